// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/plots/plot_layout.h>

#include <QJsonArray>
#include <array>
#include <cmath>
#include <span>

namespace pitchboard::ui {
namespace {

// Words in files: never change them.
constexpr std::array<const char*, 8> curveKinds{"variable",   "derivative", "integral",
                                                "average",    "difference", "wrap",
                                                "conversion", "expression"};
constexpr std::array<const char*, 4> styles{"line", "steps", "points", "line-and-points"};
constexpr std::array<const char*, 3> paneKinds{"chart", "lane", "xy"};
constexpr int formatVersion = 1;
constexpr int mostOfAnything = 200;  // pages, plots, curves: a file with more is not one of ours

using Words = std::span<const char* const>;

/// A missing word is the first one.
template <class Enum>
bool readWord(Words words, const QJsonValue& value, Enum& out) {
  const QString found = value.toString(QLatin1String(words.front()));
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (found != QLatin1String(words[i])) continue;
    out = static_cast<Enum>(i);
    return true;
  }
  return false;
}

template <class Enum>
QString word(Words words, Enum value) {
  return QLatin1String(words[static_cast<std::size_t>(value)]);
}

tl::unexpected<Error> wrong(const QString& where, const QString& sentence) {
  return failure(ErrorCode::ParseError, sentence.toStdString(), where.toStdString());
}

QJsonObject curveToJson(const CurveSpec& curve) {
  QJsonObject o{{"kind", word(curveKinds, curve.kind)},
                {"inputs", QJsonArray::fromStringList(curve.inputs)},
                {"colorNumber", curve.colorNumber},
                {"style", word(styles, curve.style)},
                {"width", curve.width}};
  if (!curve.expression.isEmpty()) o["expression"] = curve.expression;
  if (curve.parameter != 0.0) o["parameter"] = curve.parameter;
  if (curve.offset != 0.0) o["offset"] = curve.offset;
  if (!curve.unit.isEmpty()) o["unit"] = curve.unit;
  if (!curve.title.isEmpty()) o["title"] = curve.title;
  if (curve.color.isValid()) o["color"] = curve.color.name();
  return o;
}

Result<CurveSpec> curveFromJson(const QJsonObject& o, const QString& where) {
  CurveSpec curve;
  if (!readWord(curveKinds, o["kind"], curve.kind)) {
    return wrong(where + ".kind", QStringLiteral("'%1' is not a kind of curve that this version "
                                                 "knows")
                                      .arg(o["kind"].toString()));
  }
  if (!readWord(styles, o["style"], curve.style)) {
    return wrong(where + ".style",
                 QStringLiteral("'%1' is not a style of curve").arg(o["style"].toString()));
  }
  for (const QJsonValue& input : o["inputs"].toArray()) curve.inputs << input.toString();
  curve.expression = o["expression"].toString();
  const qsizetype wanted = curve.kind == CurveKind::Expression   ? 0
                           : curve.kind == CurveKind::Difference ? 2
                                                                 : 1;
  if (curve.inputs.size() < wanted || curve.inputs.size() > mostOfAnything) {
    return wrong(
        where + ".inputs",
        QStringLiteral("needs %1 variable name(s), not %2").arg(wanted).arg(curve.inputs.size()));
  }
  curve.parameter = o["parameter"].toDouble();
  curve.offset = o["offset"].toDouble();
  curve.unit = o["unit"].toString();
  curve.title = o["title"].toString();
  curve.colorNumber = qMax(0, o["colorNumber"].toInt());
  if (o.contains("color")) curve.color = QColor(o["color"].toString());
  curve.width = qBound(0.5, o["width"].toDouble(1.5), 10.0);
  return curve;
}

QJsonObject paneToJson(const PaneSpec& pane) {
  QJsonArray curves;
  for (const CurveSpec& curve : pane.curves) curves.append(curveToJson(curve));
  QJsonObject o{{"kind", word(paneKinds, pane.kind)}, {"share", pane.share}, {"curves", curves}};
  if (!pane.title.isEmpty()) o["title"] = pane.title;
  if (!pane.valueTitle.isEmpty()) o["valueTitle"] = pane.valueTitle;
  if (!pane.autoValues) o["values"] = QJsonArray{pane.values.low, pane.values.high};
  if (pane.equalScales) o["equalScales"] = true;
  return o;
}

Result<PaneSpec> paneFromJson(const QJsonObject& o, const QString& where) {
  PaneSpec pane;
  if (!readWord(paneKinds, o["kind"], pane.kind)) {
    return wrong(where + ".kind", QStringLiteral("'%1' is not a kind of plot that this version "
                                                 "knows")
                                      .arg(o["kind"].toString()));
  }
  pane.title = o["title"].toString();
  pane.valueTitle = o["valueTitle"].toString();
  pane.share = qBound(1, o["share"].toInt(100), 100'000);
  pane.equalScales = o["equalScales"].toBool();
  if (const QJsonArray values = o["values"].toArray(); !values.isEmpty()) {
    pane.autoValues = false;
    pane.values = {values.at(0).toDouble(), values.at(1).toDouble()};
    if (values.size() != 2 || !(pane.values.low < pane.values.high)) {
      return wrong(where + ".values", QStringLiteral("needs two numbers, the smaller one first"));
    }
  }
  const QJsonArray curves = o["curves"].toArray();
  if (curves.size() > mostOfAnything) return wrong(where, QStringLiteral("has too many curves"));
  for (qsizetype i = 0; i < curves.size(); ++i) {
    auto curve =
        curveFromJson(curves[i].toObject(), QStringLiteral("%1.curves[%2]").arg(where).arg(i));
    if (!curve) return tl::unexpected<Error>(curve.error());
    if (pane.kind == PaneKind::Xy && curve->inputs.size() != 2) {
      return wrong(where, QStringLiteral("an XY plot needs two variables for each curve"));
    }
    pane.curves << *curve;
  }
  return pane;
}

}  // namespace

QJsonObject toJson(const PlotLayout& layout) {
  QJsonArray pages;
  for (const PageSpec& page : layout.pages) {
    QJsonArray panes;
    for (const PaneSpec& pane : page.panes) panes.append(paneToJson(pane));
    pages.append(QJsonObject{{"name", page.name}, {"plots", panes}});
  }
  return {{"pitchboardPlots", formatVersion}, {"current", layout.current}, {"tabs", pages}};
}

Result<PlotLayout> layoutFromJson(const QJsonObject& object) {
  const int version = object["pitchboardPlots"].toInt();
  if (version != formatVersion) {
    return wrong(QStringLiteral("pitchboardPlots"),
                 version == 0 ? QStringLiteral("this is not a layout of plots")
                              : QStringLiteral("this layout has version %1, this program reads "
                                               "version %2")
                                    .arg(version)
                                    .arg(formatVersion));
  }
  PlotLayout layout;
  const QJsonArray pages = object["tabs"].toArray();
  if (pages.size() > mostOfAnything) {
    return wrong(QStringLiteral("tabs"), QStringLiteral("there are too many tabs"));
  }
  for (qsizetype i = 0; i < pages.size(); ++i) {
    const QJsonObject o = pages[i].toObject();
    PageSpec page{o["name"].toString(), {}};
    const QJsonArray panes = o["plots"].toArray();
    if (panes.size() > mostOfAnything) {
      return wrong(QStringLiteral("tabs[%1]").arg(i), QStringLiteral("there are too many plots"));
    }
    for (qsizetype p = 0; p < panes.size(); ++p) {
      auto pane =
          paneFromJson(panes[p].toObject(), QStringLiteral("tabs[%1].plots[%2]").arg(i).arg(p));
      if (!pane) return tl::unexpected<Error>(pane.error());
      page.panes << *pane;
    }
    layout.pages << page;
  }
  layout.current = qBound(0, object["current"].toInt(), qMax(0, int(layout.pages.size()) - 1));
  return layout;
}

CurveSpec variableCurve(const QString& name) {
  CurveSpec curve;
  curve.inputs << name;
  return curve;
}

QString curveName(const CurveSpec& curve) {
  if (!curve.title.isEmpty()) return curve.title;
  const auto shown = [&curve](qsizetype i) {
    const QString name = curve.inputs.value(i);
    const qsizetype slash = name.indexOf(QLatin1Char('/'));
    return slash < 0 ? name : name.mid(slash + 1) + QLatin1Char(' ') + name.left(slash);
  };
  switch (curve.kind) {
    case CurveKind::Variable:
      return shown(0);
    case CurveKind::Derivative:
      return QStringLiteral("d/dt ") + shown(0);
    case CurveKind::Integral:
      return QStringLiteral("∫ ") + shown(0);
    case CurveKind::MovingAverage:
      return QStringLiteral("mean %1 s %2").arg(curve.parameter).arg(shown(0));
    case CurveKind::Difference:
      return shown(0) + QStringLiteral(" \u2212 ") + shown(1);
    case CurveKind::WrapAngle:
      return QStringLiteral("wrapped ") + shown(0);
    case CurveKind::Conversion:
      return shown(0);
    case CurveKind::Expression:
      return curve.expression;
  }
  return {};
}

}  // namespace pitchboard::ui
