// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot believes about the game, from nothing but its blackboard: its pose, the ball, other
// robots. Everything is turned so that this robot's team attacks towards +x, whichever side it
// plays on: a behaviour is written once. Metres, radians, seconds.
//
// Which goal is whose stands nowhere on the blackboard, but the IMU knows: its zero is the
// direction of the opponents' goal (SYSTEM.md section 4), so LOCALIZATION_THETA minus IMU_EULER_Z
// is near 0 for a team that attacks right and near 180 degrees for one that attacks left.

#include <array>
#include <optional>
#include <vector>

#include <base/geometry.h>
#include <robotlink/blackboard/robot_variables.h>
#include <robotlink/cognition/cognitive_process.h>
#include <simcore/world/game_state.h>
#include <simcore/world/robot_io.h>

#include "soccer/ball_track.h"
#include "team/team_variables.h"

namespace pitchboard::link {

/// The referee's word in COM_REFEREE.
enum class Referee { Silent = 0, Stop = 1, Play = 2, Ready = 11, Set = 12 };

struct TeamMate {
  Point position;
  Intention intention = Intention::None;
  bool active = false;        ///< heard of lately and standing
  std::optional<Point> ball;  ///< as it saw it
  /// In the game: whoever is penalised or plays by no behaviour of these says that it is idle, or
  /// nothing.
  bool takesPart() const {
    return active && intention != Intention::None && intention != Intention::Idle;
  }
};

class WorldModel {
 public:
  /// `body`: the robot whose radius is in `field`.
  WorldModel(const sim::FieldSpec& field, const sim::RobotModel& body,
             const BehaviourParameters& parameters, std::optional<bool> facesLeft)
      : m_field(field),
        m_body(body),
        m_facesLeft(facesLeft),
        m_ballMemory(parameters.ballMemory),
        m_opponentMemory(parameters.opponentMemory) {
    const VariableCatalog& map = VariableCatalog::extended();
    m_setPlayWord = map.intVar("COM_SET_PLAY").value_or(IntVar{-1});
    m_setPlayOursWord = map.intVar("COM_SET_PLAY_OURS").value_or(IntVar{-1});
  }

  /// Once a cycle, before the behaviour. Also tells vision what to look for: the ball, and for one
  /// cycle in a while opponents (DECISION_ACTION_VISION).
  void update(Blackboard& board, const Clock& clock);

  double now() const { return m_now; }
  Referee referee() const { return m_referee; }
  bool fallen() const { return m_fallen; }
  /// The set play that the referee has given, as COM_SET_PLAY says; None without.
  sim::SetPlay setPlay() const { return m_setPlay; }
  bool setPlayIsOurs() const { return m_setPlayOurs; }
  const sim::FieldSpec& field() const { return m_field; }
  const sim::RobotModel& body() const { return m_body; }
  /// From the robot's centre to the ball's when they touch.
  double touch() const { return m_field.robotRadius + m_field.ballRadius; }
  Point opponentGoal() const { return {m_field.halfLength(), 0.0}; }
  Point ownGoal() const { return {-m_field.halfLength(), 0.0}; }

  const Pose& pose() const { return m_pose; }
  /// The pose may be built upon.
  bool localized() const { return m_sigma < 0.7; }
  /// Heading by the IMU alone: 0 is the opponents' goal.
  double imuYaw() const { return m_imuYaw; }

  /// This robot saw the ball within the last moments; position in its own frame (forward, left).
  bool seesBall() const { return m_now - m_ballSeen < 0.8; }
  double ballAge() const { return m_now - m_ballSeen; }
  /// Where that was, on the field.
  const Point& ballLastSeen() const { return m_ballField; }
  const Point& ballInFront() const { return m_ballLocal; }
  double ballDistance() const;
  double ballBearing() const;
  /// Where the ball is on the field: seen by itself, remembered, or told by a team-mate.
  std::optional<Point> ball() const;

  /// m/s, as this robot sees it; zero when it does not roll.
  Velocity ballVelocity() const { return m_track.velocity(m_now); }
  /// Where it will lie: ball(), or where a ball that this robot sees rolling comes to rest.
  std::optional<Point> ballStops() const;

  const std::array<std::optional<TeamMate>, mostTeamMates>& mates() const { return m_mates; }
  /// Of all team-mates that are known of, up to ten.
  const std::vector<Point>& matePlaces() const { return m_matePlaces; }
  /// Opponents seen within the last seconds.
  std::vector<Point> opponents() const;

  /// To the studio's frame, whichever side this team attacks.
  Point toStudio(const Point& turned) const {
    return m_attacksLeft ? Point{-turned.x, -turned.y} : turned;
  }
  Pose toStudio(const Pose& turned) const;

  Point toField(const Point& local) const;

  /// What team and planning shall know, in DECISION_STATE, LOCALIZATION_BALL_*, LOCALIZATION_OPP*
  /// and DECISION_POSITION_*.
  void tell(Blackboard& board, Intention intention, const std::optional<Point>& target) const;

 private:
  struct Sighting {
    Point position;
    double time = -1e9;
  };
  void findSide(double theta);
  void readBall(const Blackboard& board);
  void readRobots(Blackboard& board);
  void readMates(const Blackboard& board);
  void moveWithBody(const Blackboard& board, double seconds);
  Point fromCm(double x_cm, double y_cm) const;

  sim::FieldSpec m_field;
  sim::RobotModel m_body;
  std::optional<bool> m_facesLeft;
  double m_ballMemory, m_opponentMemory;  // s
  RobotVariables m_variables{VariableCatalog::extended()};
  TeamVariables m_team;
  IntVar m_setPlayWord, m_setPlayOursWord;  // of the extension; -1: the map in use has none
  double m_now = 0.0;
  bool m_first = true;
  unsigned m_cycle = 0;
  bool m_lookedForOpponents = false;
  Referee m_referee = Referee::Silent;
  bool m_fallen = false;
  sim::SetPlay m_setPlay = sim::SetPlay::None;
  bool m_setPlayOurs = false;
  double m_side = 0.0;  // > 0 attacks right, low-passed
  bool m_attacksLeft = false;
  Pose m_pose;
  double m_sigma = 1e9, m_imuYaw = 0.0;
  Point m_ballLocal;
  Point m_ballField;
  BallTrack m_track;
  double m_ballSeen = -1e9;
  std::array<Sighting, sim::Percepts::maxSeenRobots> m_opponents;
  std::array<std::optional<TeamMate>, mostTeamMates> m_mates;
  std::vector<Point> m_matePlaces;
};

}  // namespace pitchboard::link
