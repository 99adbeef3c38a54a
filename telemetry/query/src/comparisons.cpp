// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparisons.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <telemetry/query/session_query.h>

namespace pitchboard::telemetry {
namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmedPart(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Calls `visit(place)` for each character that is outside of brackets and braces, until it returns
/// false.
template <class Visit>
void visitOutside(std::string_view text, Visit visit) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '(' || c == '{') ++depth;
    if (c == ')' || c == '}') --depth;
    if (depth == 0 && c != ')' && c != '}' && !visit(i)) return;
  }
}

/// Without brackets around all of it.
std::string_view withoutBrackets(std::string_view text) {
  for (text = trimmedPart(text); text.size() > 2 && text.front() == '(' && text.back() == ')';
       text = trimmedPart(text.substr(1, text.size() - 2))) {
    int depth = 0;
    std::size_t closed = 0;
    for (; closed < text.size(); ++closed) {
      if (text[closed] == '(') ++depth;
      if (text[closed] == ')' && --depth == 0) break;
    }
    if (closed + 1 != text.size()) break;
  }
  return text;
}

/// The name of a variable, if the text is nothing else.
std::optional<std::string> variableIn(std::string_view text) {
  text = withoutBrackets(text);
  const bool isBraced = !text.empty() && text.front() == '{' && text.find('}') + 1 == text.size();
  const bool isPlain = !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           c == '.';
  });
  if (!isBraced && !isPlain) return {};
  const auto parsed = Expression::parse(text, eachRobot);
  if (!parsed || parsed->variables().size() != 1) return {};
  return parsed->variables().front();
}

std::string turned(const std::string& op) {
  if (op == "<") return ">";
  if (op == "<=") return ">=";
  if (op == ">") return "<";
  if (op == ">=") return "<=";
  return op;
}

}  // namespace

std::optional<double> numberIn(std::string_view text) {
  text = withoutBrackets(text);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::optional<Comparison> withNumberOnTheRight(const Comparison& comparison) {
  if (!numberIn(comparison.left) || numberIn(comparison.right)) return {};
  return Comparison{comparison.right, turned(comparison.op), comparison.left};
}

std::vector<std::string> conjunctsOf(std::string_view condition) {
  condition = withoutBrackets(condition);
  std::vector<std::string> parts;
  std::size_t begin = 0;
  bool isOther = false;
  visitOutside(condition, [&](std::size_t at) {
    const std::string_view rest = condition.substr(at);
    isOther = isOther || rest.starts_with("||") || rest.front() == '?';
    if (rest.starts_with("&&")) {
      parts.emplace_back(condition.substr(begin, at - begin));
      begin = at + 2;
    }
    return !isOther;
  });
  if (isOther) return {std::string(condition)};
  parts.emplace_back(condition.substr(begin));
  std::vector<std::string> out;
  for (const std::string& part : parts) {
    if (parts.size() == 1) {
      out.push_back(part);
      continue;
    }
    for (std::string& inner : conjunctsOf(part)) out.push_back(std::move(inner));
  }
  return out;
}

std::optional<Comparison> comparisonOf(std::string_view text) {
  text = withoutBrackets(text);
  std::optional<Comparison> out;
  bool isOther = false;
  visitOutside(text, [&](std::size_t at) {
    const std::string_view rest = text.substr(at);
    if (at > 0 && (rest.front() == '=') &&
        std::string_view("<>=!").find(text[at - 1]) != std::string_view::npos) {
      return true;  // the second character of an operator
    }
    std::string op;
    for (const char* known : {"<=", ">=", "==", "<", ">"}) {
      if (op.empty() && rest.starts_with(known)) op = known;
    }
    isOther = rest.starts_with("&&") || rest.starts_with("||") || rest.starts_with("!=") ||
              rest.front() == '?' || (!op.empty() && out);
    if (isOther) return false;
    if (!op.empty()) {
      out = Comparison{std::string(trimmedPart(text.substr(0, at))), op,
                       std::string(trimmedPart(text.substr(at + op.size())))};
    }
    return true;
  });
  if (isOther) return {};
  return out;
}

std::vector<Limit> limitsOf(std::string_view condition) {
  std::vector<Limit> out;
  for (const std::string& part : conjunctsOf(condition)) {
    auto comparison = comparisonOf(part);
    if (!comparison) continue;
    if (const auto turnedOne = withNumberOnTheRight(*comparison)) comparison = turnedOne;
    const auto variable = variableIn(comparison->left);
    const auto value = numberIn(comparison->right);
    if (variable && value) out.push_back({*variable, comparison->op, *value});
  }
  return out;
}

}  // namespace pitchboard::telemetry
