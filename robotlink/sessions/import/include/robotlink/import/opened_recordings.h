// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Recordings that are read together on one clock: which time of a message counts, and by how much a
// recording is moved. Times are ns since 1970, or since an unknown moment. One thread.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <base/result.h>
#include <robotlink/live/topic_mapping.h>
#include <robotlink/live/topic_meanings.h>
#include <telemetry/recordings/recording.h>

namespace pitchboard::link {

struct OpenedRecording {
  std::unique_ptr<telemetry::RecordingReader> reader;
  MappedRecording timing{};
  telemetry::RecordedItem item = telemetry::RecordedItem::End;
  StampChoice stamps{};   ///< with RecordingClock::Auto
  std::int64_t time = 0;  ///< of the item

  /// Moves to the next item.
  Result<void> step();
};

/// Returns the name of a file or folder without those that it is in, as MappedRecording has it.
std::string fileNameOf(const std::string& path);
/// Opens files and folders. Those that `recordings` name are read each by itself; the others of one
/// format are a split recording. Fails as telemetry::openRecordings() does.
Result<std::vector<OpenedRecording>> openTogether(const std::vector<std::string>& files,
                                                  const std::vector<MappedRecording>& recordings,
                                                  const std::function<bool(double)>& progress = {});
/// Returns the one with the earliest item; null at the end of all.
OpenedRecording* earliestOf(std::vector<OpenedRecording>& recordings);
/// Returns the topics of all.
std::vector<telemetry::RecordedTopic> topicsOf(const std::vector<OpenedRecording>& recordings);

}  // namespace pitchboard::link
