// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/baked_scene.h"

#include "baked_scene_check.h"
#include "scene_description.h"

namespace rhview {
namespace {

constexpr std::uint32_t kVersion = 1;  // of the sections of long arrays
constexpr SectionTag kPositions = section_tag("SPOS");
constexpr SectionTag kNormals = section_tag("SNRM");
constexpr SectionTag kColours = section_tag("SCOL");
constexpr SectionTag kIndices = section_tag("SIDX");
constexpr SectionTag kObjects = section_tag("SOBJ");

/// The pieces of a section: this array of each item, one after the other.
template <class Items, class Member>
void append_pieces(std::vector<std::span<const std::byte>>& pieces, const Items& items, Member member) {
    for (const auto& item : items) pieces.push_back(std::as_bytes((item.*member).span()));
}

/// A section's records, handed out in the order in which they were written.
template <class T>
class Handout {
  public:
    static Result<Handout> read(const RhoFile& file, SectionTag tag) {
        Result<MappableArray<T>> records = file.array<T>(tag, kVersion);
        if (!records) return records.error();
        return Handout(std::move(records).value(), file.owner());
    }

    /// The next `count` records into `target`.
    void take(std::uint64_t count, MappableArray<T>& target) {
        complete_ = complete_ && count <= records_.size() - taken_;
        if (!complete_) return;
        const auto size = static_cast<std::size_t>(count);
        target = MappableArray<T>(records_.span().subspan(taken_, size), owner_);
        taken_ += size;
    }
    /// Whether there were exactly as many as were taken.
    [[nodiscard]] bool fits() const { return complete_ && taken_ == records_.size(); }

  private:
    Handout(MappableArray<T> records, std::shared_ptr<const void> owner)
        : records_(std::move(records)), owner_(std::move(owner)) {}

    MappableArray<T> records_;
    std::shared_ptr<const void> owner_;
    std::size_t taken_ = 0;
    bool complete_ = true;
};

Error wrong_length(const RhoFile& file, SectionTag tag) {
    return file.error(tag, "it holds more or fewer records than section SCNE counts");
}

Status hand_out_vertices(const RhoFile& file, const SceneDescription& d, Scene& scene) {
    Result<Handout<glm::vec3>> positions = Handout<glm::vec3>::read(file, kPositions);
    if (!positions) return positions.error();
    Result<Handout<PackedNormal>> normals = Handout<PackedNormal>::read(file, kNormals);
    if (!normals) return normals.error();
    Result<Handout<PackedColour>> colours = Handout<PackedColour>::read(file, kColours);
    if (!colours) return colours.error();
    for (const PoolRecord& record : d.pools) {
        VertexPool& pool = scene.pools.emplace_back();
        positions->take(record.vertices, pool.positions);
        if (record.normals) normals->take(record.vertices, pool.normals);
        if (record.colours) colours->take(record.vertices, pool.colours);
    }
    if (!positions->fits()) return wrong_length(file, kPositions);
    if (!normals->fits()) return wrong_length(file, kNormals);
    return colours->fits() ? success() : wrong_length(file, kColours);
}

Status hand_out_indices(const RhoFile& file, const SceneDescription& d, Scene& scene) {
    Result<Handout<std::uint32_t>> indices = Handout<std::uint32_t>::read(file, kIndices);
    if (!indices) return indices.error();
    Result<Handout<SceneObject>> objects = Handout<SceneObject>::read(file, kObjects);
    if (!objects) return objects.error();
    for (const BatchRecord& record : d.batches) {
        SceneBatch& batch = scene.batches.emplace_back();
        batch.material = record.material;
        batch.pool = record.pool;
        indices->take(record.indices, batch.indices);
        objects->take(record.objects, batch.objects);
    }
    for (const MeshRecord& record : d.meshes) {
        SceneMesh& mesh = scene.meshes.emplace_back();
        mesh.material = record.material;
        mesh.pool = record.pool;
        mesh.bounds = record.bounds;
        indices->take(record.indices, mesh.indices);
    }
    if (!indices->fits()) return wrong_length(file, kIndices);
    return objects->fits() ? success() : wrong_length(file, kObjects);
}

}  // namespace

void add_scene_sections(RhoWriter& writer, const SceneAndPath& loaded, const SceneProvenance& provenance) {
    const Scene& scene = loaded.scene;
    using Pieces = std::vector<std::span<const std::byte>>;
    writer.add_owned(kSceneDescription, kMotionsVersion, to_bytes(describe(loaded, provenance)));
    Pieces positions, normals, colours, indices, objects;
    append_pieces(positions, scene.pools, &VertexPool::positions);
    append_pieces(normals, scene.pools, &VertexPool::normals);
    append_pieces(colours, scene.pools, &VertexPool::colours);
    append_pieces(indices, scene.batches, &SceneBatch::indices);
    append_pieces(indices, scene.meshes, &SceneMesh::indices);
    append_pieces(objects, scene.batches, &SceneBatch::objects);
    writer.add(kPositions, kVersion, std::move(positions));
    writer.add(kNormals, kVersion, std::move(normals));
    writer.add(kColours, kVersion, std::move(colours));
    writer.add(kIndices, kVersion, std::move(indices));
    writer.add(kObjects, kVersion, std::move(objects));
}

Result<BakedScene> read_scene_sections(const RhoFile& file) {
    const Result<MappableArray<std::byte>> bytes =
        file.section(kSceneDescription, kMotionsVersion, kOldestDescription);
    if (!bytes) return bytes.error();
    std::optional<SceneDescription> d = parse_description(bytes->span(), file.version_of(kSceneDescription));
    if (!d) return file.error(kSceneDescription, "a count in it contradicts its length");
    BakedScene baked;
    Scene& scene = baked.scene.scene;
    if (Status status = hand_out_vertices(file, *d, scene); !status) return status.error();
    if (Status status = hand_out_indices(file, *d, scene); !status) return status.error();
    scene.name = std::move(d->name);
    scene.origin = d->origin;
    scene.materials = std::move(d->materials);
    scene.dynamic_objects = std::move(d->dynamic_objects);
    scene.motions = std::move(d->motions);
    scene.static_instances = std::move(d->static_instances);
    scene.instancing = d->instancing;
    scene.dropped_triangles = d->dropped_triangles;
    scene.warnings = std::move(d->warnings);
    baked.scene.path = std::move(d->path);
    baked.provenance = std::move(d->provenance);
    if (Status status = check_baked_scene(file, baked.scene); !status) return status.error();
    if (scene.static_triangles() != d->static_triangles || scene.dynamic_triangles() != d->dynamic_triangles)
        return file.error(kSceneDescription,
                          "the source had another number of triangles than the file holds");
    return baked;
}

}  // namespace rhview
