// SPDX-License-Identifier: GPL-3.0-or-later
#include "results_tabs.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSortFilterProxyModel>
#include <QTableView>
#include <QVBoxLayout>

#include <ui/base/table_style.h>

#include "distribution_view.h"
#include "trajectories_view.h"

namespace pitchboard::ui {

ResultsTabs::ResultsTabs(bool compares, QWidget* parent)
    : QTabWidget(parent),
      m_compares(compares),
      m_seeRuns(new QPushButton(this)),
      m_condition(new QComboBox(this)),
      m_trajectories(new TrajectoriesView(this)),
      m_distribution(new DistributionView(this)) {
  setObjectName(QStringLiteral("experimentTabs"));
  setDocumentMode(true);
}

QTableView* ResultsTabs::addTable(ResultsModel::Kind kind, const QString& title,
                                  const QString& name) {
  auto* model = new ResultsModel(kind, this);
  auto* sorted = new QSortFilterProxyModel(this);
  sorted->setSourceModel(model);
  sorted->setSortRole(Qt::UserRole);
  auto* table = new QTableView(this);
  table->setObjectName(name);
  table->setModel(sorted);
  styleTable(table);
  table->setSortingEnabled(kind == ResultsModel::Kind::Runs);
  m_models.push_back(model);
  m_tables.push_back(table);
  addTab(table, title);
  cover(table->viewport(), name + QStringLiteral("Empty"));
  return table;
}

void ResultsTabs::addTabs() {
  using Kind = ResultsModel::Kind;
  addTable(Kind::Measured, QStringLiteral("Measured"), QStringLiteral("experimentMeasured"));
  addTable(Kind::Differences, QStringLiteral("Differences"),
           QStringLiteral("experimentDifferences"));
  addTable(Kind::Assertions, QStringLiteral("Assertions"), QStringLiteral("experimentAssertions"));
  m_runsTable = addTable(Kind::Runs, QStringLiteral("Runs"), QStringLiteral("experimentTable"));
  m_runsTable->sortByColumn(0, Qt::AscendingOrder);
  connect(m_runsTable, &QTableView::doubleClicked, this,
          [this](const QModelIndex& index) { emit asked({numberOf(index)}); });
  connect(m_runsTable->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
    highlight();
    showChoices();
  });
  addTab(m_trajectories, QStringLiteral("Trajectories"));
  addTab(m_distribution, QStringLiteral("Distribution"));
  cover(m_trajectories, QStringLiteral("experimentTrajectoriesEmpty"));
  cover(m_distribution->area(), QStringLiteral("experimentDistributionEmpty"));
  makeCorner();
  connect(this, &QTabWidget::currentChanged, this, [this] { showChoices(); });
  showChoices();
  showPlaying(false);
}

void ResultsTabs::cover(QWidget* area, const QString& name) {
  auto* label = makeEmptyLabel(area, name);
  auto* layout = new QVBoxLayout(area);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(label);
  m_empty.push_back(label);
}

void ResultsTabs::showPlaying(bool playing) {
  if (m_shown) return;
  for (QLabel* label : m_empty) {
    label->setText(playing ? QStringLiteral("Playing the runs. Results appear here when all are "
                                            "done or when you press Cancel.")
                           : QStringLiteral("No results yet. Press Start to play the experiment."));
  }
}

/// Beside the tabs, because height is what field and chart lack.
void ResultsTabs::makeCorner() {
  m_condition->setObjectName(QStringLiteral("experimentCondition"));
  m_condition->setAccessibleName(QStringLiteral("Condition"));
  m_condition->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  connect(m_condition, &QComboBox::currentIndexChanged, this, [this](int index) {
    if (index < 0 || !m_shown) return;
    m_trajectories->show(m_shown, static_cast<std::size_t>(index));
    highlight();
  });
  m_seeRuns->setObjectName(QStringLiteral("experimentSeeRuns"));
  connect(m_seeRuns, &QPushButton::clicked, this, [this] { emit asked(chosenRuns()); });
  auto* choices = new QWidget(this);
  auto* row = new QHBoxLayout(choices);
  row->setContentsMargins(0, scaled(this, 2), scaled(this, 4), scaled(this, 2));
  row->addWidget(m_seeRuns);
  row->addWidget(m_condition);
  row->addWidget(m_distribution->chooser());
  setCornerWidget(choices);
}

std::size_t ResultsTabs::numberOf(const QModelIndex& index) const {
  const auto* proxy = static_cast<const QSortFilterProxyModel*>(m_runsTable->model());
  return m_models.back()->runNumber(proxy->mapToSource(index).row());
}

std::vector<std::size_t> ResultsTabs::chosenRuns() const {
  std::vector<std::size_t> numbers;
  for (const QModelIndex& index : m_runsTable->selectionModel()->selectedRows()) {
    numbers.push_back(numberOf(index));
  }
  return numbers;
}

void ResultsTabs::showChoices() {
  const bool runs = currentWidget() == m_runsTable && m_shown;
  const qsizetype chosen = runs ? m_runsTable->selectionModel()->selectedRows().size() : 0;
  const bool two = chosen == 2 && m_compares;
  m_seeRuns->setVisible(runs);
  m_seeRuns->setEnabled(chosen == 1 || two);
  m_seeRuns->setText(two ? QStringLiteral("Compare on the field")
                         : QStringLiteral("See in Replay"));
  m_seeRuns->setToolTip(m_compares
                            ? QStringLiteral("Choose one run, or two (Ctrl+click) to compare")
                            : QStringLiteral("Choose a run"));
  m_condition->setVisible(currentWidget() == m_trajectories && m_shown);
  m_distribution->chooser()->setVisible(currentWidget() == m_distribution && m_shown);
}

void ResultsTabs::highlight() {
  m_trajectories->highlight(chosenRuns());
}

void ResultsTabs::showResults(const PlayedPtr& played) {
  m_shown = played;
  for (ResultsModel* model : m_models) model->show(played);
  for (QTableView* table : m_tables) table->resizeColumnsToContents();
  m_condition->clear();
  for (const link::ConditionSummary& condition : played->summary.conditions) {
    m_condition->addItem(QString::fromStdString(condition.name));
  }
  m_distribution->show(played);
  for (QLabel* label : m_empty) label->setVisible(false);
  const auto showEmpty = [this](ResultsModel::Kind kind, const QString& words) {
    const auto table = static_cast<std::size_t>(kind);
    m_empty[table]->setText(words);
    m_empty[table]->setVisible(m_models[table]->rowCount() == 0);
  };
  showEmpty(ResultsModel::Kind::Differences,
            QStringLiteral("Nothing to compare: there is only one condition. Add \"conditions\", "
                           "\"grid\" or \"compare\" to the file."));
  showEmpty(ResultsModel::Kind::Assertions,
            QStringLiteral("No assertions. Add \"assertions\" to the file to make it a test, such "
                           "as \"goal_rate >= 0.5\"."));
  showEmpty(ResultsModel::Kind::Runs, QStringLiteral("No run has finished."));
  showChoices();
}

}  // namespace pitchboard::ui
