// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot believes about the game, from what it is told cycle by cycle (SoccerInput): its
// pose, the ball, other robots. It does not know blackboards. Everything is turned so that this
// robot's team attacks towards +x, whichever side it plays on: a behaviour is written once. Metres,
// radians, seconds.
//
// Which goal is whose stands nowhere on the blackboard, but the IMU knows: its zero is the
// direction of the opponents' goal (system.md section 4), so LOCALIZATION_THETA minus IMU_EULER_Z
// is near 0 for a team that attacks right and near 180 degrees for one that attacks left.

#include <array>
#include <optional>

#include <base/geometry.h>
#include <robotlink/cognition/behaviour_parameters.h>
#include <robotlink/cognition/soccer_input.h>
#include <simcore/world/field.h>
#include <simcore/world/robot_model.h>

#include "soccer/ball_track.h"

namespace pitchboard::link {

class WorldModel {
 public:
  /// `body`: the robot whose radius is in `field`.
  WorldModel(const sim::FieldSpec& field, const sim::RobotModel& body,
             const BehaviourParameters& parameters, std::optional<bool> facesLeft)
      : m_field(field),
        m_body(body),
        m_facesLeft(facesLeft),
        m_ballMemory(parameters.ballMemory),
        m_opponentMemory(parameters.opponentMemory) {}

  /// Once a cycle, before the behaviour.
  void update(const SoccerInput& input, double now);
  /// What vision shall look for until the next cycle: the ball, and for one cycle in a while
  /// opponents.
  bool looksForOpponents() const { return m_looksForOpponents; }

  double now() const { return m_now; }
  Referee referee() const { return m_referee; }
  bool fallen() const { return m_fallen; }
  /// The set play that the referee has given, as COM_SET_PLAY says; None without.
  SetPlay setPlay() const { return m_setPlay; }
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

  const std::array<std::optional<TeamMate>, maxTeamMates>& mates() const { return m_mates; }
  /// Of all team-mates that are known of, up to ten.
  const Points& matePlaces() const { return m_matePlaces; }
  /// Opponents seen within the last seconds.
  const Points& opponents() const { return m_opponentPlaces; }

  /// SoccerInput::keeperShift.
  double keeperShift() const { return m_keeperShift; }

  /// To the studio's frame, whichever side this team attacks; and from it, which is the same.
  Point toStudio(const Point& turned) const {
    return m_attacksLeft ? Point{-turned.x, -turned.y} : turned;
  }
  Pose toStudio(const Pose& turned) const;

  Point toField(const Point& local) const;

 private:
  struct Sighting {
    Point position;
    double time = -1e9;
  };
  void findSide(double theta);
  void seeBall(const SeenAt& ball);
  void seeRobots(const SoccerInput& input);
  void readMates(const SoccerInput& input);
  void moveWithBody(const Act& doing, double seconds);

  sim::FieldSpec m_field;
  sim::RobotModel m_body;
  std::optional<bool> m_facesLeft;
  double m_ballMemory, m_opponentMemory;  // s
  double m_now = 0.0;
  bool m_first = true;
  unsigned m_cycle = 0;
  bool m_looksForOpponents = false;
  Referee m_referee = Referee::None;
  bool m_fallen = false;
  SetPlay m_setPlay = SetPlay::None;
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
  Points m_opponentPlaces;  // of those seen lately
  std::array<std::optional<TeamMate>, maxTeamMates> m_mates;
  Points m_matePlaces;
  double m_keeperShift = 0.0;
};

}  // namespace pitchboard::link
