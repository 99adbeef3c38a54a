// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A behaviour: chooses one action a cycle from the world model. To add one, derive from it here or
// in a file of your own and add a line to the list in process_registry.cpp.

#include <memory>
#include <span>

#include <robotlink/cognition/cognitive_process.h>

#include "soccer/skills.h"
#include "soccer/world_model.h"

namespace pitchboard::link {

/// What a behaviour decided in one cycle.
struct Choice {
  Move move;
  Intention intention = Intention::Idle;
  std::optional<Point> target;  ///< where it is going, for the team and for display
  bool search = false;          ///< vision shall turn the head to find the ball
};

class Behaviour {
 public:
  explicit Behaviour(const BehaviourParameters& parameters)
      : m_numbers(parameters), m_search(m_numbers), m_attack(m_numbers) {}
  virtual ~Behaviour() = default;
  /// The referee says play and the robot stands.
  virtual Choice play(const WorldModel& world) = 0;
  /// Where it waits for the kick-off: in its own half and outside the centre circle.
  virtual Pose kickOff(const WorldModel& world) = 0;
  /// What it tells its team on the way there.
  virtual Intention atKickOff() const { return Intention::Walk; }

  /// A copy with all that it remembers.
  virtual std::unique_ptr<Behaviour> clone() const = 0;

  /// Referee and falls first, then play().
  Choice choose(const WorldModel& world);

 protected:
  Choice goTo(const WorldModel& world, const Pose& pose, Intention intention, double near = 0.15);
  Choice toBall(const WorldModel& world, const Point& ball);
  bool takesBall(const WorldModel& world, const Point& ball, bool has) const;
  Choice lookForBall(const WorldModel& world);
  bool comesBack(const WorldModel& world);
  Choice enter(const WorldModel& world);
  Choice waitForSetPlay(const WorldModel& world);

  BehaviourParameters m_numbers;
  Search m_search;
  Attack m_attack;
  bool m_comesBack = false;
  double m_ballConfirmed = -1e9;  // when the ball was last where it was said to be
};

/// Goes for the ball when nobody of its team is there sooner; else takes one of the places of those
/// who support.
class Striker : public Behaviour {
 public:
  using Behaviour::Behaviour;
  std::unique_ptr<Behaviour> clone() const override { return std::make_unique<Striker>(*this); }
  Choice play(const WorldModel& world) override;
  Pose kickOff(const WorldModel& world) override;

 private:
  Choice support(const WorldModel& world, const Point& ball);
  bool m_attacking = false;
  double m_side = 1.0;                 // of the ball with more room
  std::optional<std::size_t> m_place;  // of those who support
};

/// As a striker; begins behind it, in a place of its own.
class Supporter : public Striker {
 public:
  using Striker::Striker;
  std::unique_ptr<Behaviour> clone() const override { return std::make_unique<Supporter>(*this); }
  Pose kickOff(const WorldModel& world) override;
  Intention atKickOff() const override { return Intention::Support; }

 private:
  static bool mateHolds(const WorldModel& world, const Point& place);
  static std::size_t nearestNotHeld(const WorldModel& world, std::span<const Point> places,
                                    std::size_t otherwise);
  static Point besideStanding(const WorldModel& world, Point place);
  std::size_t m_kickOffPlace = 0;
  std::ptrdiff_t m_supporters = 0;                  // beside this one
  double m_placeAsked = -1e9, m_placeBegan = -1e9;  // s
};

/// Stays between the ball and its own goal; clears the ball when it comes near, and comes out when
/// nobody is there sooner.
class Keeper : public Behaviour {
 public:
  using Behaviour::Behaviour;
  std::unique_ptr<Behaviour> clone() const override { return std::make_unique<Keeper>(*this); }
  Choice play(const WorldModel& world) override;
  Pose kickOff(const WorldModel& world) override;
  Intention atKickOff() const override { return Intention::Keep; }

 private:
  bool goesForBall(const WorldModel& world, const Point& ball) const;
  Pose keeperPlace(const WorldModel& world, const Point& ball) const;
  bool m_clearing = false;
};

/// Stands.
class Idle : public Behaviour {
 public:
  using Behaviour::Behaviour;
  std::unique_ptr<Behaviour> clone() const override { return std::make_unique<Idle>(*this); }
  Choice play(const WorldModel&) override { return {}; }
  Pose kickOff(const WorldModel& world) override { return world.pose(); }
};

/// The decision process of one behaviour.
Result<std::unique_ptr<CognitiveProcess>> makeSoccerDecision(
    const ProcessOptions& options,
    std::unique_ptr<Behaviour> (*make)(const BehaviourParameters& parameters));

template <class B>
Result<std::unique_ptr<CognitiveProcess>> makeSoccerDecision(const ProcessOptions& options) {
  return makeSoccerDecision(
      options, [](const BehaviourParameters& parameters) -> std::unique_ptr<Behaviour> {
        return std::make_unique<B>(parameters);
      });
}

}  // namespace pitchboard::link
