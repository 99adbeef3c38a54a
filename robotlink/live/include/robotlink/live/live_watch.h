// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Watches a match of real robots: receives, decodes and keeps the books on threads of its own, and
// hands out frames (the newest wins) and events as values, all on one clock (LiveClock). It sends
// nothing, except the monitor request to a referee when that is turned on. All public functions may
// be called from any thread.

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
  telemetry::Address bind{};  ///< 0.0.0.0: every interface, unicast and broadcast
  int portBase = 1240;        ///< robot n sends to portBase + n
  int robots = 16;            ///< ports after the base
  int refereePort = 3838;
  /// Robot n sends its variables to this port + n (docs/agent.md); 0: none are received.
  int variablesPortBase = telemetry::pb2PortBase;
  int refereeVersion = 0;                    ///< the only one to be shown; 0: the highest
  telemetry::SenderFilter refereeSenders{};  ///< who may be the referee; the robots' is in `team`
  telemetry::Profile profile = telemetry::publishedProfile();
  telemetry::MonitorOptions team;
  int ourTeam = 0;                       ///< the referee's number of our team; 0: not chosen
  std::optional<TeamColor> ourColour{};  ///< of our team, where it was chosen by its colour
  bool colourByNumber = false;           ///< as the published telemetry: a colour for each number
  sim::FieldSpec field;
  std::vector<AttachedBoard> boards;          ///< of robots that are this computer
  std::vector<std::string> catalogs;          ///< files; of variables that robots send
  std::optional<telemetry::Address> monitor;  ///< the referee to ask for monitor mode; empty: off
  std::uint16_t monitorPort = telemetry::monitorRequestPort;
};

/// All ports that are received. Refuses those that do not exist or collide: Error InvalidArgument.
Result<std::vector<std::uint16_t>> portsOf(const LiveOptions& options);
/// Refuses ports as portsOf(), and files that cannot be read.
Result<void> validate(const LiveOptions& options);

/// More than a frame says, for status line and tables.
struct LiveDetails {
  telemetry::TeamStatus team;
  telemetry::ReceiverStatus network;
  std::string networkProblem;  ///< why nothing can be received at all; empty otherwise
  telemetry::RefereeTracker::Counts referee;
  std::uint64_t unknownReferee = 0;  ///< packets on the referee's port that could not be decoded
  std::string unknownRefereeReason;  ///< of the last one
  std::string unknownRefereeSample;
  Teams teams;  ///< for robotName()
  std::vector<AttachedStatus> boards;
  std::vector<SentStatus> sent;        ///< variables that robots send
  std::uint64_t badVariables = 0;      ///< datagrams on their ports that could not be read
  std::string badVariablesReason;      ///< of the last one
  std::uint64_t refusedVariables = 0;  ///< of senders that are not on the list, or too many robots
  std::uint64_t refusedReferees = 0;   ///< datagrams of senders that are not on the referee's list
  std::string monitorProblem;          ///< why the last monitor request was not sent
  telemetry::LiveRows::Refused rows;   ///< rows and values beyond the limits, since clear()
};

/// What is new since it was asked for the last time, in the order in which it is to be shown.
struct LiveNews {
  std::vector<std::vector<Renaming>> renamings;  ///< one after the other; `frame` shows them
  std::vector<MatchEvent> events;                ///< at most the newest 10 000
  std::shared_ptr<const MatchFrame> frame;       ///< the newest one; null before the first
};

/// A datagram and what it turned out to be. All of it is valid during the call only.
struct LiveDatagram {
  using Verdict = telemetry::TeamMonitor::Verdict;
  double time = 0.0;  ///< s since the beginning, of the arrival
  const telemetry::DatagramView& view;
  const Teams& teams;                                         ///< for robotName()
  const Result<telemetry::RefereePacket>* referee = nullptr;  ///< null: it came to a robot's port
  /// Of the message of a robot. Empty: it only draws.
  std::optional<Verdict> verdict{};
  const telemetry::TextDecoder* decoder = nullptr;  ///< null without a verdict
  const telemetry::DecodedText* decoded = nullptr;  ///< null without a verdict
  /// As in the frames; number 0 if it does not say who it is.
  RobotKey robot{};
  std::optional<std::string> drawingProblem{};  ///< why its drawing cannot be shown
  /// What came to a port of variables; null: it came to another one.
  const Result<telemetry::Pb2Message>* variables = nullptr;
  std::optional<SentBoards::Verdict> variablesVerdict{};  ///< empty: they could not be read

  bool isStranger() const { return verdict == Verdict::SenderRefused; }
  /// The referee's state; null if it is none.
  const telemetry::RefereeState* state() const {
    return referee && *referee ? std::get_if<telemetry::RefereeState>(&**referee) : nullptr;
  }
};

/// Sees everything that a LivePipeline takes and makes, for recording and printing. Called on the
/// thread of the pipeline (that of the watch): must not wait.
class LiveObserver {
 public:
  virtual ~LiveObserver() = default;
  /// Every datagram, but those of senders that may not be the referee.
  virtual void received(const LiveDatagram&) {}
  virtual void happened(const MatchEvent&) {}
  /// Whenever a frame was made.
  virtual void frameMade(const MatchFrame&) {}
  /// Everything that is known at this moment (LiveState::text): at once, on the observing thread,
  /// then every 15 s and whenever options have changed or everything was forgotten. Nothing else is
  /// told at the same time.
  virtual void remembered(double /*time*/, std::string_view /*books*/) {}
  /// Where to put the rows of robots, links and attached blackboards; null: nowhere.
  virtual std::shared_ptr<telemetry::RowSink> rows() { return nullptr; }
};

class LiveWatch {
 public:
  /// `onFrame` is called from the watch's thread when a frame is there that was not taken yet; it
  /// must return at once. The options must be valid.
  explicit LiveWatch(LiveOptions options, std::function<void()> onFrame = {},
                     telemetry::ClockSource clock = telemetry::ClockSource::system());
  ~LiveWatch();  ///< stops receiving, joins
  LiveWatch(const LiveWatch&) = delete;
  LiveWatch& operator=(const LiveWatch&) = delete;

  /// From the next moment on. Robots, health and counters stay; ports are bound anew if they
  /// differ.
  void setOptions(LiveOptions options);
  /// Forgets robots, referee and counters.
  void clear();
  /// Forgets one robot or second sender; it appears again when it is heard.
  void forget(const RobotKey& robot);

  /// Calling it asks for the next `onFrame`.
  LiveNews take();
  LiveDetails details() const;

  /// The time of day at 0 s, by the computer's clock as it was then.
  telemetry::WallTime began() const;
  void observe(std::shared_ptr<LiveObserver> observer);
  /// After this returns the observer is not called any more.
  void stopObserving(const std::shared_ptr<LiveObserver>& observer);

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace pitchboard::link
