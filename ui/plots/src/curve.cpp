// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
  m_compared.clear();
  if (spec.kind != CurveKind::Variable) m_derived = std::make_unique<DerivedSeries>(spec);
}

void Curve::update(PlotFeed& feed) {
  m_note.clear();
  m_faulty = false;
  updateCompared(feed);
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

// Sessions that go on keep what was computed for them.
void Curve::updateCompared(const PlotFeed& feed) {
  std::vector<Compared> before = std::exchange(m_compared, {});
  for (const ComparedRows& session : feed.compared()) {
    Compared& now = m_compared.emplace_back(Compared{session.id, {}, {}});
    if (isHidden()) continue;
    if (m_spec.kind == CurveKind::Variable) {
      now.view = feed.find(session, m_spec.inputs.value(0));
      if (m_spec.inputs.size() < 2) continue;
      now.ordinate = feed.find(session, m_spec.inputs[1]);
      if (!now.ordinate) now.view = {};
      continue;
    }
    const auto known = std::ranges::find(before, session.id, &Compared::id);
    if (known != before.end()) now.derived = std::move(known->derived);
    if (!now.derived) now.derived = std::make_shared<DerivedSeries>(m_spec);
    now.derived->update([&](const QString& name) { return feed.find(session, name); },
                        session.generation, session.ownTime(feed.time()->range()));
    if (!session.isHidden) now.view = now.derived->view();
  }
}

const Curve::Compared* Curve::compared(const ComparedRows& session) const {
  const auto found = std::ranges::find(m_compared, session.id, &Compared::id);
  return found == m_compared.end() ? nullptr : &*found;
}

bool Curve::isWorking() const {
  return (m_derived && m_derived->isWorking()) ||
         std::ranges::any_of(m_compared, [](const Compared& session) {
           return session.derived && session.derived->isWorking();
         });
}

QString Curve::unit() const {
  if (!m_spec.unit.isEmpty()) return m_spec.unit;
  return m_view ? QString::fromStdString(m_view.info().unit) : QString();
}

QColor Curve::color() const {
  return m_spec.color.isValid() ? m_spec.color : curveColor(m_spec.colorNumber);
}

std::optional<double> valueIn(const ColumnView& view, std::optional<double> time) {
  if (!view) return {};
  const auto sample = time ? view.group->at(view.column, *time) : view.group->latest(view.column);
  // What is no longer drawn is no longer said either.
  const bool old = sample && time && *time - sample->time > maxBridge;
  if (!sample || old || std::isnan(sample->value)) return {};
  return sample->value;
}

QString codeTextIn(const ColumnView& view, double value) {
  if (!std::isfinite(value)) return QStringLiteral("–");
  const auto code = static_cast<std::int32_t>(std::lround(std::clamp(value, -2e9, 2e9)));
  if (view) {
    const auto& labels = view.info().labels;
    if (const auto word = labels.find(code); word != labels.end()) {
      return QString::fromStdString(word->second);
    }
    if (view.info().kind == telemetry::ColumnKind::Flag) {
      return code != 0 ? QStringLiteral("on") : QStringLiteral("off");
    }
  }
  return QString::number(code);
}

QString valueTextIn(const ColumnView& view, std::optional<double> time) {
  const auto value = valueIn(view, time);
  if (!value) return QStringLiteral("–");
  return view.isCoded() ? codeTextIn(view, *value) : valueText(*value);
}

std::optional<double> Curve::valueAt(std::optional<double> time) const {
  return valueIn(m_view, time);
}

QString Curve::codeText(double value) const {
  return codeTextIn(m_view, value);
}

QString Curve::valueTextAt(std::optional<double> time) const {
  return valueTextIn(m_view, time);
}

}  // namespace pitchboard::ui
