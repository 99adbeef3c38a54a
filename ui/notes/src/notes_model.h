// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The drawn notes and the bookmarks of a source as a table, in order of time. It is made anew after
// changes, at most once for each time that the event loop runs. UI thread only.

#include <QAbstractTableModel>
#include <QPointer>
#include <optional>
#include <vector>

#include <telemetry/session/drawn_notes.h>

namespace pitchboard::ui {

class EventList;
class NoteBoard;

class NotesModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Time, Duration, What, Text, columns };
  static constexpr int sortRole = Qt::UserRole;

  NotesModel(NoteBoard* board, QObject* parent);

  double timeOf(int row) const { return m_rows[static_cast<std::size_t>(row)].note.time; }
  /// Returns the note of NoteBoard; 0 for a bookmark.
  quint64 idOf(int row) const { return m_rows[static_cast<std::size_t>(row)].id; }
  const telemetry::DrawnNote& noteOf(int row) const {
    return m_rows[static_cast<std::size_t>(row)].note;
  }
  /// Makes it anew now, if it is out of date.
  void update();

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  struct Row {
    quint64 id = 0;
    telemetry::DrawnNote note;  // of a bookmark: time and text
  };
  void updateSoon();
  void followList();

  NoteBoard* m_board;
  QPointer<EventList> m_list;
  std::vector<Row> m_rows;
  bool m_isOld = false;
};

}  // namespace pitchboard::ui
