// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The newest row of each group, for expressions over recorded variables. The thread of its match.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <telemetry/series/losable.h>
#include <telemetry/series/row_sink.h>

namespace pitchboard::link {

class LatestRows : public telemetry::RowSink {
 public:
  struct Place {
    std::size_t group = 0, column = 0;
  };

  telemetry::GroupId addGroup(const telemetry::GroupInfo& info) override;
  void append(telemetry::GroupId group, const telemetry::RowView& row) override;

  std::optional<Place> find(std::string_view group, std::string_view column) const;
  /// Every GROUP/COLUMN that find() knows.
  std::vector<std::string> names() const;
  /// The newest value; NaN if it is unknown (ColumnInfo::lost) or there is no row yet.
  double value(const Place& place) const;
  /// How many rows the first group, that of the match, has had.
  std::uint64_t samples() const { return m_samples; }

 private:
  struct Group {
    telemetry::GroupInfo info;
    std::vector<telemetry::Losable> losable;
    std::vector<std::uint32_t> words;
    std::vector<double> values;
  };
  std::vector<Group> m_groups;
  std::uint64_t m_samples = 0;
};

}  // namespace pitchboard::link
