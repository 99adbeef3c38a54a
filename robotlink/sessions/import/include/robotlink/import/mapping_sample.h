// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a mapping makes of recordings at a moment, for who makes one: all topics with their fields
// and last values until then, and the robots. The recordings are read from their beginning, by the
// code that imports them. Any thread; one call at a time.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <base/result.h>
#include <robotlink/frame/robot_frame.h>
#include <robotlink/import/mapping_slots.h>
#include <robotlink/import/opened_recordings.h>
#include <telemetry/recordings/recording.h>

namespace pitchboard::link {

/// Opens what is read, anew for each sample, with the times that a mapping gives to recordings.
using OpenRecordings =
    std::function<Result<std::vector<OpenedRecording>>(const std::vector<MappedRecording>&)>;

/// A topic, and the values of its last message of each shape, as texts for people.
struct SampledTopic : TopicFields {
  std::vector<std::string> values;  ///< one for each field
  std::uint64_t messages = 0;
};

/// When a recording has messages, in s from the first message of all.
struct SampledRecording {
  MappedRecording timing;  ///< `file` is empty for a split recording and for a program's messages
  double begin = 0.0, end = 0.0;
};

struct MappingSample {
  std::vector<SampledTopic> topics;
  TopicMapping mapping;  ///< the one that was given, or the usual one
  sim::FieldSpec field;
  std::vector<RobotFrame> robots;
  std::vector<SampledRecording> recordings;
  double time = 0.0, end = 0.0;  ///< s from the first message: the moment, and the last message
};

/// Reads until `seconds` behind the first message; without, to the end. With `seconds` the end is
/// not known. Fails as the recordings do, and with Conflict if `goesOn` returns false.
Result<MappingSample> sampleMapping(const OpenRecordings& open,
                                    const std::optional<TopicMapping>& mapping,
                                    std::optional<double> seconds,
                                    const std::function<bool()>& goesOn);

}  // namespace pitchboard::link
