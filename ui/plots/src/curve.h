// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A curve in a plot: its description, and the column that it shows at the moment. A variable's
// column is the source's; a derived curve has a column of its own that is computed beside the UI
// thread. UI thread only.

#include <QLineF>
#include <QList>
#include <memory>
#include <span>
#include <vector>

#include <ui/plots/plot_layout.h>

#include "plot_feed.h"

namespace pitchboard::ui {

class DerivedSeries;

class Curve {
 public:
  explicit Curve(const CurveSpec& spec);
  ~Curve();
  Curve(Curve&&) noexcept;
  Curve& operator=(Curve&&) noexcept;

  const CurveSpec& spec() const { return m_spec; }
  void setSpec(const CurveSpec& spec);

  /// Takes the newest rows.
  void update(PlotFeed& feed);
  /// No data: see note().
  bool isWaiting() const { return !m_view; }
  /// Why there is nothing to see: "waiting for B1/…", what is wrong with an expression. Else empty.
  QString note() const { return m_note; }
  bool isFaulty() const { return m_faulty; }
  /// More rows come although the source stands still.
  bool isWorking() const;

  const ColumnView& view() const { return m_view; }
  /// Xy: the second input, over view().
  const ColumnView& ordinate() const { return m_ordinate; }
  /// The same curve in a compared session, at the times of there.
  struct Compared {
    quint64 id = 0;             ///< of the session
    ColumnView view, ordinate;  ///< nothing where it has none
    std::shared_ptr<DerivedSeries> derived = nullptr;
  };
  /// As of the last update; null for a session that came later.
  const Compared* compared(const ComparedRows& session) const;

  QString name() const { return curveName(m_spec); }
  QString unit() const;
  QColor color() const;
  bool isHidden() const { return m_spec.hidden.contains(name()); }
  /// At this time, or the newest value without one; nothing where the curve has a gap.
  std::optional<double> valueAt(std::optional<double> time) const;
  /// The same as text, codes as their labels.
  QString valueTextAt(std::optional<double> time) const;
  /// "walk forward, slow" for a code; its number if it has no label.
  QString codeText(double value) const;

 private:
  void updateCompared(const PlotFeed& feed);

  CurveSpec m_spec;
  ColumnView m_view;
  ColumnView m_ordinate;
  QString m_note;
  bool m_faulty = false;
  std::unique_ptr<DerivedSeries> m_derived;
  std::vector<Compared> m_compared;
};

/// The value of a column at this time, or its newest one; nothing where it has a gap.
std::optional<double> valueIn(const ColumnView& view, std::optional<double> time);
/// "walk forward, slow" for a code of this column; its number if it has no label.
QString codeTextIn(const ColumnView& view, double value);
/// The value of a column as text, codes as their labels.
QString valueTextIn(const ColumnView& view, std::optional<double> time);

/// Curves of the mock, then four more; each has a shade for either theme.
QColor curveColor(int number);
inline constexpr int curveColors = 8;
/// Of the curves that have a colour for the second time and more: 0 is a whole line. There are
/// four.
int curveDash(int number);
/// The dash of an abandoned future, which no curve has.
inline constexpr int futureDash = 4;
/// The parts of the line of neighbouring points that its dash leaves, for QPainter::drawLines().
/// They depend on x only, counted from `origin`: a curve that scrolls takes its dashes along.
/// `pixel`: of the mock.
QList<QLineF> dashedLine(std::span<const QPointF> line, int dash, double pixel, double origin);
/// Curves of compared sessions have the session's colour and are so thin; those of an abandoned
/// future have the curve's own colour, so much paler.
inline constexpr double comparedPaleness = 0.5, comparedWidth = 0.66;
struct ComparedLook {
  QColor color;
  double width = 1.0;  ///< times that of the curve
  int dash = 0;        ///< of curveDash(); tells the curves of a plot apart
};
/// `curve`: its position in the plot. `base`: the ground of the plot.
ComparedLook comparedLook(const ComparedRows& session, std::size_t curve, const QColor& own,
                          const QColor& base);
/// A curve that stands out for a moment is so many times as wide.
inline constexpr double pointedOutWidth = 2.5;
QColor mixedColor(const QColor& a, const QColor& b, double share);
/// Ground of a stretch of a lane: walking, turning, stopping, kicking and gait have theirs.
QColor laneColor(const QString& word, int code);

}  // namespace pitchboard::ui
