// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One plot on a page: curves, a legend, and something that draws them. What it draws with is the
// subclass's: a chart over time, lanes of words, one variable over another. UI thread only.

#include <QWidget>
#include <vector>

#include "curve.h"
#include "curve_trace.h"

class QMenu;
class QVBoxLayout;

namespace pitchboard::ui {

class LegendBar;
class LinkedTime;

class PlotPane : public QWidget {
  Q_OBJECT
 public:
  /// Distance of a plot's right edge from the page's, px of the mock: half a time label.
  static constexpr int rightMargin = 20;

  ~PlotPane() override;

  PaneKind kind() const { return m_spec.kind; }
  /// As it is now, curves included; `share` is the page's to fill in.
  PaneSpec spec() const;
  /// Title, limits, axes: everything but the curves.
  void setOptions(const PaneSpec& spec);
  const std::vector<Curve>& curves() const { return m_curves; }

  void addCurve(CurveSpec curve);
  void setCurve(int index, const CurveSpec& curve);
  void removeCurve(int index);
  bool hasCurve(const CurveSpec& curve) const;

  LegendBar* legend() const { return m_legend; }
  /// The part that curves are drawn in.
  virtual QWidget* surface() const = 0;
  /// Whether the linked time axis runs along this plot.
  virtual bool isOverTime() const { return true; }
  /// Room that value labels need at the left, px.
  virtual int wantedLeft() const { return 0; }
  void setLeft(int left);
  int left() const { return m_left; }
  /// In coordinates of surface().
  TimeAxis timeAxis() const;
  /// A drag without keys draws a box.
  virtual void setBoxTool(bool) {}

  /// Takes the newest rows and draws what is visible of them.
  void refresh();
  /// Only the values in the legend.
  void showValues();
  /// Entries of its own in the context menu.
  virtual void extendMenu(QMenu*) {}

 signals:
  void changed();      ///< something that a preset holds
  void leftChanged();  ///< wantedLeft() or a fixed height did
  void menuRequested(int curve, const QPoint& globalPosition);  ///< curve: -1 for the plot
  void editRequested(int curve);

 protected:
  PlotPane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent);
  /// Below the legend; called once by the subclass.
  void setSurface(QWidget* surface);
  void contextMenuEvent(QContextMenuEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;
  virtual void draw() = 0;
  virtual void restyle() {}
  virtual bool wantsLegend() const { return true; }

  PlotFeed* m_feed;
  PaneSpec m_spec;  // without curves
  std::vector<Curve> m_curves;

 private:
  void edited();
  int freeColor() const;

  LegendBar* m_legend;
  QVBoxLayout* m_column;
  int m_left = 0;
};

/// The pane for a description's kind.
PlotPane* makePane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent);

}  // namespace pitchboard::ui
