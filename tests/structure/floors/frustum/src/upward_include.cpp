// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/frustum/low.h"
#include "rhview/rhoctree/high.h"

int rhview::low() {
    return 1;
}
