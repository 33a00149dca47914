// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The triangles and the cameras of a property case.
#pragma once

#include <vector>

#include "property_case.h"
#include "ray_picture.h"
#include "rhview/base/triangle_batch.h"

namespace rhview {

/// Corners are not shared: triangle t has the indices 3·t to 3·t + 2.
struct PropertyScene {
    explicit PropertyScene(const PropertyCase& property);

    [[nodiscard]] std::vector<TriangleBatch> batches() const;
    [[nodiscard]] std::vector<SingleTriangle> triangles() const;

    std::vector<glm::vec3> positions;
    std::vector<std::vector<std::uint32_t>> indices;  ///< by batch

  private:
    void add(std::size_t batch, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double scale);
};

/// The third of each scene's batches is two-sided.
inline bool is_two_sided(std::size_t batch) {
    return batch == 2;
}

glm::dvec3 origin_of(const PropertyCase& property);
/// Cameras in the scene and around it; some stand on a vertex or look along a triangle's plane. All are
/// valid.
std::vector<View> views_of(const PropertyCase& property, const PropertyScene& scene);

}  // namespace rhview
