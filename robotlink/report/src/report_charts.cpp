// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_charts.h"

#include <algorithm>
#include <cmath>

namespace pitchboard::link {
namespace {

constexpr double width = 440, height = 110;                    // of the drawing
constexpr double left = 40, right = 6, top = 10, bottom = 20;  // room round the curve
constexpr double plotWidth = width - left - right, plotHeight = height - top - bottom;

std::string frame(const std::string& highest, telemetry::TimeRange range,
                  const std::string& inside) {
  const auto at = [](double value) { return fixed(value, 1); };
  const double foot = top + plotHeight;
  std::string out = "<svg class=\"chart\" viewBox=\"0 0 " + at(width) + ' ' + at(height) + "\">";
  for (const double y : {top, top + plotHeight / 2, foot}) {
    out += "<line class=\"grid\" x1=\"" + at(left) + "\" y1=\"" + at(y) + "\" x2=\"" +
           at(width - right) + "\" y2=\"" + at(y) + "\"/>";
  }
  out += inside;
  const auto text = [&](double x, double y, const char* anchor, const std::string& label) {
    out += "<text class=\"axis\" x=\"" + at(x) + "\" y=\"" + at(y) + "\" text-anchor=\"" + anchor +
           "\">" + label + "</text>";
  };
  text(left - 5, top + 4, "end", highest);
  text(left - 5, foot + 4, "end", "0");
  text(left, height - 4, "start", clockText(range.begin));
  text(left + plotWidth / 2, height - 4, "middle", clockText((range.begin + range.end) / 2));
  text(width - right, height - 4, "end", clockText(range.end));
  return out + "</svg>";
}

}  // namespace

std::string clockText(double seconds) {
  const auto total = static_cast<long long>(std::clamp(std::floor(seconds), -1e9, 1e9));
  const long long s = std::abs(total);
  const auto two = [](long long value) { return (value < 10 ? "0" : "") + std::to_string(value); };
  const std::string sign = total < 0 ? "−" : "";
  if (s >= 3600)
    return sign + std::to_string(s / 3600) + ':' + two(s / 60 % 60) + ':' + two(s % 60);
  return sign + std::to_string(s / 60) + ':' + two(s % 60);
}

double axisTop(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (value <= step * power) return step * power;
  }
  return 10.0 * power;
}

std::string curveChart(const std::vector<double>& values, double most, const std::string& unit,
                       telemetry::TimeRange range) {
  const double foot = top + plotHeight;
  std::string curve, area, run;
  double runStart = 0.0, lastX = 0.0;
  const auto endRun = [&] {
    if (run.empty()) return;
    curve += 'M' + run;
    area += 'M' + fixed(runStart, 1) + ' ' + fixed(foot, 1) + 'L' + run + 'L' + fixed(lastX, 1) +
            ' ' + fixed(foot, 1) + 'Z';
    run.clear();
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      endRun();
      continue;
    }
    const double x =
        left + plotWidth * (static_cast<double>(i) + 0.5) / static_cast<double>(values.size());
    const double y = foot - plotHeight * std::clamp(values[i] / most, 0.0, 1.0);
    if (run.empty()) {
      runStart = x;
    } else {
      run += 'L';
    }
    run += fixed(x, 1) + ' ' + fixed(y, 1);
    lastX = x;
  }
  endRun();
  return frame(
      fixed(most, most < 1 ? 1 : 0) + (unit.empty() ? "" : " " + unit), range,
      "<path class=\"area\" d=\"" + area + "\"/><path class=\"curve\" d=\"" + curve + "\"/>");
}

std::string shareChart(const std::vector<double>& shares, telemetry::TimeRange range) {
  std::string bars;
  const double each = plotWidth / static_cast<double>(std::max<std::size_t>(1, shares.size()));
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double tall = plotHeight * std::clamp(shares[i], 0.0, 1.0);
    if (tall < 0.1) continue;
    bars += "<rect class=\"bar\" x=\"" + fixed(left + each * static_cast<double>(i), 2) +
            "\" y=\"" + fixed(top + plotHeight - tall, 1) + "\" width=\"" + fixed(each * 0.9, 2) +
            "\" height=\"" + fixed(tall, 1) + "\"/>";
  }
  return frame("100 %", range, bars);
}

}  // namespace pitchboard::link
