// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "property_case.h"

#include <limits>
#include <sstream>

#include "uniform.h"

namespace rhview {
namespace {

/// Calls `each(name, value)` for every number of a case.
template <class Case, class Each>
void for_each_number(Case& c, const Each& each) {
    each("seed", c.seed);
    each("triangles", c.triangles);
    each("batches", c.batches);
    each("walls", c.walls);
    each("copies", c.copies);
    each("slivers", c.slivers);
    each("frames", c.frames);
    each("stand", c.stand);
    each("leaf", c.leaf);
    each("record", c.record);
    each("depth", c.depth);
    each("mode", c.mode);
    each("orthographic", c.orthographic);
    each("latency", c.latency);
    each("spread", c.spread);
    each("replicas", c.replicas);
    each("scale", c.scale);
    each("origin", c.origin);
    each("fov", c.fov);
    each("draw_ns", c.draw_ns);
    each("call_ns", c.call_ns);
    each("query_ns", c.query_ns);
    each("lost", c.lost);
    each("duplicated", c.duplicated);
}

bool is_runnable(const PropertyCase& c) {
    return c.triangles > 0 && c.triangles <= 1'000'000 && c.batches > 0 && c.batches <= 10'000 &&
           c.frames > 0 && c.stand > 0 && c.depth < 3 && c.mode < 3 && c.scale > 0.0 && c.fov > 0.0 &&
           c.fov < 3.14 && c.draw_ns >= 0.0 && c.call_ns >= 0.0 && c.query_ns >= 0.0;
}

}  // namespace

PropertyCase random_property_case(std::uint32_t seed) {
    Uniform uniform(seed);
    const auto number = [&](double low, double high) {
        return static_cast<std::uint32_t>(uniform(low, high + 1.0));
    };
    const auto sometimes = [&](double part, double value) { return uniform(0, 1) < part ? value : 0.0; };
    PropertyCase c;
    c.seed = seed;
    c.triangles = static_cast<std::uint32_t>(uniform.log(2, 600));
    c.batches = number(1, 5);
    c.walls = number(0, 12);
    c.copies = static_cast<std::uint32_t>(sometimes(0.3, c.triangles / 4.0));
    c.slivers = static_cast<std::uint32_t>(sometimes(0.3, c.triangles / 8.0));
    c.frames = number(1, 5);
    c.stand = number(1, 10);
    c.leaf = static_cast<std::uint32_t>(uniform.log(1, 60));
    c.record = static_cast<std::uint32_t>(sometimes(0.5, uniform.log(1, 100)));
    c.depth = number(0, 2);
    c.mode = number(0, 2);
    c.orthographic = static_cast<std::uint32_t>(sometimes(0.2, 1.0));
    c.latency = number(1, 3);
    c.spread = number(0, 2);
    c.replicas = sometimes(0.5, uniform(0.1, 2.0));
    // Powers of two: a scene's float coordinates scale without rounding.
    c.scale = std::exp2(std::floor(sometimes(0.4, uniform(-20, 30))));
    c.origin = sometimes(0.4, uniform.log(1, 1e8));
    c.fov = uniform.log(0.01, 3.0);
    c.draw_ns = sometimes(0.9, uniform.log(1, 1e5));
    c.call_ns = sometimes(0.3, uniform.log(1, 1e4));
    c.query_ns = sometimes(0.9, uniform.log(0.1, 300));
    c.lost = sometimes(0.5, uniform(0, 1));
    c.duplicated = sometimes(0.5, uniform(0, 0.5));
    return c;
}

std::string text_of(const PropertyCase& property) {
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    for_each_number(property,
                    [&](const char* name, const auto& value) { text << name << ' ' << value << '\n'; });
    return text.str();
}

std::optional<PropertyCase> read_property_case(const std::string& text) {
    PropertyCase result;
    std::istringstream lines(text);
    for (std::string name; lines >> name;) {
        bool known = false;
        for_each_number(result, [&](const char* of, auto& value) {
            if (name == of) known = static_cast<bool>(lines >> value);
        });
        if (!known) return std::nullopt;
    }
    return is_runnable(result) ? std::optional(result) : std::nullopt;
}

std::vector<PropertyCase> simpler(const PropertyCase& property) {
    std::vector<PropertyCase> cases;
    const auto offer = [&](auto PropertyCase::*number, auto value) {
        PropertyCase c = property;
        c.*number = value;
        if (!(c == property) && is_runnable(c)) cases.push_back(c);
    };
    const PropertyCase plain;
    for (const auto number :
         {&PropertyCase::mode, &PropertyCase::walls, &PropertyCase::copies, &PropertyCase::slivers,
          &PropertyCase::record, &PropertyCase::orthographic, &PropertyCase::depth, &PropertyCase::spread})
        offer(number, 0u);
    for (const auto number : {&PropertyCase::batches, &PropertyCase::stand, &PropertyCase::latency})
        offer(number, 1u);
    for (const auto number :
         {&PropertyCase::replicas, &PropertyCase::scale, &PropertyCase::origin, &PropertyCase::fov,
          &PropertyCase::call_ns, &PropertyCase::lost, &PropertyCase::duplicated, &PropertyCase::draw_ns})
        offer(number, plain.*number);
    for (const auto number :
         {&PropertyCase::triangles, &PropertyCase::frames, &PropertyCase::batches, &PropertyCase::walls,
          &PropertyCase::copies, &PropertyCase::slivers, &PropertyCase::stand}) {
        offer(number, property.*number / 2);
        if (property.*number > 0) offer(number, property.*number - 1);
    }
    return cases;
}

}  // namespace rhview
