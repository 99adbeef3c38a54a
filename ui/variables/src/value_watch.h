// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether a value that a person wrote stays: a process of the robot may write the same variable all
// the time. UI thread only.

#include <QString>
#include <optional>
#include <vector>

#include <telemetry/series/series_store.h>

namespace pitchboard::ui {

struct UserWrite {
  QString group, column;
  double before = 0.0;  ///< what stood there
  double value = 0.0;   ///< what was written
  double time = 0.0;    ///< after which tick, s of the source
};

struct OverwrittenValue {
  UserWrite written;
  double found = 0.0;  ///< the first other value
  double after = 0.0;  ///< s of the source
};

class ValueWatch {
 public:
  void add(const UserWrite& written);
  void clear() { m_watched.clear(); }
  bool empty() const { return m_watched.empty(); }
  /// The first written value that did not stay, if one was overwritten within a second of the
  /// source's time. What stayed that long is forgotten.
  std::optional<OverwrittenValue> check(const telemetry::SeriesStore& store);

 private:
  std::vector<UserWrite> m_watched;
};

/// What to tell the person.
QString overwrittenText(const OverwrittenValue& value, const telemetry::ColumnInfo& column);

}  // namespace pitchboard::ui
