// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/expression/expression.h>

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace pitchboard::telemetry {
namespace {

constexpr std::size_t longest = 2000;  // bytes; a longer text is a mistake
constexpr const char* nameCharacters =
    "0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
constexpr std::string_view bracedName = "braced_";
constexpr std::string_view spaces = " \t\r\n";
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}
double radians(double degrees_) {
  return degrees_ * std::numbers::pi / 180.0;
}
double hypotenuse(double a, double b) {
  return std::hypot(a, b);
}
double negated(double value) {
  return value == 0.0 ? 1.0 : 0.0;
}
double wrapped(double angle, double turn) {
  const double rest = std::remainder(angle, turn);
  return rest <= -turn / 2 ? rest + turn : rest;
}

tl::unexpected<Error> wrong(std::string sentence) {
  return failure(ErrorCode::ParseError, std::move(sentence));
}

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(spaces);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(spaces) - first + 1));
}

/// Characters of UTF-8 in front of this byte, from 1: what a person counts.
std::string placeOf(std::string_view text, std::size_t at) {
  const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  return std::to_string(
      1 + std::count_if(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), begins));
}

/// The '=' that is no comparison.
std::optional<std::size_t> assignmentIn(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool after =
        i > 0 && std::string_view("=<>!").find(text[i - 1]) != std::string_view::npos;
    const bool before = i + 1 < text.size() && text[i + 1] == '=';
    if (!after && !before) return i;
  }
  return {};
}

}  // namespace

struct Expression::Private {
  mu::Parser parser;
  std::vector<std::string> variables;
  std::vector<double> values;  // addresses are the parser's: never resized after parse()
  double time = 0.0;
};

Expression::Expression(std::unique_ptr<Private> made) : d(std::move(made)) {}
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;
Expression::~Expression() = default;

const std::vector<std::string>& Expression::variables() const {
  return d->variables;
}

Result<Expression> Expression::parse(std::string_view text) {
  if (trimmed(text).empty()) return wrong("the expression is empty");
  if (text.size() > longest) {
    return wrong("the expression is longer than " + std::to_string(longest) + " characters");
  }
  if (const auto at = assignmentIn(text)) {
    return wrong("the '=' at character " + placeOf(text, *at) + " would assign; '==' compares");
  }
  // `{B1/odd name}` becomes an identifier that the parser can read.
  std::string plain;
  std::vector<std::string> braced;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '{') {
      plain += text[i];
      continue;
    }
    const std::size_t end = text.find('}', i);
    if (end == std::string_view::npos) {
      return wrong("the brace at character " + placeOf(text, i) + " is not closed");
    }
    std::string name = trimmed(text.substr(i + 1, end - i - 1));
    const std::size_t slash = name.find('/');
    if (slash == std::string::npos || slash == 0) {
      return wrong('{' + name + "} is not GROUP/NAME, such as {B1/VISION_BALL_DIST}");
    }
    plain += std::string(bracedName) + std::to_string(braced.size());
    braced.push_back(std::move(name));
    i = end;
  }
  auto made = std::make_unique<Private>();
  try {
    mu::Parser& parser = made->parser;
    parser.DefineNameChars(nameCharacters);
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineFun("deg", degrees);
    parser.DefineFun("rad", radians);
    parser.DefineFun("hypot", hypotenuse);
    parser.DefineFun("wrap", wrapped);
    parser.DefineInfixOprt("!", negated);
    parser.SetExpr(plain);
    struct Used {
      std::size_t at;
      std::string identifier, name;
      auto operator<=>(const Used&) const = default;
    };
    std::vector<Used> used;
    for (const auto& [identifier, address] : parser.GetUsedVar()) {
      if (identifier == "t") continue;
      std::string name;
      if (identifier.starts_with(bracedName)) {
        const std::string digits = identifier.substr(bracedName.size());
        const bool ours = !digits.empty() && digits.size() < 5 &&
                          digits.find_first_not_of("0123456789") == std::string::npos;
        const std::size_t index = ours ? std::stoul(digits) : braced.size();
        if (index < braced.size()) name = braced[index];
      } else if (const std::size_t dot = identifier.find('.');
                 dot != std::string::npos && dot > 0) {
        name = identifier.substr(0, dot) + '/' + identifier.substr(dot + 1);
      }
      if (name.empty()) {
        return wrong('\'' + identifier +
                     "' is not known; a variable is written with its group, such as "
                     "B1.VISION_BALL_DIST");
      }
      used.push_back({plain.find(identifier), identifier, std::move(name)});
    }
    if (used.empty()) return wrong("there is no variable in it, such as B1.VISION_BALL_DIST");
    std::sort(used.begin(), used.end());
    made->values.assign(used.size(), nan);
    for (std::size_t i = 0; i < used.size(); ++i) {
      parser.DefineVar(used[i].identifier, &made->values[i]);
      made->variables.push_back(std::move(used[i].name));
    }
    parser.DefineVar("t", &made->time);
    parser.Eval();  // finds what only shows with every name known, such as missing arguments
  } catch (const mu::Parser::exception_type& error) {
    std::string what = error.GetMsg();
    while (what.ends_with('.')) what.pop_back();
    return wrong("cannot be read: " + what);
  }
  return Expression(std::move(made));
}

double Expression::evaluate(double time, std::span<const double> values) {
  std::copy_n(values.begin(), std::min(values.size(), d->values.size()), d->values.begin());
  d->time = time;
  try {
    return d->parser.Eval();
  } catch (const mu::Parser::exception_type&) {
    return nan;  // a division by zero in integers, for one
  }
}

}  // namespace pitchboard::telemetry
