// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The path of a live match from datagrams, messages of topics and samples of blackboards to robots,
// events, link health, drawings and rows. LiveWatch feeds it from sockets, the command line also
// from files. It has no thread, socket or clock; times are seconds since a moment of the source.
// Not thread-safe.

#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <robotlink/live/attached_robots.h>
#include <robotlink/live/live_events.h>
#include <robotlink/live/live_observer.h>
#include <robotlink/live/live_rows.h>
#include <robotlink/live/live_state.h>
#include <robotlink/live/live_topics.h>
#include <robotlink/live/robot_uids.h>
#include <robotlink/live/sent_boards.h>

namespace pitchboard::link {

/// Passes rows to any number of sinks. A group is added to a sink with its first row. Between
/// hold() and release(), names and facts of known groups are kept back, so that all sinks get
/// them together: robots may exchange their names.
class RowFan : public telemetry::RowSink {
 public:
  void add(std::shared_ptr<telemetry::RowSink> sink) { m_sinks.push_back({std::move(sink), {}}); }
  void remove(const std::shared_ptr<telemetry::RowSink>& sink);
  bool isEmpty() const { return m_sinks.empty(); }

  telemetry::GroupId addGroup(const telemetry::GroupInfo& info) override;
  void describeGroups(std::span<const telemetry::GroupInfo> groups) override;
  void hold() { m_isHeld = true; }
  void release();
  void append(telemetry::GroupId group, const telemetry::RowView& row) override;

 private:
  struct Sink {
    std::shared_ptr<telemetry::RowSink> rows;
    std::vector<std::optional<telemetry::GroupId>> groups;  // index as in m_groups
  };
  std::size_t indexOf(const telemetry::GroupInfo& group) const;

  std::vector<telemetry::GroupInfo> m_groups;
  std::vector<Sink> m_sinks;
  std::set<std::size_t> m_described;  // groups that the sinks know otherwise
  bool m_isHeld = false;
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
  void forget(RobotUid robot, telemetry::WallTime now);

  /// Takes a datagram. The port decides whether it comes from the referee.
  void take(const telemetry::DatagramView& received);
  /// Takes what has come from a program of LiveOptions::foxglove, and how its connection is.
  /// Returns to which of its channels to subscribe.
  TopicRequest take(const FoxgloveSource& source, const telemetry::FoxgloveEvent& event) {
    return m_topics.take(source, event);
  }
  void note(const FoxgloveSource& source, telemetry::FoxgloveClientStatus status) {
    m_topics.note(source, std::move(status));
  }
  /// Returns the frame of this moment, with the robots of `boards`. It changes nothing.
  MatchFrame frame(telemetry::WallTime now, const AttachedRobots* boards = nullptr) const;
  /// Does what is due: passes on rows, events and reports, and the frame, which it returns. The
  /// rows of `boards` are taken.
  MatchFrame advance(telemetry::WallTime now, AttachedRobots* boards = nullptr);
  /// Takes by how much the computer's clock was set since the beginning, and the ports' states.
  void noticeClock(telemetry::Duration setBy, double time);
  void noticePorts(const telemetry::ReceiverStatus& network, double time);
  /// Returns telemetry::sharedPortsText() for the ports of the options.
  std::string sharedPorts(const telemetry::ReceiverStatus& network) const;

  /// Returns what is new since the last call, without the frame.
  LiveNews drainNews() { return std::exchange(m_news, {}); }
  /// Returns the status that the pipeline knows; the watch completes it.
  LiveDetails details(telemetry::WallTime now) const;

  void observe(std::shared_ptr<LiveObserver> observer, telemetry::WallTime now);
  void stopObserving(const std::shared_ptr<LiveObserver>& observer);

 private:
  using SentKey = std::pair<telemetry::Address, int>;  // who sends variables, and its number
  double seconds(telemetry::WallTime time) const { return telemetry::secondsOf(time - m_zero); }
  void takeReferee(const telemetry::DatagramView& datagram);
  void takeVariables(const telemetry::DatagramView& datagram);
  /// A robot of a frame whose blackboard is received.
  struct Board {
    SentKey sender;
    std::optional<int> key;  // of an attached one
    std::string group;       // of its rows, if it is sent
    RobotUid robot;
  };
  MatchFrame join(const telemetry::TeamStatus& team, const AttachedRobots* attached,
                  telemetry::WallTime now, std::vector<Board>& boards) const;
  void nameBoards(const MatchFrame& frame, const std::vector<Board>& boards,
                  telemetry::WallTime now);
  void useCatalogs();
  void nameGroups(telemetry::WallTime now);
  std::map<std::string, BoardRowKeeper::Facts> agentFacts(const std::vector<SentStatus>& all) const;
  void reportSent(telemetry::WallTime now);
  std::optional<int> teamOf(int number, telemetry::Address sender) const;
  void notify(const LiveDatagram& datagram);
  void notify(const std::vector<MatchEvent>& events);
  void notify(const LogLine& line);
  LiveTopics::Outputs topicOutputs();
  void useSources();
  void sendSnapshot(telemetry::WallTime now);
  void noteTeams();

  LiveOptions m_options;
  telemetry::MonitorOptions m_monitorOptions;
  const telemetry::WallTime m_zero;
  telemetry::WallTime m_saved = telemetry::WallTime::min();  // of the newest saved state
  LiveState m_state;
  Teams m_teams = m_state.teams(m_options);
  LiveEvents m_events;
  std::shared_ptr<RowFan> m_fan = std::make_shared<RowFan>();
  LiveRows m_rows;
  bool m_hasNewNames = false;  // that the groups of rows do not have yet
  SentBoards m_sent;
  LiveTopics m_topics;
  BoardRowKeeper m_boardRows, m_sentHealth;
  std::map<RobotUid, std::string> m_boardNames;  // robots whose blackboards are received
  std::map<std::string, BoardRowKeeper::Facts> m_boardFacts;  // the same, by GroupInfo::id
  /// The robots that senders of variables are.
  std::map<SentKey, RobotUid> m_sentRobots;
  double m_nextReport = 0.0, m_nextSnapshot = 0.0, m_nextSentReport = 0.0;  // s
  std::uint64_t m_serial = 0, m_unknownReferee = 0, m_refusedReferees = 0, m_ignoredSimulated = 0;
  std::string m_unknownReason, m_unknownSample;
  std::uint64_t m_badVariables = 0, m_refusedVariables = 0;
  std::string m_badReason;
  LiveNews m_news;
  std::vector<std::shared_ptr<LiveObserver>> m_observers;
};

}  // namespace pitchboard::link
