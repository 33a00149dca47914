// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "rhview/timing_model/profile.h"

#include <cmath>
#include <fstream>
#include <system_error>

#include "profile_fields.h"
#include "rhview/base/replacement_file.h"

namespace rhview {
namespace {

/// Far beyond any real profile: what is larger is not one.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 20;

Status check_constant(const std::string& field, double value) {
    if (std::isfinite(value) && value >= 0.0) return success();
    return Error{field + " is " +
                 (std::isnan(value) ? "not a number"
                  : value < 0.0     ? "negative"
                                    : "infinite") +
                 "; it must be finite and not negative, so calibrate again"};
}

Status check_finite(const std::string& field, const std::optional<double>& value) {
    if (!value || std::isfinite(*value)) return success();
    return Error{field + " is not finite; calibrate again"};
}

}  // namespace

std::optional<double> TimingProfile::constant(Term term) const {
    switch (term) {
        case Term::Constant:
            return c0_ns;
        case Term::Indices:
            return c1_ns;
        case Term::DrawCalls:
            return c3_ns;
        case Term::SubDraws:
            return sub_draw_ns;
        case Term::Fragments:
            return fragment_ns;
        case Term::Queries:
            return query_ns;
        case Term::MaterialChanges:
            return material_ns;
        case Term::Primitives:
            return primitive_ns;
        case Term::PassedSamples:
            return passed_sample_ns;
    }
    return std::nullopt;
}

void TimingProfile::set_constant(Term term, double value_ns) {
    switch (term) {
        case Term::Constant:
            c0_ns = value_ns;
            break;
        case Term::Indices:
            c1_ns = value_ns;
            break;
        case Term::DrawCalls:
            c3_ns = value_ns;
            break;
        case Term::SubDraws:
            sub_draw_ns = value_ns;
            break;
        case Term::Fragments:
            fragment_ns = value_ns;
            break;
        case Term::Queries:
            query_ns = value_ns;
            break;
        case Term::MaterialChanges:
            material_ns = value_ns;
            break;
        case Term::Primitives:
            primitive_ns = value_ns;
            break;
        case Term::PassedSamples:
            passed_sample_ns = value_ns;
            break;
    }
}

Constants TimingProfile::constants() const {
    Constants result{};
    for (const Term term : kAllTerms) result[index_of(term)] = constant(term).value_or(0.0);
    return result;
}

double TimingProfile::predict_ns(const Work& work) const {
    return rhview::predict_ns(constants(), combination, work);
}

std::string_view profile_field_of(Term term) {
    for (const ConstantField& field : kConstantFields)
        if (field.term == term) return field.name;
    return "";
}

TimingProfile make_profile(const Fit& fit) {
    TimingProfile profile;
    for (const Coefficient& coefficient : fit.coefficients) {
        profile.set_constant(coefficient.term, coefficient.value_ns);
        profile.standard_errors_ns[index_of(coefficient.term)] = coefficient.standard_error_ns;
    }
    profile.combination = fit.combination;
    profile.residuals = fit.residuals;
    profile.hold_out_error = fit.hold_out_error;
    profile.r_squared = fit.r_squared;
    profile.samples = fit.samples;
    return profile;
}

Status validate(const TimingProfile& profile) {
    for (const ConstantField& field : kConstantFields) {
        const std::string name = std::string("\"") + field.name + "\"";
        if (const std::optional<double> value = profile.constant(field.term)) {
            if (Status status = check_constant(name, *value); !status) return status;
        }
        if (const std::optional<double> error = profile.standard_errors_ns[index_of(field.term)]) {
            if (Status status = check_constant("the standard error of " + name, *error); !status)
                return status;
        }
    }
    for (const WayField& way : kWayFields) {
        for (const AnswerField& field : kAnswerFields) {
            if (!profile.answer_costs) break;
            const std::string name = std::string("\"") + field.name + "\" of \"" + way.name + "\"";
            const double value = ((*profile.answer_costs).*way.value).*field.value;
            if (Status status = check_constant(name, value); !status) return status;
        }
    }
    if (profile.hold_out_error) {
        if (Status status = check_constant("\"hold_out_error\"", *profile.hold_out_error); !status)
            return status;
    }
    if (Status status = check_finite("\"r_squared\"", profile.r_squared); !status) return status;
    for (const PercentileField& field : kPercentileFields) {
        if (!profile.residuals) break;
        const std::string name = std::string("the residual percentile \"") + field.name + "\"";
        if (Status status = check_finite(name, (*profile.residuals).*field.value); !status) return status;
    }
    return success();
}

Result<TimingProfile> load_profile(const std::filesystem::path& file) {
    const std::string name = file.string();
    std::error_code problem;
    if (!std::filesystem::exists(file, problem))
        return Error{name + ": there is no such file; check the path"};
    if (std::filesystem::is_directory(file, problem))
        return Error{name + ": this is a folder; name a profile file"};
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return Error{name + ": the file cannot be opened; check its permissions"};
    std::string text;
    std::array<char, 4096> block{};
    while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
        text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
        if (text.size() > kLargestFile)
            return Error{name + ": too large for a timing profile (1 MiB at most); name a profile file"};
    }
    if (stream.bad()) return Error{name + ": the file cannot be read to its end; check the disk"};
    return parse_profile(text, name);
}

Status save_profile(const TimingProfile& profile, const std::filesystem::path& file) {
    const std::string name = file.string();
    if (const Status status = validate(profile); !status) return Error{name + ": " + status.error().message};
    Result<ReplacementFile> replacement = ReplacementFile::create(file);
    if (!replacement) return replacement.error();
    replacement->write(profile_text(profile));
    return replacement->commit();
}

}  // namespace rhview
