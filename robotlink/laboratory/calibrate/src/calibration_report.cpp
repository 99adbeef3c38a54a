// SPDX-License-Identifier: GPL-3.0-or-later

// The page of a calibration. Charts are inline SVG in the style of the match report.

#include <robotlink/calibrate/calibration_file.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <base/base64.h>
#include <robotlink/report/field_svg.h>
#include <robotlink/report/report_page.h>

namespace pitchboard::link {
namespace {

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string tableCell(const std::string& text, bool left = false) {
  return std::string(left ? "<td class=\"l\">" : "<td>") + text + "</td>";
}

std::string valueTable(const Calibration& c) {
  std::string out =
      "<h2>Values</h2>\n<div class=\"scroll\"><table><thead><tr><th class=\"l\">Key</th>"
      "<th>Value</th><th>95 % interval</th><th class=\"l\">Unit</th><th>Base model</th>"
      "<th class=\"l\">From</th></tr></thead><tbody>\n";
  const auto row = [&](const CalibratedValue& value) {
    const WrittenValue w = writtenValue(value);
    const auto base = writtenBase(c, value.key);
    out += "<tr>" + tableCell(escaped(value.key), true) + tableCell(digits(w.value)) +
           tableCell(digits(w.low) + " to " + digits(w.high)) + tableCell(escaped(w.unit), true) +
           tableCell(base ? digits(*base) : "–") + tableCell(escaped(samplesText(value)), true) +
           "</tr>\n";
  };
  for (const CalibratedValue& value : c.values) row(value);
  for (const CalibratedValue& value : c.estimates) row(value);
  out +=
      "</tbody></table></div>\n<h2>Not estimated</h2>\n<p class=\"quiet\">These keep the number "
      "of the base model.</p>\n<div class=\"scroll\"><table><tbody>\n";
  for (const auto& [key, reason] : c.kept) {
    out += "<tr>" + tableCell(escaped(key), true) + tableCell(escaped(reason), true) + "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

/// Points of a curve in a box of 300 by 110 with a grid line at `mark`.
std::string smallChart(const std::vector<double>& values, double most, double mark,
                       const std::string& begin, const std::string& end) {
  constexpr double width = 300.0, height = 110.0, foot = 92.0, top = 8.0, left = 30.0;
  const auto y = [&](double value) {
    return foot - (foot - top) * std::clamp(value / most, 0.0, 1.0);
  };
  std::string line;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const double x =
        left + (width - left) * (static_cast<double>(i) + 0.5) / static_cast<double>(values.size());
    line += (line.empty() ? "M" : "L") + fixed(x, 1) + ' ' + fixed(y(values[i]), 1);
  }
  const auto text = [](double x, double at, const char* anchor, const std::string& label) {
    return "<text class=\"axis\" x=\"" + fixed(x, 1) + "\" y=\"" + fixed(at, 1) +
           "\" text-anchor=\"" + anchor + "\">" + label + "</text>";
  };
  return "<svg class=\"chart\" viewBox=\"0 0 300 110\"><line class=\"grid\" x1=\"30\" x2=\"300\" "
         "y1=\"" +
         fixed(y(mark), 1) + "\" y2=\"" + fixed(y(mark), 1) + "\"/><path class=\"curve\" d=\"" +
         line + "\"/>" + text(left - 4, y(mark) + 4, "end", digits(mark)) +
         text(left - 4, foot + 4, "end", "0") + text(left, height - 4, "start", begin) +
         text(width, height - 4, "end", end) + "</svg>";
}

/// Sample quantiles of the residuals against those of the normal distribution: a straight line.
std::string quantileChart(const std::vector<double>& quantiles) {
  std::string marks;
  const auto at = [](double z) { return 55.0 + 45.0 * std::clamp(z, -3.0, 3.0) / 3.0; };
  for (std::size_t i = 0; i < quantiles.size(); ++i) {
    const double normal = -2.0 + 0.5 * static_cast<double>(i);
    marks += "<circle class=\"bar\" r=\"2.5\" cx=\"" + fixed(at(normal), 1) + "\" cy=\"" +
             fixed(110.0 - at(quantiles[i]), 1) + "\"/>";
  }
  return "<svg class=\"chart\" viewBox=\"0 0 110 110\"><line class=\"grid\" x1=\"10\" y1=\"100\" "
         "x2=\"100\" y2=\"10\"/>" +
         marks + "</svg>";
}

std::string residualCharts(const Calibration& c) {
  std::string out =
      "<h2>Residuals</h2>\n<p class=\"quiet\">What was measured minus what the calibrated model "
      "expected, divided by its standard deviation. Where the model is right, bias and "
      "autocorrelation are 0, the deviation is 1, and the dots (quantiles against the normal "
      "distribution) lie on the "
      "line.</p>\n<div class=\"charts\">\n";
  for (const CalibrationResiduals& one : c.residuals) {
    double most = 2.0;
    for (const double value : one.overTime) most = std::max(most, value);
    out += "<figure class=\"blue\"><h3><span>" + escaped(one.sense) +
           "</span><span class=\"quiet\">" + residualsText(one) + "</span></h3>" +
           smallChart(one.overTime, most, 1.0, "size, first row", "last row") +
           "<div style=\"max-width:160px\">" + quantileChart(one.quantiles) + "</div></figure>\n";
  }
  return out + "</div>\n";
}

std::string trajectories(const Calibration& c, const sim::FieldSpec& field) {
  if (c.check.windows.empty()) {
    return "<h2>Predictions</h2>\n<p class=\"quiet\">The part that was held out has no stretch of "
           "5 s in which the robot walked.</p>\n";
  }
  constexpr std::size_t maxShown = 12;
  std::vector<PredictedWindow> shown;
  const std::size_t count = std::min(maxShown, c.check.windows.size());
  for (std::size_t i = 0; i < count; ++i) {
    shown.push_back(c.check.windows[i * c.check.windows.size() / count]);
  }
  std::vector<FieldTrajectory> all;
  for (const PredictedWindow& window : shown) {
    FieldTrajectory recorded{{}, "#ffffff", 0.9, 0.05}, base{{}, "#e8a25c", 0.9, 0.03},
        calibrated{{}, "#4f8fe3", 1.0, 0.03};
    for (const PredictedWindow::Place& place : window.places) {
      recorded.points.push_back(place.recorded);
      base.points.push_back(place.base);
      calibrated.points.push_back(place.calibrated);
    }
    all.insert(all.end(), {recorded, base, calibrated});
  }
  std::string out =
      "<h2>Predictions</h2>\n<p>Over " + std::to_string(c.check.windows.size()) + " windows of " +
      digits(c.check.window) + " s the calibrated model ends " + fixed(100.0 * c.check.rms, 1) +
      " cm from where the robot was (root mean square), the base model " +
      fixed(100.0 * c.check.rmsBase, 1) +
      " cm.</p>\n<figure><img alt=\"Trajectories\" "
      "src=\"data:image/svg+xml;base64," +
      toBase64(fieldSvg(field, all)) +
      "\"><figcaption>Simulated trajectories over recorded ones, from the same commands. White: "
      "recorded. Blue: calibrated. Orange: base model.</figcaption></figure>\n<div "
      "class=\"charts\">\n";
  for (const PredictedWindow& window : shown) {
    std::vector<double> calibrated, base;
    double most = 0.1;
    for (const PredictedWindow::Place& place : window.places) {
      calibrated.push_back(
          std::hypot(place.calibrated.x - place.recorded.x, place.calibrated.y - place.recorded.y));
      base.push_back(std::hypot(place.base.x - place.recorded.x, place.base.y - place.recorded.y));
      most = std::max({most, calibrated.back(), base.back()});
    }
    const auto chart = [&](const char* colour, const std::string& name,
                           const std::vector<double>& values) {
      return std::string("<div class=\"") + colour + "\"><span class=\"quiet\">" + name +
             "</span>" + smallChart(values, most, most, "0 s", "5 s") + "</div>";
    };
    out += "<figure><h3><span>From " + fixed(window.time, 1) +
           " s</span><span class=\"quiet\">error, m</span></h3>" +
           chart("blue", "calibrated", calibrated) + chart("orange", "base", base) + "</figure>\n";
  }
  return out + "</div>\n";
}

}  // namespace

std::string calibrationReport(const Calibration& c, const sim::FieldSpec& field) {
  std::string sessions;
  for (const std::string& name : c.sessions) sessions += (sessions.empty() ? "" : ", ") + name;
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>Calibration of " +
      escaped(c.robot) + "</title>\n<style>";
  out += reportStyle;
  out += "</style></head><body><main>\n<h1>Calibration of " + escaped(c.robot) +
         "</h1>\n<p class=\"quiet\">" + escaped(sessions) + " · " + fixed(c.seconds, 0) +
         " s recorded · base model " + escaped(c.base.name) + "</p>\n";
  for (const std::string& note : c.notes) out += "<p class=\"note\">" + escaped(note) + "</p>\n";
  for (const std::string& text : leftOutTexts(c))
    out += "<p class=\"note\">" + escaped(text) + ".</p>\n";
  out += valueTable(c) + trajectories(c, field) + residualCharts(c);
  return out +
         "<footer>If the model is right, an interval contains the true value in 95 of 100 "
         "calibrations; see docs/calibrate.md.</footer>\n</main></body></html>\n";
}

}  // namespace pitchboard::link
