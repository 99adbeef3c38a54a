// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The probability of a goal of each team until a time after the explored moment, with its 95 %
// band, and a line at the time that the field shows. UI thread only.

#include <QWidget>

#include <ui/explore/explorer.h>

namespace pitchboard::ui {

class GoalChart : public QWidget {
 public:
  explicit GoalChart(QWidget* parent);
  /// Null: an empty chart. It is read now and not kept.
  void show(const ExploredMoment* found, int second);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Line {
    std::optional<TeamColor> team;
    std::vector<rollout::Share> shares;
  };
  std::array<Line, 2> m_lines;
  double m_most = 0.1;  // at the upper edge
  int m_second = 0;
};

/// The team's colour; a neutral one if the team is unknown.
QColor teamLineColor(const std::optional<TeamColor>& team);

}  // namespace pitchboard::ui
