# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# rhview_module(name [SHARED] SOURCES … HEADERS … DEPENDS … [LIBRARIES …] [PRIVATE_LIBRARIES …])
#
# One module: static library rhview_<name>, alias rhview::<name>, include root <name>/include. DEPENDS names modules,
# all of them on lower floors (an upward or sideways one stops the configure step); since each module has its own
# include directory, a header of a module that is not linked cannot be found by the compiler.

# SHARED: a shared library librhview instead, that holds what it depends on and shows its users none of it.

include_guard(GLOBAL)

set(RHVIEW_FLOOR_base 0)
set(RHVIEW_FLOOR_frustum 1)
set(RHVIEW_FLOOR_lod 1)
set(RHVIEW_FLOOR_scenes 1)
set(RHVIEW_FLOOR_timing_model 1)
set(RHVIEW_FLOOR_occlusion_queries 2)
set(RHVIEW_FLOOR_rhoctree 2)
set(RHVIEW_FLOOR_pipeline 3)
set(RHVIEW_FLOOR_gl 4)
set(RHVIEW_FLOOR_baselines 4)
set(RHVIEW_FLOOR_capi 4)

# What an engine takes: needs GLM, oneTBB, meshoptimizer and Highway. rhview::rhview links those of them that are built; the package's default
# component holds them.
set(RHVIEW_CORE_MODULES base frustum lod timing_model occlusion_queries rhoctree pipeline)

# Flags of our own targets only: consumers see none of them.
function(rhview_private_options target)
  target_compile_features(${target} PRIVATE cxx_std_20)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    target_compile_features(${target} PUBLIC cxx_std_20)
  endif()
  if(MSVC)
    target_compile_options(${target} PRIVATE /W4 $<$<BOOL:${RHVIEW_WARNINGS_AS_ERRORS}>:/WX>)
  else()
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -Wpedantic
      $<$<BOOL:${RHVIEW_WARNINGS_AS_ERRORS}>:-Werror>
      # GCC 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105329).
      $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
    if(RHVIEW_SANITIZE)
      # With sanitizers GCC takes the standard library's own variables for uninitialised.
      target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=all
        -fno-omit-frame-pointer $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
      target_link_options(${target} PUBLIC -fsanitize=address,undefined)
    endif()
    if(RHVIEW_FUZZ)
      # Counters for the fuzzer to see new paths by; its own loop is linked into its targets only.
      target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
    endif()
  endif()
endfunction()

function(rhview_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "SHARED" "" "SOURCES;HEADERS;DEPENDS;LIBRARIES;PRIVATE_LIBRARIES")
  if(NOT DEFINED RHVIEW_FLOOR_${name})
    message(FATAL_ERROR "rhview_module(${name}): the module has no floor; add it to cmake/RhviewModule.cmake")
  endif()
  foreach(dependency IN LISTS arg_DEPENDS)
    if(NOT DEFINED RHVIEW_FLOOR_${dependency})
      message(FATAL_ERROR "rhview_module(${name}): there is no module '${dependency}'")
    endif()
    if(NOT RHVIEW_FLOOR_${dependency} LESS RHVIEW_FLOOR_${name})
      message(FATAL_ERROR "rhview_module(${name}): floor ${RHVIEW_FLOOR_${name}} may not depend on '${dependency}' "
        "on floor ${RHVIEW_FLOOR_${dependency}}: dependencies point downwards")
    endif()
  endforeach()

  list(TRANSFORM arg_DEPENDS PREPEND rhview::)
  if(arg_SHARED)
    add_library(rhview_${name} SHARED ${arg_SOURCES})
    target_link_libraries(rhview_${name} PRIVATE ${arg_DEPENDS} ${arg_LIBRARIES} ${arg_PRIVATE_LIBRARIES})
    # Before 1.0 a minor release may take something away.
    set_target_properties(rhview_${name} PROPERTIES OUTPUT_NAME rhview VERSION ${PROJECT_VERSION}
      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} CXX_VISIBILITY_PRESET hidden
      VISIBILITY_INLINES_HIDDEN ON)
  else()
    add_library(rhview_${name} STATIC ${arg_SOURCES})
    target_link_libraries(rhview_${name} PUBLIC ${arg_DEPENDS} ${arg_LIBRARIES} PRIVATE ${arg_PRIVATE_LIBRARIES})
  endif()
  add_library(rhview::${name} ALIAS rhview_${name})
  target_sources(rhview_${name} PUBLIC FILE_SET HEADERS BASE_DIRS include FILES ${arg_HEADERS})
  rhview_private_options(rhview_${name})
  set_target_properties(rhview_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  set_property(GLOBAL APPEND PROPERTY RHVIEW_MODULES ${name})
  set_property(GLOBAL PROPERTY RHVIEW_HEADERS_${name} ${arg_HEADERS})

  if(name IN_LIST RHVIEW_CORE_MODULES)
    if(NOT TARGET rhview_core)
      add_library(rhview_core INTERFACE)
      add_library(rhview::rhview ALIAS rhview_core)
      set_target_properties(rhview_core PROPERTIES EXPORT_NAME rhview)
    endif()
    target_link_libraries(rhview_core INTERFACE rhview::${name})
  endif()
endfunction()
