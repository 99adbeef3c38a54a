// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/try.h>
#include <robotlink/experiment/experiment_edits.h>

#include <nlohmann/json.hpp>

namespace pitchboard::link {
namespace {

using EditedJson = nlohmann::ordered_json;

Result<void> parseFile(std::string_view text, EditedJson& file) {
  try {
    file = EditedJson::parse(text);
    if (file.is_object()) return {};
  } catch (const EditedJson::exception& problem) {
    return failure(ErrorCode::InvalidArgument,
                   std::string("The file is not valid JSON: ") + problem.what());
  }
  return failure(ErrorCode::InvalidArgument, "The file must be an object: { ... }");
}

std::string trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\n");
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" \t\n") - begin + 1));
}

std::string settingsText(const EditedJson& set) {
  std::string all;
  for (const auto& [key, value] : set.items()) {
    if (!all.empty()) all += ", ";
    // A text that reads as JSON keeps its quotes.
    const bool isPlain = value.is_string() &&
                         !EditedJson::accept(value.get_ref<const std::string&>()) &&
                         value.get_ref<const std::string&>().find(',') == std::string::npos;
    all += key + " = " + (isPlain ? value.get<std::string>() : value.dump());
  }
  return all;
}

/// At commas that stand in no brackets and no quotes.
std::vector<std::string> partsOf(std::string_view text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' && (i == 0 || text[i - 1] != '\\')) quoted = !quoted;
    if (!quoted && (c == '[' || c == '{')) ++depth;
    if (!quoted && (c == ']' || c == '}')) --depth;
    if (c == ',' && !quoted && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

Result<void> readSettings(const std::string& text, EditedJson& set) {
  set = EditedJson::object();
  if (trimmed(text).empty()) return {};
  for (const std::string& part : partsOf(text)) {
    const auto equals = part.find('=');
    const std::string key = trimmed(part.substr(0, equals));
    const std::string value =
        equals == std::string::npos ? std::string() : trimmed(part.substr(equals + 1));
    if (key.empty() || value.empty()) {
      return failure(ErrorCode::InvalidArgument,
                     "\"" + trimmed(part) +
                         "\" is not a setting. Write key = value, such as "
                         "noise = paper.");
    }
    set[key] = EditedJson::accept(value) ? EditedJson::parse(value) : EditedJson(value);
  }
  return {};
}

}  // namespace

Result<ExperimentEdits> editsOf(std::string_view text) {
  EditedJson file;
  TRY(parseFile(text, file));
  ExperimentEdits edits;
  if (const auto seed = file.find("seed"); seed != file.end() && seed->is_number_unsigned()) {
    edits.seed = seed->get<std::uint64_t>();
  }
  if (const auto runs = file.find("runs"); runs != file.end() && runs->is_number_unsigned()) {
    edits.runs = runs->get<std::size_t>();
  }
  edits.isGrid = file.contains("grid");
  const auto conditions = file.find("conditions");
  if (conditions == file.end() || !conditions->is_array()) return edits;
  for (std::size_t i = 0; i < conditions->size(); ++i) {
    const EditedJson& one = (*conditions)[i];
    if (!one.is_object()) continue;
    const auto name = one.find("name"), set = one.find("set");
    edits.conditions.push_back(
        {i, name != one.end() && name->is_string() ? name->get<std::string>() : std::string(),
         set != one.end() && set->is_object() ? settingsText(*set) : std::string()});
  }
  return edits;
}

Result<std::string> withEdits(std::string_view text, const ExperimentEdits& edits) {
  EditedJson file;
  TRY(parseFile(text, file));
  file["seed"] = edits.seed;
  file["runs"] = edits.runs;
  if (!edits.isGrid && (!edits.conditions.empty() || file.contains("conditions"))) {
    const EditedJson before =
        file.contains("conditions") ? file["conditions"] : EditedJson::array();
    EditedJson conditions = EditedJson::array();
    for (const ConditionEdit& edit : edits.conditions) {
      EditedJson one =
          edit.from && *edit.from < before.size() ? before[*edit.from] : EditedJson::object();
      one["name"] = edit.name;
      TRY(readSettings(edit.settings, one["set"]));
      if (one["set"].empty()) one.erase("set");
      conditions.push_back(std::move(one));
    }
    file["conditions"] = std::move(conditions);
    if (file["conditions"].empty()) file.erase("conditions");
  }
  return file.dump(2, ' ', false, EditedJson::error_handler_t::replace) + '\n';
}

}  // namespace pitchboard::link
