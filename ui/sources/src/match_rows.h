// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The rows of one simulated match, written by two kinds of threads: the match's, which brings its
// own time, and the samplers of attached blackboards, whose rows get the match's time at that
// moment, so that both can be compared.

#include <chrono>
#include <memory>
#include <mutex>

#include <telemetry/series/row_sink.h>
#include <telemetry/series/series_store.h>

namespace pitchboard::ui {

class MatchRows : public telemetry::RowSink {
 public:
  explicit MatchRows(std::size_t memoryBudget) : m_store({memoryBudget}) {}  ///< bytes

  // The match's thread.
  telemetry::GroupId addGroup(const telemetry::GroupInfo& info) override;
  void append(telemetry::GroupId group, const telemetry::RowView& row) override;
  /// The match goes on from here (s): later rows are dropped, those of attached blackboards too.
  void rewind(double time);

  // Any thread.
  const telemetry::SeriesStore& store() const { return m_store; }
  void setMemoryBudget(std::size_t bytes) { m_store.setMemoryBudget(bytes); }

  /// Of what is sampled beside the match, s.
  double timeBeside();
  /// Where its rows go; keeps `rows`.
  static std::shared_ptr<telemetry::RowSink> beside(const std::shared_ptr<MatchRows>& rows) {
    return {rows, &rows->m_store};
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::mutex m_mutex;  // of the time
  telemetry::SeriesStore m_store;
  double m_time = 0.0;  // of the match's newest row, s
  double m_step = 0.0;  // between its last two
  Clock::time_point m_arrived = Clock::now();
  bool m_matchBegan = false;
};

}  // namespace pitchboard::ui
