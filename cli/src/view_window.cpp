// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The only file that knows GLFW and Dear ImGui's back ends.

#include "view_window.h"

#include <fmt/format.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <array>
#include <utility>

#include "view_camera.h"
#include "view_command.h"

namespace rhview::cli {
namespace {

struct NamedKey {
    int code;
    const char* name;
};

constexpr std::array kKeys{
    NamedKey{GLFW_KEY_W, "W"},
    NamedKey{GLFW_KEY_S, "S"},
    NamedKey{GLFW_KEY_A, "A"},
    NamedKey{GLFW_KEY_D, "D"},
    NamedKey{GLFW_KEY_E, "E"},
    NamedKey{GLFW_KEY_Q, "Q"},
    NamedKey{GLFW_KEY_F, "F"},
    NamedKey{GLFW_KEY_O, "O"},
    NamedKey{GLFW_KEY_B, "B"},
    NamedKey{GLFW_KEY_C, "C"},
    NamedKey{GLFW_KEY_R, "R"},
    NamedKey{GLFW_KEY_P, "P"},
    NamedKey{GLFW_KEY_F12, "F12"},
    NamedKey{GLFW_KEY_TAB, "Tab"},
    NamedKey{GLFW_KEY_ESCAPE, "Escape"},
    NamedKey{GLFW_KEY_LEFT_SHIFT, "shift"},
    NamedKey{GLFW_KEY_RIGHT_SHIFT, "shift"},
};

const char* name_of(int code) {
    for (const NamedKey& key : kKeys)
        if (key.code == code) return key.name;
    return "";
}

std::string last_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "no reason given";
}

}  // namespace

struct ViewWindow::State {
    GLFWwindow* window = nullptr;
    bool has_panels = false;
    ViewInput input;
    bool dragging = false;
    double mouse_x = 0.0, mouse_y = 0.0;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (has_panels) {
            ImGui_ImplOpenGL3_Shutdown();
            ImGui_ImplGlfw_Shutdown();
            ImGui::DestroyContext();
        }
        if (window != nullptr) glfwDestroyWindow(window);
        glfwTerminate();
    }

    static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }

    void listen() {
        glfwSetWindowUserPointer(window, this);
        glfwSetKeyCallback(window, [](GLFWwindow* w, int code, int, int action, int) {
            const std::uint32_t movement = movement_of_key(name_of(code));
            ViewInput& told = of(w).input;
            if (action == GLFW_RELEASE) {
                told.held &= ~movement;
            } else if (!ImGui::GetIO().WantCaptureKeyboard) {
                told.held |= movement;
                if (action == GLFW_PRESS && command_of_key(name_of(code)))
                    told.tapped.emplace_back(name_of(code));
            }
        });
        glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int, int action, int) {
            // Where the mouse is comes from its own events: asked now, the answer may be of a later one.
            of(w).dragging = action == GLFW_PRESS && !ImGui::GetIO().WantCaptureMouse;
        });
        glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
            State& state = of(w);
            if (state.dragging) {
                state.input.right_px += x - state.mouse_x;
                state.input.down_px += y - state.mouse_y;
            }
            state.mouse_x = x;
            state.mouse_y = y;
        });
        glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) {
            if (!ImGui::GetIO().WantCaptureMouse) of(w).input.wheel += y;
        });
        glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** names) {
            for (int i = 0; i < count; ++i) of(w).input.dropped.emplace_back(names[i]);
        });
        // Keys that are released elsewhere are never told.
        glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { of(w).input.held = 0; });
    }

    /// ImGui calls the callbacks of `listen` after its own.
    bool make_panels() {
        IMGUI_CHECKVERSION();
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;
        ImGui::StyleColorsDark();
        ImGui::GetStyle().WindowRounding = 4.0f;
        ImGui::GetStyle().Colors[ImGuiCol_WindowBg].w = 0.85f;
        if (!ImGui_ImplGlfw_InitForOpenGL(window, true)) return false;
        if (!ImGui_ImplOpenGL3_Init("#version 430 core")) {
            ImGui_ImplGlfw_Shutdown();
            ImGui::DestroyContext();
            return false;
        }
        has_panels = true;
        return true;
    }
};

ViewWindow::ViewWindow(std::unique_ptr<State> state) : state_(std::move(state)) {}
ViewWindow::ViewWindow(ViewWindow&&) noexcept = default;
ViewWindow& ViewWindow::operator=(ViewWindow&&) noexcept = default;
ViewWindow::~ViewWindow() = default;

Result<ViewWindow> ViewWindow::create(const std::string& title, PictureSize size) {
    if (glfwInit() != GLFW_TRUE)
        return Error{fmt::format(
            "no window can be opened ({}); set DISPLAY, or use rhview walk, which needs none", last_error())};
    auto state = std::make_unique<State>();
    for (const auto& [major, minor] : {std::pair{4, 5}, {4, 3}}) {
        glfwDefaultWindowHints();
        glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
        state->window = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
        if (state->window != nullptr) break;
    }
    if (state->window == nullptr)
        return Error{
            fmt::format("the window has no OpenGL 4.3 ({}); install a driver, libgl1-mesa-dri for example",
                        last_error())};
    glfwMakeContextCurrent(state->window);
    glfwSwapInterval(0);  // frames are as long as they take
    state->listen();
    if (!state->make_panels()) return Error{"the panels can't be made: Dear ImGui refuses this OpenGL"};
    return ViewWindow(std::move(state));
}

PictureSize ViewWindow::size() const {
    PictureSize size;
    glfwGetFramebufferSize(state_->window, &size.width, &size.height);
    return size;
}

bool ViewWindow::wants_to_close() const {
    return glfwWindowShouldClose(state_->window) == GLFW_TRUE;
}

ViewInput ViewWindow::take_input() {
    glfwPollEvents();
    const std::uint32_t held = state_->input.held;
    return std::exchange(state_->input, ViewInput{held, 0.0, 0.0, 0.0, {}, {}});
}

void ViewWindow::set_title(const std::string& title) {
    glfwSetWindowTitle(state_->window, title.c_str());
}

void ViewWindow::begin_panels() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void ViewWindow::draw_panels() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void ViewWindow::present() {
    glfwSwapBuffers(state_->window);
}

}  // namespace rhview::cli
