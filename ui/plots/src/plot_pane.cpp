// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_pane.h"

#include <QContextMenuEvent>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include <ui/base/theme.h>
#include <ui/sources/linked_time.h>

#include "chart_pane.h"
#include "curve_template.h"
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
  m_descriptions = spec.curves;
  m_right = scaled(this, rightMargin);
  expand();
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
    const auto uses = [number](const Curve& c) {
      return c.spec().colorNumber % curveColors == number;
    };
    if (number == curveColors) return static_cast<int>(m_curves.size());
    if (std::none_of(m_curves.begin(), m_curves.end(), uses)) return number;
  }
}

bool PlotPane::hasCurve(const CurveSpec& curve) const {
  return std::any_of(m_curves.begin(), m_curves.end(),
                     [&curve](const Curve& mine) { return sameData(mine.spec(), curve); });
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
}

void PlotPane::edited() {
  refresh();
  emit changed();
}

void PlotPane::setEdges(int left, int right) {
  if (left == m_left && right == m_right) return;
  m_left = left;
  m_right = right;
  m_legend->setLeft(left, scaled(this, rightMargin));
  draw();
}

TimeAxis PlotPane::timeAxis() const {
  const double right = std::max(surface()->width() - m_right, m_left + 1);
  return {m_feed->time()->range(), static_cast<double>(m_left), right - m_left};
}

void PlotPane::refresh() {
  if (m_feed->looks() != m_expandedFor) expand();
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
      entry.value = curve.valueTextAt(m_feed->time()->readAt());
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
