// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "occlusion_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "rhview/gl/answer_costs.h"
#include "rhview/gl/render_target.h"

namespace rhview::cli {

Result<std::optional<OcclusionOptions>> choose_occlusion(const WalkOptions& options,
                                                         const WantedConstants& wanted,
                                                         const std::optional<UserConstants>& constants,
                                                         PictureSize size, std::string& why_not) {
    std::optional<OcclusionOptions> occlusion;
    if (options.occlusion == "off") return occlusion;
    if (!constants) {
        why_not = "what drawing costs is not known";
        return occlusion;
    }
    std::optional<QueryCosts> costs = query_costs(wanted, *constants);
    if (!costs && wanted.are_complete()) {
        why_not = "what a query costs is not set (--set query=… or box=…, in ns)";
        if (options.occlusion == "auto" && options.mode == "exact") return occlusion;
        return Error{fmt::format("--occlusion {} --mode {}: {}", options.occlusion, options.mode, why_not)};
    }
    if (!costs) {
        Result<gl::RenderTarget> target = gl::RenderTarget::create(size.width, size.height);
        if (!target) return Error{"--size: " + target.error().message};
        const Result<gl::MeasuredAnswerCosts> measured =
            gl::measure_answer_costs(*target, {.longest_s = kQuickAnswersS});
        if (!measured) return measured.error();
        costs = measured->costs;
    }
    const double never = std::numeric_limits<double>::infinity();
    if (options.occlusion == "hardware") costs->box_pass = {.query_ns = never};
    if (options.occlusion == "boxes") costs->hardware = {.query_ns = never};
    if (!(std::min(costs->hardware.query_ns, costs->box_pass.query_ns) < never))
        return Error{fmt::format("--occlusion {}: --set gives it no price; set {}", options.occlusion,
                                 options.occlusion == "boxes" ? "box" : "query")};
    occlusion.emplace();
    occlusion->costs = *costs;
    occlusion->settings.mode = options.mode == "latent" ? OcclusionMode::Latent : OcclusionMode::Exact;
    occlusion->counts_samples = options.lod_policy == "fragments";
    occlusion->settings.visible_samples = std::max(1u, options.visible_pixels);
    occlusion->shown_index_ns =
        constants->profile.c1_ns + constants->profile.primitive_ns.value_or(0.0) / 3.0;
    return occlusion;
}

}  // namespace rhview::cli
