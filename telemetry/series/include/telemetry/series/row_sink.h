// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where rows go: the series store, a session file, both one after the other.

#include <string_view>

#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

/// One thread at a time.
class RowSink {
 public:
  virtual ~RowSink() = default;
  /// A group of this name with the same columns is the same group. So is one with further Float64
  /// columns behind them, though its id may be another one from then on.
  virtual GroupId addGroup(const GroupInfo& info) = 0;
  /// A group goes on under another name, with its rows where the sink can do that; columns may be
  /// added as by addGroup(). Where a group has that name already, it is that group.
  virtual GroupId renameGroup(std::string_view /*from*/, const GroupInfo& to) {
    return addGroup(to);
  }
  virtual void append(GroupId group, const RowView& row) = 0;
};

}  // namespace pitchboard::telemetry
