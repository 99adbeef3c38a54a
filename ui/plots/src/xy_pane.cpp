// SPDX-License-Identifier: GPL-3.0-or-later
#include "xy_pane.h"

#include <QChart>
#include <QImage>
#include <QLineSeries>
#include <QMenu>
#include <QMouseEvent>
#include <QPainter>
#include <QScatterSeries>
#include <QWheelEvent>
#include <algorithm>
#include <array>
#include <cmath>

#include <ui/base/theme.h>
#include <ui/sources/linked_time.h>

#include "time_gestures.h"
#include "value_chart.h"

namespace pitchboard::ui {
namespace {

constexpr std::size_t maxPoints = 8000;  // more do not show on a screen
constexpr int pixelsPerStepX = 64;       // px of the mock
constexpr int pixelsPerStepY = 24;
constexpr int roomBelow = 52;  // for the numbers and the title of the lower axis
constexpr int lowestXy = 170;  // lower ones cannot be read: the plots scroll instead
// A line with more breaks is shown as points: Qt needs a series for each stretch.
constexpr std::size_t maxStretches = 100;

/// Widens the axis that has more room, so that a unit is as long on both.
void equalize(ValueLimits& x, ValueLimits& y, QSizeF size) {
  const double perX = (x.high - x.low) / size.width();
  const double perY = (y.high - y.low) / size.height();
  const auto widen = [](ValueLimits& limits, double span) {
    const double middle = (limits.low + limits.high) / 2;
    limits = {middle - span / 2, middle + span / 2};
  };
  if (perX < perY)
    widen(x, perY * size.width());
  else
    widen(y, perX * size.height());
}

/// The title of an axis that also shows this variable: of several robots without their names, of
/// different variables none of them alone ("TRUE_X, BELIEF_X").
QString commonTitle(const QString& before, const QString& variable) {
  QString whole = curveName(variableCurve(variable));
  const QString column = variable.section(QLatin1Char('/'), 1);
  if (before.isEmpty() || before == whole) return whole;
  QStringList columns;
  for (const QString& name : before.split(QStringLiteral(", "))) {
    columns << name.section(QLatin1Char(' '), 0, 0);
  }
  if (!columns.contains(column)) columns << column;
  return columns.join(QStringLiteral(", "));
}

bool isFinite(const QPointF& point) {
  return std::isfinite(point.x()) && std::isfinite(point.y());
}

QImage dot(const QColor& color, double diameter, double ratio) {
  const int side = std::max(1, static_cast<int>(std::ceil(diameter * ratio)));
  QImage image(side, side, QImage::Format_ARGB32_Premultiplied);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing, true);
  painter.setPen(Qt::NoPen);
  painter.setBrush(color);
  painter.drawEllipse(QRectF(0, 0, side, side));
  return image;
}

}  // namespace

std::optional<std::vector<QList<QPointF>>> stretchesOf(const std::vector<QPointF>& points,
                                                       std::size_t most) {
  std::vector<QList<QPointF>> stretches;
  bool broken = true;
  for (const QPointF& point : points) {
    if (!isFinite(point)) {
      broken = true;
      continue;
    }
    if (broken) {
      if (stretches.size() == most) return {};
      stretches.emplace_back();
    }
    broken = false;
    stretches.back() << point;
  }
  return stretches;
}

std::vector<QPointF> xyPoints(const ColumnView& x, const ColumnView& y, telemetry::TimeRange range,
                              std::size_t most) {
  std::vector<QPointF> points;
  if (!x || !y || !x.group->hasEveryRow(range) || !y.group->hasEveryRow(range)) return points;
  const auto add = [&](double time, double value) {
    const auto other = y.group->at(y.column, time);
    points.emplace_back(value, other ? other->value : std::nan(""));
  };
  std::vector<telemetry::Sample> samples;
  if (x.group->samples(x.column, range, samples, most)) {
    points.reserve(samples.size());
    for (const telemetry::Sample& sample : samples) add(sample.time, sample.value);
    return points;
  }
  for (std::size_t i = 0; i < most; ++i) {
    const double time = range.begin + (range.end - range.begin) * static_cast<double>(i) /
                                          static_cast<double>(most - 1);
    if (const auto sample = x.group->at(x.column, time)) add(time, sample->value);
  }
  return points;
}

XyPane::XyPane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent)
    : PlotPane(feed, spec, parent), m_chart(new ValueChart(this)) {
  setSurface(m_chart);
  m_chart->setMinimumHeight(scaled(this, lowestXy));
  m_chart->labelX();
  m_chart->setRenderHint(QPainter::Antialiasing, true);
  m_chart->viewport()->installEventFilter(this);
  connect(m_chart, &ValueChart::resized, this, [this] { draw(); });
}

QWidget* XyPane::surface() const {
  return m_chart->viewport();
}
ValueLimits XyPane::xLimits() const {
  return m_chart->xLimits();
}
ValueLimits XyPane::yLimits() const {
  return m_chart->yLimits();
}
void XyPane::restyle() {
  m_chart->applyTheme();
}

void XyPane::draw() {
  m_points.clear();
  ValueLimits x{INFINITY, -INFINITY}, y{INFINITY, -INFINITY};
  QString xTitle, yTitle;
  const telemetry::TimeRange range = m_feed->time()->range();
  const auto include = [&x, &y](const std::vector<QPointF>& points) {
    for (const QPointF& point : points) {
      if (!isFinite(point)) continue;
      x = {std::min(x.low, point.x()), std::max(x.high, point.x())};
      y = {std::min(y.low, point.y()), std::max(y.high, point.y())};
    }
  };
  for (const Curve& curve : m_curves) {
    m_points.emplace_back();
    if (curve.isHidden()) continue;
    m_points.back() = xyPoints(curve.view(), curve.ordinate(), range, maxPoints);
    include(m_points.back());
    xTitle = commonTitle(xTitle, curve.spec().inputs.value(0));
    yTitle = commonTitle(yTitle, curve.spec().inputs.value(1));
  }
  m_comparedPoints.clear();
  for (const ComparedRows& session : m_feed->compared()) {
    for (const Curve& curve : m_curves) {
      const Curve::Compared* other = curve.compared(session);
      m_comparedPoints.emplace_back();
      if (other == nullptr) continue;
      m_comparedPoints.back() =
          xyPoints(other->view, other->ordinate, session.ownTime(range), maxPoints);
      include(m_comparedPoints.back());
    }
  }
  m_titles = {xTitle, m_spec.valueTitle.isEmpty() ? yTitle : m_spec.valueTitle};
  m_chart->setTitles(m_titles.first, m_titles.second);
  if (!layOutAxes(x, y)) return;
  showCurves();
  showMarkers();
}

const std::vector<QPointF>& XyPane::comparedPoints(std::size_t curve, std::size_t session) const {
  static const std::vector<QPointF> none;
  const std::size_t i = session * m_curves.size() + curve;
  return i < m_comparedPoints.size() ? m_comparedPoints[i] : none;
}

bool XyPane::layOutAxes(const ValueLimits& x, const ValueLimits& y) {
  // New numbers can need another width, which changes the room for the curves. The result does not
  // depend on the numbers before.
  constexpr int maxPasses = 3;
  int before = -1;
  for (int pass = 0; pass < maxPasses; ++pass) {
    const int wanted = std::max(left(), m_chart->wantedLeft());
    if (wanted == before) break;
    before = wanted;
    m_chart->setMargins(wanted, scaled(this, 5), right(), scaled(this, roomBelow));
    const QRectF area = m_chart->plotArea();
    if (area.isEmpty()) return false;
    const int stepsX = std::max(1, static_cast<int>(area.width()) / scaled(this, pixelsPerStepX));
    const int stepsY = std::max(1, static_cast<int>(area.height()) / scaled(this, pixelsPerStepY));
    if (m_fits) {
      const int room = scaled(this, frameRoom);
      m_x = niceLimits(x.low, x.high, stepsX, room / area.width()).limits;
      m_y = m_spec.autoValues ? niceLimits(y.low, y.high, stepsY, room / area.height()).limits
                              : m_spec.values;
      if (m_spec.equalScales) equalize(m_x, m_y, area.size());
    }
    m_chart->setAxes(m_x, labelStep(m_x, stepsX), m_y, labelStep(m_y, stepsY));
  }
  return true;
}

QPointF XyPane::toValue(const QPointF& view) const {
  const QRectF area = m_chart->plotArea();
  return {m_x.low + (view.x() - area.left()) / area.width() * (m_x.high - m_x.low),
          m_y.low + (area.bottom() - view.y()) / area.height() * (m_y.high - m_y.low)};
}

QLineSeries* XyPane::nextLine(std::size_t& used) {
  if (used == m_lines.size()) {
    removeMarkers();  // series lie in the order in which they came
    m_lines.push_back(new QLineSeries);
    m_chart->addSeries(m_lines.back());
  }
  return m_lines[used++];
}

void XyPane::showCurve(const CurveSpec& spec, const QColor& color, double width,
                       const std::vector<QPointF>& points, std::size_t& used, Qt::PenStyle pen) {
  const auto stretches =
      spec.style == CurveStyle::Points ? std::nullopt : stretchesOf(points, maxStretches);
  if (stretches) {
    const QPen stroke(color, points.size() > manyPoints ? 0.0 : width, pen);
    for (const QList<QPointF>& stretch : *stretches) {
      QLineSeries* line = nextLine(used);
      line->setPen(stroke);
      line->setPointsVisible(false);
      line->setLightMarker({});
      line->replace(stretch);
    }
    return;
  }
  QList<QPointF> finite;
  std::copy_if(points.begin(), points.end(), std::back_inserter(finite), isFinite);
  QLineSeries* dots = nextLine(used);
  dots->setPen(Qt::NoPen);
  dots->setPointsVisible(true);
  dots->setMarkerSize(2 * width);
  dots->setLightMarker(dot(color, 2 * width, devicePixelRatioF()));
  dots->replace(finite);
}

void XyPane::showCurves() {
  std::size_t used = 0;
  const auto widthOf = [this](const CurveSpec& spec) {
    return spec.width * scaled(this, 100) / 100.0;
  };
  // Below what is shown, and thinner.
  constexpr std::array pens{Qt::SolidLine, Qt::DashLine, Qt::DotLine, Qt::DashDotLine,
                            Qt::DashLine};
  for (std::size_t i = 0; i < m_comparedPoints.size(); ++i) {
    if (m_comparedPoints[i].empty()) continue;
    const std::size_t curve = i % m_curves.size();
    const CurveSpec& spec = m_curves[curve].spec();
    const ComparedLook look =
        comparedLook(m_feed->compared()[i / m_curves.size()], curve, m_curves[curve].color(),
                     palette().color(QPalette::Base));
    showCurve(spec, look.color, widthOf(spec) * look.width, m_comparedPoints[i], used,
              pens[static_cast<std::size_t>(look.dash)]);
  }
  for (std::size_t i = 0; i < m_curves.size(); ++i) {
    const CurveSpec& spec = m_curves[i].spec();
    const double width = widthOf(spec) * (isPointedOut(i) ? pointedOutWidth : 1.0);
    showCurve(spec, m_curves[i].color(), width, m_points[i], used, Qt::SolidLine);
  }
  for (std::size_t i = 0; i < m_lines.size(); ++i) m_lines[i]->setVisible(i < used);
}

void XyPane::removeMarkers() {
  for (QScatterSeries* marker : m_markers) {
    m_chart->chart()->removeSeries(marker);
    delete marker;
  }
  m_markers.clear();
}

void XyPane::showMarkers() {
  // Where it was at the cursor, or is now.
  const auto cursor = m_feed->time()->readAt();
  while (m_markers.size() < m_curves.size()) {
    m_markers.push_back(new QScatterSeries);
    m_chart->addSeries(m_markers.back());
  }
  for (std::size_t i = 0; i < m_markers.size(); ++i) {
    QScatterSeries* marker = m_markers[i];
    marker->setVisible(false);
    if (i >= m_curves.size() || m_curves[i].isHidden()) continue;
    const Curve& curve = m_curves[i];
    const auto x = curve.valueAt(cursor);
    const auto y = !curve.ordinate() ? std::nullopt
                   : cursor          ? curve.ordinate().group->at(curve.ordinate().column, *cursor)
                                     : curve.ordinate().group->latest(curve.ordinate().column);
    if (!x || !y || !isFinite({*x, y->value})) continue;
    marker->setColor(curve.color());
    marker->setBorderColor(theme().view);
    marker->setMarkerSize(2.0 * scaled(this, 4));
    marker->replace({{*x, y->value}});
    marker->setVisible(true);
  }
}

bool XyPane::eventFilter(QObject*, QEvent* event) {
  switch (event->type()) {
    case QEvent::Wheel: {
      auto* wheel = static_cast<QWheelEvent*>(event);
      wheel->accept();
      const QPointF anchor = toValue(wheel->position());
      const double factor = wheelFactor(wheel->angleDelta().y());
      const ValueLimits x{anchor.x() + (m_x.low - anchor.x()) * factor,
                          anchor.x() + (m_x.high - anchor.x()) * factor};
      const ValueLimits y{anchor.y() + (m_y.low - anchor.y()) * factor,
                          anchor.y() + (m_y.high - anchor.y()) * factor};
      const double size =
          std::max({std::abs(x.low), std::abs(x.high), std::abs(y.low), std::abs(y.high)});
      const double least = std::min(x.high - x.low, y.high - y.low);
      if (!(least > size * 1e-12) || size > 1e300) return true;
      m_x = x;
      m_y = y;
      m_fits = false;
      draw();
      return true;
    }
    case QEvent::MouseButtonPress:
      if (static_cast<QMouseEvent*>(event)->button() == Qt::RightButton) return false;
      m_last = static_cast<QMouseEvent*>(event)->position();
      m_dragging = true;
      return true;
    case QEvent::MouseMove: {
      if (!m_dragging) return false;
      const QPointF at = static_cast<QMouseEvent*>(event)->position();
      const QPointF by = toValue(m_last) - toValue(at);
      m_last = at;
      m_x = {m_x.low + by.x(), m_x.high + by.x()};
      m_y = {m_y.low + by.y(), m_y.high + by.y()};
      m_fits = false;
      draw();
      return true;
    }
    case QEvent::MouseButtonRelease:
      m_dragging = false;
      return false;
    case QEvent::MouseButtonDblClick:
      showAll();
      return true;
    default:
      return false;
  }
}

void XyPane::showAll() {
  m_fits = true;
  draw();
}

void XyPane::extendMenu(QMenu* menu) {
  QAction* equal = menu->addAction(QStringLiteral("Equal scales"));
  equal->setCheckable(true);
  equal->setChecked(m_spec.equalScales);
  connect(equal, &QAction::triggered, this, [this](bool on) {
    PaneSpec options = m_spec;
    options.equalScales = on;
    m_fits = true;
    setOptions(options);
  });
}

}  // namespace pitchboard::ui
