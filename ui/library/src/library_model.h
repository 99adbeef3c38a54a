// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The table of the library. It sorts and filters by itself: ten thousand rows take a few
// milliseconds, where a QSortFilterProxyModel asks for every text again. UI thread only.

#include <QAbstractTableModel>
#include <QIcon>
#include <QPixmap>
#include <QStringList>
#include <functional>
#include <unordered_map>
#include <vector>

#include "library_row.h"

namespace pitchboard::ui {

class LibraryModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  using QAbstractTableModel::QAbstractTableModel;

  /// `of` returns the picture of a session, or a null one until changedPicture() is called. `blank`
  /// keeps its place.
  void setPictures(std::function<QPixmap(const LibraryRowPtr&)> of, const QPixmap& blank) {
    m_picture = std::move(of);
    m_blank = QIcon(blank);
  }
  /// Replaces all sessions.
  void show(const std::vector<LibraryRowPtr>& rows);
  /// Adds these sessions, or replaces those with the same path.
  void merge(const std::vector<LibraryRowPtr>& rows);
  /// Keeps sessions in which each word occurs.
  void setFilter(const QString& text);
  void changedPicture(const LibraryRowPtr& row);

  const LibraryRowPtr& at(int row) const { return m_rows[m_shown[static_cast<std::size_t>(row)]]; }
  /// Returns the row that shows this file; -1 if none does.
  int rowOf(const QString& path) const;
  std::size_t all() const { return m_rows.size(); }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  void sort(int column, Qt::SortOrder order) override;

 private:
  QVariant pictureOf(const LibraryRowPtr& row) const;
  void arrange();

  std::vector<LibraryRowPtr> m_rows;
  std::unordered_map<std::string, std::size_t> m_places;  // in m_rows, by path
  std::vector<std::size_t> m_shown;                       // places in m_rows, in their order
  QStringList m_words;
  int m_column = LibraryRow::Date;
  Qt::SortOrder m_order = Qt::DescendingOrder;
  std::function<QPixmap(const LibraryRowPtr&)> m_picture;
  QIcon m_blank;
};

}  // namespace pitchboard::ui
