// SPDX-License-Identifier: GPL-3.0-or-later
#include "line_charts.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include <ui/base/elide_text.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>

#include "statistics_text.h"

namespace pitchboard::ui {
namespace {

constexpr std::size_t mostStates = 12;  // with a bar; the others are in the tool tip of the cell
constexpr double barHeight = 18.0;      // px of the design
constexpr double chartHeight = 96.0;

QRectF chartArea(const QWidget* widget) {
  const QFontMetrics metrics(themeFont(TypeRole::Secondary));
  const double edge = scaled(widget, 6);
  return {edge, edge, widget->width() - 2 * edge, widget->height() - edge - metrics.height() - 2};
}

/// Bars are neutral: the accent is for what is chosen.
QColor barColor() {
  QColor color = theme().secondaryText;
  color.setAlphaF(0.65F);
  return color;
}

void paintFrame(QPainter& painter, const QRectF& area) {
  painter.fillRect(area, theme().view);
  painter.setPen(theme().innerLine);
  painter.drawRect(area);
}

/// Texts below the left end, the middle and the right end of a chart.
void paintEnds(QPainter& painter, const QRectF& area, const QString& left, const QString& middle,
               const QString& right) {
  const QFontMetricsF metrics(painter.font());
  const QRectF row(area.left(), area.bottom() + 2, area.width(), metrics.height());
  painter.setPen(theme().secondaryText);
  painter.drawText(row, Qt::AlignLeft | Qt::AlignVCenter, left);
  painter.drawText(row, Qt::AlignRight | Qt::AlignVCenter, right);
  const double ends =
      2 * std::max(metrics.horizontalAdvance(left), metrics.horizontalAdvance(right)) +
      metrics.horizontalAdvance(middle) + 4 * metrics.averageCharWidth();
  if (ends < area.width()) painter.drawText(row, Qt::AlignCenter, middle);
}

bool showTip(QWidget* widget, QEvent* event, const QString& text) {
  if (text.isEmpty()) {
    QToolTip::hideText();
  } else {
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), text, widget);
  }
  return true;
}

}  // namespace

DistributionChart::DistributionChart(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("distributionChart"));
  setAccessibleName(QStringLiteral("Distribution"));
}

void DistributionChart::show(const StatisticsRow& row) {
  m_row = row;
  // The most frequent states come first, as in the table.
  std::ranges::stable_sort(
      m_row.states, [](const auto& a, const auto& b) { return a.state->share > b.state->share; });
  setVisible(m_row.line.isCode ? !m_row.states.empty() : !m_row.line.counts.empty());
  updateGeometry();
  update();
}

std::size_t DistributionChart::shownStates() const {
  return std::min(m_row.states.size(), mostStates);
}

QSize DistributionChart::sizeHint() const {
  const double height =
      m_row.line.isCode ? barHeight * static_cast<double>(shownStates()) + 12.0 : chartHeight;
  return {scaled(this, 180), scaled(this, height)};
}

QRectF DistributionChart::area() const {
  return chartArea(this);
}

void DistributionChart::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setFont(themeFont(TypeRole::Secondary));
  if (m_row.line.isCode) {
    paintStates(painter);
  } else if (!m_row.line.counts.empty()) {
    paintBins(painter);
  }
}

void DistributionChart::paintBins(QPainter& painter) const {
  const QRectF area = this->area();
  const telemetry::CurveSummary& s = m_row.line.summary;
  const auto& counts = m_row.line.counts;
  paintFrame(painter, area);
  const auto most = static_cast<double>(*std::ranges::max_element(counts));
  const double width = area.width() / static_cast<double>(counts.size());
  const double room = area.height() - scaled(this, 4);
  painter.setPen(Qt::NoPen);
  painter.setBrush(barColor());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    // A single sample can be seen, too.
    const double height = std::max(1.0, room * static_cast<double>(counts[i]) / most);
    painter.drawRect(QRectF(area.left() + width * static_cast<double>(i), area.bottom() - height,
                            std::max(1.0, width - 1.0), height));
  }
  const auto at = [&](double value) {
    return area.left() + area.width() * (value - s.least) / (s.most - s.least);
  };
  if (s.most > s.least) {
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(theme().text, 1.4));
    painter.drawLine(QPointF(at(s.mean), area.top()), QPointF(at(s.mean), area.bottom()));
  }
  paintEnds(painter, area, shortValueText(s.least, m_row.line.unit),
            QStringLiteral("mean %1").arg(shortValueText(s.mean)),
            shortValueText(s.most, m_row.line.unit));
}

void DistributionChart::paintStates(QPainter& painter) const {
  const QFontMetricsF metrics(painter.font());
  const double edge = scaled(this, 6), height = scaled(this, barHeight);
  const double number = metrics.horizontalAdvance(QStringLiteral("100.0 %")) + edge;
  const double words = std::min(0.45 * width(), width() - 2 * edge - number - scaled(this, 40));
  const double room = width() - 2 * edge - words - number;
  for (std::size_t i = 0; i < shownStates(); ++i) {
    const telemetry::StretchLine& state = m_row.states[i];
    const QRectF row(edge, edge + height * static_cast<double>(i), width() - 2 * edge, height);
    painter.setPen(theme().text);
    painter.drawText(QRectF(row.left(), row.top(), words - edge, height),
                     Qt::AlignLeft | Qt::AlignVCenter,
                     elideText(metrics, stateName(state), words - edge));
    const QRectF bar(row.left() + words, row.top() + 3, room, height - 6);
    painter.fillRect(bar, theme().view);
    painter.fillRect(
        QRectF(bar.left(), bar.top(), std::max(1.0, room * state.state->share), bar.height()),
        barColor());
    painter.setPen(theme().innerLine);
    painter.drawRect(bar);
    painter.setPen(theme().text);
    painter.drawText(QRectF(bar.right(), row.top(), number, height),
                     Qt::AlignRight | Qt::AlignVCenter, percentText(state.state->share));
  }
}

QString DistributionChart::textAt(const QPoint& place) const {
  if (m_row.line.isCode) {
    const double row = (place.y() - scaled(this, 6)) / static_cast<double>(scaled(this, barHeight));
    const auto index = static_cast<std::size_t>(std::max(0.0, row));
    if (row < 0.0 || index >= shownStates()) return {};
    const telemetry::StretchLine& state = m_row.states[index];
    return QStringLiteral("%1: %2 of the known time, %3 samples")
        .arg(stateName(state), percentText(state.state->share), countText(state.state->samples));
  }
  const auto& counts = m_row.line.counts;
  const QRectF area = this->area();
  const double part = (place.x() - area.left()) / area.width();
  if (counts.empty() || part < 0.0 || part >= 1.0) return {};
  const auto bins = static_cast<double>(counts.size());
  const auto index = static_cast<std::size_t>(part * bins);
  const telemetry::CurveSummary& s = m_row.line.summary;
  const double width = (s.most - s.least) / bins;
  const double from = s.least + width * static_cast<double>(index);
  const auto all = static_cast<double>(std::max<std::uint64_t>(1, s.samples));
  return QStringLiteral("%1 to %2: %3 samples, %4")
      .arg(shortValueText(from), shortValueText(from + width, m_row.line.unit),
           countText(counts[index]), percentText(static_cast<double>(counts[index]) / all));
}

bool DistributionChart::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  return showTip(this, event, textAt(static_cast<QHelpEvent*>(event)->pos()));
}

DelayChart::DelayChart(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("delayChart"));
  setAccessibleName(QStringLiteral("Correlation over the delay"));
}

void DelayChart::show(const telemetry::CurveCorrelation& correlation) {
  m_correlation = correlation;
  update();
}

QSize DelayChart::sizeHint() const {
  return {scaled(this, 180), scaled(this, chartHeight)};
}

QRectF DelayChart::area() const {
  return chartArea(this);
}

double DelayChart::most() const {
  return 0.5 * m_correlation.step * static_cast<double>(m_correlation.byDelay.size() - 1);
}

void DelayChart::paintEvent(QPaintEvent*) {
  if (m_correlation.byDelay.size() < 2) return;
  QPainter painter(this);
  painter.setFont(themeFont(TypeRole::Secondary));
  const QRectF area = this->area();
  paintFrame(painter, area);
  const auto atDelay = [&](double delay) {
    return area.left() + area.width() * (delay / most() + 1.0) / 2.0;
  };
  const auto atCoefficient = [&](double coefficient) {
    return area.top() + area.height() * (1.0 - coefficient) / 2.0;
  };
  painter.drawLine(QPointF(area.left(), atCoefficient(0)), QPointF(area.right(), atCoefficient(0)));
  painter.drawLine(QPointF(atDelay(0), area.top()), QPointF(atDelay(0), area.bottom()));
  painter.setRenderHint(QPainter::Antialiasing);
  QPolygonF line;
  painter.setPen(QPen(theme().text, 1.4));
  for (std::size_t i = 0; i < m_correlation.byDelay.size(); ++i) {
    const double value = m_correlation.byDelay[i];
    if (std::isfinite(value)) {
      line << QPointF(atDelay(-most() + m_correlation.step * static_cast<double>(i)),
                      atCoefficient(value));
      continue;
    }
    painter.drawPolyline(line);
    line.clear();
  }
  painter.drawPolyline(line);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme().accentLine);
  const double radius = scaled(this, 3);
  painter.drawEllipse(
      QPointF(atDelay(m_correlation.delay), atCoefficient(m_correlation.coefficient)), radius,
      radius);
  paintEnds(painter, area, shortValueText(-most(), "s"), QStringLiteral("delay"),
            shortValueText(most(), "s"));
}

QString DelayChart::textAt(const QPoint& place) const {
  const QRectF area = this->area();
  const double part = (place.x() - area.left()) / area.width();
  if (m_correlation.byDelay.size() < 2 || part < 0.0 || part > 1.0) return {};
  const auto last = static_cast<double>(m_correlation.byDelay.size() - 1);
  const auto index = static_cast<std::size_t>(std::lround(part * last));
  return QStringLiteral("Delay %1: correlation %2")
      .arg(shortValueText(-most() + m_correlation.step * static_cast<double>(index), "s"),
           shortValueText(m_correlation.byDelay[index]));
}

bool DelayChart::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  return showTip(this, event, textAt(static_cast<QHelpEvent*>(event)->pos()));
}

}  // namespace pitchboard::ui
