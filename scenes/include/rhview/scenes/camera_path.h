// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Camera key frames over time, read from JSON (`rhview.path/1`) or made from a scene's bounds.
///
/// ```json
/// {"schema": "rhview.path/1", "fov_y_deg": 60, "near": 0.1, "far": 1000, "up": [0, 1, 0],
///  "keys": [{"time": 0, "eye": [0, 2, 0], "target": [0, 2, -1]},
///           {"time": 5, "eye": [9, 2, 0], "target": [9, 2, -1]}]}
/// ```
///
/// `schema` and `keys` are required, the other fields have the defaults of `CameraPath`.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "rhview/base/aabb.h"
#include "rhview/base/result.h"
#include "rhview/base/view.h"

namespace rhview {

struct Scene;

/// Where the camera is at a time, and where it looks.
struct CameraKey {
    double time_s = 0.0;
    glm::dvec3 eye{0.0};     ///< world space
    glm::dvec3 target{0.0};  ///< a point the camera looks at
};

/// At least two keys, times strictly increasing, every camera finite and non-singular: `validate` says so.
struct CameraPath {
    double fov_y_deg = 60.0;
    double near_m = 0.1;
    double far_m = 1000.0;  ///< may be infinite (JSON: the string "infinity")
    glm::dvec3 up{0.0, 1.0, 0.0};
    std::vector<CameraKey> keys;

    /// The view at `time_s`, clamped to the keys' span. The eye moves linearly between keys (so it never
    /// leaves a corridor that its keys keep to), the viewing direction turns along the great circle.
    [[nodiscard]] View view_at(double time_s, double aspect, ClipDepth clip_depth) const;

    /// When frame `frame` of `frames` is, evenly spaced from the first key to the last. A path with a key
    /// every 64th of a second and as many frames as keys gives the keys' own times, and so their own cameras,
    /// to the last bit: what was flown is walked again.
    [[nodiscard]] double time_of_frame(int frame, int frames) const;
    /// The view at that time.
    [[nodiscard]] View view_of_frame(int frame, int frames, double aspect, ClipDepth clip_depth) const;
};

/// An error names the key and the mend.
Status validate(const CameraPath& path);

/// Parses the text of a path file; `source_name` is what errors call it.
Result<CameraPath> parse_camera_path(std::string_view json, const std::string& source_name);
/// Reads and parses a file; errors name it.
Result<CameraPath> load_camera_path(const std::filesystem::path& file);
/// The text of a path file; parsing it gives the same path to the last bit. `path` is valid.
std::string to_json(const CameraPath& path);

/// A deterministic walkthrough of a scene that brings none: at eye level through the middle of its bounds and
/// around, then a climb to an overview. Depends on the bounds alone. `bounds` is not empty; it is relative to
/// `origin`.
CameraPath walkthrough_of_bounds(const Aabb& bounds, const glm::dvec3& origin);

/// The same walk, lifted to eye level above the scene's ground (its lowest static vertices nearby): on
/// terrain the bounds alone would lead under the hills. Cost: one pass over the static indices.
CameraPath walkthrough_of_scene(const Scene& scene);

}  // namespace rhview
