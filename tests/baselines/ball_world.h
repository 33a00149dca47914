// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// Balls in a box that fly about, and which of them rays see first.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "rhview/baselines/grid_planner.h"
#include "uniform.h"

namespace rhview {

struct BallWorld {
    struct Ball {
        glm::dvec3 centre;
        double radius = 1.0;
        glm::dvec3 velocity;  ///< per frame; each component at most `step`
        double step = 0.0;
    };

    Aabb bounds;
    std::vector<Ball> balls;

    /// One in `moving_every` moves.
    BallWorld(unsigned seed, const glm::vec3& size, std::size_t count, double radius, double step,
              std::size_t moving_every) {
        Uniform uniform(seed);
        bounds = {glm::vec3(0.0f), size};
        for (std::size_t i = 0; i < count; ++i) {
            Ball ball;
            ball.radius = radius * uniform(0.5, 1.0);
            for (int a = 0; a < 3; ++a)
                ball.centre[a] = uniform(ball.radius, static_cast<double>(size[a]) - ball.radius);
            ball.step = i % moving_every == 0 ? step : 0.0;
            for (int a = 0; a < 3; ++a) ball.velocity[a] = ball.step * uniform(-0.9, 0.9);
            balls.push_back(ball);
        }
    }

    void move() {
        for (Ball& ball : balls)
            for (int a = 0; a < 3; ++a) {
                const double next = ball.centre[a] + ball.velocity[a];
                if (next < ball.radius || next > static_cast<double>(bounds.max[a]) - ball.radius)
                    ball.velocity[a] = -ball.velocity[a];
                else
                    ball.centre[a] = next;
            }
    }

    [[nodiscard]] static Aabb box_of(const Ball& ball) {
        return {glm::vec3(ball.centre - ball.radius), glm::vec3(ball.centre + ball.radius)};
    }
    [[nodiscard]] std::vector<Aabb> boxes() const {
        std::vector<Aabb> result;
        for (const Ball& ball : balls) result.push_back(box_of(ball));
        return result;
    }
    [[nodiscard]] std::vector<GridObject> objects() const {
        std::vector<GridObject> result;
        for (const Ball& ball : balls) {
            const auto radius = static_cast<float>(ball.radius);
            result.push_back({box_of(ball), static_cast<float>(ball.step), glm::vec3(0.0f), radius * 0.9999f,
                              radius * 1.0001f});
        }
        return result;
    }

    /// The ball that the ray meets first from outside, beyond `from`.
    [[nodiscard]] std::optional<std::size_t> first_hit(const glm::dvec3& eye, const glm::dvec3& direction,
                                                       double from) const {
        std::optional<std::size_t> first;
        double least = std::numeric_limits<double>::infinity();
        const double length = glm::length(direction);
        const glm::dvec3 d = direction / length;
        for (std::size_t i = 0; i < balls.size(); ++i) {
            const glm::dvec3 to = balls[i].centre - eye;
            const double along = glm::dot(to, d);
            const double beside2 = glm::dot(to, to) - along * along, r2 = balls[i].radius * balls[i].radius;
            if (beside2 >= r2) continue;
            const double at = along - std::sqrt(r2 - beside2);
            if (at > from && at < least) least = at, first = i;
        }
        return first;
    }
};

}  // namespace rhview
