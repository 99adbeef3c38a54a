// SPDX-License-Identifier: GPL-3.0-or-later
#include "variables_header.h"

#include <QMenu>
#include <algorithm>

#include <ui/base/theme.h>

#include "variables_model.h"

namespace pitchboard::ui {

VariablesHeader::VariablesHeader(QWidget* parent) : QHeaderView(Qt::Horizontal, parent) {
  setFont(themeFont(TypeRole::Secondary));
  setHighlightSections(false);
  setSectionsClickable(true);
  setSectionsMovable(true);
  setFirstSectionMovable(false);
  setStretchLastSection(false);
  // In the order of the catalog at first, and again on a third click.
  setSortIndicatorClearable(true);
  setContextMenuPolicy(Qt::CustomContextMenu);
  connect(this, &QWidget::customContextMenuRequested, this, [this](QPoint at) {
    auto* menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    fillColumns(menu);
    menu->popup(mapToGlobal(at));
  });
  // A curve has no order.
  connect(this, &QHeaderView::sortIndicatorChanged, this, [this](int column, Qt::SortOrder) {
    if (column == VariablesModel::Spark) setSortIndicator(-1, Qt::AscendingOrder);
  });
}

void VariablesHeader::setUpColumns() {
  setMinimumSectionSize(scaled(this, 24));
  setSectionResizeMode(VariablesModel::Name, QHeaderView::Stretch);
  const std::pair<int, int> widths[] = {{VariablesModel::Value, 52},
                                        {VariablesModel::Unit, 38},
                                        {VariablesModel::Rate, 66},
                                        {VariablesModel::Age, 56},
                                        {VariablesModel::Spark, 60}};
  const QFontMetrics metrics(font());
  for (const auto& [column, width] : widths) {
    // Names get what is left; the heads stay whole.
    const QString head = model()->headerData(column, Qt::Horizontal).toString();
    const int least = metrics.horizontalAdvance(head) + scaled(this, 14);
    resizeSection(column, std::max(scaled(this, width), least));
  }
  setSectionHidden(VariablesModel::Rate, true);
  setSectionHidden(VariablesModel::Age, true);
  setSectionHidden(VariablesModel::Spark, m_hidSpark);
  setSortIndicator(-1, Qt::AscendingOrder);
}

// Names are not cut for a curve.
void VariablesHeader::resizeEvent(QResizeEvent* event) {
  QHeaderView::resizeEvent(event);
  constexpr int least = 300;  // px of the mock
  const bool fits = width() >= scaled(this, least);
  const bool hidden = isSectionHidden(VariablesModel::Spark);
  if (fits ? !m_hidSpark : hidden) return;
  m_hidSpark = !fits;
  setSectionHidden(VariablesModel::Spark, !fits);
}

QByteArray VariablesHeader::stateToKeep() {
  if (m_hidSpark) setSectionHidden(VariablesModel::Spark, false);
  return saveState();
}

void VariablesHeader::fillColumns(QMenu* menu) {
  menu->clear();
  for (int c = 1; c < VariablesModel::columns; ++c) {
    QAction* action =
        menu->addAction(model()->headerData(c, Qt::Horizontal, Qt::DisplayRole).toString());
    action->setCheckable(true);
    action->setChecked(!isSectionHidden(c));
    connect(action, &QAction::toggled, this, [this, c](bool shown) {
      if (c == VariablesModel::Spark) m_hidSpark = false;
      setSectionHidden(c, !shown);
    });
  }
}

}  // namespace pitchboard::ui
