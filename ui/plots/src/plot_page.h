// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A tab of the plots: plots stacked over one time axis, marks across all of them, and the table of
// what lies between the marks. Takes drops for all its plots. UI thread only.

#include <QList>
#include <QPointer>
#include <QWidget>

#include "plot_pane.h"

class QLabel;
class QScrollArea;
class QSplitter;

namespace pitchboard::ui {

class LinkedTime;
class MarkHeads;
class MarksPanel;
class TimeLines;
class TimeRuler;
struct DropHint;

class PlotPage : public QWidget {
  Q_OBJECT
 public:
  PlotPage(PlotFeed* feed, const PageSpec& spec, QWidget* parent = nullptr);

  PageSpec spec() const;
  void setName(const QString& name);
  QString name() const { return m_name; }

  QList<PlotPane*> panes() const;
  PlotPane* insertPane(int index, const PaneSpec& spec);
  void removePane(PlotPane* pane);
  /// A pane in place of another, of another kind.
  void replacePane(PlotPane* pane, const PaneSpec& spec);

  /// Where variables go when nobody said where: the last plot that can take them, lanes for codes.
  void addVariables(const QStringList& names);
  /// What a drop there does. `position` in the page.
  void drop(const QStringList& names, const QPoint& position);
  void addCurve(const CurveSpec& curve);

  MarksPanel* marksPanel() const { return m_marks; }
  /// What a picture of the page shows: the plots with their marks, without the table.
  QWidget* picture() const { return m_stack; }
  /// The time axis in the pixels of picture().
  TimeAxis pictureAxis() const;
  /// While on, nothing is drawn that only makes sense on the screen: pointer, moment, scroll bar,
  /// the handles between plots.
  void setForPicture(bool on);
  void removeAll();
  void setBoxTool(bool on);
  /// A curve is still being computed.
  bool isWorking() const;
  /// Draws what is new.
  void refresh();

 signals:
  void changed();
  /// Curves were to be added to plots that have them already; they stand out there now.
  void alreadyPlotted(const QStringList& names);
  void menuRequested(pitchboard::ui::PlotPane* pane, int curve, const QPoint& globalPosition);
  void sessionToggled(quint64 id);

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dragMoveEvent(QDragMoveEvent* event) override;
  void dragLeaveEvent(QDragLeaveEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  enum class Place { OnPane, NewPane, NewXy };
  struct Target {
    Place place = Place::NewPane;
    PlotPane* pane = nullptr;
    int index = 0;
    QRect area;  // in m_stack
  };
  Target targetAt(const QPoint& position, qsizetype count) const;
  /// Changes that are one for whoever undoes them: changed() comes at their end.
  class Batch;
  void notifyChanged();
  bool isCoded(const QString& name) const;
  QString unitOf(const QString& name) const;
  /// Each to the first of these plots that can show it, else to a new one at `index`.
  void place(const QStringList& names, QList<PlotPane*> takers, int index);
  /// Makes them stand out in the first of these plots that has each, and reports them. Returns the
  /// others.
  QStringList pointOut(const QStringList& names, const QList<PlotPane*>& in);
  void pointOut(PlotPane* pane, const CurveSpec& curve);
  void align();
  void placeLines();
  void giveLanesTheirHeight();
  void showLanesWhereTheyFit();
  void showPointed();
  void showMarks();
  TimeAxis timeAxis() const;

  PlotFeed* m_feed;
  QString m_name;
  QWidget* m_stack;
  QSplitter* m_panes;
  QSplitter* m_split;
  QScrollArea* m_scroll;  // of m_panes
  QLabel* m_empty;
  MarkHeads* m_heads;
  TimeRuler* m_ruler;
  TimeLines* m_lines;
  MarksPanel* m_marks;
  QPointer<PlotPane> m_pointedPane;
  std::optional<QPointF> m_pointedAt;  // in the pane's surface
  int m_left = 0, m_right = 0;
  int m_batches = 0;
  bool m_changedInBatch = false;
  bool m_boxTool = false;
  bool m_aligning = false;
};

}  // namespace pitchboard::ui
