// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// What most scenes of the catalogue are made of. Random by a seed of its own; all of it is placed through
/// one map.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <vector>

#include "hard_case.h"
#include "rhview/scenes/scene_builder.h"

namespace rhview {

class Yard {
  public:
    explicit Yard(double unit = 1.0, const glm::dvec3& origin = glm::dvec3(0.0),
                  const glm::dvec3& middle = glm::dvec3(0.0));

    /// All that is added from now on goes through `map` first.
    void set_map(const glm::dmat3& map) { map_ = glm::dmat4(map); }

    /// Closed, seen from outside; `inside_out`: from inside.
    void add_box(const glm::dvec3& centre, const glm::dvec3& half, std::size_t material,
                 bool inside_out = false);
    void add_boxes(int count, double largest = 8.0);
    void add_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, std::size_t material);
    void add_clutter(int count, double smallest = 0.05, double largest = 4.0);
    /// Dynamic objects and instances, as many of each; instances only where a map can be drawn through.
    void add_objects(int count);
    /// Dynamic objects through a linear map of their own.
    void add_object(const glm::dvec3& centre, const glm::dmat3& map);
    /// What every yard has.
    void add_usual();

    Uniform& uniform() { return uniform_; }
    [[nodiscard]] glm::dmat4 world_from_yard() const;
    SceneBuilder& builder() { return builder_; }
    [[nodiscard]] MaterialId material(std::size_t i) const { return materials_[i % 3]; }
    HardScene finish();

  private:
    [[nodiscard]] std::size_t any_material() { return static_cast<std::size_t>(uniform_(0, 3)); }

    Uniform uniform_{2026};
    double unit_;
    glm::dvec3 origin_, middle_;
    SceneBuilder builder_;
    std::array<MaterialId, 3> materials_{};  ///< the last is two-sided
    std::array<MeshId, 3> meshes_{};
    glm::dmat4 map_{1.0};
};

}  // namespace rhview
