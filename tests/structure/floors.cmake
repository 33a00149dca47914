# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# The build enforces the order of the floors. The legal house must build: else a failure proves nothing.

function(configure case result output)
  file(REMOVE_RECURSE "${BINARY}/${case}")
  execute_process(COMMAND ${CMAKE_COMMAND} -S "${SOURCE}" -B "${BINARY}/${case}" -G "${GENERATOR}"
    "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" "-DMODULE_PATH=${MODULE_PATH}"
    "-DCASE=${case}" RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
  # CMake wraps its messages.
  string(REGEX REPLACE "[ \n]+" " " text "${text}")
  set(${result} "${status}" PARENT_SCOPE)
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

function(build case result output)
  execute_process(COMMAND ${CMAKE_COMMAND} --build "${BINARY}/${case}"
    RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
  set(${result} "${status}" PARENT_SCOPE)
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

function(expect_refused case sentence)
  configure(${case} status text)
  if(status EQUAL 0)
    message(SEND_ERROR "${case}: the configure step accepted it")
  elseif(NOT text MATCHES "${sentence}")
    message(SEND_ERROR "${case}: expected '${sentence}' in: ${text}")
  endif()
endfunction()

configure(legal status text)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the legal house does not configure: ${text}")
endif()
build(legal status text)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the legal house does not build: ${text}")
endif()

expect_refused(upward_dependency
  "floor 1 may not depend on 'rhoctree' on floor 2: dependencies point downwards")
expect_refused(sideways_dependency
  "floor 1 may not depend on 'scenes' on floor 1: dependencies point downwards")
expect_refused(unknown_dependency "there is no module 'utils'")

configure(upward_include status text)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "upward_include: the mistake is in the source, yet it does not configure: ${text}")
endif()
build(upward_include status text)
if(status EQUAL 0)
  message(SEND_ERROR "upward_include: frustum compiled a header of rhoctree")
elseif(NOT text MATCHES "rhview/rhoctree/high\\.h")
  message(SEND_ERROR "upward_include: it fails for another reason: ${text}")
endif()
