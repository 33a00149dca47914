# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# Install rules and the CMake package. The core modules are the component `core`; every other module is a component of
# its own name, with its own export file, so that find_package(rhview) looks for GLM, oneTBB, meshoptimizer and
# Highway alone. `capi`, a shared library, needs nothing.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The export file of a component, without its ending: rhviewScenesTargets.
function(rhview_export_name component result)
  string(SUBSTRING "${component}" 0 1 first)
  string(SUBSTRING "${component}" 1 -1 rest)
  string(TOUPPER "${first}" first)
  set(${result} "rhview${first}${rest}Targets" PARENT_SCOPE)
endfunction()

function(rhview_component_of module result)
  if(module IN_LIST RHVIEW_CORE_MODULES)
    set(${result} core PARENT_SCOPE)
  else()
    set(${result} "${module}" PARENT_SCOPE)
  endif()
endfunction()

# What a consumer of the module must find: its link libraries, private ones too, since a static library leaves them to
# the final link. The namespace of an imported target is the package's name; PkgConfig::<module> stays as it is.
function(rhview_requirements_of module packages_result components_result)
  set(packages "")
  set(components "")
  set(libraries "")
  get_target_property(type rhview_${module} TYPE)
  if(NOT type STREQUAL "SHARED_LIBRARY")
    get_target_property(libraries rhview_${module} LINK_LIBRARIES)
  endif()
  foreach(library IN LISTS libraries)
    if(library MATCHES "^rhview::(.+)$")
      rhview_component_of(${CMAKE_MATCH_1} component)
      list(APPEND components ${component})
    elseif(library MATCHES "^PkgConfig::")
      list(APPEND packages ${library})
    elseif(library MATCHES "^([^$<>:]+)::")
      list(APPEND packages ${CMAKE_MATCH_1})
    endif()
  endforeach()
  set(${packages_result} "${packages}" PARENT_SCOPE)
  set(${components_result} "${components}" PARENT_SCOPE)
endfunction()

function(rhview_install_module module component)
  get_target_property(header_sets rhview_${module} INTERFACE_HEADER_SETS)
  set(file_sets "")
  foreach(header_set IN LISTS header_sets)
    list(APPEND file_sets FILE_SET ${header_set} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  endforeach()
  install(TARGETS rhview_${module} EXPORT rhview_${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
    ${file_sets})
endfunction()

# pkg-config, for who builds without CMake. Paths are relative to the file: an install can be moved.
function(rhview_install_pkg_config name)
  cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_LIBDIR BASE_DIRECTORY "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig"
    OUTPUT_VARIABLE libdir)
  cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_INCLUDEDIR BASE_DIRECTORY "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig"
    OUTPUT_VARIABLE includedir)
  configure_file("${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in" "${PROJECT_BINARY_DIR}/cmake/${name}.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/cmake/${name}.pc" DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

# Written from the program's own --help whenever that was built.
function(rhview_install_man_page)
  find_package(Python3 COMPONENTS Interpreter)
  if(NOT Python3_Interpreter_FOUND OR CMAKE_CROSSCOMPILING)
    message(STATUS "rhview: no Python, or a program that does not run here: there will be no manual page")
    return()
  endif()
  set(page "${PROJECT_BINARY_DIR}/man/rhview.1")
  set(script "${PROJECT_SOURCE_DIR}/scripts/man_page.py")
  file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/man")
  add_custom_command(OUTPUT "${page}" DEPENDS rhview_cli "${script}" VERBATIM
    COMMAND ${CMAKE_COMMAND} -E env "ASAN_OPTIONS=detect_leaks=0"
      "${Python3_EXECUTABLE}" "${script}" "$<TARGET_FILE:rhview_cli>" "${page}")
  add_custom_target(rhview_man_page ALL DEPENDS "${page}")
  install(FILES "${page}" DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endfunction()

function(rhview_install)
  set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/rhview")
  get_property(modules GLOBAL PROPERTY RHVIEW_MODULES)
  set(components "")
  foreach(module IN LISTS modules)
    rhview_component_of(${module} component)
    list(APPEND components ${component})
    rhview_install_module(${module} ${component})
    rhview_requirements_of(${module} packages required)
    # Lower floors are built first: what a required component requires is known by now.
    foreach(other IN LISTS required)
      list(APPEND requires_${component} ${requires_${other}} ${other})
    endforeach()
    list(APPEND packages_${component} ${packages})
  endforeach()
  install(TARGETS rhview_core EXPORT rhview_core)

  list(REMOVE_DUPLICATES components)
  set(RHVIEW_COMPONENT_TABLE "")
  foreach(component IN LISTS components)
    list(REMOVE_DUPLICATES requires_${component})
    list(REMOVE_ITEM requires_${component} ${component})
    list(REMOVE_DUPLICATES packages_${component})
    string(APPEND RHVIEW_COMPONENT_TABLE
      "set(_rhview_requires_${component} \"${requires_${component}}\")\n"
      "set(_rhview_packages_${component} \"${packages_${component}}\")\n")
    rhview_export_name(${component} export_name)
    string(APPEND RHVIEW_COMPONENT_TABLE "set(_rhview_targets_${component} ${export_name}.cmake)\n")
    install(EXPORT rhview_${component} NAMESPACE rhview:: FILE ${export_name}.cmake DESTINATION ${package_dir})
  endforeach()
  set(RHVIEW_COMPONENTS "${components}")

  configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/rhviewConfig.cmake.in"
    "${PROJECT_BINARY_DIR}/cmake/rhviewConfig.cmake" INSTALL_DESTINATION ${package_dir}
    NO_SET_AND_CHECK_MACRO)
  write_basic_package_version_file("${PROJECT_BINARY_DIR}/cmake/rhviewConfigVersion.cmake"
    VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
  install(FILES "${PROJECT_BINARY_DIR}/cmake/rhviewConfig.cmake"
    "${PROJECT_BINARY_DIR}/cmake/rhviewConfigVersion.cmake" DESTINATION ${package_dir})

  if(TARGET rhview_cli)
    install(TARGETS rhview_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    install(FILES "${PROJECT_SOURCE_DIR}/scripts/report.py" "${PROJECT_SOURCE_DIR}/scripts/report_page.py"
      DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/rhview)
    rhview_install_man_page()
  endif()

  set(core_libraries ${RHVIEW_CORE_MODULES})
  list(REVERSE core_libraries)
  list(TRANSFORM core_libraries PREPEND "-lrhview_")
  list(JOIN core_libraries " " RHVIEW_CORE_LIBRARIES)
  rhview_install_pkg_config(rhview-cpp)
  if(TARGET rhview_capi)
    rhview_install_pkg_config(rhview)
  endif()
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION ${CMAKE_INSTALL_DOCDIR})
endfunction()

rhview_install()
