// SPDX-License-Identifier: GPL-3.0-or-later
#include "time_gestures.h"

#include <QMouseEvent>
#include <QRubberBand>
#include <QWheelEvent>
#include <QWidget>
#include <cmath>

#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {
constexpr double notch = 120.0;      // eighths of a degree, as Qt counts them
constexpr double markReach = 4.0;    // px of the mock
constexpr double smallestBox = 4.0;  // px; less is a click
constexpr double clickReach = 4.0;   // px; more is a drag
constexpr double flatBox = 10.0;     // px; lower boxes choose times only
}  // namespace

double wheelFactor(int turned) {
  return std::pow(0.8, turned / notch);
}

TimeGestures::TimeGestures(QWidget* surface, LinkedTime* time, std::function<TimeAxis()> axis)
    : QObject(surface), m_surface(surface), m_time(time), m_axis(std::move(axis)) {
  surface->setMouseTracking(true);
  surface->installEventFilter(this);
  connect(time, &LinkedTime::rangeChanged, this, &TimeGestures::showCursor);
}

bool TimeGestures::eventFilter(QObject* watched, QEvent* event) {
  if (watched != m_surface) return false;
  switch (event->type()) {
    case QEvent::Wheel:
      // Over the numbers beside the axis it scrolls the plots.
      if (static_cast<QWheelEvent*>(event)->position().x() < m_axis().left) {
        event->ignore();
        return true;
      }
      wheel(static_cast<QWheelEvent*>(event));
      return true;
    case QEvent::MouseButtonPress:
      if (static_cast<QMouseEvent*>(event)->button() == Qt::RightButton) return false;
      press(static_cast<QMouseEvent*>(event));
      return true;
    case QEvent::MouseMove:
      move(static_cast<QMouseEvent*>(event));
      return true;
    case QEvent::MouseButtonRelease:
      if (static_cast<QMouseEvent*>(event)->button() == Qt::RightButton) return false;
      release(static_cast<QMouseEvent*>(event));
      return true;
    case QEvent::MouseButtonDblClick:
      if (static_cast<QMouseEvent*>(event)->button() != Qt::LeftButton) return false;
      m_drag = Drag::None;
      // Its first half was a click, and is taken back.
      if (m_before)
        m_time->shown()->seek(*m_before);
      else
        m_time->shown()->goLive();
      m_time->fitAll();
      emit fitRequested();
      return true;
    case QEvent::Leave:
      leave();
      return false;
    default:
      return false;
  }
}

void TimeGestures::wheel(QWheelEvent* event) {
  const QPoint turned = event->angleDelta();
  event->accept();
  if (turned.y() == 0) {
    // A wheel that is tilted, or two fingers sideways.
    const TimeAxis axis = m_axis();
    m_time->pan(-turned.x() / notch * 0.1 * (axis.shown.end - axis.shown.begin));
    return;
  }
  const double factor = wheelFactor(turned.y());
  if (event->modifiers() & Qt::ControlModifier) {
    if (m_hasValues) emit valueZoomed(factor, event->position().y());
    return;
  }
  m_time->zoom(factor, m_axis().time(event->position().x()));
}

std::optional<TimeMark> TimeGestures::markAt(const QPointF& position) const {
  const TimeAxis axis = m_axis();
  for (const TimeMark mark : {TimeMark::B, TimeMark::A}) {
    const auto at = m_time->shown()->mark(mark);
    if (at && std::abs(axis.pixel(*at) - position.x()) <= scaled(m_surface, markReach)) return mark;
  }
  return {};
}

void TimeGestures::leave() {
  m_over = false;
  m_time->setCursor({});
  emit pointed({});
}

void TimeGestures::showCursor() {
  if (!m_over) return;
  const TimeAxis axis = m_axis();
  const bool inside = m_last.x() >= axis.left && m_last.x() <= axis.right();
  const bool moving = m_drag == Drag::Pan && m_dragged;
  m_time->setCursor(inside && !moving ? std::optional(axis.time(m_last.x())) : std::nullopt);
}

void TimeGestures::press(QMouseEvent* event) {
  m_dragged = false;
  m_from = m_last = event->position();
  const bool left = event->button() == Qt::LeftButton;
  if (left && (m_boxTool || (event->modifiers() & Qt::ShiftModifier))) {
    m_drag = Drag::Box;
    if (m_band == nullptr) m_band = new QRubberBand(QRubberBand::Rectangle, m_surface);
    m_band->setGeometry(QRect(m_from.toPoint(), QSize()));
    m_band->show();
    return;
  }
  if (const auto mark = markAt(m_from); left && mark) {
    m_drag = Drag::Mark;
    m_mark = *mark;
    return;
  }
  m_drag = Drag::Pan;
}

void TimeGestures::move(QMouseEvent* event) {
  const QPointF at = event->position();
  const TimeAxis axis = m_axis();
  const double time = axis.time(at.x());
  switch (m_drag) {
    case Drag::None:
      if (markAt(at))
        m_surface->setCursor(Qt::SplitHCursor);
      else
        m_surface->unsetCursor();
      break;
    case Drag::Pan: {
      if (!m_dragged && (at - m_from).manhattanLength() < clickReach) return;
      m_dragged = true;
      m_surface->setCursor(Qt::ClosedHandCursor);
      m_time->pan(-(at.x() - m_last.x()) / axis.width * (axis.shown.end - axis.shown.begin));
      if (at.y() != m_last.y()) emit valuePanned(at.y() - m_last.y());
      break;
    }
    case Drag::Box: {
      QRect box = QRect(m_from.toPoint(), at.toPoint()).normalized();
      if (!m_hasValues || box.height() < flatBox) {
        box.setTop(0);
        box.setBottom(m_surface->height());
      }
      m_band->setGeometry(box);
      break;
    }
    case Drag::Mark:
      m_time->shown()->setMark(m_mark, time);
      break;
  }
  m_last = at;
  m_over = true;
  showCursor();
  emit pointed(at);
}

void TimeGestures::release(QMouseEvent* event) {
  const Drag drag = std::exchange(m_drag, Drag::None);
  if (drag == Drag::Pan) {
    m_surface->unsetCursor();
    const TimeAxis axis = m_axis();
    const double x = m_from.x();
    if (m_dragged || event->button() != Qt::LeftButton || x < axis.left || x > axis.right()) return;
    m_before = m_time->shown()->chosenTime();
    m_time->shown()->seek(axis.time(x));
    return;
  }
  if (drag != Drag::Box) return;
  m_band->hide();
  const QRectF box = QRectF(m_from, event->position()).normalized();
  if (box.width() < smallestBox) return;
  const TimeAxis axis = m_axis();
  m_time->setRange(
      {axis.time(std::max(box.left(), axis.left)), axis.time(std::min(box.right(), axis.right()))});
  if (m_hasValues && box.height() >= flatBox) emit boxDrawn(box);
}

}  // namespace pitchboard::ui
