# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# Target rhview_reference: HTML of the public headers of all modules that are built, by Doxygen, in <build>/reference.
# RHVIEW_DOXYGEN and RHVIEW_DOXYFILE are for the test that takes its warnings for errors.

find_program(RHVIEW_DOXYGEN doxygen)
mark_as_advanced(RHVIEW_DOXYGEN)
if(NOT RHVIEW_DOXYGEN)
  message(STATUS "rhview: no target rhview_reference: there is no doxygen")
  return()
endif()

set(RHVIEW_REFERENCE_DIR "${PROJECT_BINARY_DIR}/reference")
set(RHVIEW_REFERENCE_INPUT "")
get_property(modules GLOBAL PROPERTY RHVIEW_MODULES)
foreach(module IN LISTS modules)
  string(APPEND RHVIEW_REFERENCE_INPUT " \"${PROJECT_SOURCE_DIR}/${module}/include\"")
endforeach()
set(RHVIEW_DOXYFILE "${PROJECT_BINARY_DIR}/Doxyfile")
configure_file("${PROJECT_SOURCE_DIR}/docs/Doxyfile.in" "${RHVIEW_DOXYFILE}" @ONLY)
file(MAKE_DIRECTORY "${RHVIEW_REFERENCE_DIR}")
add_custom_target(rhview_reference COMMAND "${RHVIEW_DOXYGEN}" "${RHVIEW_DOXYFILE}"
  COMMENT "Reference: ${RHVIEW_REFERENCE_DIR}/index.html" VERBATIM)
