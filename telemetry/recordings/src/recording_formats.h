// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The functions of each format, for the list in recording.cpp. Private to recordings.

#include <telemetry/recordings/recording.h>

namespace pitchboard::telemetry {

using RecordingProgress = std::function<bool(double)>;
using OpenedRecording = Result<std::unique_ptr<RecordingReader>>;

bool isMcapRecording(const std::string& path, std::string_view beginning);
OpenedRecording openMcapRecording(const std::vector<std::string>& files,
                                  const RecordingProgress& progress);

bool isRosbag2Database(const std::string& path, std::string_view beginning);
OpenedRecording openRosbag2Database(const std::vector<std::string>& files,
                                    const RecordingProgress& progress);

bool isRefereeLog(const std::string& path, std::string_view beginning);
OpenedRecording openRefereeLog(const std::vector<std::string>& files,
                               const RecordingProgress& progress);

bool isCsvRecording(const std::string& path, std::string_view beginning);
OpenedRecording openCsvRecording(const std::vector<std::string>& files,
                                 const RecordingProgress& progress);

}  // namespace pitchboard::telemetry
