// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/formats/text_protocol.h>

#include <charconv>
#include <cmath>

namespace pitchboard::telemetry {

std::string pythonFloat(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  // 12 significant digits, with the exponent they have after rounding.
  constexpr int digits = 12;
  char buffer[32];
  const auto scientific = std::to_chars(buffer, buffer + sizeof buffer, value,
                                        std::chars_format::scientific, digits - 1);
  std::string text(buffer, scientific.ptr);
  int exponent = 0;
  const char* sign = text.data() + text.find('e') + 1;
  std::from_chars(*sign == '+' ? sign + 1 : sign, text.data() + text.size(), exponent);

  // %g would write 100000000000 out. Python keeps a place of the twelve for the ".0", so that it
  // begins to use exponents there.
  if (exponent == digits - 1) {
    const std::size_t e = text.find('e');
    std::size_t mantissa = text.find_last_not_of('0', e - 1) + 1;
    if (text[mantissa - 1] == '.') --mantissa;
    return text.erase(mantissa, e - mantissa);
  }
  const auto general =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits);
  text.assign(buffer, general.ptr);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string encode(const TextMessage& m) {
  std::string out;
  out.reserve(160);
  const auto add = [&out](const std::string& field) {
    out += field;
    out += ' ';
  };
  for (const int value : {m.robot, m.x, m.y, m.theta}) add(std::to_string(value));
  for (const float value : {m.belief, m.ballDist, m.ballAngle}) add(pythonFloat(value));
  for (const int value : {m.control, m.vision, m.localization, m.decision, m.imu, m.actionA}) {
    add(std::to_string(value));
  }
  add(pythonFloat(m.imuEulerZ));
  add(std::to_string(m.voltage));
  return out + "OUT";
}

}  // namespace pitchboard::telemetry
