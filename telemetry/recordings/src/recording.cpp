// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/recordings/recording.h>

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>

#include <base/byte_sizes.h>
#include <base/system_reason.h>
#include <base/try.h>
#include <base/unique_fd.h>

#include "recording_formats.h"

namespace pitchboard::telemetry {
namespace {

// A new format is a file and a line here. The first that recognizes a file has it.
constexpr std::array formatList{
    RecordingFormat{"MCAP", isMcapRecording, openMcapRecording},
    RecordingFormat{"rosbag2 (sqlite3)", isRosbag2Database, openRosbag2Database},
    RecordingFormat{"GameController log (YAML)", isRefereeLog, openRefereeLog},
    RecordingFormat{"CSV", isCsvRecording, openCsvRecording},
};

Result<std::string> beginningOf(const std::string& path) {
  const UniqueFd file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::string bytes(4 * kibibyte, '\0');
  const ssize_t got = file ? ::read(file.get(), bytes.data(), bytes.size()) : -1;
  if (got < 0) {
    return failure(errno == ENOENT ? ErrorCode::NotFound : ErrorCode::SystemError,
                   "The file cannot be read: " + systemReason(errno) + ".", path);
  }
  bytes.resize(static_cast<std::size_t>(got));
  return bytes;
}

/// The recordings in a folder, as rosbag2 writes it: parts of a recording, in order.
Result<std::vector<std::string>> recordingsIn(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code problem;
  for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".mcap" || ending == ".db3") files.push_back(entry.path().string());
  }
  if (problem) {
    return failure(ErrorCode::SystemError, "The folder cannot be read: " + problem.message() + ".",
                   folder);
  }
  if (files.empty()) {
    return failure(ErrorCode::NotFound,
                   "There is no recording (*.mcap, *.db3) in this folder. Name the files.", folder);
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

std::span<const RecordingFormat> recordingFormats() {
  return formatList;
}

Result<const RecordingFormat*> recordingFormatOf(const std::string& path) {
  const auto beginning = TRY(beginningOf(path));
  std::string names;
  for (const RecordingFormat& format : formatList) {
    if (format.recognizes(path, beginning)) return &format;
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  }
  return failure(ErrorCode::Unsupported,
                 beginning.empty()
                     ? "The file is empty."
                     : "The format of this file is unknown. Known are: " + names + ".",
                 path);
}

Result<std::vector<std::unique_ptr<RecordingReader>>> openRecordings(
    const std::vector<std::string>& paths, const std::function<bool(double)>& progress) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    std::error_code problem;
    if (std::filesystem::is_directory(path, problem)) {
      const auto inside = TRY(recordingsIn(path));
      files.insert(files.end(), inside.begin(), inside.end());
    } else {
      files.push_back(path);
    }
  }
  std::vector<std::pair<const RecordingFormat*, std::vector<std::string>>> parts;
  for (const std::string& file : files) {
    const RecordingFormat* format = TRY(recordingFormatOf(file));
    const auto known = std::ranges::find(parts, format, &decltype(parts)::value_type::first);
    if (known == parts.end()) {
      parts.push_back({format, {file}});
    } else {
      known->second.push_back(file);
    }
  }
  std::vector<std::unique_ptr<RecordingReader>> readers;
  for (const auto& [format, own] : parts) readers.push_back(TRY(format->open(own, progress)));
  return readers;
}

}  // namespace pitchboard::telemetry
