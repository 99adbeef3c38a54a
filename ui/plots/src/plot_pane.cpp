// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_pane.h"

#include <QContextMenuEvent>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include <ui/base/session_mark.h>
#include <ui/base/theme.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/shown_moment.h>

#include "chart_pane.h"
#include "curve_template.h"
#include "lane_pane.h"
#include "legend_bar.h"
#include "xy_pane.h"

namespace pitchboard::ui {
namespace {
constexpr int pointOutMilliseconds = 1500;
}  // namespace

PlotPane::PlotPane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent)
    : QWidget(parent),
      m_feed(feed),
      m_spec(spec),
      m_legend(new LegendBar(this)),
      m_column(new QVBoxLayout(this)) {
  setObjectName(QStringLiteral("plot"));
  m_spec.curves.clear();
  m_descriptions = spec.curves;
  m_right = scaled(this, rightMargin);
  expand();
  m_column->setContentsMargins(0, 0, 0, 0);
  m_column->setSpacing(0);
  m_column->addWidget(m_legend);
  connect(m_legend, &LegendBar::menuRequested, this, [this](int index, const QPoint& at) {
    const bool isOwn = index < static_cast<int>(m_curves.size());
    emit menuRequested(isOwn ? index : -1, at);
  });
  connect(m_legend, &LegendBar::toggled, this, [this](int index) {
    const LegendEntry entry = m_legend->entries().value(index);
    if (entry.session > 0)
      emit sessionToggled(entry.session);
    else
      toggleCurve(index);
  });
  connect(m_legend, &LegendBar::isolated, this, &PlotPane::showOnly);
  m_pointingOut.setSingleShot(true);
  m_pointingOut.setInterval(pointOutMilliseconds);
  connect(&m_pointingOut, &QTimer::timeout, this, [this] {
    m_pointedOut.reset();
    refresh();
  });
}

PlotPane::~PlotPane() = default;

void PlotPane::setSurface(QWidget* surface) {
  m_column->addWidget(surface, 1);
}

PaneSpec PlotPane::spec() const {
  PaneSpec all = m_spec;
  all.curves = m_descriptions;
  return all;
}

void PlotPane::setOptions(const PaneSpec& spec) {
  PaneSpec options = spec;
  options.curves.clear();
  options.kind = m_spec.kind;
  if (options == m_spec) return;
  m_spec = options;
  edited();
}

int PlotPane::freeColor() const {
  for (int number = 0;; ++number) {
    const auto uses = [number](const Curve& c) { return c.spec().colorNumber == number; };
    if (std::none_of(m_curves.begin(), m_curves.end(), uses)) return number;
  }
}

bool PlotPane::hasCurve(const CurveSpec& curve) const {
  return std::any_of(m_curves.begin(), m_curves.end(),
                     [&curve](const Curve& mine) { return sameData(mine.spec(), curve); });
}

void PlotPane::pointOut(const CurveSpec& curve) {
  for (std::size_t i = 0; i < m_curves.size(); ++i) {
    if (!sameData(m_curves[i].spec(), curve)) continue;
    const int index = static_cast<int>(i);
    m_pointedOut = m_curves[i].spec();
    m_pointingOut.start();
    if (m_curves[i].isHidden()) toggleCurve(index);
    refresh();
    m_legend->reveal(index);
    return;
  }
}

bool PlotPane::isPointedOut(std::size_t curve) const {
  return m_pointedOut && sameData(m_curves[curve].spec(), *m_pointedOut);
}

void PlotPane::addCurve(CurveSpec curve) {
  if (hasCurve(curve)) return;
  const auto taken = [&curve](const Curve& c) { return c.spec().colorNumber == curve.colorNumber; };
  if (std::any_of(m_curves.begin(), m_curves.end(), taken)) curve.colorNumber = freeColor();
  m_descriptions << curve;
  expand();
  edited();
}

void PlotPane::setCurve(int index, const CurveSpec& curve) {
  if (index < 0 || static_cast<std::size_t>(index) >= m_curves.size()) return;
  m_descriptions[m_describedBy[static_cast<std::size_t>(index)]] = curve;
  expand();
  edited();
}

void PlotPane::removeCurve(int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= m_curves.size()) return;
  m_descriptions.removeAt(m_describedBy[static_cast<std::size_t>(index)]);
  expand();
  edited();
}

void PlotPane::setDescriptions(const QList<CurveSpec>& curves) {
  m_descriptions = curves;
  expand();
}

const CurveSpec& PlotPane::description(int curve) const {
  return m_descriptions[m_describedBy[static_cast<std::size_t>(curve)]];
}

// Curves that go on keep what was computed for them.
void PlotPane::expand() {
  m_expandedFor = m_feed->looks();
  std::vector<Curve> before = std::exchange(m_curves, {});
  std::vector<bool> taken(before.size(), false);
  m_describedBy.clear();
  for (qsizetype d = 0; d < m_descriptions.size(); ++d) {
    for (const CurveSpec& wanted : curvesOf(m_descriptions[d], *m_feed)) {
      std::size_t i = 0;
      while (i < before.size() && (taken[i] || !sameData(before[i].spec(), wanted))) ++i;
      if (i < before.size()) {
        taken[i] = true;
        m_curves.push_back(std::move(before[i]));
        m_curves.back().setSpec(wanted);
      } else {
        m_curves.emplace_back(wanted);
      }
      m_describedBy.push_back(d);
    }
  }
  m_axes = planAxes(unitsOfCurves());
}

std::vector<AxisRequest> PlotPane::unitsOfCurves() const {
  std::vector<AxisRequest> all;
  for (const Curve& curve : m_curves)
    all.push_back({curve.unit(), curve.spec().side, curve.isWaiting()});
  return all;
}

bool PlotPane::canTake(const QString& unit) const {
  if (kind() != PaneKind::Chart) return true;
  std::vector<AxisRequest> all = unitsOfCurves();
  all.push_back({unit});
  return !planAxes(all).places.back().otherUnit;
}

void PlotPane::setHidden(int index, bool on) {
  const auto curve = static_cast<std::size_t>(index);
  QStringList& hidden = m_descriptions[m_describedBy[curve]].hidden;
  const QString name = m_curves[curve].name();
  hidden.removeAll(name);
  if (on) hidden << name;
}

void PlotPane::toggleCurve(int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= m_curves.size()) return;
  setHidden(index, !m_curves[static_cast<std::size_t>(index)].isHidden());
  expand();
  edited();
}

void PlotPane::showOnly(int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= m_curves.size()) return;
  // The first click of a double click on the only one that was shown has hidden it.
  const bool none = std::ranges::all_of(m_curves, &Curve::isHidden);
  for (int i = 0; i < static_cast<int>(m_curves.size()); ++i) setHidden(i, !none && i != index);
  expand();
  edited();
}

void PlotPane::edited() {
  refresh();
  emit changed();
}

void PlotPane::setEdges(int left, int right) {
  if (left == m_left && right == m_right) return;
  m_left = left;
  m_right = right;
  m_legend->setEdges(left, right);
  draw();
}

TimeAxis PlotPane::timeAxis() const {
  const double right = std::max(surface()->width() - m_right, m_left + 1);
  return {m_feed->time()->range(), static_cast<double>(m_left), right - m_left};
}

void PlotPane::refresh() {
  if (m_feed->looks() != m_expandedFor) expand();
  for (Curve& curve : m_curves) curve.update(*m_feed);
  m_axes = planAxes(unitsOfCurves());
  showValues();
  draw();
}

LegendEntry PlotPane::legendEntry(std::size_t index) const {
  const Curve& curve = m_curves[index];
  LegendEntry entry;
  entry.text = curve.name();
  entry.color = curve.color();
  entry.dash = curveDash(curve.spec().colorNumber);
  entry.hidden = curve.isHidden();
  entry.pointedOut = isPointedOut(index);
  entry.tip = curve.spec().expression.isEmpty() ? curve.spec().inputs.join(QStringLiteral(", "))
                                                : curve.spec().expression;
  if (!curve.note().isEmpty()) {
    entry.muted = true;
    entry.faulty = curve.isFaulty();
    entry.text = entry.faulty ? entry.text + QStringLiteral(": ") + curve.note() : curve.note();
    return entry;
  }
  if (m_feed->showsValues()) entry.value = curve.valueTextAt(m_feed->time()->readAt());
  const AxisPlan::Place& place = m_axes.places[index];
  const bool chart = kind() == PaneKind::Chart;
  QStringList side;
  if (chart && place.right) side << QStringLiteral("right");
  const QString axis = !chart ? QString() : place.right ? m_axes.right : m_axes.left;
  if (!curve.unit().isEmpty() && curve.unit() != axis)
    side << QStringLiteral("[%1]").arg(curve.unit());
  entry.side = side.join(QLatin1Char(' '));
  entry.odd = chart && place.otherUnit;
  if (entry.odd) {
    entry.tip += curve.unit().isEmpty()
                     ? QStringLiteral("\nIts unit is unknown, and both axes have one")
                     : QStringLiteral("\nNeither axis has the unit %1").arg(curve.unit());
  }
  return entry;
}

QList<LegendEntry> PlotPane::comparedEntries() const {
  QList<LegendEntry> entries;
  const auto cursor = m_feed->time()->readAt();
  for (const ComparedRows& session : m_feed->compared()) {
    if (session.isFuture()) continue;
    for (std::size_t i = 0; i < m_curves.size(); ++i) {
      const Curve& curve = m_curves[i];
      const Curve::Compared* other = curve.compared(session);
      if (curve.isHidden() || other == nullptr || (!other->view && !session.isHidden)) continue;
      const ComparedLook look = comparedLook(session, i, curve.color(), {});
      LegendEntry entry;
      entry.text = curve.name() + sessionMark(session.number);
      entry.color = look.color;
      entry.dash = look.dash;
      entry.hidden = session.isHidden;
      entry.session = session.id;
      entry.tip = session.caption;
      if (m_feed->showsValues() && other->view) {
        const double time = cursor.value_or(m_feed->time()->shown()->time());
        entry.value = valueTextIn(other->view, time - session.offset);
      }
      entries << entry;
    }
  }
  return entries;
}

void PlotPane::showValues() {
  m_legend->setVisible(wantsLegend());
  if (!wantsLegend()) return;
  QList<LegendEntry> entries;
  for (std::size_t i = 0; i < m_curves.size(); ++i) entries << legendEntry(i);
  entries << comparedEntries();
  const bool chart = kind() == PaneKind::Chart;
  m_legend->setTitle(m_spec.title);
  m_legend->setUnits(chart ? m_axes.left : QString(), chart ? m_axes.right : QString());
  m_legend->setEntries(entries);
}

void PlotPane::contextMenuEvent(QContextMenuEvent* event) {
  emit menuRequested(-1, event->globalPos());
}

void PlotPane::resizeEvent(QResizeEvent*) {
  draw();
}

void PlotPane::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() != QEvent::PaletteChange && event->type() != QEvent::FontChange) return;
  restyle();
  showValues();
  draw();
}

PlotPane* makePane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent) {
  switch (spec.kind) {
    case PaneKind::Lane:
      return new LanePane(feed, spec, parent);
    case PaneKind::Xy:
      return new XyPane(feed, spec, parent);
    case PaneKind::Chart:
      break;
  }
  return new ChartPane(feed, spec, parent);
}

}  // namespace pitchboard::ui
