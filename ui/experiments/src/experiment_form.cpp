// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiment_form.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <algorithm>

#include <ui/base/robot_words.h>
#include <ui/base/table_style.h>

namespace pitchboard::ui {
namespace {

constexpr int mostRuns = 1'000'000;

QString settingsText(const link::Condition& condition) {
  QStringList all;
  for (const link::ScenarioSetting& one : condition.settings) {
    all << QStringLiteral("%1 = %2").arg(QString::fromStdString(one.key),
                                         QString::fromStdString(one.value).simplified());
  }
  return all.isEmpty() ? QStringLiteral("as in the scenario") : all.join(QStringLiteral(", "));
}

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
      m_runs(new QSpinBox(this)),
      m_conditions(new QTableWidget(0, 2, this)) {
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
  m_runs->setRange(1, mostRuns);
  m_runs->setButtonSymbols(QAbstractSpinBox::NoButtons);
  m_runs->setFixedWidth(scaled(this, 72));
  m_runs->setToolTip(QStringLiteral("How often each condition is played"));
  m_all->setObjectName(QStringLiteral("experimentAllRuns"));
  connect(m_runs, &QSpinBox::valueChanged, this, &ExperimentForm::showAll);
  auto* row = new QHBoxLayout;
  row->setSpacing(gap);
  row->addWidget(m_runs);
  row->addWidget(m_all, 1);
  form->addRow(QStringLiteral("Runs"), row);
  form->addRow(QStringLiteral("A run ends"), m_end);
  m_conditions->setObjectName(QStringLiteral("experimentConditions"));
  m_conditions->setHorizontalHeaderLabels(
      {QStringLiteral("Condition"), QStringLiteral("Changed values")});
  styleTable(m_conditions);
  m_conditions->setSelectionMode(QAbstractItemView::NoSelection);
  m_conditions->setFocusPolicy(Qt::NoFocus);
  m_conditions->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  form->addRow(QStringLiteral("Conditions"), m_conditions);
  form->addRow(QStringLiteral("Assertions"), m_assertions);
  setWidget(page);
}

void ExperimentForm::show(const link::Experiment& experiment) {
  m_title->setText(
      QString::fromStdString(experiment.title.empty() ? experiment.name : experiment.title));
  m_description->setText(QString::fromStdString(experiment.description));
  m_description->setVisible(!experiment.description.empty());
  m_end->setText(endText(experiment.stop));
  m_assertions->setText(assertionsText(experiment));
  m_conditions->setRowCount(static_cast<int>(experiment.conditions.size()));
  for (int i = 0; i < m_conditions->rowCount(); ++i) {
    const link::Condition& one = experiment.conditions[static_cast<std::size_t>(i)];
    m_conditions->setItem(i, 0, new QTableWidgetItem(QString::fromStdString(one.name)));
    m_conditions->setItem(i, 1, new QTableWidgetItem(settingsText(one)));
    m_conditions->item(i, 1)->setToolTip(settingsText(one));
  }
  m_conditions->resizeColumnToContents(0);
  // The page scrolls, not the table.
  m_conditions->setFixedHeight(
      m_conditions->horizontalHeader()->sizeHint().height() +
      m_conditions->rowCount() * m_conditions->verticalHeader()->defaultSectionSize() + 2);
  m_runs->setValue(static_cast<int>(experiment.runs));
  showAll();
}

void ExperimentForm::showError(const QString& sentence) {
  m_title->setText(QStringLiteral("The file cannot be read"));
  m_description->setText(sentence);
  m_description->show();
  m_conditions->setRowCount(0);
}

void ExperimentForm::showAll() {
  const int conditions = std::max(1, m_conditions->rowCount());
  m_all->setText(
      conditions == 1
          ? (m_runs->value() == 1 ? QStringLiteral("run") : QStringLiteral("runs"))
          : QStringLiteral("per condition, %1 in all").arg(qint64{m_runs->value()} * conditions));
}

}  // namespace pitchboard::ui
