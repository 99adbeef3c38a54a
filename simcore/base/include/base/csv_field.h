// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Quotes a text as a field of a CSV file (RFC 4180). Pure function; any thread.

#include <string>

namespace pitchboard {

inline std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    out += c;
    if (c == '"') out += c;
  }
  return out + '"';
}

}  // namespace pitchboard
