// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "property_scene.h"

#include <glm/geometric.hpp>

#include "uniform.h"

namespace rhview {

PropertyScene::PropertyScene(const PropertyCase& property) : indices(property.batches) {
    Uniform uniform(property.seed);
    const auto batch = [&] { return static_cast<std::size_t>(uniform(0, property.batches)); };
    for (std::uint32_t i = 0; i < property.walls; ++i) {
        const glm::dvec3 centre = uniform.point(30.0), side = uniform.point(25.0), up = uniform.point(25.0);
        const std::size_t of = batch();
        // Both sides, so that it hides from both.
        for (const auto& [b, c] : {std::pair(side, up), std::pair(up, side)}) {
            add(of, centre - b - c, centre + b - c, centre + b + c, property.scale);
            add(of, centre - b - c, centre + b + c, centre - b + c, property.scale);
        }
    }
    for (std::uint32_t i = 0; i < property.triangles; ++i) {
        const glm::dvec3 centre = uniform.point(40.0);
        const double size = uniform.log(0.01, 10.0);
        add(batch(), centre, centre + uniform.point(size), centre + uniform.point(size), property.scale);
    }
    for (std::uint32_t i = 0; i < property.copies; ++i) {
        const auto from = 3 * static_cast<std::size_t>(uniform(0, static_cast<double>(positions.size() / 3)));
        const std::size_t of = batch();
        for (std::size_t corner = from; corner < from + 3; ++corner) {
            indices[of].push_back(static_cast<std::uint32_t>(positions.size()));
            positions.push_back(glm::vec3(positions[corner]));
        }
    }
    for (std::uint32_t i = 0; i < property.slivers; ++i) {
        const glm::dvec3 centre = uniform.point(40.0), along = uniform.point(30.0);
        add(batch(), centre, centre + along,
            centre + uniform(0, 1) * along + uniform.point(i % 2 == 0 ? 0.0 : 1e-5), property.scale);
    }
}

void PropertyScene::add(std::size_t batch, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                        double scale) {
    for (const glm::dvec3& corner : {a, b, c}) {
        indices[batch].push_back(static_cast<std::uint32_t>(positions.size()));
        positions.push_back(glm::vec3(scale * corner));
    }
}

std::vector<TriangleBatch> PropertyScene::batches() const {
    std::vector<TriangleBatch> result;
    for (std::uint32_t b = 0; b < indices.size(); ++b)
        result.push_back({MaterialId{b}, positions, indices[b], is_two_sided(b)});
    return result;
}

std::vector<SingleTriangle> PropertyScene::triangles() const {
    std::vector<SingleTriangle> result(positions.size() / 3);
    for (std::size_t i = 0; i < positions.size(); ++i)
        result[i / 3].corners[i % 3] = glm::dvec3(positions[i]);
    if (indices.size() > 2)
        for (const std::uint32_t index : indices[2]) result[index / 3].two_sided = true;
    return result;
}

glm::dvec3 origin_of(const PropertyCase& property) {
    return property.origin * property.scale * glm::dvec3(1.0, -1.0, 2.0);
}

std::vector<View> views_of(const PropertyCase& property, const PropertyScene& scene) {
    Uniform uniform(property.seed ^ 0x9e3779b9u);
    const glm::dvec3 origin = origin_of(property);
    std::vector<View> views;
    for (std::uint32_t i = 0; i < property.frames; ++i) {
        glm::dvec3 eye = property.scale * uniform.point(60.0),
                   forward = uniform.point(1.0) - 0.02 * eye / property.scale;
        const double kind = uniform(0, 1);
        const auto corner = static_cast<std::size_t>(uniform(0, static_cast<double>(scene.positions.size())));
        if (kind < 0.15) eye = glm::dvec3(scene.positions[corner]);
        if (kind > 0.9) {
            const std::size_t first = corner - corner % 3;
            forward = glm::dvec3(scene.positions[first + 1]) - glm::dvec3(scene.positions[first]);
            eye = glm::dvec3(scene.positions[first]) - 2.0 * forward;
        }
        const auto depth = static_cast<ClipDepth>(property.depth);
        const double near = property.scale * uniform.log(0.001, 1.0);
        double far = property.scale * uniform.log(20, 1000);
        if (property.orthographic == 0 && depth == ClipDepth::ReversedZeroToOne && kind < 0.5)
            far = RayPicture::kNothing;
        const double width = property.scale * uniform.log(1, 100);
        const View view{look_along(origin + eye, forward, {0, 1, 0}),
                        property.orthographic != 0 ? orthographic(width, width / 1.5, near, far, depth)
                                                   : perspective(property.fov, 1.5, near, far, depth),
                        depth};
        if (validate(view))
            for (std::uint32_t frame = 0; frame < property.stand; ++frame) views.push_back(view);
    }
    return views;
}

}  // namespace rhview
