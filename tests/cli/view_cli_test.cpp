// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT
//
// Drives `rhview view` in a virtual display and looks at its screenshots.

#include <signal.h>
#include <unistd.h>

#include <cstdint>
#include <set>

#include "program.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace rhview::cli {
namespace {

/// An X server without a screen, on a display number of its own; one for all tests.
class VirtualDisplay {
  public:
    VirtualDisplay() {
        int told[2];
        if (pipe(told) != 0) return;
        server_ = fork();
        if (server_ == 0) {
            dup2(told[1], 3);
            for (const int stream : {0, 1, 2})
                if (std::freopen("/dev/null", "r+",
                                 stream == 0   ? stdin
                                 : stream == 1 ? stdout
                                               : stderr) == nullptr)
                    _exit(126);
            execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "1024x768x24", "-nolisten", "tcp",
                   static_cast<char*>(nullptr));
            _exit(127);
        }
        close(told[1]);
        for (char c = 0; read(told[0], &c, 1) == 1 && c != '\n';) number_ += c;
        close(told[0]);
    }
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;
    ~VirtualDisplay() {
        if (server_ <= 0) return;
        kill(server_, SIGTERM);
        waitpid(server_, nullptr, 0);
    }

    /// Empty: there is none.
    [[nodiscard]] std::string name() const { return number_.empty() ? "" : ":" + number_; }

  private:
    pid_t server_ = -1;
    std::string number_;
};

struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;

    [[nodiscard]] std::uint32_t at(int x, int y) const {
        const std::size_t i = 3 * static_cast<std::size_t>(y * width + x);
        return rgb[i] | rgb[i + 1] << 8 | rgb[i + 2] << 16;
    }
    [[nodiscard]] std::size_t colours() const {
        std::set<std::uint32_t> seen;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) seen.insert(at(x, y));
        return seen.size();
    }
};

/// Part of a picture, in pixels from its top left corner.
struct Area {
    int left, top, right, bottom;
};

/// The share of pixels of `area` that differ.
double difference(const Image& a, const Image& b, const Area& area) {
    std::size_t differ = 0;
    for (int y = area.top; y < area.bottom; ++y)
        for (int x = area.left; x < area.right; ++x) differ += a.at(x, y) != b.at(x, y);
    return static_cast<double>(differ) / ((area.right - area.left) * (area.bottom - area.top));
}

constexpr int kWidth = 960, kHeight = 600;
constexpr Area kAll{0, 0, kWidth, kHeight};
/// Where there is never a panel: between them.
constexpr Area kMiddle{370, 0, 640, kHeight};
constexpr Area kLeftPanel{8, 8, 358, 250};
constexpr Area kRightPanel{kWidth - 308, 8, kWidth - 8, 250};
/// Where a frozen camera's own picture is shown.
constexpr Area kInset{kWidth - kWidth / 4 - 8, kHeight - kHeight / 4 - 8, kWidth - 8, kHeight - 8};

const std::string kCity = "city:blocks=5 --size 960x600";
/// Prices at which asking pays on a small scene.
const std::string kPrices = " --set c1=5,c3=200,query=4000,box=800";

class View : public ProgramTest {
  protected:
    static void SetUpTestSuite() { display_ = std::make_unique<VirtualDisplay>(); }
    static void TearDownTestSuite() { display_.reset(); }

    Outcome view(const std::string& arguments, const std::string& script) {
        EXPECT_NE(display_->name(), "") << "no Xvfb; install it (scripts/setup.sh does)";
        write_file(folder_ / "script.txt", script);
        return run("view " + arguments + " --script script.txt", "DISPLAY=" + display_->name());
    }
    std::string output_of(const std::string& arguments, const std::string& script) {
        const Outcome outcome = view(arguments, script);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.out;
    }

    [[nodiscard]] Image image(const std::string& name) const {
        Image image;
        int channels = 0;
        std::uint8_t* pixels = stbi_load((folder_ / name).c_str(), &image.width, &image.height, &channels, 3);
        EXPECT_NE(pixels, nullptr) << name;
        if (pixels == nullptr) return image;
        image.rgb.assign(pixels, pixels + 3 * image.width * image.height);
        stbi_image_free(pixels);
        EXPECT_EQ(image.width, kWidth);
        EXPECT_EQ(image.height, kHeight);
        return image;
    }

    /// What follows `before` in `text`, up to a space or line's end.
    static std::string word_after(const std::string& text, const std::string& before) {
        const std::size_t at = text.find(before);
        EXPECT_NE(at, std::string::npos) << before << " in\n" << text;
        if (at == std::string::npos) return {};
        const std::size_t first = at + before.size();
        return text.substr(first, text.find_first_of(" ,\n", first) - first);
    }
    /// The command that the viewer printed, run.
    nlohmann::json walk_again(const std::string& output) {
        const std::string mark = "again: rhview walk ";
        const std::size_t first = output.find(mark) + mark.size();
        return walk_json(output.substr(first, output.find('\n', first) - first));
    }

    static std::unique_ptr<VirtualDisplay> display_;
};

std::unique_ptr<VirtualDisplay> View::display_;

TEST_F(View, shows_the_scene_with_panels_over_it_and_a_frozen_camera_from_outside) {
    const std::string output = output_of(kCity + kPrices,
                                         "frames 3\nscreenshot panels.png\npanels off\nscreenshot bare.png\n"
                                         "freeze on\nscreenshot frozen.png\noutside\nscreenshot outside.png\n"
                                         "freeze off\nscreenshot free.png\ntell\n");
    const Image bare = image("bare.png"), panels = image("panels.png"), frozen = image("frozen.png"),
                outside = image("outside.png"), free = image("free.png");
    EXPECT_GT(bare.colours(), 50u);
    EXPECT_GT(difference(bare, panels, kLeftPanel), 0.9);
    EXPECT_GT(difference(bare, panels, kRightPanel), 0.9);
    EXPECT_EQ(difference(bare, panels, kMiddle), 0.0);
    // Frozen, it is the same camera in false colours; from outside, another view with the camera's picture in
    // it.
    EXPECT_GT(difference(bare, frozen, kMiddle), 0.3);
    EXPECT_GT(difference(frozen, outside, kMiddle), 0.3);
    EXPECT_LT(difference(frozen, outside, kInset), 0.02);
    EXPECT_GT(difference(outside, free, kAll), 0.5);
    EXPECT_NE(output.find("city:blocks=5, rhview, exact: "), std::string::npos) << output;
}

TEST_F(View, paints_what_the_plan_did_from_outside) {
    output_of(kCity + kPrices, "panels off\nframes 6\nfreeze on\noutside\nframes 4\nscreenshot a.png\n");
    const Image picture = image("a.png");
    std::size_t frustum = 0, hidden = 0, seen = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const std::uint32_t c = picture.at(x, y);
            const int r = c & 255, g = c >> 8 & 255, b = c >> 16 & 255;
            frustum += r > 200 && g == 0 && b > 55 && b < 70;
            hidden += r > 20 && r < 30 && g > 58 && g < 70 && b > 185 && b < 196;
            seen += r == 0 && g > 150 && g < 165 && b > 45 && b < 57;
        }
    EXPECT_GT(frustum, 200u);
    EXPECT_GT(hidden, 100u);
    EXPECT_GT(hidden + seen, 150u);
}

class Recording : public View, public testing::WithParamInterface<const char*> {};

TEST_P(Recording, is_walked_again_with_the_same_plans) {
    const std::string output =
        output_of(std::string(GetParam()),
                  "panels off\nframes 2\nrecord fly.json\nhold W,shift 9\nturn 200 30\n"
                  "hold W,D 8\nturn -90 -45\nhold E,A 5\nstop\nreplay fly.json\nframes 22\n");
    const std::string recorded = word_after(output, "recorded fly.json: 22 frames, plan hash ");
    EXPECT_EQ(word_after(output, "replayed fly.json: 22 frames, plan hash "), recorded);
    const nlohmann::json walk = walk_again(output);
    EXPECT_EQ(walk["frames"], 22);
    EXPECT_EQ(walk["summary"]["plan_hash"], recorded);
    EXPECT_GT(walk["summary"]["draw_calls"]["max"], 0);
}

// Not CHC and CHC++: what they do while an answer is not there depends on when it comes.
INSTANTIATE_TEST_SUITE_P(
    Methods, Recording,
    testing::Values("city:blocks=5 --size 320x200 --set c1=5,c3=200,query=4000,box=800",
                    "city:blocks=5 --size 320x200 --method nested-grid --set c1=5,c3=200",
                    "crowd:objects=200 --size 320x200 --set c1=5,c3=200,query=4000",
                    "town:size=96 --size 320x200 --method octree --submission multi "
                    "--set c1=5,c3=200"),
    [](const auto& test) {
        const std::string arguments = test.param;
        const bool rival = arguments.find("nested-grid") != std::string::npos;
        return rival ? "nested_grid" : arguments.substr(0, arguments.find_first_of(": "));
    });

TEST_F(View, records_with_the_prices_of_its_sliders_and_of_a_profile) {
    const std::string output =
        output_of("town:size=96 --size 320x200 --profile " RHVIEW_PROFILES_DIR "/llvmpipe-2core.json",
                  "panels off\nframes 1\nc3 20\nframes 2\ntell\nc3 200000\nframes 1\ntell\nrecord "
                  "fly.json\nhold W 6\nstop\n");
    const nlohmann::json walk = walk_again(output);
    EXPECT_EQ(walk["summary"]["plan_hash"], word_after(output, "recorded fly.json: 6 frames, plan hash "));
    EXPECT_EQ(walk["profile"]["c3_ns"], 200000);
    // Dear draws are few.
    const std::size_t second = output.find("exact: ", output.find("exact: ") + 1);
    EXPECT_LT(std::stoi(word_after(output.substr(second), "exact: ")),
              std::stoi(word_after(output, "exact: ")))
        << output;
}

TEST_F(View, switches_method_mode_and_scene_while_it_runs) {
    const std::string output =
        output_of("town:size=96 --size 320x200" + kPrices,
                  "panels off\nframes 2\ntell\nmethod octree\nframes 1\ntell\nmethod chc\nframes "
                  "2\ntell\nmethod none\nframes 1\n"
                  "tell\nmethod rhview\nmode latent\nframes 2\ntell\nopen soup\nframes 1\ntell\n");
    for (const char* told : {"town:size=96, rhview, exact", "town:size=96, octree, exact",
                             "town:size=96, chc, exact", "town:size=96, none, exact: 1 draw calls",
                             "town:size=96, rhview, latent", "opened soup", "soup, rhview, latent"})
        EXPECT_NE(output.find(told), std::string::npos) << told << " in\n" << output;
}

TEST_F(View, shows_levels_of_detail_by_colour_and_records_their_bound) {
    const std::string output =
        output_of("crowd:objects=300 --size 960x600 --set c1=5,c3=200",
                  "panels off\nlod-error 0.01\ncolours on\nframes 2\nscreenshot fine.png\ntell\n"
                  "lod-error 16\nframes 2\nscreenshot coarse.png\ntell\nrecord fly.json\n"
                  "hold W 6\nstop\n");
    EXPECT_GT(difference(image("fine.png"), image("coarse.png"), kAll), 0.002);
    const auto indices = [](const std::string& told) { return std::stol(word_after(told, "draw calls, ")); };
    EXPECT_GT(indices(output), indices(output.substr(output.rfind("draw calls") - 1)));
    const nlohmann::json walk = walk_again(output);
    EXPECT_EQ(walk["summary"]["plan_hash"], word_after(output, "recorded fly.json: 6 frames, plan hash "));
    EXPECT_GT(walk["summary"]["lod_error_px"]["max"], 1.0);
}

TEST_F(View, keeps_its_scene_when_another_cannot_be_opened) {
    const Outcome outcome =
        view("town:size=96 --size 320x200" + kPrices, "frames 1\nopen missing.glb\nframes 1\n");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("script.txt, line 2: missing.glb: "), std::string::npos) << outcome.err;
}

TEST_F(View, names_its_files_itself_and_never_writes_over_one) {
    std::filesystem::create_directories(folder_ / "shots");
    const std::string output =
        output_of("soup --size 320x200 --folder shots" + kPrices,
                  "frames 1\nkey F12\nkey F12\nkey R\nframes 3\nkey R\nkey Escape\nframes 1\n");
    for (const char* name : {"rhview_0001.png", "rhview_0002.png", "rhview_path_0001.json"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / "shots" / name)) << name << " in\n" << output;
}

TEST_F(View, that_cannot_be_opened_says_what_is_missing) {
    write_file(folder_ / "s.txt", "frames 1\nfly\n");
    const Outcome bad = run("view soup --script s.txt");
    EXPECT_EQ(bad.code, 2);
    EXPECT_NE(bad.err.find("s.txt, line 2: unknown command 'fly'"), std::string::npos) << bad.err;
    const Outcome none = run("view soup", "DISPLAY= WAYLAND_DISPLAY=");
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.err.find("rhview: no window can be opened ("), std::string::npos) << none.err;
    EXPECT_EQ(run("view soup --script missing.txt").code, 2);
    EXPECT_EQ(run("view soup --method magic").code, 2);
}

}  // namespace
}  // namespace rhview::cli
