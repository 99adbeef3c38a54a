// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a person sees of a match at one moment, whatever its source: simulated, live or recorded.
// Plain values; frames are immutable once handed out.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/cognition/robot_thoughts.h>
#include <robotlink/frame/live_values.h>
#include <robotlink/processes/process_supervisor.h>
#include <simcore/world/field.h>
#include <simcore/world/noise.h>
#include <simcore/world/snapshot.h>

namespace pitchboard::link {

/// What a person sees of one robot besides its snapshot: read from its blackboard.
struct RobotBoardView {
  RobotId id;
  int key = 0;      ///< System V key, 0 = heap
  int actionA = 0;  ///< DECISION_ACTION_A
  int voltage = 0;  ///< tenths of a volt
  bool visionLost = false;
  float ballDistCm = 0.0F;  ///< VISION_BALL_DIST
  float panDeg = 0.0F;      ///< VISION_PAN_DEG
  int localizationX = 0, localizationY = 0, localizationTheta = 0;
  float belief = 0.0F;  ///< cm
  /// communication, vision, localization, decision, IMU: *_WORKING seen set within the last second
  /// (communication has no flag: running child process).
  bool controlWorking = false, visionWorking = false, localizationWorking = false,
       decisionWorking = false, imuWorking = false;
  std::string behaviour;
};

/// Where a frame comes from. The same values everywhere; what is not known says so.
enum class FrameOrigin : std::uint8_t { Simulated, Live, Recorded };

struct MatchFrame {
  FrameOrigin origin = FrameOrigin::Simulated;
  /// False: nobody knows the true poses. The snapshot's poses are then the robots' beliefs.
  bool truthKnown = true;
  bool ballKnown = true;     ///< false: snapshot.ball means nothing
  std::uint64_t serial = 0;  ///< grows with every frame
  sim::Snapshot snapshot;
  std::vector<RobotBoardView> boards;
  std::vector<ChildStatus> children;
  /// What robots have in mind, of those that tell it (MatchOptions::thoughts); by robot number.
  std::vector<RobotThoughts> thoughts;
  std::vector<RobotHealth> health;     ///< of robots that are heard: one for each of the snapshot's
  std::optional<RefereeView> referee;  ///< once one was heard
  std::optional<TeamBall> teamBall;    ///< while at least two robots agree
  double speed = 0.0;             ///< simulated seconds per second, measured over the last second
  double ticksPerSecond = 0.0;    ///< measured
  double tickMicroseconds = 0.0;  ///< mean time of a tick, measured
  bool paused = false;
  bool finished = false;  ///< a stop condition of the scenario is met; it stands still
  sim::FieldSpec field;
  sim::NoiseParameters noise;
  std::string physics;
  std::uint64_t seed = 0;
  double tickRate = 60.0;
  std::string finishedBy;           ///< "goal", "ball_out", "duration"; empty unless finished
  std::uint64_t droppedEvents = 0;  ///< nobody took them in time
  std::uint64_t droppedLogLines = 0;
};

struct LogLine {
  double time = 0.0;   ///< simulated s
  std::string origin;  ///< "simulation", "B1 decision"
  std::string text;
  bool warning = false;
};

}  // namespace pitchboard::link
