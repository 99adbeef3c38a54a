// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/formats/text_errors.h>

#include <algorithm>
#include <cstring>

namespace pitchboard::telemetry {
namespace {

struct Text {
  std::string_view name;
  std::string_view text;
};

constexpr std::array<Text, textErrorCount> texts{{
    {"empty", "empty message"},
    {"too-long", "longer than 64 KiB"},
    {"truncated", "cut off before its end"},
    {"binary", "not text"},
    {"missing-fields", "too few fields"},
    {"missing-end", "no end word"},
    {"bad-robot", "no usable robot number"},
    {"bad-format", "not in the profile's format"},
    {"not-a-number", "text instead of a number"},
    {"not-finite", "nan or inf"},
    {"too-large", "number too large"},
    {"bad-flag", "flag neither 0 nor 1"},
    {"too-many-fields", "more extra fields than are kept"},
    {"trailing-text", "text after the end word"},
    {"duplicate", "repeated message"},
}};

}  // namespace

std::string_view errorName(TextError error) {
  return texts[static_cast<std::size_t>(error)].name;
}
std::string_view errorText(TextError error) {
  return texts[static_cast<std::size_t>(error)].text;
}

void ErrorTally::add(TextErrors errors, std::string_view datagram) {
  if (errors.empty()) return;
  ++m_messages;
  for (std::size_t i = 0; i < textErrorCount; ++i) {
    if (!errors.has(static_cast<TextError>(i))) continue;
    Kind& kind = m_kinds[i];
    ++kind.count;
    const std::size_t length = std::min(datagram.size(), sampleBytes);
    if (length > 0) std::memcpy(kind.text.data(), datagram.data(), length);
    kind.length = static_cast<std::uint16_t>(length);
    kind.cut = datagram.size() > sampleBytes;
  }
}

std::string ErrorTally::sample(TextError error) const {
  const Kind& kind = m_kinds[index(error)];
  std::string out = printable({kind.text.data(), kind.length});
  return kind.cut ? out + "..." : out;
}

std::size_t sequenceLength(std::string_view text) {
  if (text.empty()) return 0;
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return 1;
  const std::size_t length = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return 0;
  }
  // Not the shortest form, a half of a pair, beyond the last character.
  if (byte(0) == 0xe0 && byte(1) < 0xa0) return 0;
  if (byte(0) == 0xed && byte(1) > 0x9f) return 0;
  if (byte(0) == 0xf0 && byte(1) < 0x90) return 0;
  if (byte(0) == 0xf4 && byte(1) > 0x8f) return 0;
  return length;
}

std::string printable(std::string_view bytes, std::size_t limit) {
  std::string out;
  addPrintable(out, bytes, limit);
  return out;
}

void addPrintable(std::string& out, std::string_view bytes, std::size_t limit) {
  static constexpr char digits[] = "0123456789abcdef";
  std::size_t i = 0;
  while (i < bytes.size() && i < limit) {
    const auto isPlain = [](char c) { return c >= 0x20 && c < 0x7f; };
    const std::string_view rest = bytes.substr(i, limit - i);
    const auto plain =
        static_cast<std::size_t>(std::ranges::find_if_not(rest, isPlain) - rest.begin());
    out += rest.substr(0, plain);
    i += plain;
    if (plain == rest.size()) continue;
    const auto byte = static_cast<unsigned char>(bytes[i]);
    const std::size_t length = sequenceLength(bytes.substr(i));
    // U+0080 to U+009F are control characters, too.
    const bool control = length == 1 ? byte < 0x20 || byte == 0x7f
                                     : length == 2 && byte == 0xc2 &&
                                           static_cast<unsigned char>(bytes[i + 1]) < 0xa0;
    if (length > 0 && !control) {
      out += bytes.substr(i, length);
      i += length;
      continue;
    }
    out += "\\x";
    out += digits[byte >> 4U];
    out += digits[byte & 15U];
    ++i;
  }
  if (i < bytes.size()) out += "...";
}

}  // namespace pitchboard::telemetry
