// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// PB2, the text in which a robot sends any of its variables by UDP (docs/agent.md):
//
//   PB2 ROBOT SEQUENCE MILLISECONDS NAME=VALUE ... OUT
//
// One datagram has at most 1400 bytes. Plain values and pure functions, without packages, so that
// the agent on the robot and the studio share them. Any thread.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>

namespace pitchboard::telemetry {

struct Pb2Limits {
  static constexpr std::size_t bytes = 1400;        ///< of a datagram
  static constexpr std::size_t nameBytes = 64;      ///< of a variable's name
  static constexpr int robots = 64;                 ///< the highest number of a robot
  static constexpr std::int64_t whole = 1LL << 53;  ///< the farthest whole number from 0
};

/// Robot N sends to this port + N, unless told otherwise.
inline constexpr int pb2PortBase = 1340;

/// Letters, digits and _, not a digit first, at most Pb2Limits::nameBytes.
bool isPb2Name(std::string_view name);

struct Pb2Value {
  std::string_view name;  ///< a part of the datagram
  /// Numbers with a point, an exponent, nan and inf are single-precision, as on the blackboard:
  /// this is then exactly that float.
  double value = 0.0;
  bool whole = false;  ///< written as a whole number: an int variable
};

/// What the sender says of itself about once a second; empty in most messages. Its fields begin
/// with @, which no variable does.
struct Pb2Status {
  std::optional<std::int64_t> refresh_ms;  ///< @REFRESH: in this time every variable is sent once
  std::optional<std::int64_t> waiting;     ///< @WAITING: changed variables that wait for bandwidth
  std::optional<bool> blackboard;          ///< @BLACKBOARD: false while there is none to read
};

struct Pb2Message {
  int robot = 0;
  std::uint32_t sequence = 0;      ///< one more in each datagram of a sender; wraps
  std::uint64_t milliseconds = 0;  ///< the robot's monotonic clock when the values were read
  std::vector<Pb2Value> values;    ///< of a name that occurs twice the last one counts
  Pb2Status status;
};

/// The message's views are parts of `datagram`. Allocates no more than a datagram of the largest
/// size can fill. Error ParseError with the byte, counted from 0, and what it should be. Unknown
/// fields that begin with @ are left out.
Result<Pb2Message> parsePb2(std::string_view datagram);

/// A value as it is sent: the shortest text that reads back to the same number.
class Pb2Number {
 public:
  explicit Pb2Number(std::int64_t value);
  explicit Pb2Number(float value);  ///< always with a point, an exponent, nan or inf
  std::string_view text() const { return {m_text, m_size}; }

 private:
  char m_text[24];
  std::size_t m_size = 0;
};

/// Makes one datagram.
class Pb2Writer {
 public:
  Pb2Writer(int robot, std::uint32_t sequence, std::uint64_t milliseconds);

  /// Bytes that one more field takes.
  static std::size_t fieldBytes(std::string_view name, std::string_view number) {
    return name.size() + number.size() + 2;
  }
  /// Of the datagram if it ended here.
  std::size_t bytes() const { return m_text.size() + 4; }
  bool fits(std::size_t fieldBytes) const { return bytes() + fieldBytes <= Pb2Limits::bytes; }
  /// The field must fit, and its name be one of a variable or a status.
  void add(std::string_view name, std::string_view number);
  /// The whole datagram.
  std::string finish() &&;

 private:
  std::string m_text;
};

}  // namespace pitchboard::telemetry
