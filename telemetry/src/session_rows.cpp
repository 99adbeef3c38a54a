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

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

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
    if (isLetter(c) || isDigit(c)) out += c;
    else if (!out.empty() && out.back() != '_') out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() ? "group" : out;
}

std::string comment(const ColumnInfo& column) {
  std::string out = column.name;
  if (!column.unit.empty()) out += " [" + column.unit + "]";
  for (const auto& [code, word] : column.labels) {
    out += (code == column.labels.begin()->first ? ": " : ", ") + std::to_string(code) + " = " + word;
  }
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return out;
}

const char* typeName(ColumnType type) {
  switch (type) {
    case ColumnType::Int32: return "int32";
    case ColumnType::Float32: return "float32";
    case ColumnType::Float64: return "float64";
  }
  return "float64";
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

std::string rowTopic(const GroupInfo& group) {
  return (group.attributes.contains("robot") || group.attributes.contains("live") ? "/robots/" : "/") + plainName(group.name) + "/row";
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
  std::string out = "float64 source_time  # seconds of the source\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    out += std::string(typeName(group.columns[i].type)) + " " + names[i] + "  # " +
           comment(group.columns[i]) + "\n";
  }
  return out;
}

RowLayout::RowLayout(const GroupInfo& group) {
  for (const ColumnInfo& column : group.columns) {
    ++(column.type == ColumnType::Float64 ? values : words);
  }
  // CDR aligns 8-byte numbers to 8, counted from behind the 4 bytes of the head.
  valuesAt = wordsAt + words * 4 + (values > 0 && words % 2 == 1 ? 4 : 0);
  size = valuesAt + values * 8;
}

void RowLayout::write(char* to, const RowView& row) const {
  std::memcpy(to, littleEndianCdr.data(), littleEndianCdr.size());
  std::memcpy(to + timeAt, &row.time, 8);
  const std::size_t wordCount = std::min(words, row.words.size());
  const std::size_t valueCount = std::min(values, row.values.size());
  if (wordCount > 0) std::memcpy(to + wordsAt, row.words.data(), wordCount * 4);
  std::memset(to + wordsAt + wordCount * 4, 0, valuesAt - wordsAt - wordCount * 4);
  if (valueCount > 0) std::memcpy(to + valuesAt, row.values.data(), valueCount * 8);
  std::memset(to + valuesAt + valueCount * 8, 0, (values - valueCount) * 8);
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
  if (values > 0) std::memcpy(valuesOut.data(), bytes.data() + valuesAt, values * 8);
  return std::isfinite(time);
}

std::uint64_t nanoseconds(WallTime start, double seconds) {
  const std::int64_t base = start.time_since_epoch().count();
  // Beyond 100 years nobody has recorded anything; this keeps the sum inside its type.
  constexpr double most = 3.2e9;
  const double inside = std::isfinite(seconds) ? std::clamp(seconds, -most, most) : 0.0;
  std::int64_t sum = 0;
  if (__builtin_add_overflow(base, std::llround(inside * 1e9), &sum)) return 0;
  return sum > 0 ? static_cast<std::uint64_t>(sum) : 0;
}

}  // namespace pitchboard::telemetry::session
