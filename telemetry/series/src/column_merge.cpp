// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/series/column_merge.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>
#include <unordered_map>

namespace pitchboard::telemetry {
namespace {

using ColumnIndices = std::unordered_map<std::string_view, std::size_t>;

ColumnIndices indicesOf(const std::vector<ColumnInfo>& columns) {
  ColumnIndices out;
  out.reserve(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) out.try_emplace(columns[i].name, i);
  return out;
}

double numberOf(ColumnType type, std::uint32_t word) {
  return type == ColumnType::Int32 ? std::bit_cast<std::int32_t>(word)
                                   : static_cast<double>(std::bit_cast<float>(word));
}

std::uint32_t wordOf(ColumnType type, double number) {
  if (type == ColumnType::Float32) return std::bit_cast<std::uint32_t>(static_cast<float>(number));
  if (std::isnan(number)) return 0;
  return std::bit_cast<std::uint32_t>(
      static_cast<std::int32_t>(std::clamp(number, -2147483648.0, 2147483647.0)));
}

/// Makes room for rows that do not have the column.
void makeOptional(ColumnInfo& column) {
  column.isWhole = column.isWhole || column.type == ColumnType::Int32;
  column.type = ColumnType::Float64;
}

/// Describes a column as `now`, for rows of both.
ColumnInfo joined(const ColumnInfo& before, const ColumnInfo& now) {
  ColumnInfo out = now;
  if (before.type != now.type) makeOptional(out);
  out.isWhole = out.isWhole && (before.isWhole || before.type == ColumnType::Int32);
  if (before.resolution != now.resolution) out.resolution = 0.0;
  if (now.lost.empty()) out.lost = before.lost;
  if (now.kind == ColumnKind::Text) {
    out.labels.insert(before.labels.begin(), before.labels.end());
  }
  return out;
}

}  // namespace

std::vector<ColumnInfo> mergedColumns(const std::vector<ColumnInfo>& before,
                                      const std::vector<ColumnInfo>& now) {
  if (before.empty()) return now;
  std::vector<ColumnInfo> out;
  out.reserve(std::max(before.size(), now.size()));
  const ColumnIndices known = indicesOf(before), given = indicesOf(now);
  for (const ColumnInfo& column : before) {
    const auto found = given.find(column.name);
    if (found != given.end()) {
      out.push_back(joined(column, now[found->second]));
      continue;
    }
    out.push_back(column);
    makeOptional(out.back());
  }
  for (const ColumnInfo& column : now) {
    if (known.contains(column.name) || out.size() >= maxMergedColumns) continue;
    out.push_back(column);
    makeOptional(out.back());
  }
  return out;
}

RowMap::RowMap(const std::vector<ColumnInfo>& from, const std::vector<ColumnInfo>& to) {
  const bool isSame = std::ranges::equal(from, to, [](const ColumnInfo& a, const ColumnInfo& b) {
    return a.name == b.name && a.type == b.type;
  });
  if (isSame) {
    m_columns.resize(to.size());
    std::iota(m_columns.begin(), m_columns.end(), std::size_t{0});
    return;
  }
  m_isIdentity = false;
  const ColumnIndices known = indicesOf(to);
  std::vector<std::uint32_t> indices;  // of the columns of `to`, among the words or the values
  indices.reserve(to.size());
  for (const ColumnInfo& column : to) {
    std::size_t& next = column.type == ColumnType::Float64 ? m_values : m_words;
    indices.push_back(static_cast<std::uint32_t>(next++));
  }
  std::uint32_t words = 0, values = 0;
  for (const ColumnInfo& column : from) {
    const std::uint32_t index = column.type == ColumnType::Float64 ? values++ : words++;
    const auto found = known.find(column.name);
    m_columns.push_back(found == known.end() ? to.size() : found->second);
    if (found == known.end()) continue;
    m_steps.push_back({column.type, to[found->second].type, index, indices[found->second]});
  }
}

RowView RowMap::convert(const RowView& row, std::vector<std::uint32_t>& words,
                        std::vector<double>& values) const {
  if (m_isIdentity) return row;
  words.assign(m_words, 0);
  values.assign(m_values, std::numeric_limits<double>::quiet_NaN());
  for (const Step& step : m_steps) {
    if (step.from == ColumnType::Float64) {
      if (step.fromIndex >= row.values.size()) continue;
      const double number = row.values[step.fromIndex];
      if (step.to == ColumnType::Float64)
        values[step.toIndex] = number;
      else
        words[step.toIndex] = wordOf(step.to, number);
    } else if (step.fromIndex < row.words.size()) {
      const std::uint32_t word = row.words[step.fromIndex];
      if (step.to == ColumnType::Float64)
        values[step.toIndex] = numberOf(step.from, word);
      else
        words[step.toIndex] = word;
    }
  }
  return {row.time, words, values};
}

}  // namespace pitchboard::telemetry
