// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Watches a match of real robots. It receives and decodes their messages on threads of its own and
// provides frames (only the newest is kept) and events, with times of one clock (LiveClock). It
// sends nothing, except the monitor request to a referee if that is turned on. All public functions
// may be called from any thread.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/frame/match_event.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/frame/teams.h>
#include <robotlink/live/attached_robots.h>
#include <robotlink/live/live_rows.h>
#include <robotlink/live/sent_boards.h>
#include <simcore/simulation/simulation.h>
#include <telemetry/pb2/pb2.h>
#include <telemetry/wire/gamecontroller.h>
#include <telemetry/wire/live_clock.h>
#include <telemetry/wire/monitor_request.h>
#include <telemetry/wire/referee_tracker.h>
#include <telemetry/wire/team_monitor.h>
#include <telemetry/wire/udp_receiver.h>

namespace pitchboard::link {

struct LiveOptions {
  LiveOptions() { team.battery = telemetry::usualBattery; }
  telemetry::Address bind{};  ///< 0.0.0.0: all interfaces, unicast and broadcast
  int portBase = 1240;        ///< robot n sends to portBase + n
  int robots = 16;            ///< number of robots' ports
  int refereePort = 3838;
  /// Robot n sends its variables to this port + n (docs/agent.md); 0: do not receive variables.
  int variablesPortBase = telemetry::pb2PortBase;
  int refereeVersion = 0;                    ///< packet version to show; 0: the highest received
  telemetry::SenderFilter refereeSenders{};  ///< for robots, see `team`
  telemetry::Profile profile = telemetry::publishedProfile();
  telemetry::MonitorOptions team;
  int ourTeam = 0;                       ///< our team's number at the referee; 0: not chosen
  std::optional<TeamColor> ourColour{};  ///< set if our team was chosen by its colour
  bool colourByNumber = false;           ///< the colour follows from the robot's number (published)
  sim::FieldSpec field;
  std::vector<AttachedBoard> boards;          ///< blackboards on this computer
  std::vector<std::string> catalogs;          ///< files that list the variables robots send
  std::optional<telemetry::Address> monitor;  ///< referee to ask for monitor mode; empty: off
  std::uint16_t monitorPort = telemetry::monitorRequestPort;
};

/// Returns all ports to receive on. Error InvalidArgument if a port is out of range or used twice.
Result<std::vector<std::uint16_t>> portsOf(const LiveOptions& options);
/// Fails as portsOf() does, and if a file cannot be read.
Result<void> validate(const LiveOptions& options);

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
  std::vector<SentStatus> sent;        ///< variables that robots send
  std::uint64_t badVariables = 0;      ///< invalid datagrams on the ports of variables
  std::string badVariablesReason;      ///< for the last such datagram
  std::uint64_t refusedVariables = 0;  ///< refused by the list of senders or the limit of robots
  std::uint64_t refusedReferees = 0;   ///< refused by LiveOptions::refereeSenders
  std::string monitorProblem;          ///< why the last monitor request could not be sent
  telemetry::LiveRows::Refused rows;   ///< rows and values beyond the limits, since clear()
};

/// What is new since the last call of LiveWatch::take(). Apply the members in this order.
struct LiveNews {
  std::vector<std::vector<Renaming>> renamings;  ///< apply one after the other, before `frame`
  std::vector<MatchEvent> events;                ///< at most the newest 10 000
  std::shared_ptr<const MatchFrame> frame;       ///< the newest frame; null before the first
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
/// Called on the pipeline's thread, which is that of LiveWatch. Must not block.
class LiveObserver {
 public:
  virtual ~LiveObserver() = default;
  /// Called for each datagram, except on the referee's port for those of refused senders.
  virtual void received(const LiveDatagram&) {}
  virtual void happened(const MatchEvent&) {}
  virtual void frameMade(const MatchFrame&) {}
  /// Passes a checkpoint: the whole state as text (LiveState::text). Called first when the observer
  /// is added, on the thread that adds it; then every 15 s, when options change, and after clear().
  /// No other function is called at the same time.
  virtual void remembered(double /*time*/, std::string_view /*state*/) {}
  /// Returns where to write the rows of robots, links and attached blackboards; null: nowhere.
  virtual std::shared_ptr<telemetry::RowSink> rows() { return nullptr; }
};

class LiveWatch {
 public:
  /// `onFrame` is called on the watch's thread when a new frame can be taken; it must not block.
  /// The options must be valid, see validate().
  explicit LiveWatch(LiveOptions options, std::function<void()> onFrame = {},
                     telemetry::ClockSource clock = telemetry::ClockSource::system());
  ~LiveWatch();  ///< stops receiving and waits for the threads
  LiveWatch(const LiveWatch&) = delete;
  LiveWatch& operator=(const LiveWatch&) = delete;

  /// Changes the options. Robots, link states and counters are kept; sockets are bound again if the
  /// ports differ.
  void setOptions(LiveOptions options);
  /// Forgets robots, referee and counters.
  void clear();
  /// Forgets a robot or second sender. It appears again with its next message.
  void forget(const RobotKey& robot);

  /// Returns the news and requests the next `onFrame`.
  LiveNews take();
  LiveDetails details() const;

  /// Returns the time of day at 0 s, by the computer's clock at that moment.
  telemetry::WallTime began() const;
  void observe(std::shared_ptr<LiveObserver> observer);
  /// The observer is not called after this returns.
  void stopObserving(const std::shared_ptr<LiveObserver>& observer);

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::link
