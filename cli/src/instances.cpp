// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "instances.h"

#include <fmt/format.h>

namespace rhview::cli {
namespace {

std::optional<InstancePolicy> policy_of(const std::string& text) {
    if (text == "auto") return InstancePolicy::Auto;
    if (text == "flatten") return InstancePolicy::Flatten;
    if (text == "keep") return InstancePolicy::Keep;
    return std::nullopt;
}

/// Each instance is a call of its own and sets its material and place.
InstanceCosts costs_of(const TimingProfile& profile) {
    return {profile.c1_ns,
            profile.c3_ns + profile.sub_draw_ns.value_or(0.0) + profile.material_ns.value_or(0.0)};
}

}  // namespace

Status check_instances(const InstancesWanted& wanted) {
    if (policy_of(wanted.policy)) return success();
    return Error{fmt::format("--instances {}: unknown; write auto, flatten or keep", wanted.policy)};
}

Status settle_instances(LoadedScene& loaded, const std::string& spec, const InstancesWanted& wanted,
                        const std::optional<UserConstants>& constants) {
    if (loaded.baked) {
        if (wanted.policy == "auto" && !wanted.budget_mib) return success();
        return Error{fmt::format(
            "--instance{}: {} was baked with its instances settled; bake its source again with that option",
            wanted.policy == "auto" ? "-budget" : "s", spec)};
    }
    InstanceOptions options;
    options.policy = policy_of(wanted.policy).value_or(InstancePolicy::Auto);
    if (constants) options.costs = costs_of(constants->profile);
    if (wanted.budget_mib)
        options.budget_bytes = static_cast<std::uint64_t>(*wanted.budget_mib * 1024.0 * 1024.0);
    return rhview::settle_instances(loaded.scene, options);
}

}  // namespace rhview::cli
