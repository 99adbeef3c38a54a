// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/wire/text_decoder.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>

namespace pitchboard::telemetry {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

constexpr bool isSpace(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// Splits the text at white space while it looks at every byte once.
class Words {
 public:
  explicit Words(std::string_view text) : m_at(text.data()), m_end(text.data() + text.size()) {}

  /// The next word; empty at the end of the text.
  std::string_view next() {
    while (m_at != m_end && isSpace(*m_at)) ++m_at;
    const char* begin = m_at;
    while (m_at != m_end && !isSpace(*m_at)) ++m_at;
    return {begin, static_cast<std::size_t>(m_at - begin)};
  }

 private:
  const char* m_at;
  const char* m_end;
};

bool isText(std::string_view text) {
  // One pass without a branch per byte.
  bool good = true;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    good &= (byte >= 0x20 && byte < 0x7f) || byte == '\t' || byte == '\r' || byte == '\n';
  }
  return good;
}

struct Number {
  double value = missing;
  std::optional<TextError> error;
};

Number readFloat(std::string_view word) {
  double value = 0.0;
  const char* end = word.data() + word.size();
  const auto [stop, code] = std::from_chars(word.data(), end, value);
  if (code == std::errc::invalid_argument || stop != end) return {missing, TextError::NotANumber};
  if (code == std::errc::result_out_of_range) {
    // Too small is as good as zero, too large is not a value of a robot.
    const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
    return tiny ? Number{0.0, {}} : Number{missing, TextError::TooLarge};
  }
  if (!std::isfinite(value)) return {missing, TextError::NotFinite};
  if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max())) {
    return {missing, TextError::TooLarge};
  }
  return {value, {}};
}

Number readInt(std::string_view word) {
  std::int32_t value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, code] = std::from_chars(word.data(), end, value);
  if (code == std::errc{} && stop == end) return {static_cast<double>(value), {}};
  if (code == std::errc::result_out_of_range && stop == end) return {missing, TextError::TooLarge};
  // A whole number may be written as 258.0 where a team computes it as a float.
  Number number = readFloat(word);
  if (number.error) return number;
  if (number.value != std::floor(number.value)) return {missing, TextError::NotANumber};
  if (std::abs(number.value) > std::numeric_limits<std::int32_t>::max()) {
    return {missing, TextError::TooLarge};
  }
  return number;
}

Number readFlag(std::string_view word) {
  if (word.size() == 1 && (word[0] == '0' || word[0] == '1')) return {word[0] - '0' + 0.0, {}};
  const Number number = readInt(word);
  if (number.error || number.value == 0.0 || number.value == 1.0) return number;
  return {missing, TextError::BadFlag};
}

/// A counter of 32 bits may be written without a sign.
Number readCounter(std::string_view word) {
  std::uint32_t value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, code] = std::from_chars(word.data(), end, value);
  if (code == std::errc{} && stop == end) return {static_cast<double>(value), {}};
  return readInt(word);
}

Number read(const ProfileField& field, std::string_view word) {
  if (field.meaning == FieldMeaning::Sequence) return readCounter(word);
  switch (field.type) {
    case FieldType::Int:
      return readInt(word);
    case FieldType::Float:
      return readFloat(word);
    case FieldType::Flag:
      return readFlag(word);
  }
  return {};
}

}  // namespace

TextDecoder::TextDecoder(Profile profile) : m_profile(std::move(profile)) {
  m_places.fill(DecodedText::maxValues);
  for (std::size_t i = 0; i < m_profile.fields.size(); ++i) {
    m_places[static_cast<std::size_t>(m_profile.fields[i].meaning)] = i;
  }
  m_places[static_cast<std::size_t>(FieldMeaning::None)] = DecodedText::maxValues;
}

void TextDecoder::decode(std::string_view datagram, DecodedText& out) const {
  out.robot = 0;
  out.errors = {};
  out.badField = 0;
  out.count = 0;
  if (datagram.size() > maxBytes) return out.errors.add(TextError::TooLong);
  while (!datagram.empty() && (datagram.back() == '\0' || isSpace(datagram.back()))) {
    datagram.remove_suffix(1);
  }
  if (!isText(datagram)) return out.errors.add(TextError::Binary);

  Words words(datagram);
  std::string_view word = words.next();
  if (word.empty()) return out.errors.add(TextError::Empty);

  const std::string_view end = m_profile.end;
  const std::size_t fields = m_profile.fields.size();
  std::optional<std::size_t> badField;
  for (; !word.empty() && word != end; word = words.next()) {
    const std::size_t i = out.count;
    if (i == DecodedText::maxValues) {
      out.errors.add(TextError::TooManyFields);
      while (!word.empty() && word != end) word = words.next();
      break;
    }
    // An extra field may be anything until the team gives it a type: text is kept as a word.
    const Number number =
        i < fields ? read(m_profile.fields[i], word) : Number{readFloat(word).value, {}};
    out.values[i] = number.value;
    out.words[i] = word;
    ++out.count;
    if (number.error) {
      out.errors.add(*number.error);
      if (!badField) badField = i;
    }
  }
  out.badField = badField.value_or(0);

  const auto robot = value(out, FieldMeaning::Robot);
  if (robot && *robot >= 1.0 && *robot <= maxRobot) {
    out.robot = static_cast<int>(*robot);
  } else if (m_places[static_cast<std::size_t>(FieldMeaning::Robot)] < out.count) {
    out.errors.add(TextError::BadRobot);
  }
  if (out.count < fields) out.errors.add(TextError::MissingFields);
  if (word.empty()) {
    out.errors.add(TextError::MissingEnd);
  } else if (!words.next().empty()) {
    out.errors.add(TextError::TrailingText);
  }
}

std::string TextDecoder::name(std::size_t index) const {
  if (index < m_profile.fields.size()) return m_profile.fields[index].name;
  return "OTHER_" + std::to_string(index - m_profile.fields.size() + 1);
}

std::optional<double> TextDecoder::value(const DecodedText& decoded, FieldMeaning meaning) const {
  const std::size_t place = m_places[static_cast<std::size_t>(meaning)];
  if (!decoded.has(place)) return std::nullopt;
  return decoded.values[place];
}

}  // namespace pitchboard::telemetry
