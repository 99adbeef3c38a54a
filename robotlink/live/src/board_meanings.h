// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads a received blackboard's row by meaning, and all of it by name. Private to robotlink/live.
// Any thread.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/frame/build_robot.h>
#include <robotlink/live/attached_robots.h>

namespace pitchboard::link {

/// Where the columns of a board have what is shown of a robot.
class BoardMeanings {
 public:
  BoardMeanings() = default;
  explicit BoardMeanings(const std::vector<telemetry::ColumnInfo>& columns) {
    std::size_t words = 0, values = 0;
    auto names = std::make_shared<std::vector<std::string>>();
    for (const telemetry::ColumnInfo& column : columns) {
      const bool isValue = column.type == telemetry::ColumnType::Float64;
      m_columns.push_back({column.type, isValue ? values++ : words++});
      names->push_back(column.name);
      for (std::size_t i = 0; i < m_places.size(); ++i) {
        if (telemetry::meaningTable[i].variable == column.name) m_places[i] = m_columns.back();
      }
    }
    m_names = std::move(names);
  }

  BoardContents contents(const BoardRow& row) const {
    BoardContents out{m_names, {}};
    out.values.reserve(m_columns.size());
    for (const Place& place : m_columns) out.values.push_back(place.read(row));
    return out;
  }

  /// Of a row that must outlive it.
  RobotReader reader(const BoardRow& row) const {
    return [this, &row](telemetry::FieldMeaning meaning) -> std::optional<double> {
      const auto& place = m_places[static_cast<std::size_t>(meaning)];
      if (!place) return std::nullopt;
      const double value = place->read(row);
      return std::isfinite(value) ? std::optional(meantBy(meaning, value)) : std::nullopt;
    };
  }

 private:
  struct Place {
    telemetry::ColumnType type;
    std::size_t index;
    double read(const BoardRow& row) const {
      if (type == telemetry::ColumnType::Float64) return row.values[index];
      const std::uint32_t word = row.words[index];
      return type == telemetry::ColumnType::Int32 ? std::bit_cast<std::int32_t>(word)
                                                  : static_cast<double>(std::bit_cast<float>(word));
    }
  };
  std::shared_ptr<const std::vector<std::string>> m_names;
  std::vector<Place> m_columns;
  std::array<std::optional<Place>, telemetry::fieldMeaningCount> m_places;
};

}  // namespace pitchboard::link
