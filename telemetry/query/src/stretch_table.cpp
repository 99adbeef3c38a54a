// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/query/stretch_table.h>
#include <telemetry/statistics/histogram.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include <base/csv_field.h>
#include <base/try.h>

namespace pitchboard::telemetry {
namespace {

constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t textsAtOnce = 16;  // so that not all curves of a session are in memory

std::vector<StretchColumn> summaryColumns() {
  using L = StretchLine;
  return {{"value", [](const L& l) { return l.state ? l.state->value : noNumber; }},
          {"share", [](const L& l) { return l.state ? l.state->share : l.summary.share; }},
          {"n",
           [](const L& l) {
             return static_cast<double>(l.state ? l.state->samples : l.summary.samples);
           }},
          {"missing", [](const L& l) { return static_cast<double>(l.summary.missing); }},
          {"n_effective", [](const L& l) { return l.summary.effective; }},
          {"mean", [](const L& l) { return l.summary.mean; }},
          {"mean_95_low", [](const L& l) { return l.summary.meanLow; }},
          {"mean_95_high", [](const L& l) { return l.summary.meanHigh; }},
          {"sd", [](const L& l) { return l.summary.deviation; }},
          {"rms", [](const L& l) { return l.summary.rms; }},
          {"min", [](const L& l) { return l.summary.least; }},
          {"min_time", [](const L& l) { return l.summary.leastAt; }},
          {"p05", [](const L& l) { return l.summary.quantiles[0]; }},
          {"p25", [](const L& l) { return l.summary.quantiles[1]; }},
          {"median", [](const L& l) { return l.summary.quantiles[2]; }},
          {"p75", [](const L& l) { return l.summary.quantiles[3]; }},
          {"p95", [](const L& l) { return l.summary.quantiles[4]; }},
          {"max", [](const L& l) { return l.summary.most; }},
          {"max_time", [](const L& l) { return l.summary.mostAt; }}};
}

std::vector<StretchColumn> errorColumns() {
  using L = StretchLine;
  return {
      {"error_n",
       [](const L& l) { return l.error ? static_cast<double>(l.error->samples) : noNumber; }},
      {"bias", [](const L& l) { return l.error ? l.error->bias : noNumber; }},
      {"bias_95_low", [](const L& l) { return l.error ? l.error->biasLow : noNumber; }},
      {"bias_95_high", [](const L& l) { return l.error ? l.error->biasHigh : noNumber; }},
      {"error_rms", [](const L& l) { return l.error ? l.error->rms : noNumber; }},
      {"largest_error", [](const L& l) { return l.error ? l.error->largest : noNumber; }},
      {"largest_error_time", [](const L& l) { return l.error ? l.error->largestAt : noNumber; }},
      {"correlation", [](const L& l) { return l.correlation ? l.correlation->atZero : noNumber; }},
      {"delay", [](const L& l) { return l.correlation ? l.correlation->delay : noNumber; }},
      {"delayed_correlation",
       [](const L& l) { return l.correlation ? l.correlation->coefficient : noNumber; }}};
}

/// The curve that `against` means for the robot of another one; null if there is none.
const StretchCurve* otherOf(const std::vector<StretchCurve>& others, const QueryCurve& curve) {
  const auto found = std::ranges::find_if(others, [&](const StretchCurve& one) {
    return !one.curve.isOfEach || one.curve.robot == curve.robot;
  });
  return found == others.end() ? nullptr : &*found;
}

Result<void> compareWith(const StretchCurve& curve, const StretchCurve& other,
                         const StretchQuestion& question, StretchLine& line) {
  if (!curve.curve.unit.empty() && !other.curve.unit.empty() &&
      curve.curve.unit != other.curve.unit) {
    return failure(ErrorCode::InvalidArgument, line.variable + " is in " + curve.curve.unit + ", " +
                                                   question.against + " in " + other.curve.unit +
                                                   ". Convert one with an expression, such as " +
                                                   line.variable + " / 100.");
  }
  line.error = errorAgainst(curve.samples, other.samples, curve.counted);
  line.correlation = correlationOf(curve.samples, other.samples, question.maxDelay);
  return {};
}

/// A map of the curve over the places of its robot; nothing if those are unknown.
std::optional<ValueMap> mapOf(const StretchCurve& curve, const std::vector<StretchCurve>& places,
                              const MapGrid& grid) {
  std::array<const StretchCurve*, 2> axes{};
  for (const StretchCurve& place : places) {
    const bool isOf = !place.curve.isOfEach || place.curve.robot == curve.curve.robot;
    if (isOf && place.curve.value < axes.size()) axes[place.curve.value] = &place;
  }
  if (axes[0] == nullptr || axes[1] == nullptr) return {};
  return valueMap(curve.samples, axes[0]->samples, axes[1]->samples, grid);
}

StretchLine lineOf(const StretchCurve& curve, const std::string& name, std::size_t bins) {
  StretchLine line;
  line.robot = curve.curve.robot;
  line.variable = name;
  line.unit = curve.curve.unit;
  line.isCode = curve.curve.kind != ColumnKind::Number;
  line.summary = summaryOf(curve.samples, curve.counted, line.isCode);
  if (bins > 0 && line.summary.least <= line.summary.most) {
    std::vector<double> values;
    for (const Sample& sample : curve.samples) values.push_back(sample.value);
    line.counts = histogram(values, line.summary.least, line.summary.most, bins);
  }
  return line;
}

/// A line for each value of a code that occurs.
void addStates(const StretchCurve& curve, const StretchLine& line,
               std::vector<StretchLine>& lines) {
  for (const StateShare& state : statesOf(curve.samples).value_or(std::vector<StateShare>())) {
    StretchLine one;
    one.robot = line.robot;
    one.variable = line.variable;
    one.summary = summaryOf({}, {}, true);
    one.state = state;
    one.isCode = true;
    const auto label = curve.curve.labels.find(static_cast<std::int32_t>(state.value));
    if (label != curve.curve.labels.end()) one.label = label->second;
    lines.push_back(std::move(one));
  }
}

}  // namespace

Result<StretchTable> describeStretch(const QueryRows& rows, const StretchQuestion& question,
                                     std::span<const TimeRange> ranges,
                                     const std::function<bool(double)>& progress) {
  if (!question.condition.empty()) {
    const auto condition = SessionQuery::of(rows, {{question.condition}, {}, question.robots});
    if (!condition) return tl::unexpected(condition.error());
  }
  StretchTable out;
  std::vector<StretchQuestion::Text> texts;
  for (const StretchQuestion::Text& text : question.texts) {
    const auto query =
        SessionQuery::of(rows, {{text.expression}, question.condition, question.robots});
    if (query) {
      texts.push_back(text);
    } else {
      out.problems.push_back({text.name, query.error()});
    }
  }
  const bool isCompared = !question.against.empty();
  const std::size_t batches = (texts.size() + textsAtOnce - 1) / textsAtOnce;
  const bool isMapped = !question.placeX.empty();
  const double passes = static_cast<double>(batches + (isCompared ? 1 : 0) + (isMapped ? 1 : 0));
  double done = 0.0;
  const auto report = [&](double part) { return !progress || progress((done + part) / passes); };
  std::vector<StretchCurve> others;
  if (isCompared) {
    others = TRY(readStretch(rows, {{question.against}, {}, question.robots}, ranges, report));
    done += 1.0;
  }
  std::vector<StretchCurve> places;
  if (isMapped) {
    auto read = readStretch(rows, {{question.placeX, question.placeY}, {}, {}}, ranges, report);
    // Where a place is unknown there is no map.
    if (!read && read.error().code != ErrorCode::NotFound) return tl::unexpected(read.error());
    if (read) places = std::move(*read);
    done += 1.0;
  }
  for (std::size_t begin = 0; begin < texts.size(); begin += textsAtOnce) {
    const auto end = std::min(texts.size(), begin + textsAtOnce);
    QueryTexts batch{{}, question.condition, question.robots};
    for (std::size_t i = begin; i < end; ++i) batch.values.push_back(texts[i].expression);
    const std::vector<StretchCurve> curves = TRY(readStretch(rows, batch, ranges, report));
    for (const StretchCurve& curve : curves) {
      if (!report(1.0)) return failure(ErrorCode::Conflict, "Stopped.");
      const std::string& name = texts[begin + curve.curve.value].name;
      StretchLine line = lineOf(curve, name, question.bins);
      if (const StretchCurve* other = otherOf(others, curve.curve); other && !line.isCode) {
        const auto compared = compareWith(curve, *other, question, line);
        if (!compared) out.problems.push_back({name, compared.error()});
      }
      if (isMapped && !line.isCode) line.map = mapOf(curve, places, question.grid);
      out.lines.push_back(line);
      if (line.isCode) addStates(curve, line, out.lines);
    }
    done += 1.0;
  }
  return out;
}

std::vector<StretchColumn> stretchColumns(bool isCompared) {
  std::vector<StretchColumn> columns = summaryColumns();
  if (isCompared) std::ranges::copy(errorColumns(), std::back_inserter(columns));
  return columns;
}

std::string stretchNumber(double value) {
  if (!std::isfinite(value)) return {};
  char text[40];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

std::string stretchCsv(std::span<const StretchLine> lines, bool isCompared, bool hasCounts) {
  const std::vector<StretchColumn> columns = stretchColumns(isCompared);
  std::string out = "session,robot,variable,unit,label";
  for (const StretchColumn& column : columns) out += "," + column.name;
  if (hasCounts) out += ",histogram";
  out += "\n";
  for (const StretchLine& line : lines) {
    out += csvField(line.session) + "," + csvField(line.robot) + "," + csvField(line.variable) +
           "," + csvField(line.unit) + "," + csvField(line.label);
    for (const StretchColumn& column : columns) out += "," + stretchNumber(column.of(line));
    if (hasCounts) out += ",";
    for (std::size_t i = 0; i < line.counts.size(); ++i) {
      out += (i > 0 ? " " : "") + std::to_string(line.counts[i]);
    }
    out += "\n";
  }
  return out;
}

}  // namespace pitchboard::telemetry
