// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays a SimulatedMatch on a thread of its own at a chosen pace. Commands go in (carried out
// between two ticks, in order), values come out (the latest frame wins; events and log lines are
// queued, bounded and counted). All public functions may be called from any thread.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <robotlink/simulated_match.h>

namespace pitchboard::link {

/// What a person sees of one robot besides its snapshot: read from its blackboard.
struct RobotBoardView {
  RobotId id;
  int key = 0;                       ///< System V key, 0 = heap
  int actionA = 0;                   ///< DECISION_ACTION_A
  int voltage = 0;                   ///< tenths of a volt
  bool visionLost = false;
  float ballDistCm = 0.0F;           ///< VISION_BALL_DIST
  float panDeg = 0.0F;               ///< VISION_PAN_DEG
  int localizationX = 0, localizationY = 0, localizationTheta = 0;
  float belief = 0.0F;               ///< cm
  /// communication, vision, localization, decision, IMU: *_WORKING seen set within the last second
  /// (communication has no flag: running child process).
  bool controlWorking = false, visionWorking = false, localizationWorking = false,
       decisionWorking = false, imuWorking = false;
  std::string behaviour;
};

struct MatchFrame {
  std::uint64_t serial = 0;          ///< grows with every frame
  sim::Snapshot snapshot;
  std::vector<RobotBoardView> boards;
  std::vector<ChildStatus> children;
  double speed = 0.0;                ///< simulated seconds per second, measured over the last second
  double ticksPerSecond = 0.0;       ///< measured
  double tickMicroseconds = 0.0;     ///< mean time of a tick, measured
  bool paused = false;
  bool finished = false;             ///< a stop condition of the scenario is met; it stands still
  sim::FieldSpec field;
  sim::NoiseParameters noise;
  std::string physics;
  std::uint64_t seed = 0;
  double tickRate = 60.0;
  std::string finishedBy;            ///< "goal", "ball_out", "duration"; empty unless finished
  std::uint64_t droppedEvents = 0;   ///< nobody took them in time
  std::uint64_t droppedLogLines = 0;
};

struct LogLine {
  double time = 0.0;                 ///< simulated s
  std::string origin;                ///< "simulation", "B1 decision"
  std::string text;
  bool warning = false;
};

class MatchRunner {
 public:
  static constexpr double unlimitedSpeed = 0.0;

  /// Makes the match on the runner's thread (its processes must belong to that thread) and starts
  /// paused or playing. Fails with the reason when the match cannot be made.
  static Result<std::unique_ptr<MatchRunner>> start(
      const Scenario& scenario, const MatchOptions& options, bool paused = false,
      const VariableCatalog& catalog = VariableCatalog::published());
  ~MatchRunner();                    ///< stops, ends processes, joins

  void setPaused(bool paused);
  /// One tick, then pause.
  void stepOnce();
  /// 1 = real time; unlimitedSpeed = as fast as possible.
  void setSpeed(double timesRealTime);
  /// Plays at full speed up to this tick, then pauses; for tests and repeatable pictures.
  void runTo(std::uint64_t tick);
  /// Waits until the match stands still (paused, or over); false when it still plays after that.
  bool waitUntilStill(std::chrono::milliseconds timeout) const;

  /// Carried out on the runner's thread between two ticks, also while paused.
  using Command = std::function<void(SimulatedMatch&)>;
  void post(Command command);
  /// The same, and waits for it. Not from within a command.
  void execute(const Command& command);

  /// The newest frame, or nothing when `knownSerial` is already the newest.
  std::shared_ptr<const MatchFrame> latest(std::uint64_t knownSerial = 0) const;
  /// Both give what came since the last call, at most the newest 10 000.
  std::vector<sim::Event> takeEvents();
  std::vector<LogLine> takeLog();

  struct Shared;  ///< between the thread and the callers; private to the library

 private:
  explicit MatchRunner(std::shared_ptr<Shared> shared);
  std::shared_ptr<Shared> m_shared;
  std::jthread m_thread;
};

}  // namespace pitchboard::link
