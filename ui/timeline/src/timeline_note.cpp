// SPDX-License-Identifier: GPL-3.0-or-later
// Notes of bookmarks are written in their place on the timeline.
#include <QKeyEvent>
#include <QLineEdit>
#include <algorithm>

#include <ui/base/theme.h>
#include <ui/sources/event_list.h>
#include <ui/sources/timeline.h>

#include "timeline_strip.h"

namespace pitchboard::ui {

void TimelineStrip::editNote(int row) {
  finishNote(true);
  const EventList* list = m_timeline->events();
  if (row < 0 || row >= list->rowCount()) return;
  m_noteTime = list->event(row).time;
  m_note = new QLineEdit(QString::fromStdString(list->event(row).detail), this);
  m_note->setObjectName(QStringLiteral("bookmarkNote"));
  m_note->setFont(themeFont(TypeRole::Secondary));
  m_note->setMaxLength(EventList::maxNote);
  m_note->setPlaceholderText(QStringLiteral("Note, then Enter"));
  const int wide = std::min(scaled(this, 200), width());
  const int x =
      std::clamp(static_cast<int>(m_axis.pixel(m_noteTime)) + scaled(this, 8), 0, width() - wide);
  m_note->setGeometry(x, 0, wide, scaled(this, 22));
  m_note->show();
  m_note->selectAll();
  m_note->setFocus();
  connect(m_note, &QLineEdit::editingFinished, this, [this] { finishNote(true); });
  m_note->installEventFilter(this);
}

bool TimelineStrip::eventFilter(QObject* watched, QEvent* event) {
  if (watched == m_note && event->type() == QEvent::KeyPress &&
      static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    finishNote(false);
    return true;
  }
  return QWidget::eventFilter(watched, event);
}

void TimelineStrip::finishNote(bool keep) {
  if (m_note == nullptr) return;
  QLineEdit* note = std::exchange(m_note, nullptr);
  note->removeEventFilter(this);
  const bool hadFocus = note->hasFocus();
  if (keep) m_timeline->setNote(m_noteTime, note->text());
  note->hide();
  note->deleteLater();
  if (hadFocus) setFocus();
}

}  // namespace pitchboard::ui
