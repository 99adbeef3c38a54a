// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/duration_text.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace pitchboard {
namespace {

constexpr double longest = 1e9;  // s; 30 years

}  // namespace

std::string durationText(double seconds, int decimals) {
  if (!std::isfinite(seconds)) return "–";
  char text[64];
  const double part = std::pow(10.0, decimals);
  // Rounding must not make ten of nine and a half.
  const double shown = std::floor(std::clamp(seconds, 0.0, longest) * part + 1e-6) / part;
  if (shown < 10 && decimals > 0) {
    std::snprintf(text, sizeof text, "%.*f s", decimals, shown);
    return text;
  }
  const auto whole = static_cast<std::int64_t>(shown);
  constexpr std::int64_t minute = 60, hour = 60 * minute, day = 24 * hour;
  const auto both = [&](std::int64_t large, const char* name, std::int64_t small,
                        const char* smallName) {
    if (small == 0) return std::to_string(large) + ' ' + name;
    return std::to_string(large) + ' ' + name + ' ' + std::to_string(small) + ' ' + smallName;
  };
  if (whole < minute) return std::to_string(whole) + " s";
  if (whole < hour) return both(whole / minute, "min", whole % minute, "s");
  if (whole < day) return both(whole / hour, "h", whole % hour / minute, "min");
  return both(whole / day, "d", whole % day / hour, "h");
}

}  // namespace pitchboard
