// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The interface that takes rows: the series store, a session file, or both. Rows are values; the
// implementation says which threads may call it.

#include <string_view>

#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

/// Called by one thread at a time, unless the implementation says otherwise.
class RowSink {
 public:
  virtual ~RowSink() = default;
  /// Registers a group and returns its id. A group with the same name and columns is the same
  /// group. Further Float64 columns may be added at the end; the id can change then.
  virtual GroupId addGroup(const GroupInfo& info) = 0;
  /// Continues a group under another name, with its old rows if the sink can do that. Columns may
  /// be added as in addGroup(). If a group of the new name exists, it is continued instead.
  virtual GroupId renameGroup(std::string_view /*from*/, const GroupInfo& to) {
    return addGroup(to);
  }
  /// Adds a row. The views in `row` need to be valid only during the call.
  virtual void append(GroupId group, const RowView& row) = 0;
};

}  // namespace pitchboard::telemetry
