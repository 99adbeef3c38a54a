// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment_form.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QRegularExpressionValidator>
#include <QTimer>
#include <algorithm>
#include <utility>

#include <ui/base/robot_text.h>
#include <ui/base/table_style.h>

namespace pitchboard::ui {
namespace {

constexpr int maxRuns = 1'000'000;

/// "after 60 s, or at a goal".
QString endText(const link::RunStop& stop) {
  QStringList ends{QStringLiteral("after %1").arg(durationText(stop.duration))};
  if (stop.goal) ends << QStringLiteral("at a goal");
  if (stop.goalAgainst) ends << QStringLiteral("at a goal of the opponents");
  if (stop.ballOut) ends << QStringLiteral("when the ball is out");
  if (stop.fell) ends << QStringLiteral("when a robot of the team falls");
  if (stop.stuck)
    ends << QStringLiteral("when nothing moved for %1").arg(durationText(*stop.stuck));
  return ends.join(QStringLiteral(", or "));
}

QString assertionsText(const link::Experiment& experiment) {
  QStringList all;
  for (const link::Assertion& one : experiment.assertions) {
    all << QString::fromStdString(one.text) +
               (one.condition.empty()
                    ? QString()
                    : QStringLiteral(" in “%1”").arg(QString::fromStdString(one.condition)));
  }
  return all.isEmpty() ? QStringLiteral("none") : all.join(QLatin1Char('\n'));
}

}  // namespace

ExperimentForm::ExperimentForm(QWidget* parent)
    : QScrollArea(parent),
      m_title(new QLabel(this)),
      m_description(new QLabel(this)),
      m_all(new QLabel(this)),
      m_end(new QLabel(this)),
      m_assertions(new QLabel(this)),
      m_seed(new QLineEdit(this)),
      m_runs(new QSpinBox(this)),
      m_conditions(new QTableWidget(0, 2, this)),
      m_add(new QPushButton(QStringLiteral("Add condition"), this)),
      m_remove(new QPushButton(QStringLiteral("Remove"), this)) {
  setObjectName(QStringLiteral("experimentForm"));
  setFrameShape(QFrame::NoFrame);
  setWidgetResizable(true);
  auto* page = new QWidget(this);
  auto* form = new QFormLayout(page);
  const int gap = scaled(this, 6);
  form->setContentsMargins(2 * gap, gap, 2 * gap, gap);
  form->setVerticalSpacing(gap);
  form->setLabelAlignment(Qt::AlignLeft | Qt::AlignTop);
  m_title->setFont(themeFont(TypeRole::Body, true));
  for (QLabel* label : {m_title, m_description, m_end, m_assertions}) label->setWordWrap(true);
  form->addRow(m_title);
  form->addRow(m_description);
  m_runs->setObjectName(QStringLiteral("experimentRuns"));
  m_runs->setRange(1, maxRuns);
  m_runs->setButtonSymbols(QAbstractSpinBox::NoButtons);
  m_runs->setFixedWidth(scaled(this, 72));
  m_runs->setToolTip(QStringLiteral("How often each condition is played"));
  m_all->setObjectName(QStringLiteral("experimentAllRuns"));
  connect(m_runs, &QSpinBox::valueChanged, this, [this] {
    showAll();
    notifyEdited();
  });
  m_seed->setObjectName(QStringLiteral("experimentSeed"));
  m_seed->setFixedWidth(scaled(this, 140));
  m_seed->setValidator(
      new QRegularExpressionValidator(QRegularExpression(QStringLiteral("\\d{1,19}")), m_seed));
  m_seed->setToolTip(QStringLiteral("Run i has the same seed in every condition"));
  connect(m_seed, &QLineEdit::editingFinished, this, [this] {
    if (m_seed->isModified()) notifyEdited();
    m_seed->setModified(false);
  });
  auto* row = new QHBoxLayout;
  row->setSpacing(gap);
  row->addWidget(m_runs);
  row->addWidget(m_all, 1);
  form->addRow(QStringLiteral("Runs"), row);
  form->addRow(QStringLiteral("Seed"), m_seed);
  form->addRow(QStringLiteral("A run ends"), m_end);
  m_conditions->setObjectName(QStringLiteral("experimentConditions"));
  m_conditions->setHorizontalHeaderLabels(
      {QStringLiteral("Condition"), QStringLiteral("Changed values")});
  styleTable(m_conditions);
  m_conditions->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  connect(m_conditions, &QTableWidget::itemChanged, this, [this] {
    // Later: receivers may recreate the items.
    if (!m_isShowing) QTimer::singleShot(0, this, &ExperimentForm::edited);
  });
  connect(m_conditions, &QTableWidget::itemSelectionChanged, this,
          [this] { setEditable(m_isEditable); });
  m_add->setObjectName(QStringLiteral("addCondition"));
  m_remove->setObjectName(QStringLiteral("removeCondition"));
  connect(m_add, &QPushButton::clicked, this, [this] {
    const int last = m_conditions->rowCount();
    addCondition({{}, QStringLiteral("condition %1").arg(last + 1).toStdString(), {}});
    fitConditions();
    notifyEdited();
    m_conditions->setFocus();
    m_conditions->editItem(m_conditions->item(last, 1));
  });
  connect(m_remove, &QPushButton::clicked, this, [this] {
    if (m_conditions->currentRow() < 0) return;
    m_conditions->removeRow(m_conditions->currentRow());
    fitConditions();
    notifyEdited();
  });
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(gap);
  buttons->addWidget(m_add);
  buttons->addWidget(m_remove);
  buttons->addStretch(1);
  auto* conditions = new QVBoxLayout;
  conditions->setSpacing(gap);
  conditions->addWidget(m_conditions);
  conditions->addLayout(buttons);
  form->addRow(QStringLiteral("Conditions"), conditions);
  form->addRow(QStringLiteral("Assertions"), m_assertions);
  setWidget(page);
}

void ExperimentForm::show(const link::Experiment& experiment, const link::ExperimentEdits& edits) {
  m_isShowing = true;
  m_title->setText(
      QString::fromStdString(experiment.title.empty() ? experiment.name : experiment.title));
  m_description->setText(QString::fromStdString(experiment.description));
  m_description->setVisible(!experiment.description.empty());
  m_end->setText(endText(experiment.stop));
  m_assertions->setText(assertionsText(experiment));
  m_listed = static_cast<int>(experiment.conditions.size());
  m_isGrid = edits.isGrid;
  // A cell that is being edited goes on being edited.
  const auto same = [](const link::ConditionEdit& a, const link::ConditionEdit& b) {
    return a.name == b.name && a.settings == b.settings;
  };
  if (!edits.isGrid && std::ranges::equal(edits.conditions, this->edits().conditions, same)) {
    for (int row = 0; row < m_conditions->rowCount(); ++row)
      m_conditions->item(row, 0)->setData(Qt::UserRole, row);
  } else {
    m_conditions->setRowCount(0);
    if (!edits.isGrid) {
      for (const link::ConditionEdit& one : edits.conditions) addCondition(one);
    }
  }
  // What a grid makes is listed, and edited in the file.
  if (edits.isGrid) {
    for (const link::Condition& one : experiment.conditions) {
      std::string settings;
      for (const link::ScenarioSetting& set : one.settings)
        settings += (settings.empty() ? "" : ", ") + set.key + " = " + set.value;
      addCondition({{}, one.name, settings});
    }
  }
  m_conditions->resizeColumnToContents(0);
  fitConditions();
  m_runs->setValue(static_cast<int>(edits.runs));
  m_seed->setText(QString::number(edits.seed));
  setEditable(m_isEditable);
  showAll();
  m_isShowing = false;
}

void ExperimentForm::addCondition(const link::ConditionEdit& condition) {
  const bool wasShowing = std::exchange(m_isShowing, true);
  const int row = m_conditions->rowCount();
  m_conditions->insertRow(row);
  auto* name = new QTableWidgetItem(QString::fromStdString(condition.name));
  if (condition.from) name->setData(Qt::UserRole, static_cast<int>(*condition.from));
  m_conditions->setItem(row, 0, name);
  auto* settings = new QTableWidgetItem(QString::fromStdString(condition.settings));
  settings->setToolTip(
      QStringLiteral("key = value, key = value: as in the scenario's file, for example "
                     "noise = paper. Empty: as in the scenario."));
  m_conditions->setItem(row, 1, settings);
  m_isShowing = wasShowing;
}

// The page scrolls, not the table.
void ExperimentForm::fitConditions() {
  m_conditions->setFixedHeight(
      m_conditions->horizontalHeader()->sizeHint().height() +
      m_conditions->rowCount() * m_conditions->verticalHeader()->defaultSectionSize() + 2);
}

void ExperimentForm::notifyEdited() {
  if (!m_isShowing) emit edited();
}

void ExperimentForm::setEditable(bool on) {
  m_isEditable = on;
  m_runs->setEnabled(on);
  m_seed->setEnabled(on);
  m_conditions->setEditTriggers(on && !m_isGrid ? QAbstractItemView::DoubleClicked |
                                                      QAbstractItemView::EditKeyPressed |
                                                      QAbstractItemView::AnyKeyPressed
                                                : QAbstractItemView::NoEditTriggers);
  m_add->setEnabled(on && !m_isGrid);
  m_remove->setEnabled(on && !m_isGrid && !m_conditions->selectedItems().isEmpty());
  m_add->setToolTip(m_isGrid ? QStringLiteral("\"grid\" in the file makes these conditions")
                             : QStringLiteral("The scenario with other values"));
}

link::ExperimentEdits ExperimentForm::edits() const {
  link::ExperimentEdits all;
  all.seed = m_seed->text().toULongLong();
  all.runs = static_cast<std::size_t>(m_runs->value());
  all.isGrid = m_isGrid;
  for (int row = 0; !m_isGrid && row < m_conditions->rowCount(); ++row) {
    link::ConditionEdit& one = all.conditions.emplace_back();
    const QVariant from = m_conditions->item(row, 0)->data(Qt::UserRole);
    if (from.isValid()) one.from = static_cast<std::size_t>(from.toInt());
    one.name = m_conditions->item(row, 0)->text().trimmed().toStdString();
    one.settings = m_conditions->item(row, 1)->text().trimmed().toStdString();
  }
  return all;
}

void ExperimentForm::showError(const QString& sentence) {
  m_title->setText(QStringLiteral("The file cannot be read"));
  m_description->setText(sentence);
  m_description->show();
  m_isShowing = true;
  m_conditions->setRowCount(0);
  m_isShowing = false;
}

void ExperimentForm::showAll() {
  const int conditions = std::max(1, m_listed);
  m_all->setText(
      conditions == 1
          ? (m_runs->value() == 1 ? QStringLiteral("run") : QStringLiteral("runs"))
          : QStringLiteral("per condition, %1 in all").arg(qint64{m_runs->value()} * conditions));
}

}  // namespace pitchboard::ui
