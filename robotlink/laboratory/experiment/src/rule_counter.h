// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Counts how often rules are broken in a run: in the rows that a recording of it has, so that
// checking the recording gives the same numbers. An observer behind the MatchSampler that fills its
// rows. The thread of its match; seconds.

#include <limits>
#include <memory>
#include <vector>

#include <robotlink/match/tick_observer.h>
#include <telemetry/query/moment_watch.h>
#include <telemetry/query/rules.h>
#include <telemetry/series/series_store.h>

namespace pitchboard::link {

class RuleCounter : public TickObserver {
 public:
  explicit RuleCounter(const std::vector<telemetry::Rule>& rules)
      : m_watch(telemetry::questionsOf(rules)), m_counts(rules.size(), 0.0) {}

  /// Where the sampler writes the row of every tick.
  const std::shared_ptr<telemetry::SeriesStore>& rows() const { return m_rows; }

  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds tickTime) override;
  /// Returns for each rule how often it was broken until the last row; NaN if the match does not
  /// have its variables or robots.
  std::vector<double> finish();

 private:
  void count(const std::vector<telemetry::FoundMoment>& moments) {
    for (const telemetry::FoundMoment& one : moments) m_counts[one.question] += 1.0;
  }

  std::shared_ptr<telemetry::SeriesStore> m_rows =
      std::make_shared<telemetry::SeriesStore>(telemetry::SeriesOptions{std::size_t{128} << 20});
  telemetry::MomentWatch m_watch;
  std::vector<double> m_counts;
  int m_fresh = 0;  // ticks that were not looked at
};

}  // namespace pitchboard::link
