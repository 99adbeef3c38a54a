// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_list.h"

#include <array>
#include <cstdio>
#include <ctime>

#include <base/csv_field.h>
#include <base/duration_text.h>
#include <base/try.h>
#include <robotlink/library/session_overview.h>

#include "commands.h"
#include "interrupt.h"
#include "json_text.h"
#include "progress.h"
#include "session_options.h"

namespace pitchboard::cli {
namespace {

using link::SessionOverview;

std::string joinedTexts(const std::vector<std::string>& texts, const char* between) {
  std::string out;
  for (const std::string& text : texts) out += (out.empty() ? "" : between) + text;
  return out;
}

std::string createdText(const SessionOverview& session) {
  return session.created == telemetry::WallTime() ? std::string() : wallText(session.created);
}

void printListedJson(const std::string& file, const SessionOverview& session) {
  std::string line = "{\"file\":";
  addJsonText(line, file);
  std::printf("%s,%s\n", line.c_str(), overviewJson(session).substr(1).c_str());
}

constexpr const char* sessionCsvHeading =
    "file,created,teams,score_left,score_right,length,robots,events,bookmarks,notes,problem\n";

void printListedCsv(const std::string& file, const SessionOverview& session) {
  std::string score = ",";
  if (session.score) {
    score = std::to_string(session.score->first) + ',' + std::to_string(session.score->second);
  }
  std::printf("%s,%s,%s,%s,", csvField(file).c_str(), createdText(session).c_str(),
              csvField(teamsText(session)).c_str(), score.c_str());
  if (session.isReadable) {
    std::printf("%.3f,%s,%llu,%llu", session.length,
                csvField(joinedTexts(session.robots, " ")).c_str(),
                static_cast<unsigned long long>(session.events),
                static_cast<unsigned long long>(session.bookmarks));
  } else {
    std::printf(",,,");
  }
  std::printf(",%s,%s\n", csvField(joinedTexts(session.notes, "; ")).c_str(),
              csvField(session.problem).c_str());
}

void printListedText(const std::string& file, const SessionOverview& session) {
  if (session.isReadable) {
    const auto counted = [](std::uint64_t count, const char* what) {
      return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
    };
    std::printf("%s %s %s  %s  %s %s  ", padded(createdText(session), 23).c_str(),
                padded(durationText(session.length), 12).c_str(),
                padded(scoreText(session), 6).c_str(), padded(teamsText(session), 24).c_str(),
                padded(counted(session.robots.size(), "robot"), 9).c_str(),
                padded(counted(session.events, "event"), 11).c_str());
  }
  std::printf("%s%s%s\n", file.c_str(), session.problem.empty() ? "" : ": ",
              session.problem.c_str());
  for (const std::string& note : session.notes) std::printf("    %s\n", note.c_str());
}

}  // namespace

std::string wallText(telemetry::WallTime time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(
      std::chrono::time_point_cast<std::chrono::system_clock::duration>(time));
  std::tm parts{};
  if (!gmtime_r(&seconds, &parts)) return "?";
  std::array<char, 40> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S UTC", &parts);
  return text.data();
}

Result<int> listSessions(const SessionListOptions& options) {
  const std::vector<std::string> files = TRY(recordingsOf(options.places));
  const InterruptGuard signals;
  Progress progress("reading", options.progress);
  if (options.csv) std::printf("%s", sessionCsvHeading);
  bool hasProblems = false;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const SessionOverview session = link::overviewOf(files[i], [] { return !interrupted; });
    if (interrupted) return failure(ErrorCode::Conflict, "Stopped before every file was read.");
    hasProblems = hasProblems || !session.problem.empty();
    std::fputs(progress.fresh().c_str(), stderr);
    (options.json  ? printListedJson
     : options.csv ? printListedCsv
                   : printListedText)(files[i], session);
    std::fflush(stdout);
    (void)progress(static_cast<double>(i + 1) / static_cast<double>(files.size()));
  }
  return hasProblems ? 1 : 0;
}

}  // namespace pitchboard::cli
