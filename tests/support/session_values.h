// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A value of a row of a session, by its column: for tests that know a file by what stands in it.

#include <QtGlobal>
#include <bit>
#include <string>

#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

inline double valueOf(const GroupInfo& info, const RowView& row, std::size_t column) {
  std::size_t words = 0, values = 0;
  for (std::size_t i = 0; i < column; ++i) {
    ++(info.columns[i].type == ColumnType::Float64 ? values : words);
  }
  switch (info.columns[column].type) {
    case ColumnType::Int32:
      return std::bit_cast<std::int32_t>(row.words[words]);
    case ColumnType::Float32:
      return double(std::bit_cast<float>(row.words[words]));
    case ColumnType::Float64:
      break;
  }
  return row.values[values];
}

inline std::size_t columnOf(const GroupInfo& info, const std::string& name) {
  for (std::size_t i = 0; i < info.columns.size(); ++i) {
    if (info.columns[i].name == name) return i;
  }
  qFatal("there is no column %s", name.c_str());
}

}  // namespace pitchboard::telemetry
