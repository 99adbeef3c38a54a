// SPDX-License-Identifier: GPL-3.0-or-later
#include "candidates.h"

#include <algorithm>
#include <cmath>

#include <base/angles.h>
#include <base/repeatable_math.h>
#include <robotlink/cognition/act.h>
#include <robotlink/cognition/keeper_place.h>
#include <simcore/world/action_codes.h>

namespace pitchboard::link {
namespace {

constexpr double atBall = 0.8;         // m
constexpr double rival = 1.5;          // m: a mate that is hardly farther from the ball
constexpr double keeperCares = 3.5;    // m from the ball to its goal
constexpr double longestMemory = 2.0;  // s since anybody saw the ball

double strongRange(const Thinker& who) {
  return sim::rollingDistance(who.field.surface, who.model.kickSpeed);
}
double weakRange(const Thinker& who) {
  return sim::rollingDistance(who.field.surface, who.model.weakKickSpeed);
}

Point ahead(const Point& from, double yaw, double metres) {
  const auto [s, c] = repeatable::sinCos(yaw);
  return {from.x + metres * c, from.y + metres * s};
}

Point inside(const sim::FieldSpec& field, const Point& at, double margin) {
  const double x = field.halfLength() - margin, y = field.halfWidth() - margin;
  return {std::clamp(at.x, -x, x), std::clamp(at.y, -y, y)};
}

bool isSame(const Advice& a, const Advice& b) {
  const double near = a.kind == AdviceKind::Stand ? 0.15 : 0.4;  // m
  return a.kind == b.kind && distance(a.place.position, b.place.position) < near;
}

class Collector {
 public:
  Collector() { m_all.push_back({}); }
  void add(AdviceKind kind, const Point& place, double yaw = 0.0) {
    const Advice one{kind, {place, yaw}};
    const bool known = std::ranges::any_of(m_all, [&](const Advice& a) { return isSame(a, one); });
    if (!known && !m_all.full()) m_all.push_back(one);
  }
  const Candidates& all() const { return m_all; }

 private:
  Candidates m_all;
};

void addAtBall(const Situation& now, const Thinker& who, Collector& out) {
  const sim::FieldSpec& field = who.field;
  const Point ball = *now.ball;
  const Point goal{field.halfLength(), 0.0};
  const double strong = strongRange(who), weak = weakRange(who);
  if (distance(ball, goal) < 0.85 * strong) {
    const double y = 0.28 * field.goalWidth;
    // The side that it looks at, and the other one.
    const double first = ball.y + (goal.x - ball.x) * repeatable::sin(now.pose.yaw);
    out.add(AdviceKind::StrongKick, {goal.x, first > 0.0 ? y : -y});
    out.add(AdviceKind::StrongKick, {goal.x, first > 0.0 ? -y : y});
  } else {
    out.add(AdviceKind::StrongKick, inside(field, ahead(ball, direction(ball, goal), strong), 0.3));
  }
  // To the team-mate that is farthest ahead, just before it.
  const TeamMate* receiver = nullptr;
  for (const auto& mate : now.mates) {
    if (!mate || !mate->takesPart() || mate->intention == Intention::Keep) continue;
    const double metres = distance(mate->position, ball);
    if (metres < 0.8 || metres > strong || mate->position.x < ball.x - 0.5) continue;
    if (!receiver || mate->position.x > receiver->position.x) receiver = &*mate;
  }
  if (receiver) {
    const Point to{receiver->position.x + 0.3, receiver->position.y};
    out.add(distance(to, ball) > 1.3 * weak ? AdviceKind::StrongKick : AdviceKind::WeakKick, to);
  }
  out.add(AdviceKind::Dribble, goal);
  // Away from whoever is nearest.
  const Point* nearest = nullptr;
  for (const Point& opponent : now.opponents) {
    if (!nearest || distance(opponent, ball) < distance(*nearest, ball)) nearest = &opponent;
  }
  constexpr double pressing = 1.5;  // m
  if (nearest && distance(*nearest, ball) < pressing) {
    const double straight = direction(ball, goal);
    const double off = wrapToPi(direction(ball, *nearest) - straight);
    const double heading = straight + (off > 0.0 ? -0.6 : 0.6);
    out.add(AdviceKind::WeakKick, inside(field, ahead(ball, heading, weak), 0.3));
  }
}

/// Beside where it stands anyway, and out, or to the ball if it would go so far.
void addKeeper(const Situation& now, const Thinker& who, Collector& out) {
  const Point goal{-who.field.halfLength(), 0.0};
  for (const double aside : {0.3, -0.3, 0.6, -0.6}) {
    BehaviourParameters numbers = who.numbers;
    numbers.keeperAside += aside;
    const Pose place = keeperPlace(who.field, numbers, *now.ball);
    out.add(AdviceKind::Stand, place.position, place.yaw);
  }
  if (distance(*now.ball, goal) < who.numbers.keeperOut) {
    out.add(AdviceKind::GoToBall, *now.ball);
  } else {
    const double angle = std::clamp(direction(goal, *now.ball), -1.2, 1.2);
    out.add(AdviceKind::Stand, ahead(goal, angle, 1.2), angle);
  }
}

}  // namespace

bool isKick(const Act& act) {
  const auto index = static_cast<std::size_t>(act.action);
  return index < knownActions.size() && knownActions[index].kind == ActionKind::Kick;
}

bool enoughIsKnown(const Situation& now) {
  const bool hasReportedBall = std::ranges::any_of(
      now.mates, [](const auto& mate) { return mate && mate->active && mate->ball; });
  return now.localized && now.ball && (now.ballAge < longestMemory || hasReportedBall);
}

Question questionOf(const Situation& now, const Thinker& who) {
  if (now.referee != Referee::Play || now.fallen || !enoughIsKnown(now)) return Question::None;
  const double away = distance(now.pose.position, *now.ball);
  if (now.intention == Intention::Ball && now.seesBall && away < atBall) return Question::AtBall;
  if (who.isKeeper) {
    const Point goal{-who.field.halfLength(), 0.0};
    const bool near = distance(*now.ball, goal) < keeperCares;
    const bool threatened = std::ranges::any_of(now.opponents, [&](const Point& opponent) {
      return distance(opponent, *now.ball) < rival;
    });
    return near && threatened ? Question::Keeper : Question::None;
  }
  if (now.intention != Intention::Ball && now.intention != Intention::Support) {
    return Question::None;
  }
  // One that goes, and a mate that could; one that could, and a mate that goes.
  const bool goes = now.intention == Intention::Ball;
  constexpr double far = 4.0;  // m
  if (away > far) return Question::None;
  const bool contested = std::ranges::any_of(now.mates, [&](const auto& mate) {
    if (!mate || !mate->takesPart() || mate->intention == Intention::Keep) return false;
    const bool itGoes = mate->intention == Intention::Ball;
    return itGoes != goes && std::abs(distance(mate->position, *now.ball) - away) < rival;
  });
  return contested ? Question::WhoGoes : Question::None;
}

Candidates candidatesFor(Question question, const Situation& now, const Thinker& who,
                         const Advice& last) {
  Collector out;
  const auto fits = [&] {
    switch (question) {
      case Question::AtBall:
        return isForBall(last.kind) && distance(last.place.position, *now.ball) > atBall;
      case Question::WhoGoes:
      case Question::Keeper:
      case Question::None:
        break;
    }
    return false;
  };
  if (fits()) out.add(last.kind, last.place.position, last.place.yaw);
  switch (question) {
    case Question::AtBall:
      addAtBall(now, who, out);
      break;
    case Question::WhoGoes:
      out.add(now.intention == Intention::Ball ? AdviceKind::LeaveBall : AdviceKind::GoToBall,
              *now.ball);
      break;
    case Question::Keeper:
      addKeeper(now, who, out);
      break;
    case Question::None:
      break;
  }
  return out.all();
}

}  // namespace pitchboard::link
