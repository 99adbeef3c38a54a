// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/beat.h>
#include <ui/processes/processes_dock.h>

#include <QLabel>
#include <QMenu>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <chrono>

#include <ui/base/table_style.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/shown_moment.h>

#include "processes_model.h"

namespace pitchboard::ui {
namespace {

QString emptyText(const MatchController& controller) {
  if (!controller.isOpen()) return controller.emptyText();
  switch (controller.cognition()) {
    case link::Cognition::Inline:
      if (controller.options().cognition != link::Cognition::Inline) {
        return QStringLiteral(
            "Processes run inside the studio because separate processes could not be started. See "
            "the Log for the reason.");
      }
      return QStringLiteral(
          "Processes run inside the studio, so there are no separate processes to show. To start "
          "them, choose Simulation > Run robot processes > In separate processes.");
    case link::Cognition::None:
      return QStringLiteral(
          "No processes were started. Attach your team's programs to the robots' blackboards: key "
          "100 × robot number (plus the key base).");
    case link::Cognition::Separate:
      return QStringLiteral("There are no robots, so no processes run.");
  }
  return {};
}

class ProcessesDock : public QStackedWidget {
 public:
  ProcessesDock(MatchController* controller, ShownMoment* shown, QWidget* parent)
      : QStackedWidget(parent),
        m_controller(controller),
        m_shown(shown),
        m_model(new ProcessesModel(this)),
        m_page(new QWidget(this)),
        m_asNow(new QLabel(
            QStringLiteral("Processes are not recorded. You are viewing the past; this list shows "
                           "them as they are now."),
            m_page)),
        m_table(new QTableView(m_page)),
        m_empty(makeEmptyLabel(this, QStringLiteral("noProcesses"))) {
    constexpr Beat::Milliseconds least{250}, most{1000};
    m_table->setObjectName(QStringLiteral("processesTable"));
    m_table->setModel(m_model);
    m_table->setSelectionMode(QAbstractItemView::ExtendedSelection);
    styleTable(m_table);
    const int widths[ProcessesModel::columns] = {56, 110, 120, 200, 64, 84, 64, 60, 76, 80, 220};
    for (int column = 0; column < ProcessesModel::columns; ++column) {
      m_table->setColumnWidth(column, scaled(m_table, widths[column]));
    }
    m_asNow->setObjectName(QStringLiteral("processesAsNow"));
    m_asNow->setFont(themeFont(TypeRole::Secondary));
    m_asNow->setForegroundRole(QPalette::PlaceholderText);
    m_asNow->setMargin(scaled(this, 4));
    auto* column = new QVBoxLayout(m_page);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(m_asNow);
    column->addWidget(m_table, 1);
    addWidget(m_page);
    addWidget(m_empty);
    m_refresh = Beat::display().add(
        this, least, [this] { refresh(); }, most);
    connect(m_shown, &ShownMoment::frameReceived, this, [this] { m_refresh->want(); });
    connect(m_shown, &ShownMoment::sourceChosen, this, [this] { refresh(); });
    connect(m_controller->edits(), &MatchEdits::lockedChanged, this, [this] { refresh(); });
    for (const auto changed : {&MatchController::scenarioChanged, &MatchController::opened}) {
      connect(m_controller, changed, this, [this] { refresh(); });
    }
    m_table->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(m_table, &QWidget::customContextMenuRequested, this,
            [this](const QPoint& at) { showMenu(at); });
    refresh();
  }

 private:
  void refresh() {
    const bool simulated = m_shown->source() == m_controller;
    // Processes are not recorded, so the list shows them as they are now and does nothing.
    if (const FramePtr frame = simulated ? m_controller->frame() : m_shown->frame())
      m_model->update(*frame, std::chrono::steady_clock::now());
    else
      m_model->clear();
    m_empty->setText(
        simulated ? emptyText(*m_controller)
        : m_shown->kind().hasPresent
            ? QStringLiteral("These robots' processes run on the robots. The letters on the cards "
                             "show which of them work.")
            : QStringLiteral("Processes are not recorded. The cards name the teams' programs, and "
                             "the letters on them show which processes worked."));
    const bool isLocked = m_controller->edits()->isLocked();
    m_asNow->setVisible(isLocked);
    m_table->setEnabled(!isLocked);
    if (isLocked) m_table->clearSelection();
    setCurrentWidget(m_model->rowCount() > 0 ? m_page : m_empty);
  }

  /// What the clicked row and the selected ones stand for.
  std::vector<link::ProcessStatus> chosen(const QModelIndex& clicked) const {
    std::vector<link::ProcessStatus> all;
    const QModelIndexList rows = m_table->selectionModel()->selectedRows();
    const bool among = std::any_of(rows.begin(), rows.end(), [&clicked](const QModelIndex& row) {
      return row.row() == clicked.row();
    });
    if (!among) return {m_model->statusAt(clicked.row())};
    for (const QModelIndex& row : rows) all.push_back(m_model->statusAt(row.row()));
    return all;
  }

  void showMenu(const QPoint& at) {
    const QModelIndex index = m_table->indexAt(at);
    if (!m_shown->kind().canBeEdited || !index.isValid()) return;
    const auto processes = chosen(index);
    const QString robot = index.siblingAtColumn(ProcessesModel::Robot).data().toString();
    const QString name =
        processes.size() == 1
            ? QStringLiteral("%1 of %2").arg(QString::fromStdString(processes.front().name), robot)
            : QStringLiteral("%1 processes").arg(processes.size());
    const bool anyRuns = std::any_of(processes.begin(), processes.end(),
                                     [](const auto& one) { return one.pid != 0; });
    const bool allRun = std::all_of(processes.begin(), processes.end(),
                                    [](const auto& one) { return one.pid != 0; });
    QMenu menu(this);
    const auto offer = [&](const char* icon, const QString& text, bool enabled,
                           void (MatchEdits::*order)(int)) {
      QAction* action =
          menu.addAction(themedIcon(QString::fromUtf8(icon)), text.arg(name), m_controller,
                         [edits = m_controller->edits(), order, processes] {
                           for (const link::ProcessStatus& one : processes) (edits->*order)(one.id);
                         });
      action->setEnabled(enabled);
    };
    offer("media-playback-start", QStringLiteral("Start %1"), !allRun, &MatchEdits::startProcess);
    offer("media-playback-stop", QStringLiteral("Stop %1"), true, &MatchEdits::stopProcess);
    offer("view-refresh", QStringLiteral("Restart %1"), true, &MatchEdits::restartProcess);
    offer("process-stop", QStringLiteral("Kill %1"), anyRuns, &MatchEdits::killProcess);
    menu.addSeparator();
    menu.addAction(QStringLiteral("Select all processes of %1").arg(robot), this, [this, index] {
      const auto robotAt = [this](int row) {
        return m_model->index(row, ProcessesModel::Robot).data().toString();
      };
      const QString chosen = robotAt(index.row());
      m_table->clearSelection();
      for (int row = 0; row < m_model->rowCount(); ++row) {
        if (robotAt(row) != chosen) continue;
        m_table->selectionModel()->select(m_model->index(row, 0),
                                          QItemSelectionModel::Select | QItemSelectionModel::Rows);
      }
    });
    menu.exec(m_table->viewport()->mapToGlobal(at));
  }

  MatchController* m_controller;
  ShownMoment* m_shown;
  ProcessesModel* m_model;
  QWidget* m_page;
  QLabel* m_asNow;
  QTableView* m_table;
  QLabel* m_empty;
  std::unique_ptr<Beat::Part> m_refresh;
};

}  // namespace

QWidget* makeProcessesDock(MatchController* controller, ShownMoment* shown, QWidget* parent) {
  return new ProcessesDock(controller, shown, parent);
}

}  // namespace pitchboard::ui
