// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/expression/expression_unit.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include <base/units.h>

namespace pitchboard::telemetry {
namespace {

constexpr double unknownNumber = std::numeric_limits<double>::quiet_NaN();

/// "m/s" as m to the power of 1 and s to the power of -1; empty for a number without a unit.
using Powers = std::map<std::string, int, std::less<>>;

constexpr std::array<std::pair<std::string_view, int>, 2> superscripts{{{"²", 2}, {"³", 3}}};

/// In "m/s" both names have one power, in "m²" the name has two.
Powers powersOf(std::string_view unit) {
  constexpr std::string_view times = "·";
  Powers all;
  int sign = 1;
  while (!unit.empty()) {
    const std::size_t end = std::min(unit.find('/'), unit.find(times));
    std::string_view name = unit.substr(0, end);
    int power = 1;
    for (const auto& [mark, raised] : superscripts) {
      if (!name.ends_with(mark)) continue;
      name.remove_suffix(mark.size());
      power = raised;
    }
    if (name != "1" && !name.empty()) all[std::string(name)] += sign * power;
    if (end == std::string_view::npos) break;
    sign = unit[end] == '/' ? -1 : 1;
    unit.remove_prefix(end + (sign < 0 ? 1 : times.size()));
  }
  std::erase_if(all, [](const auto& one) { return one.second == 0; });
  return all;
}

std::string textOf(const Powers& powers) {
  const auto named = [](const std::string& name, int power) {
    if (power == 1) return name;
    const auto mark =
        std::ranges::find(superscripts, power, &std::pair<std::string_view, int>::second);
    if (mark != superscripts.end()) return name + std::string(mark->first);
    return name + '^' + std::to_string(power);
  };
  std::string above, below;
  const auto add = [&](const std::string& name, int power) {
    if (power > 0)
      above += (above.empty() ? "" : "·") + named(name, power);
    else
      below += '/' + named(name, -power);
  };
  // Seconds stand last: °·s.
  for (const auto& [name, power] : powers) {
    if (name != "s") add(name, power);
  }
  if (const auto seconds = powers.find("s"); seconds != powers.end()) add("s", seconds->second);
  return (above.empty() ? "1" : above) + below;
}

/// A value: a number of the text, which has any unit where it is added or compared; something with
/// a unit times a factor of the text; or something of which nothing is known.
struct Term {
  enum class Kind { Number, Measured, Unknown };
  Kind kind = Kind::Unknown;
  double number = 1.0;  ///< of Number its value, of Measured the factor; NaN: depends on functions
  Powers powers;
};

Term unknownTerm() {
  return {};
}
Term numberTerm(double value) {
  return {Term::Kind::Number, value, {}};
}
Term measuredTerm(Powers powers) {
  return {Term::Kind::Measured, 1.0, std::move(powers)};
}

bool isAbout(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::abs(b);
}

/// Gives the unit after its factor: cm × 0.01 is m, and cm × 0.5 is cm still. A power of ten that
/// converts to nothing known was meant to convert.
Term withoutFactor(Term term) {
  if (term.kind != Term::Kind::Measured) return term;
  const double factor = std::abs(term.number);
  term.number = 1.0;
  if (std::isnan(factor) || isAbout(factor, 1.0) || factor == 0.0) return term;
  for (const auto& [name, power] : term.powers) {
    if (power != 1) continue;
    for (const Unit& other : units) {
      const auto converts = unitFactor(name, other.name);
      if (!converts || name == other.name || !isAbout(*converts, factor)) continue;
      term.powers.erase(name);
      for (const auto& [part, itsPower] : powersOf(other.name)) term.powers[part] += itsPower;
      std::erase_if(term.powers, [](const auto& one) { return one.second == 0; });
      return term;
    }
  }
  const double tens = std::log10(factor);
  if (!term.powers.empty() && std::abs(tens - std::round(tens)) < 1e-9) return unknownTerm();
  return term;
}

/// The sum of both, or the greater one, or either.
Term sumOf(const Term& a, const Term& b) {
  const Term left = withoutFactor(a), right = withoutFactor(b);
  if (left.kind == Term::Kind::Unknown || right.kind == Term::Kind::Unknown) return unknownTerm();
  if (left.kind == Term::Kind::Number && right.kind == Term::Kind::Number) {
    return numberTerm(unknownNumber);
  }
  if (left.kind == Term::Kind::Number) return right;
  if (right.kind == Term::Kind::Number) return left;
  return left.powers == right.powers ? left : unknownTerm();
}

/// a × b, or a / b with a `sign` of -1.
Term productOf(const Term& a, const Term& b, int sign) {
  if (a.kind == Term::Kind::Unknown || b.kind == Term::Kind::Unknown) return unknownTerm();
  const bool isNumber = a.kind == Term::Kind::Number && b.kind == Term::Kind::Number;
  Term all{isNumber ? Term::Kind::Number : Term::Kind::Measured,
           sign > 0 ? a.number * b.number : a.number / b.number, a.powers};
  for (const auto& [name, power] : b.powers) all.powers[name] += sign * power;
  std::erase_if(all.powers, [](const auto& one) { return one.second == 0; });
  return all;
}

Term powerOf(const Term& base, double exponent) {
  if (base.kind == Term::Kind::Number) return numberTerm(std::pow(base.number, exponent));
  Term all = withoutFactor(base);
  for (auto& [name, power] : all.powers) {
    const double raised = power * exponent;
    if (!(std::abs(raised) < 100.0) || raised != std::round(raised)) return unknownTerm();
    power = static_cast<int>(raised);
  }
  std::erase_if(all.powers, [](const auto& one) { return one.second == 0; });
  return all;
}

Term callOf(std::string_view function, const std::vector<Term>& arguments) {
  const auto isOneOf = [function](std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, function) != names.end();
  };
  if (arguments.empty()) return unknownTerm();
  if (isOneOf({"deg"})) return measuredTerm({{"°", 1}});
  if (isOneOf({"rad", "asin", "acos", "atan", "atan2"})) return measuredTerm({{"rad", 1}});
  if (isOneOf({"sqrt"})) return powerOf(arguments[0], 0.5);
  if (isOneOf({"sign", "known", "sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "ln", "log",
               "log2", "log10"})) {
    const bool isNumber = arguments[0].kind == Term::Kind::Number;
    return isNumber ? numberTerm(unknownNumber) : measuredTerm({});
  }
  if (!isOneOf({"abs", "rint", "min", "max", "sum", "avg", "hypot", "wrap"})) return unknownTerm();
  Term all = withoutFactor(arguments[0]);
  for (std::size_t i = 1; i < arguments.size(); ++i) all = sumOf(all, arguments[i]);
  return all;
}

/// Reads an expression that muParser accepts. What it does not know makes the unit unknown.
class UnitReader {
 public:
  UnitReader(std::string_view text, const UnitOfVariable& unitOf)
      : m_text(text), m_unitOf(unitOf) {}

  Term read() {
    const Term all = choice();
    skipSpaces();
    return m_failed || m_at < m_text.size() ? unknownTerm() : withoutFactor(all);
  }

 private:
  static constexpr int deepest = 100;  // brackets in brackets

  Term choice() {
    const Term condition = either();
    if (!takes("?")) return condition;
    const Term yes = choice();
    if (!takes(":")) return failed();
    return sumOf(yes, choice());
  }
  Term either() {
    Term left = both();
    while (takes("||")) {
      both();
      left = measuredTerm({});
    }
    return left;
  }
  Term both() {
    Term left = comparison();
    while (takes("&&")) {
      comparison();
      left = measuredTerm({});
    }
    return left;
  }
  Term comparison() {
    Term left = sum();
    while (takes("==") || takes("!=") || takes("<=") || takes(">=") || takes("<") || takes(">")) {
      sum();
      left = measuredTerm({});
    }
    return left;
  }
  Term sum() {
    Term left = product();
    for (;;) {
      if (!takes("+") && !takes("-")) return left;
      left = sumOf(left, product());
    }
  }
  Term product() {
    Term left = factor();
    for (;;) {
      if (takes("*"))
        left = productOf(left, factor(), 1);
      else if (takes("/"))
        left = productOf(left, factor(), -1);
      else
        return left;
    }
  }
  Term factor() {
    if (takes("-") || takes("+")) return factor();
    if (takes("!")) {
      factor();
      return measuredTerm({});
    }
    const Term base = operand();
    if (!takes("^")) return base;
    const Term exponent = factor();
    return exponent.kind == Term::Kind::Number ? powerOf(base, exponent.number) : unknownTerm();
  }
  Term operand() {
    skipSpaces();
    if (takes("(")) return bracketed();
    if (takes("{")) {
      const std::size_t end = m_text.find('}', m_at);
      if (end == std::string_view::npos) return failed();
      std::string_view name = m_text.substr(m_at, end - m_at);
      m_at = end + 1;
      while (name.starts_with(' ')) name.remove_prefix(1);
      while (name.ends_with(' ')) name.remove_suffix(1);
      return variable(std::string(name));
    }
    if (m_at == m_text.size()) return failed();
    double number = 0.0;
    const char* const begin = m_text.data() + m_at;
    const auto [end, error] = std::from_chars(begin, m_text.data() + m_text.size(), number);
    if (error == std::errc() && *begin >= '.' && *begin <= '9') {
      m_at += static_cast<std::size_t>(end - begin);
      return numberTerm(number);
    }
    const std::string_view name = takeName();
    if (name.empty()) return failed();
    if (takes("(")) return call(name);
    if (name == "pi" || name == "_pi") return numberTerm(std::numbers::pi);
    if (name == "t") return measuredTerm({{"s", 1}});
    const std::size_t dot = name.find('.');
    if (dot == std::string_view::npos) return variable(std::string(name));
    return variable(std::string(name.substr(0, dot)) + '/' + std::string(name.substr(dot + 1)));
  }
  Term bracketed() {
    if (++m_depth > deepest) return failed();
    const Term inner = choice();
    --m_depth;
    return takes(")") ? inner : failed();
  }
  Term call(std::string_view function) {
    if (++m_depth > deepest) return failed();
    std::vector<Term> arguments;
    do arguments.push_back(choice());
    while (takes(","));
    --m_depth;
    return takes(")") ? callOf(function, arguments) : failed();
  }
  Term variable(const std::string& name) const {
    const auto unit = m_unitOf(name);
    return unit ? measuredTerm(powersOf(*unit)) : unknownTerm();
  }

  Term failed() {
    m_failed = true;
    m_at = m_text.size();
    return unknownTerm();
  }
  void skipSpaces() {
    while (m_at < m_text.size() &&
           std::string_view(" \t\r\n").find(m_text[m_at]) != std::string_view::npos)
      ++m_at;
  }
  bool takes(std::string_view token) {
    skipSpaces();
    if (!m_text.substr(m_at).starts_with(token)) return false;
    m_at += token.size();
    return true;
  }
  std::string_view takeName() {
    const std::size_t begin = m_at;
    const auto isPart = [](char c) {
      return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
             c == '_' || c == '.';
    };
    while (m_at < m_text.size() && isPart(m_text[m_at])) ++m_at;
    return m_text.substr(begin, m_at - begin);
  }

  std::string_view m_text;
  const UnitOfVariable& m_unitOf;
  std::size_t m_at = 0;
  int m_depth = 0;
  bool m_failed = false;
};

}  // namespace

std::optional<std::string> unitOfExpression(std::string_view text, const UnitOfVariable& unitOf) {
  const Term all = UnitReader(text, unitOf).read();
  if (all.kind == Term::Kind::Unknown) return std::nullopt;
  return textOf(all.powers);
}

std::string timesSeconds(std::string_view unit, int power) {
  if (unit.empty()) return {};
  Powers powers = powersOf(unit);
  powers["s"] += power;
  std::erase_if(powers, [](const auto& one) { return one.second == 0; });
  return textOf(powers);
}

}  // namespace pitchboard::telemetry
