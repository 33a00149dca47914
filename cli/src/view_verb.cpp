// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "output_file.h"
#include "rhview/gl/timer.h"
#include "verbs.h"
#include "view_panels.h"
#include "view_session.h"
#include "view_window.h"

namespace rhview::cli {
namespace {

/// A longer frame doesn't fly further: what took so long was no flight.
constexpr double kLongestStep_s = 0.25;

Result<std::vector<ScriptLine>> read_script(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in || !text) return Error{file.string() + ": the script can't be read; check the path"};
    return parse_view_script(text.str(), file.string());
}

/// Window, session and, where there is one, the script that takes the place of keys and mouse.
class ViewLoop {
  public:
    ViewLoop(const ViewOptions& options, ViewWindow& window, ViewSession& session,
             std::vector<ScriptLine> script)
        : options_(options), window_(window), session_(session), script_(std::move(script)) {}

    Status run() {
        while (!quits_ && !window_.wants_to_close()) {
            const ViewInput input = window_.take_input();
            if (Status status = follow_size(); !status) return status;
            if (Status status = options_.script ? follow_script() : follow_input(input); !status)
                return status;
            if (quits_) break;
            if (Status status = draw(); !status) return status;
        }
        return session_.run({ViewVerb::Stop, {}, 0.0, 0.0, 0, {}});
    }

  private:
    Status follow_size() {
        const PictureSize size = window_.size(), drawn = session_.ground().size;
        if (size.width < 1 || size.height < 1 || (size.width == drawn.width && size.height == drawn.height))
            return success();
        return session_.resize(size);
    }

    Status follow_input(const ViewInput& input) {
        held_ = input.held;
        session_.turn(input.right_px, input.down_px);
        if (input.wheel != 0.0) session_.scale_speed(std::pow(1.25, input.wheel));
        for (const std::string& key : input.tapped) tell_or_show(*command_of_key(key));
        for (const std::filesystem::path& file : input.dropped)
            tell_or_show({ViewVerb::Open, file.string(), 0.0, 0.0, 0, {}});
        return success();
    }

    /// People see what went wrong, and go on.
    void tell_or_show(const ViewCommand& command) {
        if (const Status status = tell(command); !status) session_.say("error: " + status.error().message);
    }

    /// Up to the next command that lets time pass.
    Status follow_script() {
        if (waits_ > 0) {
            --waits_;
            return success();
        }
        held_ = 0;
        while (next_ < script_.size()) {
            const ScriptLine& line = script_[next_++];
            if (const Status status = tell(line.command); !status)
                return Error{fmt::format("{}, line {}: {}", options_.script->string(), line.line,
                                         status.error().message)};
            if (quits_ || waits_ > 0 || screenshot_) break;
        }
        if (waits_ > 0)
            --waits_;
        else if (!screenshot_)
            quits_ = true;
        return success();
    }

    Status tell(const ViewCommand& command) {
        switch (command.verb) {
            case ViewVerb::Frames:
                waits_ = command.frames;
                return success();
            case ViewVerb::Hold:
                waits_ = command.frames;
                held_ = movements(command.text);
                return success();
            case ViewVerb::Key: {
                const std::optional<ViewCommand> meant = command_of_key(command.text);
                if (!meant) return Error{fmt::format("there is no key '{}'", command.text)};
                return tell(*meant);
            }
            case ViewVerb::Panels:
                panels_ = command.on.value_or(!panels_);
                return success();
            case ViewVerb::Screenshot:
                screenshot_ = command.text.empty() ? new_file(options_.folder, "rhview", "png")
                                                   : std::filesystem::path(command.text);
                return success();
            case ViewVerb::Quit:
                quits_ = true;
                return success();
            case ViewVerb::Method:
            case ViewVerb::Open:
                window_.set_title(fmt::format("rhview: {} …", command.text));
                break;
            default:
                break;
        }
        const Status status = session_.run(command);
        window_.set_title("rhview: " + session_.options().scene);
        return status;
    }

    static std::uint32_t movements(const std::string& keys) {
        std::uint32_t held = 0;
        std::istringstream names(keys);
        for (std::string name; std::getline(names, name, ',');) held |= movement_of_key(name);
        return held;
    }

    Status draw() {
        const double step_s =
            options_.script ? ViewSession::kStep_s : std::min(1e-3 * clock_.elapsed_ms(), kLongestStep_s);
        clock_ = gl::WallTimer();
        if (Status status = session_.draw(held_, step_s); !status) return status;
        session_.show();
        std::vector<ViewCommand> chosen;
        window_.begin_panels();
        if (panels_) make_panels(session_, chosen);
        window_.draw_panels();
        if (screenshot_) {
            const std::filesystem::path file = *std::exchange(screenshot_, {});
            const PictureSize size = session_.ground().size;
            const Status status = gl::read_window(size.width, size.height).save_png(file);
            if (!status && options_.script) return status;
            session_.say(status ? "screenshot " + file.string() : "error: " + status.error().message);
        }
        window_.present();
        for (const ViewCommand& command : chosen) tell_or_show(command);
        return gl::check_device();
    }

    const ViewOptions& options_;
    ViewWindow& window_;
    ViewSession& session_;
    std::vector<ScriptLine> script_;
    std::size_t next_ = 0;
    int waits_ = 0;  ///< frames, before the script goes on
    std::uint32_t held_ = 0;
    bool panels_ = true;
    bool quits_ = false;
    std::optional<std::filesystem::path> screenshot_;
    gl::WallTimer clock_;
};

}  // namespace

Result<int> run_view(const ViewOptions& options) {
    const Result<WalkWishes> wishes = parse_wishes(options.walk);
    if (!wishes) return wishes.error();
    std::vector<ScriptLine> script;
    if (options.script) {
        Result<std::vector<ScriptLine>> read = read_script(*options.script);
        if (!read) return read.error();
        script = std::move(read).value();
    }
    if (Status status = prepare_folder(options.folder); !status) return status.error();
    Result<ViewWindow> window = ViewWindow::create("rhview: " + options.walk.scene, wishes->size);
    if (!window) return window.error();
    Result<std::unique_ptr<ViewSession>> session = ViewSession::create(options);
    if (!session) return session.error();
    ViewLoop loop(options, *window, **session, std::move(script));
    if (Status status = loop.run(); !status) return status.error();
    const std::string error = gl::take_error();
    session->reset();  // before the window, whose context it needs
    if (!error.empty()) return Error{"OpenGL reported: " + error};
    return kDone;
}

}  // namespace rhview::cli
