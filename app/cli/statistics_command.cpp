// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/query/stretch_table.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include <base/nearest_name.h>
#include <base/try.h>
#include <base/wildcard.h>
#include <telemetry/session/session_export.h>

#include "commands.h"
#include "interrupt.h"
#include "progress.h"
#include "session_options.h"

namespace pitchboard::cli {
namespace {

using namespace telemetry;

struct StatisticsCommand {
  std::vector<std::string> files;
  std::vector<std::string> variables, expressions, robots, between;
  PartOptions part;
  std::string condition, against;
  std::optional<double> maxDelay;
  int bins = 0;
  bool json = false, csv = false, progress = false;
};

/// What --variables and --expr mean in a session.
Result<std::vector<StretchQuestion::Text>> wantedIn(const SessionReader& session,
                                                    const StatisticsCommand& command) {
  std::vector<StretchQuestion::Text> out;
  std::set<GroupId> chosen;
  for (const std::string& robot : command.robots) {
    const std::vector<GroupId> groups = TRY(session.groupsNamed(robot));
    chosen.insert(groups.begin(), groups.end());
  }
  std::vector<std::string_view> known;
  for (GroupId g = 0; g < session.groups().size(); ++g) {
    if (!command.robots.empty() && !chosen.contains(g)) continue;
    for (const ColumnInfo& column : session.groups()[g].info.columns) {
      if (column.kind != ColumnKind::Text) known.push_back(column.name);
    }
  }
  for (const std::string& pattern : command.variables) {
    bool isUsed = false;
    for (const std::string_view name : known) {
      if (!fitsWildcard(pattern, name)) continue;
      isUsed = true;
      if (std::ranges::count(out, name, &StretchQuestion::Text::name) > 0) continue;
      out.push_back({"{each/" + std::string(name) + "}", std::string(name)});
    }
    if (isUsed) continue;
    const std::string_view near = nearestName(pattern, known);
    return failure(ErrorCode::NotFound,
                   "The selected robots have no variable of numbers \"" + pattern + "\"" +
                       (near.empty() ? "; a * stands for any letters."
                                     : "; did you mean \"" + std::string(near) + "\"?"));
  }
  for (const std::string& expression : command.expressions) {
    out.push_back({expression, expression});
  }
  return out;
}

Result<std::vector<TimeRange>> rangesOf(const SessionReader& session,
                                        const StatisticsCommand& command) {
  const auto all = session.range();
  if (!all) return failure(ErrorCode::NotFound, "The recording is empty.");
  const Part part = TRY(partOf(session, command.part));
  const TimeRange limits{part.from.value_or(all->begin), part.until.value_or(all->end)};
  TRY(checkRange(limits));
  if (command.between.empty()) return std::vector<TimeRange>{limits};
  std::vector<TimeRange> out;
  for (TimeRange range : TRY(rangesBetween(session, command.between[0], command.between[1]))) {
    range.begin = std::max(range.begin, limits.begin);
    range.end = std::min(range.end, limits.end);
    if (range.begin <= range.end) out.push_back(range);
  }
  if (out.empty()) {
    return failure(ErrorCode::NotFound, "No time between these events lies in the chosen part.");
  }
  return out;
}

Result<void> describeSession(const std::string& file, const StatisticsCommand& command,
                             const std::function<bool(double)>& progress,
                             std::vector<StretchLine>& lines) {
  McapReaderOptions reading;
  reading.progress = [&progress](double) { return progress(0.0); };
  const SessionReader session = TRY(SessionReader::open(file, reading));
  if (session.isForeign()) {
    return failure(ErrorCode::Unsupported,
                   "Another program recorded this file. Make a session of it with pitchboard-cli "
                   "import.");
  }
  StretchQuestion question;
  question.texts = TRY(wantedIn(session, command));
  question.condition = command.condition;
  question.robots = command.robots;
  question.against = command.against;
  question.maxDelay = command.maxDelay.value_or(question.maxDelay);
  question.bins = static_cast<std::size_t>(command.bins);
  const std::vector<TimeRange> ranges = TRY(rangesOf(session, command));
  StretchTable table = TRY(describeStretch(session, question, ranges, progress));
  if (!table.problems.empty()) return tl::unexpected(table.problems.front().error);
  for (StretchLine& line : table.lines) {
    line.session = file;
    lines.push_back(std::move(line));
  }
  for (const std::string& note : session.notes()) {
    std::fprintf(stderr, "warning: %s: %s\n", file.c_str(), note.c_str());
  }
  return {};
}

constexpr double noValue = std::numeric_limits<double>::quiet_NaN();

std::string shortNumber(double value) {
  if (!std::isfinite(value)) return "-";
  char text[40];
  std::snprintf(text, sizeof text,
                std::abs(value) < 1e7 && value == std::round(value) ? "%.0f" : "%.4g", value);
  return text;
}

void printJson(const std::vector<StretchLine>& lines, const StatisticsCommand& command) {
  using Json = nlohmann::ordered_json;
  Json all = Json::array();
  for (const StretchLine& line : lines) {
    Json one{{"session", line.session},
             {"robot", line.robot},
             {"variable", line.variable},
             {"unit", line.unit},
             {"label", line.label}};
    for (const StretchColumn& column : stretchColumns(!command.against.empty())) {
      const double value = column.of(line);
      one[column.name] = std::isfinite(value) ? Json(value) : Json();
    }
    if (!line.counts.empty()) one["histogram"] = line.counts;
    all.push_back(std::move(one));
  }
  std::printf("%s\n", all.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

/// Prints a table whose columns are as wide as their widest cell; numbers are aligned on the right.
void printCells(const std::vector<std::vector<std::string>>& rows, std::size_t texts) {
  std::vector<std::size_t> widths;
  const auto charactersOf = [](const std::string& text) {
    return static_cast<std::size_t>(
        std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
  };
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], charactersOf(row[i]));
    }
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string gap(widths[i] - charactersOf(row[i]), ' ');
      const bool isLeft = i < texts || row[i].starts_with('#');
      line += (i > 0 ? "  " : "") + (isLeft ? row[i] + gap : gap + row[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    std::printf("%s\n", line.c_str());
  }
}

void printText(const std::vector<StretchLine>& lines, const StatisticsCommand& command) {
  const bool isCompared = !command.against.empty();
  std::vector<std::vector<std::string>> numbers, states, comparisons, histograms;
  const auto head = [&](const StretchLine& line) {
    std::vector<std::string> cells{line.robot, line.variable};
    if (command.files.size() > 1) cells.insert(cells.begin(), line.session);
    return cells;
  };
  const auto begin = [&](std::vector<std::vector<std::string>>& table,
                         std::vector<std::string> titles) {
    if (!table.empty()) return;
    titles.insert(titles.begin(), {"robot", "variable"});
    if (command.files.size() > 1) titles.insert(titles.begin(), "session");
    table.push_back(std::move(titles));
  };
  const auto add = [&](std::vector<std::vector<std::string>>& table, const StretchLine& line,
                       std::vector<std::string> cells) {
    std::vector<std::string> row = head(line);
    row.insert(row.end(), cells.begin(), cells.end());
    table.push_back(std::move(row));
  };
  for (const StretchLine& line : lines) {
    const CurveSummary& s = line.summary;
    if (line.state) {
      begin(states, {"state", "share", "n"});
      char share[32];
      std::snprintf(share, sizeof share, "%.2f %%", 100.0 * line.state->share);
      add(states, line,
          {line.label.empty() ? shortNumber(line.state->value) : line.label, share,
           std::to_string(line.state->samples)});
      continue;
    }
    begin(numbers, {"unit", "n", "missing", "n_eff", "mean", "95 % of the mean", "sd", "min",
                    "at s", "median", "p95", "max", "at s"});
    const std::string interval =
        std::isfinite(s.meanLow) ? shortNumber(s.meanLow) + " to " + shortNumber(s.meanHigh) : "-";
    add(numbers, line,
        {line.unit, std::to_string(s.samples), std::to_string(s.missing), shortNumber(s.effective),
         shortNumber(s.mean), interval, shortNumber(s.deviation), shortNumber(s.least),
         shortNumber(s.leastAt), shortNumber(s.quantiles[2]), shortNumber(s.quantiles[4]),
         shortNumber(s.most), shortNumber(s.mostAt)});
    if (isCompared && line.error) {
      begin(comparisons, {"unit", "n", "bias", "95 % of the bias", "rms", "largest", "at s",
                          "correlation", "delay s", "correlation then"});
      const CurveError& e = *line.error;
      const auto& c = line.correlation;
      add(comparisons, line,
          {line.unit, std::to_string(e.samples), shortNumber(e.bias),
           std::isfinite(e.biasLow) ? shortNumber(e.biasLow) + " to " + shortNumber(e.biasHigh)
                                    : "-",
           shortNumber(e.rms), shortNumber(e.largest), shortNumber(e.largestAt),
           shortNumber(c ? c->atZero : noValue), shortNumber(c ? c->delay : noValue),
           shortNumber(c ? c->coefficient : noValue)});
    }
    if (!line.counts.empty()) {
      begin(histograms, {"from", "to", "n", ""});
      const std::size_t most = *std::ranges::max_element(line.counts);
      for (std::size_t i = 0; i < line.counts.size(); ++i) {
        const double width = (s.most - s.least) / static_cast<double>(line.counts.size());
        const double from = s.least + static_cast<double>(i) * width;
        add(histograms, line,
            {shortNumber(from), shortNumber(from + width), std::to_string(line.counts[i]),
             std::string(40 * line.counts[i] / std::max<std::size_t>(1, most), '#')});
      }
    }
  }
  const std::size_t texts = command.files.size() > 1 ? 3 : 2;
  bool isFirst = true;
  const auto show = [&](const char* title, const std::vector<std::vector<std::string>>& table,
                        std::size_t more) {
    if (table.empty()) return;
    std::printf("%s%s", isFirst ? "" : "\n", title);
    isFirst = false;
    printCells(table, texts + more);
  };
  show("", numbers, 1);
  show("", states, 1);
  show(("against " + command.against + ":\n").c_str(), comparisons, 1);
  show("", histograms, 0);
}

Result<int> describe(const StatisticsCommand& command) {
  if (command.variables.empty() && command.expressions.empty()) {
    return failure(ErrorCode::InvalidArgument,
                   "Say what to describe: add --variables NAMES or --expr EXPRESSION.");
  }
  if (command.maxDelay && command.against.empty()) {
    return failure(ErrorCode::InvalidArgument,
                   "--max-delay needs --against, the curve that may come later.");
  }
  const InterruptGuard signals;
  Progress progress("reading", command.progress);
  std::vector<StretchLine> lines;
  int exitCode = 0;
  for (std::size_t i = 0; i < command.files.size(); ++i) {
    const std::string& file = command.files[i];
    const auto report = [&](double part) {
      return progress((static_cast<double>(i) + part) / static_cast<double>(command.files.size()));
    };
    if (const auto done = describeSession(file, command, report, lines); !done) {
      if (interrupted) return failure(ErrorCode::Conflict, "Stopped.");
      Error error = done.error();
      if (!error.context.starts_with(file)) error.context = file;
      std::fputs(progress.fresh().c_str(), stderr);
      exitCode = reportError(error);
    }
  }
  if (lines.empty()) return exitCode;
  if (command.csv) {
    const std::string text = stretchCsv(lines, !command.against.empty(), command.bins > 0);
    std::fwrite(text.data(), 1, text.size(), stdout);
  } else if (command.json) {
    printJson(lines, command);
  } else {
    printText(lines, command);
  }
  return exitCode;
}

}  // namespace

void addStatisticsCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<StatisticsCommand>();
  CLI::App* command = parent.add_subcommand(
      "statistics",
      "Describe variables over a part of recordings. Variables or expressions: mean with its 95 % "
      "interval (neighbouring samples are alike: n_eff), deviation, percentiles, extremes, shares "
      "of states, and the error against another curve.\n"
      "Examples: pitchboard-cli statistics match.mcap --variables TRUE_X,DECISION_ACTION_A "
      "--robots "
      "B1\n"
      "          pitchboard-cli statistics *.mcap --expr BELIEF_ERROR --while 'VISION_BALL_DIST < "
      "100' --csv\n"
      "          pitchboard-cli statistics match.mcap --variables TRUE_X --against BELIEF_X\n"
      "          pitchboard-cli statistics match.mcap --expr BELIEF_ERROR --between "
      "referee:PLAYING goal");
  command->add_option("SESSION", options->files, "The recordings")->required();
  addVariables(*command, options->variables, "Describe these variables; * matches any letters");
  command
      ->add_option("--expr", options->expressions,
                   "Describe this expression, as in plots; a variable without a robot is that of "
                   "each robot. May be repeated")
      ->type_name("EXPRESSION")
      ->allow_extra_args(false);
  addRobots(*command, options->robots,
            "Only these robots, e.g. B1,R2; 'match' for data of no robot");
  addPart(*command, options->part);
  command->add_option("--while", options->condition, "Only samples at which this condition holds")
      ->type_name("EXPRESSION");
  command
      ->add_option("--between", options->between,
                   "Only from each event of the first kind to the next of the second, such as goal "
                   "or referee:PLAYING (kind:detail)")
      ->type_name("EVENT EVENT")
      ->expected(2);
  command
      ->add_option("--against", options->against,
                   "Also the error against this expression (bias, RMS, largest), and the "
                   "correlation with it")
      ->type_name("EXPRESSION");
  shared::addDuration(*command, "--max-delay", options->maxDelay,
                      "With --against: look for the delay up to this [1]");
  command->add_option("--histogram", options->bins, "Also a histogram with this many bins")
      ->type_name("BINS")
      ->check(CLI::Range(1, 1000));
  command->add_flag("--json", options->json,
                    "Print a JSON list with an object for each line of the table");
  command->add_flag("--csv", options->csv, "Print the table with commas")->excludes("--json");
  command->add_flag("--progress", options->progress,
                    "Print progress to stderr even if it is not a terminal");
  whenChosen(*command, options, exitCode, describe);
}

}  // namespace pitchboard::cli
