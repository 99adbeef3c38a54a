// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/expression/expression.h>

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace pitchboard::telemetry {
namespace {

/// The name or character that is meant. muParser gives the rest of the text for some errors.
std::string shortToken(const std::string& token) {
  const auto isPart = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           c == '.';
  };
  std::size_t length = 0;
  while (length < token.size() && isPart(token[length])) ++length;
  if (length == 0 && !token.empty()) {
    length = 1;  // one character, which may have several bytes of UTF-8
    while (length < token.size() && (static_cast<unsigned char>(token[length]) & 0xC0U) == 0x80U) {
      ++length;
    }
  }
  return '\'' + token.substr(0, length) + '\'';
}

/// Returns a sentence without a full stop. `place` is the place of the mistake in the text that the
/// user wrote, such as "character 5".
std::string problemText(const mu::Parser::exception_type& error, const std::string& place) {
  const std::string token = shortToken(error.GetToken());
  const std::string at = " at " + place;
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
      return token + at + " is neither a function nor a variable";
    case mu::ecINVALID_CHARACTERS_FOUND:
      return "there is a character that cannot be used" + at;
    case mu::ecUNEXPECTED_EOF:
      return "the expression is incomplete: a value is missing at its end";
    case mu::ecUNEXPECTED_OPERATOR:
      return "the operator " + token + at + " has no value before it";
    case mu::ecUNEXPECTED_ARG_SEP:
      return "the ','" + at + " does not separate the arguments of a function";
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN:
      return "an operator is missing before " + token + at;
    case mu::ecUNEXPECTED_PARENS:
      return "the bracket " + token + at + " does not belong there";
    case mu::ecMISSING_PARENS:
      return "a ')' is missing";
    case mu::ecUNEXPECTED_ARG:
    case mu::ecTOO_MANY_PARAMS:
      return "the function " + token + at + " has too many arguments";
    case mu::ecTOO_FEW_PARAMS:
      return "the function " + token + at + " has too few arguments";
    case mu::ecUNEXPECTED_STR:
    case mu::ecSTRING_EXPECTED:
    case mu::ecVAL_EXPECTED:
    case mu::ecUNTERMINATED_STRING:
    case mu::ecOPRT_TYPE_CONFLICT:
    case mu::ecSTR_RESULT:
      return "an expression has no text in quotes" + at;
    case mu::ecUNEXPECTED_CONDITIONAL:
      return "the '?'" + at + " has no condition before it";
    case mu::ecMISSING_ELSE_CLAUSE:
      return "a ':' with the other value is missing after the '?'";
    case mu::ecMISPLACED_COLON:
      return "the ':'" + at + " has no '?' before it";
    case mu::ecIDENTIFIER_TOO_LONG:
      return "the name" + at + " is too long";
    default:
      return "the expression cannot be read" + at;
  }
}

constexpr std::size_t longest = 2000;  // bytes; a longer text is a mistake
constexpr const char* nameCharacters =
    "0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
constexpr std::string_view bracedName = "braced_";
constexpr std::string_view spaces = " \t\r\n";
constexpr const char* choiceName = "if_then_else";
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Unknown in, unknown out. The arithmetic of doubles does that by itself, but the comparisons,
// && and ||, the powers and some functions of muParser make a number of a NaN, so they are
// replaced here.
double ifKnown(double a, double b, double value) {
  return std::isunordered(a, b) ? nan : value;
}
double less(double a, double b) {
  return ifKnown(a, b, a < b);
}
double lessOrEqual(double a, double b) {
  return ifKnown(a, b, a <= b);
}
double greater(double a, double b) {
  return ifKnown(a, b, a > b);
}
double greaterOrEqual(double a, double b) {
  return ifKnown(a, b, a >= b);
}
double equal(double a, double b) {
  return ifKnown(a, b, a == b);
}
double unequal(double a, double b) {
  return ifKnown(a, b, a != b);
}
double both(double a, double b) {
  return ifKnown(a, b, a != 0.0 && b != 0.0);
}
double either(double a, double b) {
  return ifKnown(a, b, a != 0.0 || b != 0.0);
}
double negated(double value) {
  return ifKnown(value, value, value == 0.0);
}
double power(double base, double exponent) {
  if (exponent == 2.0) return base * base;
  return ifKnown(base, exponent, std::pow(base, exponent));
}
double hypotenuse(double a, double b) {
  return ifKnown(a, b, std::hypot(a, b));
}
double signOf(double value) {
  return ifKnown(value, value, (value > 0.0) - (value < 0.0));
}
double least(const double* values, int count) {
  double out = values[0];
  for (int i = 1; i < count; ++i) out = ifKnown(out, values[i], std::min(out, values[i]));
  return out;
}
double greatest(const double* values, int count) {
  double out = values[0];
  for (int i = 1; i < count; ++i) out = ifKnown(out, values[i], std::max(out, values[i]));
  return out;
}
/// `condition ? yes : no`. An unknown value counts only if it is chosen.
double choice(double condition, double yes, double no) {
  if (std::isnan(condition)) return nan;
  return condition != 0.0 ? yes : no;
}
double isKnown(double value) {
  return std::isnan(value) ? 0.0 : 1.0;
}

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}
double radians(double degrees_) {
  return degrees_ * std::numbers::pi / 180.0;
}
double wrapped(double angle, double turn) {
  const double rest = std::remainder(angle, turn);
  return rest <= -turn / 2 ? rest + turn : rest;
}

void define(mu::Parser& parser) {
  parser.DefineNameChars(nameCharacters);
  parser.DefineConst("pi", std::numbers::pi);
  parser.DefineFun("deg", degrees);
  parser.DefineFun("rad", radians);
  parser.DefineFun("hypot", hypotenuse);
  parser.DefineFun("wrap", wrapped);
  parser.DefineFun("known", isKnown);
  parser.DefineFun("min", least);
  parser.DefineFun("max", greatest);
  parser.DefineFun("sign", signOf);
  parser.DefineFun(choiceName, choice);
  parser.DefineInfixOprt("!", negated);
}

struct Operator {
  const char* name;
  double (*value)(double, double);
  mu::EOprtPrecedence precedence;
  mu::EOprtAssociativity associativity = mu::oaLEFT;
};
// A name that begins with another one stands in front of it.
constexpr Operator operators[] = {
    {"<=", lessOrEqual, mu::prCMP},
    {">=", greaterOrEqual, mu::prCMP},
    {"==", equal, mu::prCMP},
    {"!=", unequal, mu::prCMP},
    {"<", less, mu::prCMP},
    {">", greater, mu::prCMP},
    {"&&", both, mu::prLAND},
    {"||", either, mu::prLOR},
    {"^", power, mu::prPOW, mu::oaRIGHT},
};
/// In front of the name of an operator of ours; muParser would find its own first.
constexpr char ourMark = '~';

/// Copies `text` from `at` to the end of an operand (a bracket, comma or colon that closes it),
/// with our operators, and every `a ? b : c` as a call of choice(): muParser takes a NaN for a
/// condition that holds. muParser has accepted the text.
std::string withOurOperators(std::string_view text, std::size_t& at) {
  std::string out;
  while (at < text.size() && std::string_view("),:").find(text[at]) == std::string_view::npos) {
    const std::string_view rest = text.substr(at);
    const auto* ours = std::ranges::find_if(
        operators, [rest](const Operator& one) { return rest.starts_with(one.name); });
    if (ours != std::end(operators)) {
      out += ourMark + std::string(ours->name);
      at += std::string_view(ours->name).size();
      continue;
    }
    const char c = text[at++];
    if (c == '?') {
      const std::string yes = withOurOperators(text, at);
      ++at;  // the colon
      return std::string(choiceName) + '(' + out + ',' + yes + ',' + withOurOperators(text, at) +
             ')';
    }
    out += c;
    while (c == '(' && at < text.size()) {
      out += withOurOperators(text, at);
      if (at == text.size()) break;
      out += text[at];
      if (text[at++] == ')') break;
    }
  }
  return out;
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

/// The ',' that does not separate the arguments of a function.
std::optional<std::size_t> strayCommaIn(std::string_view text) {
  std::vector<bool> calls;  // of each open bracket: whether a name stands before it
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '{') {
      i = std::min(text.find('}', i), text.size());
    } else if (text[i] == '(') {
      const std::size_t before = i > 0 ? text.find_last_not_of(spaces, i - 1) : i;
      calls.push_back(before != std::string_view::npos &&
                      std::string_view(nameCharacters).find(text[before]) !=
                          std::string_view::npos);
    } else if (text[i] == ')' && !calls.empty()) {
      calls.pop_back();
    } else if (text[i] == ',' && (calls.empty() || !calls.back())) {
      return i;
    }
  }
  return {};
}

bool hasDecimalComma(std::string_view text) {
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] == ',' && isDigit(text[i - 1]) && isDigit(text[i + 1])) return true;
  }
  return false;
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

Result<Expression> Expression::parse(std::string_view text, std::string_view group) {
  if (trimmed(text).empty()) return wrong("the expression is empty");
  if (text.size() > longest) {
    return wrong("the expression is longer than " + std::to_string(longest) + " characters");
  }
  if (const std::size_t at = text.find('\0'); at != std::string_view::npos) {
    // muParser would read up to there and accept the rest unseen.
    return wrong("the character at " + placeOf(text, at) + " is not part of a text; remove it");
  }
  if (const auto at = assignmentIn(text)) {
    return wrong("the '=' at character " + placeOf(text, *at) + " would assign; '==' compares");
  }
  if (const auto at = strayCommaIn(text)) {
    return wrong("the ',' at character " + placeOf(text, *at) +
                 " does not separate arguments; write decimals with a point, such as 1.5");
  }
  // `{B1/odd name}` becomes an identifier that the parser can read.
  std::string plain;
  std::vector<std::string> braced;
  std::vector<std::pair<std::size_t, std::size_t>> closed;  // ends of braces, in `plain` and `text`
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
    closed.emplace_back(plain.size(), end + 1);
  }
  // Where something of `plain` stands in `text`.
  const auto written = [&](std::size_t at) {
    std::pair<std::size_t, std::size_t> before{0, 0};
    for (const auto& one : closed) {
      if (one.first <= at) before = one;
    }
    return std::min(before.second + (at - before.first), text.size());
  };
  auto made = std::make_unique<Private>();
  try {
    mu::Parser& parser = made->parser;
    define(parser);
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
      } else if (dot == std::string::npos && !group.empty()) {
        name = std::string(group) + '/' + identifier;
      }
      if (name.empty()) {
        return wrong('\'' + identifier +
                     "' is not known; a variable is written with its group, such as "
                     "B1.VISION_BALL_DIST");
      }
      used.push_back({plain.find(identifier), identifier, std::move(name)});
    }
    if (used.empty())
      return wrong("the expression contains no variable; add one, such as B1.VISION_BALL_DIST");
    std::sort(used.begin(), used.end());
    made->values.assign(used.size(), nan);
    for (std::size_t i = 0; i < used.size(); ++i) {
      parser.DefineVar(used[i].identifier, &made->values[i]);
      made->variables.push_back(std::move(used[i].name));
    }
    parser.DefineVar("t", &made->time);
    parser.Eval();  // finds what only shows with every name known, such as missing arguments
    for (const Operator& one : operators) {
      parser.DefineOprt(ourMark + std::string(one.name), one.value, one.precedence,
                        one.associativity);
    }
    std::size_t at = 0;
    parser.SetExpr(withOurOperators(plain, at));
    parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    auto position = static_cast<std::size_t>(error.GetPos());
    if (error.GetCode() == mu::ecMISPLACED_COLON && position > 0)
      --position;  // muParser names what follows
    if (error.GetCode() == mu::ecUNEXPECTED_PARENS) {
      // A name in front of a bracket is no function: muParser has taken it for a variable.
      const std::size_t end = std::min(position, plain.size());
      const std::size_t before = end > 0 ? plain.find_last_not_of(nameCharacters, end - 1) : end;
      const std::size_t begin = before == std::string::npos ? 0 : before + 1;
      if (begin < end && plain[end] == '(') {
        return wrong('\'' + plain.substr(begin, end - begin) + "' at character " +
                     placeOf(text, written(begin)) + " is neither a function nor a variable");
      }
    }
    const std::string what = problemText(error, "character " + placeOf(text, written(position)));
    if (text.find('%') != std::string_view::npos)
      return wrong(what + "; write a share as a number: 0.5 for 50 %");
    return wrong(what +
                 (hasDecimalComma(text) ? "; write decimals with a point, not a comma" : ""));
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
