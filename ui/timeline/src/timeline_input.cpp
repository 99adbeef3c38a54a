// SPDX-License-Identifier: GPL-3.0-or-later
// What mouse and keys do on the timeline.
#include <QContextMenuEvent>
#include <QMouseEvent>
#include <algorithm>
#include <cmath>

#include <ui/base/theme.h>
#include <ui/sources/event_list.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/playback.h>
#include <ui/sources/timeline.h>

#include "timeline_strip.h"

namespace pitchboard::ui {
namespace {

constexpr double edgeReach = 4.0;  // px of the mock: where a window's edge is taken

}  // namespace

TimelineStrip::Grab TimelineStrip::grabAt(QPointF at, Qt::KeyboardModifiers keys) const {
  if (keys & Qt::ShiftModifier) return Grab::Range;
  if (comparedRect().contains(at.toPoint())) return Grab::Compared;
  const auto window = windowRect();
  const double reach = scaled(this, edgeReach);
  if (window && at.y() >= window->top() && at.y() < window->bottom() + 1 &&
      at.x() >= window->left() - reach && at.x() <= window->right() + reach) {
    // The middle of a small window stays free for moving it.
    const double edge = std::min(reach, window->width() / 4);
    if (at.x() < window->left() + edge) return Grab::WindowBegin;
    if (at.x() > window->right() - edge) return Grab::WindowEnd;
    return Grab::Window;
  }
  return Grab::Moment;
}

void TimelineStrip::showCursorAt(QPointF at, Qt::KeyboardModifiers keys) {
  switch (grabAt(at, keys)) {
    case Grab::WindowBegin:
    case Grab::WindowEnd:
      setCursor(Qt::SizeHorCursor);
      break;
    case Grab::Window:
      setCursor(Qt::OpenHandCursor);
      break;
    case Grab::Compared:
      setCursor(Qt::SizeHorCursor);
      break;
    case Grab::Range:
      setCursor(Qt::IBeamCursor);
      break;
    default:
      setCursor(markAt(at) != nullptr ? Qt::PointingHandCursor : Qt::ArrowCursor);
      break;
  }
}

void TimelineStrip::mousePressEvent(QMouseEvent* event) {
  m_pressedAt = event->position();
  m_dragged = false;
  m_grabTime = m_axis.time(m_pressedAt.x());
  if (event->button() == Qt::MiddleButton) {
    m_grab = Grab::View;
    m_grabRange = m_axis.shown;
    setCursor(Qt::ClosedHandCursor);
    return;
  }
  if (event->button() != Qt::LeftButton) return;
  m_grab = grabAt(m_pressedAt, event->modifiers());
  if (m_grab == Grab::Moment) {
    const EventMark* mark = markAt(m_pressedAt);
    m_timeline->seek(mark != nullptr ? m_timeline->events()->event(mark->row).time : m_grabTime);
  } else if (m_grab == Grab::Compared) {
    m_grabOffset = m_comparedOffset;
  } else if (m_grab != Grab::Range) {
    m_grabRange = m_plots->range();
    setCursor(m_grab == Grab::Window ? Qt::ClosedHandCursor : Qt::SizeHorCursor);
  }
}

void TimelineStrip::mouseMoveEvent(QMouseEvent* event) {
  const QPointF at = event->position();
  if (m_grab == Grab::Nothing) {
    showCursorAt(at, event->modifiers());
    return;
  }
  constexpr double still = 3.0;  // a trembling hand is not a drag
  if (!m_dragged && std::abs(at.x() - m_pressedAt.x()) < still) return;
  m_dragged = true;
  const double time = m_axis.time(at.x());
  const double by = time - m_grabTime;
  switch (m_grab) {
    case Grab::Moment:
      m_timeline->seek(time);
      break;
    case Grab::Range:
      m_timeline->setSelection({{std::min(m_grabTime, time), std::max(m_grabTime, time)}});
      break;
    case Grab::Window:
      m_plots->setRange({m_grabRange.begin + by, m_grabRange.end + by});
      break;
    case Grab::WindowBegin:
      m_plots->setRange(
          {std::min(m_grabRange.begin + by, m_grabRange.end - LinkedTime::minimumSpan),
           m_grabRange.end});
      break;
    case Grab::WindowEnd:
      m_plots->setRange({m_grabRange.begin, std::max(m_grabRange.end + by,
                                                     m_grabRange.begin + LinkedTime::minimumSpan)});
      break;
    case Grab::View: {
      const double pixels = at.x() - m_pressedAt.x();
      const double seconds = pixels * m_axis.secondsPerPixel();
      setShown({m_grabRange.begin - seconds, m_grabRange.end - seconds});
      break;
    }
    case Grab::Compared:
      emit comparedMoved(m_grabOffset + by);
      break;
    case Grab::Nothing:
      break;
  }
}

void TimelineStrip::mouseReleaseEvent(QMouseEvent* event) {
  const Grab grabbed = m_grab;
  m_grab = Grab::Nothing;
  if (!m_dragged && event->button() == Qt::LeftButton) {
    if (grabbed == Grab::Window || grabbed == Grab::WindowBegin || grabbed == Grab::WindowEnd) {
      m_timeline->seek(m_grabTime);
    }
    if (grabbed == Grab::Range) m_timeline->setSelection({});
    if (grabbed == Grab::Compared) m_timeline->seek(m_grabTime);
  }
  showCursorAt(event->position(), event->modifiers());
}

void TimelineStrip::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  if (const EventMark* mark = markAt(event->position())) {
    if (m_timeline->events()->event(mark->row).kind == link::MatchEventKind::Bookmark)
      editNote(mark->row);
    return;
  }
  if (event->position().y() > bandRect().bottom()) showAll();
}

void TimelineStrip::wheelEvent(QWheelEvent* event) {
  const QPoint angle = event->angleDelta();
  const bool sideways = angle.x() != 0 || (event->modifiers() & Qt::ShiftModifier);
  const double notches = (angle.y() != 0 ? angle.y() : angle.x()) / 120.0;
  if (sideways) {
    constexpr double part = 0.1;
    const double by = -notches * part * (m_axis.shown.end - m_axis.shown.begin);
    setShown({m_axis.shown.begin + by, m_axis.shown.end + by});
  } else {
    constexpr double perNotch = 1.2;
    zoom(std::pow(perNotch, -notches), m_axis.time(event->position().x()));
  }
  event->accept();
}

void TimelineStrip::keyPressEvent(QKeyEvent* event) {
  const bool coarse = event->modifiers() & Qt::ShiftModifier;
  const double middle = m_timeline->shownTime();
  constexpr double closer = 1 / 1.5, farther = 1.5, second = 1.0;
  switch (event->key()) {
    case Qt::Key_Left:
      if (coarse)
        m_timeline->seek(m_timeline->shownTime() - second);
      else
        m_timeline->step(-1);
      break;
    case Qt::Key_Right:
      if (coarse)
        m_timeline->seek(m_timeline->shownTime() + second);
      else
        m_timeline->step(1);
      break;
    case Qt::Key_Home:
      if (const auto range = m_timeline->available()) m_timeline->seek(range->begin);
      break;
    case Qt::Key_End:
      m_timeline->seek(m_timeline->now());
      break;
    case Qt::Key_Space:
      m_timeline->togglePlay();
      break;
    case Qt::Key_L:
      m_timeline->setLooping(!m_timeline->isLooping());
      break;
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      zoom(closer, middle);
      break;
    case Qt::Key_Minus:
      zoom(farther, middle);
      break;
    case Qt::Key_0:
      showAll();
      break;
    case Qt::Key_Escape:
      if (m_timeline->selection())
        m_timeline->setSelection({});
      else
        m_timeline->goLive();
      break;
    default:
      QWidget::keyPressEvent(event);
      return;
  }
  event->accept();
}

void TimelineStrip::contextMenuEvent(QContextMenuEvent* event) {
  const QPointF at = event->pos();
  if (const EventMark* mark = markAt(at)) {
    emit menuRequested(event->globalPos(), &m_timeline->events()->event(mark->row), false);
    return;
  }
  if (comparedRect().contains(event->pos())) {
    const std::vector<EventMark> all = comparedMarks();
    if (const EventMark* mark = nearest(all, at.x())) {
      emit menuRequested(event->globalPos(), &m_compared->event(mark->row), true);
      return;
    }
  }
  emit menuRequested(event->globalPos(), nullptr, false);
}

}  // namespace pitchboard::ui
