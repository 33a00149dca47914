// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/static_instances.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "placement.h"
#include "rhview/scenes/memory.h"

namespace rhview {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kMost = kNone - 1;  // vertices of a pool, indices of a batch

std::uint64_t bytes_per_vertex(const VertexPool& pool) {
    return sizeof(glm::vec3) + (pool.normals.empty() ? 0 : sizeof(PackedNormal)) +
           (pool.colours.empty() ? 0 : sizeof(PackedColour));
}

/// A mesh taken out of its pool: what its placements are made from.
struct LooseMesh {
    MaterialId material{};
    std::uint32_t pool = 0;
    std::vector<std::uint32_t> indices;  ///< into the arrays below
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<PackedColour> colours;
};

/// Numbers the vertices that `indices` use, in the order of their first use; the same numbers replace the
/// indices.
std::vector<std::uint32_t> used_vertices(std::vector<std::uint32_t>& indices,
                                         std::vector<std::uint32_t>& number_of) {
    std::vector<std::uint32_t> used;
    for (std::uint32_t& index : indices) {
        if (number_of.size() <= index) number_of.resize(std::size_t{index} + 1, kNone);
        if (number_of[index] == kNone) {
            number_of[index] = static_cast<std::uint32_t>(used.size());
            used.push_back(index);
        }
        index = number_of[index];
    }
    for (const std::uint32_t vertex : used) number_of[vertex] = kNone;
    return used;
}

LooseMesh take_out(const Scene& scene, const SceneMesh& mesh, std::vector<std::uint32_t>& number_of) {
    LooseMesh loose{mesh.material, mesh.pool, {mesh.indices.begin(), mesh.indices.end()}, {}, {}, {}};
    const VertexPool& pool = scene.pools[mesh.pool];
    for (const std::uint32_t vertex : used_vertices(loose.indices, number_of)) {
        loose.positions.push_back(pool.positions[vertex]);
        if (!pool.normals.empty()) loose.normals.push_back(unpack_normal(pool.normals[vertex]));
        if (!pool.colours.empty()) loose.colours.push_back(pool.colours[vertex]);
    }
    return loose;
}

/// Moves the elements that stay to their new places, further to the front.
template <class T>
void compact(MappableArray<T>& array, const std::vector<std::uint32_t>& new_place) {
    if (array.empty()) return;
    std::vector<T>& elements = array.own();
    std::size_t count = 0;
    for (std::size_t i = 0; i < elements.size(); ++i)
        if (new_place[i] != kNone) elements[count++] = elements[i];
    elements.resize(count);
}

class Flattening {
  public:
    Flattening(Scene& scene, std::span<const MeshId> meshes)
        : scene_(scene), loose_of_(scene.meshes.size(), kNone) {
        std::vector<std::uint32_t> number_of;
        for (const MeshId mesh : meshes) {
            loose_of_[index_of(mesh)] = static_cast<std::uint32_t>(loose_.size());
            loose_.push_back(take_out(scene, scene.meshes[index_of(mesh)], number_of));
        }
    }

    /// Whether pools and batches hold what is to come.
    Status measure();
    void run();

  private:
    [[nodiscard]] bool is_flattened(const StaticInstance& instance) const {
        return loose_of_[index_of(instance.mesh)] != kNone;
    }
    std::uint32_t batch_for(MaterialId material, std::uint32_t pool);
    void remove_meshes();
    void remove_vertices();
    void reserve();
    void place(const StaticInstance& instance);

    Scene& scene_;
    std::vector<LooseMesh> loose_;
    std::vector<std::uint32_t> loose_of_;  ///< by mesh
    std::vector<std::uint64_t> vertices_;  ///< to come, by pool
    std::vector<std::uint64_t> indices_;   ///< to come, by batch
    std::vector<std::uint64_t> objects_;
};

std::uint32_t Flattening::batch_for(MaterialId material, std::uint32_t pool) {
    const auto found = std::ranges::find_if(scene_.batches, [&](const SceneBatch& batch) {
        return batch.material == material && batch.pool == pool;
    });
    return static_cast<std::uint32_t>(found - scene_.batches.begin());
}

Status Flattening::measure() {
    vertices_.assign(scene_.pools.size(), 0);
    indices_.assign(scene_.batches.size() + loose_.size(), 0);
    objects_ = indices_;
    std::vector<std::pair<MaterialId, std::uint32_t>> new_batches;
    for (const StaticInstance& instance : scene_.static_instances) {
        if (!is_flattened(instance)) continue;
        const LooseMesh& loose = loose_[loose_of_[index_of(instance.mesh)]];
        std::size_t batch = batch_for(loose.material, loose.pool);
        if (batch == scene_.batches.size()) {
            const std::pair key(loose.material, loose.pool);
            const auto found = std::ranges::find(new_batches, key);
            batch += static_cast<std::size_t>(found - new_batches.begin());
            if (found == new_batches.end()) new_batches.push_back(key);
        }
        vertices_[loose.pool] += loose.positions.size();
        indices_[batch] += loose.indices.size();
        ++objects_[batch];
    }
    bool fits = true;
    for (std::size_t i = 0; i < vertices_.size(); ++i)
        fits = fits && vertices_[i] + scene_.pools[i].positions.size() <= kMost;
    for (std::size_t i = 0; i < indices_.size(); ++i)
        fits =
            fits && indices_[i] + (i < scene_.batches.size() ? scene_.batches[i].indices.size() : 0) <= kMost;
    if (!fits)
        return Error{scene_.name +
                     ": flattened, it has more than 4,294,967,294 vertices or indices in one vertex format; "
                     "keep more of its instances"};
    for (const auto& [material, pool] : new_batches) scene_.batches.push_back({material, pool, {}, {}});
    return success();
}

/// What nothing places any more goes; the others move up.
void Flattening::remove_meshes() {
    std::vector<bool> is_placed(scene_.meshes.size());
    for (const DynamicObject& object : scene_.dynamic_objects) is_placed[index_of(object.mesh)] = true;
    for (std::size_t i = 0; i < is_placed.size(); ++i) is_placed[i] = is_placed[i] || loose_of_[i] == kNone;
    std::vector<MeshId> new_id(scene_.meshes.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < scene_.meshes.size(); ++i) {
        if (!is_placed[i]) continue;
        new_id[i] = MeshId{static_cast<std::uint32_t>(count)};
        if (count != i) scene_.meshes[count] = std::move(scene_.meshes[i]);
        ++count;
    }
    scene_.meshes.resize(count);
    for (DynamicObject& object : scene_.dynamic_objects) object.mesh = new_id[index_of(object.mesh)];
    for (StaticInstance& instance : scene_.static_instances) instance.mesh = new_id[index_of(instance.mesh)];
}

/// Those that no batch and no mesh uses.
void Flattening::remove_vertices() {
    std::vector<std::vector<std::uint32_t>> new_place;
    for (const VertexPool& pool : scene_.pools) new_place.emplace_back(pool.positions.size(), kNone);
    const auto mark = [&](const auto& part) {
        for (const std::uint32_t index : part.indices) new_place[part.pool][index] = 0;
    };
    for (const SceneBatch& batch : scene_.batches) mark(batch);
    for (const SceneMesh& mesh : scene_.meshes) mark(mesh);
    for (std::size_t i = 0; i < scene_.pools.size(); ++i) {
        std::uint32_t next = 0;
        for (std::uint32_t& place : new_place[i])
            if (place != kNone) place = next++;
        compact(scene_.pools[i].positions, new_place[i]);
        compact(scene_.pools[i].normals, new_place[i]);
        compact(scene_.pools[i].colours, new_place[i]);
    }
    const auto renumber = [&](auto& part) {
        for (std::uint32_t& index : part.indices.own()) index = new_place[part.pool][index];
    };
    for (SceneBatch& batch : scene_.batches) renumber(batch);
    for (SceneMesh& mesh : scene_.meshes) renumber(mesh);
}

void Flattening::reserve() {
    const auto reserve_more = [](auto& array, std::uint64_t more) {
        auto& elements = array.own();
        elements.reserve(elements.size() + static_cast<std::size_t>(more));
    };
    for (const LooseMesh& loose : loose_) {
        VertexPool& pool = scene_.pools[loose.pool];
        const std::uint64_t more = std::exchange(vertices_[loose.pool], 0);
        if (more == 0) continue;
        reserve_more(pool.positions, more);
        if (!loose.normals.empty()) reserve_more(pool.normals, more);
        if (!loose.colours.empty()) reserve_more(pool.colours, more);
    }
    for (std::size_t i = 0; i < scene_.batches.size(); ++i) {
        reserve_more(scene_.batches[i].indices, indices_[i]);
        reserve_more(scene_.batches[i].objects, objects_[i]);
    }
}

void Flattening::place(const StaticInstance& instance) {
    const LooseMesh& loose = loose_[loose_of_[index_of(instance.mesh)]];
    const Placement placement(instance.scene_from_mesh);
    VertexPool& pool = scene_.pools[loose.pool];
    std::vector<glm::vec3>& positions = pool.positions.own();
    const auto first_vertex = static_cast<std::uint32_t>(positions.size());
    SceneBatch& batch = scene_.batches[batch_for(loose.material, loose.pool)];
    std::vector<std::uint32_t>& indices = batch.indices.own();
    SceneObject object;
    object.first_index = static_cast<std::uint32_t>(indices.size());
    object.index_count = static_cast<std::uint32_t>(loose.indices.size());
    for (const glm::vec3& position : loose.positions) {
        positions.push_back(placement.position(position));
        object.bounds.grow(positions.back());
    }
    for (const glm::vec3& normal : loose.normals) pool.normals.own().push_back(placement.normal(normal));
    std::vector<PackedColour>& colours = pool.colours.own();
    colours.insert(colours.end(), loose.colours.begin(), loose.colours.end());
    const std::size_t second = placement.mirrored ? 2 : 1;
    for (std::size_t i = 0; i < loose.indices.size(); i += 3)
        for (const std::size_t corner : {std::size_t{0}, second, 3 - second})
            indices.push_back(first_vertex + loose.indices[i + corner]);
    batch.objects.own().push_back(object);
}

void Flattening::run() {
    std::vector<StaticInstance> to_place;
    for (const StaticInstance& instance : scene_.static_instances)
        if (is_flattened(instance)) to_place.push_back(instance);
    std::erase_if(scene_.static_instances, [&](const StaticInstance& i) { return is_flattened(i); });
    remove_meshes();
    remove_vertices();
    reserve();
    for (const StaticInstance& instance : to_place) place(instance);
}

/// `budget_bytes`, or as much of it as the memory that is free holds with all that is made of it.
std::uint64_t budget_of(const InstanceOptions& options) {
    if (options.policy != InstancePolicy::Auto) return options.budget_bytes;
    // Vertices are about half of what is flattened: of two bytes of it, one is half of an index triple.
    constexpr std::uint64_t kTriangles = 1024;
    constexpr std::uint64_t kTaken = 2 * 12 * kTriangles;
    const std::uint64_t needed = estimated_scene_bytes(kTriangles, kTriangles, 12);
    return std::min(options.budget_bytes, available_memory_bytes() / needed * kTaken);
}

std::vector<MeshId> chosen_by(const InstanceOptions& options, std::span<const RepeatedMesh> repeated,
                              std::uint64_t budget_bytes) {
    if (options.policy == InstancePolicy::Auto)
        return choose_flattened(repeated, options.costs, budget_bytes);
    std::vector<MeshId> all;
    if (options.policy == InstancePolicy::Flatten)
        for (const RepeatedMesh& mesh : repeated) all.push_back(mesh.mesh);
    return all;
}

InstancingReport report_of(std::span<const RepeatedMesh> repeated, std::span<const MeshId> flattened,
                           const InstanceCosts& costs) {
    InstancingReport report;
    for (const RepeatedMesh& mesh : repeated) {
        report.all_flattened_bytes += mesh.flattened_bytes();
        report.all_kept_ns += kept_ns(mesh, costs);
        report.all_flattened_ns += flattened_ns(mesh, costs);
        if (std::ranges::binary_search(flattened, mesh.mesh)) {
            ++report.flattened_meshes;
            report.flattened_placements += mesh.placements;
            report.flattened_bytes += mesh.flattened_bytes();
            report.chosen_ns += flattened_ns(mesh, costs);
        } else {
            ++report.kept_meshes;
            report.kept_placements += mesh.placements;
            report.kept_bytes += mesh.bytes();
            report.chosen_ns += kept_ns(mesh, costs);
        }
    }
    return report;
}

Status check_flattened_memory(const std::string& name, std::span<const RepeatedMesh> repeated,
                              std::span<const MeshId> flattened) {
    std::uint64_t bytes = 0;
    for (const RepeatedMesh& mesh : repeated)
        if (std::ranges::binary_search(flattened, mesh.mesh))
            bytes +=
                mesh.placements * estimated_scene_bytes(mesh.triangles, mesh.vertices, mesh.bytes_per_vertex);
    return check_memory(name + ", its instances flattened,", bytes);
}

}  // namespace

std::vector<RepeatedMesh> repeated_meshes(const Scene& scene) {
    std::vector<RepeatedMesh> meshes(scene.meshes.size());
    for (const StaticInstance& instance : scene.static_instances)
        ++meshes[index_of(instance.mesh)].placements;
    std::vector<std::uint32_t> number_of, indices;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        if (meshes[i].placements == 0) continue;
        const SceneMesh& mesh = scene.meshes[i];
        indices.assign(mesh.indices.begin(), mesh.indices.end());
        meshes[i].mesh = MeshId{static_cast<std::uint32_t>(i)};
        meshes[i].triangles = mesh.indices.size() / 3;
        meshes[i].vertices = used_vertices(indices, number_of).size();
        meshes[i].bytes_per_vertex = bytes_per_vertex(scene.pools[mesh.pool]);
        meshes[i].two_sided = scene.materials[index_of(mesh.material)].two_sided;
    }
    std::erase_if(meshes, [](const RepeatedMesh& mesh) { return mesh.placements == 0; });
    return meshes;
}

Status settle_instances(Scene& scene, const InstanceOptions& options) {
    const std::vector<RepeatedMesh> repeated = repeated_meshes(scene);
    const std::uint64_t budget = budget_of(options);
    const std::vector<MeshId> flattened = chosen_by(options, repeated, budget);
    if (Status status = check_flattened_memory(scene.name, repeated, flattened); !status) return status;
    if (!flattened.empty()) {
        Flattening flattening(scene, flattened);
        if (Status status = flattening.measure(); !status) return status;
        flattening.run();
    }
    scene.instancing = report_of(repeated, flattened, options.costs);
    scene.instancing.budget_bytes = budget;
    return success();
}

}  // namespace rhview
