// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "catalogue_methods.h"
#include "hard_case.h"
#include "yard.h"

namespace rhview {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDegree = 0.017453292519943295;

HardScene usual(Amount) {
    Yard yard;
    yard.add_usual();
    return yard.finish();
}

template <int Exponent>
HardScene far_origin(Amount) {
    const double offset = std::pow(10.0, Exponent);
    Yard yard(1.0, {offset, -offset, 0.7 * offset});
    yard.add_usual();
    return yard.finish();
}

// The zero is the world's, and floats are 8 apart there.
HardScene far_positions(Amount) {
    Yard yard(1000.0, glm::dvec3(0.0), {1e8, -1e8, 1e8});
    yard.add_usual();
    return yard.finish();
}

template <int Exponent>
HardScene of_unit(Amount) {
    Yard yard(std::pow(10.0, Exponent) / 40.0);
    yard.add_usual();
    return yard.finish();
}

HardScene on_vertices(Amount) {
    Yard yard;
    yard.add_usual();
    HardScene result = yard.finish();
    const auto positions = result.scene.pools[0].positions.span();
    for (int i = 0; i < 200; ++i) {
        const auto vertex =
            static_cast<std::size_t>(yard.uniform()(0, static_cast<double>(positions.size())));
        result.stands.push_back({glm::dvec3(positions[vertex]), yard.uniform().point(1.0)});
    }
    return result;
}

// On an edge and along it, or on a triangle and along its plane.
HardScene on_edges(Amount) {
    Yard yard;
    yard.add_usual();
    HardScene result = yard.finish();
    const SceneBatch& batch = result.scene.batches[0];
    const auto positions = result.scene.pools[batch.pool].positions.span();
    for (int i = 0; i < 200; ++i) {
        const auto triangle =
            static_cast<std::size_t>(yard.uniform()(0, static_cast<double>(batch.indices.size() / 3)));
        const auto corner = [&](std::size_t c) {
            return glm::dvec3(positions[batch.indices[3 * triangle + c]]);
        };
        const glm::dvec3 edge = corner(1) - corner(0);
        const double share = yard.uniform()(0.1, 0.9);
        if (i % 2 == 0)
            result.stands.push_back({corner(0) + share * edge, i % 4 == 0 ? edge : -edge});
        else
            result.stands.push_back({(corner(0) + corner(1) + corner(2)) / 3.0 - 0.5 * edge,
                                     corner(2) - share * corner(0) - (1.0 - share) * corner(1)});
    }
    return result;
}

// In corners and on faces of nodes' boxes, along the faces and into the boxes.
HardScene on_nodes(Amount) {
    Yard yard;
    yard.add_usual();
    HardScene result = yard.finish();
    const RhOctree octree = catalogue_octree(result.scene);
    for (int i = 0; i < 200; ++i) {
        const auto node =
            static_cast<std::size_t>(yard.uniform()(0, static_cast<double>(octree.nodes().size())));
        const glm::dvec3 low(octree.nodes()[node].bounds.min), high(octree.nodes()[node].bounds.max);
        glm::dvec3 share = glm::round(yard.uniform().point(0.5) + 0.5), forward = yard.uniform().point(1.0);
        if (i % 2 == 0) share[i / 2 % 3] = 0.5;
        if (i % 4 < 2) forward[i / 4 % 3] = 0.0;
        result.stands.push_back({low + share * (high - low), forward});
    }
    return result;
}

HardScene inside_geometry(Amount) {
    Yard yard;
    std::vector<Stand> stands;
    for (int i = 0; i < 20; ++i) {
        const glm::dvec3 at = yard.uniform().point(30.0);
        yard.add_box(at, glm::dvec3(yard.uniform()(0.01, 4.0)), static_cast<std::size_t>(i));
        stands.push_back({at, yard.uniform().point(1.0)});
    }
    yard.add_usual();
    HardScene result = yard.finish();
    result.stands = std::move(stands);
    return result;
}

// The same triangles in every material, twice and turned round, and others in their planes.
HardScene coplanar(Amount) {
    Yard yard;
    for (int i = 0; i < 150; ++i) {
        const glm::dvec3 a = yard.uniform().point(30.0), b = a + yard.uniform().point(12.0),
                         c = a + yard.uniform().point(12.0);
        for (std::size_t material = 0; material < 3; ++material) {
            yard.add_triangle(a, b, c, material);
            yard.add_triangle(a, c, b, material);
        }
        for (int part = 0; part < 4; ++part) {
            const glm::dvec3 from =
                a + yard.uniform()(0.1, 0.6) * (b - a) + yard.uniform()(0.1, 0.3) * (c - a);
            yard.add_triangle(from, from + 0.2 * (b - a), from + 0.2 * (c - a),
                              static_cast<std::size_t>(part));
        }
    }
    yard.add_objects(20);
    return yard.finish();
}

HardScene slivers(Amount) {
    Yard yard;
    yard.add_boxes(20);
    for (int i = 0; i < 1200; ++i) {
        const glm::dvec3 a = yard.uniform().point(38.0), along = yard.uniform().point(30.0);
        const glm::dvec3 beside = yard.uniform().point(yard.uniform().log(1e-7, 0.05));
        const double share = i % 3 == 0 ? yard.uniform()(0, 1) : i % 3 == 1 ? 0.0 : 1.0 + 1e-6;
        yard.add_triangle(a, a + along, a + share * along + beside, static_cast<std::size_t>(i));
    }
    return yard.finish();
}

HardScene no_area(Amount) {
    Yard yard;
    for (int i = 0; i < 900; ++i) {
        const glm::dvec3 a = yard.uniform().point(38.0), along = yard.uniform().point(20.0);
        const glm::dvec3 b = i % 3 == 0 ? a : a + along, c = i % 3 < 2 ? a : a + 0.5 * along;
        yard.add_triangle(a, b, c, static_cast<std::size_t>(i));
    }
    yard.add_usual();
    return yard.finish();
}

HardScene sub_pixel(Amount) {
    Yard yard;
    yard.add_boxes(15);
    yard.add_clutter(6000, 0.002, 0.1);
    return yard.finish();
}

// One leaf that no split can divide, and an eye in it or near.
HardScene one_point(Amount) {
    Yard yard;
    const glm::dvec3 at(3.0, 1.0, -2.0);
    for (int i = 0; i < 500; ++i) yard.add_triangle(at, at, at, static_cast<std::size_t>(i));
    for (int i = 0; i < 500; ++i)
        yard.add_triangle(at, at + yard.uniform().point(0.3), at + yard.uniform().point(0.3),
                          static_cast<std::size_t>(i));
    HardScene result = yard.finish();
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 away = yard.uniform().point(i % 5 == 0 ? 0.0 : 2.0);
        result.stands.push_back({at + away, i % 5 == 0 ? yard.uniform().point(1.0) : -away});
    }
    return result;
}

HardScene one_large_triangle(Amount) {
    Yard yard;
    yard.add_usual();
    constexpr double kLarge = 4e7;
    yard.add_triangle({-kLarge, -45.0, kLarge}, {kLarge, -45.0, kLarge}, {0.0, -45.0, -kLarge}, 0);
    yard.add_triangle({-kLarge, -kLarge, -60.0}, {kLarge, -kLarge, -70.0}, {0.0, kLarge, -65.0}, 2);
    return yard.finish();
}

HardScene many_materials(Amount amount) {
    const int count = amount == Amount::Whole ? 1'000'000 : 4'000;
    Yard yard;
    yard.add_boxes(20);
    const std::vector<std::uint32_t> indices{0, 1, 2};
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 at = yard.uniform().point(38.0);
        const std::vector<glm::vec3> corners{glm::vec3(at), glm::vec3(at + yard.uniform().point(0.4)),
                                             glm::vec3(at + yard.uniform().point(0.4))};
        const MaterialId material = yard.builder().add_material({"", glm::vec3(0.5f), i % 3 == 0, false});
        yard.builder().add_static(material, {corners, {}, {}, indices}, yard.world_from_yard());
    }
    return yard.finish();
}

HardScene many_objects(Amount amount) {
    const int count = amount == Amount::Whole ? 1'000'000 : 20'000;
    Yard yard;
    yard.add_boxes(20);
    const std::vector<std::uint32_t> indices{0, 1, 2};
    const std::vector<glm::vec3> corners{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    const MeshId mesh = yard.builder().add_mesh(yard.material(2), {corners, {}, {}, indices}).value();
    for (int i = 0; i < count / 2; ++i) {
        yard.add_clutter(1, 0.02, 0.4);  // a static object each
        glm::dmat4 place = yard.world_from_yard();
        place[3] += glm::dvec4(yard.uniform().point(38.0), 0.0);
        place[0] *= yard.uniform()(0.05, 0.3);
        place[1] *= yard.uniform()(0.05, 0.3);
        yard.builder().add_dynamic(mesh, place);
    }
    return yard.finish();
}

/// All of the yard through one map, and objects through it too.
HardScene mapped(const glm::dmat3& map) {
    Yard yard;
    yard.set_map(map);
    yard.add_usual();
    return yard.finish();
}

HardScene non_uniform(Amount) {
    return mapped({{1.0, 0.0, 0.0}, {0.0, 0.01, 0.0}, {0.0, 0.0, 30.0}});
}

HardScene mirrored(Amount) {
    return mapped({{-1.0, 0.0, 0.0}, {0.0, 0.7, 0.0}, {0.0, 0.0, 1.3}});
}

HardScene sheared(Amount) {
    return mapped({{1.0, 0.0, 0.0}, {6.0, 1.0, 0.0}, {-3.0, 2.0, 1.0}});
}

// What they place is flat, a line or a point.
HardScene singular(Amount) {
    Yard yard;
    yard.add_usual();
    for (int i = 0; i < 120; ++i) {
        const glm::dvec3 a = yard.uniform().point(3.0), b = yard.uniform().point(3.0);
        const glm::dvec3 none(0.0);
        const glm::dmat3 map = i % 4 == 0   ? glm::dmat3(a, b, a + b)
                               : i % 4 == 1 ? glm::dmat3(a, b, none)
                               : i % 4 == 2 ? glm::dmat3(a, 2.0 * a, none)
                                            : glm::dmat3(none, none, none);
        yard.add_object(yard.uniform().point(36.0), map);
    }
    return yard.finish();
}

HardScene inside_out(Amount) {
    Yard yard;
    for (int i = 0; i < 60; ++i)
        yard.add_box(
            yard.uniform().point(30.0),
            {yard.uniform().log(0.5, 9.0), yard.uniform().log(0.5, 9.0), yard.uniform().log(0.5, 9.0)},
            static_cast<std::size_t>(i), i % 2 == 0);
    yard.add_clutter(400);
    yard.add_objects(20);
    return yard.finish();
}

// Walls whose halves meet in corners of one and edges of the other: what is behind shines through the cracks.
HardScene t_junctions(Amount) {
    Yard yard;
    for (int wall = 0; wall < 12; ++wall) {
        const glm::dvec3 at = yard.uniform().point(25.0), right = yard.uniform().point(14.0),
                         up = yard.uniform().point(14.0);
        const std::size_t material = wall % 2 == 0 ? 2 : 0;
        yard.add_triangle(at - up, at + right, at - right, material);
        constexpr int kParts = 23;
        for (int i = 0; i < kParts; ++i) {
            const glm::dvec3 from = at - right + (2.0 * i / kParts) * right;
            yard.add_triangle(from, from + (2.0 / kParts) * right, at + up, material);
        }
    }
    yard.add_clutter(1200);
    yard.add_objects(20);
    return yard.finish();
}

// Corners that are zero of either sign, or as near to it as a float can be.
HardScene denormals(Amount) {
    Yard yard;
    yard.add_usual();
    const float tiny[] = {0.0f, -0.0f, 1e-45f, -1e-45f, 3e-40f, -7e-39f};
    const auto any = [&] {
        return static_cast<double>(tiny[static_cast<std::size_t>(yard.uniform()(0, 6))]);
    };
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 a(any(), any(), any());
        glm::dvec3 b = yard.uniform().point(2.0), c(any(), any(), any());
        if (i % 3 == 0) b = {any(), any(), any()};
        if (i % 2 == 0) c = yard.uniform().point(2.0);
        yard.add_triangle(a, b, c, static_cast<std::size_t>(i));
    }
    HardScene result = yard.finish();
    for (int i = 0; i < 60; ++i) {
        const glm::dvec3 away = yard.uniform().point(i % 3 == 0 ? 1e-40 : 6.0);
        result.stands.push_back({away, i % 3 == 0 ? yard.uniform().point(1.0) : -away});
    }
    return result;
}

std::vector<HardCase> make_cases() {
    const Lens usual_lens;
    return {
        {"the_usual_yard", usual},
        {"world_origin_at_1e4", far_origin<4>},
        {"world_origin_at_1e6", far_origin<6>},
        {"world_origin_at_1e8", far_origin<8>},
        {"positions_at_1e8", far_positions},
        {"scene_of_size_1e_minus_6", of_unit<-6>},
        {"scene_of_size_1e9", of_unit<9>},
        {"far_is_1e9_times_near", usual, {.near = 1e-4, .far = 1e5}},
        {"field_of_view_half_a_degree", usual, {.fov_y = 0.5 * kDegree}},
        {"field_of_view_179_degrees", usual, {.fov_y = 179.0 * kDegree}},
        {"orthographic", usual, {.projection = Projection::Orthographic}},
        {"oblique_near_plane", usual, {.projection = Projection::Oblique}},
        {"asymmetric", usual, {.projection = Projection::Asymmetric}},
        {"infinite_far_plane", usual, {.far = kInfinity}},
        {"depth_of_16_24_and_32_bits", usual, usual_lens, true},
        {"depth_of_few_bits_far_is_1e9_times_near", usual, {.near = 1e-4, .far = 1e5}, true},
        {"eye_on_vertices", on_vertices},
        {"eye_on_edges_and_in_planes", on_edges},
        {"eye_on_planes_of_nodes", on_nodes},
        {"eye_inside_geometry", inside_geometry},
        {"coplanar_and_duplicate_triangles", coplanar},
        {"slivers_and_needles", slivers},
        {"triangles_without_area", no_area},
        {"triangles_below_a_pixel", sub_pixel},
        {"all_triangles_in_one_point", one_point},
        {"one_triangle_larger_than_the_scene", one_large_triangle},
        {"as_many_materials_as_triangles", many_materials, usual_lens, false, true},
        {"objects_of_one_triangle", many_objects, usual_lens, false, true},
        {"non_uniform_scales", non_uniform},
        {"mirrored", mirrored},
        {"sheared", sheared},
        {"singular_placements", singular},
        {"two_sided_and_inside_out", inside_out},
        {"t_junctions", t_junctions},
        {"denormal_and_negative_zero_corners", denormals},
        {"cameras_with_a_hostile_number", usual, usual_lens, false, false, hostile_cameras},
    };
}

}  // namespace

const std::vector<HardCase>& hard_cases() {
    static const std::vector<HardCase> cases = make_cases();
    return cases;
}

}  // namespace rhview
