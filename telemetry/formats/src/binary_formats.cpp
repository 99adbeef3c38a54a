// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers at fixed places, and the three formats whose places depend on what stands in them
// (docs/reference/team-formats.md).
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>

#include <base/angles.h>

#include <telemetry/formats/profile_names.h>
#include "message_readers.h"

namespace pitchboard::telemetry {
namespace {

/// `count` bytes, little-endian; nothing beyond the end.
std::optional<std::uint64_t> bitsAt(std::string_view bytes, std::size_t at, std::size_t count) {
  if (count == 0 || bytes.size() < count || at > bytes.size() - count) return std::nullopt;
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < count; ++i) {
    bits |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  }
  return bits;
}

std::optional<double> numberAt(std::string_view bytes, std::size_t at, WireType type) {
  const auto bits = bitsAt(bytes, at, static_cast<std::size_t>(profile_names::bytesOf(type)));
  if (!bits) return std::nullopt;
  switch (type) {
    case WireType::I8:
      return static_cast<std::int8_t>(*bits);
    case WireType::I16:
      return static_cast<std::int16_t>(*bits);
    case WireType::I32:
      return static_cast<std::int32_t>(*bits);
    case WireType::I64:
      return static_cast<double>(static_cast<std::int64_t>(*bits));
    case WireType::F32:
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(*bits)));
    case WireType::F64:
      return std::bit_cast<double>(*bits);
    default:
      return static_cast<double>(*bits);
  }
}

/// A text of fixed length: up to the first NUL.
std::string_view textAt(std::string_view bytes, std::size_t at, std::size_t length) {
  if (at >= bytes.size()) return {};
  const std::string_view all = bytes.substr(at, length);
  const std::string_view text = all.substr(0, all.find('\0'));
  return isText(text, true) ? text : std::string_view();
}

bool fits(const WireCondition& condition, std::string_view bytes) {
  const auto value = numberAt(bytes, static_cast<std::size_t>(condition.at), condition.as);
  return value &&
         std::any_of(condition.values.begin(), condition.values.end(),
                     [&](std::int64_t wanted) { return *value == static_cast<double>(wanted); });
}

}  // namespace

bool readBinary(const Profile& profile, std::string_view bytes, DecodedText& out) {
  const auto holds = [bytes](const WireCondition& condition) { return fits(condition, bytes); };
  if (!bytes.starts_with(profile.begins) ||
      !std::all_of(profile.when.begin(), profile.when.end(), holds)) {
    return false;
  }
  for (std::size_t i = 0; i < profile.fields.size(); ++i) {
    const ProfileField& field = profile.fields[i];
    const auto at = static_cast<std::size_t>(field.at);
    const auto length = static_cast<std::size_t>(
        field.as == WireType::Text ? field.length : profile_names::bytesOf(field.as));
    if (bytes.size() < at + length && !field.optional) out.errors.add(TextError::Truncated);
    if (field.as == WireType::Text) {
      if (at < bytes.size()) setText(field, i, textAt(bytes, at, length), out);
      continue;
    }
    auto value = numberAt(bytes, at, field.as);
    if (!value) continue;
    if (field.mask != 0 && *value >= 0.0 && *value < 1.8e19) {
      value = static_cast<double>(static_cast<std::uint64_t>(*value) & field.mask);
    }
    // A float that is not a number says that there is nothing.
    if (!std::isnan(*value)) setNumber(field, i, *value, out);
  }
  return true;
}

bool readMitecom(std::string_view bytes, FieldSink& sink) {
  constexpr std::size_t header = 16, entry = 8;
  constexpr std::uint64_t version = 1;
  if (!bytes.starts_with("CTXM") || bitsAt(bytes, 4, 2) != version) return false;
  const auto count = bitsAt(bytes, 6, 2);
  if (!count || bytes.size() < header + entry * *count) return false;
  sink.number("team", numberAt(bytes, 12, WireType::U16).value_or(0.0));
  sink.number("robot", numberAt(bytes, 14, WireType::U16).value_or(0.0));
  for (std::size_t i = 0; i < *count; ++i) {
    const std::size_t at = header + entry * i;
    char key[16] = "0x";
    const auto end =
        std::to_chars(key + 2, key + sizeof key, bitsAt(bytes, at, 4).value_or(0), 16).ptr;
    sink.number({key, static_cast<std::size_t>(end - key)},
                numberAt(bytes, at + 4, WireType::I32).value_or(0.0));
  }
  return true;
}

bool readHulks(std::string_view bytes, FieldSink& sink) {
  constexpr std::size_t plain = 25, withBall = 45;
  const auto ball = bitsAt(bytes, plain - 1, 1);
  if (bitsAt(bytes, 0, 4) != 0U || !ball || *ball > 1) return false;
  if (bytes.size() != (*ball == 1 ? withBall : plain)) return false;
  const auto real = [bytes](std::size_t at) {
    return numberAt(bytes, at, WireType::F32).value_or(0.0);
  };
  sink.number("player", numberAt(bytes, 4, WireType::U32).value_or(0.0) + 1.0);
  sink.number("theta", std::atan2(real(12), real(8)));
  sink.number("x", real(16));
  sink.number("y", real(20));
  if (*ball == 0) return true;
  sink.number("ball.x", real(25));
  sink.number("ball.y", real(29));
  sink.number("ball.age", numberAt(bytes, 33, WireType::U64).value_or(0.0) +
                              numberAt(bytes, 41, WireType::U32).value_or(0.0) * 1e-9);
  return true;
}

bool readCitBrains(std::string_view bytes, FieldSink& sink) {
  constexpr std::size_t objects = 7, first = 3, size = 4, shortest = 36, longest = 110;
  if (bytes.size() < shortest || bytes.size() > longest) return false;
  const auto byte = [bytes](std::size_t at) -> unsigned {
    return static_cast<unsigned char>(bytes[at]);
  };
  sink.number("id", byte(0) & 0x7fU);
  sink.number("colour", byte(0) >> 7U);
  sink.number("own-confidence", byte(1));
  sink.number("ball-confidence", byte(2));
  bool self = false, ball = false, target = false;
  for (std::size_t i = 0; i < objects; ++i) {
    const std::size_t at = first + size * i;
    const unsigned head = byte(at);
    if ((head & 0x80U) == 0) continue;
    const unsigned packed = (head & 0x0fU) << 16U | byte(at + 1) << 8U | byte(at + 2);
    // Two numbers of ten bits with a sign.
    const auto signedTen = [](unsigned bits) {
      return static_cast<double>(bits & 0x200U ? static_cast<int>(bits) - 0x400
                                               : static_cast<int>(bits));
    };
    const double x = signedTen(packed >> 10U) * 10.0, y = signedTen(packed & 0x3ffU) * 10.0;
    const double theta = byte(at + 3) * 2.0 - 180.0;
    const auto put = [&](bool& seen, const char* nameX, const char* nameY, const char* nameTheta) {
      if (std::exchange(seen, true)) return;  // the first one of a kind
      sink.number(nameX, x);
      sink.number(nameY, y);
      sink.number(nameTheta, theta);
    };
    switch (head >> 5U & 3U) {
      case 3:
        put(ball, "ball.x", "ball.y", "ball.theta");
        break;
      case 2:
        put(self, "self.x", "self.y", "self.theta");
        break;
      case 1:
        put(target, "target.x", "target.y", "target.theta");
        break;
      default:
        break;
    }
  }
  sink.number("status", byte(31));
  sink.number("fps", byte(32));
  sink.number("voltage", byte(33));
  sink.number("temperature", byte(34));
  sink.addText("role", textAt(bytes, 36, 42));
  sink.addText("text", textAt(bytes, 78, 32));
  return true;
}

}  // namespace pitchboard::telemetry
