// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The catalogue of hard cases: scenes and cameras at the limits of what rhview promises to show whole.
///
/// A case is a scene and a lens. Most scenes are a yard: boxes that hide, clutter in three materials, one of
/// them two-sided, and placed objects and instances, within 40 units of its middle.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "rhview/base/view.h"
#include "rhview/scenes/scene.h"
#include "uniform.h"

namespace rhview {

enum class Projection { Perspective, Orthographic, Oblique, Asymmetric };

/// Lengths in units of the yard.
struct Lens {
    Projection projection = Projection::Perspective;
    double fov_y = 1.0;  ///< radians
    double near = 0.05;
    double far = 300.0;  ///< may be infinite, of a perspective
};

/// Where a camera stands, relative to the scene's origin.
struct Stand {
    glm::dvec3 eye{0.0};
    glm::dvec3 forward{0.0, 0.0, -1.0};
};

struct HardScene {
    Scene scene;
    double unit = 1.0;          ///< of the yard, in the scene's
    glm::dvec3 middle{0.0};     ///< relative to the scene's origin
    std::vector<Stand> stands;  ///< empty: anywhere in the yard
};

/// How much is run: a sample, or all of it.
enum class Amount { Sample, Whole };

struct HardCase {
    std::string name;
    HardScene (*make)(Amount);
    Lens lens{};
    bool every_depth_format = false;  ///< 16 and 24 bits besides floating point
    bool is_large = false;            ///< few methods and views
    /// Cameras of their own instead of the lens; `validate` may refuse some, which are left out.
    std::vector<View> (*cameras)(const HardScene&, ClipDepth, Amount) = nullptr;
};

const std::vector<HardCase>& hard_cases();

/// So many cameras of a case, or all that it has of its own; all are valid.
std::vector<View> views_of(const HardCase& hard_case, const HardScene& scene, ClipDepth depth, Amount amount,
                           int count, Uniform& uniform);
/// A usual camera in the yard with each of its numbers in turn replaced by what no camera has.
std::vector<View> hostile_cameras(const HardScene& scene, ClipDepth depth, Amount amount);

}  // namespace rhview
