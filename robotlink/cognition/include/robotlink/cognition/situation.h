// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The game as a robot's decision process understands it, read from the robot's blackboard by other
// processes. Coordinates are turned so that the robot's team attacks towards +x; metres, radians,
// seconds. One thread at a time.

#include <memory>
#include <optional>

#include <robotlink/cognition/cognitive_process.h>
#include <robotlink/cognition/soccer_input.h>

namespace pitchboard::link {

struct Situation {
  Referee referee = Referee::None;
  sim::SetPlay setPlay = sim::SetPlay::None;
  bool setPlayIsOurs = false;
  int goalsOwn = 0, goalsTheirs = 0;
  int secondsLeft = 0;  ///< of this half; 0 or less: unknown

  bool fallen = false;
  bool localized = false;
  Pose pose;
  Act doing;
  Intention intention = Intention::None;  ///< what decision does
  std::optional<Point> ball;              ///< seen, told by a team-mate, or remembered
  bool seesBall = false;
  double ballAge = 1e9;  ///< s since this robot saw it
  Velocity ballVelocity;
  std::array<std::optional<TeamMate>, mostTeamMates> mates;
  Points opponents;  ///< opponents that the decision process remembers
};

class SituationReader {
 public:
  explicit SituationReader(const ProcessOptions& options);
  SituationReader(const SituationReader& other);
  SituationReader& operator=(const SituationReader& other);
  SituationReader(SituationReader&&) noexcept;
  SituationReader& operator=(SituationReader&&) noexcept;
  ~SituationReader();

  /// Reads the blackboard. Call it ten times a second; `now` is in seconds of the process's clock.
  const Situation& read(const Blackboard& board, double now);
  /// Converts a turned pose to the studio's frame.
  Pose toStudio(const Pose& turned) const;
  bool attacksLeft() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> m_parts;
};

}  // namespace pitchboard::link
