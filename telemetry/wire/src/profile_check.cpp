// SPDX-License-Identifier: GPL-3.0-or-later
#include "profile_check.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "profile_names.h"
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

}  // namespace

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

Result<void> validate(const Profile& profile) {
  std::vector<std::string> where;
  for (std::size_t i = 0; i < profile.fields.size(); ++i) {
    where.push_back("fields[" + std::to_string(i) + "] \"" + profile.fields[i].name + "\"");
  }
  return validateAt(profile, where, "profile");
}

}  // namespace pitchboard::telemetry
