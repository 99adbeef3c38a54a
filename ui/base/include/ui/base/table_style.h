// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What all tables of the window share: their look, and the label that stands in the place of one
// that has no rows. UI thread only.

#include <QHeaderView>
#include <QLabel>
#include <QTableView>

#include <ui/base/theme.h>

namespace pitchboard::ui {

/// The look that all tables share: rows of one height, no grid, whole rows selected.
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

/// Says in the place of an empty table why it is empty. The name is for tests.
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
