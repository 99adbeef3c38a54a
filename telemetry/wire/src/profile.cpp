// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/wire/profile.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include <base/lined_json.h>
#include <base/read_file.h>
#include <resources/resources.h>

namespace pitchboard::telemetry {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, fieldMeaningCount> meanings{
    "none",          "robot",      "x",       "y",       "theta",        "belief",
    "ball-distance", "ball-angle", "control", "vision",  "localization", "decision",
    "imu",           "action",     "yaw",     "voltage", "sequence"};
constexpr std::array<std::string_view, 3> types{"int", "float", "flag"};

constexpr std::size_t maxNameBytes = 60;
constexpr std::size_t maxFileBytes = 1024 * 1024;

bool isWord(std::string_view text) {
  return !text.empty() && text.size() <= maxNameBytes &&
         std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 0x7f; });
}

ProfileField fieldFrom(const JsonObject& object) {
  ProfileField field;
  object.require("name");
  field.name = object.text("name", {}, maxFileBytes);
  object.require("type");
  field.type = static_cast<FieldType>(object.choice("type", types, "type of a field").value_or(0));
  field.unit = object.text("unit", {}, maxFileBytes);
  // Profiles of version 0.1 call it "group".
  field.category = object.text(object.find("category") ? "category" : "group", {}, maxFileBytes);
  field.meaning =
      static_cast<FieldMeaning>(object.choice("meaning", meanings, "meaning").value_or(0));
  if (object.find("absent")) field.absent = object.number("absent", 0.0, anyNumber);
  field.bits = object.integer("bits", 0, 0, 32);
  return field;
}

}  // namespace

std::string_view meaningName(FieldMeaning meaning) {
  return meanings[static_cast<std::size_t>(meaning)];
}

std::optional<std::size_t> Profile::indexOf(FieldMeaning meaning) const {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].meaning == meaning) return i;
  }
  return std::nullopt;
}

namespace {

/// What is wrong with one field beside those before it; empty when nothing is.
std::string fieldProblem(const ProfileField& field, std::set<std::string>& names,
                         std::set<FieldMeaning>& used) {
  if (!isWord(field.name)) {
    return "A name has 1 to 60 printable characters without spaces.";
  }
  if (field.name.starts_with("OTHER_")) {
    return "Names that begin with OTHER_ are kept for fields without a name.";
  }
  if (!names.insert(field.name).second) return "Two fields are called \"" + field.name + "\".";
  if (field.unit.size() > maxNameBytes || field.category.size() > maxNameBytes) {
    return "A unit or category has at most 60 characters.";
  }
  if (field.meaning != FieldMeaning::None && !used.insert(field.meaning).second) {
    return "Two fields have the meaning \"" + std::string(meaningName(field.meaning)) + "\".";
  }
  const bool mustBeInt =
      field.meaning == FieldMeaning::Robot || field.meaning == FieldMeaning::Sequence;
  if (mustBeInt && field.type != FieldType::Int) {
    return "A field with the meaning \"" + std::string(meaningName(field.meaning)) +
           "\" has the type int.";
  }
  if (field.bits != 0 && field.meaning != FieldMeaning::Sequence) {
    return "Only a field with the meaning \"sequence\" has bits.";
  }
  if (field.bits != 0 && field.bits != 8 && field.bits != 16 && field.bits != 32) {
    return "A sequence number has 8, 16 or 32 bits.";
  }
  return {};
}

Result<void> validateAt(const Profile& profile, const std::vector<std::string>& where,
                        const std::string& whole) {
  if (!isWord(profile.end)) {
    return failure(ErrorCode::ParseError,
                   "The end word has 1 to 60 printable characters without spaces.",
                   whole + ": end");
  }
  if (profile.fields.empty() || profile.fields.size() > Profile::maxFields) {
    return failure(ErrorCode::ParseError, "A profile has 1 to 100 fields.", whole + ": fields");
  }
  std::set<std::string> names;
  std::set<FieldMeaning> used;
  for (std::size_t i = 0; i < profile.fields.size(); ++i) {
    std::string problem = fieldProblem(profile.fields[i], names, used);
    if (!problem.empty()) return failure(ErrorCode::ParseError, std::move(problem), where[i]);
  }
  if (!used.contains(FieldMeaning::Robot)) {
    return failure(ErrorCode::ParseError,
                   "No field has the meaning \"robot\", so messages could not be told apart.",
                   whole + ": fields");
  }
  return {};
}

}  // namespace

Result<void> validate(const Profile& profile) {
  std::vector<std::string> where;
  for (std::size_t i = 0; i < profile.fields.size(); ++i) {
    where.push_back("fields[" + std::to_string(i) + "] \"" + profile.fields[i].name + "\"");
  }
  return validateAt(profile, where, "profile");
}

Result<Profile> parseProfile(std::string_view text, const std::string& file) {
  JsonReport report(file);
  const auto root = parseJson(text, report, maxFileBytes);
  if (!root) return tl::unexpected(report.error());
  const JsonObject top(report, *root, "", {"name", "end", "fields"});
  Profile profile;
  top.require("name");
  profile.name = top.text("name", {}, maxFileBytes);
  profile.end = top.text("end", profile.end, maxFileBytes);
  top.require("fields");
  std::vector<std::string> where;
  const auto* fields = top.array("fields", Profile::maxFields);
  for (std::size_t i = 0; fields && i < fields->size(); ++i) {
    const JsonNode& item = (*fields)[i];
    const std::string path = top.pathOf("fields", i);
    where.push_back(file + ":" + std::to_string(item.line) + ": " + path);
    profile.fields.push_back(fieldFrom(
        JsonObject(report, item, path,
                   {"name", "type", "unit", "category", "group", "meaning", "absent", "bits"})));
  }
  if (report.failed()) return tl::unexpected(report.error());
  if (const auto valid = validateAt(profile, where, file); !valid) {
    return tl::unexpected(valid.error());
  }
  return profile;
}

Result<Profile> loadProfile(const std::string& path) {
  const auto text = readFile(path, maxFileBytes, "The profile");
  if (!text) return tl::unexpected(text.error());
  return parseProfile(*text, path);
}

std::string profileText(const Profile& profile) {
  Json fields = Json::array();
  for (const ProfileField& field : profile.fields) {
    fields.push_back({{"name", field.name},
                      {"type", types[static_cast<std::size_t>(field.type)]},
                      {"unit", field.unit},
                      {"category", field.category},
                      {"meaning", meaningName(field.meaning)}});
    if (field.absent) fields.back()["absent"] = *field.absent;
    if (field.bits != 0) fields.back()["bits"] = field.bits;
  }
  const Json json{{"name", profile.name}, {"end", profile.end}, {"fields", fields}};
  // Bad UTF-8 typed by hand is replaced, not thrown at the caller.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

const Profile& publishedProfile() {
  // The resource is part of the program: a test parses it, so it cannot fail here.
  static const Profile profile =
      parseProfile(resourceText("profiles/published.json"), "profiles/published.json")
          .value_or(Profile{});
  return profile;
}

}  // namespace pitchboard::telemetry
