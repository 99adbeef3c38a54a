// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/time_text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace pitchboard {
namespace {

constexpr std::size_t maxTimeDigits = 10;  // 300 years of seconds

std::size_t digitsAtFront(std::string_view text) {
  return std::min(text.find_first_not_of("0123456789"), text.size());
}

/// A number of digits; the last part of a time may have decimals.
std::optional<double> timePart(std::string_view text, bool decimals) {
  const std::size_t digits = digitsAtFront(text);
  if (digits > maxTimeDigits) return {};
  if (digits < text.size()) {
    if (!decimals || text[digits] != '.') return {};
    const std::string_view behind = text.substr(digits + 1);
    if (digitsAtFront(behind) < behind.size() || digits + behind.size() == 0) return {};
  } else if (digits == 0) {
    return {};
  }
  double value = 0.0;
  (void)std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

std::optional<double> secondsFromText(std::string_view text) {
  bool negative = false;
  for (const std::string_view sign : {"-", "\u2212"}) {
    if (negative || !text.starts_with(sign)) continue;
    negative = true;
    text.remove_prefix(sign.size());
  }
  double seconds = 0.0;
  for (int parts = 1;; ++parts) {
    const std::size_t colon = text.find(':');
    const bool last = colon == std::string_view::npos;
    const auto value = timePart(text.substr(0, colon), last);
    if (!value || parts > 3) return {};
    if (parts > 1 && (digitsAtFront(text) != 2 || *value >= 60.0)) return {};
    seconds = seconds * 60.0 + *value;
    if (last) return negative ? -seconds : seconds;
    text.remove_prefix(colon + 1);
  }
}

std::string secondsToText(double seconds) {
  constexpr double longest = 1e12;
  if (!std::isfinite(seconds)) return "–";
  const long long all = std::llround(std::clamp(seconds, -longest, longest) * 1000.0);
  const long long ms = std::llabs(all), whole = ms / 1000;
  char text[64];
  if (whole >= 3600) {
    std::snprintf(text, sizeof text, "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60,
                  whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%lld:%02lld", whole / 60, whole % 60);
  }
  std::string out = (all < 0 ? "-" : "") + std::string(text);
  if (ms % 1000 == 0) return out;
  std::snprintf(text, sizeof text, ".%03lld", ms % 1000);
  out += text;
  out.erase(out.find_last_not_of('0') + 1);
  return out;
}

}  // namespace pitchboard
