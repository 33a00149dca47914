// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstdint>

#include "rhview/scenes/camera_path.h"

namespace rhview::cli {

/// Ways to fly, as bits.
enum Movement : std::uint32_t {
    kForward = 1,
    kBack = 2,
    kLeft = 4,
    kRight = 8,
    kUp = 16,
    kDown = 32,
    kFast = 64,  ///< four times the speed
};

/// A camera that flies with the lens and the up vector of a path. What it sees is what a path with its key
/// shows, to the last bit: what was flown can be recorded and walked again.
class FlyCamera {
  public:
    /// Where `path` begins, as fast as it is on average. `path` is valid.
    explicit FlyCamera(const CameraPath& path);

    /// `target` differs from `eye`, and is not straight above or below it.
    void look_at(const glm::dvec3& eye, const glm::dvec3& target);
    /// To the right and up, in radians; it never tips over.
    void turn(double right, double up);
    /// `held` is a set of `Movement`.
    void move(std::uint32_t held, double seconds);

    [[nodiscard]] CameraKey key(double time_s) const;
    [[nodiscard]] View view(double aspect, ClipDepth clip_depth) const;
    /// The path's, without its keys.
    [[nodiscard]] CameraPath lens() const;
    [[nodiscard]] const glm::dvec3& eye() const { return eye_; }
    [[nodiscard]] glm::dvec3 direction() const;
    [[nodiscard]] const glm::dvec3& up() const { return up_; }

    double speed = 1.0;  ///< units of the scene per second

  private:
    CameraPath path_;  ///< with two keys, both of them this camera
    glm::dvec3 eye_{0.0};
    glm::dvec3 up_{0.0, 1.0, 0.0};
    glm::dvec3 north_{0.0, 0.0, -1.0};  ///< at right angles to `up_`
    glm::dvec3 east_{1.0, 0.0, 0.0};
    double heading_ = 0.0;  ///< from north to east
    double pitch_ = 0.0;
};

/// What a camera with this key sees.
View view_of_key(const CameraPath& lens, const CameraKey& key, double aspect, ClipDepth clip_depth);

}  // namespace rhview::cli
