// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/scenes/camera_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "rhview/base/assert.h"

namespace rhview {
namespace {

/// A camera must look at least this far off its up vector (the sine of the angle).
constexpr double kOffUp = 1e-6;
/// Below this sine a turn has no axis of its own.
constexpr double kNoTurn = 1e-9;

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Unit vector of `v`, without overflow or underflow on the way; not finite if `v` is zero.
glm::dvec3 unit(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return glm::normalize(v / largest);
}

glm::dvec3 direction_of(const CameraKey& key) {
    return unit(key.target - key.eye);
}

/// Unit axis about which `from` turns into `to` the short way; opposite directions turn about `up`, as far as
/// it is at right angles to them, so that the camera pans and does not tip over.
glm::dvec3 turn_axis(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& up) {
    const glm::dvec3 axis = glm::cross(from, to);
    if (glm::length(axis) > kNoTurn) return glm::normalize(axis);
    return glm::normalize(up - from * glm::dot(from, up));
}

double angle_between(const glm::dvec3& from, const glm::dvec3& to) {
    return std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to));
}

/// The direction `t` of the way along the great circle from `from` to `to`.
glm::dvec3 turned(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& up, double t) {
    const glm::dvec3 axis = turn_axis(from, to, up);
    const double angle = t * angle_between(from, to);
    return std::cos(angle) * from + std::sin(angle) * glm::cross(axis, from);
}

View view_along(const CameraPath& path, const glm::dvec3& eye, const glm::dvec3& direction, double aspect,
                ClipDepth clip_depth) {
    const double fov_y = path.fov_y_deg * (std::numbers::pi / 180.0);
    return {look_along(eye, direction, unit(path.up)),
            perspective(fov_y, aspect, path.near_m, path.far_m, clip_depth), clip_depth};
}

/// Whether the turn from `from` to `to` passes `pole` (unit, not near either end).
bool passes(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& up, const glm::dvec3& pole) {
    const glm::dvec3 axis = turn_axis(from, to, up);
    const glm::dvec3 in_plane = pole - axis * glm::dot(axis, pole);
    if (std::abs(glm::dot(axis, pole)) > kOffUp) return false;
    const double to_pole = std::atan2(glm::dot(axis, glm::cross(from, in_plane)), glm::dot(from, in_plane));
    return to_pole >= 0.0 && to_pole <= angle_between(from, to);
}

Status validate_lens(const CameraPath& path) {
    if (!(path.fov_y_deg > 0.0 && path.fov_y_deg < 180.0)) {
        return Error{
            fmt::format("camera path: fov_y_deg is {}; it must be above 0 and below 180", path.fov_y_deg)};
    }
    if (!(path.near_m > 0.0) || std::isinf(path.near_m)) {
        return Error{
            fmt::format("camera path: near is {}; it must be a finite distance above 0", path.near_m)};
    }
    if (!(path.far_m > path.near_m)) {
        return Error{fmt::format("camera path: far is {}; it must be beyond near, which is {}", path.far_m,
                                 path.near_m)};
    }
    if (!is_finite(path.up) || !is_finite(unit(path.up))) {
        return Error{"camera path: up must be three finite numbers that are not all 0, such as [0, 1, 0]"};
    }
    return success();
}

Status validate_key(const CameraPath& path, std::size_t index) {
    const CameraKey& key = path.keys[index];
    const auto refuse = [&](std::string_view what) {
        return Error{fmt::format("camera path: key {} {}", index, what)};
    };
    if (!std::isfinite(key.time_s) || !is_finite(key.eye) || !is_finite(key.target))
        return refuse("holds a number that is not finite; write finite ones");
    if (index > 0 && !(key.time_s > path.keys[index - 1].time_s)) {
        return refuse(
            fmt::format("has time {}, which is not after the key before it ({}); times must increase",
                        key.time_s, path.keys[index - 1].time_s));
    }
    if (index > 0 && !std::isfinite(key.time_s - path.keys[0].time_s))
        return refuse("has a time too far from the first; use smaller times");
    if (key.eye == key.target) return refuse("has its eye at its target; move the target to where it looks");
    const glm::dvec3 direction = direction_of(key);
    if (!is_finite(direction)) return refuse("has its target too far away or too close; move it");
    if (glm::length(glm::cross(direction, unit(path.up))) < kOffUp)
        return refuse("looks along the up vector; tilt it, or choose another up");
    const Status status = validate(view_along(path, key.eye, direction, 1.0, ClipDepth::NegativeOneToOne));
    if (!status) return refuse("makes no camera: " + status.error().message);
    return success();
}

/// Between valid keys a camera can still tip over the pole.
Status validate_turn(const CameraPath& path, std::size_t index) {
    const glm::dvec3 from = direction_of(path.keys[index]), to = direction_of(path.keys[index + 1]);
    const glm::dvec3 up = unit(path.up);
    if (!passes(from, to, up, up) && !passes(from, to, up, -up)) return success();
    return Error{
        fmt::format("camera path: between keys {} and {} the camera turns through the up vector; add a key "
                    "between them that turns it sideways",
                    index, index + 1)};
}

}  // namespace

View CameraPath::view_at(double time_s, double aspect, ClipDepth clip_depth) const {
    RHVIEW_ASSERT(keys.size() >= 2);
    const auto view_of = [&](const CameraKey& key) {
        return view_along(*this, key.eye, direction_of(key), aspect, clip_depth);
    };
    if (!(time_s > keys.front().time_s)) return view_of(keys.front());
    if (time_s >= keys.back().time_s) return view_of(keys.back());
    const auto next = std::upper_bound(keys.begin(), keys.end(), time_s,
                                       [](double time, const CameraKey& key) { return time < key.time_s; });
    const CameraKey& a = *(next - 1);
    const CameraKey& b = *next;
    const double t = (time_s - a.time_s) / (b.time_s - a.time_s);
    return view_along(*this, (1.0 - t) * a.eye + t * b.eye,
                      turned(direction_of(a), direction_of(b), unit(up), t), aspect, clip_depth);
}

double CameraPath::time_of_frame(int frame, int frames) const {
    RHVIEW_ASSERT(frame >= 0 && frame < frames);
    const double first = keys.front().time_s, last = keys.back().time_s;
    if (frame == 0 || frame == frames - 1) return frame == 0 ? first : last;
    // The product first: times that are exact, such as whole 64ths of a second, stay exact.
    return first + static_cast<double>(frame) * (last - first) / (frames - 1);
}

View CameraPath::view_of_frame(int frame, int frames, double aspect, ClipDepth clip_depth) const {
    return view_at(time_of_frame(frame, frames), aspect, clip_depth);
}

Status validate(const CameraPath& path) {
    if (const Status status = validate_lens(path); !status) return status;
    if (path.keys.size() < 2) {
        return Error{fmt::format("camera path: {} keys; at least two are needed, add where it goes",
                                 path.keys.size())};
    }
    for (std::size_t i = 0; i < path.keys.size(); ++i)
        if (const Status status = validate_key(path, i); !status) return status;
    for (std::size_t i = 0; i + 1 < path.keys.size(); ++i)
        if (const Status status = validate_turn(path, i); !status) return status;
    return success();
}

CameraPath walkthrough_of_bounds(const Aabb& bounds, const glm::dvec3& origin) {
    const glm::dvec3 low(bounds.min), high(bounds.max);
    const glm::dvec3 middle = 0.5 * low + 0.5 * high;
    // A scene thin in some direction, or a point, still gets room to walk, in steps that float positions can
    // tell apart.
    const double coordinate = glm::length(glm::max(glm::abs(low), glm::abs(high)));
    const double size =
        std::max({glm::length(high - low), 1e-3, 1e-4 * coordinate, 1e-9 * glm::length(origin)});
    const double x = std::max(0.5 * (high.x - low.x), 0.05 * size);
    const double z = std::max(0.5 * (high.z - low.z), 0.05 * size);
    const double rise = std::max(high.y - low.y, 0.05 * size);
    const glm::dvec3 ground = origin + glm::dvec3(middle.x, low.y, middle.z);

    CameraPath path;
    path.far_m = 2.5 * size;
    path.near_m = 1e-5 * path.far_m;
    const auto add = [&](double seconds, const glm::dvec3& eye, const glm::dvec3& target) {
        const double time = path.keys.empty() ? 0.0 : path.keys.back().time_s + seconds;
        const glm::dvec3 scale(x, rise, z);
        path.keys.push_back({time, ground + scale * eye, ground + scale * target});
    };
    // In units of half the width, the height and half the depth: through the middle the long way,
    const bool along_x = x >= z;
    const auto swing = [&](double along, double up, double across) {
        return along_x ? glm::dvec3(along, up, across) : glm::dvec3(across, up, along);
    };
    constexpr double kLevel = 0.1;
    add(0, swing(-0.9, kLevel, 0.0), swing(0.0, kLevel, 0.0));
    add(10, swing(0.0, kLevel, 0.0), swing(0.9, kLevel, 0.0));
    add(4, swing(0.0, kLevel, 0.0), swing(0.3, kLevel, 0.9));
    add(4, swing(0.0, kLevel, 0.0), swing(0.9, kLevel, 0.0));
    add(8, swing(0.8, kLevel, 0.0), swing(1.2, kLevel, 0.6));
    // around inside the walls,
    add(4, swing(0.8, kLevel, 0.7), swing(0.0, kLevel, 0.8));
    add(12, swing(-0.8, kLevel, 0.7), swing(-1.2, kLevel, 0.2));
    add(8, swing(-0.8, kLevel, -0.7), swing(0.0, kLevel, -0.8));
    // and out and up for an overview from two corners.
    add(10, swing(0.8, 0.6, -1.1), swing(0.0, 0.3, 0.0));
    const auto overview = [&](double side_x, double side_z) {
        const glm::dvec3 target = ground + glm::dvec3(0.0, 0.4 * rise, 0.0);
        path.keys.push_back(
            {path.keys.back().time_s + 8.0, target + size * glm::dvec3(side_x, 0.45, side_z), target});
    };
    overview(0.5, along_x ? -0.5 : 0.5);
    overview(-0.5, along_x ? -0.6 : 0.6);
    return path;
}

}  // namespace rhview
