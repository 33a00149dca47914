// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Whether a box and a frustum have no point in common, exactly but for the number type's rounding: the
/// oracle that the fast tests are measured by.
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace rhview {

/// A frustum with parallel near and far planes, as its corners: bit 0, 1, 2 of the index choose right, top,
/// far.
template <class Number>
using FrustumHull = std::array<glm::vec<3, Number>, 8>;

/// A box centre ± Σ half_sizes[i] · axes[i]; the axes are at right angles and not zero.
template <class Number>
struct HullBox {
    glm::vec<3, Number> centre{0};
    std::array<glm::vec<3, Number>, 3> axes{};
    glm::vec<3, Number> half_sizes{0};
};

namespace detail {

/// Whether the box and the hull are apart when looked at along `axis`.
template <class Number>
bool separates(const glm::vec<3, Number>& axis, const FrustumHull<Number>& hull, const HullBox<Number>& box) {
    Number low = glm::dot(axis, hull[0] - box.centre), high = low;
    for (int i = 1; i < 8; ++i) {
        const Number value = glm::dot(axis, hull[i] - box.centre);
        low = value < low ? value : low;
        high = value > high ? value : high;
    }
    Number radius = 0;
    for (int i = 0; i < 3; ++i) radius += box.half_sizes[i] * glm::abs(glm::dot(axis, box.axes[i]));
    return low > radius || high < -radius;
}

}  // namespace detail

/// True: the two, relative to the same point, have no point in common.
/// Cost: 26 axes at most, eleven dot products each. Source: Gottschalk, Lin & Manocha, "OBBTree", 1996.
template <class Number>
bool are_separated(const FrustumHull<Number>& hull, const HullBox<Number>& box) {
    using Vec = glm::vec<3, Number>;
    const Vec right = hull[1] - hull[0], up = hull[2] - hull[0];
    const Vec left_bottom = hull[4] - hull[0], right_bottom = hull[5] - hull[1], left_top = hull[6] - hull[2],
              right_top = hull[7] - hull[3];
    for (const Vec& normal :
         {glm::cross(right, up), glm::cross(up, left_bottom), glm::cross(up, right_bottom),
          glm::cross(right, left_bottom), glm::cross(right, left_top)})
        if (detail::separates(normal, hull, box)) return true;
    for (const Vec& axis : box.axes)
        if (detail::separates(axis, hull, box)) return true;
    for (const Vec& edge : {right, up, left_bottom, right_bottom, left_top, right_top})
        for (const Vec& axis : box.axes)
            if (detail::separates(glm::cross(edge, axis), hull, box)) return true;
    return false;
}

}  // namespace rhview
