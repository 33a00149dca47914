// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

namespace rhview {

int high();

}  // namespace rhview
