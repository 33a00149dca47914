// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include "view_panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "method.h"

namespace rhview::cli {
namespace {

constexpr float kMargin = 8.0f;
constexpr float kWidth = 350.0f;
constexpr float kPlotWidth = 300.0f;
constexpr float kPlotHeight = 54.0f;
constexpr ImU32 kMeasured = IM_COL32(255, 200, 60, 255);
constexpr ImU32 kPredicted = IM_COL32(90, 200, 255, 255);
const ImVec4 kWarning(1.0f, 0.6f, 0.3f, 1.0f);

using Commands = std::vector<ViewCommand>;

void tell(Commands& commands, ViewVerb verb, std::string text = {}, double x = 0.0) {
    commands.push_back({verb, std::move(text), x, 0.0, 0, {}});
}

void choose(const char* label, const std::string& now, const std::vector<std::string>& names, ViewVerb verb,
            Commands& commands) {
    if (!ImGui::BeginCombo(label, now.c_str())) return;
    for (const std::string& name : names)
        if (ImGui::Selectable(name.c_str(), name == now) && name != now) tell(commands, verb, name);
    ImGui::EndCombo();
}

void make_scene_panel(const ViewSession& session) {
    const Scene& scene = session.ground().loaded.scene;
    ImGui::Text("%s", session.options().scene.c_str());
    ImGui::Text("%.2f M triangles, %zu batches, %zu objects",
                1e-6 * static_cast<double>(scene.static_triangles() + scene.dynamic_triangles()),
                scene.batches.size(), scene.object_count());
    ImGui::TextDisabled("%s", session.ground().context.device().renderer.c_str());
    ImGui::TextDisabled("drop a scene file on the window to open it");
}

void make_method_panel(const ViewSession& session, Commands& commands) {
    const WalkOptions& options = session.options();
    choose("method", options.method, method_names(), ViewVerb::Method, commands);
    if (options.method == "rhview") {
        choose("mode", options.mode, {"exact", "latent"}, ViewVerb::Mode, commands);
        choose("occlusion", options.occlusion, {"auto", "hardware", "boxes", "off"}, ViewVerb::Occlusion,
               commands);
    } else if (options.method == "rhview-seed") {
        choose("occlusion", options.occlusion, {"auto", "hardware", "off"}, ViewVerb::Occlusion, commands);
    }
    choose("submission", options.submission, {"plain", "multi"}, ViewVerb::Submission, commands);
    if (session.method().octree)
        ImGui::Text("octree: %zu nodes, %zu replicas", session.method().octree->nodes().size(),
                    session.method().octree->replicas().size());
}

void make_price(const char* label, double value_ns, float least, float most, ViewVerb verb,
                Commands& commands) {
    auto value = static_cast<float>(value_ns);
    if (ImGui::SliderFloat(label, &value, least, most, "%.3g", ImGuiSliderFlags_Logarithmic))
        tell(commands, verb, {}, static_cast<double>(value));
}

void make_price_panel(const ViewSession& session, Commands& commands) {
    const std::optional<UserConstants>& constants = session.ground().chosen.constants;
    if (!constants) ImGui::TextColored(kWarning, "prices are unknown: set them");
    make_price("c1, ns an index", constants ? constants->profile.c1_ns : 0.0, 0.001f, 100.0f,
               ViewVerb::IndexPrice, commands);
    make_price("c3, ns a draw call", constants ? constants->profile.c3_ns : 0.0, 1.0f, 1e6f,
               ViewVerb::DrawPrice, commands);
    if (!session.is_stale()) return;
    ImGui::TextColored(kWarning, "octree of other prices");
    ImGui::SameLine();
    if (ImGui::SmallButton("build again")) tell(commands, ViewVerb::Rebuild);
}

/// Of scenes that have levels.
void make_level_panel(const ViewSession& session, Commands& commands) {
    if (session.ground().chains.empty()) return;
    make_price("LoD error, px", session.options().lod_error_px, 0.01f, 64.0f, ViewVerb::LodError, commands);
    auto budget = static_cast<float>(session.options().budget_ms.value_or(0.0));
    if (ImGui::SliderFloat("budget, ms", &budget, 0.0f, 200.0f, budget > 0.0f ? "%.1f" : "none"))
        tell(commands, ViewVerb::Budget, {}, static_cast<double>(budget));
    ImGui::Separator();
}

void make_camera_panel(ViewSession& session, Commands& commands) {
    if (ImGui::Button(session.is_frozen() ? "let go (F)" : "freeze (F)")) tell(commands, ViewVerb::Freeze);
    ImGui::SameLine();
    if (ImGui::Button("outside (O)")) tell(commands, ViewVerb::Outside);
    ImGui::SameLine();
    if (ImGui::Button("back (B)")) tell(commands, ViewVerb::Back);
    bool colours = session.shows_colours();
    if (ImGui::Checkbox("colours (C)", &colours)) tell(commands, ViewVerb::Colours);
    ImGui::Checkbox("rest", &session.marks.rest);
    ImGui::SameLine();
    ImGui::Checkbox("gaps", &session.marks.gaps);
    ImGui::SameLine();
    ImGui::Checkbox("boxes", &session.marks.boxes);
    ImGui::SameLine();
    ImGui::Checkbox("frustum", &session.marks.frustum);
    const std::optional<std::size_t> recorded = session.recorded_frames();
    const auto replayed = session.replayed_frames();
    if (ImGui::Button(recorded ? "stop (R)" : "record (R)")) tell(commands, ViewVerb::Record);
    ImGui::SameLine();
    if (ImGui::Button(replayed ? "stop (P)" : "replay (P)")) tell(commands, ViewVerb::Replay);
    ImGui::SameLine();
    if (ImGui::Button("screenshot (F12)")) tell(commands, ViewVerb::Screenshot);
    if (recorded) ImGui::TextColored(kWarning, "recording, frame %zu", *recorded);
    if (replayed)
        ImGui::TextColored(kWarning, "replaying, frame %d of %d", replayed->first, replayed->second);
    const glm::dvec3& eye = session.camera().eye();
    ImGui::TextDisabled("eye %.1f %.1f %.1f, speed %.3g", eye.x, eye.y, eye.z, session.camera().speed);
}

/// One or two lines over the frames remembered, from 0 to their greatest value.
template <class Field, class Other>
void plot(const char* name, const char* unit, const std::vector<FrameRecord>& frames, Field field,
          Other other) {
    const auto number = [](const std::optional<double>& v) { return v ? fmt::format("{:.4g}", *v) : "-"; };
    std::string title = fmt::format("{} {} {}", name, number(field(frames.back())), unit);
    if (other(frames.back())) title += fmt::format(", predicted {} {}", number(other(frames.back())), unit);
    double greatest = 1e-9;
    for (const FrameRecord& frame : frames)
        greatest = std::max({greatest, field(frame).value_or(0.0), other(frame).value_or(0.0)});
    ImGui::TextUnformatted(title.c_str());
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, kPlotHeight);
    ImGui::Dummy(size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, IM_COL32(0, 0, 0, 110));
    const auto line = [&](auto value_of, ImU32 colour) {
        std::vector<ImVec2> points;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const std::optional<double> value = value_of(frames[i]);
            if (!value) continue;
            const float x = static_cast<float>(i) / static_cast<float>(ViewSession::kRemembered - 1);
            points.push_back({corner.x + x * size.x,
                              corner.y + size.y * (1.0f - 0.95f * static_cast<float>(*value / greatest))});
        }
        list.AddPolyline(points.data(), static_cast<int>(points.size()), colour, ImDrawFlags_None, 1.5f);
    };
    line(other, kPredicted);
    line(field, kMeasured);
    list.AddText({corner.x + size.x - 50.0f, corner.y + 1.0f}, IM_COL32(255, 255, 255, 120),
                 fmt::format("{:.4g}", greatest).c_str());
}

void make_plots(const ViewSession& session) {
    const std::vector<FrameRecord>& frames = session.history();
    if (frames.empty()) return;
    using Value = std::optional<double>;
    const auto nothing = [](const FrameRecord&) { return Value(); };
    plot(
        "frame", "ms", frames, [](const FrameRecord& f) { return Value(f.frame_ms); },
        [](const FrameRecord& f) { return f.predicted_ms; });
    plot(
        "planning", "ms", frames, [](const FrameRecord& f) { return Value(f.cull_ms); }, nothing);
    plot(
        "draw calls", "", frames, [](const FrameRecord& f) { return Value(f.work.draw_calls); }, nothing);
    plot(
        "indices", "M", frames, [](const FrameRecord& f) { return Value(1e-6 * f.work.indices); }, nothing);
    plot(
        "queries", "", frames, [](const FrameRecord& f) { return Value(f.work.queries); }, nothing);
    const FrameRecord& last = frames.back();
    if (!session.ground().chains.empty())
        ImGui::Text("%llu objects, levels off by %.2f px at most",
                    static_cast<unsigned long long>(last.visible_objects), last.lod_error_px);
    if (last.occlusion)
        ImGui::Text("%llu boxes, %llu queries saw nothing",
                    static_cast<unsigned long long>(last.occlusion->boxes),
                    static_cast<unsigned long long>(last.occlusion->hidden));
}

struct LegendEntry {
    ImU32 colour;
    const char* text;
};

void make_legend(const ViewSession& session) {
    if (!session.is_frozen() && !session.shows_colours()) return;
    const bool asks = !session.plan().queries.empty();
    const std::array entries{
        LegendEntry{IM_COL32(255, 140, 25, 255), "drawn from the base order, a colour a call"},
        LegendEntry{IM_COL32(13, 140, 185, 255), "drawn from replicas"},
        LegendEntry{IM_COL32(178, 25, 217, 255), "bridged gaps"},
        LegendEntry{IM_COL32(128, 130, 135, 255), "not drawn"},
        LegendEntry{IM_COL32(25, 64, 191, 255), asks ? "asked about: nothing seen" : "chosen nodes"},
        LegendEntry{IM_COL32(0, 158, 51, 255), "asked about: seen"},
        LegendEntry{IM_COL32(217, 0, 64, 255), "frustum of the frozen camera"},
    };
    if (!session.ground().chains.empty())
        ImGui::TextUnformatted("objects by level: finest red, coarser to violet");
    for (const LegendEntry& entry : entries) {
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const float side = ImGui::GetTextLineHeight();
        ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + side, corner.y + side}, entry.colour);
        ImGui::Dummy({side, side});
        ImGui::SameLine();
        ImGui::TextUnformatted(entry.text);
    }
}

void make_keys() {
    for (const KeyHelp& line : key_help()) {
        ImGui::TextUnformatted(line.key);
        ImGui::SameLine(80.0f);
        ImGui::TextDisabled("%s", line.what);
    }
}

}  // namespace

void make_panels(ViewSession& session, Commands& commands) {
    constexpr ImGuiWindowFlags kFixed =
        ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({kMargin, kMargin}, ImGuiCond_Always);
    ImGui::SetNextWindowSizeConstraints({kWidth, 0.0f}, {kWidth, display.y - 2.0f * kMargin});
    ImGui::Begin("rhview", nullptr, kFixed | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushItemWidth(0.5f * kWidth);
    make_scene_panel(session);
    ImGui::Separator();
    make_method_panel(session, commands);
    ImGui::Separator();
    make_price_panel(session, commands);
    ImGui::Separator();
    make_level_panel(session, commands);
    make_camera_panel(session, commands);
    make_legend(session);
    if (ImGui::CollapsingHeader("keys")) make_keys();
    if (!session.message().empty()) ImGui::TextWrapped("%s", session.message().c_str());
    ImGui::PopItemWidth();
    ImGui::End();

    ImGui::SetNextWindowPos({display.x - kPlotWidth - kMargin, kMargin}, ImGuiCond_Always);
    ImGui::SetNextWindowSize({kPlotWidth, 0.0f}, ImGuiCond_Always);
    ImGui::Begin("frames", nullptr, kFixed);
    make_plots(session);
    ImGui::End();
}

}  // namespace rhview::cli
