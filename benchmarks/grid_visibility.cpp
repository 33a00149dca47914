// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The regular grid with temporal bounding volumes on balls in a box, after Batagelo 2002, chapter 4: hidden
/// objects (his figure 4.3), a walk (4.5), an empty scene by field of view (4.6), resolutions (4.7, 4.8).
///
/// usage: rhview_grid_visibility [--quick] [hidden|walk|traversal|resolution …]; CSV on standard output, all
/// without; --quick: few frames and objects, only to see that it runs.
/// The world is that of the named scene `spheres`. Times are of planning alone: no picture is drawn. The
/// exact set is that of a picture of 1280 × 720 points, found ball by ball. `pvs` is what the method would
/// draw, `in_view` what frustum culling would.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "../tests/baselines/sphere_objects.h"
#include "rhview/baselines/grid_planner.h"

namespace {

using namespace rhview;

constexpr int kWidth = 1280, kHeight = 720;
constexpr double kNear = 0.1, kFar = 1000.0, kFrameSeconds = 1.0 / 30.0;

/// A world and the time in it.
class Flight {
  public:
    explicit Flight(const SphereWorldOptions& options)
        : world_(make_sphere_world(options)), top_speed_(options.top_speed), boxes_(world_.boxes_at(0.0)) {}

    void set_frame(int frame) {
        time_s_ = frame * kFrameSeconds;
        boxes_ = world_.boxes_at(time_s_);
    }
    [[nodiscard]] const SphereWorld& world() const { return world_; }
    [[nodiscard]] std::span<const Aabb> boxes() const { return boxes_; }
    [[nodiscard]] glm::dvec3 centre(std::size_t i) const {
        return world_.centre_at(world_.spheres[i], time_s_);
    }
    [[nodiscard]] std::vector<GridObject> objects() const {
        return grid_objects(world_, top_speed_, kFrameSeconds);
    }

  private:
    SphereWorld world_;
    double top_speed_;
    double time_s_ = 0.0;
    std::vector<Aabb> boxes_;
};

SphereWorldOptions still_world() {
    SphereWorldOptions options;
    options.spheres = 4800;
    options.moving = 0;
    return options;
}

GridOptions grid_of(const glm::ivec3& cells) {
    GridOptions options;
    options.cells = cells;
    options.bounds = {glm::vec3(0.0f), glm::vec3(SphereWorldOptions{}.size)};
    options.nothing_leaves = true;
    return options;
}

FrameInput seen(const glm::dvec3& eye, const glm::dvec3& forward, double fov_y_deg,
                std::span<const Aabb> boxes) {
    return {{look_along(eye, forward, {0, 1, 0}),
             perspective(glm::radians(fov_y_deg), static_cast<double>(kWidth) / kHeight, kNear, kFar,
                         ClipDepth::NegativeOneToOne),
             ClipDepth::NegativeOneToOne},
            glm::dvec3(0.0),
            boxes,
            {kWidth, kHeight}};
}

/// Which spheres show in a picture, drawn with a depth for every point.
class ExactSet {
  public:
    std::size_t count(const Flight& flight, const View& view) {
        depth_.assign(kWidth * kHeight, 1e30);
        owner_.assign(kWidth * kHeight, -1);
        const glm::dmat4 inverse = glm::inverse(view.clip_from_eye_relative());
        const auto ray = [&](double x, double y) {
            const glm::dvec4 p = inverse * glm::dvec4(x, y, -1.0, 1.0);
            return glm::dvec3(p) / p.w;
        };
        const glm::dvec3 corner = ray(-1.0, -1.0), across = (ray(1.0, -1.0) - corner) / double(kWidth),
                         up = (ray(-1.0, 1.0) - corner) / double(kHeight);
        const std::vector<SphereWorld::Sphere>& spheres = flight.world().spheres;
        for (std::size_t i = 0; i < spheres.size(); ++i)
            draw({flight.centre(i), spheres[i].radius}, static_cast<int>(i), view, corner, across, up);
        seen_.assign(spheres.size(), false);
        for (const int owner : owner_)
            if (owner >= 0) seen_[static_cast<std::size_t>(owner)] = true;
        return static_cast<std::size_t>(std::count(seen_.begin(), seen_.end(), true));
    }
    /// Spheres that show and that `plan` lacks.
    [[nodiscard]] std::size_t missing(const FramePlan& plan) const {
        std::vector<bool> drawn(seen_.size(), false);
        for (const ObjectId object : plan.objects) drawn[index_of(object)] = true;
        std::size_t missing = 0;
        for (std::size_t i = 0; i < drawn.size(); ++i) missing += seen_[i] && !drawn[i] ? 1 : 0;
        return missing;
    }

  private:
    struct Ball {
        glm::dvec3 centre{0.0};
        double radius = 1.0;
    };

    void draw(const Ball& ball, int number, const View& view, const glm::dvec3& corner,
              const glm::dvec3& across, const glm::dvec3& up) {
        const glm::dvec3 to = ball.centre - view.eye();
        const double reach2 = glm::dot(to, to) - ball.radius * ball.radius;
        if (reach2 <= 0.0) return;
        const double depth = (view.clip_from_eye_relative() * glm::dvec4(to, 1.0)).w;
        if (depth + ball.radius < kNear) return;
        // A box of points around the ball: its corners, where they are all before the eye.
        int x0 = 0, x1 = kWidth - 1, y0 = 0, y1 = kHeight - 1;
        bound(to, ball.radius, view, x0, x1, y0, y1);
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                const glm::dvec3 ray = corner + (x + 0.5) * across + (y + 0.5) * up;
                const double length2 = glm::dot(ray, ray), along = glm::dot(ray, to);
                const double discriminant = along * along - length2 * reach2;
                if (along <= 0.0 || discriminant < 0.0) continue;
                const double at = (along - std::sqrt(discriminant)) / length2;
                const std::size_t point = static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
                if (at < 1.0 || at >= depth_[point]) continue;
                depth_[point] = at;
                owner_[point] = number;
            }
    }

    static void bound(const glm::dvec3& to, double radius, const View& view, int& x0, int& x1, int& y0,
                      int& y1) {
        double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9;
        const glm::dmat4 clip = view.clip_from_eye_relative();
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 corner(to.x + ((i & 1) != 0 ? radius : -radius),
                                    to.y + ((i & 2) != 0 ? radius : -radius),
                                    to.z + ((i & 4) != 0 ? radius : -radius));
            const glm::dvec4 p = clip * glm::dvec4(corner, 1.0);
            if (p.w <= kNear) return;
            low_x = std::min(low_x, p.x / p.w), high_x = std::max(high_x, p.x / p.w);
            low_y = std::min(low_y, p.y / p.w), high_y = std::max(high_y, p.y / p.w);
        }
        x0 = std::max(0, static_cast<int>((low_x + 1.0) * 0.5 * kWidth) - 1);
        x1 = std::min(kWidth - 1, static_cast<int>((high_x + 1.0) * 0.5 * kWidth) + 1);
        y0 = std::max(0, static_cast<int>((low_y + 1.0) * 0.5 * kHeight) - 1);
        y1 = std::min(kHeight - 1, static_cast<int>((high_y + 1.0) * 0.5 * kHeight) + 1);
    }

    std::vector<double> depth_;
    std::vector<int> owner_;
    std::vector<bool> seen_;
};

double plan_ms(GridPlanner& planner, const FrameInput& input, FramePlan& plan) {
    const auto start = std::chrono::steady_clock::now();
    planner.plan(input, plan);
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

double greatest(const std::vector<double>& values) {
    return *std::max_element(values.begin(), values.end());
}

void print_row(const char* test, const glm::ivec3& cells, double x, const std::vector<double>& ms, double pvs,
               double exact, double in_view, double reached, double volumes, std::size_t missing) {
    std::printf("%s,%dx%dx%d,%g,%.4f,%.4f,%.4f,%.1f,%.1f,%.1f,%.0f,%.0f,%zu\n", test, cells.x, cells.y,
                cells.z, x, mean(ms), median(ms), greatest(ms), pvs, exact, in_view, reached, volumes,
                missing);
    std::fflush(stdout);
}

struct Length {
    std::size_t most_hidden = 20000;
    int hidden_frames = 900;  ///< the last third counts
    int walk_frames = 150;
    int finest = 150;  ///< cells along each side
};

std::size_t count_in_view(const FrameInput& input) {
    std::vector<ObjectId> all;
    append_visible_objects(make_frustum(input.culling_view), input.object_boxes, all);
    return all.size();
}

/// Figure 4.3: hidden moving objects, all outside of the view; the observer looks out of the box.
void run_hidden(const glm::ivec3& cells, const Length& length) {
    for (const std::size_t count : {0u, 500u, 1000u, 2000u, 5000u, 10000u, 20000u}) {
        if (count > length.most_hidden) break;
        SphereWorldOptions options;
        options.spheres = options.moving = count;
        options.greatest_radius = 1.5;
        options.seed = 3;
        Flight flight(options);
        GridPlanner planner({}, {}, {}, flight.objects(), grid_of(cells));
        FramePlan plan;
        std::vector<double> ms;
        double volumes = 0.0;
        for (int frame = 0; frame < length.hidden_frames; ++frame) {
            flight.set_frame(frame);
            const double t = plan_ms(planner, seen({-1, 30, 50}, {-1, 0, 0}, 55.0, flight.boxes()), plan);
            if (3 * frame >= 2 * length.hidden_frames) ms.push_back(t);
            volumes += static_cast<double>(planner.statistics().volumes) / length.hidden_frames;
        }
        print_row("hidden", cells, static_cast<double>(count), ms, static_cast<double>(plan.objects.size()),
                  0.0, 0.0, 0.0, volumes, 0);
    }
}

/// Figures 4.4 and 4.5: 150 frames through 4,800 resting and 200 moving balls; a row for every fifth.
void run_walk(const glm::ivec3& cells, const Length& length) {
    Flight flight({});
    GridPlanner planner({}, {}, {}, flight.objects(), grid_of(cells));
    FramePlan plan;
    ExactSet exact;
    for (int frame = 0; frame < length.walk_frames; ++frame) {
        flight.set_frame(frame);
        const double turn = frame / 150.0;
        const glm::dvec3 eye = flight.world().way(turn);
        const FrameInput input = seen(eye, flight.world().way(turn + 0.06) - eye, 55.0, flight.boxes());
        const std::vector<double> ms{plan_ms(planner, input, plan)};
        if (frame % 5 != 0) continue;
        const std::size_t visible = exact.count(flight, input.culling_view);
        print_row("walk", cells, frame, ms, static_cast<double>(plan.objects.size()),
                  static_cast<double>(visible), static_cast<double>(count_in_view(input)),
                  static_cast<double>(planner.statistics().cells_reached),
                  static_cast<double>(planner.statistics().volumes), exact.missing(plan));
    }
}

/// Figure 4.6: an empty box, from its middle, by field of view.
void run_traversal(const glm::ivec3& cells) {
    GridPlanner planner({}, {}, {}, {}, grid_of(cells));
    FramePlan plan;
    for (const double fov : {10.0, 20.0, 40.0, 60.0, 80.0, 100.0, 120.0, 140.0, 160.0, 175.0}) {
        std::vector<double> ms;
        for (int i = 0; i < 11; ++i)
            ms.push_back(plan_ms(planner, seen({50.3, 30.2, 0.4}, {0, 0, 1}, fov, {}), plan));
        print_row("traversal", cells, fov, ms, 0.0, 0.0, 0.0,
                  static_cast<double>(planner.statistics().cells_reached), 0.0, 0);
    }
}

/// Figures 4.7 and 4.8: 4,800 resting balls, one place to stand, resolution N × N × N.
void run_resolution(const Length& length) {
    const Flight flight(still_world());
    const glm::dvec3 eye = flight.world().way(0.0);
    const FrameInput input = seen(eye, 0.5 * flight.world().size - eye, 55.0, flight.boxes());
    ExactSet exact;
    const std::size_t visible = exact.count(flight, input.culling_view);
    for (int n = 10; n <= length.finest; n += 10) {
        GridPlanner planner({}, {}, {}, flight.objects(), grid_of(glm::ivec3(n)));
        FramePlan plan;
        std::vector<double> ms;
        for (int i = 0; i < 11; ++i) ms.push_back(plan_ms(planner, input, plan));
        print_row("resolution", glm::ivec3(n), n, ms, static_cast<double>(plan.objects.size()),
                  static_cast<double>(visible), static_cast<double>(count_in_view(input)),
                  static_cast<double>(planner.statistics().cells_reached), 0.0, exact.missing(plan));
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> names(argv + 1, argv + argc);
    const bool quick = std::erase(names, "--quick") > 0;
    const Length length = quick ? Length{500, 30, 11, 30} : Length{};
    const auto wanted = [&](const char* name) {
        return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
    };
    std::printf(
        "test,cells,x,plan_ms_mean,plan_ms_median,plan_ms_max,pvs,exact,in_view,cells_reached,volumes,"
        "missing\n");
    for (const glm::ivec3& cells : {glm::ivec3(50, 30, 50), glm::ivec3(100, 60, 100)}) {
        if (wanted("hidden")) run_hidden(cells, length);
        if (wanted("walk")) run_walk(cells, length);
        if (wanted("traversal")) run_traversal(cells);
    }
    if (wanted("resolution")) run_resolution(length);
    return 0;
}
