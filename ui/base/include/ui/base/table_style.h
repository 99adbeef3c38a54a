// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How every table of the studio looks, so that none has a look of its own. Window thread.

#include <QHeaderView>
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

}  // namespace pitchboard::ui
