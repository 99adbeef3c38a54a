// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The errors of robots' datagrams, and counters for them. Plain values; not thread-safe.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pitchboard::telemetry {

/// A message with one of the first eight errors is refused. The other errors affect a single field,
/// or nothing.
enum class TextError : std::uint8_t {
  Empty,          ///< no text at all
  TooLong,        ///< more than 64 KiB
  Truncated,      ///< cut by the network, or shorter than the fields of a binary message
  Binary,         ///< bytes that are not printable ASCII
  MissingFields,  ///< fewer fields than the profile has
  MissingEnd,     ///< no OUT
  BadRobot,       ///< the robot's number is not a whole number from 1 to 64295
  BadFormat,      ///< does not follow the profile's format
  NotANumber,     ///< text where a number should be, or 1.5 where a whole number should be
  NotFinite,      ///< nan or inf
  TooLarge,       ///< does not fit the field's type
  BadFlag,        ///< neither 0 nor 1
  TooManyFields,  ///< more extra fields than are kept
  TrailingText,   ///< something after OUT, e.g. a second message
  Duplicate       ///< the same message again within 5 ms
};
inline constexpr std::size_t textErrorCount = 15;

/// Returns a name such as "missing-end", for files and JSON.
std::string_view errorName(TextError error);
/// Returns a text such as "no OUT at the end", for people.
std::string_view errorText(TextError error);

/// A set of errors.
class TextErrors {
 public:
  void add(TextError error) { m_bits |= 1U << static_cast<unsigned>(error); }
  bool has(TextError error) const { return (m_bits >> static_cast<unsigned>(error) & 1U) != 0; }
  bool empty() const { return m_bits == 0; }
  bool refused() const { return (m_bits & ((1U << 8U) - 1U)) != 0; }
  bool operator==(const TextErrors&) const = default;

 private:
  std::uint32_t m_bits = 0;
};

/// Counts errors by kind and keeps the last text of each kind, in bounded memory.
class ErrorTally {
 public:
  static constexpr std::size_t sampleBytes = 160;

  void add(TextErrors errors, std::string_view datagram);
  /// Adds errors that were counted elsewhere, without a text.
  void add(TextError error, std::uint64_t count) { m_kinds[index(error)].count += count; }
  void addMessages(std::uint64_t count) { m_messages += count; }
  std::uint64_t count(TextError error) const { return m_kinds[index(error)].count; }
  /// Returns the number of datagrams with at least one error.
  std::uint64_t messages() const { return m_messages; }
  /// Returns the last text, printable: other bytes as \xNN, and "..." if it was longer.
  std::string sample(TextError error) const;

 private:
  struct Kind {
    std::uint64_t count = 0;
    std::array<char, sampleBytes> text{};
    std::uint16_t length = 0;
    bool cut = false;
  };
  static std::size_t index(TextError error) { return static_cast<std::size_t>(error); }
  std::array<Kind, textErrorCount> m_kinds{};
  std::uint64_t m_messages = 0;
};

/// Returns the length in bytes of the UTF-8 character at the beginning of a text; 0 if there is
/// none.
std::size_t sequenceLength(std::string_view text);
/// Returns the beginning of any bytes as one printable line of UTF-8, other bytes as \xNN.
std::string printable(std::string_view bytes, std::size_t limit = ErrorTally::sampleBytes);
/// Adds it to `out`.
void addPrintable(std::string& out, std::string_view bytes, std::size_t limit);

}  // namespace pitchboard::telemetry
