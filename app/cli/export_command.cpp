// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/session_export.h>

#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <base/file_target.h>
#include <base/try.h>
#include <robotlink/report/report.h>
#include <robotlink/session/live_moments.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/session_choice.h>
#include <robotlink/session/session_events.h>
#include <telemetry/session/session_reader.h>

#include "commands.h"
#include "interrupt.h"
#include "picture_export.h"
#include "progress.h"
#include "session_options.h"

namespace pitchboard::cli {
namespace {

constexpr double clipLead = 8.0, clipTrail = 4.0;  // s round a goal or a shot

/// Writes a recording of each goal and shot into a folder beside the report: match.html and
/// match-clips/0312.mcap.
Result<std::vector<link::ReportClip>> writeClips(const telemetry::SessionReader& session,
                                                 telemetry::TimeRange range,
                                                 const std::vector<link::PlayEvent>& plays,
                                                 const std::string& output, IfExists ifExists) {
  std::vector<link::ReportClip> clips;
  for (const link::PlayEvent& play : plays) {
    if (play.kind != link::PlayKind::Goal && play.kind != link::PlayKind::Shot) continue;
    const telemetry::TimeRange part{std::max(range.begin, play.time - clipLead),
                                    std::min(range.end, play.time + clipTrail)};
    if (!clips.empty() && part.begin <= clips.back().range.end) {
      clips.back().range.end = part.end;
    } else {
      clips.push_back({part, {}});
    }
  }
  if (clips.empty()) return clips;
  const std::filesystem::path page(output);
  const std::string folder = page.stem().string() + "-clips";
  std::error_code failed;
  std::filesystem::create_directories(page.parent_path() / folder, failed);
  if (failed) {
    return failure(ErrorCode::SystemError, "Cannot create the folder " + folder + " for clips: " +
                                               failed.message() + ". Choose another -o.");
  }
  for (link::ReportClip& clip : clips) {
    const int second = static_cast<int>(clip.range.begin);
    char name[32];
    std::snprintf(name, sizeof name, "%02d%02d.mcap", second / 60, second % 60);
    clip.href = folder + '/' + name;
    telemetry::ExportSelection selection;
    selection.range = clip.range;
    selection.opening = link::openingAt(session, clip.range.begin);
    TRY(link::chooseRobots(session, telemetry::ExportFormat::Mcap, selection));
    TRY(telemetry::exportFile(session, telemetry::ExportFormat::Mcap, selection,
                              (page.parent_path() / clip.href).string(), {}, ifExists));
  }
  return clips;
}

/// Writes the part of the session in the closed range (s, may exceed the session) as an HTML page,
/// or its plays as a table.
Result<void> exportReport(const telemetry::SessionReader& session, telemetry::TimeRange range,
                          const std::vector<std::string>& robots, const std::string& output,
                          IfExists ifExists, bool asTable, bool withClips) {
  if (output.empty() && !asTable) {
    return failure(ErrorCode::InvalidArgument, "a report needs a file: add -o FILE.html");
  }
  const auto all = session.range();
  if (!all) return failure(ErrorCode::NotFound, "the recording is empty");
  const telemetry::TimeRange part{std::max(range.begin, all->begin), std::min(range.end, all->end)};
  if (!(part.begin <= part.end)) {
    return failure(ErrorCode::InvalidArgument, "this part of the recording is empty");
  }
  link::ReportContent content;
  content.session = session.info();
  content.title = session.info().title;
  content.statistics = link::statisticsOf(session, part);
  content.events = link::eventsOf(session);
  const link::RobotChoice chosen = TRY(link::RobotChoice::of(session, robots));
  link::keepRobots(content, chosen);
  if (asTable) {
    const std::string table = link::playCsv(content.statistics.plays);
    if (!output.empty()) return writeFile(output, table, ifExists, session.file().contents().name);
    if (std::fwrite(table.data(), 1, table.size(), stdout) == table.size()) return {};
    return tl::unexpected(shared::outputError(errno));
  }
  if (withClips) {
    content.clips = TRY(writeClips(session, part, content.statistics.plays, output, ifExists));
  }
  content.notes = session.notes();
  if (session.isGrowing()) {
    content.notes.push_back("The recording had not ended when this report was written.");
  } else if (!session.complete()) {
    content.notes.push_back("The recording is truncated.");
  }

  link::RecordedFrames frames(link::backdropOf(session), chosen);
  const link::MatchFrame frame = frames.frameAt(session, part.end);
  if (!frame.robots.empty()) {
    if (const auto picture = svgPicture(session, part.end)) {
      content.picture = *picture;
      char caption[96];
      std::snprintf(caption, sizeof caption, "The field at %.1f s%s", part.end,
                    frame.truthKnown ? "; dashed: where the robots believe they are."
                                     : ", as reported by the robots.");
      content.pictureCaption = caption;
    } else {
      content.notes.push_back("Could not paint the field: " + picture.error().text());
    }
  }
  return link::writeReport(output, content, ifExists, session.file().contents().name);
}

using namespace telemetry;

constexpr const char *reportFormat = "report", *playsFormat = "plays";

struct ExportOptions {
  std::string file, format, output;
  PartOptions part;
  std::vector<std::string> robots, variables;
  bool rowsOnly = false, interpolate = false, clips = false;
  double rate = 10.0;
  bool force = false, progress = false;
};

/// An option that has a meaning for some formats only.
struct FormatOption {
  const char* option;
  std::vector<std::string_view> formats;
};

/// Returns what --to says; without it, the format that the output's name says.
Result<std::string> formatOf(const ExportOptions& options) {
  if (!options.format.empty()) return options.format;
  if (options.output.empty()) return std::string("csv-wide");
  static const std::pair<const char*, const char*> endings[] = {
      {".csv", "csv-wide"}, {".jsonl", "jsonl"}, {".mcap", "mcap"}, {".html", reportFormat},
      {".svg", "svg"},      {".png", "png"},     {".mp4", "mp4"},   {".webm", "webm"}};
  std::error_code unknown;
  // Devices and pipes have no endings.
  if (std::filesystem::is_other(options.output, unknown)) return std::string("csv-wide");
  for (const auto& [ending, format] : endings) {
    if (options.output.ends_with(ending)) return std::string(format);
  }
  return failure(ErrorCode::InvalidArgument,
                 "The name \"" + options.output +
                     "\" does not tell the format. Choose one with --to, or a name that ends in "
                     ".csv, .jsonl, .mcap, .html, .svg, .png, .mp4 or .webm.");
}

/// Refuses options that would be ignored.
Result<void> checkOptions(const CLI::App& command, const std::string& format) {
  static const FormatOption limited[] = {
      {"--clips", {reportFormat}},
      {"--interpolate", {"csv-even"}},
      {"--rate", {"csv-even", "mp4", "webm"}},
      {"--rows-only", {"jsonl", "mcap"}},
      {"--variables", {"csv-wide", "csv-even", "csv-long", "jsonl", "mcap"}}};
  for (const FormatOption& one : limited) {
    if (command.count(one.option) == 0 || std::ranges::count(one.formats, format) > 0) {
      continue;
    }
    std::string formats;
    for (const std::string_view name : one.formats) {
      formats += (formats.empty() ? "" : ", ") + std::string(name);
    }
    return failure(ErrorCode::InvalidArgument, std::string(one.option) + " only works with --to " +
                                                   formats + ", not with " + format +
                                                   ". Leave it out or choose another format.");
  }
  return {};
}

int exportSession(const ExportOptions& options) {
  const bool asTable = options.format == playsFormat;
  const bool asReport = asTable || options.format == reportFormat;
  const bool asPicture = isPictureFormat(options.format);
  const auto format = asReport || asPicture ? ExportFormat::CsvWide : exportFormat(options.format);
  if (!format) return reportError(format.error());
  if (*format == ExportFormat::Mcap && options.output.empty()) {
    return reportError(
        {ErrorCode::InvalidArgument, "MCAP output needs a file: add -o FILE.mcap", {}});
  }
  const auto old = ifExists(options.output, options.force, options.file);
  if (!old) return reportError(old.error());
  const InterruptGuard signals;
  Progress progress("exporting", options.progress);
  McapReaderOptions reading;
  reading.progress = [](double) { return !interrupted; };
  const auto session = SessionReader::open(options.file, reading);
  if (!session) return reportError(session.error());
  const auto part = partOf(*session, options.part);
  if (!part) return reportError(part.error());
  ExportSelection selection;
  selection.range.begin = part->from.value_or(selection.range.begin);
  selection.range.end = part->until.value_or(selection.range.end);
  selection.robots = options.robots;
  if (const auto good = checkSelection(*session, selection); !good) {
    return reportError(good.error());
  }
  if (asReport || asPicture) {
    const auto done = asReport
                          ? exportReport(*session, selection.range, options.robots, options.output,
                                         *old, asTable, options.clips)
                          : exportPictures(*session,
                                           {options.format, part->from, part->until, options.rate,
                                            options.output, options.robots, *old},
                                           std::ref(progress));
    for (const std::string& note : session->notes())
      std::fprintf(stderr, "warning: %s\n", note.c_str());
    return done ? 0 : reportError(done.error());
  }
  selection.variables = options.variables;
  selection.messages = !options.rowsOnly;
  selection.clock = options.part.clock;
  selection.resampling = {options.rate, options.interpolate};
  if (*format == ExportFormat::Mcap) {
    selection.opening = link::openingAt(*session, selection.range.begin);
  }
  if (const auto chosen = link::chooseRobots(*session, *format, selection); !chosen) {
    return reportError(chosen.error());
  }
  std::optional<Error> stopped;  // of standard output
  const auto report = [&] {
    if (!options.output.empty()) {
      return exportFile(*session, *format, selection, options.output, std::ref(progress), *old);
    }
    return exportText(
        *session, *format, selection,
        [&](std::string_view text) {
          if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size()) return true;
          stopped = shared::outputError(errno);
          return false;
        },
        std::ref(progress));
  }();
  for (const std::string& note : session->notes())
    std::fprintf(stderr, "warning: %s\n", note.c_str());
  if (!report) return reportError(stopped.value_or(report.error()));
  return 0;
}

}  // namespace

void addExportCommand(CLI::App& parent, int& exitCode) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = parent.add_subcommand(
      "export",
      "Export a recording, or part of it, as CSV, JSON lines, MCAP, HTML report, picture or "
      "video.\n"
      "Examples: pitchboard-cli export match.mcap --to csv-wide -o match.csv\n"
      "          pitchboard-cli export match.mcap --to csv-long --robots B1,R2 --variables "
      "'VISION_*'\n"
      "          pitchboard-cli export live.mcap --to csv-even --rate 5 --robots 'Robot 1' "
      "--clock\n"
      "          pitchboard-cli export match.mcap --to mcap --from 1:00 --until 1:30 -o goal.mcap\n"
      "          pitchboard-cli export live.mcap --to mcap --clock --from 14:03:20 --until 14:05 "
      "-o "
      "goal.mcap\n"
      "          pitchboard-cli export match.mcap --to mp4 --from 60 --until 90 -o goal.mp4");
  command->add_option("file", options->file, "The recording")->required()->type_name("FILE");
  command
      ->add_option(
          "--to", options->format,
          "csv-wide (a row per time), csv-even (resampled at --rate), csv-long (a row per value), "
          "jsonl, mcap, report (HTML), plays (CSV of passes, shots, set plays), svg or png (the "
          "field at --from), mp4 or webm (a video, "
          "needs ffmpeg). Without it, the name of the output says the format; on standard output "
          "csv-wide")
      ->type_name("FORMAT");
  addPart(*command, options->part, "; CSV: add a column with the time of day (UTC)");
  addRobots(*command, options->robots,
            "Export only these robots, e.g. B1,R2; 'match' for data of no robot");
  addVariables(*command, options->variables, "Export only these variables; * matches any letters");
  command->add_option("--rate", options->rate, "Rows (csv-even) or frames (videos) per second")
      ->type_name("N")
      ->capture_default_str();
  command->add_flag("--interpolate", options->interpolate,
                    "csv-even: interpolate linearly instead of holding each value");
  command->add_flag("--clips", options->clips,
                    "report: write a recording of each goal and shot beside it, with links");
  command->add_flag("--rows-only", options->rowsOnly,
                    "Leave out events, log and datagrams (jsonl, mcap)");
  command
      ->add_option("-o,--output", options->output, "Write this new file instead of standard output")
      ->type_name("FILE");
  addForce(*command, options->force);
  command->add_flag("--progress", options->progress,
                    "Print progress to stderr even if it is not a terminal");
  whenChosen(*command, options, exitCode, [command](ExportOptions& chosen) -> Result<int> {
    chosen.format = TRY(formatOf(chosen));
    TRY(checkOptions(*command, chosen.format));
    return exportSession(chosen);
  });
}

}  // namespace pitchboard::cli
