# SPDX-FileCopyrightText: 2026 The rhview authors
# SPDX-License-Identifier: MIT
#
# cmake -DBINARY=… -DPREFIX=… -DCONFIG=… -P install.cmake: installs to an emptied prefix.

unset(ENV{DESTDIR})
file(REMOVE_RECURSE "${PREFIX}")
execute_process(COMMAND ${CMAKE_COMMAND} --install "${BINARY}" --config "${CONFIG}" --prefix "${PREFIX}"
  COMMAND_ERROR_IS_FATAL ANY)
