// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where rows go: the series store, a session file, both one after the other.

#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

/// One thread at a time.
class RowSink {
 public:
  virtual ~RowSink() = default;
  /// A group of this name with the same columns is the same group. So is one with further Float64
  /// columns behind them, though its id may be another one from then on.
  virtual GroupId addGroup(const GroupInfo& info) = 0;
  virtual void append(GroupId group, const RowView& row) = 0;
};

}  // namespace pitchboard::telemetry
