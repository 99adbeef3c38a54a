// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve.h"

#include <cmath>

#include <ui/sources/linked_time.h>

#include "curve_trace.h"
#include "derived_series.h"

namespace pitchboard::ui {
namespace {

QString missingText(const QStringList& inputs, const PlotFeed& feed) {
  QString names = inputs.join(QStringLiteral(", "));
  // Words of a description that stands for a robot's curve; nobody chose that one by name.
  names.remove(QStringLiteral("first/")).remove(QStringLiteral("each/"));
  return (feed.source()->kind().hasPresent ? QStringLiteral("waiting for %1")
                                           : QStringLiteral("not recorded: %1"))
      .arg(names);
}

}  // namespace

Curve::Curve(const CurveSpec& spec) {
  setSpec(spec);
}
Curve::~Curve() = default;
Curve::Curve(Curve&&) noexcept = default;
Curve& Curve::operator=(Curve&&) noexcept = default;

void Curve::setSpec(const CurveSpec& spec) {
  const bool sameData = spec.kind == m_spec.kind && spec.inputs == m_spec.inputs &&
                        spec.expression == m_spec.expression &&
                        spec.parameter == m_spec.parameter && spec.offset == m_spec.offset &&
                        spec.unit == m_spec.unit;
  m_spec = spec;
  if (sameData && (m_derived || spec.kind == CurveKind::Variable)) return;
  m_view = m_ordinate = {};
  m_derived.reset();
  m_comparedDerived.reset();
  if (spec.kind != CurveKind::Variable) m_derived = std::make_unique<DerivedSeries>(spec);
}

void Curve::update(PlotFeed& feed) {
  m_note.clear();
  m_faulty = false;
  if (m_derived) {
    m_derived->update([&feed](const QString& name) { return feed.find(name); }, feed.generation(),
                      feed.time()->range());
    m_view = m_derived->view();
    m_note = m_derived->note();
    if (!m_derived->missing().isEmpty()) m_note = missingText(m_derived->missing(), feed);
    m_faulty = m_derived->isFaulty();
    return;
  }
  m_view = feed.find(m_spec.inputs.value(0));
  const bool two = m_spec.inputs.size() > 1;
  m_ordinate = two ? feed.find(m_spec.inputs[1]) : ColumnView{};
  if (two && !m_ordinate) m_view = {};
  if (!m_view) m_note = missingText(m_spec.inputs, feed);
}

ColumnView Curve::compared(PlotFeed& feed) {
  if (m_spec.kind == CurveKind::Variable) return feed.compared(m_spec.inputs.value(0));
  if (!feed.hasCompared()) {
    m_comparedDerived.reset();
    return {};
  }
  if (!m_comparedDerived) m_comparedDerived = std::make_unique<DerivedSeries>(m_spec);
  const telemetry::TimeRange shown = feed.time()->range();
  m_comparedDerived->update(
      [&feed](const QString& name) { return feed.compared(name); }, feed.comparedGeneration(),
      {shown.begin - feed.comparedOffset(), shown.end - feed.comparedOffset()});
  return m_comparedDerived->view();
}

ColumnView Curve::comparedOrdinate(const PlotFeed& feed) const {
  return m_spec.inputs.size() > 1 ? feed.compared(m_spec.inputs[1]) : ColumnView{};
}

bool Curve::isWorking() const {
  return (m_derived && m_derived->isWorking()) ||
         (m_comparedDerived && m_comparedDerived->isWorking());
}

QString Curve::unit() const {
  if (!m_spec.unit.isEmpty()) return m_spec.unit;
  return m_view ? QString::fromStdString(m_view.info().unit) : QString();
}

QColor Curve::color() const {
  return m_spec.color.isValid() ? m_spec.color : curveColor(m_spec.colorNumber);
}

std::optional<double> Curve::valueAt(std::optional<double> time) const {
  if (!m_view) return {};
  const auto sample =
      time ? m_view.group->at(m_view.column, *time) : m_view.group->latest(m_view.column);
  // What is no longer drawn is no longer said either.
  const bool old = sample && time && *time - sample->time > maxBridge;
  if (!sample || old || std::isnan(sample->value)) return {};
  return sample->value;
}

QString Curve::codeText(double value) const {
  if (!std::isfinite(value)) return QStringLiteral("–");
  const auto code = static_cast<std::int32_t>(std::lround(std::clamp(value, -2e9, 2e9)));
  if (m_view) {
    const auto& labels = m_view.info().labels;
    if (const auto word = labels.find(code); word != labels.end()) {
      return QString::fromStdString(word->second);
    }
    if (m_view.info().kind == telemetry::ColumnKind::Flag) {
      return code != 0 ? QStringLiteral("on") : QStringLiteral("off");
    }
  }
  return QString::number(code);
}

QString Curve::valueTextAt(std::optional<double> time) const {
  const auto value = valueAt(time);
  if (!value) return QStringLiteral("–");
  return m_view.isCoded() ? codeText(*value) : valueText(*value);
}

}  // namespace pitchboard::ui
