// SPDX-License-Identifier: GPL-3.0-or-later
#include "expression.h"

#include <muParser.h>

#include <QRegularExpression>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace pitchboard::ui {
namespace {

constexpr qsizetype longest = 2000;  // characters; a longer text is a mistake
constexpr const char* nameCharacters =
    "0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
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
double wrapped(double angle, double turn) {
  const double rest = std::remainder(angle, turn);
  return rest <= -turn / 2 ? rest + turn : rest;
}

tl::unexpected<Error> wrong(const QString& sentence) {
  return failure(ErrorCode::ParseError, sentence.toStdString());
}

}  // namespace

struct Expression::Private {
  mu::Parser parser;
  QStringList variables;
  std::vector<double> values;  // addresses are the parser's: never resized after parse()
  double time = 0.0;
};

Expression::Expression(std::unique_ptr<Private> made) : d(std::move(made)) {}
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;
Expression::~Expression() = default;

const QStringList& Expression::variables() const {
  return d->variables;
}

Result<Expression> Expression::parse(const QString& text) {
  if (text.trimmed().isEmpty()) return wrong(QStringLiteral("the expression is empty"));
  if (text.size() > longest) {
    return wrong(QStringLiteral("the expression is longer than %1 characters").arg(longest));
  }
  static const QRegularExpression assignment(QStringLiteral("(?<![=<>!])=(?!=)"));
  if (const auto found = assignment.match(text); found.hasMatch()) {
    return wrong(QStringLiteral("the '=' at character %1 would assign; '==' compares")
                     .arg(found.capturedStart() + 1));
  }
  // `{B1/odd name}` becomes an identifier that the parser can read.
  QString plain;
  QStringList braced;
  for (qsizetype i = 0; i < text.size(); ++i) {
    if (text[i] != QLatin1Char('{')) {
      plain += text[i];
      continue;
    }
    const qsizetype end = text.indexOf(QLatin1Char('}'), i);
    if (end < 0) return wrong(QStringLiteral("the brace at character %1 is not closed").arg(i + 1));
    const QString name = text.mid(i + 1, end - i - 1).trimmed();
    if (name.indexOf(QLatin1Char('/')) <= 0) {
      return wrong(
          QStringLiteral("{%1} is not GROUP/NAME, such as {B1/VISION_BALL_DIST}").arg(name));
    }
    plain += QStringLiteral("braced_%1").arg(braced.size());
    braced << name;
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
    parser.SetExpr(plain.toStdString());
    std::vector<std::pair<qsizetype, std::pair<std::string, QString>>> used;
    for (const auto& [identifier, address] : parser.GetUsedVar()) {
      if (identifier == "t") continue;
      const QString id = QString::fromStdString(identifier);
      QString name;
      if (id.startsWith(QLatin1String("braced_"))) {
        name = braced.value(id.mid(7).toInt());
      } else if (const qsizetype dot = id.indexOf(QLatin1Char('.')); dot > 0) {
        name = id.left(dot) + QLatin1Char('/') + id.mid(dot + 1);
      }
      if (name.isEmpty()) {
        return wrong(
            QStringLiteral("'%1' is not known; a variable is written with its group, such as "
                           "B1.VISION_BALL_DIST")
                .arg(id));
      }
      used.push_back({plain.indexOf(id), {identifier, name}});
    }
    if (used.empty())
      return wrong(QStringLiteral("there is no variable in it, such as B1.VISION_BALL_DIST"));
    std::sort(used.begin(), used.end());
    made->values.assign(used.size(), nan);
    for (std::size_t i = 0; i < used.size(); ++i) {
      parser.DefineVar(used[i].second.first, &made->values[i]);
      made->variables << used[i].second.second;
    }
    parser.DefineVar("t", &made->time);
    parser.Eval();  // finds what only shows with every name known, such as missing arguments
  } catch (const mu::Parser::exception_type& error) {
    QString what = QString::fromStdString(error.GetMsg());
    while (what.endsWith(QLatin1Char('.'))) what.chop(1);
    return wrong(QStringLiteral("cannot be read: %1").arg(what));
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

}  // namespace pitchboard::ui
