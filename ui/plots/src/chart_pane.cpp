// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_pane.h"

#include <QHelpEvent>
#include <QMenu>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <ui/base/session_mark.h>
#include <ui/base/theme.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/note_board.h>
#include <ui/sources/note_layer.h>

#include "side_by_side.h"
#include "time_gestures.h"
#include "time_ruler.h"
#include "value_chart.h"

namespace pitchboard::ui {
namespace {
constexpr int pixelsPerValueStep = 18;  // px of the mock
constexpr int lowestChart = 54;         // lower ones cannot be read: the plots scroll instead

/// What notes on this curve belong to.
QString noteOwner(const Curve& curve, const PlotFeed& feed) {
  return curve.spec().kind == CurveKind::Variable && !curve.spec().inputs.isEmpty()
             ? feed.presentName(curve.spec().inputs[0])
             : curve.name();
}
}  // namespace

ChartPane::ChartPane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent)
    : PlotPane(feed, spec, parent), m_chart(new ValueChart(this)) {
  setSurface(m_chart);
  m_chart->viewport()->installEventFilter(this);
  m_chart->setMinimumHeight(scaled(this, lowestChart));
  m_gestures = new TimeGestures(m_chart->viewport(), feed->time(), [this] { return timeAxis(); });
  m_chart->setCurvePainter([this](QPainter& painter) { paintCurves(painter); },
                           ValueChart::Painting::Parts);
  connect(m_chart, &ValueChart::resized, this, [this] { draw(); });
  connect(m_gestures, &TimeGestures::pointed, this, &PlotPane::pointed);
  connect(m_gestures, &TimeGestures::valueZoomed, this, [this](double factor, double y) {
    const ValueScale scale = valueScale();
    const double anchor = scale.toValue(y);
    setValues({anchor + (scale.limits.low - anchor) * factor,
               anchor + (scale.limits.high - anchor) * factor});
  });
  connect(m_gestures, &TimeGestures::valuePanned, this, [this](double pixels) {
    // Automatic limits follow the curves; only limits set by hand are moved by hand.
    if (m_spec.autoValues) return;
    const ValueScale scale = valueScale();
    const double by = pixels / (scale.bottom - scale.top) * (scale.limits.high - scale.limits.low);
    setValues({scale.limits.low + by, scale.limits.high + by});
  });
  connect(m_gestures, &TimeGestures::boxDrawn, this, [this](const QRectF& box) {
    const ValueScale scale = valueScale();
    setValues({scale.toValue(std::min(box.bottom(), scale.bottom)),
               scale.toValue(std::max(box.top(), scale.top))});
  });
  connect(m_gestures, &TimeGestures::fitRequested, this, [this] {
    PaneSpec options = m_spec;
    options.autoValues = options.autoRight = true;
    setOptions(options);
  });
  showNotes();
}

QWidget* ChartPane::surface() const {
  return m_chart->viewport();
}
int ChartPane::wantedLeft() const {
  return m_chart->wantedLeft();
}
int ChartPane::wantedRight() const {
  return hasRightAxis() ? m_chart->wantedRight() : 0;
}

bool ChartPane::hasRightAxis() const {
  return m_axes.hasRight();
}

ValueScale ChartPane::rightScale() const {
  const QRectF area = m_chart->plotArea();
  return {hasRightAxis() ? m_chart->rightLimits() : m_chart->yLimits(), area.top(), area.bottom()};
}

QString ChartPane::pointedText(QPointF at) const {
  const ValueScale left = valueScale();
  if (at.y() < left.top || at.y() > left.bottom) return {};
  const QString value = valueText(left.toValue(at.y()));
  return hasRightAxis()
             ? QStringLiteral("%1 | %2").arg(value, valueText(rightScale().toValue(at.y())))
             : value;
}

void ChartPane::setBoxTool(bool on) {
  m_gestures->setBoxTool(on);
}
void ChartPane::restyle() {
  m_chart->applyTheme();
}

ValueScale ChartPane::valueScale() const {
  const QRectF area = m_chart->plotArea();
  return {m_chart->yLimits(), area.top(), area.bottom()};
}

void ChartPane::setValues(ValueLimits limits) {
  const double span = limits.high - limits.low;
  const double size = std::max(std::abs(limits.low), std::abs(limits.high));
  // Beyond the digits of a double nothing could be told apart.
  if (!std::isfinite(span) || !(span > size * 1e-12) || span > 1e300) return;
  PaneSpec options = m_spec;
  options.autoValues = false;
  options.values = limits;
  setOptions(options);
}

void ChartPane::draw() {
  const int room = scaled(this, 5);  // half a label above and below
  m_chart->setMargins(left(), room, right(), room);
  const QRectF area = m_chart->plotArea();
  if (area.isEmpty()) return;
  const telemetry::TimeRange range = m_feed->time()->range();
  const int columns = std::max(1, static_cast<int>(area.width() * devicePixelRatioF()));
  const double now = m_feed->time()->data().value_or(range).end;
  m_traces.clear();
  m_traces.resize(m_curves.size());
  sideBySide(static_cast<int>(m_curves.size()), [&](int number) {
    const auto i = static_cast<std::size_t>(number);
    if (!m_curves[i].isHidden()) m_traces[i] = traceOf(m_curves[i].view(), range, columns, now);
  });
  traceCompared(range, columns);
  const Extent leftExtent = extent(false), rightExtent = extent(true);
  const int steps =
      std::clamp(static_cast<int>(area.height()) / scaled(this, pixelsPerValueStep), 2, 12);
  NiceLimits nice{m_spec.values, labelStep(m_spec.values, steps)};
  const double share = std::min(scaled(this, frameRoom) / area.height(), 0.25);
  const auto limitsOf = [steps, share](const Extent& e) {
    return e.any ? niceLimits(e.low, e.high, steps, share) : niceLimits(0.0, 1.0, steps);
  };
  if (m_spec.autoValues) nice = limitsOf(leftExtent);
  const std::vector<AxisTick> ticks = ticksOf(timeAxis(), *m_feed, this);
  const bool divided = ticks.size() > 1;
  const std::pair before(wantedLeft(), wantedRight());
  m_chart->setAxes({range.begin, range.end},
                   divided ? ticks[1].time - ticks[0].time : range.end - range.begin, nice.limits,
                   nice.step, ticks.empty() ? range.begin : ticks[0].time);
  if (hasRightAxis()) {
    NiceLimits right{m_spec.right, labelStep(m_spec.right, steps)};
    if (m_spec.autoRight) right = limitsOf(rightExtent);
    m_chart->setRightAxis(right.limits, right.step);
  } else {
    m_chart->hideRightAxis();
  }
  m_chart->setTitles({}, m_spec.valueTitle, hasRightAxis() ? m_spec.rightTitle : QString());
  shape();
  m_chart->redraw();
  if (m_notes != nullptr) m_notes->refresh();
  const std::pair wanted(wantedLeft(), wantedRight());
  if (wanted == before && wanted == m_wanted) return;
  m_wanted = wanted;
  emit leftChanged();
}

void ChartPane::Extent::take(const CurveTrace& trace, double factor) {
  if (!trace.any) return;
  low = any ? std::min(low, factor * trace.low) : factor * trace.low;
  high = any ? std::max(high, factor * trace.high) : factor * trace.high;
  any = true;
}

ChartPane::Extent ChartPane::extent(bool right) const {
  Extent all;
  for (std::size_t i = 0; i < m_curves.size(); ++i) {
    const AxisPlan::Place& place = m_axes.places[i];
    if (place.right != right) continue;
    all.take(m_traces[i], place.factor);
    for (std::size_t k = i; k < m_comparedTraces.size(); k += m_curves.size()) {
      all.take(m_comparedTraces[k], place.factor);
    }
  }
  return all;
}

std::span<const CurveTrace> ChartPane::comparedTraces(std::size_t session) const {
  const std::size_t first = session * m_curves.size();
  if (first >= m_comparedTraces.size()) return {};
  return std::span(m_comparedTraces).subspan(first, m_curves.size());
}

/// Where compared sessions have the variables.
void ChartPane::traceCompared(telemetry::TimeRange range, int columns) {
  const std::vector<ComparedRows>& sessions = m_feed->compared();
  m_comparedTraces.clear();
  m_comparedTraces.resize(sessions.size() * m_curves.size());
  sideBySide(static_cast<int>(m_comparedTraces.size()), [&](int number) {
    const auto i = static_cast<std::size_t>(number);
    const ComparedRows& session = sessions[i / m_curves.size()];
    const Curve::Compared* curve = m_curves[i % m_curves.size()].compared(session);
    if (curve == nullptr || !curve->view) return;
    const double offset = session.offset;
    CurveTrace& trace = m_comparedTraces[i];
    trace = traceOf(curve->view, session.ownTime(range), columns);
    for (telemetry::Sample& sample : trace.samples) sample.time += offset;
    for (CurveTrace::Column& column : trace.columns) column.time += offset;
    trace.heldUntil += offset;
  });
}

void ChartPane::shape() {
  std::size_t points = 0;
  for (const auto* traces : {&m_traces, &m_comparedTraces}) {
    for (const CurveTrace& trace : *traces) points += trace.samples.size() + trace.columns.size();
  }
  m_shapes.clear();
  m_shapedFor = timeAxis();
  const double pixel = scaled(this, 100) / 100.0;
  const ValueScale atLeft = valueScale(), atRight = rightScale();
  // In the curve's own unit, which the axis' is a multiple of.
  const auto values = [&](std::size_t curve) {
    const AxisPlan::Place& place = m_axes.places[curve];
    ValueScale scale = place.right ? atRight : atLeft;
    scale.limits = {scale.limits.low / place.factor, scale.limits.high / place.factor};
    return scale;
  };
  for (std::size_t i = 0; i < m_curves.size(); ++i) {
    const CurveSpec& spec = m_curves[i].spec();
    const double width = spec.width * pixel * (isPointedOut(i) ? pointedOutWidth : 1.0);
    m_shapes.push_back(
        {{},
         {m_curves[i].color(), spec.style, width, points > manyPoints && !isPointedOut(i), pixel,
          curveDash(spec.colorNumber)}});
  }
  sideBySide(static_cast<int>(m_shapes.size()), [&](int number) {
    const auto i = static_cast<std::size_t>(number);
    m_shapes[i].lines =
        polylines(m_traces[i], m_shapedFor, values(i), m_shapes[i].look.style == CurveStyle::Steps);
  });
  m_caption = {captions().join(QStringLiteral(" · ")), m_chart->plotArea().adjusted(4, 2, -4, -2),
               themeFont(TypeRole::Secondary), palette().color(QPalette::PlaceholderText)};
  m_comparedShapes.assign(m_comparedTraces.size(), {});
  const QColor base = palette().color(QPalette::Base);
  for (std::size_t i = 0; i < m_comparedShapes.size(); ++i) {
    const std::size_t curve = i % m_curves.size();
    TraceLook& paint = m_comparedShapes[i].look = m_shapes[curve].look;
    const ComparedLook look =
        comparedLook(m_feed->compared()[i / m_curves.size()], curve, paint.color, base);
    paint.color = look.color;
    paint.width *= look.width;
    paint.dash = look.dash;
  }
  sideBySide(static_cast<int>(m_comparedShapes.size()), [&](int number) {
    const auto i = static_cast<std::size_t>(number);
    const std::size_t curve = i % m_curves.size();
    Shape& other = m_comparedShapes[i];
    other.lines = polylines(m_comparedTraces[i], m_shapedFor, values(curve),
                            other.look.style == CurveStyle::Steps);
  });
}

/// A session that ends before what is shown is not drawn, nor is a future that begins behind it.
bool ChartPane::isDrawn(const ComparedRows& session, std::size_t index) const {
  const telemetry::TimeRange shown = m_feed->time()->range();
  const double from = std::max(session.from, shown.begin);
  return shown.end > from &&
         std::ranges::any_of(comparedTraces(index), [from](const CurveTrace& trace) {
           const auto isBehind = [from](const auto& point) { return point.time > from; };
           return trace.any && (std::ranges::any_of(trace.samples, isBehind) ||
                                std::ranges::any_of(trace.columns, isBehind));
         });
}

QStringList ChartPane::captions() const {
  QStringList all;
  const auto any = [this](bool CurveTrace::*what) {
    const auto is = [what](const CurveTrace& trace) { return trace.*what; };
    return std::ranges::any_of(m_traces, is) || std::ranges::any_of(m_comparedTraces, is);
  };
  if (any(&CurveTrace::reading)) {
    all << QStringLiteral("reading…");
  } else if (any(&CurveTrace::coarse)) {
    all << QStringLiteral("envelope: zoom in to see every sample");
  }
  QStringList thin;
  for (std::size_t i = 0; i < m_feed->compared().size(); ++i) {
    const ComparedRows& session = m_feed->compared()[i];
    if (!isDrawn(session, i)) continue;
    if (session.isFuture())
      all << QStringLiteral("dashed: ") + session.caption;
    else
      thin << sessionMark(session.number) + QLatin1Char(' ') + session.caption;
  }
  constexpr qsizetype maxNamed = 3;
  if (thin.size() > maxNamed) {
    const qsizetype more = thin.size() - maxNamed + 1;
    thin = thin.mid(0, maxNamed - 1);
    thin << QStringLiteral("%1 more").arg(more);
  }
  if (!thin.isEmpty()) all << QStringLiteral("thin: ") + thin.join(QStringLiteral(", "));
  return all;
}

bool ChartPane::eventFilter(QObject* watched, QEvent* event) {
  if (watched != m_chart->viewport() || event->type() != QEvent::ToolTip) {
    return PlotPane::eventFilter(watched, event);
  }
  const auto* help = static_cast<const QHelpEvent*>(event);
  const QRectF caption =
      QFontMetricsF(m_caption.font)
          .boundingRect(m_caption.place, Qt::AlignTop | Qt::AlignRight, m_caption.text);
  const bool isEnvelope = std::ranges::any_of(
      m_traces, [](const CurveTrace& trace) { return trace.coarse && !trace.reading; });
  if (!isEnvelope || !caption.contains(help->pos())) {
    QToolTip::hideText();
    return false;
  }
  QToolTip::showText(
      help->globalPos(),
      QStringLiteral(
          "The samples of this time span do not fit into the memory limit, so only their "
          "smallest and largest values are drawn. Zoom in, or raise the limit "
          "(Timeline > Memory for the past)."),
      m_chart->viewport());
  return true;
}

void ChartPane::paintCurves(QPainter& painter) const {
  for (std::size_t i = 0; i < m_comparedShapes.size(); ++i) {
    paintTrace(painter, m_comparedTraces[i], m_comparedShapes[i].lines, m_shapedFor,
               m_comparedShapes[i].look);
  }
  if (!m_caption.text.isEmpty()) {
    painter.setPen(m_caption.color);
    painter.setFont(m_caption.font);
    painter.drawText(m_caption.place, Qt::AlignTop | Qt::AlignRight, m_caption.text);
  }
  for (std::size_t i = 0; i < m_shapes.size(); ++i) {
    paintTrace(painter, m_traces[i], m_shapes[i].lines, m_shapedFor, m_shapes[i].look);
  }
}

void ChartPane::showNotes() {
  if (m_feed->notes() == nullptr) return;
  const auto owner = [this](const QPointF& at) -> std::optional<NoteGround::Owner> {
    const int curve = curveAt(at);
    if (curve < 0) return {};
    const Curve& nearest = m_curves[static_cast<std::size_t>(curve)];
    return NoteGround::Owner{noteOwner(nearest, *m_feed).toStdString(),
                             nearest.unit().toStdString()};
  };
  m_notes = new NoteLayer(m_feed->notes(),
                          {telemetry::NotePlace::Plot, owner,
                           [this](const std::string& variable) { return noteTransform(variable); },
                           [this] { return m_chart->plotArea(); }},
                          m_chart->viewport(), m_chart);
}

int ChartPane::curveAt(const QPointF& at) const {
  const double time = timeAxis().time(at.x());
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < m_curves.size(); ++i) {
    if (m_curves[i].isHidden() || m_curves[i].isWaiting()) continue;
    const AxisPlan::Place& place = m_axes.places[i];
    const ValueScale scale = place.right ? rightScale() : valueScale();
    const auto value = m_curves[i].valueAt(time);
    // Beside its own gap a curve is farther than any other.
    const double off = value ? std::abs(scale.toY(*value * place.factor) - at.y()) : 1e9;
    if (off < least) {
      least = off;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

std::optional<QTransform> ChartPane::noteTransform(const std::string& variable) const {
  const QString name = QString::fromStdString(variable);
  for (std::size_t i = 0; i < m_curves.size(); ++i) {
    if (m_curves[i].isHidden() || noteOwner(m_curves[i], *m_feed) != name) continue;
    const AxisPlan::Place& place = m_axes.places[i];
    const ValueScale scale = place.right ? rightScale() : valueScale();
    const TimeAxis axis = timeAxis();
    const double perSecond = 1.0 / axis.secondsPerPixel(),
                 perUnit = scale.toY(place.factor) - scale.toY(0.0);
    if (!std::isfinite(perSecond) || !std::isfinite(perUnit) || perUnit == 0.0) return {};
    return QTransform(perSecond, 0, 0, perUnit, axis.pixel(0.0), scale.toY(0.0));
  }
  return {};
}

void ChartPane::extendMenu(QMenu* menu) {
  if (m_feed->notes() != nullptr) addNoteTools(menu, *m_feed->notes());
  QAction* automatic = menu->addAction(QStringLiteral("Fit the value axis automatically"));
  automatic->setCheckable(true);
  automatic->setChecked(m_spec.autoValues && (m_spec.autoRight || !hasRightAxis()));
  connect(automatic, &QAction::triggered, this, [this](bool on) {
    PaneSpec options = m_spec;
    options.autoValues = on;
    options.values = m_chart->yLimits();
    if (hasRightAxis()) {
      options.autoRight = on;
      options.right = m_chart->rightLimits();
    }
    setOptions(options);
  });
}

}  // namespace pitchboard::ui
