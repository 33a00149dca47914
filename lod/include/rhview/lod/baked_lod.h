// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Chains of levels of detail as sections of a baked file (`.rho`), used as they are mapped. Layout:
/// docs/files.md.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "rhview/base/result.h"
#include "rhview/base/rho_file.h"
#include "rhview/base/rho_writer.h"
#include "rhview/lod/lod_chain.h"

namespace rhview {

/// Adds the sections of `chains`, one per mesh of the scene in its order. They stay as they are until the
/// writer has finished.
void add_lod_sections(RhoWriter& writer, std::span<const LodChain> chains);

/// Reads them; none where the file has none. Checked: that chains share out the levels and levels the
/// indices, that counts fall and are multiples of three, that errors are finite and never fall, sloppy levels
/// come last, and that every index is below its vertex count. Whether an error bounds the level's distance
/// is as the checksums say. Errors: those of `RhoFile`, or the record that is wrong. Cost: one pass for the
/// checksums and one over the indices, on all of oneTBB's threads.
Result<std::optional<std::vector<LodChain>>> read_lod_sections(const RhoFile& file);

}  // namespace rhview
