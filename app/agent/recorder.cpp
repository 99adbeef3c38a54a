// SPDX-License-Identifier: GPL-3.0-or-later
#include "recorder.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <utility>

#include <base/team_color.h>
#include <base/try.h>
#include <robotlink/live/board_facts.h>

namespace pitchboard::agent {
namespace {

namespace fs = std::filesystem;

constexpr Time lookStep = std::chrono::milliseconds(250);  // at the disk and the size of the file
constexpr double patience = 2.0;  // s without a row after which the robot counts as lost
constexpr int mostFiles = 100'000;
constexpr const char* ending = ".mcap";

std::string megabytes(std::uint64_t bytes) {
  return std::to_string(bytes / 1'000'000) + " MB";
}

std::string robotName(int robot) {
  return std::string(info(TeamColor::Blue).letter) + std::to_string(robot);
}

/// The time on the robot's clock, for names of files.
std::string timeName() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", &parts)};
}

/// Recordings of earlier starts in the folder, the oldest first.
std::deque<std::string> earlierFiles(const fs::path& folder, const std::string& begin) {
  std::vector<std::pair<fs::file_time_type, std::string>> found;
  std::error_code problem;
  for (fs::directory_iterator it(folder, problem), end; !problem && it != end;
       it.increment(problem)) {
    const std::string name = it->path().filename().string();
    std::error_code unknown;
    const auto time = it->last_write_time(unknown);
    if (name.starts_with(begin) && name.ends_with(ending) && !unknown) {
      found.emplace_back(time, it->path().string());
    }
  }
  std::ranges::sort(found);
  std::deque<std::string> paths;
  for (auto& [time, path] : found) paths.push_back(std::move(path));
  return paths;
}

std::uint64_t sizeOf(const std::string& path) {
  std::error_code gone;
  const auto size = fs::file_size(path, gone);
  return gone ? 0 : size;
}

}  // namespace

telemetry::SessionWriterOptions RecordOptions::robotWriter() {
  telemetry::SessionWriterOptions options;
  options.queueBytes = std::size_t{4} << 20;
  options.chunkBytes = std::size_t{256} << 10;
  // What waits for its chunk and for the disk together is less than a second.
  options.chunkInterval = std::chrono::milliseconds(500);
  options.level = 1;
  return options;
}

Recorder::Recorder(const RecordOptions& options, const link::VariableCatalog& catalog,
                   const link::SegmentLayout& layout, Time now)
    : m_options(options),
      m_columns(catalog),
      m_catalog(catalog.toJson(layout)),
      m_zero(now),
      m_start(std::chrono::system_clock::now()) {}

double Recorder::seconds(Time time) const {
  return std::chrono::duration<double>(time - m_zero).count();
}

Result<Recorder> Recorder::start(const RecordOptions& options, const link::VariableCatalog& catalog,
                                 const link::SegmentLayout& layout, Time now) {
  Recorder recorder(options, catalog, layout, now);
  std::error_code unknown;
  if (fs::is_directory(options.path, unknown)) {
    const std::string begin = "robot" + std::to_string(options.robot) + '-';
    recorder.m_older = earlierFiles(options.path, begin);
    recorder.m_stem = (fs::path(options.path) / (begin + timeName())).string();
  } else {
    recorder.m_stem = options.path;
    if (recorder.m_stem.ends_with(ending)) recorder.m_stem.resize(recorder.m_stem.size() - 5);
    if (fs::exists(options.path, unknown)) {
      return failure(ErrorCode::Conflict,
                     "this file exists; choose another name, or give a folder, in which every "
                     "recording gets a name of its own",
                     "--record " + options.path);
    }
  }
  TRY(recorder.open(now));
  recorder.dropOldest();
  return recorder;
}

/// Creates the next file: NAME.mcap, NAME-002.mcap, ...
Result<void> Recorder::open(Time now) {
  telemetry::SessionInfo info;
  info.program = "pitchboard-agent " PITCHBOARD_VERSION;
  info.source = "live";
  info.title = "Recorded on robot " + std::to_string(m_options.robot);
  info.start = m_start;
  info.created = std::chrono::system_clock::now();
  info.more["clock_us"] = std::to_string(m_zero.count());
  for (;;) {
    const int number = ++m_files;
    char suffix[16] = "";
    if (number > 1) std::snprintf(suffix, sizeof suffix, "-%03d", number);
    const bool isGiven = number == 1 && m_stem + ending != m_options.path &&
                         m_stem == m_options.path;  // a name without an ending
    std::string path = isGiven ? m_stem : m_stem + suffix + ending;
    info.more["part"] = std::to_string(number);
    auto made = telemetry::SessionWriter::create(path, info, m_options.writer);
    if (!made && made.error().code == ErrorCode::Conflict && number < mostFiles) continue;
    if (!made) return tl::unexpected(made.error());
    m_path = std::move(path);
    m_writer = *std::move(made);
    break;
  }
  m_writer->attach("catalog.json", "application/json", m_catalog);
  telemetry::GroupInfo group{robotName(m_options.robot), m_columns.columns()};
  group.robot = link::factsOfBoard(m_options.key, m_options.rate, m_options.robot, TeamColor::Blue);
  group.robot->timeout_s = patience;
  m_group = m_writer->addGroup(group);
  m_opened = m_looked = now;
  m_reportedDropped = 0;
  return {};
}

void Recorder::append(Time time, std::span<const std::uint32_t> words) {
  m_row.assign(words.begin(), words.end());
  m_columns.makeHoles(m_row);
  m_writer->append(m_group, {seconds(time), m_row, {}});
  m_written = time;
}

std::string Recorder::take(Time now, std::span<const std::uint32_t> words) {
  if (!m_writer) return {};
  if (words.empty()) {
    m_last.clear();
  } else {
    const bool isNew = m_last.empty();
    const bool changed = !isNew && !std::ranges::equal(words, m_last);
    // A value holds until it changes: curves go straight from row to row.
    if (changed && m_written < m_read) append(m_read, m_last);
    if (isNew || changed || now - m_written >= maxSilence) append(now, words);
    m_last.assign(words.begin(), words.end());
    m_read = now;
  }
  return now - m_looked >= lookStep ? lookAfter(now) : std::string();
}

std::string Recorder::lookAfter(Time now) {
  m_looked = now;
  const telemetry::SessionStatus status = m_writer->status();
  if (!status.recording) {
    close();
    return status.problem + " File: " + m_path;
  }
  if (status.freeBytes && *status.freeBytes < m_options.leaveBytes) {
    close();
    return "Recording stopped. The disk has only " + megabytes(*status.freeBytes) +
           " left, which the robot's other programs need; free some space or choose another disk. "
           "File: " +
           m_path;
  }
  if (status.bytes >= m_options.fileBytes || now - m_opened >= m_options.fileTime) {
    return nextFile(now);
  }
  if (status.dropped == m_reportedDropped) return {};
  const bool isFirst = std::exchange(m_reportedDropped, status.dropped) == 0;
  return isFirst ? "the disk is too slow: changes are missing in " + m_path : std::string();
}

std::string Recorder::nextFile(Time now) {
  close();
  m_older.push_back(m_path);
  if (const auto opened = open(now); !opened) {
    return "Recording stopped. " + opened.error().text();
  }
  // Each file is complete by itself.
  if (!m_last.empty()) append(m_read, m_last);
  dropOldest();
  return "recording to " + m_path;
}

void Recorder::dropOldest() {
  if (m_options.keepBytes == 0) return;
  std::uint64_t total = m_options.fileBytes;  // of the file that is being written
  for (const std::string& path : m_older) total += sizeOf(path);
  std::error_code gone;
  for (; total > m_options.keepBytes && !m_older.empty(); m_older.pop_front()) {
    total -= sizeOf(m_older.front());
    fs::remove(m_older.front(), gone);
  }
}

/// Ends the file in a thread, because the disk may take its time.
void Recorder::close() {
  m_closing = std::jthread([writer = std::move(m_writer)] { (void)writer->finish(); });
}

void Recorder::note(Time now, const std::string& text) {
  if (m_writer)
    m_writer->append(LogLine{seconds(now), robotName(m_options.robot) + " agent", text});
}

Result<void> Recorder::finish() {
  if (m_closing.joinable()) m_closing.join();
  if (!m_writer) return {};
  if (m_written < m_read && !m_last.empty()) append(m_read, m_last);
  return std::exchange(m_writer, nullptr)->finish();
}

}  // namespace pitchboard::agent
