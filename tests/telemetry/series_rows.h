// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Random rows that hold everything a blackboard can: constants, rare changes, noise, NaN,
// infinities, equal times.

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "naive_series.h"

namespace pitchboard::telemetry {

inline constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline GroupInfo group(const std::string& name = "B1") {
  GroupInfo info;
  info.name = name;
  for (const char* column : {"CONSTANT", "RARE", "NOISE"}) {
    info.columns.push_back({column, ColumnType::Int32, "", "Ints", ColumnKind::Number, {}});
  }
  for (const char* column : {"F_CONSTANT", "F_RARE", "F_NOISE", "F_HOLES"}) {
    info.columns.push_back({column, ColumnType::Float32, "cm", "Floats", ColumnKind::Number, {}});
  }
  // Not seen while one of two other columns, or the column itself, says so.
  info.columns.push_back({"F_SEEN", ColumnType::Float32, "cm", "Floats", ColumnKind::Number, {}});
  info.columns.back().lost = {{"RARE", 1}, {"F_RARE", -1}};
  info.columns.push_back({"F_SELF", ColumnType::Float32, "cm", "Floats", ColumnKind::Number, {}});
  info.columns.back().lost = {{"F_SELF", -1}};
  for (const char* column : {"D_NOISE", "D_HOLES", "D_NAN"}) {
    info.columns.push_back({column, ColumnType::Float64, "m", "Doubles", ColumnKind::Number, {}});
  }
  return info;
}

class Source {
 public:
  explicit Source(unsigned seed) : m_random(seed) {}

  NaiveRow next() {
    const auto kind = m_random() % 100;
    if (kind >= 10) m_time += 1.0 / 60.0;  // else: the same time again
    if (kind == 99) m_time += 3.0;         // a pause
    return at(m_time);
  }
  NaiveRow at(double time) {
    m_time = time;
    if (m_random() % 97 == 0) m_rare = static_cast<std::int32_t>(m_random() % 5) - 2;
    const double noise = std::normal_distribution<double>(1e6, 3.0)(m_random);
    const auto hole = m_random() % 50;
    const double holes = hole == 0   ? notANumber
                         : hole == 1 ? infinity
                         : hole == 2 ? -infinity
                                     : noise;
    const auto f = [](double v) { return std::bit_cast<std::uint32_t>(static_cast<float>(v)); };
    return {time,
            {7, static_cast<std::uint32_t>(m_rare), static_cast<std::uint32_t>(m_random()), f(-0.0),
             f(m_rare * 0.5), f(noise), f(holes), f(noise), f(m_rare)},
            {noise, holes, notANumber}};
  }

 private:
  std::mt19937 m_random;
  double m_time = 0.0;
  std::int32_t m_rare = 0;
};

inline RowView viewOf(const NaiveRow& row) {
  return {row.time, row.words, row.values};
}

}  // namespace pitchboard::telemetry
