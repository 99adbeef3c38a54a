// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

#include <base/byte_sizes.h>

namespace pitchboard::telemetry {
namespace {

// So that `made` never grows: texts point into it.
constexpr std::size_t madeBytes = 16 * kibibyte;
constexpr std::size_t longestText = ErrorTally::sampleBytes;

ReadNumber readInt(std::string_view token) {
  std::int32_t value = 0;
  const char* end = token.data() + token.size();
  const auto [stop, code] = std::from_chars(token.data(), end, value);
  if (code == std::errc{} && stop == end) return {static_cast<double>(value), {}};
  if (code == std::errc::result_out_of_range && stop == end) return {missing, TextError::TooLarge};
  // A whole number may be written as 258.0 where a team computes it as a float.
  ReadNumber number = readFloat(token);
  if (number.error) return number;
  if (number.value != std::floor(number.value)) return {missing, TextError::NotANumber};
  if (std::abs(number.value) > std::numeric_limits<std::int32_t>::max()) {
    return {missing, TextError::TooLarge};
  }
  return number;
}

/// A counter of 32 bits may be written without a sign.
ReadNumber readCounter(std::string_view token) {
  std::uint32_t value = 0;
  const char* end = token.data() + token.size();
  const auto [stop, code] = std::from_chars(token.data(), end, value);
  if (code == std::errc{} && stop == end) return {static_cast<double>(value), {}};
  return readInt(token);
}

ReadNumber readFlag(std::string_view token) {
  if (token.size() == 1 && (token[0] == '0' || token[0] == '1')) return {token[0] - '0' + 0.0, {}};
  const ReadNumber number = readInt(token);
  if (number.error || number.value == 0.0 || number.value == 1.0) return number;
  return {missing, TextError::BadFlag};
}

/// Returns the code with this label.
ReadNumber readLabel(const ProfileField& field, std::string_view token) {
  for (const auto& [code, label] : field.labels) {
    if (label == token) return {static_cast<double>(code), {}};
  }
  return {missing, {}};
}

void put(const ProfileField& field, std::size_t index, double value, DecodedText& out) {
  if (field.absent && value == *field.absent) {
    // As it was received; nothing is to be seen in it.
    out.values[index] = missing;
    return;
  }
  if (field.scale != 1.0 || field.offset != 0.0) {
    // 3 × 0.1 is shown as 0.3.
    value = value * field.scale + field.offset;
    if (std::abs(value) < 1e6) value = std::round(value * 1e9) / 1e9;
  }
  out.values[index] = value;
}

}  // namespace

void addError(TextError error, std::size_t index, DecodedText& out) {
  if (out.errors.empty()) out.badField = index;
  out.errors.add(error);
}

void clearFields(std::size_t count, DecodedText& out) {
  out.count = count;
  out.values.fill(missing);
  out.texts.fill({});
  out.made.clear();
  out.made.reserve(madeBytes);
}

ReadNumber readFloat(std::string_view token) {
  double value = 0.0;
  const char* end = token.data() + token.size();
  const auto [stop, code] = std::from_chars(token.data(), end, value);
  if (code == std::errc::invalid_argument || stop != end) return {missing, TextError::NotANumber};
  if (code == std::errc::result_out_of_range) {
    // Too small is as good as zero, too large is not a value of a robot.
    const bool tiny = token.find("e-") != token.npos || token.find("E-") != token.npos;
    return tiny ? ReadNumber{0.0, {}} : ReadNumber{missing, TextError::TooLarge};
  }
  if (!std::isfinite(value)) return {missing, TextError::NotFinite};
  if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max())) {
    return {missing, TextError::TooLarge};
  }
  return {value, {}};
}

ReadNumber readNumber(const ProfileField& field, std::string_view token) {
  if (field.meaning == FieldMeaning::Sequence) return readCounter(token);
  switch (field.type) {
    case FieldType::Int:
      return readInt(token);
    case FieldType::Float:
      return readFloat(token);
    case FieldType::Flag:
      return readFlag(token);
    case FieldType::Text:
      return readLabel(field, token);
  }
  return {missing, TextError::NotANumber};
}

void setText(const ProfileField& field, std::size_t index, std::string_view token,
             DecodedText& out) {
  out.texts[index] = token;
  const ReadNumber number = readNumber(field, token);
  out.values[index] = missing;
  if (number.error) return addError(*number.error, index, out);
  put(field, index, number.value, out);
}

void setNumber(const ProfileField& field, std::size_t index, double value, DecodedText& out) {
  out.texts[index] = numberText(value, out);
  out.values[index] = missing;
  if (!std::isfinite(value)) return addError(TextError::NotFinite, index, out);
  const bool counter = field.meaning == FieldMeaning::Sequence;
  const double most = counter ? 4294967295.0 : 2147483647.0;
  switch (field.type) {
    case FieldType::Text:
      return;
    case FieldType::Flag:
      if (value != 0.0 && value != 1.0) return addError(TextError::BadFlag, index, out);
      break;
    case FieldType::Int:
      if (value != std::floor(value)) return addError(TextError::NotANumber, index, out);
      if (std::abs(value) > most) return addError(TextError::TooLarge, index, out);
      break;
    case FieldType::Float:
      if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max())) {
        return addError(TextError::TooLarge, index, out);
      }
      break;
  }
  put(field, index, value, out);
}

std::string_view numberText(double value, DecodedText& out) {
  char text[40];
  // The shortest text of a float that was widened is that of the float.
  const auto narrow = static_cast<float>(std::clamp(value, -3e38, 3e38));
  const bool isFloat = static_cast<double>(narrow) == value;
  const auto end = isFloat ? std::to_chars(text, text + sizeof text, narrow).ptr
                           : std::to_chars(text, text + sizeof text, value).ptr;
  return keep({text, static_cast<std::size_t>(end - text)}, out);
}

std::string_view keep(std::string_view text, DecodedText& out) {
  text = text.substr(0, longestText);
  if (out.made.size() + text.size() > out.made.capacity()) return {};
  const std::size_t begin = out.made.size();
  out.made += text;
  return std::string_view(out.made).substr(begin, text.size());
}

bool isText(std::string_view text, bool utf8) {
  // One pass without a branch per byte.
  bool plain = true;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    plain &= (byte >= 0x20 && byte < 0x7f) || byte == '\t' || byte == '\r' || byte == '\n';
  }
  if (plain || !utf8) return plain;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequenceLength(text.substr(i));
    if (length == 0) return false;
    const auto byte = static_cast<unsigned char>(text[i]);
    if (length == 1 && ((byte < 0x20 && !isSpace(text[i])) || byte == 0x7f)) return false;
    i += length;
  }
  return true;
}

}  // namespace pitchboard::telemetry
