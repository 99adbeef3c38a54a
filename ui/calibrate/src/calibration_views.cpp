// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration_views.h"

#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>

#include <ui/base/field_ground.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr std::size_t maxWindowsShown = 30;

QColor recordedColour() {
  return theme().fieldLines;
}
QColor calibratedColour() {
  return theme().blueTeam;
}
QColor baseColour() {
  return theme().orangeTeam;
}

void paintLine(QPainter& p, const QPolygonF& line, const QColor& colour, double width) {
  p.setPen(QPen(colour, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  p.setBrush(Qt::NoBrush);
  p.drawPolyline(line);
  if (line.isEmpty()) return;
  p.setBrush(colour);
  p.setPen(Qt::NoPen);
  p.drawEllipse(line.last(), 2 * width, 2 * width);
}

/// Below the field, on the border of it.
void paintPredictionsLegend(QPainter& p, const QRect& room, const link::CalibrationCheck& check,
                            const QString& base) {
  const QFont font = themeFont(TypeRole::Secondary);
  p.setFont(font);
  const QFontMetrics metrics(font);
  const int line = metrics.height(), gap = line / 2;
  const std::array<std::pair<QColor, QString>, 3> entries{{
      {recordedColour(), QStringLiteral("recorded")},
      {calibratedColour(),
       QStringLiteral("calibrated, %1 cm off").arg(100.0 * check.rms, 0, 'f', 1)},
      {baseColour(),
       QStringLiteral("%1, %2 cm off").arg(base).arg(100.0 * check.rmsBase, 0, 'f', 1)},
  }};
  int x = room.left() + gap;
  const int y = room.top() + gap;
  for (const auto& [colour, text] : entries) {
    p.fillRect(QRect(x, y + line / 2 - 1, 2 * line, 3), colour);
    x += 2 * line + gap;
    // The ground is dark in both themes.
    p.setPen(theme().fieldLines);
    p.drawText(QRect(x, y, room.width(), line), Qt::AlignLeft | Qt::AlignVCenter, text);
    x += metrics.horizontalAdvance(text) + 2 * gap;
  }
}

}  // namespace

// ---- PredictionsView -------------------------------------------------------------------------

PredictionsView::PredictionsView(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("calibrationPredictions"));
  setToolTip(
      QStringLiteral("Each line is 5 s of the held-out part, predicted from the commands alone. "
                     "Errors are root mean squares at the end of all such windows."));
}

void PredictionsView::show(std::shared_ptr<const link::Calibration> calibration,
                           const sim::FieldSpec& field) {
  m_calibration = std::move(calibration);
  m_field = field;
  update();
}

void PredictionsView::paintEvent(QPaintEvent* /*event*/) {
  QPainter p(this);
  p.fillRect(rect(), theme().fieldBorder);
  if (!m_calibration) return;
  const link::CalibrationCheck& check = m_calibration->check;
  p.setFont(themeFont(TypeRole::Secondary));
  if (check.windows.empty()) {
    p.setPen(theme().fieldLines);
    p.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
               QStringLiteral("The robot never walked for 5 s in the held-out part."));
    return;
  }
  const int legend = 2 * p.fontMetrics().height();
  const QRect room = rect().adjusted(0, legend, 0, 0);
  const double wide = 2 * (m_field.halfLength() + m_field.border);
  const double high = 2 * (m_field.halfWidth() + m_field.border);
  const double scale = std::min(room.width() / wide, room.height() / high);
  p.setRenderHint(QPainter::Antialiasing);
  p.save();
  p.translate(QRectF(room).center());
  p.scale(scale, -scale);
  paintGround(p, m_field, m_field.lineWidth);
  const std::size_t count = std::min(maxWindowsShown, check.windows.size());
  for (std::size_t i = 0; i < count; ++i) {
    const link::PredictedWindow& window = check.windows[i * check.windows.size() / count];
    QPolygonF recorded, calibrated, base;
    for (const link::PredictedWindow::Place& place : window.places) {
      recorded << QPointF(place.recorded.x, place.recorded.y);
      calibrated << QPointF(place.calibrated.x, place.calibrated.y);
      base << QPointF(place.base.x, place.base.y);
    }
    paintLine(p, recorded, recordedColour(), 0.045);
    paintLine(p, base, baseColour(), 0.025);
    paintLine(p, calibrated, calibratedColour(), 0.025);
  }
  p.restore();
  paintPredictionsLegend(p, rect(), check, QString::fromStdString(m_calibration->base.name));
}

// ---- ResidualsView ---------------------------------------------------------------------------

ResidualsView::ResidualsView(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("calibrationResiduals"));
  setToolTip(QStringLiteral(
      "Measured minus expected by the calibrated model, divided by the model's standard "
      "deviation. Where the model is right, the bias is 0, the deviation 1, and the dots lie on "
      "the "
      "line."));
}

void ResidualsView::show(std::shared_ptr<const link::Calibration> calibration) {
  m_calibration = std::move(calibration);
  setMinimumHeight(m_calibration ? rowHeight() * static_cast<int>(m_calibration->residuals.size())
                                 : 0);
  update();
}

int ResidualsView::rowHeight() const {
  return scaled(this, 96);
}

void ResidualsView::paintEvent(QPaintEvent* /*event*/) {
  QPainter p(this);
  p.fillRect(rect(), theme().view);
  if (!m_calibration) return;
  p.setRenderHint(QPainter::Antialiasing);
  p.setFont(themeFont(TypeRole::Secondary));
  const int line = p.fontMetrics().height(), gap = scaled(this, 8);
  int top = 0;
  for (const link::CalibrationResiduals& one : m_calibration->residuals) {
    p.setPen(theme().text);
    p.drawText(QRect(gap, top + gap / 2, width() - 2 * gap, line), Qt::AlignLeft,
               QString::fromStdString(one.sense + ": " + link::residualsText(one)));
    const int side = rowHeight() - line - 2 * gap;
    const QRectF over(gap + line, top + line + gap, width() - 4 * gap - line - side, side);
    const QRectF dots(width() - gap - side, top + line + gap, side, side);
    p.setPen(QPen(theme().innerLine, 1));
    p.setBrush(Qt::NoBrush);
    p.drawRect(over);
    p.drawRect(dots);
    double most = 2.0;
    for (const double value : one.overTime) {
      if (std::isfinite(value)) most = std::max(most, value);
    }
    const auto y = [&](double value) { return over.bottom() - over.height() * value / most; };
    p.setPen(QPen(theme().secondaryText, 1, Qt::DashLine));
    p.drawLine(QPointF(over.left(), y(1.0)), QPointF(over.right(), y(1.0)));
    p.drawLine(dots.bottomLeft(), dots.topRight());
    p.setPen(theme().secondaryText);
    p.drawText(QRectF(0, y(1.0) - line / 2.0, over.left() - 4, line),
               Qt::AlignRight | Qt::AlignVCenter, QStringLiteral("1"));
    QPolygonF curve;
    for (std::size_t i = 0; i < one.overTime.size(); ++i) {
      if (!std::isfinite(one.overTime[i])) continue;
      const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(one.overTime.size());
      curve << QPointF(over.left() + over.width() * part, y(one.overTime[i]));
    }
    p.setPen(QPen(theme().accentLine, 1.5));
    p.drawPolyline(curve);
    p.setPen(Qt::NoPen);
    p.setBrush(theme().accentLine);
    const auto at = [&](double z) { return 0.5 + std::clamp(z, -3.0, 3.0) / 6.0; };
    for (std::size_t i = 0; i < one.quantiles.size(); ++i) {
      const double normal = -2.0 + 0.5 * static_cast<double>(i);
      p.drawEllipse(QPointF(dots.left() + dots.width() * at(normal),
                            dots.bottom() - dots.height() * at(one.quantiles[i])),
                    2.5, 2.5);
    }
    top += rowHeight();
  }
}

}  // namespace pitchboard::ui
