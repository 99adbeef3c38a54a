// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/robot_recording.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <limits>
#include <utility>

#include <base/try.h>
#include <robotlink/session/match_recorder.h>

namespace pitchboard::link {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view recordingEnding = ".mcap";

std::string moreOf(const telemetry::SessionInfo& info, const std::string& key) {
  const auto found = info.more.find(key);
  return found == info.more.end() ? std::string() : found->second;
}

/// "match-003.mcap" and "match.mcap" are "match".
std::string stemOf(std::string name) {
  if (name.ends_with(recordingEnding)) name.resize(name.size() - recordingEnding.size());
  const std::size_t digits = name.find_last_not_of("0123456789");
  const bool hasNumber = digits != std::string::npos && digits > 0 && digits + 1 < name.size();
  if (hasNumber && name[digits] == '-') name.resize(digits);
  return name;
}

std::string fileName(const std::string& path) {
  return fs::path(path).filename().string();
}

}  // namespace

bool isBoardGroup(const telemetry::GroupInfo& group) {
  const telemetry::RobotFacts& facts = factsOf(group);
  return facts.linkOf.empty() && (facts.attached || !facts.sentFrom.empty());
}

Result<RobotRecording::Part> RobotRecording::openPart(const std::string& path) {
  // Before the part: what stands before a TRY in a braced list is not destroyed when it returns.
  telemetry::SessionReader reader = TRY(telemetry::SessionReader::open(path));
  Part part{path, 1, std::move(reader)};
  const std::string number = moreOf(part.reader.info(), "part");
  std::from_chars(number.data(), number.data() + number.size(), part.number);
  const auto groups = part.reader.groups();
  const auto found = std::ranges::find_if(
      groups, [](const telemetry::SessionGroup& group) { return isBoardGroup(group.info); });
  if (found == groups.end() || !part.reader.range()) {
    return failure(ErrorCode::NotFound,
                   "This is not the recording of a robot by pitchboard-agent --record: it has no "
                   "blackboard.",
                   path);
  }
  part.group = static_cast<telemetry::GroupId>(found - groups.begin());
  return part;
}

Result<RobotRecording> RobotRecording::open(const std::string& path) {
  RobotRecording recording;
  recording.m_parts.push_back(TRY(openPart(path)));
  recording.addOthers();
  recording.m_range = *recording.m_parts.front().reader.range();
  for (const Part& part : recording.m_parts) {
    const telemetry::TimeRange range = *part.reader.range();
    recording.m_range.begin = std::min(recording.m_range.begin, range.begin);
    recording.m_range.end = std::max(recording.m_range.end, range.end);
  }
  return recording;
}

/// The other files of the same start of the agent.
void RobotRecording::addOthers() {
  const Part& given = m_parts.front();
  const std::string clock = moreOf(given.reader.info(), "clock_us");
  if (clock.empty()) return;  // not split: it was not written by the agent
  const fs::path folder = fs::absolute(given.path).parent_path();
  const std::string stem = stemOf(fileName(given.path));
  std::vector<std::string> beside;
  std::error_code problem, unknown;
  for (fs::directory_iterator it(folder, problem), end; !problem && it != end;
       it.increment(problem)) {
    const std::string name = it->path().filename().string();
    const bool isIt = fs::equivalent(it->path(), given.path, unknown);
    if (stemOf(name) == stem && !isIt && it->is_regular_file(unknown)) {
      beside.push_back(it->path().string());
    }
  }
  std::ranges::sort(beside);
  if (beside.size() >= maxFiles) beside.resize(maxFiles - 1);
  const telemetry::WallTime start = given.reader.info().start;
  const telemetry::GroupInfo group = info(given);
  for (const std::string& path : beside) {
    auto part = openPart(path);
    if (!part) {
      // What cannot be read at all may be something else, or the file that a power cut left empty.
      m_notes.push_back(fileName(path) + " is left out: " + part.error().message);
    } else if (moreOf(part->reader.info(), "clock_us") == clock &&
               part->reader.info().start == start && info(*part).columns == group.columns) {
      m_parts.push_back(*std::move(part));
    }
  }
  std::ranges::sort(m_parts, {}, &Part::number);
  for (std::size_t i = 1; i < m_parts.size(); ++i) {
    const int before = m_parts[i - 1].number, next = m_parts[i].number;
    if (next <= before + 1) continue;
    m_notes.push_back("Between " + fileName(m_parts[i - 1].path) + " and " +
                      fileName(m_parts[i].path) + " a file of the recording is missing.");
  }
}

Result<std::string> RobotRecording::catalog() const {
  return m_parts.front().reader.attachment(catalogAttachment);
}

void RobotRecording::rows(telemetry::TimeRange range,
                          const std::function<bool(const telemetry::RowView&)>& visit) const {
  double last = -std::numeric_limits<double>::infinity();
  bool goesOn = true;
  for (std::size_t i = 0; i < m_parts.size() && goesOn; ++i) {
    const Part& part = m_parts[i];
    const telemetry::TimeRange own = *part.reader.range();
    if (own.end < range.begin || own.begin > range.end) continue;
    const std::array<telemetry::GroupId, 1> only{part.group};
    bool isFirst = i > 0;
    part.reader.rows(range, only, [&](telemetry::GroupId, const telemetry::RowView& row) {
      // Each file begins with the newest values of the one before.
      if (isFirst && row.time <= last) return true;
      isFirst = false;
      last = row.time;
      goesOn = visit(row);
      return goesOn;
    });
  }
}

}  // namespace pitchboard::link
