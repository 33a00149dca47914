// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <system_error>

#include "rhview/scenes/camera_path.h"

namespace rhview {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kSchema = "rhview.path/1";
/// Far beyond any real path: what is larger is not a path file.
constexpr std::size_t kLargestFile = std::size_t{64} << 20;

/// Reads the fields of one JSON object; the first error is kept and the rest is skipped.
class FieldReader {
  public:
    FieldReader(const Json& object, std::string place) : object_(object), place_(std::move(place)) {}

    void expect_only(std::span<const std::string_view> names) {
        if (!object_.is_object()) return refuse("is not a JSON object; write { … } with named fields");
        for (const auto& item : object_.items()) {
            if (std::find(names.begin(), names.end(), item.key()) == names.end())
                refuse(fmt::format("has an unknown field \"{}\"; the fields are {}", item.key(),
                                   fmt::join(names, ", ")));
        }
    }

    const Json* find(const char* name, bool required) {
        if (error_) return nullptr;
        const auto found = object_.find(name);
        if (found != object_.end()) return &*found;
        if (required) refuse(fmt::format("has no field \"{}\"; add it", name));
        return nullptr;
    }

    void number(const char* name, bool required, double& value) {
        const Json* field = find(name, required);
        if (field == nullptr) return;
        if (!field->is_number()) return refuse(fmt::format("has a \"{}\" that is not a number", name));
        value = field->get<double>();
    }

    void vector(const char* name, bool required, glm::dvec3& value) {
        const Json* field = find(name, required);
        if (field == nullptr) return;
        const bool three =
            field->is_array() && field->size() == 3 &&
            std::all_of(field->begin(), field->end(), [](const Json& v) { return v.is_number(); });
        if (!three)
            return refuse(fmt::format("has a \"{}\" that is not three numbers, as in [0, 1, 0]", name));
        for (int axis = 0; axis < 3; ++axis)
            value[axis] = (*field)[static_cast<std::size_t>(axis)].get<double>();
    }

    void refuse(const std::string& what) {
        if (!error_) error_ = Error{place_ + " " + what};
    }
    [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  private:
    const Json& object_;
    std::string place_;
    std::optional<Error> error_;
};

std::string place_of_byte(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(text.size(), byte > 0 ? byte - 1 : 0));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    return fmt::format("line {}, column {}", line, before.size() - line_start + 1);
}

Result<Json> parse_json(std::string_view text, const std::string& source_name) {
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& error) {
        return Error{fmt::format("{}: not JSON at {}; mend the text there", source_name,
                                 place_of_byte(text, error.byte))};
    } catch (const Json::exception&) {
        return Error{source_name +
                     ": not JSON that can be read: it holds a number too large for double precision"};
    }
}

void read_far(FieldReader& reader, double& far) {
    const Json* field = reader.find("far", false);
    if (field == nullptr) return;
    if (field->is_string() && field->get_ref<const std::string&>() == "infinity")
        far = std::numeric_limits<double>::infinity();
    else if (field->is_number())
        far = field->get<double>();
    else
        reader.refuse("has a \"far\" that is neither a number nor the string \"infinity\"");
}

std::optional<Error> read_keys(const Json& keys, const std::string& source_name,
                               std::vector<CameraKey>& result) {
    constexpr std::array<std::string_view, 3> kFields{"time", "eye", "target"};
    result.reserve(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        FieldReader reader(keys[i], fmt::format("{}: key {}", source_name, i));
        CameraKey key;
        reader.expect_only(kFields);
        reader.number("time", true, key.time_s);
        reader.vector("eye", true, key.eye);
        reader.vector("target", true, key.target);
        if (reader.error()) return reader.error();
        result.push_back(key);
    }
    return std::nullopt;
}

}  // namespace

Result<CameraPath> parse_camera_path(std::string_view json, const std::string& source_name) {
    constexpr std::array<std::string_view, 6> kFields{"schema", "fov_y_deg", "near", "far", "up", "keys"};
    const Result<Json> document = parse_json(json, source_name);
    if (!document) return document.error();
    FieldReader reader(*document, source_name + ": the path");
    CameraPath path;
    const Json* schema = document->is_object() ? reader.find("schema", true) : nullptr;
    if (schema != nullptr && *schema != kSchema)
        reader.refuse(fmt::format("has another schema than this program reads; it must be \"{}\"", kSchema));
    reader.expect_only(kFields);
    reader.number("fov_y_deg", false, path.fov_y_deg);
    reader.number("near", false, path.near_m);
    read_far(reader, path.far_m);
    reader.vector("up", false, path.up);
    const Json* keys = reader.find("keys", true);
    if (keys != nullptr && !keys->is_array()) reader.refuse("has \"keys\" that are not a list; write [ … ]");
    if (reader.error()) return *reader.error();
    if (const std::optional<Error> error = read_keys(*keys, source_name, path.keys)) return *error;
    if (const Status status = validate(path); !status)
        return Error{source_name + ": " + status.error().message};
    return path;
}

Result<CameraPath> load_camera_path(const std::filesystem::path& file) {
    const std::string name = file.string();
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        return Error{name + ": there is no such file; check the path"};
    if (std::filesystem::is_directory(file, ignored))
        return Error{name + ": this is a folder; name a path file"};
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return Error{name + ": the file cannot be opened; check its permissions"};
    std::string text;
    std::array<char, 65536> block{};
    while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
        text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
        if (text.size() > kLargestFile) return Error{name + ": too large for a camera path (64 MiB at most)"};
    }
    if (stream.bad()) return Error{name + ": the file cannot be read to its end"};
    return parse_camera_path(text, name);
}

std::string to_json(const CameraPath& path) {
    const auto vector = [](const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); };
    // A key a line: such a file can be read, and cut, by hand.
    std::string text = fmt::format(
        "{{\"schema\": \"{}\", \"fov_y_deg\": {}, \"near\": {}, \"far\": {}, \"up\": {},\n", kSchema,
        Json(path.fov_y_deg).dump(), Json(path.near_m).dump(),
        std::isinf(path.far_m) ? "\"infinity\"" : Json(path.far_m).dump(), vector(path.up).dump());
    text += " \"keys\": [";
    for (std::size_t i = 0; i < path.keys.size(); ++i) {
        const CameraKey& key = path.keys[i];
        text += fmt::format("{}\n  {{\"time\": {}, \"eye\": {}, \"target\": {}}}", i > 0 ? "," : "",
                            Json(key.time_s).dump(), vector(key.eye).dump(), vector(key.target).dump());
    }
    return text + "]}\n";
}

}  // namespace rhview
