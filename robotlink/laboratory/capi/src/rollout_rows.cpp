// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/capi/rollout_rows.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <base/try.h>

namespace pitchboard::link {
namespace {

// Each column stands here once: its name, its words, and where the number is. `visit` gets a
// reference to a double, a bool, an int or an enumeration with its last value. Programs know
// columns by their place: a new one is added at the end.

template <class Robot, class Visit>
void visitRobot(Robot& robot, const Visit& visit) {
  visit("x", "m", robot.pose.position.x);
  visit("y", "m", robot.pose.position.y);
  visit("yaw", "rad", robot.pose.yaw);
  visit("sigma", "m, standard deviation of each axis", robot.sigma);
  visit("yaw_sigma", "rad", robot.yawSigma);
  visit("forward", "m/s of its gait", robot.forward);
  visit("left", "m/s of its gait", robot.left);
  visit("turn", "rad/s of its gait", robot.turn);
  visit("absent", "1: penalised or not in the game", robot.absent);
  visit("down", "1: lies on the field", robot.down);
  visit("gets_up_in", "s, while it is down", robot.getsUpIn);
}

template <class Belief, class Visit>
void visitGame(Belief& belief, const Visit& visit) {
  auto& ball = belief.ball;
  auto& game = belief.game;
  visit("ball_x", "m, where it was seen last", ball.place.x);
  visit("ball_y", "m", ball.place.y);
  visit("ball_sigma", "m, standard deviation of each axis at that time", ball.sigma);
  visit("ball_age", "s since then", ball.age);
  visit("ball_vx", "m/s at that time", ball.velocity.x);
  visit("ball_vy", "m/s at that time", ball.velocity.y);
  visit("ball_velocity_sigma", "m/s", ball.velocitySigma);
  visit("goals_left", "goals so far of the team that attacks right", game.goalsLeft);
  visit("goals_right", "goals so far of the team that attacks left", game.goalsRight);
  visit("seconds_left", "s left of the half; the rollout ends with the half", game.secondsLeft);
  visit("state", "0 initial, 1 ready, 2 set, 3 playing, 4 finished", game.state);
  visit("set_play",
        "0 none, 1 direct and 2 indirect free kick, 3 penalty kick, 4 throw-in, 5 goal kick, "
        "6 corner kick",
        game.setPlay);
  visit("set_play_side", "team that takes it: 0 the one that attacks right, 1 the other",
        game.setPlaySide);
  visit("set_play_left", "s that the other team must still keep away, at most", game.setPlayLeft);
}

template <class Of, class VisitAll>
std::vector<WorldColumn> columnsBy(Of of, const VisitAll& visitAll) {
  std::vector<WorldColumn> columns;
  visitAll(of, [&columns](const char* name, const char* description, const auto&) {
    columns.push_back({name, description});
  });
  return columns;
}

/// Takes numbers of a row in their order; remembers the first that does not fit.
class RowReader {
 public:
  explicit RowReader(const double* from) : m_from(from) {}

  template <class Value>
  void operator()(const char* name, const char* /*meaning*/, Value& value) const {
    const double number = *m_from++;
    if (std::isnan(number)) return;
    if constexpr (std::is_same_v<Value, double>) {
      value = number;
    } else if constexpr (std::is_same_v<Value, bool>) {
      value = number != 0.0;
    } else {
      double last = 1e6;
      if constexpr (std::is_enum_v<Value>) {
        last = static_cast<double>(lastOf(Value{}));
      }
      if (!(number >= 0.0 && number <= last) || number != std::floor(number)) {
        if (m_wrong.empty()) m_wrong = name;
        return;
      }
      value = static_cast<Value>(static_cast<int>(number));
    }
  }
  Result<void> result() const {
    if (m_wrong.empty()) return {};
    return failure(ErrorCode::InvalidArgument, "This column takes whole numbers of its list.",
                   m_wrong);
  }

 private:
  mutable const double* m_from;
  mutable std::string m_wrong;
};

Result<void> checkSizes(std::size_t players, std::size_t robots, std::size_t game) {
  const std::size_t wanted = players * beliefRobotColumns().size();
  if (robots == wanted && game == beliefGameColumns().size()) return {};
  return failure(ErrorCode::InvalidArgument,
                 "A belief has " + std::to_string(wanted) + " numbers of robots and " +
                     std::to_string(beliefGameColumns().size()) + " of ball and game.");
}

}  // namespace

std::span<const WorldColumn> beliefRobotColumns() {
  static const auto columns =
      columnsBy(rollout::RobotBelief{}, [](auto& of, const auto& visit) { visitRobot(of, visit); });
  return columns;
}

std::span<const WorldColumn> beliefGameColumns() {
  static const auto columns =
      columnsBy(rollout::Belief{}, [](auto& of, const auto& visit) { visitGame(of, visit); });
  return columns;
}

std::span<const WorldColumn> outcomeColumns() {
  static const auto columns = [] {
    std::vector<WorldColumn> made;
    for (const rollout::OutcomeColumn& one : rollout::columns())
      made.push_back({one.name, one.description});
    return made;
  }();
  return columns;
}

Result<void> writeBelief(const rollout::Belief& belief, std::span<double> robots,
                         std::span<double> game) {
  TRY(checkSizes(belief.robots.size(), robots.size(), game.size()));
  double* to = robots.data();
  const auto put = [&to](const char*, const char*, const auto& value) {
    *to++ = static_cast<double>(value);
  };
  for (const rollout::RobotBelief& robot : belief.robots) visitRobot(robot, put);
  to = game.data();
  visitGame(belief, put);
  return {};
}

Result<rollout::Belief> readBelief(rollout::Belief belief, std::span<const double> robots,
                                   std::span<const double> game) {
  TRY(checkSizes(belief.robots.size(), robots.size(), game.size()));
  const RowReader ofRobots(robots.data()), ofGame(game.data());
  for (rollout::RobotBelief& robot : belief.robots) visitRobot(robot, ofRobots);
  visitGame(belief, ofGame);
  TRY(ofRobots.result());
  TRY(ofGame.result());
  return belief;
}

}  // namespace pitchboard::link
