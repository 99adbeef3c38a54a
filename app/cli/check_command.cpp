// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <base/try.h>
#include <robotlink/experiment/junit_report.h>
#include <telemetry/query/rules.h>

#include "commands.h"
#include "interrupt.h"
#include "progress.h"
#include "session_options.h"

namespace pitchboard::cli {
namespace {

using namespace telemetry;

struct CheckCommand {
  std::string rules, junit;
  std::vector<std::string> places;
  bool json = false, csv = false, progress = false;
  int jobs = 0;
};

std::string sentenceOf(const FoundMoment& moment) {
  char text[160];
  std::snprintf(text, sizeof text, " %.3f to %.3f s (%.3f s)", moment.range.begin, moment.range.end,
                moment.range.end - moment.range.begin);
  std::string out = moment.robot + text;
  if (!moment.value) return out;
  std::snprintf(text, sizeof text, ", worst %.4g at %.3f s", *moment.value, moment.valueAt);
  return out + text;
}

void printJson(nlohmann::ordered_json line) {
  std::printf("%s\n",
              line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

void print(const std::string& file, const Rule& rule, const FoundMoment& moment,
           const CheckCommand& command) {
  if (command.json) {
    nlohmann::ordered_json line{
        {"session", file},       {"rule", rule.name},          {"severity", nameOf(rule.severity)},
        {"robot", moment.robot}, {"from", moment.range.begin}, {"until", moment.range.end}};
    if (moment.value) {
      line["value"] = *moment.value;
      line["value_time"] = moment.valueAt;
    }
    printJson(std::move(line));
  } else if (command.csv) {
    std::printf("%s", brokenRuleCsv(file, rule, moment).c_str());
  } else {
    std::printf("%s: %s %s: %s\n", file.c_str(), std::string(nameOf(rule.severity)).c_str(),
                rule.name.c_str(), sentenceOf(moment).c_str());
  }
}

/// The result of a recording, as a suite with a test for each rule.
link::JunitSuite suiteOf(const std::string& file, const std::vector<Rule>& rules,
                         const FileMoments& found) {
  link::JunitSuite suite{file};
  if (found.isForeign) suite.error = "Another program recorded this file; import it first.";
  if (found.error && found.unanswered.empty()) suite.error = found.error->text();
  for (const Rule& rule : rules) suite.tests.push_back({rule.name});
  for (const UnansweredQuestion& one : found.unanswered) {
    suite.tests[one.question].skipped = "not checked: " + one.error.message;
  }
  constexpr std::size_t maxListed = 20;
  std::vector<std::size_t> counts(rules.size(), 0);
  for (const FoundMoment& moment : found.moments) {
    const Rule& rule = rules[moment.question];
    if (rule.severity != RuleSeverity::Error) continue;
    if (++counts[moment.question] > maxListed) continue;
    std::string& failure = suite.tests[moment.question].failure;
    failure += (failure.empty() ? rule.text + ": " : "; ") + sentenceOf(moment);
  }
  for (std::size_t i = 0; i < rules.size(); ++i) {
    if (counts[i] <= maxListed) continue;
    suite.tests[i].failure += "; and " + std::to_string(counts[i] - maxListed) + " more";
  }
  return suite;
}

/// Rules that some recordings could not be asked about.
class NotChecked {
 public:
  void add(const std::vector<UnansweredQuestion>& unanswered) {
    for (const UnansweredQuestion& one : unanswered) {
      auto& [count, why] = m_all[one.question];
      ++count;
      // A recording of other robots may have nothing similar.
      if (why.empty() || one.error.message.find("did you mean") != std::string::npos) {
        why = one.error.message;
      }
    }
  }
  void print(const std::vector<Rule>& rules, std::size_t files) const {
    for (const auto& [rule, missing] : m_all) {
      std::fprintf(stderr, "note: %s was not checked in %zu of %zu recordings: %s\n",
                   rules[rule].name.c_str(), missing.first, files, missing.second.c_str());
    }
  }

 private:
  std::map<std::size_t, std::pair<std::size_t, std::string>> m_all;
};

Result<int> checkRules(const CheckCommand& command) {
  const std::vector<Rule> rules = TRY(rulesFromFile(command.rules));
  const std::vector<std::string> files = TRY(recordingsOf(command.places));
  FindOptions options;
  options.questions = questionsOf(rules);
  options.threads = static_cast<unsigned>(command.jobs);
  const InterruptGuard signals;
  std::size_t broken = 0, checked = 0;
  bool hasFailed = false, hasErrors = false;
  NotChecked notChecked;
  std::vector<link::JunitSuite> suites;
  if (command.csv) std::printf("%s", brokenRuleCsvHead().c_str());
  {
    Progress progress("checking", command.progress);
    const auto report = [&](std::size_t index, FileMoments&& found) {
      const std::string& file = files[index];
      const bool isRead = reportReading(file, found, progress.fresh()) && !found.isForeign;
      hasFailed = hasFailed || !isRead;
      if (isRead || found.isDamaged) checked += rules.size() - found.unanswered.size();
      notChecked.add(found.unanswered);
      for (const FoundMoment& moment : found.moments) {
        const Rule& rule = rules[moment.question];
        hasErrors = hasErrors || rule.severity == RuleSeverity::Error;
        print(file, rule, moment, command);
      }
      for (const UnansweredQuestion& one : found.unanswered) {
        if (!command.json) break;
        printJson({{"session", file},
                   {"rule", rules[one.question].name},
                   {"not_checked", one.error.message}});
      }
      broken += found.moments.size();
      if (!command.junit.empty()) suites.push_back(suiteOf(file, rules, found));
      std::fflush(stdout);
      (void)progress(static_cast<double>(index + 1) / static_cast<double>(files.size()));
      return !interrupted;
    };
    TRY(findMoments(files, options, report, [] { return !interrupted; }));
  }
  if (interrupted) return failure(ErrorCode::Conflict, "Stopped before every file was read.");
  notChecked.print(rules, files.size());
  if (!command.junit.empty()) {
    TRY(writeFile(command.junit, link::junitReport(suites), IfExists::Replace));
  }
  if (!command.json && !command.csv) {
    const auto counted = [](std::size_t count, const char* what) {
      return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
    };
    std::printf("%s, %s: %s\n", counted(rules.size(), "rule").c_str(),
                counted(files.size(), "recording").c_str(),
                broken == 0 ? "never broken" : ("broken " + counted(broken, "time")).c_str());
  }
  if (checked == 0 && !hasFailed) {
    return failure(ErrorCode::NotFound, "None of the rules could be checked in any recording.");
  }
  if (hasFailed) return shared::exitRefused;
  return hasErrors ? 1 : 0;
}

}  // namespace

void addCheckCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<CheckCommand>();
  CLI::App* command = parent.add_subcommand(
      "check",
      "List where recordings break the rules of a file. A rule is a condition that must not hold "
      "(docs/rules.md).\n"
      "Exits with 0 if no rule of severity error was broken, with 1 if one was, and with 2 if a "
      "file cannot be read, at least in part, or no rule could be checked.\n"
      "Examples: pitchboard-cli check rules.json match.mcap\n"
      "          pitchboard-cli check rules.json matches/ --junit results.xml\n"
      "          pitchboard-cli check rules.json matches/ --csv > broken.csv");
  command->add_option("RULES", options->rules, "The file with the rules")->required();
  command->add_option("PLACE", options->places, "Recordings or folders with recordings (*.mcap)")
      ->required();
  command->add_flag("--json", options->json, "One JSON object for each time a rule was broken");
  command->add_flag("--csv", options->csv, "The same as lines with commas, and a header")
      ->excludes("--json");
  command
      ->add_option("--junit", options->junit,
                   "Write JUnit XML: a suite for each recording, a test for each rule")
      ->type_name("FILE.xml");
  addReading(*command, options->jobs, options->progress);
  whenChosen(*command, options, exitCode, checkRules);
}

}  // namespace pitchboard::cli
