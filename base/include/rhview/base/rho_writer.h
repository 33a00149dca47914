// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Writes baked files (`.rho`), whole or not at all.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "rhview/base/replacement_file.h"
#include "rhview/base/result.h"
#include "rhview/base/rho_file.h"

namespace rhview {

/// A `ReplacementFile`: whoever opens the file sees the old one or the new one, also after a crash.
class RhoWriter {
  public:
    /// Opens the temporary file, so that an unwritable place is told before any work is done. Links are
    /// followed to the file meant. Errors: no name, a folder, not a plain file, not writable.
    static Result<RhoWriter> create(const std::filesystem::path& file);

    /// A section of these pieces, one after the other. The pieces stay valid until `finish`; at most 64
    /// sections, each tag once.
    void add(SectionTag tag, std::uint32_t version, std::vector<std::span<const std::byte>> pieces);

    /// One piece, of records without padding.
    template <class T>
    void add_array(SectionTag tag, std::uint32_t version, std::span<const T> records) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(tag, version, {std::as_bytes(records)});
    }

    /// A section that the writer keeps itself.
    void add_owned(SectionTag tag, std::uint32_t version, std::vector<std::byte> bytes);

    /// Writes everything and puts the file in place; the bytes written, or an error. Only once.
    Result<std::uint64_t> finish();

  private:
    struct Section {
        SectionTag tag;
        std::uint32_t version;
        std::vector<std::span<const std::byte>> pieces;
    };

    explicit RhoWriter(ReplacementFile file) : file_(std::move(file)) {}
    bool write_sections(std::uint64_t& file_bytes);

    ReplacementFile file_;
    std::vector<Section> sections_;
    std::vector<std::unique_ptr<std::vector<std::byte>>> owned_;
};

}  // namespace rhview
