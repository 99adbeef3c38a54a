// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Shows a match to programs that speak Foxglove's protocol (FoxgloveServer): rows, events and log
// lines as JSON messages, and the field with robots and ball as a foxglove.SceneUpdate. Times are
// seconds of the source. One thread at a time; nothing waits for a client.

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <base/log_line.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/live/live_observer.h>
#include <robotlink/match/tick_observer.h>
#include <telemetry/foxglove/foxglove_server.h>
#include <telemetry/series/row_sink.h>
#include <telemetry/session/session_types.h>

namespace pitchboard::link {

/// Converts seconds of a source that began at this time to ns since 1970.
std::function<std::uint64_t(double)> logTimesFrom(telemetry::WallTime start);

/// Topics: those of rows in session files ("/robots/B1/row", "/match/row"), "/events", "/log" and
/// "/field". Messages of rows and of the field are made when somebody reads them.
class ServedMatch : public telemetry::RowSink {
 public:
  /// The server must live as long. `logTime` converts seconds of the source to ns since 1970.
  ServedMatch(telemetry::FoxgloveServer& server, std::function<std::uint64_t(double)> logTime);

  telemetry::GroupId addGroup(const telemetry::GroupInfo& info) override;
  void append(telemetry::GroupId group, const telemetry::RowView& row) override;
  void append(const telemetry::SessionEvent& event);
  void append(const LogLine& line);
  /// Shows the field: its lines, the robots where they are (or where they believe to be, if the
  /// truth is unknown), what they believe, and the ball.
  void show(const MatchFrame& frame);
  /// The present time of what is shown.
  void setTime(double time);

 private:
  struct Columns;
  struct Group {
    telemetry::GroupInfo info;
    std::uint32_t channel = 0;
    std::shared_ptr<const Columns> columns;  ///< shared with messages that nobody asked for yet
  };

  telemetry::FoxgloveServer& m_server;
  std::function<std::uint64_t(double)> m_logTime;
  std::vector<Group> m_groups;
  std::uint32_t m_nextChannel = 4;  // those below are field, events and log
};

/// Serves a simulated match while it is played: rows of a MatchSampler with served() as sink,
/// events, log lines, and the field as often as there are rows.
class MatchServing : public TickObserver {
 public:
  /// `everyNth`: ticks from one picture of the field to the next.
  MatchServing(std::shared_ptr<ServedMatch> served, int everyNth)
      : m_served(std::move(served)), m_everyNth(everyNth) {}
  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) override;
  void happened(std::span<const MatchEvent> events) override;
  void logged(const LogLine& line) override;

 private:
  std::shared_ptr<ServedMatch> m_served;
  int m_everyNth;
  sim::Snapshot m_snapshot;
};

/// Serves live robots.
class LiveServing : public LiveObserver {
 public:
  explicit LiveServing(std::shared_ptr<ServedMatch> served) : m_served(std::move(served)) {}
  void happened(const MatchEvent& event) override;
  void frameMade(const MatchFrame& frame) override;
  std::shared_ptr<telemetry::RowSink> rows() override { return m_served; }

 private:
  std::shared_ptr<ServedMatch> m_served;
};

}  // namespace pitchboard::link
