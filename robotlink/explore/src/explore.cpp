// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/explore/explore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <base/angles.h>
#include <base/try.h>
#include <robotlink/rollout/rollouts.h>
#include <simcore/world/action.h>

namespace pitchboard::link {
namespace {

using rollout::Belief;
using rollout::Rollouts;
using rollout::Setup;
using rollout::TracePoint;

constexpr double cellSize = 0.25;     // m, of the heat maps
constexpr double kickWithin_s = 0.5;  // a ball that was seen longer ago cannot be kicked now

/// Quantiles of the normal distribution for 1, 2, ... intervals that hold together with 95 %.
double normalQuantile(std::size_t intervals) {
  constexpr std::array quantiles{1.960, 1.960, 2.241, 2.394, 2.498, 2.576,
                                 2.638, 2.690, 2.734, 2.773, 2.807};
  return quantiles[std::min(intervals, quantiles.size() - 1)];
}

Estimate estimateOf(std::span<const double> values, double quantile) {
  const auto n = static_cast<double>(values.size());
  if (values.size() < 2) return {};
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double half = quantile * std::sqrt(squares / (n - 1.0) / n);
  return {mean, mean - half, mean + half};
}

/// An action of the chosen robot as rollouts play it, and the goal difference of each rollout.
struct PlayedAction {
  ExploredAction shown;
  Rollouts rollouts;
  Belief belief;
  std::vector<double> differences;
};

/// What has happened up to one time, counted over rollouts.
struct TimeCounts {
  std::vector<std::uint32_t> cells;
  std::size_t goalsLeft = 0, goalsRight = 0;
};

class Exploration {
 public:
  static Result<Exploration> create(const ExploreStart& start, const ExploreOptions& options) {
    Exploration made(start, options);
    TRY(made.check());
    TRY(made.addActions());
    return made;
  }

  /// False when it was cancelled before the round was finished.
  Result<bool> playRound(const std::atomic<bool>* cancelled) {
    const std::size_t count =
        std::min(m_options.rolloutsPerRound, m_options.mostRollouts - m_rollouts);
    std::vector<std::uint64_t> seeds(count);
    std::iota(seeds.begin(), seeds.end(), m_options.seed + m_rollouts);
    rollout::PlayOptions play;
    play.seconds = m_options.seconds;
    play.goOn = true;
    const std::size_t points = rollout::tracePoints(play);
    std::vector<double> rows(count * rollout::columnCount);
    std::vector<TracePoint> trace(count * points);
    std::vector<std::vector<double>> differences(m_actions.size());
    for (std::size_t a = 0; a < m_actions.size(); ++a) {
      PlayedAction& action = m_actions[a];
      const bool counts = a == 0;  // as the robots usually play
      TRY(action.rollouts.play(action.belief, seeds, play, rows, cancelled,
                               counts ? std::span(trace) : std::span<TracePoint>()));
      if (cancelled != nullptr && cancelled->load()) return false;
      for (std::size_t row = 0; row < rows.size(); row += rollout::columnCount) {
        const auto at = [&](rollout::Column column) {
          return rows[row + static_cast<std::size_t>(column)];
        };
        differences[a].push_back(
            m_sign * (at(rollout::Column::GoalsLeft) - at(rollout::Column::GoalsRight)));
      }
    }
    // Only whole rounds count, so that all actions have played the same seeds.
    for (std::size_t a = 0; a < m_actions.size(); ++a) {
      auto& all = m_actions[a].differences;
      all.insert(all.end(), differences[a].begin(), differences[a].end());
    }
    for (std::size_t i = 0; i < trace.size(); ++i) addPoint(trace[i], m_counts[i % points]);
    m_rollouts += count;
    return true;
  }

  ExploreResult result() const {
    ExploreResult out;
    out.rollouts = m_rollouts;
    out.seconds = m_options.seconds;
    out.columns = m_columns;
    out.rows = m_rows;
    const auto n = static_cast<double>(m_rollouts);
    for (const TimeCounts& counts : m_counts) {
      ExploredTime& time = out.times.emplace_back();
      for (const std::uint32_t cell : counts.cells) {
        time.heat.push_back(static_cast<float>(cell / n));
      }
      time.goalLeft = rollout::shareOf(static_cast<double>(counts.goalsLeft), n);
      time.goalRight = rollout::shareOf(static_cast<double>(counts.goalsRight), n);
    }
    if (m_options.robot) addActions(out);
    return out;
  }

  bool enough(const ExploreResult& result) const {
    if (m_rollouts >= m_options.mostRollouts) return true;
    const auto isKnown = [this](const rollout::Share& share) {
      return (share.high - share.low) / 2.0 <= m_options.precision;
    };
    return isKnown(result.last().goalLeft) && isKnown(result.last().goalRight) && result.isClear();
  }

  double done() const {
    return static_cast<double>(m_rollouts) / static_cast<double>(m_options.mostRollouts);
  }
  std::size_t rollouts() const { return m_rollouts; }

 private:
  Exploration(const ExploreStart& start, const ExploreOptions& options)
      : m_start(start), m_options(options) {}

  Result<void> check() {
    const auto refuse = [](const char* text, const char* key) {
      return failure(ErrorCode::InvalidArgument, text, key);
    };
    if (!(m_options.seconds >= 1.0 && m_options.seconds <= Rollouts::longest)) {
      return refuse("Rollouts last 1 to 600 s.", "seconds");
    }
    if (m_options.mostRollouts < 2 || m_options.rolloutsPerRound < 1) {
      return refuse("At least two rollouts are needed.", "rollouts");
    }
    if (m_options.robot) {
      const auto found = std::ranges::find(m_start.robots, *m_options.robot);
      if (found == m_start.robots.end()) {
        return failure(ErrorCode::NotFound, "The chosen robot does not take part.");
      }
      m_player = static_cast<std::size_t>(found - m_start.robots.begin());
      if (m_start.belief.robots[m_player].absent) {
        return failure(ErrorCode::NotFound, m_start.names[m_player] + " is penalised.");
      }
      m_sign = m_start.setup.players[m_player].side == rollout::Side::Left ? 1.0 : -1.0;
    }
    const sim::FieldSpec& field = m_start.setup.field;
    m_columns = std::max(1, static_cast<int>(std::lround(field.length / cellSize)));
    m_rows = std::max(1, static_cast<int>(std::lround(field.width / cellSize)));
    rollout::PlayOptions play;
    play.seconds = m_options.seconds;
    m_counts.resize(rollout::tracePoints(play));
    for (TimeCounts& counts : m_counts) {
      counts.cells.resize(static_cast<std::size_t>(m_columns) * static_cast<std::size_t>(m_rows));
    }
    return {};
  }

  Result<void> addActions() {
    const Belief& belief = m_start.belief;
    if (!m_options.robot) return add({}, m_start.setup, belief);
    const rollout::Player& player = m_start.setup.players[m_player];
    const Point& at = belief.robots[m_player].pose.position;
    const double ownGoal = -m_sign * m_start.setup.field.halfLength();
    struct Role {
      const char *behaviour, *text;
      std::optional<Point> to;
    };
    const std::array roles{
        Role{"striker", "Goes for the ball", belief.ball.place}, Role{"supporter", "Supports", {}},
        Role{"keeper", "Guards the goal", Point{ownGoal, 0.0}}, Role{"idle", "Stands still", {}}};
    const auto usual = std::ranges::find(
        roles, player.behaviour.name, [](const Role& role) { return std::string(role.behaviour); });
    ExploredAction plays;
    plays.text = "Plays on (" + player.behaviour.name + ')';
    plays.from = at;
    if (usual != roles.end()) plays.to = usual->to;
    TRY(add(std::move(plays), m_start.setup, belief));
    for (const Role& role : roles) {
      if (role.behaviour == player.behaviour.name) continue;
      Setup setup = m_start.setup;
      setup.players[m_player].behaviour.name = role.behaviour;
      ExploredAction action;
      action.text = role.text;
      action.from = at;
      action.to = role.to;
      TRY(add(std::move(action), setup, belief));
    }
    return addKicks();
  }

  /// Kicks that reach the ball where the robot stands: the ball leaves at once, then it plays on.
  Result<void> addKicks() {
    const Belief& belief = m_start.belief;
    const rollout::RobotBelief& robot = belief.robots[m_player];
    if (robot.down || belief.ball.age > kickWithin_s) return {};
    struct Kick {
      std::array<int, 2> codes;
      const char* text;
    };
    constexpr std::array kicks{Kick{{4, 5}, "Kicks now"}, Kick{{21, 22}, "Kicks gently now"},
                               Kick{{12, 12}, "Passes to the left now"},
                               Kick{{13, 13}, "Passes to the right now"}};
    const Setup& setup = m_start.setup;
    const sim::RobotModel& model = setup.players[m_player].model;
    const sim::NoiseParameters& noise = setup.noise.ofModel ? model.noise : setup.noise;
    const double radius = model.radius > 0.0 ? model.radius : setup.field.robotRadius;
    const sim::BallAtFeet ball{
        distance(robot.pose.position, belief.ball.place),
        wrapToPi(direction(robot.pose.position, belief.ball.place) - robot.pose.yaw)};
    for (const Kick& kick : kicks) {
      double speed = 0.0;
      int code = 0;
      for (const int foot : kick.codes) {
        const double hit = sim::kickSpeed(model, radius, foot, ball);
        if (hit <= speed) continue;
        speed = hit;
        code = foot;
      }
      if (speed <= 0.0) continue;
      const double yaw = robot.pose.yaw + radiansFromDegrees(sim::findAction(code)->kick.direction);
      const double x = std::cos(yaw), y = std::sin(yaw);
      Belief kicked = belief;
      kicked.ball.velocity = {speed * x, speed * y};
      kicked.ball.velocitySigma = std::hypot(noise.kickSpeed, speed * noise.kickAngle);
      const double rolls =
          std::min(sim::rollingDistance(setup.field.surface, speed), setup.field.length);
      ExploredAction action;
      action.text = kick.text;
      action.from = belief.ball.place;
      action.to = Point{belief.ball.place.x + rolls * x, belief.ball.place.y + rolls * y};
      TRY(add(std::move(action), setup, kicked));
    }
    return {};
  }

  Result<void> add(ExploredAction action, const Setup& setup, const Belief& belief) {
    rollout::RolloutsOptions options;
    options.threads = m_options.threads;
    m_actions.push_back({std::move(action), TRY(Rollouts::create(setup, options)), belief, {}});
    return {};
  }

  void addPoint(const TracePoint& point, TimeCounts& counts) const {
    const sim::FieldSpec& field = m_start.setup.field;
    const auto cellOf = [](double place, double half, int cells) {
      return std::clamp(static_cast<int>((place + half) / (2.0 * half) * cells), 0, cells - 1);
    };
    const int x = cellOf(point.ball.x, field.halfLength(), m_columns);
    const int y = cellOf(point.ball.y, field.halfWidth(), m_rows);
    ++counts.cells[static_cast<std::size_t>(y * m_columns + x)];
    counts.goalsLeft += point.goalsLeft > 0 ? 1 : 0;
    counts.goalsRight += point.goalsRight > 0 ? 1 : 0;
  }

  void addActions(ExploreResult& out) const {
    for (const PlayedAction& action : m_actions) {
      ExploredAction& shown = out.actions.emplace_back(action.shown);
      shown.value = estimateOf(action.differences, normalQuantile(1));
    }
    const auto best = std::ranges::max_element(
        out.actions, {}, [](const ExploredAction& action) { return action.value.value; });
    out.best = static_cast<std::size_t>(best - out.actions.begin());
    const std::vector<double>& most = m_actions[out.best].differences;
    for (std::size_t a = 0; a < m_actions.size(); ++a) {
      if (a == out.best) continue;
      std::vector<double> behind(most);
      for (std::size_t i = 0; i < behind.size(); ++i) behind[i] -= m_actions[a].differences[i];
      out.actions[a].behind = estimateOf(behind, normalQuantile(m_actions.size() - 1));
    }
  }

  ExploreStart m_start;
  ExploreOptions m_options;
  std::vector<PlayedAction> m_actions;
  std::vector<TimeCounts> m_counts;
  std::size_t m_player = 0, m_rollouts = 0;
  int m_columns = 1, m_rows = 1;
  double m_sign = 1.0;  // of the robot's team: its goals minus the others'
};

}  // namespace

bool ExploreResult::isClear() const {
  return std::ranges::count_if(actions, &ExploredAction::isWorse) + 1 >= std::ssize(actions);
}

std::string ExploreResult::verdict() const {
  if (actions.empty()) return {};
  if (isClear()) return '"' + actions[best].text + "\" is best.";
  std::vector<std::string> alike{actions[best].text};
  for (std::size_t a = 0; a < actions.size(); ++a) {
    if (a != best && !actions[a].isWorse()) alike.push_back(actions[a].text);
  }
  if (alike.size() == actions.size()) return "No difference can be told between the actions.";
  std::string text = "No difference can be told between ";
  for (std::size_t i = 0; i < alike.size(); ++i) {
    text += (i == 0 ? "\"" : i + 1 == alike.size() ? " and \"" : ", \"") + alike[i] + '"';
  }
  return text + "; the others are worse.";
}

Result<ExploreResult> explore(const ExploreStart& start, const ExploreOptions& options,
                              const ExploreProgress& progress, const std::atomic<bool>* cancelled) {
  Exploration exploration = TRY(Exploration::create(start, options));
  for (;;) {
    if (!TRY(exploration.playRound(cancelled))) break;
    ExploreResult result = exploration.result();
    const bool enough = exploration.enough(result);
    if ((progress && !progress(enough ? 1.0 : exploration.done(), result)) || enough) return result;
  }
  if (exploration.rollouts() == 0) return failure(ErrorCode::Conflict, "Cancelled.");
  return exploration.result();
}

}  // namespace pitchboard::link
