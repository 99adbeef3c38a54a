// SPDX-License-Identifier: GPL-3.0-or-later
#include "statistics_table.h"

#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QMenu>
#include <QSettings>
#include <algorithm>

#include <ui/base/table_style.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr int widestText = 260;  // px of the design
const QString columnsKey = QStringLiteral("statistics/columns");

std::string keyOfRow(const StatisticsRow& row) {
  return std::to_string(row.number) + '\n' + row.line.session + '\n' + row.line.robot + '\n' +
         row.line.variable;
}

}  // namespace

StatisticsTable::StatisticsTable(QSettings* settings, QWidget* parent)
    : QTableView(parent),
      m_settings(settings),
      m_model(new StatisticsModel(this)),
      m_sort(new StatisticsSort(this)) {
  setObjectName(QStringLiteral("statisticsTable"));
  m_model->setObjectName(QStringLiteral("statisticsModel"));
  if (settings != nullptr) m_columns = settings->value(columnsKey).toStringList();
  m_sort->setSourceModel(m_model);
  setModel(m_sort);
  setSelectionMode(QAbstractItemView::ExtendedSelection);
  setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  styleTable(this);
  setIconSize(QSize(scaled(this, 8), scaled(this, 8)));
  setSortingEnabled(true);
  sortByColumn(-1, Qt::AscendingOrder);
  QHeaderView* header = horizontalHeader();
  header->setStretchLastSection(false);
  header->setSectionsMovable(true);
  header->setResizeContentsPrecision(100);
  header->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(header, &QWidget::customContextMenuRequested, this,
          [this, header](const QPoint& at) { askForColumns(header->mapToGlobal(at)); });
  connect(this, &QTableView::clicked, this, &StatisticsTable::goTo);
  connect(this, &QTableView::activated, this, &StatisticsTable::goTo);
  connect(selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          &StatisticsTable::currentShown);
}

const StatisticsRow& StatisticsTable::rowAt(int sortedRow) const {
  return m_model->at(m_sort->mapToSource(m_sort->index(sortedRow, 0)).row());
}

void StatisticsTable::show(const std::shared_ptr<const StretchResult>& result,
                           const QStringList& texts, const std::optional<QDateTime>& clock) {
  const StatisticsRow* before = current();
  const std::string key = before != nullptr ? keyOfRow(*before) : std::string();
  m_model->show(result, texts, clock);
  showColumns();
  selectRow(key);
  emit currentShown();
}

const StatisticsRow* StatisticsTable::current() const {
  const QModelIndex index = currentIndex();
  return index.isValid() ? &rowAt(index.row()) : nullptr;
}

std::vector<const StatisticsRow*> StatisticsTable::selected() const {
  std::vector<const StatisticsRow*> rows;
  for (int row = 0; row < m_sort->rowCount(); ++row) {
    if (selectionModel()->isRowSelected(row, {})) rows.push_back(&rowAt(row));
  }
  return rows;
}

void StatisticsTable::copySelection() const {
  std::vector<int> rows;
  for (int row = 0; row < m_sort->rowCount(); ++row) {
    if (!selectionModel()->isRowSelected(row, {})) continue;
    rows.push_back(m_sort->mapToSource(m_sort->index(row, 0)).row());
  }
  QApplication::clipboard()->setText(m_model->spreadsheetText(rows));
}

void StatisticsTable::selectRow(const std::string& key) {
  int found = m_sort->rowCount() > 0 ? 0 : -1;
  for (int row = 0; row < m_sort->rowCount(); ++row) {
    if (keyOfRow(rowAt(row)) == key) found = row;
  }
  if (found >= 0 && currentIndex().row() != found) {
    setCurrentIndex(m_sort->index(found, StatisticsModel::Variable));
  }
}

void StatisticsTable::goTo(const QModelIndex& index) {
  const QVariant time = index.data(StatisticsModel::timeRole);
  if (time.isValid()) emit momentClicked(time.toDouble());
}

bool StatisticsTable::isColumnShown(int column) const {
  if (!m_model->isUsed(column)) return false;
  const QString key = StatisticsModel::keyOf(column);
  if (m_columns.contains(QLatin1Char('+') + key)) return true;
  if (m_columns.contains(QLatin1Char('-') + key)) return false;
  return StatisticsModel::isShownAtFirst(column);
}

void StatisticsTable::showColumns() {
  const QHeaderView* header = horizontalHeader();
  for (int column = 0; column < StatisticsModel::columns; ++column) {
    const bool isShown = isColumnShown(column);
    setColumnHidden(column, !isShown);
    if (!isShown) continue;
    // Columns do not become narrower and wider again while numbers change.
    int width =
        std::max(header->sectionSizeHint(column), sizeHintForColumn(column)) + scaled(this, 8);
    if (column == StatisticsModel::Variable || column == StatisticsModel::States) {
      width = std::min(width, scaled(this, widestText));
    }
    if (width > columnWidth(column) || !m_sized.contains(column)) {
      setColumnWidth(column, width);
      m_sized.insert(column);
    }
  }
}

void StatisticsTable::askForColumns(const QPoint& at) {
  auto* menu = new QMenu(this);
  menu->setObjectName(QStringLiteral("statisticsColumns"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  for (int column = 0; column < StatisticsModel::columns; ++column) {
    if (column == StatisticsModel::Variable || !m_model->isUsed(column)) continue;
    QAction* entry =
        menu->addAction(m_model->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString());
    entry->setCheckable(true);
    entry->setChecked(isColumnShown(column));
    connect(entry, &QAction::triggered, this,
            [this, column](bool on) { chooseColumn(column, on); });
  }
  menu->popup(at);
}

void StatisticsTable::chooseColumn(int column, bool on) {
  const QString key = StatisticsModel::keyOf(column);
  m_columns.removeAll(QLatin1Char('+') + key);
  m_columns.removeAll(QLatin1Char('-') + key);
  if (on != StatisticsModel::isShownAtFirst(column)) {
    m_columns << (on ? QLatin1Char('+') : QLatin1Char('-')) + key;
  }
  if (m_settings != nullptr) m_settings->setValue(columnsKey, m_columns);
  showColumns();
}

}  // namespace pitchboard::ui
