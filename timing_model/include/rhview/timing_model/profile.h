// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

/// \file
/// The timing constants of one machine: what predicts a frame, and the file that keeps them.
///
/// File: JSON, schema `rhview.profile/1`. Required: `schema`, `device` {`renderer`, `version`}, `c0_ns`,
/// `c1_ns`, `c3_ns`. Optional, absent or null where not measured: `query_ns`, `sub_draw_ns`, `fragment_ns`,
/// `material_ns`, `primitive_ns`, `passed_sample_ns`, `combination` ("sum" or "max"), `timer` {`name`,
/// `why`}, `date`, `note`, `samples`, `hold_out_error`, `r_squared`, `standard_errors` {the constants'
/// names}, `answer_costs` {`hardware_query`, `box_pass`: each {`frame_ns`, `query_ns`, `box_ns`, `pixel_ns`,
/// `draw_ns`}}, `residuals` {`p5`, `p50`, `p95`, `absolute_p50`, `absolute_p95`}. Unknown fields are ignored,
/// so that later versions may add some. Writing and reading keeps every bit of a number.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "rhview/base/result.h"
#include "rhview/timing_model/fit.h"
#include "rhview/timing_model/query_costs.h"

namespace rhview {

/// Constants are finite and not negative. Strings are UTF-8.
struct TimingProfile {
    std::string renderer, version;      ///< the device, as its driver calls itself
    std::string timer_name, timer_why;  ///< the clock that measured, and why that one
    std::string date;                   ///< as the caller writes it
    std::string note;

    double c0_ns = 0.0;  ///< per frame
    double c1_ns = 0.0;  ///< per index
    double c3_ns = 0.0;  ///< per draw call
    std::optional<double> query_ns, sub_draw_ns, fragment_ns, material_ns, primitive_ns, passed_sample_ns;
    Combination combination = Combination::Sum;
    std::optional<QueryCosts> answer_costs;  ///< of occlusion queries, by what they ask about

    std::array<std::optional<double>, kTermCount> standard_errors_ns;  ///< by `Term`
    std::optional<ResidualPercentiles> residuals;
    std::optional<double> hold_out_error, r_squared;
    std::uint64_t samples = 0;  ///< 0: not known

    /// The constant of a term; absent if the model lacks it.
    [[nodiscard]] std::optional<double> constant(Term term) const;
    /// Sets the field of that term.
    void set_constant(Term term, double value_ns);
    /// By `Term`, 0 for those that were not measured.
    [[nodiscard]] Constants constants() const;

    /// What the model says of the work; terms that the model lacks cost nothing. Thread-safe, no allocation.
    [[nodiscard]] double predict_ns(const Work& work) const;
};

/// The constant's name in the file: "c1_ns".
std::string_view profile_field_of(Term term);

/// The constants and errors of a fit; the caller adds device, timer, date, and `query_ns` if measured apart.
TimingProfile make_profile(const Fit& fit);

/// Whether every number of the profile may be written: the error names the field.
Status validate(const TimingProfile& profile);

/// `source_name` begins every error sentence.
Result<TimingProfile> parse_profile(std::string_view text, const std::string& source_name);
/// Reads and parses a file; errors name it, and the field that is wrong.
Result<TimingProfile> load_profile(const std::filesystem::path& file);

/// The text of the file; the profile is valid. Broken UTF-8 is replaced by U+FFFD.
std::string profile_text(const TimingProfile& profile);

/// As a `ReplacementFile`: `file` is old or new, never half. On an error nothing is left behind. The folder
/// must exist.
Status save_profile(const TimingProfile& profile, const std::filesystem::path& file);

}  // namespace rhview
