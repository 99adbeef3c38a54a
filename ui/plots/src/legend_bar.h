// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The row above a plot: a stroke of each curve's colour, its name and its value, and at both ends
// the units of the value axes. Where the width is not enough, the wheel and two arrows scroll by
// entries. A click hides a curve, a double click leaves only it. Not Qt's QLegend: its entries are
// one text in one colour, so values that run would move the names, and it has no tips, menus or
// double clicks. UI thread only.

#include <QColor>
#include <QList>
#include <QRect>
#include <QWidget>

namespace pitchboard::ui {

struct LegendEntry {
  QString text;
  QString value;
  QColor color;
  int dash = 0;  ///< of curveDash()
  QString tip;
  QString side;      ///< behind the name, in a quieter colour: "[cm]", "right"
  bool odd = false;  ///< its unit is not that of the axis
  bool hidden = false;
  bool pointedOut = false;  ///< stands out for a moment
  bool muted = false;       ///< no data yet
  bool faulty = false;      ///< never will be
  quint64 session = 0;      ///< id of the compared session that it is of; 0: of none
  bool operator==(const LegendEntry&) const = default;
};

class LegendBar : public QWidget {
  Q_OBJECT
 public:
  explicit LegendBar(QWidget* parent = nullptr);

  void setTitle(const QString& title);
  void setEntries(const QList<LegendEntry>& entries);
  const QList<LegendEntry>& entries() const { return m_entries; }
  /// Edges of the plot below, as distances from those of the widget: entries stand between them,
  /// units outside.
  void setEdges(int left, int right);
  void setUnits(const QString& left, const QString& right);
  /// The entry that stands first. Others before it are scrolled out of sight.
  int first() const { return m_first; }
  void setFirst(int index);
  /// Scrolls until this entry is in sight.
  void reveal(int index);
  /// Empty while it is scrolled out of sight.
  QRect rectOf(int index) const { return m_rects.value(index); }

 signals:
  void menuRequested(int index, const QPoint& globalPosition);
  void toggled(int index);   ///< click
  void isolated(int index);  ///< double click; its first click was a toggle

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void arrange();
  int entryAt(const QPoint& position) const;
  int widthOf(const LegendEntry& entry) const;
  /// Scrolls when it is one of the arrows.
  bool pressArrow(const QPoint& position);

  QString m_title, m_leftUnit, m_rightUnit;
  QList<LegendEntry> m_entries;
  QList<QRect> m_rects;  // empty where an entry is out of sight
  QRect m_back, m_on;    // the arrows; empty while everything fits
  int m_first = 0, m_last = 0;
  int m_turned = 0;  // of a wheel, less than a notch
  int m_left = 0;
  int m_right = 0;
};

}  // namespace pitchboard::ui
