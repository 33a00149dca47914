# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# cmake -DSOURCE=… -DBINARY=… -DCONFIG=… -DGENERATOR=… -DSETTINGS=… [-DPREFIX=… | -DPROGRAM=TRUE]
#   -P run.cmake -- options

set(options "")
set(after_separator FALSE)
math(EXPR last "${CMAKE_ARGC} - 1")
foreach(i RANGE ${last})
  if(after_separator)
    list(APPEND options "${CMAKE_ARGV${i}}")
  elseif(CMAKE_ARGV${i} STREQUAL "--")
    set(after_separator TRUE)
  endif()
endforeach()

# An old cache would hide a changed default.
file(REMOVE_RECURSE "${BINARY}")
execute_process(COMMAND ${CMAKE_COMMAND} -S "${SOURCE}" -B "${BINARY}" -G "${GENERATOR}" -C "${SETTINGS}"
  "-DCMAKE_BUILD_TYPE=${CONFIG}" ${options} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build "${BINARY}" --config "${CONFIG}" --parallel 2
  COMMAND_ERROR_IS_FATAL ANY)
if(PREFIX)
  include("${CMAKE_CURRENT_LIST_DIR}/install.cmake")
endif()
if(PROGRAM)
  execute_process(COMMAND "${BINARY}/bin/consumer" COMMAND_ERROR_IS_FATAL ANY)
endif()
