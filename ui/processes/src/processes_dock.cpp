// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/processes/processes_dock.h>

#include <QLabel>
#include <QMenu>
#include <QStackedWidget>
#include <QTimer>

#include <ui/base/table_style.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/source_switch.h>

#include "processes_model.h"

namespace pitchboard::ui {
namespace {

QString emptyText(const MatchController& controller) {
  if (controller.isOpening()) return QStringLiteral("Opening…");
  if (!controller.isOpen()) {
    return QStringLiteral("No match is open. Choose a scenario in the tool bar.");
  }
  switch (controller.cognition()) {
    case link::Cognition::Inline:
      if (controller.options().cognition != link::Cognition::Inline) {
        return QStringLiteral(
            "The robots decide inside the studio, because separate processes could "
            "not be started: the Log says why.");
      }
      return QStringLiteral(
          "The robots decide inside the studio, so there are no separate processes to "
          "show. Start the studio with --cognition external to have them.");
    case link::Cognition::None:
      return QStringLiteral(
          "Nothing was started. Attach your own processes to the robots' "
          "blackboards: key 100 × robot number (plus the key base).");
    case link::Cognition::External:
      return QStringLiteral("There are no robots, so no processes run.");
  }
  return {};
}

class ProcessesDock : public QStackedWidget {
 public:
  ProcessesDock(MatchController* controller, SourceSwitch* source, QWidget* parent)
      : QStackedWidget(parent),
        m_controller(controller),
        m_source(source),
        m_model(new ProcessesModel(this)),
        m_table(new QTableView(this)),
        m_empty(makeEmptyLabel(this, QStringLiteral("noProcesses"))) {
    constexpr int refreshMilliseconds = 250;
    m_table->setObjectName(QStringLiteral("processesTable"));
    m_table->setModel(m_model);
    styleTable(m_table);
    const int widths[] = {68, 140, 84, 220};
    for (int column = 0; column < 4; ++column) {
      m_table->setColumnWidth(column, scaled(m_table, widths[column]));
    }
    addWidget(m_table);
    addWidget(m_empty);
    auto* timer = new QTimer(this);
    connect(timer, &QTimer::timeout, this, [this] {
      if (isVisible()) refresh();
    });
    timer->start(refreshMilliseconds);
    connect(m_source, &SourceSwitch::changed, this, [this] { refresh(); });
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
    const bool simulated = m_source->kind() == SourceKind::Simulate;
    if (const FramePtr frame = m_source->frame())
      m_model->update(*frame);
    else
      m_model->clear();
    m_empty->setText(
        simulated
            ? emptyText(*m_controller)
            : QStringLiteral("These robots' processes run on the robots. The letters on the cards "
                             "tell which of them work."));
    setCurrentWidget(m_model->rowCount() > 0 ? static_cast<QWidget*>(m_table) : m_empty);
  }

  void showMenu(const QPoint& at) {
    const QModelIndex index = m_table->indexAt(at);
    if (m_source->kind() != SourceKind::Simulate || !index.isValid()) return;
    const RobotId id = m_model->robotAt(index.row());
    const QString name = index.siblingAtColumn(ProcessesModel::Robot).data().toString();
    QMenu menu(this);
    menu.addAction(themedIcon(QStringLiteral("view-refresh")),
                   QStringLiteral("Restart all processes of %1").arg(name), m_controller,
                   [this, id] { m_controller->edits()->restartProcesses(id); });
    menu.addAction(themedIcon(QStringLiteral("media-playback-stop")),
                   QStringLiteral("Stop all processes of %1").arg(name), m_controller,
                   [this, id] { m_controller->edits()->stopProcesses(id); });
    menu.exec(m_table->viewport()->mapToGlobal(at));
  }

  MatchController* m_controller;
  SourceSwitch* m_source;
  ProcessesModel* m_model;
  QTableView* m_table;
  QLabel* m_empty;
};

}  // namespace

QWidget* makeProcessesDock(MatchController* controller, SourceSwitch* source, QWidget* parent) {
  return new ProcessesDock(controller, source, parent);
}

}  // namespace pitchboard::ui
