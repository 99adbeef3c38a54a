// SPDX-License-Identifier: GPL-3.0-or-later
#include "numbers.h"

#include <charconv>
#include <cmath>

#include <robotlink/report/report_page.h>

namespace pitchboard::link {
namespace {

constexpr int significant = 4;

}  // namespace

std::string number(double value) {
  if (!std::isfinite(value)) return "–";
  if (value == std::round(value) && std::abs(value) < 1e9) return fixed(value, 0);
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, significant);
  return {text, end.ptr};
}

std::string valueText(const MetricInfo& metric, double value) {
  if (!metric.rate || !std::isfinite(value)) return number(value);
  return fixed(100.0 * value, 1) + " %";
}

std::string intervalText(const MetricInfo& metric, const std::optional<Interval>& interval) {
  if (!interval) return "–";
  return '[' + valueText(metric, interval->low) + ", " + valueText(metric, interval->high) + ']';
}

std::string titleOf(const MetricInfo& metric) {
  return metric.unit.empty() ? metric.title : metric.title + ", " + metric.unit;
}

std::string probabilityText(double p) {
  if (p < 0.001) return "< 0.001";
  return fixed(p, 3);
}

}  // namespace pitchboard::link
