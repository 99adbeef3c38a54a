// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One plot on a page: curves, a legend, and something that draws them. What it draws with is the
// subclass's: a chart over time, lanes of labels, one variable over another. UI thread only.

#include <QTimer>
#include <QWidget>
#include <optional>
#include <vector>

#include "axis_units.h"
#include "curve.h"
#include "curve_trace.h"

class QMenu;
class QVBoxLayout;

namespace pitchboard::ui {

class LegendBar;
class LinkedTime;
struct LegendEntry;

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
  /// What is shown: more curves than descriptions where one stands for every robot.
  const std::vector<Curve>& curves() const { return m_curves; }
  /// The description that a shown curve is of.
  const CurveSpec& description(int curve) const;

  void addCurve(CurveSpec curve);
  void setCurve(int index, const CurveSpec& curve);
  void removeCurve(int index);
  /// The same curves under other names; says nothing of it.
  void setDescriptions(const QList<CurveSpec>& curves);
  bool hasCurve(const CurveSpec& curve) const;
  /// Shows a curve that is there already: no longer hidden, and for a moment it stands out.
  void pointOut(const CurveSpec& curve);
  /// The curve stands out now.
  bool isPointedOut(std::size_t curve) const;
  /// A variable of this unit has a value axis here, or can have one.
  bool canTake(const QString& unit) const;
  /// Hides a curve, or shows it again.
  void toggleCurve(int index);
  /// Hides all others; shows all again where that leaves nothing to do.
  void showOnly(int index);
  /// At which axis each curve is read.
  const AxisPlan& axes() const { return m_axes; }

  LegendBar* legend() const { return m_legend; }
  const PlotFeed& feed() const { return *m_feed; }
  /// The part that curves are drawn in.
  virtual QWidget* surface() const = 0;
  /// Of the surface: where lines of moments go, which strike no name through.
  virtual QList<QRect> lineAreas() const { return {surface()->rect()}; }
  /// Whether the linked time axis runs along this plot.
  virtual bool isOverTime() const { return true; }
  /// Room that value labels need at the left, px.
  virtual int wantedLeft() const { return 0; }
  /// The same at the right, where a plot has a second value axis.
  virtual int wantedRight() const { return 0; }
  void setEdges(int left, int right);
  int left() const { return m_left; }
  int right() const { return m_right; }
  /// In coordinates of surface().
  TimeAxis timeAxis() const;
  /// A drag without keys draws a box.
  virtual void setBoxTool(bool) {}
  /// Returns the value at this place of the surface as text; empty where there is none.
  virtual QString pointedText(QPointF) const { return {}; }

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
  /// The entry of a compared session in the legend was clicked.
  void sessionToggled(quint64 id);
  void pointed(std::optional<QPointF> at);  ///< the pointer, in the surface

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
  AxisPlan m_axes;

 private:
  void edited();
  void expand();
  std::vector<AxisRequest> unitsOfCurves() const;
  LegendEntry legendEntry(std::size_t index) const;
  /// Of the curves of compared sessions, behind those of the source.
  QList<LegendEntry> comparedEntries() const;
  /// Without drawing again.
  void setHidden(int index, bool on);
  int freeColor() const;

  LegendBar* m_legend;
  QVBoxLayout* m_column;
  std::optional<CurveSpec> m_pointedOut;
  QTimer m_pointingOut;  // until it no longer stands out
  QList<CurveSpec> m_descriptions;
  std::vector<qsizetype> m_describedBy;  // the description of each curve
  quint64 m_expandedFor = 0;             // the feed's looks()
  int m_left = 0, m_right = 0;
};

/// The pane for a description's kind.
PlotPane* makePane(PlotFeed* feed, const PaneSpec& spec, QWidget* parent);

}  // namespace pitchboard::ui
