# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# cmake -DBINARY=… -DROOT=… -DCONFIG=… -DVERSION=… -DC_COMPILER=… -DCXX_COMPILER=… -DSOURCE=… -P debian_package.cmake
#
# Makes the Debian package, unpacks it into an emptied folder as dpkg would into /, and uses what is there as its users
# do: the program, the manual page, and both libraries through pkg-config.

file(REMOVE_RECURSE "${ROOT}")
execute_process(COMMAND ${CMAKE_CPACK_COMMAND} -G DEB -C "${CONFIG}" -B "${ROOT}/made"
  WORKING_DIRECTORY "${BINARY}" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB packages "${ROOT}/made/*.deb")
list(LENGTH packages count)
if(NOT count EQUAL 1)
  message(FATAL_ERROR "one package was to be made, not: '${packages}'")
endif()
execute_process(COMMAND dpkg-deb -x "${packages}" "${ROOT}/root" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND dpkg-deb -f "${packages}" Depends OUTPUT_VARIABLE depends COMMAND_ERROR_IS_FATAL ANY)
if(NOT depends MATCHES "libtbb" OR NOT depends MATCHES "libc6")
  message(FATAL_ERROR "the package does not name what its libraries were linked to: '${depends}'")
endif()

set(usr "${ROOT}/root/usr")
foreach(file IN ITEMS bin/rhview include/rhview/rhview.h include/rhview/pipeline/rhview_planner.h
    lib/cmake/rhview/rhviewConfig.cmake share/man/man1/rhview.1 share/doc/rhview/LICENSE)
  if(NOT EXISTS "${usr}/${file}")
    message(FATAL_ERROR "the package has no /usr/${file}")
  endif()
endforeach()

execute_process(COMMAND "${usr}/bin/rhview" --version OUTPUT_VARIABLE told COMMAND_ERROR_IS_FATAL ANY)
if(NOT told MATCHES "^${VERSION}")
  message(FATAL_ERROR "its program calls itself '${told}'")
endif()

# Every option that a verb's help names is in the manual page, and troff finds nothing wrong with it.
file(READ "${usr}/share/man/man1/rhview.1" page)
string(REPLACE "\\-" "-" page "${page}")
foreach(verb IN ITEMS info calibrate walk compare bake)
  execute_process(COMMAND "${usr}/bin/rhview" ${verb} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "--[a-z][a-z-]*" options "${help}")
  foreach(option IN LISTS options)
    string(FIND "${page}" "${option}" place)
    if(place EQUAL -1)
      message(FATAL_ERROR "the manual page lacks ${verb} ${option}")
    endif()
  endforeach()
endforeach()
find_program(groff groff)
if(groff)
  execute_process(COMMAND "${groff}" -ww -k -mandoc -Tutf8 -z "${usr}/share/man/man1/rhview.1"
    ERROR_VARIABLE warnings COMMAND_ERROR_IS_FATAL ANY)
  if(warnings)
    message(FATAL_ERROR "troff finds in the manual page: ${warnings}")
  endif()
endif()

# consume(program compiler library sources… ): compiled and linked with what pkg-config says, and run.
function(consume program compiler library)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env "PKG_CONFIG_PATH=${usr}/lib/pkgconfig" pkg-config --cflags --libs
    ${library} OUTPUT_VARIABLE flags COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  execute_process(COMMAND "${compiler}" ${ARGN} ${flags} -o "${ROOT}/${program}" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env "LD_LIBRARY_PATH=${usr}/lib" "${ROOT}/${program}"
    COMMAND_ERROR_IS_FATAL ANY)
endfunction()

consume(c_consumer "${C_COMPILER}" rhview -std=c99 -Wall -Wextra -Werror "${SOURCE}/c_library/main.c")
consume(cpp_consumer "${CXX_COMPILER}" rhview-cpp -std=c++20 -Wall -Wextra -Werror "${SOURCE}/main.cpp")
