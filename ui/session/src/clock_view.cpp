// SPDX-License-Identifier: GPL-3.0-or-later
#include "clock_view.h"

#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>

#include <ui/base/robot_text.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

/// s at the upper edge: the first in which nearly all points are.
double edgeOf(const link::ClockAgreement& agreement) {
  constexpr std::array<double, 5> edges{0.01, 0.025, 0.05, 0.1, link::ClockAgreement::window};
  const auto fits = [&](double edge) { return 2.0 * agreement.spread <= edge; };
  const auto* found = std::ranges::find_if(edges, fits);
  return found == edges.end() ? edges.back() : *found;
}

}  // namespace

ClockView::ClockView(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("clockView"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setMinimumHeight(scaled(this, 90));
  setAccessibleName(QStringLiteral("Distances of the changes over time"));
  setToolTip(QStringLiteral(
      "Each point is a change of a variable that both recordings have: by how much the session is "
      "later. With the right offset the points lie around 0; with the right drift they do so from "
      "the beginning to the end"));
}

QSize ClockView::sizeHint() const {
  return {scaled(this, 420), scaled(this, 150)};
}

void ClockView::show(const link::ClockAgreement& agreement) {
  m_agreement = agreement;
  update();
}

void ClockView::paintEvent(QPaintEvent* /*event*/) {
  QPainter p(this);
  p.fillRect(rect(), theme().view);
  p.setFont(themeFont(TypeRole::Secondary));
  const auto& points = m_agreement.points;
  p.setPen(theme().secondaryText);
  if (points.empty()) {
    p.drawText(rect(), Qt::AlignCenter, QStringLiteral("No changes agree"));
    return;
  }
  const QFontMetrics metrics = p.fontMetrics();
  const double edge = edgeOf(m_agreement);
  const QString most = QStringLiteral("+%1 ms").arg(numberText(1e3 * edge, 0));
  const QString least = numberText(-1e3 * edge, 0) + QStringLiteral(" ms");
  const int gap = scaled(this, 6), left = metrics.horizontalAdvance(most) + 2 * gap;
  const QRectF plot(left, gap + metrics.height() / 2.0, width() - left - 2 * gap,
                    height() - 2.0 * gap - 2.0 * metrics.height());
  const auto yOf = [&](double apart) {
    return plot.center().y() - plot.height() / 2.0 * std::clamp(apart / edge, -1.0, 1.0);
  };
  const auto label = [&](double apart, const QString& text) {
    p.drawText(QRectF(0, yOf(apart) - metrics.height() / 2.0, left - gap, metrics.height()),
               Qt::AlignRight | Qt::AlignVCenter, text);
  };
  label(edge, most);
  label(0.0, QStringLiteral("0"));
  label(-edge, least);
  const double begin = points.front().time, end = std::max(points.back().time, begin + 1e-3);
  const QRectF times(plot.left(), plot.bottom() + gap / 2.0, plot.width(), metrics.height());
  p.drawText(times, Qt::AlignLeft, clockText(begin));
  p.drawText(times, Qt::AlignRight, clockText(end));
  p.setPen(QPen(theme().innerLine, 1));
  p.drawRect(plot);
  p.setPen(QPen(theme().secondaryText, 1, Qt::DashLine));
  p.drawLine(QPointF(plot.left(), yOf(0.0)), QPointF(plot.right(), yOf(0.0)));
  p.setRenderHint(QPainter::Antialiasing);
  p.setPen(Qt::NoPen);
  p.setBrush(theme().accentLine);
  const double radius = scaled(this, 1.5);
  for (const link::ClockAgreement::Point& point : points) {
    const double x = plot.left() + plot.width() * (point.time - begin) / (end - begin);
    p.drawEllipse(QPointF(x, yOf(point.apart)), radius, radius);
  }
}

}  // namespace pitchboard::ui
