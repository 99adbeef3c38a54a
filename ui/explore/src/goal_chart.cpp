// SPDX-License-Identifier: GPL-3.0-or-later
#include "goal_chart.h"

#include <QPainter>
#include <algorithm>
#include <array>

#include <ui/base/theme.h>

namespace pitchboard::ui {

QColor teamLineColor(const std::optional<TeamColor>& team) {
  return team ? theme().team(*team) : theme().secondaryText;
}

GoalChart::GoalChart(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("goalChart"));
  setAccessibleName(QStringLiteral("Probability of a goal over time"));
}

QSize GoalChart::sizeHint() const {
  return {scaled(this, 200), scaled(this, 110)};
}

void GoalChart::show(const ExploredMoment* found, int second) {
  m_second = second;
  double most = 0.0;
  for (std::size_t side = 0; side < m_lines.size(); ++side) {
    Line& line = m_lines[side];
    line = {};
    if (found == nullptr) continue;
    line.team = found->teams[side];
    for (const link::ExploredTime& time : found->result.times) {
      line.shares.push_back(side == 0 ? time.goalLeft : time.goalRight);
      most = std::max(most, line.shares.back().high);
    }
  }
  constexpr std::array edges{0.05, 0.1, 0.2, 0.5};
  const auto fits = std::ranges::lower_bound(edges, most);
  m_most = fits == edges.end() ? 1.0 : *fits;
  update();
}

void GoalChart::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(themeFont(TypeRole::Secondary));
  const QFontMetrics metrics = painter.fontMetrics();
  const QString top = QStringLiteral("%1 %").arg(100.0 * m_most);
  const int left = metrics.horizontalAdvance(QStringLiteral("100 %")) + scaled(this, 4);
  const int below = metrics.height() + scaled(this, 2);
  const QRectF area(left, metrics.height() / 2.0, width() - left - scaled(this, 8),
                    height() - below - metrics.height() / 2.0);
  const auto at = [&](double second, double share) {
    return QPointF(area.left() + area.width() * second / Explorer::seconds,
                   area.bottom() - area.height() * share / m_most);
  };
  painter.fillRect(area, theme().view);
  painter.setPen(theme().innerLine);
  painter.drawRect(area);
  painter.drawLine(at(0, m_most / 2), at(Explorer::seconds, m_most / 2));
  painter.setPen(theme().secondaryText);
  const auto label = [&](double share, const QString& text) {
    painter.drawText(QRectF(0, at(0, share).y() - metrics.height() / 2.0, left - scaled(this, 4),
                            metrics.height()),
                     Qt::AlignRight | Qt::AlignVCenter, text);
  };
  label(m_most, top);
  label(0.0, QStringLiteral("0 %"));
  for (int second = 0; second <= Explorer::seconds; second += 10) {
    const QString text =
        second == Explorer::seconds ? QStringLiteral("%1 s").arg(second) : QString::number(second);
    const double wide = metrics.horizontalAdvance(text);
    const double x = std::min(at(second, 0).x() - wide / 2.0, width() - wide);
    painter.drawText(QPointF(x, height() - metrics.descent()), text);
  }
  for (const Line& line : m_lines) {
    if (line.shares.empty()) continue;
    QPolygonF band, middle;
    for (std::size_t i = 0; i < line.shares.size(); ++i) {
      const auto second = static_cast<double>(i);
      band << at(second, line.shares[i].high);
      middle << at(second, line.shares[i].value);
    }
    for (std::size_t i = line.shares.size(); i-- > 0;) {
      band << at(static_cast<double>(i), line.shares[i].low);
    }
    QColor fill = teamLineColor(line.team);
    painter.setPen(QPen(fill, 1.6));
    painter.drawPolyline(middle);
    fill.setAlphaF(0.22F);
    painter.setPen(Qt::NoPen);
    painter.setBrush(fill);
    painter.drawPolygon(band);
    painter.setBrush(Qt::NoBrush);
  }
  painter.setPen(QPen(theme().accentLine, 1.0));
  painter.drawLine(at(m_second, 0), at(m_second, m_most));
}

}  // namespace pitchboard::ui
