// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The part of a session that is exported, with names resolved to indices in rows.

#include <vector>

#include <telemetry/session/session_export.h>

namespace pitchboard::telemetry {

struct SelectedColumn {
  std::size_t column = 0;  ///< in GroupInfo
  ColumnType type = ColumnType::Float64;
  std::size_t index = 0;  ///< in the words or the values of a row
};

struct SelectedGroup {
  bool selected = false;
  std::vector<SelectedColumn> columns;
};

/// Index = GroupId. Error NotFound as checkSelection().
Result<std::vector<SelectedGroup>> resolveSelection(const SessionReader& session,
                                                    const ExportSelection& selection);

}  // namespace pitchboard::telemetry
