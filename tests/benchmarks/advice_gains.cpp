// SPDX-License-Identifier: GPL-3.0-or-later
// What advice is worth in whole matches. At moments at which a robot would think, each candidate is
// played in rollouts, and in the match itself, where the robot is told it for three seconds; eight
// seconds later goals count, or what the position is worth. Prints the table of docs/advisor.md:
// the gain over what the behaviour does anyway. `advice_gains [situations] [runs] [rollouts] [seed]
// [1: only what the advisor suggests; 2: at the ball, kicks and dribbles in directions up to 60°
// beside the goal's; 3: up to 120°]`.

#include <cstdio>
#include <cstdlib>
#include <map>
#include <numbers>
#include <string>

#include "../support/rollout_agreement.h"
#include "candidates.h"
#include "game_belief.h"
#include "lookahead.h"
#include "position_value.h"

namespace pitchboard::tests {
namespace {

using link::Advice, link::AdviceKind, link::Candidates, link::Question, link::SimulatedMatch;

constexpr double toldFor = 3.0, playedFor = 8.0, horizon = 5.0;  // s
constexpr double pause = 15.0;  // s between two questions of a robot
constexpr int ofMatch = 25;     // questions of one match

struct Thinking {
  explicit Thinking(const link::ProcessOptions& its)
      : options(its), reader(its), rollouts(rollout::Rollouts::create(setupFor(its)).value()) {}
  link::ProcessOptions options;
  link::SituationReader reader;
  link::OpponentMemory opponents;
  rollout::Rollouts rollouts;
  double asked = -pause;  // s
};

/// Mean with its standard error.
struct Mean {
  double sum = 0.0, squares = 0.0;
  int count = 0;
  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double mean() const { return sum / count; }
  double error() const {
    if (count < 2) return 0.0;
    return std::sqrt(std::max(0.0, squares / count - mean() * mean()) / (count - 1));
  }
};

struct Row {
  Mean first, second;  // the two columns of its table
};

Point turned(const Point& place, bool attacksLeft) {
  return attacksLeft ? Point{-place.x, -place.y} : place;
}

/// For the team of robot `id`.
double valueNow(const SimulatedMatch& match, const Thinking& who) {
  const bool attacksLeft = who.reader.attacksLeft();
  const auto& bodies = std::get<sim::RigidBodyState>(match.simulation().state().physics);
  link::Position end;
  end.ball = turned(bodies.ball.position, attacksLeft);
  end.velocity = {attacksLeft ? -bodies.ball.velocity.x : bodies.ball.velocity.x,
                  attacksLeft ? -bodies.ball.velocity.y : bodies.ball.velocity.y};
  for (std::size_t i = 0; i < bodies.robots.size(); ++i) {
    const bool isOwn = match.robots().all()[i]->facesLeft == attacksLeft;
    double& least = isOwn ? end.near : end.theirsNear;
    least =
        std::min(least, distance(turned(bodies.robots[i].pose.position, attacksLeft), end.ball));
  }
  return positionValue(who.options.field, end);
}

/// The same belief, but everybody and the ball are known to a few centimetres.
rollout::Belief knowingPlaces(const SimulatedMatch& match, const Thinking& who,
                              rollout::Belief belief) {
  constexpr double surely = 0.02;  // m, rad
  const bool attacksLeft = who.reader.attacksLeft();
  const auto& bodies = std::get<sim::RigidBodyState>(match.simulation().state().physics);
  for (rollout::RobotBelief& robot : belief.robots) robot.absent = true;
  std::size_t nextMate = link::firstMate, nextTheirs = link::firstTheirs;
  for (std::size_t i = 0; i < bodies.robots.size(); ++i) {
    const auto& slot = *match.robots().all()[i];
    const sim::RigidRobot& body = bodies.robots[i];
    const bool isOwn = slot.facesLeft == attacksLeft, isKeeper = slot.behaviour == "keeper";
    const std::size_t place = slot.id == who.options.robot ? link::ownPlayer
                              : isKeeper ? (isOwn ? link::mateKeeper : link::theirKeeper)
                                         : (isOwn ? nextMate++ : nextTheirs++);
    rollout::RobotBelief& robot = belief.robots[place];
    robot.absent = false;
    robot.pose = {turned(body.pose.position, attacksLeft),
                  wrapToPi(body.pose.yaw + (attacksLeft ? std::numbers::pi : 0.0))};
    robot.sigma = robot.yawSigma = surely;
    robot.forward = body.forwardSpeed;
    robot.left = body.sidewaysSpeed;
    robot.turn = body.yawRate;
    robot.down = body.posture != sim::Posture::Upright;
    robot.getsUpIn = body.getUpRemaining;
  }
  belief.ball.place = turned(bodies.ball.position, attacksLeft);
  belief.ball.velocity = {attacksLeft ? -bodies.ball.velocity.x : bodies.ball.velocity.x,
                          attacksLeft ? -bodies.ball.velocity.y : bodies.ball.velocity.y};
  belief.ball.sigma = belief.ball.velocitySigma = surely;
  belief.ball.age = 0.0;
  return belief;
}

/// How the match goes on when the robot is told this, with other random numbers.
double playOn(SimulatedMatch& match, const link::Moment& moment, const Thinking& who,
              Advice advice) {
  constexpr int ticksOfLookahead = 24;  // until it says what it thought
  const link::AdvisorVariables v;
  const sim::WorldState& state = match.simulation().state();
  if (!match.restore(moment)) std::abort();
  advice.place = who.reader.toStudio(advice.place);
  const sim::Score before = state.score;
  const int perSecond = static_cast<int>(moment.state.settings.tickRate);
  int goals = 0, stamp = 0;
  for (int tick = 1; tick <= playedFor * perSecond && goals == 0; ++tick) {
    const bool isAnnounced = tick % perSecond == ticksOfLookahead && tick < toldFor * perSecond;
    if (isAnnounced && advice.kind != AdviceKind::None) {
      link::Blackboard& board = *match.blackboard(who.options.robot);
      v.write(board, who.options.field, advice);
      board.write(v.stamp, ++stamp);
    }
    match.tick();
    goals = (state.score.left - before.left) - (state.score.right - before.right);
  }
  std::vector<link::MatchEvent> events;
  match.takeEvents(events);
  if (goals != 0) return who.reader.attacksLeft() ? -goals : goals;
  return valueNow(match, who);
}

const char* nameOf(AdviceKind kind) {
  constexpr std::array names{"as usual",       "strong kick",    "weak kick or pass", "dribble",
                             "go to the ball", "leave the ball", "stand elsewhere"};
  return names[static_cast<std::size_t>(kind)];
}

/// Mean gains in the even and in the odd continuations, which have different random numbers.
struct Halves {
  double first = 0.0, second = 0.0;
};

Halves gainIn(const std::vector<double>& values, const std::vector<double>& usual) {
  Halves gain;
  for (std::size_t i = 0; i < values.size(); ++i) {
    (i % 2 == 0 ? gain.first : gain.second) +=
        2.0 * (values[i] - usual[i]) / static_cast<double>(values.size());
  }
  return gain;
}

/// The best as one half of the continuations shows; the other half tells what it is worth.
struct Choice {
  Halves gain;  // of the behaviour's own choice
  AdviceKind kind = AdviceKind::None;
  void take(const Halves& other, AdviceKind its) {
    if (other.first <= gain.first) return;
    gain = other;
    kind = its;
  }
};

double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Chooses what gains most in rollouts, if anything gains; the match tells what that is worth.
struct ChoiceByRollouts {
  rollout::Belief belief;
  double usual = 0.0;  // value
  double most = 0.0;   // gain in rollouts
  double worth = 0.0;  // of the same in the match
  void take(double gain, double real) {
    if (gain <= most) return;
    most = gain;
    worth = real;
  }
};

/// Pairs of gains: in rollouts, in the match.
struct Agreement {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  void add(double rollouts, double match) {
    n += 1.0;
    x += rollouts;
    y += match;
    xx += rollouts * rollouts;
    xy += rollouts * match;
    yy += match * match;
  }
  double correlation() const {
    return (n * xy - x * y) / std::sqrt((n * xx - x * x) * (n * yy - y * y));
  }
};

class Comparison {
 public:
  Comparison(int runs, int many, bool onlySuggested)
      : m_runs(runs), m_many(many), m_onlySuggested(onlySuggested) {}

  void compare(SimulatedMatch& match, link::Moment moment, Thinking& who, Question question,
               const rollout::Belief& belief, const Candidates& candidates, std::uint64_t seed) {
    const link::LookaheadPlan plan =
        link::planFor(question, link::AdvisorOptions{}.rollouts, horizon, {});
    const auto fast = [&](std::size_t candidate) {
      return inRollouts(who, belief, candidates[candidate], plan.horizon, seed);
    };
    const auto whole = [&](std::size_t candidate) {
      return continued(match, moment, who, candidates[candidate], seed);
    };
    link::Lookahead lookahead(belief, candidates, seed + 500000, plan);
    while (!lookahead.isDone()) lookahead.playOne(who.rollouts, who.options.field);
    const link::LookaheadResult result = lookahead.result();
    const std::size_t best = result.best;
    ++m_questions;
    if (best == 0 && m_onlySuggested) return;
    const double usualFast = fast(0);
    const std::vector<double> usual = whole(0);
    const double usualWhole = meanOf(usual);
    Choice possible;
    for (std::size_t i = 1; i < candidates.size(); ++i) {
      if (m_onlySuggested && i != best) continue;
      const std::vector<double> played = whole(i);
      const double gain = fast(i) - usualFast, real = meanOf(played) - usualWhole;
      possible.take(gainIn(played, usual), candidates[i].kind);
      Row* const suggested = i == best ? &m_suggested : nullptr;
      Row* const surely = suggested && result.gainLow > 0.0 ? &m_surely : nullptr;
      for (Row* row : {&m_rows[nameOf(candidates[i].kind)], suggested, surely}) {
        if (row == nullptr) continue;
        row->first.add(gain);
        row->second.add(real);
      }
    }
    add(possible);
  }

  /// What somebody at the ball could gain who knew how the match goes on; and who chooses by
  /// rollouts, from what the robot believes and from where everybody is.
  void compareDirections(SimulatedMatch& match, link::Moment moment, Thinking& who,
                         const Point& ball, const rollout::Belief& belief,
                         const rollout::Belief& places, int farthest, std::uint64_t seed) {
    const std::vector<double> usual = continued(match, moment, who, {}, seed);
    const double usualWhole = meanOf(usual);
    Choice best;
    std::array<ChoiceByRollouts, 2> choosers{{{belief}, {places}}};
    for (ChoiceByRollouts& one : choosers)
      one.usual = inRollouts(who, one.belief, {}, horizon, seed);
    const double goal = direction(ball, {who.options.field.halfLength(), 0.0});
    for (int degrees = -farthest; degrees <= farthest; degrees += 30) {
      const double yaw = goal + radiansFromDegrees(degrees);
      const auto tryOne = [&](AdviceKind kind, double metres) {
        const Advice advice{
            kind, {{ball.x + metres * std::cos(yaw), ball.y + metres * std::sin(yaw)}, yaw}};
        const std::vector<double> played = continued(match, moment, who, advice, seed);
        const double real = meanOf(played) - usualWhole;
        const Halves gain = gainIn(played, usual);
        Row& row = m_halves[std::string(nameOf(kind)) + " to " + std::to_string(degrees) + "°"];
        row.first.add(gain.first);
        row.second.add(gain.second);
        best.take(gain, kind);
        for (std::size_t i = 0; i < choosers.size(); ++i) {
          ChoiceByRollouts& one = choosers[i];
          const double expected = inRollouts(who, one.belief, advice, horizon, seed) - one.usual;
          one.take(expected, real);
          m_agreements[i].add(expected, real);
        }
      };
      tryOne(AdviceKind::StrongKick, 3.0);
      tryOne(AdviceKind::WeakKick, 1.2);
      tryOne(AdviceKind::Dribble, 2.0);
    }
    for (std::size_t i = 0; i < choosers.size(); ++i) {
      m_byRollouts[i].first.add(choosers[i].most);
      m_byRollouts[i].second.add(choosers[i].worth);
    }
    ++m_questions;
    add(best);
  }

  void print() const {
    const auto print = [](const char* name, const Row& row) {
      if (row.second.count == 0) return;
      std::printf("| %s | %d | %+.3f ± %.3f | %+.3f ± %.3f |\n", name, row.second.count,
                  row.first.mean(), row.first.error(), row.second.mean(), row.second.error());
    };
    if (!m_rows.empty()) {
      std::printf("| candidate | times | gain in rollouts | gain in whole matches |\n");
      for (const auto& [name, row] : m_rows) print(name.c_str(), row);
      print("what the advisor suggests", m_suggested);
      print("of these, with a gain above 0 at 95 %", m_surely);
    }
    std::printf("| candidate | times | gain in half of the continuations | gain in the others |\n");
    for (const auto& [name, row] : m_halves) print(name.c_str(), row);
    print("the best in half of the continuations", m_possible);
    if (m_agreements[0].n > 0.0) {
      std::printf("| who chooses | questions | gain in rollouts | gain in whole matches |\n");
      print("rollouts of what the robot believes", m_byRollouts[0]);
      print("rollouts of where everybody is", m_byRollouts[1]);
      std::printf("correlation of gains in rollouts and matches: %.2f and %.2f\n",
                  m_agreements[0].correlation(), m_agreements[1].correlation());
    }
    for (const auto& [name, times] : m_chosen) std::printf("of these, %s: %d\n", name, times);
    std::printf("%d questions\n", m_questions);
  }

 private:
  /// Mean value of the rollouts with this advice.
  double inRollouts(Thinking& who, const rollout::Belief& belief, const Advice& advice,
                    double seconds, std::uint64_t seed) const {
    std::vector<double> values;
    rollout::PlayOptions play;
    play.seconds = seconds;
    play.advice = advice;
    play.advised = link::ownPlayer;
    for (int j = 0; j < m_many; ++j) {
      std::array<double, rollout::columnCount> row{};
      const std::uint64_t one = seed + static_cast<std::uint64_t>(j);
      if (!who.rollouts.play(belief, {&one, 1}, play, row)) std::abort();
      values.push_back(link::valueOfRow(row, who.options.field));
    }
    return meanOf(values);
  }
  std::vector<double> continued(SimulatedMatch& match, link::Moment& moment, const Thinking& who,
                                const Advice& advice, std::uint64_t seed) const {
    std::vector<double> values;
    for (int i = 0; i < m_runs; ++i) {
      moment.state.settings.seed = seed + static_cast<std::uint64_t>(i);
      values.push_back(playOn(match, moment, who, advice));
    }
    return values;
  }
  void add(const Choice& choice) {
    m_possible.first.add(choice.gain.first);
    m_possible.second.add(choice.gain.second);
    ++m_chosen[nameOf(choice.kind)];
  }

  int m_runs, m_many;
  bool m_onlySuggested;
  int m_questions = 0;
  std::map<std::string, Row> m_rows, m_halves;
  Row m_suggested, m_surely, m_possible;
  std::array<Row, 2> m_byRollouts;
  std::array<Agreement, 2> m_agreements;
  std::map<const char*, int> m_chosen;
};

/// Asks the robots of one match; returns how often.
/// `farthest`: of directions at the ball, beside the goal's, degrees; 0: the advisor's candidates.
int askMatch(std::uint64_t seed, int most, int farthest, Comparison& comparison) {
  link::Scenario scenario = link::loadScenario("match").value();
  scenario.settings.seed = seed;
  auto match = SimulatedMatch::create(scenario, {}).value();
  auto other = SimulatedMatch::create(scenario, {}).value();
  std::vector<std::unique_ptr<Thinking>> robots;
  for (const auto& slot : match.robots().all()) {
    link::ProcessOptions options;
    options.robot = slot->id;
    options.behaviour = slot->behaviour;
    options.parameters = slot->parameters;
    options.field = scenario.settings.field;
    options.model = scenario.robots[robots.size()].model;
    options.facesLeft = slot->facesLeft;
    robots.push_back(std::make_unique<Thinking>(options));
  }
  int asked = 0;
  constexpr int ticksOfCycle = 6, lastTick = 60 * 500;
  for (int tick = 1; tick < lastTick && asked < most; ++tick) {
    match.tick();
    if (tick % ticksOfCycle != 0) continue;
    const double now = tick / scenario.settings.tickRate;
    for (std::size_t i = 0; i < robots.size() && asked < most; ++i) {
      Thinking& who = *robots[i];
      const link::Situation& situation = who.reader.read(match.robots().all()[i]->board, now);
      who.opponents.update(situation.opponents, now);
      if (now < who.asked + pause || link::isKick(situation.doing)) continue;
      const link::Thinker thinker{who.options.field, who.options.model,
                                  who.options.behaviour == "keeper", who.options.parameters};
      const Question question = questionOf(situation, thinker);
      const Candidates candidates = candidatesFor(question, situation, thinker, {});
      if (candidates.size() < 2 || (farthest > 0 && question != Question::AtBall)) continue;
      who.asked = now;
      ++asked;
      const std::uint64_t first = 1000 * (1000 * seed + static_cast<std::uint64_t>(asked));
      const rollout::Belief belief = beliefOf(situation, who.opponents, now, who.options);
      const link::Moment moment = situationOf(match).moment;
      if (farthest > 0) {
        comparison.compareDirections(other, moment, who, *situation.ball, belief,
                                     knowingPlaces(match, who, belief), farthest, first);
      } else {
        comparison.compare(other, moment, who, question, belief, candidates, first);
      }
    }
  }
  return asked;
}

}  // namespace
}  // namespace pitchboard::tests

int main(int argc, char** argv) {
  const auto number = [&](int i, int usual) { return argc > i ? std::atoi(argv[i]) : usual; };
  pitchboard::tests::Comparison comparison(number(2, 16), number(3, 36), number(5, 0) == 1);
  const int farthest = number(5, 0) == 2 ? 60 : number(5, 0) == 3 ? 120 : 0;
  int left = number(1, 300);
  for (auto seed = static_cast<std::uint64_t>(number(4, 1000)); left > 0; ++seed) {
    left -= pitchboard::tests::askMatch(seed, std::min(left, pitchboard::tests::ofMatch), farthest,
                                        comparison);
  }
  comparison.print();
}
