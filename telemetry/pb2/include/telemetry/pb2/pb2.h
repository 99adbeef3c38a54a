// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// PB2, the text in which a robot sends any of its variables by UDP (docs/agent.md):
//
//   PB2 ROBOT SEQUENCE MILLISECONDS NAME=VALUE ... OUT
//
// A datagram has at most 1400 bytes. These are plain values and pure functions that need no
// library, because the agent on the robot uses them, too. Any thread.

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
  static constexpr std::int64_t whole = 1LL << 53;  ///< largest magnitude of a whole number
};

/// Robot N sends to this port + N, by default.
inline constexpr int pb2PortBase = 1340;

/// Returns whether a name has only letters, digits and _, does not begin with a digit, and is at
/// most Pb2Limits::nameBytes long.
bool isPb2Name(std::string_view name);

struct Pb2Value {
  std::string_view name;  ///< points into the datagram
  /// A number with a point or an exponent, nan and inf are single-precision, as on the blackboard;
  /// then this is exactly that float.
  double value = 0.0;
  bool whole = false;  ///< it was written as a whole number, so the variable is an int
};

/// What the sender reports about itself, about once a second; empty in most messages. The names of
/// these fields begin with @, which no variable's name does.
struct Pb2Status {
  std::optional<std::int64_t> refresh_ms;  ///< @REFRESH: time in which every variable is sent once
  std::optional<std::int64_t> waiting;     ///< @WAITING: changed variables that wait for bandwidth
  std::optional<bool> blackboard;          ///< @BLACKBOARD: false while there is no blackboard
};

struct Pb2Message {
  int robot = 0;
  std::uint32_t sequence = 0;      ///< counts the datagrams of a sender; wraps
  std::uint64_t milliseconds = 0;  ///< the robot's monotonic clock when the values were read
  std::vector<Pb2Value> values;    ///< if a name occurs twice, the last one counts
  Pb2Status status;
};

/// Reads a datagram. The names in the result point into `datagram`, which has to outlive them.
/// Unknown fields that begin with @ are ignored. Fails with ParseError, which names the byte
/// (counted from 0) and what was expected there. Memory is bounded by the largest datagram.
Result<Pb2Message> parsePb2(std::string_view datagram);

/// The text of a value in a datagram: the shortest one that reads back to the same number.
class Pb2Number {
 public:
  explicit Pb2Number(std::int64_t value);
  explicit Pb2Number(float value);  ///< always with a point, an exponent, nan or inf
  std::string_view text() const { return {m_text, m_size}; }

 private:
  char m_text[24];
  std::size_t m_size = 0;
};

/// Builds one datagram. Ask fits() before add(); finish() returns the text.
class Pb2Writer {
 public:
  Pb2Writer(int robot, std::uint32_t sequence, std::uint64_t milliseconds);

  /// Returns how many bytes a field takes.
  static std::size_t fieldBytes(std::string_view name, std::string_view number) {
    return name.size() + number.size() + 2;
  }
  /// Returns the size of the datagram if it ended here.
  std::size_t bytes() const { return m_text.size() + 4; }
  bool fits(std::size_t fieldBytes) const { return bytes() + fieldBytes <= Pb2Limits::bytes; }
  /// Appends a field. It must fit, and the name must be valid.
  void add(std::string_view name, std::string_view number);
  /// Returns the complete datagram.
  std::string finish() &&;

 private:
  std::string m_text;
};

}  // namespace pitchboard::telemetry
