// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "plant_parts.h"

#include <algorithm>

namespace rhview {
namespace {

using Vec = glm::dvec3;

void add_plain_box(PlantWriter& writer, PlantMaterial material, const Vec& low, const Vec& high) {
    add_box(writer.start(), {}, low, high);
    writer.finish(material);
}

/// An I-beam along `frame.y`.
void add_beam(PlantWriter& writer, const Frame& frame, double length, double size) {
    ShapeBuffer& buffer = writer.start();
    const double h = 0.5 * size, web = 0.05 * size, flange = 0.12 * size;
    add_box(buffer, frame, {-web, 0.0, -h + flange}, {web, length, h - flange});
    add_box(buffer, frame, {-h, 0.0, -h}, {h, length, -h + flange});
    add_box(buffer, frame, {-h, 0.0, h - flange}, {h, length, h});
    writer.finish(PlantMaterial::Steel);
}

void add_flange(PlantWriter& writer, const Frame& frame, double radius, PlantMaterial material) {
    add_cylinder(writer.start(), frame.moved({0.0, -0.2 * radius, 0.0}), 1.7 * radius, 1.7 * radius,
                 0.4 * radius, writer.sides());
    writer.finish(material);
}

void add_pipe(PlantWriter& writer, const Frame& frame, double radius, double length, PlantMaterial material) {
    add_cylinder(writer.start(), frame, radius, radius, length, writer.sides(), false);
    writer.finish(material);
}

/// A body on the pipe's line with a stem and a hand wheel across it.
void add_valve(PlantWriter& writer, const Frame& frame, double radius) {
    ShapeBuffer& buffer = writer.start();
    add_sphere(buffer, frame, 1.8 * radius, 1.6 * radius, writer.sides(), 4);
    const Frame stem{frame.origin, frame.y, frame.x, -frame.z};
    add_cylinder(buffer, stem, 0.3 * radius, 0.3 * radius, 4.0 * radius, std::max(3, writer.sides() / 2),
                 false);
    add_torus(buffer, stem.moved({0.0, 4.0 * radius, 0.0}), 1.5 * radius, 0.25 * radius, writer.sides() + 2,
              4);
    writer.finish(PlantMaterial::RedPaint);
}

void add_handrail(PlantWriter& writer, const Vec& start, const Vec& along) {
    ShapeBuffer& buffer = writer.start();
    for (int post = 0; post < 4; ++post) {
        const Vec foot = start + along * (post * kBayPitch / 4.0);
        add_box(buffer, {foot}, {-0.025, 0.0, -0.025}, {0.025, 1.1, 0.025});
    }
    for (const double height : {0.55, 1.1})
        add_box(buffer, {start}, {-0.02, height - 0.02, -0.02},
                along * kBayPitch + Vec(0.02, height + 0.02, 0.02));
    writer.finish(PlantMaterial::YellowPaint);
}

void add_ladder(PlantWriter& writer, const Vec& foot) {
    ShapeBuffer& buffer = writer.start();
    for (const double x : {-0.25, 0.25})
        add_box(buffer, {foot}, {x - 0.03, 0.0, -0.03}, {x + 0.03, kDeckHeight, 0.03});
    for (int rung = 1; rung < 20; ++rung)
        add_box(buffer, {foot}, {-0.22, rung * 0.3 - 0.015, -0.015}, {0.22, rung * 0.3 + 0.015, 0.015});
    writer.finish(PlantMaterial::YellowPaint);
}

void add_structure(PlantWriter& writer, SceneRandom& random, const BayPlace& place) {
    const Vec& c = place.corner;
    add_plain_box(writer, PlantMaterial::Grating, c + Vec(0.0, -0.08, 0.0),
                  c + Vec(kBayPitch, 0.0, kBayPitch));
    const Frame along_x{{c.x, c.y - 0.3, c.z}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    const Frame along_z{{c.x, c.y - 0.3, c.z}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
    for (const double offset : {0.0, 0.5 * kBayPitch}) {
        add_beam(writer, along_x.moved({offset, 0.0, 0.0}), kBayPitch, 0.4);
        add_beam(writer, along_z.moved({offset, 0.0, 0.0}), kBayPitch, 0.4);
    }
    if (!place.top_deck) add_beam(writer, {c, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, kDeckHeight - 0.5, 0.5);
    if (!place.top_deck && random.chance(0.3)) add_ladder(writer, c + Vec(1.0, 0.0, kWalkway + 0.3));
    if (place.last_x) add_handrail(writer, c + Vec(kBayPitch, 0.0, kWalkway), {0, 0, 1});
    if (place.last_z) add_handrail(writer, c + Vec(0.0, 0.0, kBayPitch), {1, 0, 0});
}

/// A standing vessel with domed ends, or a hopper where `cone` says so.
void add_tank(PlantWriter& writer, SceneRandom& random, const Vec& foot, bool cone) {
    const double radius = random.between(0.9, 1.6), height = random.between(2.0, 2.8);
    const int sides = 2 * writer.sides();
    const Frame body{foot + Vec(0.0, 0.9, 0.0)};
    if (cone) {
        add_turned(writer.start(), body,
                   {{0.0, -0.6}, {0.15, -0.6}, {0.15, -0.4}, {radius, 1.2}, {radius, height}, {0.0, height}},
                   sides);
        writer.finish(PlantMaterial::GreenPaint);
    } else {
        std::vector<OutlinePoint> outline;
        for (int k = 0; k <= 4; ++k) {
            const CosSin angle = cos_sin_of_turns(0.0625 * k - 0.25);
            outline.push_back(
                {k == 0 ? 0.0 : radius * angle.cos, 0.5 * radius * angle.sin, {angle.cos, angle.sin}});
        }
        for (int k = 4; k >= 0; --k) {
            const OutlinePoint low = outline[static_cast<std::size_t>(k)];
            outline.push_back({low.radius, height - low.height, {low.normal.x, -low.normal.y}});
        }
        add_lathe(writer.start(), body, outline, sides);
        writer.finish(random.chance(0.5) ? PlantMaterial::TankWhite : PlantMaterial::Insulation);
    }
    ShapeBuffer& legs = writer.start();
    for (int leg = 0; leg < 4; ++leg) {
        const CosSin angle = cos_sin_of_turns(0.25 * leg + 0.125);
        add_box(legs, {foot + 0.95 * radius * Vec(angle.cos, 0.0, angle.sin)}, {-0.08, 0.0, -0.08},
                {0.08, 1.4, 0.08});
    }
    writer.finish(PlantMaterial::Steel);
    const double top = cone ? height : height + 0.5 * radius;
    add_flange(writer, body.moved({0.0, top, 0.0}), 0.15, PlantMaterial::Steel);
}

/// A lying vessel on saddles, or two of them, as in a heat exchanger.
void add_vessel(PlantWriter& writer, SceneRandom& random, const Vec& foot) {
    const int count = random.whole(1, 2);
    const double radius = count == 1 ? 0.9 : 0.55, length = 4.2;
    for (const double x : {-1.3, 1.3})
        add_plain_box(writer, PlantMaterial::Steel, foot + Vec(x - 0.12, 0.0, -0.8 * radius),
                      foot + Vec(x + 0.12, 0.5 + 0.6 * radius, 0.8 * radius));
    for (int i = 0; i < count; ++i) {
        const Vec start = foot + Vec(-0.5 * length, 0.4 + radius + 2.1 * radius * i, 0.0);
        const Frame frame{start, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
        add_cylinder(writer.start(), frame, radius, radius, length, 2 * writer.sides());
        writer.finish(count == 1 ? PlantMaterial::TankWhite : PlantMaterial::Insulation);
        for (const double end : {0.0, length})
            add_flange(writer, frame.moved({0.0, end, 0.0}), 0.64 * radius, PlantMaterial::BluePaint);
    }
}

void add_pump(PlantWriter& writer, const Vec& foot) {
    add_plain_box(writer, PlantMaterial::Steel, foot + Vec(-1.0, 0.0, -0.5), foot + Vec(1.0, 0.25, 0.5));
    const Frame frame{foot + Vec(-0.9, 0.65, 0.0), {0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    add_cylinder(writer.start(), frame, 0.35, 0.35, 0.9, 2 * writer.sides());
    writer.finish(PlantMaterial::BluePaint);
    add_cylinder(writer.start(), frame.moved({0.0, 0.9, 0.0}), 0.28, 0.12, 0.35, writer.sides());
    writer.finish(PlantMaterial::YellowPaint);
    add_sphere(writer.start(), frame.moved({0.0, 1.45, 0.0}), 0.4, 0.25, 2 * writer.sides(), 6);
    writer.finish(PlantMaterial::GreenPaint);
    add_flange(writer, {foot + Vec(0.55, 1.05, 0.0)}, 0.12, PlantMaterial::Steel);
}

void add_cabinet(PlantWriter& writer, const Vec& foot) {
    add_plain_box(writer, PlantMaterial::TankWhite, foot + Vec(-0.6, 0.1, -0.3), foot + Vec(0.6, 2.0, 0.3));
    ShapeBuffer& dials = writer.start();
    for (int i = 0; i < 6; ++i) {
        const Frame frame{
            foot + Vec(-0.4 + 0.4 * (i % 3), 1.2 + 0.35 * (i / 3), -0.3), {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}};
        add_cylinder(dials, frame, 0.1, 0.1, 0.04, writer.sides());
    }
    writer.finish(PlantMaterial::Copper);
}

void add_machines(PlantWriter& writer, SceneRandom& random, const BayPlace& place) {
    for (const double x : {3.2, 8.8}) {
        const Vec foot = place.corner + Vec(x, 0.0, random.between(5.0, 9.0));
        const int kind = random.below(6);
        if (kind <= 1)
            add_tank(writer, random, foot, kind == 1);
        else if (kind <= 3)
            add_vessel(writer, random, foot);
        else if (kind == 4)
            add_pump(writer, foot);
        else
            add_cabinet(writer, foot);
    }
}

/// Pipes that go on from bay to bay below the next deck.
void add_racks(PlantWriter& writer, const BayPlace& place) {
    if (place.top_deck) return;
    constexpr std::array<PlantMaterial, 4> kPaint{PlantMaterial::PipeSteel, PlantMaterial::Insulation,
                                                  PlantMaterial::Copper, PlantMaterial::BluePaint};
    for (int i = 0; i < 7; ++i) {
        const bool across = i >= 4;
        const double radius = 0.06 + 0.03 * (i % 3), place_of_pipe = 3.2 + 0.55 * i;
        const Frame frame =
            across ? Frame{place.corner + Vec(place_of_pipe, 4.75, 0.0), {1, 0, 0}, {0, 0, 1}, {0, -1, 0}}
                   : Frame{place.corner + Vec(0.0, 5.25, place_of_pipe), {0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
        const PlantMaterial paint = kPaint[static_cast<std::size_t>(i % 4)];
        add_pipe(writer, frame, radius, kBayPitch, paint);
        add_flange(writer, frame, radius, paint);
        if (across ? place.last_z : place.last_x)
            add_flange(writer, frame.moved({0.0, kBayPitch, 0.0}), radius, paint);
    }
}

/// Where a run of pipe is, and where it may go.
struct PipeHead {
    Vec position{0.0};
    Vec low{0.0}, high{0.0};

    [[nodiscard]] double room(int axis, double sign) const {
        return sign > 0.0 ? high[axis] - position[axis] : position[axis] - low[axis];
    }
};

Vec axis_vector(int axis, double sign) {
    Vec v(0.0);
    v[axis] = sign;
    return v;
}

/// Straight lengths and bends from a flange to a flange, with a valve here and there.
void add_pipe_run(PlantWriter& writer, SceneRandom& random, const BayPlace& place) {
    constexpr std::array<PlantMaterial, 5> kPaint{PlantMaterial::PipeSteel, PlantMaterial::PipeSteel,
                                                  PlantMaterial::Copper, PlantMaterial::YellowPaint,
                                                  PlantMaterial::GreenPaint};
    const PlantMaterial paint = kPaint[static_cast<std::size_t>(random.below(5))];
    const double thickness = random.unit();
    const double radius = 0.025 + 0.13 * thickness * thickness, bend = 3.0 * radius;
    PipeHead head;
    head.low = place.corner + Vec(0.3, 0.3, kWalkway + 0.3);
    head.high = place.corner + Vec(kBayPitch - 0.3, place.top_deck ? 3.0 : 4.5, kBayPitch - 0.3);
    for (int axis = 0; axis < 3; ++axis)
        head.position[axis] = random.between(head.low[axis], head.high[axis]);
    int axis = random.below(3);
    double sign = head.room(axis, 1.0) > head.room(axis, -1.0) ? 1.0 : -1.0;
    const int lengths = random.whole(3, 7);
    for (int i = 0; i < lengths; ++i) {
        const Vec along = axis_vector(axis, sign);
        const double length = std::min(random.between(0.4, 6.0), head.room(axis, sign) - bend - 0.05);
        const Frame frame = frame_along(head.position, along);
        if (i == 0) add_flange(writer, frame, radius, paint);
        add_pipe(writer, frame, radius, length, paint);
        if (length > 10.0 * radius && random.chance(0.4))
            add_valve(writer, frame.moved({0.0, 0.5 * length, 0.0}), radius);
        head.position += length * along;
        const int next_axis = (axis + random.whole(1, 2)) % 3;
        const double next_sign = head.room(next_axis, 1.0) > head.room(next_axis, -1.0) ? 1.0 : -1.0;
        if (i + 1 == lengths) add_flange(writer, frame.moved({0.0, length, 0.0}), radius, paint);
        if (i + 1 == lengths) break;
        const Vec turn = axis_vector(next_axis, next_sign);
        add_elbow(writer.start(), {head.position, turn, along, glm::cross(turn, along)}, bend, radius,
                  writer.sides(), 4);
        writer.finish(paint);
        head.position += bend * (along + turn);
        axis = next_axis;
        sign = next_sign;
    }
}

}  // namespace

PlantWriter::PlantWriter(SceneBuilder& builder, int sides, std::int64_t objects)
    : builder_(builder), sides_(sides) {
    constexpr std::array<glm::vec3, kPlantMaterials> kColours{{{0.24f, 0.25f, 0.27f},
                                                               {0.46f, 0.47f, 0.48f},
                                                               {0.55f, 0.24f, 0.12f},
                                                               {0.72f, 0.50f, 0.05f},
                                                               {0.60f, 0.06f, 0.05f},
                                                               {0.08f, 0.20f, 0.50f},
                                                               {0.10f, 0.36f, 0.18f},
                                                               {0.80f, 0.80f, 0.78f},
                                                               {0.14f, 0.14f, 0.13f},
                                                               {0.64f, 0.62f, 0.56f}}};
    constexpr std::array<const char*, kPlantMaterials> kNames{
        "steel",      "pipe steel",  "copper",     "yellow paint", "red paint",
        "blue paint", "green paint", "tank white", "grating",      "insulation"};
    for (std::size_t i = 0; i < kPlantMaterials; ++i)
        materials_[i] = builder.add_material({kNames[i], kColours[i]});
    const auto vertices = static_cast<std::size_t>(objects) * static_cast<std::size_t>(8 + 4 * sides);
    builder.reserve(materials_[0], true, false, vertices, 0);
}

ShapeBuffer& PlantWriter::start() {
    buffer_.clear();
    return buffer_;
}

void PlantWriter::finish(PlantMaterial material) {
    if (is_full()) return;
    builder_.add_static(materials_[static_cast<std::size_t>(material)], buffer_.piece());
    ++written_;
}

void add_bay(PlantWriter& writer, SceneRandom& random, const BayPlace& place) {
    add_structure(writer, random, place);
    add_racks(writer, place);
    add_machines(writer, random, place);
    while (!writer.is_full()) add_pipe_run(writer, random, place);
}

}  // namespace rhview
