// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/pb2/pb2.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <utility>

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t shownBytes = 24;

bool isNameByte(char c, bool first) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' ||
         (!first && c >= '0' && c <= '9');
}

std::string inQuotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text.substr(0, shownBytes)) out += (c < ' ' || c > '~') ? '?' : c;
  return out + (text.size() > shownBytes ? "...\"" : "\"");
}

/// Words between blanks, and where they stand.
class Words {
 public:
  explicit Words(std::string_view text) : m_text(text) {}

  /// Empty at the end.
  std::string_view next() {
    m_at = std::min(m_text.find_first_not_of(' ', m_end), m_text.size());
    m_end = std::min(m_text.find(' ', m_at), m_text.size());
    return m_text.substr(m_at, m_end - m_at);
  }
  tl::unexpected<Error> refuse(const std::string& what) const {
    return failure(ErrorCode::ParseError, what, "PB2, byte " + std::to_string(m_at));
  }

 private:
  std::string_view m_text;
  std::size_t m_at = 0, m_end = 0;
};

template <class Number>
bool readWhole(std::string_view text, Number& number) {
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && rest == end;
}

/// False: not a number, or one that is too large.
bool readNumber(std::string_view text, double& number, bool& whole) {
  whole = text.find_first_not_of("-0123456789") == std::string_view::npos;
  if (whole) {
    std::int64_t value = 0;
    if (!readWhole(text, value) || value > Pb2Limits::whole || value < -Pb2Limits::whole) {
      return false;
    }
    number = static_cast<double>(value);
    return true;
  }
  const char* const end = text.data() + text.size();
  float single = 0.0F;
  const auto [rest, error] = std::from_chars(text.data(), end, single);
  if (rest != end || error == std::errc::invalid_argument) return false;
  if (error == std::errc()) {
    number = static_cast<double>(single);
    return true;
  }
  // Beyond a float: nearer to 0 than the smallest one is 0.
  double wide = 0.0;
  const auto again = std::from_chars(text.data(), end, wide);
  if (again.ec != std::errc() || std::abs(wide) > 1.0) return false;
  number = std::copysign(0.0, wide);
  return true;
}

void readStatus(std::string_view name, double number, bool whole, Pb2Status& status) {
  if (!whole || number < 0.0) return;
  const auto value = static_cast<std::int64_t>(number);
  if (name == "@REFRESH") status.refresh_ms = value;
  if (name == "@WAITING") status.waiting = value;
  if (name == "@BLACKBOARD") status.blackboard = value != 0;
}

}  // namespace

bool isPb2Name(std::string_view name) {
  return !name.empty() && name.size() <= Pb2Limits::nameBytes && isNameByte(name[0], true) &&
         std::ranges::all_of(name, [](char c) { return isNameByte(c, false); });
}

Result<Pb2Message> parsePb2(std::string_view datagram) {
  if (datagram.ends_with('\n')) datagram.remove_suffix(1);
  Words tokens(datagram);
  if (datagram.size() > Pb2Limits::bytes) {
    return tokens.refuse("the datagram has " + std::to_string(datagram.size()) +
                         " bytes; at most 1400 are read");
  }
  if (tokens.next() != "PB2") return tokens.refuse("the datagram must begin with PB2");
  Pb2Message message;
  std::string_view token = tokens.next();
  if (!readWhole(token, message.robot) || message.robot < 1 || message.robot > Pb2Limits::robots) {
    return tokens.refuse("the robot's number must be 1 to 64, not " + inQuotes(token));
  }
  token = tokens.next();
  if (!readWhole(token, message.sequence)) {
    return tokens.refuse("the sequence number must be 0 to 4294967295, not " + inQuotes(token));
  }
  token = tokens.next();
  if (!readWhole(token, message.milliseconds)) {
    return tokens.refuse("the time must be a whole number of milliseconds, not " + inQuotes(token));
  }
  constexpr std::size_t shortestField = 4;  // " A=1"
  message.values.reserve(datagram.size() / shortestField);
  for (token = tokens.next(); token != "OUT"; token = tokens.next()) {
    if (token.empty()) return tokens.refuse("OUT is missing at the end");
    const std::size_t equals = token.find('=');
    if (equals == std::string_view::npos) {
      return tokens.refuse("expected NAME=VALUE or OUT, not " + inQuotes(token));
    }
    const std::string_view name = token.substr(0, equals), text = token.substr(equals + 1);
    const bool isStatus = name.starts_with('@');
    if (!isPb2Name(isStatus ? name.substr(1) : name)) {
      return tokens.refuse(inQuotes(name) +
                           " is not a name: use at most 64 letters, digits and _, no digit first");
    }
    Pb2Value value{.name = name};
    if (!readNumber(text, value.value, value.whole)) {
      return tokens.refuse("the value of " + inQuotes(name) +
                           " is not a number that fits: " + inQuotes(text));
    }
    if (isStatus) {
      readStatus(name, value.value, value.whole, message.status);
    } else {
      message.values.push_back(value);
    }
  }
  if (!tokens.next().empty()) return tokens.refuse("there is text after OUT");
  return message;
}

Pb2Number::Pb2Number(std::int64_t value)
    : m_size(static_cast<std::size_t>(std::to_chars(m_text, m_text + sizeof m_text, value).ptr -
                                      m_text)) {}

Pb2Number::Pb2Number(float value) {
  if (std::isnan(value)) value = std::abs(value);  // the sign of nan says nothing
  char* end = std::to_chars(m_text, m_text + sizeof m_text, value).ptr;
  const std::string_view plain(m_text, static_cast<std::size_t>(end - m_text));
  if (plain.find_first_not_of("-0123456789") == std::string_view::npos) {
    *end++ = '.';
    *end++ = '0';
  }
  m_size = static_cast<std::size_t>(end - m_text);
}

Pb2Writer::Pb2Writer(int robot, std::uint32_t sequence, std::uint64_t milliseconds) {
  m_text.reserve(Pb2Limits::bytes);
  m_text += "PB2 " + std::to_string(robot) + ' ' + std::to_string(sequence) + ' ' +
            std::to_string(milliseconds);
}

void Pb2Writer::add(std::string_view name, std::string_view number) {
  assert(fits(fieldBytes(name, number)));
  m_text += ' ';
  m_text += name;
  m_text += '=';
  m_text += number;
}

std::string Pb2Writer::finish() && {
  m_text += " OUT";
  return std::move(m_text);
}

}  // namespace pitchboard::telemetry
