// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/rhoctree/high.h"

#include "rhview/frustum/low.h"

int rhview::high() {
    return low() + 1;
}
