// SPDX-License-Identifier: GPL-3.0-or-later
#include "notes_model.h"

#include <algorithm>
#include <utility>

#include <robotlink/frame/match_event.h>
#include <ui/base/number_box.h>
#include <ui/base/time_axis.h>
#include <ui/sources/event_list.h>
#include <ui/sources/note_board.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {

using telemetry::DrawnNote;

NotesModel::NotesModel(NoteBoard* board, QObject* parent)
    : QAbstractTableModel(parent), m_board(board) {
  connect(board, &NoteBoard::changed, this, &NotesModel::updateSoon);
  connect(board->shown(), &ShownMoment::sourceChanged, this, &NotesModel::followList);
  connect(board->shown(), &ShownMoment::timesOfDayChanged, this, &NotesModel::updateSoon);
  followList();
}

/// Bookmarks are events of the source.
void NotesModel::followList() {
  EventList* list = m_board->shown()->events();
  if (m_list != nullptr && m_list != list) m_list->disconnect(this);
  if (std::exchange(m_list, list) != list) {
    connect(list, &EventList::changed, this, &NotesModel::updateSoon);
  }
  updateSoon();
}

void NotesModel::updateSoon() {
  if (std::exchange(m_isOld, true)) return;
  QMetaObject::invokeMethod(this, &NotesModel::update, Qt::QueuedConnection);
}

void NotesModel::update() {
  if (!std::exchange(m_isOld, false)) return;
  std::vector<Row> rows;
  for (const NoteBoard::Entry& one : m_board->entries()) rows.push_back({one.id, one.note});
  for (const link::MatchEvent& event : m_board->shown()->events()->events()) {
    if (event.kind != link::MatchEventKind::Bookmark) continue;
    Row& row = rows.emplace_back();
    row.note.time = event.time;
    row.note.text = event.detail;
  }
  std::ranges::stable_sort(rows, {}, [](const Row& row) { return row.note.time; });
  const bool isSame = std::ranges::equal(
      rows, m_rows, [](const Row& a, const Row& b) { return a.id == b.id && a.note == b.note; });
  if (isSame) return;
  // Where as many remain, what is selected stays selected.
  if (rows.size() == m_rows.size()) {
    m_rows = std::move(rows);
    emit dataChanged(index(0, 0), index(rowCount() - 1, columns - 1));
    return;
  }
  beginResetModel();
  m_rows = std::move(rows);
  endResetModel();
}

int NotesModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int NotesModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QVariant NotesModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const Row& row = m_rows[static_cast<std::size_t>(index.row())];
  const bool isBookmark = row.id == 0;
  if (role == Qt::ToolTipRole && index.column() == Text)
    return QString::fromStdString(row.note.text);
  if (role != Qt::DisplayRole && role != sortRole && role != Qt::EditRole) return {};
  switch (index.column()) {
    case Time:
      return role == sortRole ? QVariant(row.note.time)
                              : QVariant(momentText(row.note.time, 2, m_board->shown()->clock()));
    case Duration:
      if (role == sortRole) return isBookmark ? 0.0 : row.note.duration;
      // As text, for an editor that also takes a comma.
      if (role == Qt::EditRole) return QString::number(row.note.duration);
      return isBookmark ? QString() : QStringLiteral("%1 s").arg(row.note.duration, 0, 'f', 1);
    case What:
      return isBookmark ? QStringLiteral("Bookmark") : titleOf(row.note);
    case Text:
      return QString::fromStdString(row.note.text);
    default:
      return {};
  }
}

bool NotesModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (!index.isValid() || role != Qt::EditRole || !(flags(index) & Qt::ItemIsEditable))
    return false;
  const Row row = m_rows[static_cast<std::size_t>(index.row())];
  const QString text = value.toString().simplified().left(EventList::maxNote);
  if (row.id == 0) {
    m_board->shown()->setNote(row.note.time, text);
    return true;
  }
  // The list may be older than another change.
  const auto now = m_board->find(row.id);
  if (!now) return false;
  DrawnNote changed = *now;
  if (index.column() == Text) {
    if (text.isEmpty() && changed.shape == telemetry::NoteShape::Text) return false;
    changed.text = text.toStdString();
  } else {
    QString seconds = value.toString();
    const auto number = numberFromText(seconds.remove(QLatin1Char('s')).trimmed());
    if (!number) return false;
    changed.duration = std::clamp(*number, DrawnNote::shortestDuration, DrawnNote::longestDuration);
  }
  m_board->change(row.id, changed);
  return true;
}

Qt::ItemFlags NotesModel::flags(const QModelIndex& index) const {
  Qt::ItemFlags all = QAbstractTableModel::flags(index);
  if (!index.isValid()) return all;
  const bool isBookmark = idOf(index.row()) == 0;
  if (index.column() == Text || (index.column() == Duration && !isBookmark)) {
    all |= Qt::ItemIsEditable;
  }
  return all;
}

QVariant NotesModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  static const char* const names[columns] = {"Time", "Shown for", "Note", "Text"};
  return QString::fromUtf8(names[section]);
}

}  // namespace pitchboard::ui
