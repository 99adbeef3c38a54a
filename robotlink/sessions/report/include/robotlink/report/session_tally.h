// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a tally counts, wherever it comes from: rows of a simulated match, while it is played or
// from a recording, and frames of a live match. Any thread, one at a time.

#include <memory>

#include <robotlink/frame/match_frame.h>
#include <robotlink/report/match_tally.h>
#include <telemetry/series/row_sink.h>
#include <telemetry/series/series_store.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::link {

/// Counts a simulated match by its rows; give it to a MatchSampler, or rows that it has made. Of
/// rows that come more often, those at multiples of tallyStep and the last ones count, so that
/// every source gives the same numbers.
class RowTally : public telemetry::RowSink {
 public:
  explicit RowTally(const sim::FieldSpec& field = {});
  ~RowTally() override;
  telemetry::GroupId addGroup(const telemetry::GroupInfo& info) override;
  void append(telemetry::GroupId group, const telemetry::RowView& row) override;
  /// Takes the rows so far as what held at `time`, when the counted range begins.
  void beginAt(double time);
  /// Counted until the last row; `range` is that of the curves.
  MatchStatistics statistics(telemetry::TimeRange range) const;

 private:
  struct Source;
  TallyMoment complete() const;
  void settle();
  void endMoment();

  std::vector<std::unique_ptr<Source>> m_sources;
  MatchTally m_tally;
  TallyMoment m_moment;            // that of the newest rows
  std::vector<Source*> m_present;  // whose robots are in it
  double m_settled = -1e300;       // s, when the last moment was counted
  std::uint64_t m_rows = 0;
};

/// A frame of a live match for a MatchTally.
TallyMoment liveMomentOf(const MatchFrame& frame);

/// Both read every row of the range once; for live robots they use at most 36 000 moments.
MatchStatistics statisticsOf(const telemetry::SeriesStore& rows, telemetry::TimeRange range,
                             const sim::FieldSpec& field = {});
MatchStatistics statisticsOf(const telemetry::SessionReader& session, telemetry::TimeRange range);

}  // namespace pitchboard::link
