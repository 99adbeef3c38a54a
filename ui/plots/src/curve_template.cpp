// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve_template.h"

#include <QRegularExpression>
#include <algorithm>

#include "expression.h"
#include "plot_feed.h"

namespace pitchboard::ui {
namespace {

const QString eachGroup = QStringLiteral("each");
const QString firstGroup = QStringLiteral("first");
constexpr qsizetype mostCurves = 24;  // of one description: more cannot be told apart anyway

QString groupOf(const QString& name) {
  return name.left(name.indexOf(QLatin1Char('/')));
}

bool isPlainName(const QString& group) {
  return group == eachGroup || group == firstGroup;
}

QStringList variablesOf(const CurveSpec& curve) {
  if (curve.kind != CurveKind::Expression) return curve.inputs;
  const auto expression = PlotExpression::parse(curve.expression);
  return expression ? expression->variables() : QStringList();
}

/// As it was typed, with the names that its variables have now.
QString presentExpression(const QString& typed, const PlotFeed& feed) {
  static const QRegularExpression identifier(QStringLiteral("^[A-Za-z_]\\w*$"));
  const auto parsed = PlotExpression::parse(typed);
  QString shown = typed;
  for (const QString& name : parsed ? parsed->variables() : QStringList()) {
    const QString present = feed.presentName(name);
    if (present == name) continue;
    const QString group = groupOf(present), column = present.mid(group.size() + 1);
    const QString now = identifier.match(group).hasMatch() ? group + QLatin1Char('.') + column
                                                           : QStringLiteral("{%1}").arg(present);
    const QString braced = QRegularExpression::escape(name);
    const QString plain = QRegularExpression::escape(QString(name).replace('/', '.'));
    shown.replace(QRegularExpression(QStringLiteral("\\{\\s*%1\\s*\\}").arg(braced)), now);
    shown.replace(QRegularExpression(QStringLiteral("(?<![\\w.{])%1(?![\\w.])").arg(plain)), now);
  }
  return shown;
}

CurveSpec ofGroup(const CurveSpec& curve, const QString& group, const PlotFeed& feed) {
  CurveSpec made = curve;
  for (QString& input : made.inputs) {
    const QString identifier = groupOf(input);
    if (!isPlainName(identifier)) continue;
    input = feed.presentName(group + input.mid(identifier.size()));
  }
  // Names of groups may have characters that only braces can hold.
  static const QRegularExpression plain(
      QStringLiteral("(?<![\\w.{])(?:each|first)\\.([A-Za-z_][\\w.]*)"));
  static const QRegularExpression braced(QStringLiteral("\\{\\s*(?:each|first)/"));
  made.expression.replace(braced, QStringLiteral("{") + group + QLatin1Char('/'));
  made.expression.replace(plain, QStringLiteral("{") + group + QStringLiteral("/\\1}"));
  if (!curve.title.isEmpty()) {
    made.title = curve.title + QLatin1Char(' ') + group;
  } else if (curve.kind == CurveKind::Expression) {
    made.title = curve.expression;
    made.title.remove(QStringLiteral("each.")).remove(QStringLiteral("first."));
    made.title += QLatin1Char(' ') + group;
  }
  return made;
}

}  // namespace

bool isTemplate(const CurveSpec& curve) {
  const QStringList names = variablesOf(curve);
  return std::any_of(names.begin(), names.end(),
                     [](const QString& name) { return isPlainName(groupOf(name)); });
}

QList<CurveSpec> curvesOf(const CurveSpec& curve, PlotFeed& feed) {
  QStringList columns;
  bool every = false;
  for (const QString& name : variablesOf(curve)) {
    const QString group = groupOf(name);
    if (!isPlainName(group)) continue;
    columns << name.mid(group.size() + 1);
    every = every || group == eachGroup;
  }
  if (columns.isEmpty()) {
    CurveSpec named = curve;
    for (QString& input : named.inputs) input = feed.presentName(input);
    if (curve.kind == CurveKind::Expression && curve.title.isEmpty()) {
      named.title = presentExpression(curve.expression, feed);
    }
    return {named};
  }
  QStringList groups;
  if (every)
    groups = feed.groupsWith(columns).mid(0, mostCurves);
  else if (const QString first = feed.firstGroup(columns); !first.isEmpty())
    groups << first;
  QList<CurveSpec> all;
  for (const QString& group : groups) {
    all << ofGroup(curve, group, feed);
    all.back().colorNumber += static_cast<int>(all.size()) - 1;
  }
  if (all.isEmpty()) all << curve;
  return all;
}

CurveSpec forEachGroup(const CurveSpec& curve) {
  CurveSpec made = curve;
  if (curve.inputs.isEmpty()) return made;
  const QString group = groupOf(curve.inputs.front());
  for (QString& input : made.inputs) {
    if (groupOf(input) != group) return curve;
    input = eachGroup + input.mid(group.size());
  }
  return made;
}

}  // namespace pitchboard::ui
