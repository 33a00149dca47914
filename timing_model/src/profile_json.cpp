// SPDX-FileCopyrightText: 2026 The rhview authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <nlohmann/json.hpp>

#include "profile_fields.h"

namespace rhview {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

constexpr const char* kSchema = "rhview.profile/1";
constexpr const char* kMendAgain = "; calibrate again";

/// Reads the fields of one JSON object; the first error is kept and the rest is skipped.
class FieldReader {
  public:
    FieldReader(const Json& object, std::string place) : object_(object), place_(std::move(place)) {
        if (!object_.is_object()) refuse("is not a JSON object; write { … } with named fields");
    }

    /// Null where an optional field is absent or null.
    const Json* find(const char* name, bool required) {
        if (error_) return nullptr;
        const auto found = object_.find(name);
        if (found != object_.end() && !found->is_null()) return &*found;
        if (required) refuse_field("has no field", name, kMendAgain);
        return nullptr;
    }

    std::optional<double> number(const char* name, bool required) {
        const Json* field = find(name, required);
        if (field == nullptr) return std::nullopt;
        if (field->is_number()) return field->get<double>();
        refuse_field("does not hold a number in", name, kMendAgain);
        return std::nullopt;
    }

    void text(const char* name, bool required, std::string& value) {
        const Json* field = find(name, required);
        if (field == nullptr) return;
        if (field->is_string())
            value = field->get<std::string>();
        else
            refuse_field("does not hold text in", name, "; write it in quotes");
    }

    /// The object of that name; null where it is absent, or an error was found.
    const Json* object(const char* name, bool required) {
        const Json* field = find(name, required);
        if (field == nullptr || field->is_object()) return field;
        refuse_field("does not hold an object in", name, "; write { … } with named fields");
        return nullptr;
    }

    void refuse_field(const char* what, const char* name, const char* mend) {
        refuse(std::string(what) + " \"" + name + "\"" + mend);
    }
    void refuse(const std::string& what) {
        if (!error_) error_ = Error{place_ + " " + what};
    }
    /// Takes over the error of the reader of a part.
    void adopt(const FieldReader& part) {
        if (!error_) error_ = part.error_;
    }
    [[nodiscard]] const std::string& place() const { return place_; }
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
    return "line " + std::to_string(line) + ", column " + std::to_string(before.size() - line_start + 1);
}

Result<Json> parse_json(std::string_view text, const std::string& source_name) {
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& error) {
        if (error.byte > text.size())
            return Error{source_name + ": the file is truncated (it ends at " +
                         place_of_byte(text, error.byte) + ")" + kMendAgain};
        return Error{source_name + ": not JSON at " + place_of_byte(text, error.byte) +
                     "; mend the text there or calibrate again"};
    } catch (const Json::exception&) {
        return Error{source_name + ": it holds a number too large for double precision" + kMendAgain};
    }
}

void read_schema(FieldReader& reader) {
    std::string schema;
    reader.text("schema", true, schema);
    if (!reader.error() && schema != kSchema)
        reader.refuse("has the schema \"" + schema + "\", this program reads \"" + kSchema + "\"" +
                      kMendAgain);
}

/// Device and timer.
void read_strings(FieldReader& reader, TimingProfile& profile) {
    if (const Json* device = reader.object("device", true)) {
        FieldReader part(*device, reader.place() + ": \"device\"");
        part.text("renderer", true, profile.renderer);
        part.text("version", true, profile.version);
        reader.adopt(part);
    }
    if (const Json* timer = reader.object("timer", false)) {
        FieldReader part(*timer, reader.place() + ": \"timer\"");
        part.text("name", false, profile.timer_name);
        part.text("why", false, profile.timer_why);
        reader.adopt(part);
    }
    reader.text("date", false, profile.date);
    reader.text("note", false, profile.note);
}

void read_constants(FieldReader& reader, TimingProfile& profile) {
    for (const ConstantField& field : kConstantFields) {
        if (const std::optional<double> value = reader.number(field.name, field.required))
            profile.set_constant(field.term, *value);
    }
    std::string combination = "sum";
    reader.text("combination", false, combination);
    if (combination == "max")
        profile.combination = Combination::MaxOfCpuAndGpu;
    else if (combination != "sum")
        reader.refuse("has the combination \"" + combination + "\"; it must be \"sum\" or \"max\"");
    if (const Json* errors = reader.object("standard_errors", false)) {
        FieldReader part(*errors, reader.place() + ": \"standard_errors\"");
        for (const ConstantField& field : kConstantFields)
            profile.standard_errors_ns[index_of(field.term)] = part.number(field.name, false);
        reader.adopt(part);
    }
}

void read_answer_costs(FieldReader& reader, TimingProfile& profile) {
    const Json* costs = reader.object("answer_costs", false);
    if (costs == nullptr) return;
    FieldReader ways(*costs, reader.place() + ": \"answer_costs\"");
    profile.answer_costs.emplace();
    for (const WayField& field : kWayFields) {
        const Json* way = ways.object(field.name, true);
        if (way == nullptr) continue;
        FieldReader part(*way, ways.place() + ": \"" + field.name + "\"");
        for (const AnswerField& answer : kAnswerFields)
            ((*profile.answer_costs).*field.value).*answer.value =
                part.number(answer.name, true).value_or(0.0);
        ways.adopt(part);
    }
    reader.adopt(ways);
}

void read_quality(FieldReader& reader, TimingProfile& profile) {
    profile.hold_out_error = reader.number("hold_out_error", false);
    profile.r_squared = reader.number("r_squared", false);
    if (const Json* samples = reader.find("samples", false)) {
        if (samples->is_number_unsigned())
            profile.samples = samples->get<std::uint64_t>();
        else
            reader.refuse_field("does not hold a whole number, 0 or more, in", "samples", kMendAgain);
    }
    if (const Json* residuals = reader.object("residuals", false)) {
        FieldReader part(*residuals, reader.place() + ": \"residuals\"");
        profile.residuals.emplace();
        for (const PercentileField& field : kPercentileFields)
            (*profile.residuals).*field.value = part.number(field.name, true).value_or(0.0);
        reader.adopt(part);
    }
}

OrderedJson or_null(const std::optional<double>& value) {
    return value ? OrderedJson(*value) : OrderedJson(nullptr);
}

}  // namespace

Result<TimingProfile> parse_profile(std::string_view text, const std::string& source_name) {
    const Result<Json> document = parse_json(text, source_name);
    if (!document) return document.error();
    FieldReader reader(*document, source_name + ": the profile");
    TimingProfile profile;
    read_schema(reader);
    read_strings(reader, profile);
    read_constants(reader, profile);
    read_answer_costs(reader, profile);
    read_quality(reader, profile);
    if (reader.error()) return *reader.error();
    if (const Status status = validate(profile); !status)
        return Error{source_name + ": " + status.error().message};
    return profile;
}

std::string profile_text(const TimingProfile& profile) {
    OrderedJson json;
    json["schema"] = kSchema;
    json["device"] = {{"renderer", profile.renderer}, {"version", profile.version}};
    json["timer"] = {{"name", profile.timer_name}, {"why", profile.timer_why}};
    json["date"] = profile.date;
    json["note"] = profile.note;
    json["combination"] = profile.combination == Combination::Sum ? "sum" : "max";
    OrderedJson errors = OrderedJson::object();
    for (const ConstantField& field : kConstantFields) {
        json[field.name] = or_null(profile.constant(field.term));
        errors[field.name] = or_null(profile.standard_errors_ns[index_of(field.term)]);
    }
    json["standard_errors"] = std::move(errors);
    json["answer_costs"] = nullptr;
    if (profile.answer_costs) {
        OrderedJson ways = OrderedJson::object();
        for (const WayField& way : kWayFields)
            for (const AnswerField& answer : kAnswerFields)
                ways[way.name][answer.name] = ((*profile.answer_costs).*way.value).*answer.value;
        json["answer_costs"] = std::move(ways);
    }
    json["residuals"] = nullptr;
    if (profile.residuals) {
        OrderedJson residuals = OrderedJson::object();
        for (const PercentileField& field : kPercentileFields)
            residuals[field.name] = (*profile.residuals).*field.value;
        json["residuals"] = std::move(residuals);
    }
    json["hold_out_error"] = or_null(profile.hold_out_error);
    json["r_squared"] = or_null(profile.r_squared);
    json["samples"] = profile.samples;
    return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace rhview
