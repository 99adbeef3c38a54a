// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/text_protocol.h>

#include <charconv>
#include <cmath>

namespace pitchboard::telemetry {

std::string pythonFloat(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general,
                                 12);
  std::string text(buffer, end.ptr);
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
