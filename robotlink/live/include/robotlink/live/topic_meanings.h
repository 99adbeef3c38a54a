// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a mapping (topic_mapping.h) finds in messages besides robots: log lines, a referee, and
// which of a message's two times counts. For recordings and live sources. Not thread-safe.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <base/log_line.h>
#include <robotlink/live/topic_mapping.h>
#include <robotlink/live/topic_path.h>

namespace pitchboard::link {

/// Makes log lines of messages.
class TopicLog {
 public:
  explicit TopicLog(const TopicMapping& mapping);
  /// Returns the line of a message at `time` (s); nothing if it has none.
  std::optional<LogLine> lineOf(const telemetry::RecordedTopic& topic,
                                const telemetry::RecordedMessage& message, double time) const;

 private:
  struct Paths {
    std::string topic;
    TopicPath text, level, origin;
  };
  std::vector<Paths> m_paths;
};

/// Makes packets of a GameController of messages with a referee's state.
class TopicReferee {
 public:
  explicit TopicReferee(const MappedReferee& mapped);
  /// Returns a packet of the version that says most; nothing if the message has no state.
  std::optional<std::string> packetOf(const telemetry::RecordedTopic& topic,
                                      const telemetry::RecordedMessage& message);

 private:
  MappedReferee m_mapped;
  TopicPath m_state, m_secondsLeft, m_firstHalf, m_leftScore, m_rightScore;
  int m_packets = 0;
};

/// Which time of a message counts: when it was measured, unless the first of a source is more than
/// a minute from when it was written, so that the two are of different clocks.
class StampChoice {
 public:
  /// Returns the time of a message, in ns.
  std::int64_t timeOf(const telemetry::RecordedMessage& message);
  /// Returns whether the times of measuring are used; nothing before the first one.
  std::optional<bool> usesStamps() const { return m_usesStamps; }
  /// Messages whose two times differ by more than a minute although others' do not.
  std::uint64_t odd() const { return m_odd; }

 private:
  std::optional<bool> m_usesStamps;
  std::uint64_t m_odd = 0;
};

}  // namespace pitchboard::link
