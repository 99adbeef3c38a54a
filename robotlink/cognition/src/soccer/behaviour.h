// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A behaviour: chooses one action a cycle from the world model. To add one, derive from it here or
// in a file of your own and add a line to the list in cognitive_process.cpp.

#include "soccer/skills.h"
#include "soccer/world_model.h"

namespace pitchboard::link {

/// What a behaviour decided in one cycle.
struct Choice {
  Act act;
  Intention intention = Intention::Idle;
  std::optional<Point> target;  ///< where it is going, for the team and for display
  bool search = false;          ///< vision shall turn the head to find the ball
};

class Behaviour {
 public:
  explicit Behaviour(const sim::FieldSpec& field) : m_walk(field) {}
  virtual ~Behaviour() = default;
  /// The referee says play and the robot stands.
  virtual Choice play(const WorldModel& world) = 0;
  /// Where it waits for the kick-off: in its own half and outside the centre circle.
  virtual Pose kickOff(const WorldModel& world) = 0;

  /// Referee and falls first, then play().
  Choice choose(const WorldModel& world);
  const Walk& walk() const { return m_walk; }

 protected:
  Choice walkTo(const WorldModel& world, const Pose& pose, Intention intention, double near = 0.15);
  Choice toBall(const WorldModel& world, const Point& ball);
  Choice lookForBall(const WorldModel& world);

  Walk m_walk;
  Search m_search;
  Attack m_attack;
  double m_told = -1e9;  // when the ball was last where it was said to be
};

/// Goes for the ball and the goal; leaves the ball to a team-mate that is there first.
class Striker : public Behaviour {
 public:
  using Behaviour::Behaviour;
  Choice play(const WorldModel& world) override;
  Pose kickOff(const WorldModel& world) override;

 protected:
  Pose supportPose(const WorldModel& world, const Point& ball) const;
  virtual bool takesBall(const WorldModel& world, const Point& ball) const;
  bool m_attacking = false;
};

/// Stays behind and beside the ball; goes for it when it is there clearly before its team-mates.
class Supporter : public Striker {
 public:
  using Striker::Striker;
  Pose kickOff(const WorldModel& world) override;

 protected:
  bool takesBall(const WorldModel& world, const Point& ball) const override;

 private:
  double m_side = 0.0;        // of its place for the kick-off: +1 left, −1 right
  double m_sideAsked = -1e9;  // s
};

/// Stays between the ball and its own goal; clears the ball when it comes near.
class Keeper : public Behaviour {
 public:
  using Behaviour::Behaviour;
  Choice play(const WorldModel& world) override;
  Pose kickOff(const WorldModel& world) override;

 private:
  bool m_clearing = false;
};

/// Stands.
class Idle : public Behaviour {
 public:
  using Behaviour::Behaviour;
  Choice play(const WorldModel&) override { return {}; }
  Pose kickOff(const WorldModel& world) override { return world.pose(); }
};

template <class B>
Result<std::unique_ptr<CognitiveProcess>> makeSoccerDecision(const ProcessOptions& options);

extern template Result<std::unique_ptr<CognitiveProcess>> makeSoccerDecision<Striker>(
    const ProcessOptions&);
extern template Result<std::unique_ptr<CognitiveProcess>> makeSoccerDecision<Supporter>(
    const ProcessOptions&);
extern template Result<std::unique_ptr<CognitiveProcess>> makeSoccerDecision<Keeper>(
    const ProcessOptions&);
extern template Result<std::unique_ptr<CognitiveProcess>> makeSoccerDecision<Idle>(
    const ProcessOptions&);

}  // namespace pitchboard::link
