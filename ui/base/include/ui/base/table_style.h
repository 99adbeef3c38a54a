// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The style of all tables of the window, and the label that replaces an empty table. UI thread
// only.

#include <QApplication>
#include <QHeaderView>
#include <QLabel>
#include <QStyledItemDelegate>
#include <QTableView>

#include <ui/base/elide_text.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {

/// Shortens texts that do not fit, and keeps their numbers: Qt would cut off the end.
class CellDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override {
    QStyleOptionViewItem cell = option;
    initStyleOption(&cell, index);
    const QStyle* style = cell.widget ? cell.widget->style() : QApplication::style();
    const int margin = style->pixelMetric(QStyle::PM_FocusFrameHMargin, &cell, cell.widget) + 1;
    const QRect room = style->subElementRect(QStyle::SE_ItemViewItemText, &cell, cell.widget);
    cell.text = elideText(QFontMetricsF(cell.font), cell.text, room.width() - 2 * margin);
    style->drawControl(QStyle::CE_ItemViewItem, &cell, painter, cell.widget);
  }
};

/// Sets rows of equal height, no grid, selection of whole rows, and numbers that are never cut.
inline void styleTable(QTableView* table) {
  table->setItemDelegate(new CellDelegate(table));
  table->setFrameShape(QFrame::NoFrame);
  table->setShowGrid(false);
  table->setAlternatingRowColors(true);
  table->setWordWrap(false);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setTabKeyNavigation(false);
  table->verticalHeader()->hide();
  table->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
  table->verticalHeader()->setMinimumSectionSize(scaled(table, 20));
  table->verticalHeader()->setDefaultSectionSize(scaled(table, 20));
  table->horizontalHeader()->setFont(themeFont(TypeRole::Secondary));
  table->horizontalHeader()->setStretchLastSection(true);
  table->horizontalHeader()->setHighlightSections(false);
  table->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
}

/// Makes a label that explains why the table is empty. Tests find it by its object name.
inline QLabel* makeEmptyLabel(QWidget* parent, const QString& objectName) {
  auto* label = new QLabel(parent);
  label->setObjectName(objectName);
  label->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  label->setForegroundRole(QPalette::PlaceholderText);
  label->setBackgroundRole(QPalette::Base);
  label->setAutoFillBackground(true);
  label->setMargin(scaled(parent, 12));
  label->setWordWrap(true);
  return label;
}

}  // namespace pitchboard::ui
