// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The interface that takes rows: the series store, a session file, or both. Rows are values; the
// implementation says which threads may call it.

#include <span>

#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

/// Called by one thread at a time, unless the implementation says otherwise.
class RowSink {
 public:
  virtual ~RowSink() = default;
  /// Registers a group and returns its id. A group that is known already (isSameGroup()) continues,
  /// with the name and facts of `info`, also if its columns are others now; the id can change
  /// then. Rows have the columns of the last call.
  virtual GroupId addGroup(const GroupInfo& info) = 0;
  /// Gives known groups other names and facts. Their columns stay. Groups may exchange their
  /// names; a sink that is read by other threads changes all of them at once.
  virtual void describeGroups(std::span<const GroupInfo> groups) {
    for (const GroupInfo& group : groups) addGroup(group);
  }
  /// Adds a row. The views in `row` need to be valid only during the call.
  virtual void append(GroupId group, const RowView& row) = 0;
};

}  // namespace pitchboard::telemetry
