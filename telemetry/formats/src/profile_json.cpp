// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include <base/lined_json.h>
#include <telemetry/formats/profile.h>

#include <telemetry/formats/profile_names.h>
#include "published_values.h"

namespace pitchboard::telemetry {
namespace {

bool isWord(std::string_view text) {
  return !text.empty() && text.size() <= profile_names::maxNameBytes &&
         std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c < 0x7f; });
}

std::string inQuotes(std::string_view text) {
  return "\"" + std::string(text) + "\"";
}

/// Of a field beside those before it; empty: nothing is wrong.
std::string nameProblem(const ProfileField& field, std::set<std::string>& names) {
  if (!isWord(field.name)) return "A name has 1 to 60 printable characters without spaces.";
  if (field.name.starts_with("OTHER_")) {
    return "Names that begin with OTHER_ are kept for fields without a name.";
  }
  if (!names.insert(field.name).second)
    return "Two fields are called " + inQuotes(field.name) + ".";
  if (field.unit.size() > profile_names::maxNameBytes ||
      field.category.size() > profile_names::maxNameBytes) {
    return "A unit or category has at most 60 characters.";
  }
  if (field.key.size() > 2 * profile_names::maxNameBytes) {
    return "A key has at most 120 characters.";
  }
  if (field.variable.empty()) return {};
  if (!isWord(field.variable) || field.variable.starts_with("OTHER_")) {
    return "A variable has 1 to 60 printable characters without spaces.";
  }
  if (field.variable != field.name && !names.insert(field.variable).second) {
    return "Two fields are called " + inQuotes(field.variable) + ".";
  }
  return {};
}

std::string meaningProblem(const ProfileField& field, std::set<FieldMeaning>& used) {
  const std::string meaning = inQuotes(meaningName(field.meaning));
  if (field.meaning != FieldMeaning::None && !used.insert(field.meaning).second) {
    return "Two fields have the meaning " + meaning + ".";
  }
  const bool mustBeInt = field.meaning == FieldMeaning::Robot ||
                         field.meaning == FieldMeaning::Sequence ||
                         field.meaning == FieldMeaning::Team;
  if (mustBeInt && field.type != FieldType::Int) {
    return "A field with the meaning " + meaning + " has the type int.";
  }
  if (field.bits != 0 && field.meaning != FieldMeaning::Sequence) {
    return "Only a field with the meaning \"sequence\" has bits.";
  }
  return {};
}

std::string valueProblem(const Profile& profile, const ProfileField& field) {
  if (!std::isfinite(field.scale) || field.scale == 0.0 || !std::isfinite(field.offset)) {
    return "A scale is a number other than 0, an offset a number.";
  }
  if (field.absent && !std::isfinite(*field.absent)) return "\"absent\" is a number.";
  if (!isPublishedForm(profile) && !unitFits(field.meaning, field.unit)) {
    return "A field with the meaning " + inQuotes(meaningName(field.meaning)) + " has the unit " +
           unitsOf(field.meaning) + ".";
  }
  if (profile.format != MessageFormat::Binary) return {};
  if (field.as == WireType::None) return "A field of a binary message needs \"at\" and \"as\".";
  if ((field.as == WireType::Text) != (field.type == FieldType::Text)) {
    return "A field of the type text, and no other, is read as text.";
  }
  if (field.as == WireType::Text && (field.length < 1 || field.length > 1024)) {
    return "A text has a \"length\" of 1 to 1024 bytes.";
  }
  return {};
}

Error problemOf(std::string sentence, std::string where) {
  return {ErrorCode::ParseError, std::move(sentence), std::move(where)};
}

/// `where`: of each field; `whole`: of the profile.
Result<void> validateAt(const Profile& profile, const std::vector<std::string>& where,
                        const std::string& whole) {
  if (!profile.end.empty() && !isWord(profile.end)) {
    return tl::unexpected(
        problemOf("The end word has at most 60 printable characters without spaces; without any, "
                  "the end of the datagram is the end.",
                  whole + ": end"));
  }
  if (profile.fields.empty() || profile.fields.size() > Profile::maxFields) {
    return tl::unexpected(problemOf("A profile has 1 to 100 fields.", whole + ": fields"));
  }
  const bool protobuf = profile.format == MessageFormat::Protobuf;
  const auto& known = profile_names::messages;
  if (protobuf && std::find(known.begin(), known.end(), profile.message) == known.end()) {
    return tl::unexpected(
        problemOf("The message is robocup, nubots, rhoban or utra.", whole + ": message"));
  }
  std::set<std::string> names;
  std::set<FieldMeaning> used;
  for (std::size_t i = 0; i < profile.fields.size(); ++i) {
    const ProfileField& field = profile.fields[i];
    for (std::string problem :
         {nameProblem(field, names), meaningProblem(field, used), valueProblem(profile, field)}) {
      if (!problem.empty()) return tl::unexpected(problemOf(std::move(problem), where[i]));
    }
  }
  const bool fromMessage = profile.robotFrom.source == RobotFrom::Source::Message;
  if (fromMessage && !used.contains(FieldMeaning::Robot)) {
    return tl::unexpected(
        problemOf("No field has the meaning \"robot\", so robots could not be distinguished; a "
                  "message without a number needs \"robotFrom\".",
                  whole + ": fields"));
  }
  if (!fromMessage && used.contains(FieldMeaning::Robot)) {
    return tl::unexpected(
        problemOf("A field has the meaning \"robot\" already.", whole + ": robotFrom"));
  }
  return {};
}

using Json = nlohmann::ordered_json;
using namespace profile_names;

constexpr std::array<std::string_view, 18> fieldKeys{
    "name",   "type",   "unit",   "category", "group", "meaning", "variable", "key",  "scale",
    "offset", "absent", "labels", "bits",     "at",    "as",      "length",   "mask", "optional"};

template <class Enum, class Words>
Enum chosen(const JsonObject& object, std::string_view key, const Words& words,
            std::string_view what, Enum otherwise) {
  const auto index = object.choice(key, words, what);
  return index ? static_cast<Enum>(*index) : otherwise;
}

std::map<std::int32_t, std::string> labelsFrom(JsonReport& report, const JsonObject& field) {
  std::map<std::int32_t, std::string> labels;
  const JsonNode* node = field.find("labels");
  if (node == nullptr) return labels;
  const JsonObject object(report, *node, field.pathOf("labels"));
  if (object.members().size() > maxLabels) {
    object.fail({}, "must not have more than " + std::to_string(maxLabels) + " words");
    return labels;
  }
  for (const auto& [code, word] : object.members()) {
    std::int32_t value = 0;
    const auto [stop, error] = std::from_chars(code.data(), code.data() + code.size(), value);
    if (error != std::errc{} || stop != code.data() + code.size()) {
      object.fail(code, "the code of a word is a whole number in quotes");
      return labels;
    }
    labels[value] = object.text(code, {}, maxNameBytes);
  }
  return labels;
}

ProfileField fieldFrom(JsonReport& report, const JsonObject& object) {
  ProfileField field;
  object.require("name");
  field.name = object.text("name", {}, maxFileBytes);
  object.require("type");
  field.type = chosen(object, "type", types, "type of a field", FieldType::Int);
  field.unit = object.text("unit", {}, maxFileBytes);
  // Profiles of version 0.1 call it "group".
  field.category = object.text(object.find("category") ? "category" : "group", {}, maxFileBytes);
  field.meaning = chosen(object, "meaning", meaningNames, "meaning", FieldMeaning::None);
  field.variable = object.text("variable", {}, maxFileBytes);
  field.key = object.text("key", {}, maxFileBytes);
  field.scale = object.number("scale", 1.0, anyNumber);
  field.offset = object.number("offset", 0.0, anyNumber);
  if (object.find("absent")) field.absent = object.number("absent", 0.0, anyNumber);
  field.labels = labelsFrom(report, object);
  field.bits = object.integer("bits", 0, 0, 32);
  field.at = object.integer("at", 0, 0, maxOffset);
  field.as = chosen(object, "as", wireTypes, "number of a binary message", WireType::None);
  field.length = object.integer("length", 0, 0, 1024);
  field.mask = static_cast<std::uint32_t>(object.number("mask", 0.0, {0.0, 4294967295.0}));
  field.optional = object.boolean("optional", false);
  return field;
}

MessageFrame frameFrom(JsonReport& report, const JsonObject& top) {
  MessageFrame frame;
  const JsonNode* node = top.find("frame");
  if (node == nullptr) return frame;
  const JsonObject object(report, *node, top.pathOf("frame"), {"origin", "x", "y", "angle"});
  frame.centre = object.choice("origin", origins, "origin").value_or(0) == 1;
  frame.x = chosen(object, "x", xAxes, "direction of x", frame.x);
  frame.yLeft = object.choice("y", yAxes, "side of x").value_or(0) == 1;
  frame.clockwise = object.choice("angle", angles, "direction of angles").value_or(0) == 1;
  return frame;
}

RobotFrom robotFrom(JsonReport& report, const JsonObject& top) {
  RobotFrom from;
  const JsonNode* node = top.find("robotFrom");
  if (node == nullptr) return from;
  const JsonObject object(report, *node, top.pathOf("robotFrom"), {"source", "base"});
  object.require("source");
  from.source = chosen(object, "source", robotSources, "source of a robot's number", from.source);
  from.base = object.integer("base", 0, 0, 65535);
  return from;
}

std::string bytesFrom(const JsonObject& top, std::string_view key) {
  const std::string hex = top.text(key, {}, 2 * maxNameBytes);
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    unsigned byte = 0;
    const auto [stop, code] = std::from_chars(hex.data() + i, hex.data() + i + 2, byte, 16);
    if (code != std::errc{} || stop != hex.data() + i + 2) break;
    bytes += static_cast<char>(byte);
  }
  if (2 * bytes.size() != hex.size()) top.fail(key, "has two hexadecimal digits for each byte");
  return bytes;
}

std::vector<WireCondition> conditionsFrom(JsonReport& report, const JsonObject& top) {
  std::vector<WireCondition> conditions;
  const auto* nodes = top.array("when", maxConditions);
  for (std::size_t i = 0; nodes && i < nodes->size(); ++i) {
    const JsonObject object(report, (*nodes)[i], top.pathOf("when", i), {"at", "as", "is"});
    WireCondition condition;
    condition.at = object.integer("at", 0, 0, maxOffset);
    object.require("as");
    condition.as = chosen(object, "as", wireTypes, "number of a binary message", condition.as);
    object.require("is");
    const auto* values = object.array("is", maxLabels);
    for (std::size_t v = 0; values && v < values->size(); ++v) {
      const JsonNode& value = (*values)[v];
      if (value.kind != JsonNode::Kind::Number || std::abs(value.number) > 9e15) {
        object.fail("is", "is a list of whole numbers");
        return conditions;
      }
      condition.values.push_back(static_cast<std::int64_t>(value.number));
    }
    conditions.push_back(std::move(condition));
  }
  return conditions;
}

std::string hexOf(std::string_view bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string hex;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    hex += digits[byte >> 4U];
    hex += digits[byte & 15U];
  }
  return hex;
}

Json fieldJson(const ProfileField& field) {
  Json json{{"name", field.name},
            {"type", types[static_cast<std::size_t>(field.type)]},
            {"unit", field.unit},
            {"category", field.category},
            {"meaning", meaningName(field.meaning)}};
  if (!field.variable.empty()) json["variable"] = field.variable;
  if (!field.key.empty()) json["key"] = field.key;
  if (field.scale != 1.0) json["scale"] = field.scale;
  if (field.offset != 0.0) json["offset"] = field.offset;
  if (field.absent) json["absent"] = *field.absent;
  for (const auto& [code, word] : field.labels) json["labels"][std::to_string(code)] = word;
  if (field.bits != 0) json["bits"] = field.bits;
  if (field.at != 0 || field.as != WireType::None) json["at"] = field.at;
  if (field.as != WireType::None) json["as"] = wireTypes[static_cast<std::size_t>(field.as)];
  if (field.length != 0) json["length"] = field.length;
  if (field.mask != 0) json["mask"] = field.mask;
  if (field.optional) json["optional"] = true;
  return json;
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
  const JsonObject top(report, *root, "",
                       {"name", "format", "end", "separator", "encoding", "tolerant", "frame",
                        "robotFrom", "begins", "when", "message", "fields"});
  Profile profile;
  top.require("name");
  profile.name = top.text("name", {}, maxFileBytes);
  profile.format = chosen(top, "format", formats, "format of messages", profile.format);
  if (profile.format != MessageFormat::Words) profile.end.clear();
  profile.end = top.text("end", profile.end, maxFileBytes);
  const std::string separator = top.text("separator", " ", maxNameBytes);
  if (separator.size() != 1 || separator[0] < ' ' || separator[0] > '~') {
    top.fail("separator", "is one printable character");
  } else {
    profile.separator = separator[0];
  }
  profile.utf8 = top.choice("encoding", encodings, "encoding").value_or(0) == 1;
  profile.tolerant = top.boolean("tolerant", false);
  profile.frame = frameFrom(report, top);
  profile.robotFrom = robotFrom(report, top);
  profile.begins = bytesFrom(top, "begins");
  profile.when = conditionsFrom(report, top);
  profile.message = top.text("message", {}, maxNameBytes);
  top.require("fields");
  std::vector<std::string> where;
  const auto* fields = top.array("fields", Profile::maxFields);
  for (std::size_t i = 0; fields && i < fields->size(); ++i) {
    const JsonNode& item = (*fields)[i];
    const std::string path = top.pathOf("fields", i);
    where.push_back(file + ":" + std::to_string(item.line) + ": " + path);
    profile.fields.push_back(fieldFrom(report, JsonObject(report, item, path, fieldKeys)));
  }
  // Up to version 0.8 the published profile named no variables.
  const bool isOld =
      profile.name == "published" && profile.format == MessageFormat::Words &&
      std::ranges::all_of(profile.fields, &std::string::empty, &ProfileField::variable);
  for (ProfileField& field : profile.fields) {
    const std::string_view present = presentName(field.name);
    if (isOld && present != field.name && present == info(field.meaning).variable) {
      field.variable = present;
    }
  }
  if (report.failed()) return tl::unexpected(report.error());
  if (const auto valid = validateAt(profile, where, file); !valid) {
    return tl::unexpected(valid.error());
  }
  return profile;
}

std::string profileText(const Profile& profile) {
  Json fields = Json::array();
  for (const ProfileField& field : profile.fields) fields.push_back(fieldJson(field));
  Json json{{"name", profile.name}};
  if (profile.format != MessageFormat::Words) json["format"] = formatName(profile.format);
  json["end"] = profile.end;
  if (profile.separator != ' ') json["separator"] = std::string(1, profile.separator);
  if (profile.utf8) json["encoding"] = encodings[1];
  if (profile.tolerant) json["tolerant"] = true;
  if (const MessageFrame& frame = profile.frame; !(frame == MessageFrame{})) {
    json["frame"] = {{"origin", origins[frame.centre ? 1 : 0]},
                     {"x", xAxes[static_cast<std::size_t>(frame.x)]},
                     {"y", yAxes[frame.yLeft ? 1 : 0]},
                     {"angle", angles[frame.clockwise ? 1 : 0]}};
  }
  if (!(profile.robotFrom == RobotFrom{})) {
    json["robotFrom"] = {
        {"source", robotSources[static_cast<std::size_t>(profile.robotFrom.source)]},
        {"base", profile.robotFrom.base}};
  }
  if (!profile.begins.empty()) json["begins"] = hexOf(profile.begins);
  for (const WireCondition& condition : profile.when) {
    json["when"].push_back({{"at", condition.at},
                            {"as", wireTypes[static_cast<std::size_t>(condition.as)]},
                            {"is", condition.values}});
  }
  if (!profile.message.empty()) json["message"] = profile.message;
  json["fields"] = std::move(fields);
  // Bad UTF-8 typed by hand is replaced, not thrown at the caller.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pitchboard::telemetry
