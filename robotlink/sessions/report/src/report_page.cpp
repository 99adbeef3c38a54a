// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/report/report_page.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pitchboard::link {

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "—";
  char text[48];
  // Not printf: its decimal point follows the locale.
  const auto end = std::to_chars(text, text + sizeof text, std::clamp(value, -1e15, 1e15),
                                 std::chars_format::fixed, decimals);
  std::string out(text, end.ptr);
  if (out.starts_with('-') && out.find_first_not_of("-0.") == std::string::npos) out.erase(0, 1);
  return out;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        // XML has no other control characters.
        out += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? '?' : c;
    }
  }
  return out;
}

}  // namespace pitchboard::link
