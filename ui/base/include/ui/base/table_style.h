// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The style of all tables of the window, and the label that replaces an empty table. UI thread
// only.

#include <QHeaderView>
#include <QLabel>
#include <QTableView>

#include <ui/base/theme.h>

namespace pitchboard::ui {

/// Sets rows of equal height, no grid, and selection of whole rows.
inline void styleTable(QTableView* table) {
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
