// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve_template.h"

#include <QRegularExpression>
#include <algorithm>
#include <functional>
#include <utility>

#include "expression.h"
#include "plot_feed.h"

namespace pitchboard::ui {
namespace {

const QString eachGroup = QStringLiteral("each");
const QString firstGroup = QStringLiteral("first");
const QString computedPrefix = QStringLiteral("curve/");
constexpr qsizetype maxCurves = 24;  // of one description: more cannot be told apart anyway

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

/// The expression as it was typed, with other names of its variables. All change at the same time:
/// two may exchange their names.
QString renamedExpression(const QString& typed,
                          const std::function<QString(const QString&)>& nameOf) {
  static const QRegularExpression plain(QStringLiteral("^[A-Za-z_]\\w*/[A-Za-z_][\\w.]*$"));
  static const QRegularExpression token(
      QStringLiteral("\\{\\s*([^{}]*?)\\s*\\}|(?<![\\w.])([A-Za-z_][\\w.]*)"));
  const auto parsed = PlotExpression::parse(typed);
  std::map<QString, QString> names;  // as they can be typed
  for (const QString& name : parsed ? parsed->variables() : QStringList()) {
    const QString present = nameOf(name);
    if (present == name) continue;
    const QString group = groupOf(present), column = present.mid(group.size() + 1);
    const QString now = plain.match(present).hasMatch() ? group + QLatin1Char('.') + column
                                                        : QStringLiteral("{%1}").arg(present);
    names[name] = names[QString(name).replace(QLatin1Char('/'), QLatin1Char('.'))] = now;
  }
  QString shown;
  qsizetype at = 0;
  for (auto found = token.globalMatch(typed); found.hasNext();) {
    const QRegularExpressionMatch match = found.next();
    const auto known = names.find(match.captured(1) + match.captured(2));
    if (known == names.end()) continue;
    shown += typed.mid(at, match.capturedStart() - at) + known->second;
    at = match.capturedEnd();
  }
  return shown + typed.mid(at);
}

/// A curve after groups and computed curves have got other names.
CurveSpec renamedCurve(const CurveSpec& curve, const GroupNames& groups, const GroupNames& curves) {
  const auto nameOf = [&](const QString& name) {
    const QString group = groupOf(name), rest = name.mid(group.size());
    if (group + QLatin1Char('/') == computedPrefix) {
      const auto other = curves.find(rest.mid(1));
      return other == curves.end() ? name : computedPrefix + other->second;
    }
    const auto now = groups.find(group);
    return now == groups.end() ? name : now->second + rest;
  };
  CurveSpec made = curve;
  for (QString& input : made.inputs) input = nameOf(input);
  if (!curve.expression.isEmpty()) made.expression = renamedExpression(curve.expression, nameOf);
  for (QString& hidden : made.hidden) {
    if (const auto other = curves.find(hidden); other != curves.end()) {
      hidden = other->second;
      continue;
    }
    // One curve of a description for every robot.
    const auto now = std::ranges::find_if(groups, [&hidden](const auto& group) {
      return hidden.endsWith(QLatin1Char(' ') + group.first);
    });
    if (now != groups.end()) hidden = hidden.chopped(now->first.size()) + now->second;
  }
  return made;
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
      named.title = renamedExpression(
          curve.expression, [&feed](const QString& name) { return feed.presentName(name); });
    }
    return {named};
  }
  QStringList groups;
  if (every)
    groups = feed.groupsWith(columns).mid(0, maxCurves);
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

PlotLayout renamedGroups(const PlotLayout& layout, const GroupNames& groups) {
  const auto each = [](PlotLayout& of, const auto& change) {
    for (PageSpec& page : of.pages) {
      for (PaneSpec& pane : page.panes) {
        for (CurveSpec& curve : pane.curves) change(curve);
      }
    }
  };
  // Curves without a title are named after their variables, and others may be made of them.
  GroupNames curves;
  constexpr int maxSteps = 8;
  for (int step = 0; step < maxSteps; ++step) {
    GroupNames now;
    PlotLayout before = layout;
    each(before, [&](const CurveSpec& curve) {
      const QString name = curveName(curve), other = curveName(renamedCurve(curve, groups, curves));
      if (name != other) now.emplace(name, other);
    });
    if (now == curves) break;
    curves = std::move(now);
  }
  PlotLayout made = layout;
  each(made, [&](CurveSpec& curve) { curve = renamedCurve(curve, groups, curves); });
  return made;
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
