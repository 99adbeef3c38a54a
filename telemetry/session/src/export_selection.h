// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The part of a session that is exported, with names resolved to indices in rows.

#include <cmath>
#include <vector>

#include <telemetry/session/session_export.h>

namespace pitchboard::telemetry {

struct SelectedColumn {
  std::size_t column = 0;  ///< in GroupInfo
  ColumnType type = ColumnType::Float64;
  std::size_t index = 0;  ///< in the words or the values of a row
  std::size_t wanted =
      0;  ///< number of the first entry of ExportSelection::variables that names it
  /// Labels of a text column; owned by the session.
  const std::map<std::int32_t, std::string>* labels = nullptr;

  /// Returns the label of a value of a text column; null for a number and for a hole.
  const std::string* labelOf(double value) const {
    if (labels == nullptr || !std::isfinite(value)) return nullptr;
    const auto found = labels->find(static_cast<std::int32_t>(value));
    return found == labels->end() ? nullptr : &found->second;
  }
};

struct SelectedGroup {
  bool selected = false;
  /// In the order of the group's columns.
  std::vector<SelectedColumn> columns;
};

/// Index = GroupId. Error NotFound as checkSelection().
Result<std::vector<SelectedGroup>> resolveSelection(const SessionReader& session,
                                                    const ExportSelection& selection);

}  // namespace pitchboard::telemetry
