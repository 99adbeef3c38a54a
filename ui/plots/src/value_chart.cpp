// SPDX-License-Identifier: GPL-3.0-or-later
#include "value_chart.h"

#include <QAbstractSeries>
#include <QChart>
#include <QGraphicsItem>
#include <QLegend>
#include <QPaintEngine>
#include <QPainter>
#include <QResizeEvent>
#include <QValueAxis>
#include <algorithm>
#include <cmath>
#include <vector>

#include <ui/base/quick_painting.h>
#include <ui/base/robot_words.h>
#include <ui/base/theme.h>

#include "side_by_side.h"

namespace pitchboard::ui {
namespace {

constexpr int mostLines = 200;  // more are no grid
constexpr int numberGap = 4;    // px between the plot and its numbers

/// The multiples of a step, counted from the anchor, within limits; rounding does not cost the
/// first or last.
std::vector<double> multiplesOf(double step, const ValueLimits& limits, double anchor) {
  std::vector<double> all;
  if (!(step > 0.0) || !(limits.high > limits.low) ||
      !((limits.high - limits.low) / step < mostLines))
    return all;
  const double slack = 1e-9;
  const auto first = std::ceil((limits.low - anchor) / step - slack);
  const auto last = std::floor((limits.high - anchor) / step + slack);
  for (double i = first; i <= last; ++i) all.push_back(anchor + i * step);
  return all;
}

}  // namespace

/// Keeps what it painted as a picture: a cursor that moves over it costs a copy. A file format
/// with lines (SVG) gets the lines.
class ValueChart::Layer : public QGraphicsItem {
 public:
  explicit Layer(QGraphicsItem* parent) : QGraphicsItem(parent) {}

  QRectF boundingRect() const override { return area; }
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override {
    if (!curves || area.isEmpty()) return;
    if (painter->paintEngine()->type() != QPaintEngine::Raster) {
      painter->setClipRect(area);
      curves(*painter);
      return;
    }
    const double ratio = painter->device()->devicePixelRatioF();
    const QSize size = (area.size() * ratio).toSize();
    if (size.isEmpty()) return;
    if (stale || ratio != paintedRatio) {
      paintParts(size, ratio);
      paintedRatio = ratio;
      stale = false;
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      painter->drawImage(area.topLeft() + QPointF(leftOf(i, size) / ratio, 0.0), parts[i]);
    }
  }

  void setArea(const QRectF& to) {
    prepareGeometryChange();
    area = to;
    stale = true;
  }

  QRectF area;
  Painter curves;
  Painting painting = Painting::Whole;
  bool stale = true;

 private:
  // Parts stand side by side. They are narrow so that one stays in a core's cache while it is
  // painted.
  static constexpr int partWidth = 120;  // px

  int leftOf(std::size_t part, const QSize& size) const {
    return static_cast<int>(static_cast<std::size_t>(size.width()) * part / parts.size());
  }
  void paintParts(const QSize& size, double ratio) {
    const int wanted = painting == Painting::Whole ? 1 : std::max(1, size.width() / partWidth);
    parts.resize(static_cast<std::size_t>(wanted));
    sideBySide(wanted, [&](int number) {
      const auto i = static_cast<std::size_t>(number);
      const int left = leftOf(i, size);
      const QSize own(leftOf(i + 1, size) - left, size.height());
      QImage& part = parts[i];
      if (part.size() != own) part = QImage(own, QImage::Format_ARGB32_Premultiplied);
      part.setDevicePixelRatio(ratio);
      part.fill(Qt::transparent);
      const QPointF from = area.topLeft() + QPointF(left / ratio, 0.0);
      QPainter inner(&part);
      inner.translate(-from);
      inner.setClipRect(QRectF(from, QSizeF(own) / ratio));
      curves(inner);
    });
  }

  std::vector<QImage> parts;
  double paintedRatio = 0.0;
};

ValueChart::ValueChart(QWidget* parent) : QChartView(new QChart, parent) {
  setFrameShape(NoFrame);
  setFocusPolicy(Qt::ClickFocus);  // no key does anything here, so that Tab need not stop
  setRubberBand(NoRubberBand);
  setAcceptDrops(false);  // the page takes drops for all its plots
  viewport()->setAcceptDrops(false);
  setContextMenuPolicy(Qt::NoContextMenu);  // the plot has one
  viewport()->setContextMenuPolicy(Qt::NoContextMenu);
  setMinimumSize(0, 0);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setOptimizationFlag(DontSavePainterState);
  setViewportUpdateMode(QGraphicsView::MinimalViewportUpdate);
  viewport()->setAutoFillBackground(false);  // drawBackground() covers everything
  viewport()->setAttribute(Qt::WA_OpaquePaintEvent);
  chart()->legend()->hide();
  chart()->setDropShadowEnabled(false);
  chart()->setMargins({});
  chart()->setBackgroundVisible(false);
  chart()->setContentsMargins(0, 0, 0, 0);
  chart()->layout()->setContentsMargins(0, 0, 0, 0);
  m_layer = new Layer(chart());
  m_layer->setZValue(100);
  redraw();
}

void ValueChart::setLabelsX(bool on) {
  m_labelsX = on;
}

// Series have their places from axes, which nobody sees.
void ValueChart::addSeries(QAbstractSeries* series) {
  if (m_axisX == nullptr) {
    m_axisX = new QValueAxis(this);
    m_axisY = new QValueAxis(this);
    chart()->addAxis(m_axisX, Qt::AlignBottom);
    chart()->addAxis(m_axisY, Qt::AlignLeft);
    m_axisX->setVisible(false);
    m_axisY->setVisible(false);
    m_axisX->setRange(m_x.low, m_x.high);
    m_axisY->setRange(m_y.low, m_y.high);
  }
  chart()->addSeries(series);
  series->attachAxis(m_axisX);
  series->attachAxis(m_axisY);
}

void ValueChart::setMargins(int left, int top, int right, int bottom) {
  const QMargins margins(left, top, right, bottom);
  if (margins == m_margins) return;
  m_margins = margins;
  place();
}

void ValueChart::resizeEvent(QResizeEvent* event) {
  QChartView::resizeEvent(event);
  place();
  emit resized();
}

void ValueChart::place() {
  const QRectF area = QRectF(rect()).marginsRemoved(m_margins);
  m_area = area.isValid() ? area : QRectF();
  if (m_area.isEmpty()) return;
  chart()->setPlotArea(m_area);
  if (m_axisX != nullptr) {
    // Series take the new place only with the next layout.
    chart()->layout()->invalidate();
    chart()->layout()->activate();
  }
  m_layer->setArea(m_area);
  redraw();
}

void ValueChart::setRightAxis(ValueLimits limits, double step) {
  m_right = limits;
  m_stepRight = step;
  m_hasRight = true;
}

void ValueChart::hideRightAxis() {
  m_hasRight = false;
}

int ValueChart::widestNumber(const ValueLimits& limits, double step) {
  const QFont font = themeFont(TypeRole::Small);
  const int decimals = decimalsOf(step);
  return static_cast<int>(std::ceil(std::max(wordsWidth(font, numberText(limits.low, decimals)),
                                             wordsWidth(font, numberText(limits.high, decimals)))));
}

int ValueChart::wantedRight() const {
  return widestNumber(m_right, m_stepRight) + scaled(this, m_titleRight.isEmpty() ? 10 : 28);
}

int ValueChart::wantedLeft() const {
  return widestNumber(m_y, m_stepY) + scaled(this, 10) +
         (m_titleY.isEmpty() ? 0 : scaled(this, 18));
}

void ValueChart::setAxes(ValueLimits x, double xStep, ValueLimits y, double yStep, double xAnchor) {
  m_x = x;
  m_stepX = xStep;
  m_anchorX = xAnchor;
  m_y = y;
  m_stepY = yStep;
  if (m_axisX != nullptr) {
    m_axisX->setRange(x.low, x.high);
    m_axisY->setRange(y.low, y.high);
  }
  viewport()->update();
}

void ValueChart::setTitles(const QString& x, const QString& y, const QString& right) {
  m_titleX = x;
  m_titleY = y;
  m_titleRight = right;
}

void ValueChart::setCurvePainter(Painter painter, Painting painting) {
  m_layer->curves = std::move(painter);
  m_layer->painting = painting;
  redraw();
}

void ValueChart::redraw() {
  m_layer->stale = true;
  viewport()->update();
}

void ValueChart::drawBackground(QPainter* painter, const QRectF& exposed) {
  painter->fillRect(exposed, theme().view);
  if (m_area.isEmpty()) return;
  const bool smooth = painter->testRenderHint(QPainter::Antialiasing);
  painter->setRenderHint(QPainter::Antialiasing, false);
  painter->setFont(themeFont(TypeRole::Small));
  paintAcross(*painter);
  paintUp(*painter, m_y, m_stepY, false);
  if (m_hasRight) paintUp(*painter, m_right, m_stepRight, true);
  paintTitles(*painter);
  painter->setRenderHint(QPainter::Antialiasing, smooth);
}

QColor ValueChart::gridColor() {
  const ThemeColors& colors = theme();
  return QColor((colors.innerLine.red() + colors.view.red()) / 2,
                (colors.innerLine.green() + colors.view.green()) / 2,
                (colors.innerLine.blue() + colors.view.blue()) / 2);
}

void ValueChart::paintAcross(QPainter& painter) const {
  const int decimals = decimalsOf(m_stepX);
  const double high = QFontMetricsF(painter.font()).height();
  double free = -1e9;  // up to where numbers stand already
  for (const double value : multiplesOf(m_stepX, m_x, m_anchorX)) {
    const double x =
        std::round(m_area.left() + (value - m_x.low) / (m_x.high - m_x.low) * m_area.width());
    painter.fillRect(QRectF(x, m_area.top(), 1, m_area.height()), gridColor());
    if (!m_labelsX) continue;
    const QString words = numberText(value, decimals);
    const double half = wordsWidth(painter.font(), words) / 2;
    if (x - half < free) continue;
    free = x + half + numberGap;
    painter.setPen(theme().secondaryText);
    drawWords(painter, QRectF(x - half, m_area.bottom() + numberGap, 2 * half, high),
              Qt::AlignHCenter | Qt::AlignTop, words);
  }
}

void ValueChart::paintUp(QPainter& painter, const ValueLimits& limits, double step,
                         bool right) const {
  const int decimals = decimalsOf(step);
  const double high = QFontMetricsF(painter.font()).height();
  double free = 1e9;
  for (const double value : multiplesOf(step, limits, 0.0)) {
    const double y = std::round(m_area.bottom() - (value - limits.low) /
                                                      (limits.high - limits.low) * m_area.height());
    if (!right) {
      painter.fillRect(QRectF(m_area.left(), y, m_area.width(), 1), gridColor());
    }
    if (y + high / 2 > free) continue;
    free = y - high / 2;
    painter.setPen(theme().secondaryText);
    const QRectF place = right ? QRectF(m_area.right() + numberGap, y - high / 2,
                                        width() - m_area.right() - numberGap, high)
                               : QRectF(0, y - high / 2, m_area.left() - numberGap, high);
    drawWords(painter, place, (right ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter,
              numberText(value, decimals));
  }
}

void ValueChart::paintTitles(QPainter& painter) const {
  painter.setPen(theme().secondaryText);
  const double high = QFontMetricsF(painter.font()).height();
  if (!m_titleX.isEmpty()) {
    painter.drawText(QRectF(m_area.left(), height() - high - 1, m_area.width(), high),
                     Qt::AlignCenter, m_titleX);
  }
  const auto upright = [&](const QString& title, double x, double turn) {
    if (title.isEmpty()) return;
    painter.save();
    painter.translate(x, m_area.center().y());
    painter.rotate(turn);
    painter.drawText(QRectF(-m_area.height() / 2, -high / 2, m_area.height(), high),
                     Qt::AlignCenter, title);
    painter.restore();
  };
  upright(m_titleY, high / 2 + 1, -90);
  if (m_hasRight) upright(m_titleRight, width() - high / 2 - 1, 90);
}

void ValueChart::drawForeground(QPainter* painter, const QRectF&) {
  if (m_area.isEmpty()) return;
  painter->setRenderHint(QPainter::Antialiasing, false);
  painter->setPen(theme().innerLine);
  painter->setBrush(Qt::NoBrush);
  painter->drawRect(m_area);
}

}  // namespace pitchboard::ui
