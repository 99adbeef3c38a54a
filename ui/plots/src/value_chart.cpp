// SPDX-License-Identifier: GPL-3.0-or-later
#include "value_chart.h"

#include <QChart>
#include <QGraphicsItem>
#include <QGraphicsLayout>
#include <QLegend>
#include <QLineSeries>
#include <QLocale>
#include <QPaintEngine>
#include <QPainter>
#include <QResizeEvent>
#include <QValueAxis>
#include <algorithm>
#include <cmath>
#include <vector>

#include <ui/base/robot_text.h>
#include <ui/base/theme.h>

#include "side_by_side.h"

namespace pitchboard::ui {
namespace {

/// Numbers as numberText() writes them, with a real minus sign and a point: what this locale has.
QLocale numbersLocale() {
  QLocale locale(QLocale::SwissGerman, QLocale::Switzerland);
  locale.setNumberOptions(QLocale::OmitGroupSeparator);
  return locale;
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
    painter->setPen(gridPen);
    painter->setRenderHint(QPainter::Antialiasing, false);
    for (const double x : grid) painter->drawLine(QLineF(x, area.top(), x, area.bottom()));
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
  std::vector<double> grid;  // lines of an x axis without numbers, in the view
  QPen gridPen;
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

ValueChart::ValueChart(QWidget* parent)
    : QChartView(new QChart, parent),
      m_axisX(new QValueAxis(this)),
      m_axisY(new QValueAxis(this)),
      m_axisRight(new QValueAxis(this)) {
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
  viewport()->setAutoFillBackground(false);  // the chart has a background
  viewport()->setAttribute(Qt::WA_OpaquePaintEvent);
  chart()->legend()->hide();
  chart()->setDropShadowEnabled(false);
  chart()->setMargins({});
  chart()->setBackgroundRoundness(0);
  chart()->setPlotAreaBackgroundVisible(true);
  chart()->setContentsMargins(0, 0, 0, 0);
  chart()->layout()->setContentsMargins(0, 0, 0, 0);
  chart()->setLocalizeNumbers(true);
  chart()->setLocale(numbersLocale());
  chart()->addAxis(m_axisX, Qt::AlignBottom);
  chart()->addAxis(m_axisY, Qt::AlignLeft);
  chart()->addAxis(m_axisRight, Qt::AlignRight);
  addSeries(new QLineSeries);  // axes are laid out by the domain of a series
  auto* atRight = new QLineSeries;
  chart()->addSeries(atRight);
  atRight->attachAxis(m_axisX);
  atRight->attachAxis(m_axisRight);
  m_axisRight->setVisible(false);
  m_axisRight->setGridLineVisible(false);
  for (QValueAxis* axis : {m_axisX, m_axisY, m_axisRight}) {
    axis->setLineVisible(false);
    axis->setTruncateLabels(false);  // wantedLeft() makes room for them
    axis->setTickType(QValueAxis::TicksDynamic);
  }
  m_axisX->setLabelsVisible(false);
  m_axisX->setGridLineVisible(false);
  m_layer = new Layer(chart());
  m_layer->setZValue(100);
  applyTheme();
}

void ValueChart::labelX() {
  m_axisX->setLabelsVisible(true);
  m_axisX->setGridLineVisible(true);
}

void ValueChart::addSeries(QAbstractSeries* series) {
  chart()->addSeries(series);
  series->attachAxis(m_axisX);
  series->attachAxis(m_axisY);
}

void ValueChart::applyTheme() {
  const ThemeColors& colors = theme();
  chart()->setBackgroundBrush(colors.view);
  chart()->setBackgroundPen(Qt::NoPen);
  chart()->setPlotAreaBackgroundBrush(colors.view);
  chart()->setPlotAreaBackgroundPen(QPen(colors.innerLine, 1));
  setBackgroundBrush(colors.view);
  QColor grid = colors.innerLine;
  grid.setRgb((grid.red() + colors.view.red()) / 2, (grid.green() + colors.view.green()) / 2,
              (grid.blue() + colors.view.blue()) / 2);
  for (QValueAxis* axis : {m_axisX, m_axisY, m_axisRight}) {
    axis->setGridLinePen(QPen(grid, 1));
    m_layer->gridPen = QPen(grid, 1);
    axis->setTitleFont(themeFont(TypeRole::Small));
    axis->setTitleBrush(colors.secondaryText);
    axis->setLabelsFont(themeFont(TypeRole::Small));
    axis->setLabelsBrush(colors.secondaryText);
  }
  redraw();
  viewport()->update();
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
  // Axes and grid take the new place only with the next layout.
  chart()->layout()->invalidate();
  chart()->layout()->activate();
  m_layer->setArea(m_area);
  placeGridX();
  redraw();
  viewport()->update();
}

void ValueChart::put(QValueAxis* axis, ValueLimits& now, const ValueLimits& to, double& step,
                     double toStep) {
  if (now == to && step == toStep) return;
  // While limits and step disagree Qt would make a grid line for every step of the new range.
  if (step != toStep) axis->setTickInterval(std::max(step, toStep));
  // Rounding must not cost the first or last number.
  const double slack = toStep * 1e-9;
  if (!(now == to)) axis->setRange(to.low - slack, to.high + slack);
  if (step != toStep) {
    axis->setTickInterval(toStep);
    axis->setLabelFormat(QStringLiteral("%.%1f").arg(decimalsOf(toStep)));
  }
  now = to;
  step = toStep;
  // Numbers that are elsewhere now would leave parts of themselves.
  viewport()->update();
}

void ValueChart::setRightAxis(ValueLimits limits, double step) {
  put(m_axisRight, m_right, limits, m_stepRight, step);
  if (!m_axisRight->isVisible()) {
    m_axisRight->setVisible(true);
    place();
  }
}

void ValueChart::hideRightAxis() {
  if (m_axisRight->isVisible()) m_axisRight->setVisible(false);
}

int ValueChart::wantedRight() const {
  const QFontMetrics metrics(themeFont(TypeRole::Small));
  const int decimals = decimalsOf(m_stepRight);
  return std::max(metrics.horizontalAdvance(numberText(m_right.low, decimals)),
                  metrics.horizontalAdvance(numberText(m_right.high, decimals))) +
         scaled(this, m_axisRight->titleText().isEmpty() ? 10 : 28);
}

void ValueChart::setAxes(ValueLimits x, double xStep, ValueLimits y, double yStep, double xAnchor) {
  if (m_axisX->labelsVisible()) {
    if (xAnchor != m_axisX->tickAnchor()) m_axisX->setTickAnchor(xAnchor);
    put(m_axisX, m_x, x, m_stepX, xStep);
  } else {
    m_x = x;
    m_stepX = xStep;
    m_anchorX = xAnchor;
    placeGridX();
  }
  put(m_axisY, m_y, y, m_stepY, yStep);
}

void ValueChart::placeGridX() {
  m_layer->grid.clear();
  const double span = m_x.high - m_x.low;
  if (m_axisX->labelsVisible() || !(m_stepX > 0.0) || !(span > 0.0)) return;
  // Rounding must not cost the first or last line.
  const double slack = m_stepX * 1e-9;
  const double first = std::ceil((m_x.low - slack - m_anchorX) / m_stepX);
  const double last = std::floor((m_x.high + slack - m_anchorX) / m_stepX);
  constexpr double most = 1000.0;  // of lines; none is needed where they cannot be told apart
  if (last - first > most) return;
  for (double i = first; i <= last; ++i) {
    const double time = m_anchorX + i * m_stepX;
    m_layer->grid.push_back(m_area.left() + (time - m_x.low) / span * m_area.width());
  }
}

void ValueChart::setTitles(const QString& x, const QString& y, const QString& right) {
  m_axisRight->setTitleText(right);
  m_axisRight->setTitleVisible(!right.isEmpty());
  m_axisX->setTitleText(x);
  m_axisY->setTitleText(y);
  m_axisX->setTitleVisible(!x.isEmpty());
  m_axisY->setTitleVisible(!y.isEmpty());
}

int ValueChart::wantedLeft() const {
  const QFontMetrics metrics(themeFont(TypeRole::Small));
  const int decimals = decimalsOf(m_stepY);
  const int widest = std::max(metrics.horizontalAdvance(numberText(m_y.low, decimals)),
                              metrics.horizontalAdvance(numberText(m_y.high, decimals)));
  const int title = m_axisY->titleText().isEmpty() ? 0 : scaled(this, 18);
  return widest + scaled(this, 10) + title;
}

void ValueChart::setCurvePainter(Painter painter, Painting painting) {
  m_layer->curves = std::move(painter);
  m_layer->painting = painting;
  redraw();
}

void ValueChart::redraw() {
  m_layer->stale = true;
  // Axes: see put().
  viewport()->update(m_area.toAlignedRect().adjusted(-1, -1, 1, 1));
}

void ValueChart::drawForeground(QPainter* painter, const QRectF&) {
  if (m_area.isEmpty()) return;
  painter->setRenderHint(QPainter::Antialiasing, false);
  painter->setPen(theme().innerLine);
  painter->setBrush(Qt::NoBrush);
  painter->drawRect(m_area);
}

}  // namespace pitchboard::ui
