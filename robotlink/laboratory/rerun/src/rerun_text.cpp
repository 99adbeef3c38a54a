// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/rerun/rerun_text.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include <base/file_target.h>
#include <base/read_file.h>
#include <base/time_text.h>
#include <base/try.h>
#include <robotlink/report/report_page.h>

namespace pitchboard::link {
namespace {

using RerunJson = nlohmann::ordered_json;

constexpr std::size_t maxUnchangedBytes = std::size_t{64} << 20;

std::size_t shownWidth(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Columns beneath each other; the last one is not padded.
std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], shownWidth(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += row[i];
      if (i + 1 < row.size()) text += std::string(widths[i] - shownWidth(row[i]) + 2, ' ');
    }
    text += '\n';
  }
  return text;
}

std::string processesText(const RerunResult& result) {
  std::string text;
  for (const RerunProcess& process : result.processes) {
    text += (text.empty() ? "" : ", ") + process.name + '=' + process.program;
  }
  return text;
}

std::string countText(std::uint64_t count, const char* one, const char* many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

std::string largestText(const ComparedVariable& variable) {
  if (variable.isCode()) return "–";
  return valueText(variable.column, variable.largest);
}

/// The row of a variable in tables: name, first, what, how often, how long, how large.
std::vector<std::string> rowOf(const ComparedVariable& variable) {
  const DifferentStretch& first = variable.stretches.front();
  return {variable.column.name,
          secondsToText(first.begin),
          differenceText(variable, first),
          std::to_string(variable.stretchCount),
          fixed(variable.seconds, 2) + " s",
          largestText(variable)};
}

std::vector<const ComparedVariable*> differing(const std::vector<ComparedVariable>& variables) {
  std::vector<const ComparedVariable*> out;
  for (const ComparedVariable& variable : variables) {
    if (variable.differs()) out.push_back(&variable);
  }
  // The first difference matters most; later ones may follow from it.
  std::ranges::stable_sort(
      out, {}, [](const ComparedVariable* one) { return one->stretches.front().begin; });
  return out;
}

std::string differingTable(const std::vector<const ComparedVariable*>& variables) {
  std::vector<std::vector<std::string>> rows{
      {"Variable", "First at", "Difference", "Times", "Duration", "Largest"}};
  for (const ComparedVariable* one : variables) rows.push_back(rowOf(*one));
  return '\n' + aligned(rows) + '\n';
}

std::size_t comparedVariables(const RerunResult& result) {
  return static_cast<std::size_t>(std::ranges::count_if(
      result.variables, [](const ComparedVariable& one) { return one.compared > 0; }));
}

RerunJson numberJson(double value) {
  return std::isfinite(value) ? RerunJson(value) : RerunJson(nullptr);
}

RerunJson stretchJson(const DifferentStretch& stretch) {
  return {{"begin", stretch.begin},
          {"end", stretch.end},
          {"recorded", numberJson(stretch.recorded)},
          {"rerun", numberJson(stretch.rerun)},
          {"largest", numberJson(stretch.largest)}};
}

RerunJson variableJson(const ComparedVariable& variable) {
  RerunJson out{{"name", variable.column.name},
                {"unit", variable.column.unit},
                {"tolerance", variable.tolerance},
                {"compared", variable.compared},
                {"unequal", variable.unequal},
                {"unchanged_too", variable.unchangedToo},
                {"differences", variable.stretchCount},
                {"seconds", variable.seconds},
                {"largest", variable.isCode() ? RerunJson(nullptr) : numberJson(variable.largest)}};
  if (variable.differs()) {
    const DifferentStretch& first = variable.stretches.front();
    out["first"] = {{"time", first.begin}, {"text", differenceText(variable, first)}};
  }
  RerunJson stretches = RerunJson::array();
  for (const DifferentStretch& one : variable.stretches) stretches.push_back(stretchJson(one));
  out["stretches"] = std::move(stretches);
  return out;
}

double numberOr(const nlohmann::json& object, const char* key, double fallback) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : fallback;
}

std::string textOr(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

const nlohmann::json& arrayOr(const nlohmann::json& object, const char* key) {
  static const nlohmann::json none = nlohmann::json::array();
  const auto found = object.find(key);
  return found != object.end() && found->is_array() ? *found : none;
}

ComparedVariable variableFrom(const nlohmann::json& json) {
  ComparedVariable variable;
  variable.column.name = textOr(json, "name");
  variable.stretchCount =
      static_cast<std::uint64_t>(std::clamp(numberOr(json, "differences", 0.0), 0.0, 1e15));
  for (const nlohmann::json& one : arrayOr(json, "stretches")) {
    if (!one.is_object() || variable.stretches.size() >= ComparedVariable::maxStretches) continue;
    DifferentStretch& stretch = variable.stretches.emplace_back();
    stretch.begin = numberOr(one, "begin", 0.0);
    stretch.end = numberOr(one, "end", stretch.begin);
  }
  return variable;
}

}  // namespace

std::vector<std::string> rerunVerdicts(const RerunResult& result) {
  std::vector<std::string> out;
  std::string unchanged;
  for (const ComparedVariable& one : result.variables) {
    if (one.unchangedToo > 0) unchanged += (unchanged.empty() ? "" : ", ") + one.column.name;
  }
  if (!unchanged.empty()) {
    out.push_back("Left out, because it differs without a change, too: " + unchanged + ".");
  }
  if (result.compared() == 0) {
    out.emplace_back("Nothing was compared: the recording has none of the outputs.");
  } else if (result.unequal() == 0) {
    out.emplace_back("No value differs.");
  } else if (result.stretches() == 0) {
    out.push_back("No difference: " + countText(result.unequal(), "value is", "values are") +
                  " not the same to the last bit, but within the tolerance" +
                  (result.slack > 0.0 ? " and the time that a program may vary" : "") + ".");
  } else if (result.isTooCoarse()) {
    out.emplace_back(
        "The recording lacks changes of what the process reads, so these differences are no "
        "evidence about the program. Run the unchanged program with --same first.");
  } else if (!result.inLockStep && unchanged.empty()) {
    out.emplace_back(
        "The program is not in lock-step, so some of these differences may come without a change. "
        "Run the unchanged program with --same first.");
  }
  return out;
}

std::string rerunTable(const RerunResult& result) {
  std::string text = result.robot + " rerun (" + processesText(result) + "), " +
                     secondsToText(result.begin) + " to " + secondsToText(result.end) + ": " +
                     countText(result.compared(), "value", "values") + " of " +
                     countText(comparedVariables(result), "variable", "variables") + " compared, " +
                     (result.inLockStep ? "in lock-step" : "over time") + "\n";
  const auto variables = differing(result.variables);
  if (!variables.empty()) text += differingTable(variables);
  for (const std::string& sentence : rerunVerdicts(result)) text += sentence + '\n';
  return text;
}

std::string sinceLastTable(const RerunResult& result) {
  if (!result.sinceLast) return {};
  const auto variables = differing(*result.sinceLast);
  if (variables.empty()) return "Since the last run: no difference.\n";
  return "Since the last run, " +
         countText(variables.size(), "variable differs:", "variables differ:") + '\n' +
         differingTable(variables);
}

std::string rerunToJson(const RerunResult& result, std::string_view session) {
  RerunJson processes = RerunJson::array();
  for (const RerunProcess& one : result.processes) {
    processes.push_back({{"name", one.name}, {"program", one.program}});
  }
  RerunJson out{{"session", session},
                {"robot", result.robot},
                {"processes", std::move(processes)},
                {"from", result.begin},
                {"until", result.end},
                {"lock_step", result.inLockStep},
                {"slack", result.slack},
                {"row_interval", result.rowInterval},
                {"sampled_inputs", result.sampledInputs},
                {"notes", result.notes},
                {"compared", result.compared()},
                {"unequal", result.unequal()},
                {"unchanged_too", result.unchangedToo()},
                {"differences", result.stretches()}};
  RerunJson variables = RerunJson::array();
  for (const ComparedVariable& one : result.variables) variables.push_back(variableJson(one));
  out["variables"] = std::move(variables);
  if (result.sinceLast) {
    RerunJson since = RerunJson::array();
    for (const ComparedVariable& one : *result.sinceLast) {
      if (one.differs()) since.push_back(variableJson(one));
    }
    out["since_last"] = std::move(since);
  }
  return out.dump(-1, ' ', false, RerunJson::error_handler_t::replace);
}

std::string rerunReport(const RerunResult& result, std::string_view session) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
      escaped(result.robot + " rerun") + "</title>\n<style>" + std::string(reportStyle) +
      "</style>\n</head>\n<body>\n<main>\n<h1>" +
      escaped(result.robot + " rerun: " + processesText(result)) + "</h1>\n<p class=\"quiet\">" +
      escaped(session) + ", " +
      escaped(secondsToText(result.begin) + " to " + secondsToText(result.end)) + ": " +
      countText(result.compared(), "value", "values") + " compared, " +
      (result.inLockStep ? "in lock-step" : "over time") + "</p>\n";
  for (const std::string& note : result.notes)
    out += "<p class=\"note\">" + escaped(note) + "</p>\n";
  for (const std::string& one : rerunVerdicts(result))
    out += "<p class=\"note\">" + escaped(one) + "</p>\n";
  const auto variables = differing(result.variables);
  if (!variables.empty()) {
    out +=
        "<h2>Variables that differ</h2>\n<div class=\"scroll\"><table>\n<thead><tr>"
        "<th class=\"l\">Variable</th><th>First at</th><th class=\"l\">Difference</th>"
        "<th>Times</th><th>Duration</th><th>Largest</th></tr></thead>\n<tbody>\n";
    for (const ComparedVariable* one : variables) {
      const auto row = rowOf(*one);
      out += "<tr>";
      for (std::size_t i = 0; i < row.size(); ++i) {
        out += (i == 0 || i == 2 ? "<td class=\"l\">" : "<td>") + escaped(row[i]) + "</td>";
      }
      out += "</tr>\n";
    }
    out +=
        "</tbody></table></div>\n<h2>Every difference</h2>\n<div class=\"scroll\"><table>\n"
        "<thead><tr><th class=\"l\">Variable</th><th>From</th><th>Until</th>"
        "<th class=\"l\">Difference</th></tr></thead>\n<tbody>\n";
    for (const ComparedVariable* one : variables) {
      for (const DifferentStretch& stretch : one->stretches) {
        out += "<tr><td class=\"l\">" + escaped(one->column.name) + "</td><td>" +
               secondsToText(stretch.begin) + "</td><td>" + secondsToText(stretch.end) +
               "</td><td class=\"l\">" + escaped(differenceText(*one, stretch)) + "</td></tr>\n";
      }
    }
    out += "</tbody></table></div>\n";
  }
  return out + "</main>\n</body>\n</html>\n";
}

Result<UnchangedRerun> unchangedFromJson(std::string_view json, std::string_view source) {
  const auto object = nlohmann::json::parse(json, nullptr, false);
  if (!object.is_object() || !object.contains("variables")) {
    return failure(ErrorCode::ParseError,
                   "This is not the result of a rerun. Delete it and run --same again.",
                   std::string(source));
  }
  UnchangedRerun out;
  out.robot = textOr(object, "robot");
  for (const nlohmann::json& one : arrayOr(object, "processes")) {
    if (one.is_object()) out.processes.push_back({textOr(one, "name"), textOr(one, "program")});
  }
  for (const nlohmann::json& one : arrayOr(object, "variables")) {
    if (!one.is_object()) continue;
    ComparedVariable variable = variableFrom(one);
    if (variable.differs()) out.variables.push_back(std::move(variable));
  }
  return out;
}

std::string unchangedPath(const std::string& session, const RerunOptions& options) {
  const std::filesystem::path path(session);
  std::string name = path.stem().string() + '.' + options.robot;
  for (const RerunProcess& process : options.processes) {
    name += '-' + (process.name.empty() ? std::string("all") : process.name);
  }
  std::ranges::replace(name, '/', '_');
  return (path.parent_path() / (name + ".same.json")).string();
}

Result<std::vector<ComparedVariable>> readUnchanged(const std::string& session,
                                                    const RerunOptions& options) {
  const std::string path = unchangedPath(session, options);
  std::error_code code;
  if (!std::filesystem::exists(path, code)) return std::vector<ComparedVariable>{};
  const std::string text = TRY(readFile(path, maxUnchangedBytes));
  return TRY(unchangedFromJson(text, path)).variables;
}

Result<std::string> keepUnchanged(const std::string& session, const RerunOptions& options,
                                  const RerunResult& result) {
  RerunOptions named = options;
  named.robot = result.robot;
  const std::string path = unchangedPath(session, named);
  TRY(writeFile(path, rerunToJson(result, session) + '\n', IfExists::Replace));
  return path;
}

}  // namespace pitchboard::link
