// SPDX-License-Identifier: GPL-3.0-or-later
#include "cdr_plan.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "cdr_bytes.h"

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t maxPlannedMessage = 256U << 10U;
/// Bytes between two pieces that are compared, too: they are padding.
constexpr std::uint32_t maxPadding = 3;

template <class T>
T numberAt(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

template <class T>
void copyNumbers(const char* from, std::size_t count, double* to) {
  for (std::size_t i = 0; i < count; ++i) {
    to[i] = static_cast<double>(numberAt<T>(from + i * sizeof(T)));
  }
}

void copyNumbers(RosKind kind, const char* from, std::size_t count, double* to) {
  switch (kind) {
    case RosKind::Bool:
    case RosKind::UInt8:
      return copyNumbers<std::uint8_t>(from, count, to);
    case RosKind::Int8:
      return copyNumbers<std::int8_t>(from, count, to);
    case RosKind::Int16:
      return copyNumbers<std::int16_t>(from, count, to);
    case RosKind::UInt16:
      return copyNumbers<std::uint16_t>(from, count, to);
    case RosKind::UInt32:
      return copyNumbers<std::uint32_t>(from, count, to);
    case RosKind::Int64:
      return copyNumbers<std::int64_t>(from, count, to);
    case RosKind::UInt64:
      return copyNumbers<std::uint64_t>(from, count, to);
    case RosKind::Float32:
      return copyNumbers<float>(from, count, to);
    case RosKind::Float64:
      std::memcpy(to, from, count * sizeof(double));
      return;
    default:
      return copyNumbers<std::int32_t>(from, count, to);
  }
}

}  // namespace

bool isPlannable(const RosTypes& types) {
  return std::ranges::none_of(types.structs, [](const RosStruct& type) {
    return type.isUnion || type.extensibility == Extensibility::Mutable ||
           std::ranges::any_of(type.fields, [](const RosField& field) {
             return field.isOptional || field.kind == RosKind::WideText ||
                    field.kind == RosKind::LongDouble;
           });
  });
}

bool CdrPlan::decode(std::string_view message, DecodedMessage& to) const {
  if (message.size() != m_size) return false;
  const char* const begin = message.data();
  const char* expected = m_expected.data();
  for (const Piece& piece : m_pieces) {
    if (std::memcmp(begin + piece.place, expected, piece.length) != 0) return false;
    expected += piece.length;
  }
  to.values.resize(m_values);
  to.texts.resize(m_texts);
  to.stamp.reset();
  to.leftOut = 0;
  std::size_t text = 0;
  for (const Run& run : m_runs) {
    const char* const from = begin + run.place;
    double* const value = to.values.data() + run.value;
    if (run.kind == RosKind::Text) {
      to.texts[text++] = cutText(rosText({from, run.count}, m_isRos1));
      *value = std::numeric_limits<double>::quiet_NaN();
    } else if (run.kind == RosKind::Time || run.kind == RosKind::TimeSpan) {
      const RosTime time = rosTime(run.kind, numberAt<std::int32_t>(from),
                                   numberAt<std::uint32_t>(from + 4), m_isRos1);
      if (run.isStamp && !to.stamp) to.stamp = time.nanoseconds();
      *value = time.inSeconds();
    } else if (run.kind == RosKind::Bool &&
               std::any_of(from, from + run.count, [](char c) { return (c & ~1) != 0; })) {
      return false;
    } else {
      copyNumbers(run.kind, from, run.count, value);
    }
  }
  if (to.shape != m_shape) to.shape = m_shape;
  return true;
}

void PlanOut::expect(std::size_t place, std::size_t length) {
  const auto begin = static_cast<std::uint32_t>(place), count = static_cast<std::uint32_t>(length);
  auto& pieces = m_plan->m_pieces;
  std::string& bytes = m_plan->m_expected;
  if (!pieces.empty() && !std::exchange(m_hasValues, false)) {
    CdrPlan::Piece& last = pieces.back();
    const std::uint32_t end = last.place + last.length;
    if (begin >= end && begin - end <= maxPadding) {
      bytes += m_message.substr(end, begin - end + count);
      last.length = begin - last.place + count;
      return;
    }
  }
  pieces.push_back({begin, count});
  bytes += m_message.substr(begin, count);
}

void PlanOut::add(CdrPlan::Run run) {
  m_hasValues = true;
  run.value = static_cast<std::uint32_t>(m_plan->m_values++);
  if (m_plan->m_values > maxRecordedFields) m_isWhole = false;
  if (m_isWhole) m_plan->m_runs.push_back(run);
}

void PlanOut::number(double, RecordedKind, const std::string&, const FieldLabels&) {
  const bool isStamp = std::exchange(m_isStamp, false);
  m_hasValues = true;
  if (m_kind != RosKind::Time && m_kind != RosKind::TimeSpan && !m_plan->m_runs.empty()) {
    CdrPlan::Run& last = m_plan->m_runs.back();
    if (last.kind == m_kind && last.value + last.count == m_plan->m_values &&
        last.place + last.count * sizeOfRos(m_kind) == m_place &&
        m_plan->m_values < maxRecordedFields) {
      ++last.count;
      ++m_plan->m_values;
      return;
    }
  }
  add({m_kind, isStamp, m_place, 1, 0});
}

void PlanOut::text(std::string_view) {
  ++m_plan->m_texts;
  add({RosKind::Text, false, m_place, m_length, 0});
}

std::unique_ptr<CdrPlan> PlanOut::finish(std::shared_ptr<const RecordedShape> shape, bool isRos1) {
  if (!m_isWhole || m_message.size() > maxPlannedMessage ||
      m_plan->m_values != shape->fields.size()) {
    return {};
  }
  m_plan->m_size = m_message.size();
  m_plan->m_isRos1 = isRos1;
  m_plan->m_shape = std::move(shape);
  return std::move(m_plan);
}

}  // namespace pitchboard::telemetry
