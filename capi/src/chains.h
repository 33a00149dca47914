// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Chains of levels of detail, between C and C++.
#pragma once

#include <memory>
#include <vector>

#include "rhview/lod/lod_chain.h"
#include "rhview/rhview.h"

/// Scenes share what it holds.
struct rhview_chains {
    std::shared_ptr<const std::vector<rhview::LodChain>> chains;
};
