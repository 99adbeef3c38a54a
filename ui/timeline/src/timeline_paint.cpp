// SPDX-License-Identifier: GPL-3.0-or-later
// How the timeline looks.
#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include <ui/base/quick_painting.h>
#include <ui/base/theme.h>
#include <ui/sources/abandoned_future.h>
#include <ui/sources/event_list.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/rule_watch.h>
#include <ui/sources/shown_moment.h>

#include "timeline_strip.h"

namespace pitchboard::ui {
namespace {

constexpr double markSize = 9.0;
constexpr double tickSpacing = 56.0;  // px of the mock between labels

void stem(QPainter& painter, double x, double top, double bottom, const QColor& color,
          double wide) {
  painter.setPen(QPen(color, wide));
  painter.drawLine(QPointF(x, top), QPointF(x, bottom));
}

}  // namespace

void TimelineStrip::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), theme().window);
  paintBand(painter);
  paintRules(painter);
  paintBranch(painter);
  paintRange(painter);
  paintWindow(painter);
  paintAxis(painter);
  paintMarks(painter);
  paintCompared(painter);
  paintMoment(painter);
  if (hasFocus()) {
    painter.setPen(theme().accentLine);
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 3, 3);
  }
}

void TimelineStrip::paintBand(QPainter& painter) const {
  const QRectF band = bandRect();
  drawRoundBox(painter, band, 2, theme().view, theme().innerLine);
  const auto held = m_shown->available();
  if (!held) return;
  const double left = std::max(m_axis.pixel(held->begin), band.left());
  const double right = std::min(m_axis.pixel(held->end), band.right());
  if (right <= left) return;
  drawRoundBox(painter, QRectF(left, band.top() + 1, right - left, band.height() - 2), 2,
               theme().innerLine);
}

void TimelineStrip::paintRules(QPainter& painter) const {
  const QRect row = rulesRect();
  if (row.isEmpty()) return;
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.fillRect(QRect(row.left(), row.bottom(), row.width(), 1), theme().innerLine);
  paintBroken(painter, row, 0);
}

// The most severe rule of each pixel, however many there are.
void TimelineStrip::paintBroken(QPainter& painter, const QRect& row, quint64 session) const {
  painter.setRenderHint(QPainter::Antialiasing, false);
  std::vector<int> severity(static_cast<std::size_t>(row.width()), -1);
  for (const BrokenRule& one : m_rules->broken()) {
    if (one.session != session) continue;
    const double from = m_axis.pixel(one.from()) - row.left();
    const double until = m_axis.pixel(one.until()) - row.left();
    if (until < 0.0 || from >= row.width()) continue;
    constexpr int narrowest = 2;
    const int first = std::max(0, static_cast<int>(std::floor(from)));
    const int last = std::min(
        row.width() - 1, std::max(first + narrowest - 1, static_cast<int>(std::ceil(until)) - 1));
    const int own = static_cast<int>(m_rules->ruleOf(one).severity);
    for (int x = first; x <= last; ++x) {
      int& shown = severity[static_cast<std::size_t>(x)];
      shown = std::max(shown, own);
    }
  }
  for (int x = 0; x < row.width();) {
    const int own = severity[static_cast<std::size_t>(x)];
    int end = x + 1;
    while (end < row.width() && severity[static_cast<std::size_t>(end)] == own) ++end;
    if (own >= 0) {
      painter.fillRect(QRect(row.left() + x, row.top(), end - x, row.height()),
                       severityColor(static_cast<telemetry::RuleSeverity>(own)));
    }
    x = end;
  }
  painter.setRenderHint(QPainter::Antialiasing);
}

// Where the match has been and is not any more: dashed, as in the plots, and named.
void TimelineStrip::paintBranch(QPainter& painter) const {
  const QRectF row = branchRect();
  if (row.isEmpty()) return;
  const QRect band = bandRect();
  QColor line = theme().secondaryText, ground = line;
  line.setAlphaF(0.7F);
  ground.setAlphaF(0.12F);
  const QPen dashed(line, 1.0, Qt::DashLine);
  const double fork = m_axis.pixel(m_future->begin());
  if (fork >= band.left()) {
    painter.setPen(QPen(line, 1.4));
    painter.drawLine(QPointF(fork, band.top()), QPointF(fork, row.top()));
  }
  painter.setPen(dashed);
  painter.setBrush(ground);
  painter.drawRoundedRect(row.adjusted(0.5, 0.5, -0.5, -0.5), 2, 2);
  painter.setOpacity(0.5);
  for (const link::MatchEvent& event : m_future->events().events()) {
    if (!m_shown->filter().shows(event)) continue;
    const double x = m_axis.pixel(event.time);
    if (x < row.left() || x > row.right()) continue;
    stem(painter, x, row.top() + 2, row.bottom() - 2, markColor(link::info(event.kind).shape), 1.4);
  }
  painter.setOpacity(1.0);
  painter.setFont(themeFont(TypeRole::Small));
  const QString name = m_future->caption();
  const double pad = scaled(this, 5),
               wide = painter.fontMetrics().horizontalAdvance(name) + 2 * pad;
  QRectF place(row.left() + pad, row.top() + 1, wide, row.height() - 2);
  // Where the branch is too short for it, beside it.
  if (wide + pad > row.width()) place.moveLeft(row.right() + pad);
  if (place.right() > width()) return;
  painter.fillRect(place, theme().window);
  painter.setPen(theme().secondaryText);
  painter.drawText(place, Qt::AlignCenter, name);
}

void TimelineStrip::paintWindow(QPainter& painter) const {
  const auto window = windowRect();
  if (!window) return;
  QColor ground = theme().accentFill;
  ground.setAlphaF(isDarkTheme() ? 0.65F : 0.35F);
  drawRoundBox(painter, *window, 2, ground, theme().accentLine);
  // The handle below: a bar with a knob at each end.
  const QRectF handle = *rangeHandle();
  const double knob = scaled(this, 4);
  const QRectF bar(handle.left(), handle.center().y() - 1, handle.width(), 2);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme().accentLine);
  painter.drawRect(bar);
  for (const double x : {handle.left(), handle.right() - knob}) {
    painter.drawRoundedRect(QRectF(x, handle.top(), knob, handle.height()), 1.5, 1.5);
  }
}

void TimelineStrip::paintRange(QPainter& painter) const {
  const auto range = m_shown->selection();
  if (!range) return;
  const QRectF band = bandRect();
  const double left = std::clamp(m_axis.pixel(range->begin), band.left(), band.right());
  const double right = std::clamp(m_axis.pixel(range->end), band.left(), band.right());
  QColor ground = theme().accentLine;
  ground.setAlphaF(0.14F);
  painter.fillRect(QRectF(left, 0, right - left, band.bottom()), ground);
  // A bracket, so that the range can be told without colour.
  painter.setPen(QPen(theme().accentLine, m_shown->isLooping() ? 2.0 : 1.0));
  const double arm = scaled(this, 5);
  for (const auto& [x, inwards] : {std::pair(left, arm), std::pair(right, -arm)}) {
    painter.drawPolyline(
        QPolygonF{{QPointF(x + inwards, 1.0), QPointF(x, 1.0), QPointF(x, band.bottom()),
                   QPointF(x + inwards, band.bottom())}});
  }
}

void TimelineStrip::paintAxis(QPainter& painter) const {
  painter.setFont(themeFont(TypeRole::Small));
  const QFontMetrics metrics(painter.font());
  const int half = metrics.horizontalAdvance(QStringLiteral("00:00:00")) / 2 + 2;
  painter.setPen(theme().secondaryText);
  for (const AxisTick& tick :
       axisTicks(m_axis, std::max(scaled(this, tickSpacing), 2 * half + scaled(this, 24)),
                 m_shown->clock())) {
    const double x = m_axis.pixel(tick.time);
    const double top = height() - scaled(this, axisHeight);
    QRectF place(x - half, top, 2 * half, height() - top);
    // The first and the last label stay on the widget.
    const double edge = scaled(this, 4);
    const bool atEdge = place.left() < edge;
    if (atEdge) place.moveLeft(edge);
    if (place.right() > width()) place.moveRight(width());
    drawTextLine(painter, place, (atEdge ? Qt::AlignLeft : Qt::AlignHCenter) | Qt::AlignVCenter,
                 tick.label);
  }
}

void TimelineStrip::paintRow(QPainter& painter, const std::vector<EventMark>& marks,
                             const std::deque<link::MatchEvent>& events, double centre,
                             double bottom, double strength) const {
  painter.setFont(themeFont(TypeRole::Small));
  const double size = scaled(this, markSize);
  const double gap = scaled(this, 9);
  painter.setOpacity(strength);
  for (const EventMark& mark : marks) {
    const link::EventShape shape =
        link::info(events[static_cast<std::size_t>(mark.row)].kind).shape;
    stem(painter, mark.x, centre + size * 0.5, bottom, markColor(shape), 1.4);
    drawMark(painter, shape, {mark.x, centre}, size);
    if (mark.label.isEmpty()) continue;
    painter.setPen(theme().secondaryText);
    const QRectF line(mark.x, centre - size, width(), 2 * size);
    if (mark.labelLeft) {
      drawTextLine(painter, line.translated(-gap - width(), 0), Qt::AlignRight | Qt::AlignVCenter,
                   mark.label);
    } else {
      drawTextLine(painter, line.translated(gap, 0), Qt::AlignLeft | Qt::AlignVCenter, mark.label);
    }
  }
  painter.setOpacity(1.0);
}

void TimelineStrip::paintMarks(QPainter& painter) {
  const double bottom = m_compared.empty() ? bandRect().top() + 1 : marksRect().bottom();
  paintRow(painter, marks(), m_shown->events()->events(), scaled(this, 13), bottom, 1.0);
}

void TimelineStrip::paintMoment(QPainter& painter) const {
  const QRect band = bandRect();
  const auto inside = [&band](double x) { return x >= band.left() - 1 && x <= band.right() + 2; };
  const auto chosen = m_shown->chosenTime();
  if (m_plots != nullptr && m_plots->cursor()) {
    const double x = m_axis.pixel(*m_plots->cursor());
    if (inside(x)) stem(painter, x, band.top() - 2, band.bottom() + 1, theme().secondaryText, 1.0);
  }
  if (m_shown->kind().hasPresent && m_shown->now() > 0.0) {
    const double x = m_axis.pixel(m_shown->now());
    if (inside(x)) {
      stem(painter, x, band.top() - scaled(this, 8), band.bottom() + scaled(this, 3),
           chosen ? theme().secondaryText : theme().accentLine, 2.0);
    }
  }
  if (!chosen) return;
  // The moment shown: a handle, because it is what is dragged.
  const double x = m_axis.pixel(*chosen);
  if (!inside(x)) return;
  stem(painter, x, scaled(this, 4), band.bottom() + scaled(this, 3), theme().accentLine, 2.0);
  const double half = scaled(this, 5);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme().accentLine);
  painter.drawPolygon(
      QPolygonF{{QPointF(x - half, 0), QPointF(x + half, 0), QPointF(x + half, half),
                 QPointF(x, 2 * half), QPointF(x - half, half)}});
}

void TimelineStrip::editNote(int row) {
  finishNote(true);
  const EventList* list = m_shown->events();
  if (row < 0 || row >= list->rowCount()) return;
  m_noteTime = list->at(row).time;
  m_note = new QLineEdit(QString::fromStdString(list->at(row).detail), this);
  m_note->setObjectName(QStringLiteral("bookmarkNote"));
  m_note->setFont(themeFont(TypeRole::Secondary));
  m_note->setMaxLength(EventList::maxNote);
  m_note->setPlaceholderText(QStringLiteral("Type a note, then Enter"));
  const int wide = std::min(scaled(this, 200), width());
  const int x =
      std::clamp(static_cast<int>(m_axis.pixel(m_noteTime)) + scaled(this, 8), 0, width() - wide);
  m_note->setGeometry(x, 0, wide, scaled(this, 22));
  m_note->show();
  m_note->selectAll();
  m_note->setFocus();
  connect(m_note, &QLineEdit::editingFinished, this, [this] { finishNote(true); });
  qApp->installEventFilter(this);
}

bool TimelineStrip::eventFilter(QObject* watched, QEvent* event) {
  if (watched == m_note && event->type() == QEvent::KeyPress &&
      static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    finishNote(false);
    return true;
  }
  // A click anywhere else is done with it, also where the focus does not go.
  if (event->type() == QEvent::MouseButtonPress && m_note != nullptr) {
    const auto* pressed = qobject_cast<const QWidget*>(watched);
    const bool within = pressed == nullptr || pressed->window() != window() || pressed == m_note ||
                        m_note->isAncestorOf(pressed);
    if (!within) finishNote(true);
  }
  return QWidget::eventFilter(watched, event);
}

void TimelineStrip::finishNote(bool keep) {
  if (m_note == nullptr) return;
  QLineEdit* note = std::exchange(m_note, nullptr);
  qApp->removeEventFilter(this);
  const bool hadFocus = note->hasFocus();
  if (keep) m_shown->setNote(m_noteTime, note->text());
  note->hide();
  note->deleteLater();
  if (hadFocus) setFocus();
}

}  // namespace pitchboard::ui
