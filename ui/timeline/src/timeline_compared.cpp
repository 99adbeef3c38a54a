// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of compared sessions in the timeline.
#include <QDragEnterEvent>
#include <QFontMetrics>
#include <QPainter>
#include <QScrollBar>
#include <algorithm>

#include <ui/base/file_dialog.h>
#include <ui/base/session_mark.h>
#include <ui/base/theme.h>
#include <ui/sources/event_list.h>
#include <ui/sources/rule_watch.h>
#include <ui/sources/shown_moment.h>

#include "timeline_strip.h"

namespace pitchboard::ui {
namespace {

// px of the mock
constexpr int fewRows = 2, rowHeight = 18, lowRowHeight = 13, extentHeight = 2;
constexpr int brokenHeight = 4, brokenReach = 3;  // px above the extent; px more for a hand
constexpr int maxVisibleRows = 6;
constexpr int scrollBarWidth = 10;

}  // namespace

void TimelineStrip::setCompared(std::vector<ComparedRow> rows) {
  for (const ComparedRow& row : m_compared) row.events->disconnect(this);
  const bool isOther = rows.size() != m_compared.size();
  m_compared = std::move(rows);
  m_comparedMarks.assign(m_compared.size(), {});
  for (const ComparedRow& row : m_compared) {
    connect(row.events, &EventList::changed, this, qOverload<>(&QWidget::update));
    connect(row.events, &QObject::destroyed, this, [this, gone = row.events] {
      // The list cannot be disconnected any more.
      std::erase_if(m_compared, [gone](const ComparedRow& one) { return one.events == gone; });
      setCompared(std::exchange(m_compared, {}));
    });
  }
  if (isOther) {
    m_scroll->setRange(0, std::max(0, comparedRows() - maxVisibleRows));
    m_scroll->setPageStep(maxVisibleRows);
    updateGeometry();
    placeScrollBar();
  }
  update();
}

int TimelineStrip::visibleRows() const {
  return std::min(comparedRows(), maxVisibleRows);
}

int TimelineStrip::comparedRowHeight() const {
  return scaled(this, comparedRows() <= fewRows ? rowHeight : lowRowHeight);
}

int TimelineStrip::comparedTop() const {
  return lanesTop() - branchHeight() - visibleRows() * comparedRowHeight();
}

QRect TimelineStrip::comparedRect(int row) const {
  const int place = row - m_scroll->value();
  if (row >= comparedRows() || place < 0 || place >= visibleRows()) return {};
  const QRect band = bandRect();
  const int high = comparedRowHeight();
  return {band.left(), comparedTop() + place * high, band.width(), high};
}

QRect TimelineStrip::comparedChip(int row) const {
  const QRect place = comparedRect(row);
  if (place.isEmpty()) return {};
  const QFontMetrics metrics(themeFont(TypeRole::Small));
  const QString caption = metrics.elidedText(m_compared[static_cast<std::size_t>(row)].caption,
                                             Qt::ElideMiddle, place.width() / 3);
  const int wide = metrics.horizontalAdvance(caption) + scaled(this, 30);
  return {place.right() - wide, place.top() + 1, wide, place.height() - 2};
}

QRect TimelineStrip::comparedRulesRect(int row) const {
  const QRect place = comparedRect(row);
  if (place.isEmpty() || m_rules == nullptr || m_rules->rules().empty()) return {};
  const int high = scaled(this, brokenHeight);
  return {place.left(), place.bottom() - scaled(this, extentHeight) - high, place.width(), high};
}

std::vector<const BrokenRule*> TimelineStrip::comparedBrokenAt(QPointF at) const {
  const int row = rowAt(at);
  const QRect place = comparedRulesRect(row);
  if (place.isEmpty() || at.y() < place.top() - scaled(this, brokenReach)) return {};
  return brokenAt(at.x(), m_compared[static_cast<std::size_t>(row)].session);
}

int TimelineStrip::rowAt(QPointF at) const {
  for (int row = 0; row < comparedRows(); ++row) {
    if (comparedRect(row).contains(at.toPoint())) return row;
  }
  return -1;
}

void TimelineStrip::placeScrollBar() {
  m_scroll->setVisible(m_scroll->maximum() > 0);
  const int wide = scaled(this, scrollBarWidth);
  m_scroll->setGeometry(width() - wide, comparedTop(), wide, visibleRows() * comparedRowHeight());
}

const std::vector<EventMark>& TimelineStrip::comparedMarks(int row) {
  static const std::vector<EventMark> none;
  if (row < 0 || row >= comparedRows()) return none;
  const ComparedRow& session = m_compared[static_cast<std::size_t>(row)];
  LaidOut& laid = m_comparedMarks[static_cast<std::size_t>(row)];
  TimeAxis moved = m_axis;
  moved.shown = {m_axis.shown.begin - session.offset, m_axis.shown.end - session.offset};
  if (laid.revision != session.events->revision() || !(laid.axis == moved)) {
    laid.marks = layOutMarks(session.events->events(), moved, markSizes(),
                             QFontMetrics(themeFont(TypeRole::Small)), m_shown->filter());
    laid.axis = moved;
    laid.revision = session.events->revision();
  }
  return laid.marks;
}

QString TimelineStrip::comparedTip(QPointF at) {
  const int row = rowAt(at);
  const ComparedRow& session = m_compared[static_cast<std::size_t>(row)];
  const QString name = sessionMark(session.number) + QLatin1Char(' ') + session.caption;
  if (comparedChip(row).contains(at.toPoint())) {
    return QStringLiteral("%1\nClick to show it on the field or not. Drag the row to shift it")
        .arg(name);
  }
  if (!comparedBrokenAt(at).empty()) {
    return rulesTip(at.x(), session.session, {name.toHtmlEscaped()});
  }
  const EventMark* mark = nearest(comparedMarks(row), at.x());
  if (mark == nullptr) return QStringLiteral("%1\nDrag to shift it").arg(name);
  const link::MatchEvent& event = session.events->at(mark->row);
  return QStringLiteral("%1\n%2  %3")
      .arg(name, momentText(event.time, 2, {}), QString::fromStdString(sentenceOf(event)));
}

void TimelineStrip::paintCompared(QPainter& painter) {
  const QFont small = themeFont(TypeRole::Small);
  const QFontMetrics metrics(small);
  for (int row = m_scroll->value(); row < m_scroll->value() + visibleRows(); ++row) {
    const ComparedRow& session = m_compared[static_cast<std::size_t>(row)];
    const QRect place = comparedRect(row);
    const QColor color = sessionColor(session.number);
    painter.setPen(QPen(theme().innerLine, 1));
    painter.drawLine(place.topLeft(), place.topRight());
    if (session.range) {
      // From its beginning to its end, as far as they are in view.
      const double from =
          std::max<double>(m_axis.pixel(session.range->begin + session.offset), place.left());
      const double to =
          std::min<double>(m_axis.pixel(session.range->end + session.offset), place.right());
      const double high = scaled(this, extentHeight);
      if (to > from) {
        painter.fillRect(QRectF(from, place.bottom() - high, to - from, high), color);
      }
    }
    painter.save();
    painter.setClipRect(place.adjusted(-place.left(), 0, place.left(), 0));
    if (const QRect broken = comparedRulesRect(row); !broken.isEmpty()) {
      paintBroken(painter, broken, session.session);
    }
    paintRow(painter, comparedMarks(row), session.events->events(), place.center().y(),
             place.bottom() - scaled(this, extentHeight), 0.75);
    painter.restore();
    const QRect chip = comparedChip(row);
    // With the mark of an event at the very end, which would stand behind it.
    painter.fillRect(chip.adjusted(0, 0, scaled(this, 6), 0), theme().window);
    const int side = scaled(this, 8);
    const QRectF box(chip.left() + scaled(this, 4) + 0.5, chip.center().y() - side / 2 + 0.5, side,
                     side);
    painter.setPen(QPen(color, 1.2));
    painter.setBrush(session.isOnField ? QBrush(color) : QBrush(Qt::NoBrush));
    painter.drawRoundedRect(box, 2, 2);
    painter.setFont(small);
    painter.setPen(session.isOnField ? theme().text : theme().secondaryText);
    const QString caption = metrics.elidedText(session.caption, Qt::ElideMiddle, place.width() / 3);
    painter.drawText(chip.adjusted(side + scaled(this, 8), 0, 0, 0),
                     Qt::AlignLeft | Qt::AlignVCenter,
                     sessionMark(session.number) + QLatin1Char(' ') + caption);
  }
}

void TimelineStrip::dragEnterEvent(QDragEnterEvent* event) {
  if (!droppedFiles(event->mimeData(), QStringLiteral("mcap")).isEmpty())
    event->acceptProposedAction();
}

void TimelineStrip::dropEvent(QDropEvent* event) {
  const QStringList paths = droppedFiles(event->mimeData(), QStringLiteral("mcap"));
  if (paths.isEmpty()) return;
  event->acceptProposedAction();
  emit filesDropped(paths);
}

}  // namespace pitchboard::ui
