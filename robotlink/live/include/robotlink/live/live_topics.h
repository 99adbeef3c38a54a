// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What Live makes of programs that send topics (FoxgloveSource): their messages are decoded and
// mapped as those of recordings, and become rows of topics, robots, log lines and a referee. Part
// of a LivePipeline, used on its thread; it has no thread or clock. Times are seconds since the
// pipeline's zero. Messages get the times at which they were measured, or else sent, by a
// minimum-delay filter for each source (ClockMap); the shortest delay itself cannot be known.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <base/log_line.h>
#include <robotlink/frame/match_event.h>
#include <robotlink/frame/robot_frame.h>
#include <robotlink/live/attached_robots.h>
#include <robotlink/live/foxglove_source.h>
#include <telemetry/foxglove/foxglove_client.h>
#include <telemetry/recordings/recording.h>
#include <telemetry/series/row_sink.h>

namespace pitchboard::link {

/// A message of a topic that was decoded. Valid only during the call that passes it.
struct LiveTopicMessage {
  double time = 0.0;  ///< s, of its row
  telemetry::WallTime arrival{};
  const FoxgloveSource& source;
  const telemetry::RecordedTopic& topic;
  const telemetry::RecordedMessage& message;
};

/// How a source is.
struct TopicSourceStatus {
  FoxgloveSource source;
  telemetry::FoxgloveClientStatus client;
  std::size_t channels = 0;         ///< that the program has now
  std::size_t decoded = 0;          ///< of them: subscribed to
  std::size_t skipped = 0;          ///< of them: images and point clouds
  std::vector<std::string> unread;  ///< why the others are not read: "/topic: reason"
  std::uint64_t wrong = 0;          ///< messages that are not what their schema says
  std::uint64_t old = 0;  ///< messages that were under way for long; they count from their arrival
  double rate = 0.0;      ///< messages per second
  double delay = 0.0;     ///< s, of the last message above the shortest one
  double jitter = 0.0;    ///< s, mean change of the delay
  double clockOffset = 0.0;  ///< s, our time of day minus the source's; includes the shortest delay
  std::uint64_t restarts = 0;  ///< of the source's clock
};

/// Channels to subscribe to: FoxgloveClient::subscribe().
struct TopicRequest {
  std::uint64_t session = 0;
  std::vector<std::uint32_t> channels;
};

class LiveTopics {
 public:
  static constexpr std::size_t maxTopics = 4000;  ///< of a source, over all its sessions
  static constexpr double longDelay = 10.0;       ///< s; older messages count from their arrival

  struct Outputs {
    telemetry::RowSink& rows;  ///< of topics and sources; must outlive this
    std::function<void(LogLine)> log;
    std::function<void(const std::string& packet, telemetry::WallTime arrival)> referee;
    std::function<void(const LiveTopicMessage&)> decoded;
  };
  LiveTopics(Outputs outputs, telemetry::WallTime zero);
  ~LiveTopics();

  /// Sources that are missing end with their robots; their rows are kept. A mapping that can no
  /// longer be read counts as the usual one.
  void setSources(const std::vector<FoxgloveSource>& sources, const sim::FieldSpec& field,
                  double timeout);
  /// Takes what has come from a source.
  TopicRequest take(const FoxgloveSource& source, const telemetry::FoxgloveEvent& event);
  void note(const FoxgloveSource& source, telemetry::FoxgloveClientStatus status);

  /// Returns the robots for joinBoards(). Their name is the id of their group.
  std::vector<RobotFrame> robots(double time) const;
  /// Calls `take` with the rows of robots since the last call.
  void drainRows(const BoardRowsTaker& take);
  /// Returns falls since the last call.
  std::vector<MatchEvent> drainEvents();
  /// Adds a row about each source's link.
  void report(telemetry::WallTime now);
  /// Returns the address of a robot's source; empty if it is of none.
  std::string sourceOf(RobotUid robot) const;
  std::vector<TopicSourceStatus> status(telemetry::WallTime now) const;

  /// Does not show a robot until its next message.
  void forget(RobotUid robot);
  /// Forgets robots and counters.
  void clear();

 private:
  struct Known;
  struct Source;
  struct Groups;
  class RobotRowKeeper;
  Source* find(const FoxgloveSource& source) const;
  void begin(Source& source);
  TopicRequest add(Source& source, const std::vector<telemetry::FoxgloveChannel>& channels);
  void receive(Source& source, const telemetry::FoxgloveReceived& message);
  void map(Source& source);
  int freeNumber(TeamColor team, int wanted) const;
  Known* knownAt(const telemetry::FoxgloveAddress& address);

  const Outputs m_outputs;
  const telemetry::WallTime m_zero;
  sim::FieldSpec m_field;
  double m_timeout = 10.0;  // s
  std::unique_ptr<RobotRowKeeper> m_robotRows;
  std::unique_ptr<Groups> m_groups;
  std::vector<std::unique_ptr<Known>> m_known;  // all sources so far: their places identify robots
  std::vector<std::unique_ptr<Source>> m_sources;
};

}  // namespace pitchboard::link
