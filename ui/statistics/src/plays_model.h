// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plays of a match as a table, and which of them are shown. UI thread only.

#include <QAbstractTableModel>
#include <QDateTime>
#include <optional>
#include <utility>
#include <vector>

#include <robotlink/report/play_event.h>
#include <ui/base/text_filter.h>

namespace pitchboard::ui {

class PlaysModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Time, Kind, Robot, What, columns };
  static constexpr int sortRole = Qt::UserRole;  ///< s, or the text
  using QAbstractTableModel::QAbstractTableModel;

  /// `clock`: the time of day at second 0; empty: times are shown in seconds.
  void show(std::vector<link::PlayEvent> plays, const std::optional<QDateTime>& clock);
  const link::PlayEvent& at(int row) const { return m_plays[static_cast<std::size_t>(row)]; }
  const std::vector<link::PlayEvent>& plays() const { return m_plays; }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  QString text(const link::PlayEvent& play, int column) const;

  std::vector<link::PlayEvent> m_plays;
  std::optional<QDateTime> m_clock;
};

/// Plays of a kind, and of a team or a robot, that contain the filter text.
class PlaysFilter : public TextFilter {
  Q_OBJECT
 public:
  using TextFilter::TextFilter;
  /// Empty: all.
  void setKind(std::optional<link::PlayKind> kind) {
    m_kind = kind;
    invalidateFilter();
  }
  /// Of this robot, also as the other one, or of this team; empty: all.
  void setWho(std::string robot, std::optional<TeamColor> team) {
    m_robot = std::move(robot);
    m_team = team;
    invalidateFilter();
  }

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

 private:
  std::optional<link::PlayKind> m_kind;
  std::string m_robot;
  std::optional<TeamColor> m_team;
};

}  // namespace pitchboard::ui
