// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The path of a live match from datagrams and samples of blackboards to robots, events, link
// health, drawings and rows. LiveWatch feeds it from sockets, the command line also from files. It
// has no thread, socket or clock; times are seconds since a moment of the source. Not thread-safe.

#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <robotlink/live/attached_robots.h>
#include <robotlink/live/live_events.h>
#include <robotlink/live/live_rows.h>
#include <robotlink/live/live_state.h>
#include <robotlink/live/live_watch.h>
#include <robotlink/live/sent_boards.h>

namespace pitchboard::link {

/// Passes rows to any number of sinks. A group is added to a sink with its first row.
class RowFan : public telemetry::RowSink {
 public:
  void add(std::shared_ptr<telemetry::RowSink> sink) { m_sinks.push_back({std::move(sink), {}}); }
  void remove(const std::shared_ptr<telemetry::RowSink>& sink);
  bool isEmpty() const { return m_sinks.empty(); }

  telemetry::GroupId addGroup(const telemetry::GroupInfo& info) override;
  telemetry::GroupId renameGroup(std::string_view from, const telemetry::GroupInfo& to) override;
  void append(telemetry::GroupId group, const telemetry::RowView& row) override;

 private:
  struct Sink {
    std::shared_ptr<telemetry::RowSink> rows;
    std::vector<std::optional<telemetry::GroupId>> groups;  // place as in m_groups
  };
  std::size_t placeOf(std::string_view name) const;

  std::vector<telemetry::GroupInfo> m_groups;
  std::vector<Sink> m_sinks;
};

class LivePipeline {
 public:
  /// `zero` is the moment that counts as 0 s. The options must be valid.
  LivePipeline(LiveOptions options, telemetry::WallTime zero);

  const LiveOptions& options() const { return m_options; }
  /// Changes the options; robots and counters are kept.
  void setOptions(LiveOptions options, telemetry::WallTime now);
  /// Forgets robots, referee and counters.
  void clear(telemetry::WallTime now);
  /// Forgets a robot, or one of two programs with its number.
  void forget(const RobotKey& robot, telemetry::WallTime now);

  /// Takes a datagram. The port decides whether it comes from the referee.
  void take(const telemetry::DatagramView& datagram);
  /// Returns the frame of this moment. The robots of `boards` are added, and their rows taken.
  MatchFrame frame(telemetry::WallTime now, AttachedRobots* boards = nullptr);
  /// Takes by how much the computer's clock was set since the beginning, and the ports' states.
  void noticeClock(telemetry::Duration setBy, double time);
  void noticePorts(const telemetry::ReceiverStatus& network, double time);

  /// Returns what is new since the last call, without the frame.
  LiveNews takeNews() { return std::exchange(m_news, {}); }
  /// Returns the status that the pipeline knows; the watch completes it.
  LiveDetails details(telemetry::WallTime now) const;

  void observe(std::shared_ptr<LiveObserver> observer, telemetry::WallTime now);
  void stopObserving(const std::shared_ptr<LiveObserver>& observer);

 private:
  double seconds(telemetry::WallTime time) const { return telemetry::secondsOf(time - m_zero); }
  void takeReferee(const telemetry::DatagramView& datagram);
  void takeVariables(const telemetry::DatagramView& datagram);
  void addBoards(MatchFrame& frame, AttachedRobots* attached, telemetry::WallTime now);
  void useCatalogs();
  void reportSent(telemetry::WallTime now);
  void notify(const LiveDatagram& datagram);
  void notify(const std::vector<MatchEvent>& events);
  void sendSnapshot(telemetry::WallTime now);
  void noteTeams(const std::vector<Renaming>& renamings);

  LiveOptions m_options;
  telemetry::MonitorOptions m_monitorOptions;
  const telemetry::WallTime m_zero;
  LiveState m_state;
  Teams m_teams = m_state.teams(m_options);
  LiveEvents m_events;
  std::shared_ptr<RowFan> m_fan = std::make_shared<RowFan>();
  telemetry::LiveRows m_rows;
  SentBoards m_sent;
  BoardRowKeeper m_boardRows, m_sentHealth;
  std::map<RobotKey, std::string> m_boardNames;  // robots whose blackboards are received
  /// Senders of variables with their numbers, and the robots that they are.
  using SentKey = std::pair<telemetry::Address, int>;
  std::map<SentKey, RobotKey> m_sentRobots;
  double m_nextReport = 0.0, m_nextSnapshot = 0.0, m_nextSentReport = 0.0;  // s
  std::uint64_t m_serial = 0, m_unknownReferee = 0, m_refusedReferees = 0;
  std::string m_unknownReason, m_unknownSample;
  std::uint64_t m_badVariables = 0, m_refusedVariables = 0;
  std::string m_badReason;
  LiveNews m_news;
  std::vector<std::vector<Renaming>> m_renamings;  // that no frame shows yet
  std::vector<std::shared_ptr<LiveObserver>> m_observers;
};

}  // namespace pitchboard::link
