// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/lod/baked_lod.h"

#include <cmath>
#include <limits>
#include <string>

#include "rhview/base/index_check.h"

namespace rhview {
namespace {

constexpr SectionTag kChains = section_tag("LCHN");
constexpr SectionTag kLevels = section_tag("LLEV");
constexpr SectionTag kIndices = section_tag("LIDX");
constexpr std::uint32_t kVersion = 1;  // of each of them

/// Section LCHN: one record per mesh.
struct ChainRecord {
    std::uint64_t vertex_count = 0;
    std::uint64_t first_index = 0;  ///< into section LIDX
    std::uint64_t index_count = 0;
    std::uint32_t level_count = 0;
    std::uint32_t end = 0;  ///< `LodEnd`
};
static_assert(sizeof(ChainRecord) == 32);
static_assert(sizeof(LodLevel) == 16);

ChainRecord record_of(const LodChain& chain, std::uint64_t first_index) {
    return {chain.vertex_count, first_index, chain.indices.size(),
            static_cast<std::uint32_t>(chain.levels.size()), static_cast<std::uint32_t>(chain.end)};
}

/// Takes chains out of the sections, and checks what it takes.
class ChainReader {
  public:
    ChainReader(const RhoFile& file, MappableArray<LodLevel> levels, MappableArray<std::uint32_t> indices)
        : file_(file), levels_(std::move(levels)), indices_(std::move(indices)) {}

    Result<LodChain> next(const ChainRecord& record, std::size_t number);
    /// Whether all that is there was taken.
    [[nodiscard]] Status finish() const;

  private:
    [[nodiscard]] Error wrong(std::size_t chain, const char* what) const {
        return file_.error(kChains, "chain " + std::to_string(chain) + ": " + what);
    }
    [[nodiscard]] Status check_levels(const LodChain& chain, std::size_t number) const;
    [[nodiscard]] static const char* fault_of(const LodLevel& level, const LodLevel& before);

    const RhoFile& file_;
    MappableArray<LodLevel> levels_;
    MappableArray<std::uint32_t> indices_;
    std::size_t next_level_ = 0;
    std::size_t next_index_ = 0;
};

Result<LodChain> ChainReader::next(const ChainRecord& record, std::size_t number) {
    if (record.level_count == 0 || record.level_count > levels_.size() - next_level_)
        return wrong(number, "its levels are not in section LLEV");
    if (record.first_index != next_index_ || record.index_count > indices_.size() - next_index_)
        return wrong(number, "its indices are not in section LIDX, or leave a gap");
    if (record.index_count > std::numeric_limits<std::uint32_t>::max())
        return wrong(number, "it has 2^32 indices or more");
    if (record.end > static_cast<std::uint32_t>(LodEnd::Locked))
        return wrong(number, "there is no such reason for its end");
    LodChain chain;
    chain.levels = {levels_.span().subspan(next_level_, record.level_count), file_.owner()};
    chain.indices = {indices_.span().subspan(next_index_, record.index_count), file_.owner()};
    chain.vertex_count = record.vertex_count;
    chain.end = static_cast<LodEnd>(record.end);
    next_level_ += chain.levels.size();
    next_index_ += chain.indices.size();
    if (Status status = check_levels(chain, number); !status) return status.error();
    return chain;
}

const char* ChainReader::fault_of(const LodLevel& level, const LodLevel& before) {
    if (level.index_count == 0 || level.index_count % 3 != 0)
        return "its index count is none, or no multiple of three";
    if (level.index_count >= before.index_count) return "it is not smaller than the one before";
    if (!std::isfinite(level.error) || !(level.error > 0.0f) || level.error < before.error)
        return "its error is not finite, or below that of the one before";
    if (level.sloppy > 1 || level.sloppy < before.sloppy) return "it is not known whether it is sloppy";
    return nullptr;
}

Status ChainReader::check_levels(const LodChain& chain, std::size_t number) const {
    const LodLevel& whole = chain.levels[0];
    if (whole.first_index != 0 || whole.index_count % 3 != 0 || whole.error != 0.0f || whole.sloppy != 0)
        return wrong(number, "its level 0 is not the mesh itself");
    std::uint64_t next_index = 0;
    for (std::size_t i = 1; i < chain.levels.size(); ++i) {
        const LodLevel& level = chain.levels[i];
        const char* fault = fault_of(level, chain.levels[i - 1]);
        if (level.first_index != next_index) fault = "its indices do not follow those of the one before";
        if (fault != nullptr)
            return file_.error(
                kLevels, "chain " + std::to_string(number) + ", level " + std::to_string(i) + ": " + fault);
        next_index += level.index_count;
    }
    if (next_index != chain.indices.size())
        return wrong(number, "it has more or fewer indices than its levels");
    if (!all_below(chain.indices.span(), chain.vertex_count))
        return wrong(number, "an index is not below its number of vertices");
    return success();
}

Status ChainReader::finish() const {
    if (next_level_ != levels_.size()) return file_.error(kLevels, "it holds levels of no chain");
    if (next_index_ != indices_.size()) return file_.error(kIndices, "it holds indices of no chain");
    return success();
}

}  // namespace

void add_lod_sections(RhoWriter& writer, std::span<const LodChain> chains) {
    std::vector<std::byte> records;
    std::vector<std::span<const std::byte>> levels, indices;
    std::uint64_t first_index = 0;
    for (const LodChain& chain : chains) {
        const ChainRecord record = record_of(chain, first_index);
        const std::span<const std::byte> bytes = std::as_bytes(std::span(&record, 1));
        records.insert(records.end(), bytes.begin(), bytes.end());
        levels.push_back(std::as_bytes(chain.levels.span()));
        indices.push_back(std::as_bytes(chain.indices.span()));
        first_index += chain.indices.size();
    }
    writer.add_owned(kChains, kVersion, std::move(records));
    writer.add(kLevels, kVersion, std::move(levels));
    writer.add(kIndices, kVersion, std::move(indices));
}

Result<std::optional<std::vector<LodChain>>> read_lod_sections(const RhoFile& file) {
    using Chains = std::optional<std::vector<LodChain>>;
    if (!file.has(kChains)) return Chains();
    const Result<MappableArray<ChainRecord>> records = file.array<ChainRecord>(kChains, kVersion);
    if (!records) return records.error();
    Result<MappableArray<LodLevel>> levels = file.array<LodLevel>(kLevels, kVersion);
    if (!levels) return levels.error();
    Result<MappableArray<std::uint32_t>> indices = file.array<std::uint32_t>(kIndices, kVersion);
    if (!indices) return indices.error();
    ChainReader reader(file, std::move(levels).value(), std::move(indices).value());
    std::vector<LodChain> chains;
    chains.reserve(records->size());
    for (std::size_t i = 0; i < records->size(); ++i) {
        Result<LodChain> chain = reader.next((*records)[i], i);
        if (!chain) return chain.error();
        chains.push_back(std::move(chain).value());
    }
    if (Status status = reader.finish(); !status) return status.error();
    return Chains(std::move(chains));
}

}  // namespace rhview
