// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// The only file that knows EGL.

#include "rhview/gl/context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <utility>
#include <vector>

#include "box_pass.h"
#include "rhview/base/log.h"
#include "state_guard.h"

namespace rhview::gl {
namespace {

constexpr int kMinimumVersion = 43;

struct Candidate {
    EGLDisplay display = EGL_NO_DISPLAY;
    std::string name;
};

bool has_client_extension(const char* name) {
    return epoxy_has_egl_extension(EGL_NO_DISPLAY, name);
}

/// Displays that need no window system: each device, then Mesa's surfaceless platform, then the default one.
std::vector<Candidate> headless_displays() {
    std::vector<Candidate> candidates;
    const bool platform = has_client_extension("EGL_EXT_platform_base");
    if (platform && has_client_extension("EGL_EXT_platform_device") &&
        (has_client_extension("EGL_EXT_device_enumeration") || has_client_extension("EGL_EXT_device_base"))) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count)) {
            for (EGLint i = 0; i < count; ++i)
                candidates.push_back({eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT,
                                                               devices[static_cast<std::size_t>(i)], nullptr),
                                      "EGL device " + std::to_string(i)});
        }
    }
    if (platform && has_client_extension("EGL_MESA_platform_surfaceless"))
        candidates.push_back(
            {eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
             "EGL surfaceless"});
    if (candidates.empty()) candidates.push_back({eglGetDisplay(EGL_DEFAULT_DISPLAY), "EGL default display"});
    return candidates;
}

/// `told`: a reset of the device is told (`check_device`).
EGLContext create_context(EGLDisplay display, int version, bool debug, bool told) {
    EGLConfig config = EGL_NO_CONFIG_KHR;
    if (!epoxy_has_egl_extension(display, "EGL_KHR_no_config_context")) {
        const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                 EGL_NONE};
        EGLint count = 0;
        if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) return EGL_NO_CONTEXT;
    }
    std::vector<EGLint> attributes;
    if (version > 0) {
        attributes = {EGL_CONTEXT_MAJOR_VERSION,       version / 10,
                      EGL_CONTEXT_MINOR_VERSION,       version % 10,
                      EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
        if (debug) attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE});
        if (told)
            attributes.insert(attributes.end(),
                              {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
    }
    attributes.push_back(EGL_NONE);
    return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

void APIENTRY forward_to_log(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
                             const void*) {
    LogLevel level = LogLevel::Debug;
    if (type == GL_DEBUG_TYPE_ERROR)
        level = LogLevel::Error;
    else if (severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM)
        level = LogLevel::Warning;
    log(level,
        length >= 0 ? std::string_view(text, static_cast<std::size_t>(length)) : std::string_view(text));
}

std::string gl_text(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

void forward_debug_messages() {
    glEnable(GL_DEBUG_OUTPUT);
    glDebugMessageCallback(forward_to_log, nullptr);
}

bool has_reset_status() {
    return epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_KHR_robustness");
}

DeviceInfo describe_device() {
    DeviceInfo info;
    info.renderer = gl_text(GL_RENDERER);
    info.version = gl_text(GL_VERSION);
    for (const char* software : {"llvmpipe", "softpipe", "swrast", "SWR", "SwiftShader"})
        if (info.renderer.find(software) != std::string::npos) info.software = true;
    info.clip_control = has_clip_control();
    info.box_pass = BoxPass::is_available();
    GLint strategy = GL_NO_RESET_NOTIFICATION;
    if (has_reset_status()) glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
    info.tells_loss = strategy == GL_LOSE_CONTEXT_ON_RESET;
    return info;
}

}  // namespace

struct Context::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    DeviceInfo device;

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (context != EGL_NO_CONTEXT) {  // an adopted one is not ours
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            eglDestroyContext(display, context);
        }
    }

    /// Makes a context of `candidate` current. `found` says what was there when it could not.
    bool open(const Candidate& candidate, bool debug, std::string& found) {
        display = candidate.display;
        if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr) ||
            !eglBindAPI(EGL_OPENGL_API)) {
            found = candidate.name + " has no OpenGL";
            return false;
        }
        for (const auto& [version, told] :
             {std::pair{45, true}, {45, false}, {kMinimumVersion, false}, {0, false}}) {
            context = create_context(display, version, debug, told);
            if (context == EGL_NO_CONTEXT) continue;
            if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) break;
            eglDestroyContext(display, context);
            context = EGL_NO_CONTEXT;
        }
        if (context == EGL_NO_CONTEXT) {
            found = candidate.name + " gives no OpenGL context";
            return false;
        }
        device = describe_device();
        if (epoxy_gl_version() < kMinimumVersion) {
            found = candidate.name + " has OpenGL " + device.version + " on " + device.renderer;
            return false;
        }
        return true;
    }
};

Context::Context(std::unique_ptr<State> state) : state_(std::move(state)) {}
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

const DeviceInfo& Context::device() const {
    return state_->device;
}

Result<Context> Context::create_headless(const ContextOptions& options) {
    // libepoxy ends the process when it can't find the library; ask first.
    void* library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr)
        return Error{"no EGL library (libEGL.so.1) was found; install libegl1 and a driver"};
    dlclose(library);

    std::unique_ptr<State> best;
    std::string failures;
    for (const Candidate& candidate : headless_displays()) {
        auto state = std::make_unique<State>();
        std::string found;
        if (!state->open(candidate, options.debug, found)) {
            failures += (failures.empty() ? "" : "; ") + found;
            continue;
        }
        const bool hardware = !state->device.software;
        if (best == nullptr || hardware) best = std::move(state);
        if (hardware) break;
    }
    if (best == nullptr)
        return Error{"OpenGL 4.3 or newer without a window is needed, and there is none (" + failures +
                     "); install a driver, libgl1-mesa-dri for example"};
    eglMakeCurrent(best->display, EGL_NO_SURFACE, EGL_NO_SURFACE, best->context);
    forward_debug_messages();
    return Context(std::move(best));
}

Result<Context> Context::adopt_current() {
    // Without a current context libepoxy ends the process at the first call.
    void* library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    const bool current = library != nullptr && eglGetCurrentContext() != EGL_NO_CONTEXT;
    if (library != nullptr) dlclose(library);
    if (!current) return Error{"no EGL context is current on this thread; make the window's context current"};
    auto state = std::make_unique<State>();
    state->device = describe_device();
    if (epoxy_gl_version() < kMinimumVersion)
        return Error{"OpenGL 4.3 or newer is needed; the window has " + state->device.version + " on " +
                     state->device.renderer};
    forward_debug_messages();
    return Context(std::move(state));
}

std::string describe_reset(unsigned status) {
    constexpr const char* kMend = "; make the context and everything in it anew";
    switch (status) {
        case GL_NO_ERROR:
            return {};
        case GL_GUILTY_CONTEXT_RESET:
            return std::string("the graphics device was reset because of what this context drew") + kMend;
        case GL_INNOCENT_CONTEXT_RESET:
            return std::string("the graphics device was reset because of another program") + kMend;
        default:
            return std::string("the graphics device was reset") + kMend;
    }
}

Status check_device() {
    if (!has_reset_status()) return success();
    const GLenum status =
        epoxy_gl_version() >= 45 ? glGetGraphicsResetStatus() : glGetGraphicsResetStatusKHR();
    if (status != GL_NO_ERROR) return Error{describe_reset(status)};
    return success();
}

void finish() {
    glFinish();
}

std::string take_error() {
    const GLenum first = glGetError();
    // A lost context reports its loss for ever.
    for (GLenum next = first; next != GL_NO_ERROR && next != GL_CONTEXT_LOST;) next = glGetError();
    switch (first) {
        case GL_NO_ERROR:
            return {};
        case GL_OUT_OF_MEMORY:
            return "out of memory";
        case GL_INVALID_ENUM:
            return "invalid enum";
        case GL_INVALID_VALUE:
            return "invalid value";
        case GL_INVALID_OPERATION:
            return "invalid operation";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "invalid framebuffer operation";
        case GL_CONTEXT_LOST:
            return "context lost";
        default:
            return "error " + std::to_string(first);
    }
}

}  // namespace rhview::gl
