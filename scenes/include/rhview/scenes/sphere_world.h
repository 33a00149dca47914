// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Spheres of different sizes in a box, some of which fly about in it: what Batagelo 2002 (chapter 4)
/// measures visibility on. The named scene `spheres` is one with triangles. Metres and seconds.
///
/// Bit-identical on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "rhview/base/aabb.h"

namespace rhview {

/// Its size, and what is in it.
struct SphereWorldOptions {
    glm::dvec3 size{100.0, 60.0, 100.0};  ///< of the box, which begins at 0
    std::size_t spheres = 5000;
    std::size_t moving = 200;  ///< the first ones
    double least_radius = 1.0;
    double greatest_radius = 3.5;  ///< less than half of any side
    double top_speed = 2.0;        ///< along each axis
    bool clears_way = true;        ///< no sphere touches `SphereWorld::way` at time 0
    std::uint64_t seed = 1;
};

/// Balls that stand and move, known exactly: their movement is a formula.
struct SphereWorld {
    /// One of them; a moving one goes straight and turns back at the faces of the box.
    struct Sphere {
        glm::dvec3 centre{0.0};  ///< at time 0
        double radius = 1.0;
        glm::dvec3 velocity{0.0};  ///< at time 0; each sphere turns back at the faces of the box
    };

    glm::dvec3 size{0.0};
    std::vector<Sphere> spheres;

    /// Where one of its spheres is.
    [[nodiscard]] glm::dvec3 centre_at(const Sphere& sphere, double time_s) const;
    /// Of all spheres, by number.
    [[nodiscard]] std::vector<Aabb> boxes_at(double time_s) const;
    /// A round through the middle of the box; `turn` 0 to 1. For an eye that the spheres leave free.
    [[nodiscard]] glm::dvec3 way(double turn) const;
};

/// The same for the same options, on every machine.
SphereWorld make_sphere_world(const SphereWorldOptions& options);

}  // namespace rhview
