// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "chains.h"

#include <algorithm>

#include "border.h"
#include "rhview/lod/baked_lod.h"
#include "source_arrays.h"

namespace rhview::capi {
namespace {

/// Planners number levels by a byte.
constexpr std::size_t kMostLevels = 255;

rhview_status fail_null() {
    return fail(RHVIEW_INVALID_ARGUMENT, "an argument is null");
}

rhview_status take_options(const rhview_chain_options* given, LodOptions& options, Workers& workers) {
    rhview_chain_options taken;
    if (const rhview_status status = take(given, "rhview_chain_options", taken); status != RHVIEW_OK)
        return status;
    if (const rhview_status status = take_workers(taken.workers, workers); status != RHVIEW_OK) return status;
    if (taken.ratio != 0.0) options.ratio = taken.ratio;
    if (!(options.ratio >= 0.1 && options.ratio <= 0.8))
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_chain_options: ratio is 0.1 to 0.8");
    if (taken.min_triangles != 0) options.min_triangles = taken.min_triangles;
    options.lock_borders = taken.locks_borders != 0;
    options.allow_sloppy = taken.forbids_sloppy == 0;
    if (taken.progress != nullptr)
        options.progress = [call = taken.progress, user = taken.progress_user](double share) {
            return call(user, share) != 0;
        };
    return RHVIEW_OK;
}

/// Hands out `chains` as a handle.
rhview_status give_chains(std::vector<LodChain> chains, rhview_chains** out) {
    for (const LodChain& chain : chains)
        if (chain.levels.size() > kMostLevels)
            return fail(RHVIEW_INVALID_DATA, "a chain has more than 255 levels");
    *out = new rhview_chains{std::make_shared<const std::vector<LodChain>>(std::move(chains))};
    return RHVIEW_OK;
}

rhview_status build(const rhview_mesh* meshes, std::size_t count, const rhview_chain_options* given,
                    rhview_chains** out) {
    LodOptions options;
    Workers workers;
    if (const rhview_status status = take_options(given, options, workers); status != RHVIEW_OK)
        return status;
    SourceArrays arrays;
    std::vector<LodMesh> sources;
    for (std::size_t i = 0; i < count; ++i) {
        rhview_mesh mesh = meshes[i];
        complete_arrays(mesh);
        if (const char* wrong = wrong_arrays(mesh)) return fail_field("rhview_mesh", {wrong});
        sources.push_back({arrays.positions(mesh), arrays.indices(mesh)});
    }
    Result<std::vector<LodChain>> chains =
        run_on(workers, [&] { return build_lod_chains(sources, options); });
    if (!chains) return fail(RHVIEW_INVALID_DATA, chains.error().message);
    return give_chains(std::move(chains).value(), out);
}

rhview_status load(const char* file, rhview_chains** out) {
    const Result<RhoFile> opened = RhoFile::open(file);
    if (!opened) return fail(RHVIEW_INVALID_DATA, opened.error().message);
    Result<std::optional<std::vector<LodChain>>> chains =
        run_on(Workers{}, [&] { return read_lod_sections(*opened); });
    if (!chains) return fail(RHVIEW_INVALID_DATA, chains.error().message);
    if (!chains->has_value())
        return fail(RHVIEW_INVALID_DATA,
                    opened->name() + ": there are no levels of detail in it; save some, or bake it anew");
    return give_chains(std::move(**chains), out);
}

rhview_status save(const std::vector<LodChain>& chains, const char* file) {
    Result<RhoWriter> writer = RhoWriter::create(file);
    if (!writer) return fail(RHVIEW_INVALID_DATA, writer.error().message);
    add_lod_sections(*writer, chains);
    const Result<std::uint64_t> bytes = writer->finish();
    if (!bytes) return fail(RHVIEW_INVALID_DATA, bytes.error().message);
    return RHVIEW_OK;
}

rhview_chain exported(const LodChain& chain) {
    // Equal is what they have to be.
    // NOLINTNEXTLINE(misc-redundant-expression)
    static_assert(sizeof(rhview_level) == sizeof(LodLevel) && alignof(rhview_level) == alignof(LodLevel) &&
                  offsetof(rhview_level, error) == offsetof(LodLevel, error) &&
                  offsetof(rhview_level, is_sloppy) == offsetof(LodLevel, sloppy));
    rhview_chain out{};
    out.levels = reinterpret_cast<const rhview_level*>(chain.levels.data());
    out.level_count = chain.levels.size();
    out.indices = chain.indices.data();
    out.index_count = chain.indices.size();
    out.vertex_count = chain.vertex_count;
    out.end = text_of(chain.end).data();
    return out;
}

}  // namespace
}  // namespace rhview::capi

using namespace rhview::capi;

rhview_status rhview_chains_build(const rhview_mesh* meshes, size_t count,
                                  const rhview_chain_options* options, rhview_chains** chains) {
    return guarded([&] {
        if (chains == nullptr || (meshes == nullptr && count > 0)) return fail_null();
        return build(meshes, count, options, chains);
    });
}

rhview_status rhview_chains_load(const char* file, rhview_chains** chains) {
    return guarded([&] {
        if (file == nullptr || chains == nullptr) return fail_null();
        return load(file, chains);
    });
}

rhview_status rhview_chains_save(const rhview_chains* chains, const char* file) {
    return guarded([&] {
        if (chains == nullptr || file == nullptr) return fail_null();
        return save(*chains->chains, file);
    });
}

void rhview_chains_destroy(rhview_chains* chains) {
    delete chains;
}

rhview_status rhview_chains_get(const rhview_chains* chains, uint32_t number, rhview_chain* chain) {
    if (chains == nullptr) return fail_null();
    if (number >= chains->chains->size())
        return fail(RHVIEW_INVALID_ARGUMENT, "rhview_chains_get: there are not so many chains");
    return give(exported((*chains->chains)[number]), "rhview_chain", chain);
}
