// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Beside the plots: the times of A and B, the table between them, and what happened there.

#include <QList>
#include <QPointer>
#include <QWidget>
#include <deque>

#include "plot_feed.h"

class QLabel;
class QTableView;
class QToolButton;

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

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  /// What the widest cell of a column needs.
  int cellWidth(int column) const;
  void fitNameColumn();
  void forgetTextWidths();
  void fitTextColumns();

  PlotFeed* m_feed;
  MarksModel* m_model;
  void setWhole(bool on);

  QToolButton* m_span;  // what mean, σ, min, max and RMS are of
  bool m_whole = false;
  QList<QPointer<PlotPane>> m_panes;
  QLabel* m_times;
  QLabel* m_difference;
  QTableView* m_table;
  QLabel* m_events;
};

/// "Between A and B: B1 kicks at 05:04.60, goal for BLUE at 05:06.10 and 2 more." Events in order
/// of time, written as the feed writes it; the marks (s) in either order. Empty when there are
/// none.
QString eventsBetween(const std::deque<link::MatchEvent>& events, double a, double b,
                      const PlotFeed& feed);

}  // namespace pitchboard::ui
