// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "view_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace rhview::cli {
namespace {

/// Short of straight up, where a camera has no heading.
constexpr double kSteepest = 1.55;
constexpr double kFastFactor = 4.0;

double mean_speed(const CameraPath& path) {
    double length = 0.0;
    for (std::size_t i = 1; i < path.keys.size(); ++i)
        length += glm::distance(path.keys[i - 1].eye, path.keys[i].eye);
    const double speed = length / (path.keys.back().time_s - path.keys.front().time_s);
    return speed > 0.0 && std::isfinite(speed) ? speed : 1.0;
}

}  // namespace

FlyCamera::FlyCamera(const CameraPath& path)
    : speed(mean_speed(path)), path_(path), up_(glm::normalize(path.up)) {
    const glm::dvec3 other = std::abs(up_.z) < 0.9 ? glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(1.0, 0.0, 0.0);
    north_ = glm::normalize(other - up_ * glm::dot(other, up_));
    east_ = glm::cross(north_, up_);
    look_at(path.keys.front().eye, path.keys.front().target);
}

void FlyCamera::look_at(const glm::dvec3& eye, const glm::dvec3& target) {
    eye_ = eye;
    const glm::dvec3 direction = glm::normalize(target - eye);
    heading_ = std::atan2(glm::dot(direction, east_), glm::dot(direction, north_));
    pitch_ = std::clamp(std::asin(std::clamp(glm::dot(direction, up_), -1.0, 1.0)), -kSteepest, kSteepest);
}

void FlyCamera::turn(double right, double up) {
    heading_ = std::remainder(heading_ + right, 2.0 * 3.14159265358979323846);
    pitch_ = std::clamp(pitch_ + up, -kSteepest, kSteepest);
}

glm::dvec3 FlyCamera::direction() const {
    return std::cos(pitch_) * (std::cos(heading_) * north_ + std::sin(heading_) * east_) +
           std::sin(pitch_) * up_;
}

void FlyCamera::move(std::uint32_t held, double seconds) {
    const auto along = [&](Movement forth, Movement back) {
        return static_cast<double>((held & forth) != 0) - static_cast<double>((held & back) != 0);
    };
    const glm::dvec3 forward = direction();
    const glm::dvec3 way = along(kForward, kBack) * forward + along(kUp, kDown) * up_ +
                           along(kRight, kLeft) * glm::normalize(glm::cross(forward, up_));
    eye_ += (held & kFast ? kFastFactor : 1.0) * speed * seconds * way;
}

CameraKey FlyCamera::key(double time_s) const {
    // A unit beyond the eye would vanish far from the origin.
    const double reach = std::max(1.0, 1e-6 * glm::length(eye_));
    return {time_s, eye_, eye_ + reach * direction()};
}

CameraPath FlyCamera::lens() const {
    CameraPath lens = path_;
    lens.keys.clear();
    return lens;
}

View FlyCamera::view(double aspect, ClipDepth clip_depth) const {
    return view_of_key(path_, key(0.0), aspect, clip_depth);
}

View view_of_key(const CameraPath& lens, const CameraKey& key, double aspect, ClipDepth clip_depth) {
    CameraPath path = lens;
    path.keys.assign(2, key);
    return path.view_at(key.time_s, aspect, clip_depth);
}

}  // namespace rhview::cli
