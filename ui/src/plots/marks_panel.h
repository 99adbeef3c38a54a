// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Beside the plots: the times of A and B, the table between them, and what happened there.

#include <QWidget>

#include "plot_feed.h"

class QLabel;
class QTableView;

namespace pitchboard::ui {

class MarksModel;
class PlotPane;

class MarksPanel : public QWidget {
  Q_OBJECT
 public:
  MarksPanel(PlotFeed* feed, QWidget* parent);

  MarksModel* model() const { return m_model; }
  /// What the curves of these plots are at and between the marks. Hidden without marks.
  void refresh(const QList<PlotPane*>& panes);
  void copyTable() const;
  QSize sizeHint() const override;

 private:
  PlotFeed* m_feed;
  MarksModel* m_model;
  QLabel* m_times;
  QLabel* m_difference;
  QTableView* m_table;
  QLabel* m_events;
};

/// "Kick at 05:04.60 lies between A and B.", "3 kicks, 1 fall lie between A and B." Times in s; the
/// marks in either order.
QString eventsBetween(const std::deque<PlotEvent>& events, double a, double b);

}  // namespace pitchboard::ui
