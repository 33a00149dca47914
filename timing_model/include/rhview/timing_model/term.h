// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The terms that a timing model may have, and how they make a time:
///
///     Sum              T = c0 + c1·V + c_p·P + c_f·F + c_d·D  +  c3·N + c_s·S + c_q·Q + c_m·M
///     MaxOfCpuAndGpu   T = c0 + max(c1·V + c_p·P + c_f·F + c_d·D,  c3·N + c_s·S + c_q·Q + c_m·M)
///
/// V, P (primitives after clipping), F (fragments shaded), D (samples that passed the depth test) are the
/// GPU's side, N, S (sub-draws), Q (queries), M (material changes) the CPU's.
/// Source: c1·V + c3·N is Eq. 1 of Serpa & Rodrigues 2019 (RHView); the maximum follows Funkhouser & Séquin
/// 1993 and Wimmer & Wonka 2003.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "rhview/timing_model/work.h"

namespace rhview {

/// What a frame is made of, as far as models count it.
enum class Term {
    Constant,
    Indices,
    DrawCalls,
    SubDraws,
    Fragments,
    Queries,
    MaterialChanges,
    Primitives,
    PassedSamples
};
/// Every term, by its number.
inline constexpr std::array kAllTerms{Term::Constant,        Term::Indices,    Term::DrawCalls,
                                      Term::SubDraws,        Term::Fragments,  Term::Queries,
                                      Term::MaterialChanges, Term::Primitives, Term::PassedSamples};
/// As many as there are.
inline constexpr std::size_t kTermCount = kAllTerms.size();

/// How the parts of a frame add up: one after the other, or the CPU's beside the GPU's.
enum class Combination { Sum, MaxOfCpuAndGpu };

/// Nanoseconds per unit of each term, by `Term`; 0 for a term that the model lacks.
using Constants = std::array<double, kTermCount>;

/// The term's place in `Constants`.
constexpr std::size_t index_of(Term term) {
    return static_cast<std::size_t>(term);
}

/// "constant", "indices", "draw_calls", …: the field of `Work`.
std::string_view name_of(Term term);

/// How much of the term the work holds; 1 for the constant.
double amount_of(Term term, const Work& work);

/// Whether the term is on the GPU's side of the maximum; the constant is on neither.
bool is_on_gpu(Term term);

/// Whether the GPU's side takes longer than the CPU's; a tie is the CPU's.
bool is_gpu_bound(const Constants& constants, const Work& work);

/// Cost: a dozen flops; no allocation. Thread-safe.
double predict_ns(const Constants& constants, Combination combination, const Work& work);

}  // namespace rhview
