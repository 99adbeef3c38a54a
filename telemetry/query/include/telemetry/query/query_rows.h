// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The rows that expressions are evaluated over: those of a session file, or those that a source of
// the studio keeps in memory. Both give the same values for the same rows. One thread at a time.
// Times are seconds of the session or source.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <telemetry/series/series_store.h>
#include <telemetry/session/session_reader.h>

namespace pitchboard::telemetry {

/// Columns of a group that are read.
struct WantedColumns {
  GroupId group = 0;
  std::vector<std::uint32_t> columns;
};

class QueryRows {
 public:
  /// Is called with the index of one of the wanted groups, and a value for each of its columns in
  /// their order; NaN if it is unknown. The span is valid during the call. False ends the visit.
  using Visit = std::function<bool(std::size_t wanted, double time, std::span<const double>)>;

  /// The rows of a file, which must outlive this object.
  QueryRows(const SessionReader& session);
  /// The rows that are in memory now; later ones are not seen. Fails to see every row of a store
  /// with pages: use their file.
  QueryRows(const SeriesStore& store);

  /// Returns the groups; the index is the GroupId. They are valid as long as this object.
  std::span<const GroupInfo* const> groups() const { return m_groups; }
  /// Returns the groups that a typed name means (robot_names.h).
  Result<std::vector<GroupId>> groupsNamed(std::string_view name) const;
  /// Returns the times of the first and the last row (of a file: or message).
  std::optional<TimeRange> range() const { return m_range; }
  /// Visits the rows of the wanted groups in the closed range, in order of time.
  void visit(TimeRange range, std::span<const WantedColumns> wanted, const Visit& visit) const {
    m_visit(range, wanted, visit);
  }

 private:
  std::vector<const GroupInfo*> m_groups;
  std::optional<TimeRange> m_range;
  std::function<void(TimeRange, std::span<const WantedColumns>, const Visit&)> m_visit;
};

}  // namespace pitchboard::telemetry
