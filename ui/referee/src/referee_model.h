// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The players of one team as the referee says them, and what their robots told the referee, as a
// table. UI thread only; owned by its view.

#include <QAbstractTableModel>
#include <array>
#include <vector>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::ui {

class RefereeModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { Player, State, Left, Cards, Robot, columns };
  static constexpr int numberRole = Qt::UserRole;  ///< on the shirt
  using QAbstractTableModel::QAbstractTableModel;

  /// In order of numbers, and with time and cards beside the state: rows keep their places while
  /// somebody works with them.
  void setCompact(bool on) {
    if (on == m_compact) return;
    m_compact = on;
    emit headerDataChanged(Qt::Horizontal, 0, columns - 1);
  }

  /// Shows the players with these shirts. The frame has the game.
  void update(const link::MatchFrame& frame, const GameTeam& team, const std::vector<int>& shirts);

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation,
                      int role = Qt::DisplayRole) const override;

 private:
  struct Row {
    int number = 0;
    bool penalised = false, offline = false;
    std::array<QString, columns> texts;
    QString tip, stateTip;
    bool operator==(const Row&) const = default;
  };
  Row rowOf(int shirt, const GamePlayer& player, int secondsLeft,
            const link::RobotReplyView* reply) const;
  std::vector<Row> m_rows;
  bool m_compact = false;
};

}  // namespace pitchboard::ui
