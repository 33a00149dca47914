# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# cpack -G DEB in the build folder: one Debian package with program, libraries, headers, CMake package, pkg-config
# files and manual page.

set(CPACK_PACKAGE_NAME rhview)
set(CPACK_PACKAGE_VENDOR "The rhview authors")
set(CPACK_PACKAGE_CONTACT "The rhview authors <rhview@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
# Shared libraries that programs and librhview were linked to; what only the C++ headers and static libraries need is
# recommended, so that the C library can be had without.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libglm-dev, libtbb-dev, libmeshoptimizer-dev, libhwy-dev")
include(CPack)
