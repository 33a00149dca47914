# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# What every consumer checks of the rhview it was handed, and how it compiles.

function(consumer_program)
  add_executable(consumer ${ARGN})
  if(NOT MSVC)
    target_compile_options(consumer PRIVATE -Wall -Wextra -Werror)
  endif()
  # Without this, warnings in installed headers would be silenced as a system's.
  set_target_properties(consumer PROPERTIES NO_SYSTEM_FROM_IMPORTED ON
    RUNTIME_OUTPUT_DIRECTORY "$<1:${CMAKE_CURRENT_BINARY_DIR}/bin>")
endfunction()

# The targets ask for the language standard and for nothing else.
function(expect_no_flags)
  foreach(target IN LISTS ARGN)
    foreach(property IN ITEMS INTERFACE_COMPILE_OPTIONS INTERFACE_LINK_OPTIONS INTERFACE_PRECOMPILE_HEADERS)
      get_target_property(value ${target} ${property})
      if(value)
        message(FATAL_ERROR "${target} hands its consumers ${property}: ${value}")
      endif()
    endforeach()
  endforeach()
endfunction()

# Of all packages that were looked for, found or not, only these.
function(expect_only_packages)
  get_property(found GLOBAL PROPERTY PACKAGES_FOUND)
  get_property(not_found GLOBAL PROPERTY PACKAGES_NOT_FOUND)
  set(looked_for ${found} ${not_found})
  list(REMOVE_ITEM looked_for ${ARGN})
  if(looked_for)
    message(FATAL_ERROR "rhview looked for packages that its core does not need: ${looked_for}")
  endif()
endfunction()
