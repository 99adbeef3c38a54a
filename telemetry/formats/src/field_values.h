// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One value of a message at its place: read as its field's type, scaled, its text kept. Private to
// formats. Any thread, with a DecodedText of its own.

#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>

#include <telemetry/formats/text_decoder.h>

namespace pitchboard::telemetry {

/// The value of a field that a message does not have, or not as a number.
inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// Begins a message of `count` fields: none of them is there.
void clearFields(std::size_t count, DecodedText& out);

void addError(TextError error, std::size_t index, DecodedText& out);
/// A value that was sent as text.
void setText(const ProfileField& field, std::size_t index, std::string_view token,
             DecodedText& out);
/// A value that was sent as a number.
void setNumber(const ProfileField& field, std::size_t index, double value, DecodedText& out);
/// Returns the text of a number that the message does not have as text; "" if there is no more
/// room.
std::string_view numberText(double value, DecodedText& out);
/// A text that ends with the call is kept.
std::string_view keep(std::string_view text, DecodedText& out);

/// A number as a robot writes it. NaN with an error where it cannot be used.
struct ReadNumber {
  double value;
  std::optional<TextError> error;
};
ReadNumber readNumber(const ProfileField& field, std::string_view token);
ReadNumber readFloat(std::string_view token);

constexpr bool isSpace(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
/// Printable ASCII and white space; with `utf8`, every valid sequence of it too.
bool isText(std::string_view text, bool utf8);

}  // namespace pitchboard::telemetry
