// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_pane.h"

#include <QContextMenuEvent>
#include <QVBoxLayout>
#include <algorithm>

#include <ui/base/theme.h>
#include <ui/sources/linked_time.h>

#include "chart_pane.h"
#include "lane_pane.h"
#include "legend_bar.h"
#include "xy_pane.h"

namespace pitchboard::ui {

PlotPane::PlotPane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent)
    : QWidget(parent),
      m_feed(feed),
      m_spec(spec),
      m_legend(new LegendBar(this)),
      m_column(new QVBoxLayout(this)) {
  setObjectName(QStringLiteral("plot"));
  m_spec.curves.clear();
  for (const CurveSpec& curve : spec.curves) m_curves.emplace_back(curve);
  m_column->setContentsMargins(0, 0, 0, 0);
  m_column->setSpacing(0);
  m_column->addWidget(m_legend);
  connect(m_legend, &LegendBar::menuRequested, this, &PlotPane::menuRequested);
  connect(m_legend, &LegendBar::activated, this, &PlotPane::editRequested);
}

PlotPane::~PlotPane() = default;

void PlotPane::setSurface(QWidget* surface) {
  m_column->addWidget(surface, 1);
}

PaneSpec PlotPane::spec() const {
  PaneSpec all = m_spec;
  for (const Curve& curve : m_curves) all.curves << curve.spec();
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
  return std::any_of(m_curves.begin(), m_curves.end(), [&curve](const Curve& mine) {
    return mine.spec().kind == curve.kind && mine.spec().inputs == curve.inputs &&
           mine.spec().expression == curve.expression && mine.spec().parameter == curve.parameter &&
           mine.spec().offset == curve.offset;
  });
}

void PlotPane::addCurve(CurveSpec curve) {
  if (hasCurve(curve)) return;
  const auto taken = [&curve](const Curve& c) { return c.spec().colorNumber == curve.colorNumber; };
  if (std::any_of(m_curves.begin(), m_curves.end(), taken)) curve.colorNumber = freeColor();
  m_curves.emplace_back(curve);
  edited();
}

void PlotPane::setCurve(int index, const CurveSpec& curve) {
  if (index < 0 || static_cast<std::size_t>(index) >= m_curves.size()) return;
  m_curves[static_cast<std::size_t>(index)].setSpec(curve);
  edited();
}

void PlotPane::removeCurve(int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= m_curves.size()) return;
  m_curves.erase(m_curves.begin() + index);
  edited();
}

void PlotPane::edited() {
  refresh();
  emit changed();
}

void PlotPane::setLeft(int left) {
  if (left == m_left) return;
  m_left = left;
  m_legend->setLeft(left, scaled(this, rightMargin));
  draw();
}

TimeAxis PlotPane::timeAxis() const {
  const double right = std::max(surface()->width() - scaled(this, rightMargin), m_left + 1);
  return {m_feed->time()->range(), static_cast<double>(m_left), right - m_left};
}

void PlotPane::refresh() {
  for (Curve& curve : m_curves) curve.update(*m_feed);
  showValues();
  draw();
}

void PlotPane::showValues() {
  m_legend->setVisible(wantsLegend());
  if (!wantsLegend()) return;
  QList<LegendEntry> entries;
  for (const Curve& curve : m_curves) {
    LegendEntry entry;
    entry.text = curve.name();
    if (!curve.note().isEmpty()) {
      entry.muted = true;
      entry.faulty = curve.isFaulty();
      entry.text = entry.faulty ? entry.text + QStringLiteral(": ") + curve.note() : curve.note();
    } else {
      if (!curve.unit().isEmpty()) entry.text += QStringLiteral(" [%1]").arg(curve.unit());
      entry.value = curve.valueTextAt(m_feed->time()->cursor());
    }
    entry.color = curve.color();
    entry.tip = curve.spec().inputs.join(QStringLiteral(", "));
    if (!curve.spec().expression.isEmpty()) entry.tip = curve.spec().expression;
    entries << entry;
  }
  m_legend->setTitle(m_spec.title);
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
