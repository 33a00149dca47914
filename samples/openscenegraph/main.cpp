// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

// One static scene of 8,000 entities, rendered by OpenSceneGraph in three ways, in turns: culled by its own
// cull traversal, merged and culled by rhview, and that with occlusion queries. It checks itself: the
// pictures are the same within a tolerance, and rhview needs a fifth of the draw calls at most.

#include <osg/Geode>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "district.h"
#include "picture.h"
#include "plan_drawable.h"

namespace {

constexpr int kFrames = 60, kWarmUp = 4;
/// Edges move by a pixel where a transform is rounded otherwise: merged vertices are transformed once, by the
/// CPU.
constexpr double kDifferentPixels = 0.002;
constexpr int kDifferentBy = 12;

/// A scene, and what drawing it took.
struct Way {
    const char* name;
    std::unique_ptr<DrawCounter> counter = std::make_unique<DrawCounter>();
    osg::ref_ptr<PlanDrawable> drawable{};  ///< null: OpenSceneGraph culls
    std::unique_ptr<Picture> picture{};
    double calls = 0.0, triangles = 0.0, queries = 0.0, worst = 0.0;
    std::vector<double> ms{}, ratios{};
};

/// A walk down a street that turns round slowly.
osg::Matrixd camera_from_world(int frame) {
    const double t = static_cast<double>(frame) / kFrames;
    const osg::Vec3d eye(0.0, 0.8 * kHalf * (1.2 * t - 1.0), 2.0 + 6.0 * t);
    const osg::Vec3d ahead(std::sin(1.2 * t), std::cos(1.2 * t), 0.0);
    return osg::Matrixd::lookAt(eye, eye + ahead, osg::Vec3d(0.0, 0.0, 1.0));
}

/// An index as the sample calibrate measured it on llvmpipe; a draw is a guess, and so is what asking costs.
constexpr rhview::DrawCosts kCosts{.index_ns = 13.0, .draw_ns = 6000.0};

rhview::OcclusionOptions occlusion_options() {
    rhview::OcclusionOptions options;
    options.costs.hardware = {.query_ns = 6000, .box_ns = 4000, .pixel_ns = 0.5, .draw_ns = 6000};
    // This drawable has no box pass.
    options.costs.box_pass = {.query_ns = std::numeric_limits<double>::infinity()};
    return options;
}

/// The entities of `district`, merged into one drawable. False: it could not be.
bool merge(Way& way, osg::Group& district, const std::optional<rhview::OcclusionOptions>& occlusion) {
    auto drawable = PlanDrawable::create(merge_by_material(district), kCosts, occlusion, *way.counter);
    if (!drawable) return std::puts(drawable.error().message.c_str()), false;
    way.drawable = *drawable;
    osg::ref_ptr<osg::Geode> scene = new osg::Geode;
    scene->addDrawable(way.drawable);
    set_common_state(*scene->getOrCreateStateSet());
    way.picture = std::make_unique<Picture>(*scene);
    return true;
}

double different_share(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.size(); i += 4)
        different += std::abs(a[i] - b[i]) > kDifferentBy || std::abs(a[i + 1] - b[i + 1]) > kDifferentBy ||
                     std::abs(a[i + 2] - b[i + 2]) > kDifferentBy;
    return static_cast<double>(different) / (Picture::kWidth * Picture::kHeight);
}

/// So that equal pictures are not equal because they are empty.
bool shows_something(const std::vector<unsigned char>& pixels) {
    std::size_t other = 0;
    for (std::size_t i = 4; i < pixels.size(); i += 4)
        other += !std::equal(&pixels[i], &pixels[i + 3], pixels.data());
    return other > pixels.size() / 40;
}

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

void render(Way& way, int frame) {
    *way.counter = {};
    const double ms = way.picture->render(camera_from_world(std::max(frame, 0)));
    if (frame < 0) return;
    way.ms.push_back(ms);
    way.calls += static_cast<double>(way.counter->calls) / kFrames;
    way.triangles += static_cast<double>(way.counter->triangles) / kFrames;
    if (way.drawable) way.queries += static_cast<double>(way.drawable->plan().queries.size()) / kFrames;
}

/// False: a frame shows nothing.
bool render_all(std::array<Way, 3>& ways) {
    bool something = true;
    for (int frame = -kWarmUp; frame < kFrames; ++frame) {
        for (std::size_t i = 0; i < ways.size(); ++i)
            render(ways[(static_cast<std::size_t>(frame + kWarmUp) + i) % ways.size()], frame);
        if (frame < 0) continue;
        const std::vector<unsigned char>& expected = ways[0].picture->pixels();
        something = something && shows_something(expected);
        for (Way& way : ways) {
            way.worst = std::max(way.worst, different_share(expected, way.picture->pixels()));
            way.ratios.push_back(way.ms.back() / ways[0].ms.back());
        }
    }
    return something;
}

/// False: something is not as it must be.
bool report(const std::array<Way, 3>& ways) {
    bool good = true;
    std::printf("%-24s %10s %10s %10s %10s %14s %12s\n", "culled by", "draw calls", "triangles", "queries",
                "median ms", "ratio to first", "differ");
    for (const Way& way : ways) {
        std::printf("%-24s %10.1f %10.0f %10.1f %10.2f %14.2f %10.3f %%\n", way.name, way.calls,
                    way.triangles, way.queries, median(way.ms), median(way.ratios), 100.0 * way.worst);
        good = good && way.worst <= kDifferentPixels;
        if (way.drawable) good = good && way.calls <= ways[0].calls / 5.0;
    }
    return good && ways[2].queries > 0.0;
}

}  // namespace

int main() {
    std::array<Way, 3> ways{Way{"OpenSceneGraph"}, Way{"rhview"}, Way{"rhview with queries"}};
    const osg::ref_ptr<osg::Group> district = make_district(*ways[0].counter);
    set_common_state(*district->getOrCreateStateSet());
    ways[0].picture = std::make_unique<Picture>(*district);
    if (!merge(ways[1], *district, std::nullopt) || !merge(ways[2], *district, occlusion_options())) return 1;
    for (const Way& way : ways)
        if (!way.picture->is_ready()) return std::puts("there is no graphics context: is DISPLAY set?"), 1;
    std::printf("%d entities, %zu triangles, %zu materials\n", kEntities, ways[1].drawable->triangle_count(),
                ways[1].drawable->batch_count());
    const bool something = render_all(ways);
    return report(ways) && something ? 0 : 1;
}
