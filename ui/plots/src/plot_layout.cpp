// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/plots/plot_layout.h>

#include <QJsonArray>
#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include <base/lined_json.h>

namespace pitchboard::ui {
namespace {

// Words in files: never change them.
constexpr std::array<std::string_view, 8> curveKinds{"variable",   "derivative", "integral",
                                                     "average",    "difference", "wrap",
                                                     "conversion", "expression"};
constexpr std::array<std::string_view, 4> styles{"line", "steps", "points", "line-and-points"};
constexpr std::array<std::string_view, 3> sides{"unit", "left", "right"};
constexpr std::array<std::string_view, 3> paneKinds{"chart", "lane", "xy"};
constexpr const char* versionKey = "pitchboardPlots";
constexpr int formatVersion = 1;
constexpr std::size_t maxLayoutBytes = 4 << 20;  // a layout has some kilobytes
constexpr std::size_t mostOfAnything =
    200;  // pages, plots, curves: a file with more is not one of ours

/// A missing name is the first one; `what` as in "there is no style of curve ...".
template <class Enum, std::size_t N>
Enum readChoice(const JsonObject& object, std::string_view key,
                const std::array<std::string_view, N>& choices, std::string_view what) {
  return static_cast<Enum>(object.choice(key, choices, what).value_or(0));
}

QString textOf(const JsonObject& object, std::string_view key) {
  return QString::fromStdString(object.text(key, {}, maxLayoutBytes));
}

int wholeOf(const JsonObject& object, std::string_view key, int fallback, int least, int most) {
  constexpr int limit = std::numeric_limits<int>::max();
  return std::clamp(object.integer(key, fallback, -limit, limit), least, most);
}

/// Reads the entries of an array of objects, as long as nothing was wrong.
template <class Read>
void forEach(JsonReport& report, const JsonObject& object, std::string_view key, Read read) {
  const auto* items = object.array(key, mostOfAnything);
  for (std::size_t i = 0; items && i < items->size() && !report.failed(); ++i) {
    read(JsonObject(report, (*items)[i], object.pathOf(key, i)));
  }
}

template <class Enum, std::size_t N>
QString word(const std::array<std::string_view, N>& choices, Enum value) {
  const std::string_view found = choices[static_cast<std::size_t>(value)];
  return QLatin1String(found.data(), qsizetype(found.size()));
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
  if (curve.side != CurveSpec::Side::ByUnit) o["axis"] = word(sides, curve.side);
  if (!curve.hidden.isEmpty()) o["hidden"] = QJsonArray::fromStringList(curve.hidden);
  return o;
}

QStringList namesOf(const JsonObject& o, std::string_view key) {
  QStringList names;
  if (const auto* items = o.array(key, mostOfAnything)) {
    for (const JsonNode& item : *items) {
      if (item.kind != JsonNode::Kind::Text) o.fail(key, "must be names in quotes");
      names << QString::fromStdString(item.text);
    }
  }
  return names;
}

CurveSpec curveFrom(const JsonObject& o) {
  CurveSpec curve;
  curve.kind = readChoice<CurveKind>(o, "kind", curveKinds, "kind of curve");
  curve.style = readChoice<CurveStyle>(o, "style", styles, "style of curve");
  for (const QString& input : namesOf(o, "inputs")) {
    // Version 0.8 wrote `A|B` where Live called A otherwise.
    curve.inputs << input.section(QLatin1Char('|'), 0, 0);
  }
  curve.expression = textOf(o, "expression");
  const qsizetype wanted = curve.kind == CurveKind::Expression   ? 0
                           : curve.kind == CurveKind::Difference ? 2
                                                                 : 1;
  if (curve.inputs.size() < wanted) {
    o.fail("inputs", "needs " + std::to_string(wanted) + " variable name(s), not " +
                         std::to_string(curve.inputs.size()));
  }
  curve.parameter = o.number("parameter", 0.0, anyNumber);
  curve.offset = o.number("offset", 0.0, anyNumber);
  curve.unit = textOf(o, "unit");
  curve.title = textOf(o, "title");
  curve.colorNumber = wholeOf(o, "colorNumber", 0, 0, std::numeric_limits<int>::max());
  if (o.find("color")) curve.color = QColor(textOf(o, "color"));
  curve.side = readChoice<CurveSpec::Side>(o, "axis", sides, "value axis");
  // As versions up to 0.11 wrote it.
  if (o.boolean("rightAxis", false)) curve.side = CurveSpec::Side::Right;
  curve.hidden = namesOf(o, "hidden");
  curve.width = std::clamp(o.number("width", 1.5, anyNumber), 0.5, 10.0);
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
  if (!pane.rightTitle.isEmpty()) o["rightTitle"] = pane.rightTitle;
  if (!pane.autoRight) o["rightValues"] = QJsonArray{pane.right.low, pane.right.high};
  return o;
}

/// False: there are none, limits follow the curves.
bool readLimits(const JsonObject& o, std::string_view key, ValueLimits& limits) {
  const auto* values = o.array(key, mostOfAnything);
  if (values == nullptr || values->empty()) return false;
  limits = {values->front().number, values->back().number};
  if (values->size() != 2 || !(limits.low < limits.high)) {
    o.fail(key, "needs two numbers, the smaller first");
  }
  return true;
}

PaneSpec paneFrom(JsonReport& report, const JsonObject& o) {
  PaneSpec pane;
  pane.kind = readChoice<PaneKind>(o, "kind", paneKinds, "kind of plot");
  pane.title = textOf(o, "title");
  pane.valueTitle = textOf(o, "valueTitle");
  pane.share = wholeOf(o, "share", 100, 1, 100'000);
  pane.equalScales = o.boolean("equalScales", false);
  pane.rightTitle = textOf(o, "rightTitle");
  pane.autoValues = !readLimits(o, "values", pane.values);
  pane.autoRight = !readLimits(o, "rightValues", pane.right);
  forEach(report, o, "curves", [&](const JsonObject& entry) {
    pane.curves << curveFrom(entry);
    if (pane.kind == PaneKind::Xy && pane.curves.back().inputs.size() != 2) {
      entry.fail("inputs", "an XY plot needs two variables for each curve");
    }
  });
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
  return {{versionKey, formatVersion}, {"current", layout.current}, {"tabs", pages}};
}

Result<PlotLayout> layoutFromText(std::string_view text, std::string_view source) {
  JsonReport report(source);
  PlotLayout layout;
  if (const auto root = parseJson(text, report, maxLayoutBytes)) {
    const JsonObject object(report, *root, "");
    if (!object.find(versionKey)) {
      report.fail(root->line, {}, "this is not a layout of plots");
    }
    const int version = object.integer(versionKey, formatVersion, 0, 1'000'000);
    if (version != formatVersion) {
      object.fail(versionKey, "this layout has version " + std::to_string(version) +
                                  ", this program reads version " + std::to_string(formatVersion));
    }
    forEach(report, object, "tabs", [&](const JsonObject& tab) {
      PageSpec page{textOf(tab, "name"), {}};
      forEach(report, tab, "plots",
              [&](const JsonObject& plot) { page.panes << paneFrom(report, plot); });
      layout.pages << page;
    });
    layout.current = wholeOf(object, "current", 0, 0, qMax(0, int(layout.pages.size()) - 1));
  }
  if (report.failed()) return tl::unexpected<Error>(report.error());
  return layout;
}

bool sameData(const CurveSpec& a, const CurveSpec& b) {
  return a.kind == b.kind && a.inputs == b.inputs && a.expression == b.expression &&
         a.parameter == b.parameter && a.offset == b.offset && a.unit == b.unit;
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
    constexpr QLatin1String computed("curve/");
    if (name.startsWith(computed)) return name.mid(computed.size());
    const qsizetype slash = name.indexOf(QLatin1Char('/'));
    return slash < 0 ? name : name.mid(slash + 1) + QLatin1Char(' ') + name.left(slash);
  };
  switch (curve.kind) {
    case CurveKind::Variable: {
      if (curve.inputs.size() < 2) return shown(0);
      // Of an XY plot; the group stands once when both have it.
      const QString x = curve.inputs[0], y = curve.inputs[1];
      const qsizetype slash = y.indexOf(QLatin1Char('/'));
      const bool same = slash > 0 && x.startsWith(y.left(slash + 1));
      return QStringLiteral("%1 over %2").arg(same ? y.mid(slash + 1) : shown(1), shown(0));
    }
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
