// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The names of a profile's constants in its file.
#pragma once

#include <array>

#include "rhview/timing_model/profile.h"

namespace rhview {

struct ConstantField {
    Term term;
    const char* name;
    bool required;
};

inline constexpr std::array<ConstantField, kTermCount> kConstantFields{{
    {Term::Constant, "c0_ns", true},
    {Term::Indices, "c1_ns", true},
    {Term::DrawCalls, "c3_ns", true},
    {Term::Queries, "query_ns", false},
    {Term::SubDraws, "sub_draw_ns", false},
    {Term::Fragments, "fragment_ns", false},
    {Term::MaterialChanges, "material_ns", false},
    {Term::Primitives, "primitive_ns", false},
    {Term::PassedSamples, "passed_sample_ns", false},
}};

struct WayField {
    const char* name;
    AnswerCosts QueryCosts::*value;
};

inline constexpr std::array<WayField, 2> kWayFields{{
    {"hardware_query", &QueryCosts::hardware},
    {"box_pass", &QueryCosts::box_pass},
}};

struct AnswerField {
    const char* name;
    double AnswerCosts::*value;
};

inline constexpr std::array<AnswerField, 5> kAnswerFields{{
    {"frame_ns", &AnswerCosts::frame_ns},
    {"query_ns", &AnswerCosts::query_ns},
    {"box_ns", &AnswerCosts::box_ns},
    {"pixel_ns", &AnswerCosts::pixel_ns},
    {"draw_ns", &AnswerCosts::draw_ns},
}};

struct PercentileField {
    const char* name;
    double ResidualPercentiles::*value;
};

inline constexpr std::array<PercentileField, 5> kPercentileFields{{
    {"p5", &ResidualPercentiles::p5},
    {"p50", &ResidualPercentiles::p50},
    {"p95", &ResidualPercentiles::p95},
    {"absolute_p50", &ResidualPercentiles::absolute_p50},
    {"absolute_p95", &ResidualPercentiles::absolute_p95},
}};

}  // namespace rhview
