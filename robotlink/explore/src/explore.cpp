// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/explore/explore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <base/try.h>
#include <robotlink/rollout/rollouts.h>
#include <robotlink/rollout/summary.h>
#include <simcore/world/field.h>

namespace pitchboard::link {
namespace {

using rollout::Belief;
using rollout::Rollouts;
using rollout::Setup;
using rollout::TracePoint;

constexpr double cellSize = 0.25;   // m, of the heat maps
constexpr double atBall = 1.0;      // m: nearer to the ball, kicks are compared
constexpr double ballMemory = 2.0;  // s since it was seen
constexpr double passFrom = 0.8;    // m to a team-mate, at least
constexpr double passBefore = 0.3;  // m in front of it
constexpr double beforeLine = 0.3;  // m, of kicks that do not reach the goal

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
  Advice advice;  // AdviceKind::None: it plays as it likes
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
      play.advice = action.advice;
      play.advised = m_player;
      TRY(action.rollouts.play(m_start.belief, seeds, play, rows, cancelled,
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
    if (!m_options.robot) return add({}, m_start.setup);
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
    TRY(add(std::move(plays), m_start.setup));
    for (const Role& role : roles) {
      if (role.behaviour == player.behaviour.name) continue;
      Setup setup = m_start.setup;
      setup.players[m_player].behaviour.name = role.behaviour;
      ExploredAction action;
      action.text = role.text;
      action.from = at;
      action.to = role.to;
      TRY(add(std::move(action), setup));
    }
    return addKicks();
  }

  /// What a robot at the ball may do with it, in the words of its advisor.
  Result<void> addKicks() {
    const Belief& belief = m_start.belief;
    const rollout::RobotBelief& robot = belief.robots[m_player];
    const rollout::Player& player = m_start.setup.players[m_player];
    const Point& ball = belief.ball.place;
    const bool isAtBall =
        !robot.down && belief.ball.age < ballMemory && distance(robot.pose.position, ball) < atBall;
    if (!isAtBall || player.behaviour.name == "idle") return {};
    const sim::FieldSpec& field = m_start.setup.field;
    const double strong = sim::rollingDistance(field.surface, player.model.kickSpeed);
    const double weak = sim::rollingDistance(field.surface, player.model.weakKickSpeed);
    const Point goal{m_sign * field.halfLength(), 0.0};
    if (distance(ball, goal) < strong) {
      TRY(addKick("Kicks at the goal", AdviceKind::StrongKick, goal));
    } else {
      const double heading = direction(ball, goal);
      const double x = field.halfLength() - beforeLine, y = field.halfWidth() - beforeLine;
      TRY(addKick("Kicks ahead", AdviceKind::StrongKick,
                  {std::clamp(ball.x + strong * std::cos(heading), -x, x),
                   std::clamp(ball.y + strong * std::sin(heading), -y, y)}));
    }
    for (std::size_t i = 0; i < belief.robots.size(); ++i) {
      const rollout::RobotBelief& mate = belief.robots[i];
      const rollout::Player& other = m_start.setup.players[i];
      const Point& at = mate.pose.position;
      const double away = distance(at, ball);
      if (i == m_player || mate.absent || mate.down || other.side != player.side ||
          other.behaviour.name == "keeper" || away < passFrom || away > strong) {
        continue;
      }
      TRY(addKick("Passes to " + m_start.names[i],
                  away > weak ? AdviceKind::StrongKick : AdviceKind::WeakKick,
                  {at.x + m_sign * passBefore, at.y}));
    }
    return addKick("Dribbles to the goal", AdviceKind::Dribble, goal);
  }

  Result<void> addKick(std::string text, AdviceKind kind, const Point& to) {
    ExploredAction action;
    action.text = std::move(text);
    action.from = m_start.belief.ball.place;
    action.to = to;
    return add(std::move(action), m_start.setup, {kind, {to, 0.0}});
  }

  Result<void> add(ExploredAction action, const Setup& setup, const Advice& advice = {}) {
    rollout::RolloutsOptions options;
    options.threads = m_options.threads;
    m_actions.push_back({std::move(action), TRY(Rollouts::create(setup, options)), advice, {}});
    return {};
  }

  void addPoint(const TracePoint& point, TimeCounts& counts) const {
    const sim::FieldSpec& field = m_start.setup.field;
    ++counts.cells[rollout::heatCell(point.ball, field, m_columns, m_rows)];
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
  if (alike.size() == actions.size()) return "The actions do not differ significantly.";
  std::string text = "No significant difference between ";
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
