// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The row above a plot: a stroke of each curve's colour, its name and its value; as many rows as
// the width needs. Not Qt's QLegend: its entries are one text in one colour, so values that run
// would move the names, and it has no tips, menus or double clicks. UI thread only.

#include <QColor>
#include <QList>
#include <QRect>
#include <QWidget>

namespace pitchboard::ui {

struct LegendEntry {
  QString text;
  QString value;
  QColor color;
  QString tip;
  bool muted = false;   ///< no data yet
  bool faulty = false;  ///< never will be
  bool operator==(const LegendEntry&) const = default;
};

class LegendBar : public QWidget {
  Q_OBJECT
 public:
  explicit LegendBar(QWidget* parent = nullptr);

  void setTitle(const QString& title);
  void setEntries(const QList<LegendEntry>& entries);
  const QList<LegendEntry>& entries() const { return m_entries; }
  /// Where the first entry begins: the left edge of the plot below.
  void setLeft(int x, int right);
  /// Of an entry, for tests and menus.

 signals:
  void menuRequested(int index, const QPoint& globalPosition);
  void activated(int index);  ///< double click

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void arrange();
  int entryAt(const QPoint& position) const;

  QString m_title;
  QList<LegendEntry> m_entries;
  QList<QRect> m_rects;
  int m_left = 0;
  int m_right = 0;
};

}  // namespace pitchboard::ui
