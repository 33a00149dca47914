// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "yard.h"

#include <glm/gtc/matrix_transform.hpp>

namespace rhview {
namespace {

// Corner c of a box is high on axis a if bit a of c is set; counter-clockwise from outside.
constexpr std::array<std::uint32_t, 36> kBoxIndices{0, 3, 1, 0, 2, 3, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                                    2, 7, 3, 2, 6, 7, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

std::vector<glm::vec3> box_corners(const glm::dvec3& centre, const glm::dvec3& half) {
    std::vector<glm::vec3> corners;
    for (int c = 0; c < 8; ++c)
        corners.emplace_back(centre + half * glm::dvec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1));
    return corners;
}

}  // namespace

Yard::Yard(double unit, const glm::dvec3& origin, const glm::dvec3& middle)
    : unit_(unit), origin_(origin), middle_(middle), builder_(origin) {
    for (std::size_t i = 0; i < materials_.size(); ++i)
        materials_[i] = builder_.add_material({"", glm::vec3(0.8f), i == 2, false});
    const std::vector<glm::vec3> box = box_corners(glm::dvec3(0.0), glm::dvec3(1.0));
    std::vector<glm::vec3> clump;
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 90; ++i) {
        clump.emplace_back(uniform_.point(1.0));
        indices.push_back(i);
    }
    meshes_ = {builder_.add_mesh(materials_[0], {box, {}, {}, kBoxIndices}).value(),
               builder_.add_mesh(materials_[1], {clump, {}, {}, indices}).value(),
               builder_.add_mesh(materials_[2], {clump, {}, {}, indices}).value()};
}

glm::dmat4 Yard::world_from_yard() const {
    return glm::scale(glm::translate(glm::dmat4(1.0), origin_ + middle_), glm::dvec3(unit_)) * map_;
}

void Yard::add_box(const glm::dvec3& centre, const glm::dvec3& half, std::size_t material_number,
                   bool inside_out) {
    const std::vector<glm::vec3> corners = box_corners(centre, half);
    std::vector<std::uint32_t> indices(kBoxIndices.begin(), kBoxIndices.end());
    for (std::size_t i = 0; inside_out && i < indices.size(); i += 3) std::swap(indices[i], indices[i + 1]);
    builder_.add_static(material(material_number), {corners, {}, {}, indices}, world_from_yard());
}

void Yard::add_boxes(int count, double largest) {
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 half(uniform_.log(0.5, largest), uniform_.log(0.5, largest),
                              uniform_.log(0.5, largest));
        add_box(uniform_.point(30.0), half, any_material());
    }
}

void Yard::add_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                        std::size_t material_number) {
    const std::array<glm::vec3, 3> corners{glm::vec3(a), glm::vec3(b), glm::vec3(c)};
    constexpr std::array<std::uint32_t, 3> kIndices{0, 1, 2};
    builder_.add_static(material(material_number), {corners, {}, {}, kIndices}, world_from_yard());
}

void Yard::add_clutter(int count, double smallest, double largest) {
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 at = uniform_.point(38.0);
        const double size = uniform_.log(smallest, largest);
        add_triangle(at, at + uniform_.point(size), at + uniform_.point(size), any_material());
    }
}

void Yard::add_object(const glm::dvec3& centre, const glm::dmat3& map) {
    const MeshId mesh = meshes_[any_material()];
    const glm::dmat4 place = glm::translate(world_from_yard(), centre) * glm::dmat4(map);
    builder_.add_dynamic(mesh, place);
}

void Yard::add_objects(int count) {
    for (int i = 0; i < 2 * count; ++i) {
        glm::dmat4 place = glm::translate(world_from_yard(), uniform_.point(36.0));
        place = glm::rotate(place, uniform_(0, 6), glm::normalize(uniform_.point(1.0) + 1.1));
        place = glm::scale(place, glm::dvec3(uniform_(0.3, 1.5), uniform_(0.3, 1.5),
                                             i % 4 < 2 ? uniform_(0.3, 1.5) : -uniform_(0.3, 1.5)));
        const MeshId mesh = meshes_[any_material()];
        if (i % 2 == 0 || !builder_.add_instance(mesh, place)) builder_.add_dynamic(mesh, place);
    }
}

void Yard::add_usual() {
    add_boxes(30);
    add_clutter(900);
    add_objects(30);
}

HardScene Yard::finish() {
    return {builder_.finish("yard").value(), unit_, middle_, {}};
}

}  // namespace rhview
