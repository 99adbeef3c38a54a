// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Measures one run while it is played, and says when it is over. An observer behind the
// MatchSampler whose rows it reads. The thread of its match; metres, seconds.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/geometry.h>
#include <robotlink/experiment/run_result.h>
#include <robotlink/match/tick_observer.h>
#include <robotlink/report/session_tally.h>
#include <simcore/world/snapshot.h>
#include <telemetry/expression/expression.h>

#include "latest_rows.h"
#include "match_watch.h"
#include "run_layout.h"

namespace pitchboard::link {

/// Of the values that are known.
class MeanOf {
 public:
  void add(double value);
  double mean() const;  ///< NaN without any
  double last() const { return m_last; }

 private:
  double m_sum = 0.0, m_last = 0.0;
  std::size_t m_count = 0;
};

/// A metric of the file: its expression, evaluated with every sample.
class ReducedExpression {
 public:
  /// Fails when a variable is not recorded.
  static Result<ReducedExpression> make(const ExpressionMetric& metric, const LatestRows& rows);
  void sample(double time, const LatestRows& rows);
  double value() const;

 private:
  ReducedExpression(telemetry::Expression expression, std::vector<LatestRows::Place> places,
                    Reduction reduction)
      : m_expression(std::move(expression)),
        m_places(std::move(places)),
        m_reduction(reduction),
        m_values(m_places.size()) {}

  telemetry::Expression m_expression;
  std::vector<LatestRows::Place> m_places;
  Reduction m_reduction;
  std::vector<double> m_values;  // scratch
  MeanOf m_mean;
  std::size_t m_count = 0;
  double m_first = 0.0, m_least = 0.0, m_most = 0.0, m_integral = 0.0, m_time = 0.0;
  int m_changes = 0;
  bool m_true = false;
  std::vector<double> m_all;  // only for p95
};

/// Keeps a point where it has gone far enough; of a long way every second one goes, again and
/// again. What is put elsewhere (the ball after a goal) begins another piece of the path.
class PathFollower {
 public:
  explicit PathFollower(std::string who) : m_who(std::move(who)) {}
  /// In every tick: looks whether it is farther than anything moves in `tickTime` (s).
  void look(const Point& at, double tickTime);
  void follow(const Point& at);
  /// The pieces, in whole centimetres, which is what a drawing can show.
  std::vector<RunPath> pieces() const;

 private:
  struct Stop {
    Point at;
    bool begins = false;  ///< of a piece
  };
  void keep(const Point& at, bool begins);

  std::string m_who;
  double m_step = 0.02;  // m
  std::vector<Stop> m_stops;
  std::optional<Point> m_last;
};

class RunMeasure : public TickObserver {
 public:
  /// `tally` gets the rows of the match, ten a second, and its last one.
  RunMeasure(const Experiment& experiment, const RunPlace& run, std::shared_ptr<LatestRows> rows,
             std::shared_ptr<const RowTally> tally);

  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) override;
  void happened(std::span<const MatchEvent> events) override;

  /// Why the run is over, as RunResult::endedBy; empty: it goes on.
  std::string_view endedBy() const { return m_endedBy; }
  /// An expression that cannot be computed; looked for at the first moment.
  const std::optional<Error>& problem() const { return m_problem; }
  /// Of the run that is over, or that `match` itself has ended.
  /// `rules`: how often each was broken.
  RunResult result(const SimulatedMatch& match, std::span<const double> rules);

 private:
  struct Robot {
    std::string name;
    bool ours = false;
    Point start;
  };
  /// Of the whole run.
  struct Counted {
    TeamSummary ours, others;
    double displacement = 0.0;  ///< m, sum over the robots of the team
    MeanOf belief, beliefEnd;   ///< m, over the robots of the team
  };
  Counted countedOf(const MatchStatistics& all) const;
  double teamValue(TeamValue which, const Counted& counted) const;
  void begin(const SimulatedMatch& match);
  void sample(const SimulatedMatch& match);
  void watchMovement();
  void followPaths();
  void lookForJumps(const SimulatedMatch& match);
  void countCollisions(const sim::WorldState& world);
  void end(std::string_view why) {
    if (m_endedBy.empty()) m_endedBy = why;
  }

  const Experiment& m_experiment;
  RunPlace m_run;
  std::shared_ptr<LatestRows> m_rows;
  std::shared_ptr<const RowTally> m_tally;
  std::uint64_t m_samples = 0;
  std::vector<Robot> m_robots;  // in the order of the snapshot
  std::vector<ReducedExpression> m_expressions;
  sim::Snapshot m_now;
  std::string m_endedBy;
  std::optional<Error> m_problem;

  // Goals are counted here, because a team without robots can score, too.
  int m_goals = 0, m_goalsAgainst = 0, m_ballsOut = 0, m_collisions = 0;
  bool m_fell = false, m_stuck = false;
  std::optional<double> m_firstGoal;
  std::vector<Point> m_anchors;  // the ball, then the robots of the team
  double m_movedAt = 0.0;
  std::vector<char> m_touching;  // of each pair
  std::vector<PathFollower> m_paths;
  TeamColor m_team;
  MatchWatch m_watch;
};

}  // namespace pitchboard::link
