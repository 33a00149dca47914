// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/timing_model/term.h"

#include <algorithm>

namespace rhview {
namespace {

struct Sides {
    double cpu_ns = 0.0, gpu_ns = 0.0;
};

Sides sides_of(const Constants& constants, const Work& work) {
    Sides sides;
    for (const Term term : kAllTerms) {
        if (term == Term::Constant) continue;
        (is_on_gpu(term) ? sides.gpu_ns : sides.cpu_ns) += constants[index_of(term)] * amount_of(term, work);
    }
    return sides;
}

}  // namespace

std::string_view name_of(Term term) {
    switch (term) {
        case Term::Constant:
            return "constant";
        case Term::Indices:
            return "indices";
        case Term::DrawCalls:
            return "draw_calls";
        case Term::SubDraws:
            return "sub_draws";
        case Term::Fragments:
            return "fragments";
        case Term::Queries:
            return "queries";
        case Term::MaterialChanges:
            return "material_changes";
        case Term::Primitives:
            return "primitives";
        case Term::PassedSamples:
            return "passed_samples";
    }
    return "";
}

double amount_of(Term term, const Work& work) {
    switch (term) {
        case Term::Constant:
            return 1.0;
        case Term::Indices:
            return work.indices;
        case Term::DrawCalls:
            return work.draw_calls;
        case Term::SubDraws:
            return work.sub_draws;
        case Term::Fragments:
            return work.fragments;
        case Term::Queries:
            return work.queries;
        case Term::MaterialChanges:
            return work.material_changes;
        case Term::Primitives:
            return work.primitives;
        case Term::PassedSamples:
            return work.passed_samples;
    }
    return 0.0;
}

bool is_on_gpu(Term term) {
    return term == Term::Indices || term == Term::Fragments || term == Term::Primitives ||
           term == Term::PassedSamples;
}

bool is_gpu_bound(const Constants& constants, const Work& work) {
    const Sides sides = sides_of(constants, work);
    return sides.gpu_ns > sides.cpu_ns;
}

double predict_ns(const Constants& constants, Combination combination, const Work& work) {
    const Sides sides = sides_of(constants, work);
    const double work_ns =
        combination == Combination::Sum ? sides.cpu_ns + sides.gpu_ns : std::max(sides.cpu_ns, sides.gpu_ns);
    return constants[index_of(Term::Constant)] + work_ns;
}

}  // namespace rhview
