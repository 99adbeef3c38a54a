// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/experiment/checks.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include <base/lined_json.h>
#include <base/try.h>
#include <robotlink/experiment/statistics.h>
#include <telemetry/statistics/quantile.h>

#include "numbers.h"

namespace pitchboard::link {
namespace {

constexpr std::array<std::string_view, 17> statistics{
    "low95", "high95", "mean", "median", "sd",  "min", "max", "n",  "p01",
    "p05",   "p10",    "p25",  "p50",    "p75", "p90", "p95", "p99"};
constexpr std::string_view rateEnd = "_rate";

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool isNameCharacter(char c) {
  return isLetter(c) || (c >= '0' && c <= '9');
}
std::size_t endOfName(std::string_view text, std::size_t at) {
  while (at < text.size() && isNameCharacter(text[at])) ++at;
  return at;
}
std::size_t behindSpaces(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] == ' ') ++at;
  return at;
}

const MetricInfo* find(std::span<const MetricInfo> metrics, std::string_view name) {
  const auto found = std::ranges::find(metrics, name, &MetricInfo::name);
  return found == metrics.end() ? nullptr : &*found;
}

struct Operand {
  std::string statistic, metric;
  std::size_t end = 0;
};

/// A metric, its statistic, or a rate at this place; empty `metric`: something else.
Operand operandAt(std::string_view text, std::size_t at, Check::Over over,
                  std::span<const MetricInfo> metrics) {
  const std::size_t end = endOfName(text, at);
  const std::string_view name = text.substr(at, end - at);
  if (over == Check::Over::Run) {
    return find(metrics, name) ? Operand{"value", std::string(name), end} : Operand{{}, {}, end};
  }
  const std::size_t open = behindSpaces(text, end);
  if (open < text.size() && text[open] == '(') {
    if (std::ranges::find(statistics, name) == statistics.end()) {
      return {{}, {}, end};
    }
    const std::size_t inner = behindSpaces(text, open + 1);
    const std::size_t innerEnd = endOfName(text, inner);
    const std::size_t close = behindSpaces(text, innerEnd);
    const std::string_view metric = text.substr(inner, innerEnd - inner);
    if (close < text.size() && text[close] == ')' && find(metrics, metric)) {
      return {std::string(name), std::string(metric), close + 1};
    }
    return {{}, {}, end};
  }
  if (find(metrics, name)) return {"mean", std::string(name), end};
  if (name.ends_with(rateEnd)) {
    const std::string_view of = name.substr(0, name.size() - rateEnd.size());
    if (find(metrics, of)) return {"mean", std::string(of), end};
  }
  return {{}, {}, end};
}

}  // namespace

Result<Check> Check::parse(std::string_view text, Over over, std::span<const MetricInfo> metrics) {
  std::string translated;
  std::vector<std::pair<std::string, std::string>>
      written;  // "{mean/goal}" and how it stands there
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '{' || c == '}') {
      return failure(ErrorCode::ParseError, "braces are not allowed here");
    }
    if ((c >= '0' && c <= '9') || c == '.') {  // a number, whose exponent is no name
      std::size_t end = at;
      while (end < text.size() && (isNameCharacter(text[end]) || text[end] == '.')) ++end;
      translated += text.substr(at, end - at);
      at = end;
      continue;
    }
    if (!isLetter(c)) {
      translated += c;
      ++at;
      continue;
    }
    const Operand operand = operandAt(text, at, over, metrics);
    const std::string_view asWritten = text.substr(at, operand.end - at);
    if (!operand.metric.empty()) {
      const std::string name = operand.statistic + '/' + operand.metric;
      translated += '{' + name + '}';
      written.emplace_back(name, asWritten);
    } else {
      const std::size_t next = behindSpaces(text, operand.end);
      const bool isCall = next < text.size() && text[next] == '(';
      if (!isCall && asWritten != "pi") {
        std::vector<std::string_view> known;
        for (const MetricInfo& metric : metrics) known.push_back(metric.name);
        return failure(ErrorCode::NotFound, unknownName("metric", asWritten, known));
      }
      translated += asWritten;
    }
    at = operand.end;
  }
  auto expression = TRY(telemetry::Expression::parse(translated));
  std::vector<Name> names;
  for (const std::string& variable : expression.variables()) {
    const std::size_t slash = variable.find('/');
    Name name;
    name.statistic = variable.substr(0, slash);
    name.metric =
        static_cast<std::size_t>(find(metrics, variable.substr(slash + 1)) - metrics.data());
    const auto asWritten =
        std::ranges::find_if(written, [&](const auto& one) { return one.first == variable; });
    name.written = asWritten->second;
    names.push_back(std::move(name));
  }
  return Check(std::move(expression), std::move(names));
}

double Check::value(std::span<const double> values) {
  return m_expression.evaluate(0.0, values);
}

bool Check::holds(std::span<const double> values) {
  const double result = value(values);
  return std::isfinite(result) && result != 0.0;
}

bool isInterval(std::string_view statistic) {
  return statistic == "low95" || statistic == "high95";
}

CheckedAssertion checkedBy(
    const std::string& text, const std::string& condition, std::span<const MetricInfo> metrics,
    const std::function<std::vector<double>(std::size_t metric, bool forInterval)>& valuesOf) {
  CheckedAssertion out{condition, text, false, {}};
  auto check = Check::parse(text, Check::Over::Condition, metrics);
  if (!check) {
    out.values = check.error().message;
    return out;
  }
  std::vector<double> values;
  for (const Check::Name& one : check->names()) {
    const bool forInterval = isInterval(one.statistic);
    values.push_back(
        statisticOf(one.statistic, valuesOf(one.metric, forInterval), metrics[one.metric].rate));
    out.values += (out.values.empty() ? "" : ", ") + one.written + " = " + number(values.back());
  }
  out.holds = check->holds(values);
  return out;
}

double statisticOf(std::string_view statistic, std::span<const double> values, bool rate) {
  if (isInterval(statistic)) {
    const auto interval = rate ? intervalOfRate(momentsOf(values)) : intervalOfMean(values);
    if (!interval) return std::numeric_limits<double>::quiet_NaN();
    return statistic == "low95" ? interval->low : interval->high;
  }
  std::vector<double> sorted;
  std::ranges::copy_if(values, std::back_inserter(sorted),
                       [](double value) { return std::isfinite(value); });
  std::ranges::sort(sorted);
  if (statistic == "n") return static_cast<double>(sorted.size());
  if (statistic == "mean") return momentsOf(sorted).mean;
  if (statistic == "sd") return momentsOf(sorted).deviation;
  if (statistic == "min") return telemetry::quantile(sorted, 0.0);
  if (statistic == "max") return telemetry::quantile(sorted, 1.0);
  if (statistic == "median") return telemetry::quantile(sorted, 0.5);
  return telemetry::quantile(sorted, (10 * (statistic[1] - '0') + (statistic[2] - '0')) / 100.0);
}

}  // namespace pitchboard::link
