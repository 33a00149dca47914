// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/frustum/low.h"

int rhview::low() {
    return 1;
}
