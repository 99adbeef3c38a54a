// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a session: names of fields, the ros2msg definition, bytes.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "session_format.h"

namespace pitchboard::telemetry::session {
namespace {

constexpr std::array<char, 4> littleEndianCdr{0, 1, 0, 0};

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool isDigit(char c) {
  return c >= '0' && c <= '9';
}
char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// ros2 field name without double or final underscores; begins with a letter.
std::string fieldName(std::string_view name) {
  std::string out;
  for (const char c : name) {
    if (isLetter(c) || isDigit(c)) {
      out += lower(c);
    } else if (!out.empty() && out.back() != '_') {
      out += '_';
    }
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  if (out.empty() || !isLetter(out.front())) out.insert(0, "v");
  return out;
}

/// Of a topic or a type: letters and digits only.
std::string plainName(std::string_view name) {
  std::string out;
  for (const char c : name) {
    if (isLetter(c) || isDigit(c))
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() ? "group" : out;
}

std::string comment(const ColumnInfo& column) {
  std::string out = column.name;
  if (!column.unit.empty()) out += " [" + column.unit + "]";
  // Texts that were received can be very many; they are in the channel's metadata.
  const std::map<std::int32_t, std::string> none;
  const auto& labels = column.kind == ColumnKind::Text ? none : column.labels;
  for (const auto& [code, word] : labels) {
    out += (code == labels.begin()->first ? ": " : ", ") + std::to_string(code) + " = " + word;
  }
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return out;
}

const char* typeName(ColumnType type) {
  switch (type) {
    case ColumnType::Int32:
      return "int32";
    case ColumnType::Float32:
      return "float32";
    case ColumnType::Float64:
      return "float64";
  }
  return "float64";
}

/// NaN and infinity stay what they are.
float rounded(double value, double resolution) {
  const double whole = std::nearbyint(value / resolution) * resolution;
  return static_cast<float>(std::isfinite(whole) ? whole : value);
}

}  // namespace

std::vector<std::string> fieldNames(const GroupInfo& group) {
  std::set<std::string> taken{"source_time"};
  std::vector<std::string> out;
  for (const ColumnInfo& column : group.columns) {
    const std::string base = fieldName(column.name);
    std::string name = base;
    for (int i = 2; !taken.insert(name).second; ++i) name = base + "_" + std::to_string(i);
    out.push_back(std::move(name));
  }
  return out;
}

std::string rowSchemaName(const GroupInfo& group) {
  // A message's name has letters and digits only and begins with a capital.
  std::string name;
  for (const char c : plainName(group.name)) {
    if (c != '_') name += c;
  }
  return "pitchboard_msgs/msg/Row" + name;
}

std::string rowSchema(const GroupInfo& group) {
  const std::vector<std::string> names = fieldNames(group);
  std::string words, singles, doubles;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const ColumnInfo& column = group.columns[i];
    const bool single = isSingle(column);
    std::string& part = column.type != ColumnType::Float64 ? words : single ? singles : doubles;
    part += std::string(typeName(single ? ColumnType::Float32 : column.type)) + " " + names[i] +
            "  # " + comment(column) + "\n";
  }
  return "float64 source_time  # seconds of the source\n" + words + singles + doubles;
}

RowLayout::RowLayout(const GroupInfo& group) {
  for (const ColumnInfo& column : group.columns) {
    if (column.type != ColumnType::Float64) {
      ++words;
    } else if (const std::size_t index = values++; isSingle(column)) {
      singles.push_back({index, column.resolution});
    } else {
      doubles.push_back(index);
    }
  }
  singlesAt = wordsAt + words * 4;
  // CDR aligns 8-byte numbers to 8, counted from behind the 4 bytes of the head.
  const bool odd = (words + singles.size()) % 2 == 1;
  doublesAt = singlesAt + singles.size() * 4 + (odd && !doubles.empty() ? 4 : 0);
  size = doublesAt + doubles.size() * 8;
}

std::array<char, RowLayout::wordsAt> RowLayout::headOf(const RowView& row) {
  std::array<char, wordsAt> head{};
  std::ranges::copy(littleEndianCdr, head.begin());
  std::memcpy(head.data() + timeAt, &row.time, 8);
  return head;
}

void RowLayout::write(char* to, const RowView& row) const {
  std::memcpy(to, littleEndianCdr.data(), littleEndianCdr.size());
  std::memcpy(to + timeAt, &row.time, 8);
  const std::size_t wordCount = std::min(words, row.words.size());
  if (wordCount > 0) std::memcpy(to + wordsAt, row.words.data(), wordCount * 4);
  std::memset(to + wordsAt + wordCount * 4, 0, size - wordsAt - wordCount * 4);
  char* single = to + singlesAt;
  for (const auto& [index, resolution] : singles) {
    if (index >= row.values.size()) break;
    const float value = rounded(row.values[index], resolution);
    std::memcpy(single, &value, 4);
    single += 4;
  }
  char* number = to + doublesAt;
  for (const std::size_t index : doubles) {
    if (index >= row.values.size()) break;
    std::memcpy(number, &row.values[index], 8);
    number += 8;
  }
}

bool RowLayout::read(std::string_view bytes, double& time, std::vector<std::uint32_t>& wordsOut,
                     std::vector<double>& valuesOut) const {
  if (bytes.size() < size || size == 0 ||
      std::memcmp(bytes.data(), littleEndianCdr.data(), 2) != 0) {
    return false;
  }
  wordsOut.resize(words);
  valuesOut.resize(values);
  std::memcpy(&time, bytes.data() + timeAt, 8);
  if (words > 0) std::memcpy(wordsOut.data(), bytes.data() + wordsAt, words * 4);
  const char* single = bytes.data() + singlesAt;
  for (const Single& one : singles) {
    float value = 0.0F;
    std::memcpy(&value, single, 4);
    valuesOut[one.index] = static_cast<double>(value);
    single += 4;
  }
  const char* number = bytes.data() + doublesAt;
  for (const std::size_t index : doubles) {
    std::memcpy(&valuesOut[index], number, 8);
    number += 8;
  }
  return std::isfinite(time);
}

std::uint64_t nanoseconds(WallTime start, double seconds) {
  const std::int64_t base = start.time_since_epoch().count();
  // Limited to 100 years, so that the sum cannot overflow.
  constexpr double most = 3.2e9;
  const double inside = std::isfinite(seconds) ? std::clamp(seconds, -most, most) : 0.0;
  std::int64_t sum = 0;
  if (__builtin_add_overflow(base, std::llround(inside * 1e9), &sum)) return 0;
  return sum > 0 ? static_cast<std::uint64_t>(sum) : 0;
}

}  // namespace pitchboard::telemetry::session

namespace pitchboard::telemetry {

std::string rowTopic(const GroupInfo& group) {
  const RobotFacts& facts = factsOf(group);
  return (facts.slot > 0 || facts.live ? "/robots/" : "/") + session::plainName(group.name) +
         "/row";
}

}  // namespace pitchboard::telemetry
