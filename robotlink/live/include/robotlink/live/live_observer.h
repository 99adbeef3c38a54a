// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a live match tells: every datagram and how it was used, messages of topics, events, log
// lines, frames and rows as they come, to observers; news and details on demand.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <robotlink/frame/match_event.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/frame/teams.h>
#include <robotlink/live/attached_robots.h>
#include <robotlink/live/live_rows.h>
#include <robotlink/live/live_topics.h>
#include <robotlink/live/sent_boards.h>
#include <telemetry/monitor/team_monitor.h>
#include <telemetry/referee/gamecontroller.h>
#include <telemetry/referee/referee_tracker.h>
#include <telemetry/sockets/udp_receiver.h>

namespace pitchboard::link {

/// Details for the status line and tables that are not part of a frame.
struct LiveDetails {
  telemetry::TeamStatus team;
  telemetry::ReceiverStatus network;
  std::string networkProblem;  ///< why nothing can be received; empty: no problem
  telemetry::RefereeTracker::Counts referee;
  std::uint64_t unknownReferee = 0;  ///< packets on the referee's port that could not be decoded
  std::string unknownRefereeReason;  ///< for the last such packet
  std::string unknownRefereeSample;
  Teams teams;  ///< for robotName()
  std::vector<AttachedStatus> boards;
  std::vector<SentStatus> sent;           ///< variables that robots send
  std::uint64_t badVariables = 0;         ///< invalid datagrams on the ports of variables
  std::string badVariablesReason;         ///< for the last such datagram
  std::uint64_t refusedVariables = 0;     ///< refused by the list of senders or the limit of robots
  std::uint64_t ignoredSimulated = 0;     ///< of simulated matches, without LiveOptions::simulated
  std::string sharedPorts;                ///< telemetry::sharedPortsText()
  std::uint64_t refusedReferees = 0;      ///< refused by LiveOptions::refereeSenders
  std::vector<TopicSourceStatus> topics;  ///< programs that send topics
  std::string monitorProblem;             ///< why the last monitor request could not be sent
  LiveRows::Refused rows;                 ///< rows and values beyond the limits, since clear()
};

/// What is new since the last call of LiveWatch::take().
struct LiveNews {
  static constexpr std::size_t maxEvents = 10'000, maxLines = 10'000;
  std::vector<MatchEvent> events;           ///< at most the newest maxEvents
  std::vector<LogLine> lines;               ///< of robots' logs; at most the newest maxLines
  std::shared_ptr<const MatchFrame> frame;  ///< the newest frame; null before the first

  void add(std::vector<MatchEvent> later);
  void add(std::vector<LogLine> later);
};

/// A received datagram and how it was decoded. Valid only during the call that passes it.
struct LiveDatagram {
  using Verdict = telemetry::TeamMonitor::Verdict;
  double time = 0.0;  ///< s from the beginning to the arrival
  const telemetry::DatagramView& view;
  const Teams& teams;                                         ///< for robotName()
  const Result<telemetry::RefereePacket>* referee = nullptr;  ///< null on other ports
  /// How a robot's message was used; empty if it contains only drawings.
  std::optional<Verdict> verdict{};
  const telemetry::TextDecoder* decoder = nullptr;  ///< null without a verdict
  const telemetry::DecodedText* decoded = nullptr;  ///< null without a verdict
  /// The robot's key in the frames; number 0 if the message does not identify its robot.
  RobotKey robot{};
  std::optional<std::string> drawingProblem{};  ///< why its drawing cannot be shown
  /// Null on ports other than those of variables.
  const Result<telemetry::Pb2Message>* variables = nullptr;
  std::optional<SentBoards::Verdict> variablesVerdict{};  ///< empty if it could not be decoded

  bool isFromRefusedSender() const { return verdict == Verdict::SenderRefused; }
  /// Returns the referee's state; null if this is no such packet.
  const telemetry::RefereeState* state() const {
    return referee && *referee ? std::get_if<telemetry::RefereeState>(&**referee) : nullptr;
  }
};

/// Receives everything that goes into and comes out of a LivePipeline, for recording and printing.
/// All functions, rows() and the sink that it returns included, are called on the pipeline's
/// thread, which is that of LiveWatch, and on no other. Must not block.
class LiveObserver {
 public:
  virtual ~LiveObserver() = default;
  /// Called for each datagram, except on the referee's port for those of refused senders.
  virtual void received(const LiveDatagram&) {}
  /// Called for each message of a topic that was decoded.
  virtual void decoded(const LiveTopicMessage&) {}
  /// Called for each line of a robot's log.
  virtual void logged(const LogLine&) {}
  virtual void happened(const MatchEvent&) {}
  virtual void frameMade(const MatchFrame&) {}
  /// Passes a checkpoint: the whole state as text (LiveState::text). Called first when the observer
  /// is added; then every 15 s, when options change, and after clear().
  virtual void remembered(double /*time*/, std::string_view /*state*/) {}
  /// Returns where to write the rows of robots, links and attached blackboards; null: nowhere.
  virtual std::shared_ptr<telemetry::RowSink> rows() { return nullptr; }
};

}  // namespace pitchboard::link
