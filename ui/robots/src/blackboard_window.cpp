// SPDX-License-Identifier: GPL-3.0-or-later
#include "blackboard_window.h"

#include <QLabel>
#include <QTableWidget>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>

#include <ui/base/robot_words.h>
#include <ui/base/table_style.h>
#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

namespace pitchboard::ui {

BlackboardWindow::BlackboardWindow(MatchController* controller, RobotId id, QWidget* parent)
    : QDialog(parent),
      m_controller(controller),
      m_id(id),
      m_where(new QLabel(this)),
      m_table(new QTableWidget(0, 3, this)) {
  constexpr int refreshMilliseconds = 200;
  setAttribute(Qt::WA_DeleteOnClose);
  const link::ScenarioRobot* robot = controller->edits()->robot(id);
  setWindowTitle(
      QStringLiteral("Blackboard of %1").arg(robot ? robotName(robot->identity) : QString()));
  m_where->setWordWrap(true);
  m_where->setTextInteractionFlags(Qt::TextSelectableByMouse);
  m_table->setHorizontalHeaderLabels(
      {QStringLiteral("Name"), QStringLiteral("Value"), QStringLiteral("Unit, meaning")});
  styleTable(m_table);
  m_table->setFrameShape(QFrame::StyledPanel);
  m_table->setColumnWidth(0, scaled(this, 200));
  m_table->setColumnWidth(1, scaled(this, 80));
  m_table->horizontalHeaderItem(1)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  auto* column = new QVBoxLayout(this);
  column->addWidget(m_where);
  column->addWidget(m_table, 1);
  resize(scaled(this, 460), scaled(this, 300));
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, &BlackboardWindow::refresh);
  timer->start(refreshMilliseconds);
  refresh();
}

void BlackboardWindow::setRow(int row, const QString& name, const QString& value,
                              const QString& unit) {
  if (row >= m_table->rowCount()) {
    m_table->insertRow(row);
    m_table->setItem(row, 0, new QTableWidgetItem(name));
    m_table->setItem(row, 1, new QTableWidgetItem);
    m_table->setItem(row, 2, new QTableWidgetItem(unit));
    m_table->item(row, 1)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  }
  m_table->item(row, 1)->setText(value);
}

void BlackboardWindow::refresh() {
  const FramePtr frame = m_controller->frame();
  if (!frame) return;
  const link::RobotFrame* robot = frame->robot(m_id);
  if (robot == nullptr || !robot->board) {
    close();
    return;
  }
  const link::RobotBoardView* board = &*robot->board;
  m_where->setText(
      board->key == 0
          ? QStringLiteral(
                "In the studio's own memory: other programs cannot reach it. Start the studio with "
                "--cognition external or none to share it.")
          : QStringLiteral(
                "System V shared memory, key %1, 2048 bytes. Every variable, in a terminal:\n"
                "pitchboard-cli blackboard watch --key %1")
                .arg(board->key));
  const auto whole = [](int value) { return numberText(value, 0); };
  int row = 0;
  setRow(row++, QStringLiteral("DECISION_ACTION_A"), whole(board->actionA),
         actionText(board->actionA));
  setRow(row++, QStringLiteral("VISION_LOST"), whole(board->visionLost), QString());
  setRow(row++, QStringLiteral("VISION_BALL_DIST"), numberText(double(board->ballDistCm), 1),
         QStringLiteral("cm"));
  setRow(row++, QStringLiteral("VISION_PAN_DEG"), numberText(double(board->panDeg), 1),
         QStringLiteral("°"));
  setRow(row++, QStringLiteral("LOCALIZATION_X"), whole(board->localizationX),
         QStringLiteral("cm"));
  setRow(row++, QStringLiteral("LOCALIZATION_Y"), whole(board->localizationY),
         QStringLiteral("cm"));
  setRow(row++, QStringLiteral("LOCALIZATION_THETA"), whole(board->localizationTheta),
         QStringLiteral("°"));
  setRow(row++, QStringLiteral("LOCALIZATION_RBT01_X"), numberText(double(board->belief), 1),
         QStringLiteral("cm"));
  setRow(row++, QStringLiteral("VOLTAGE"), whole(board->voltage), QStringLiteral("0.1 V"));
}

}  // namespace pitchboard::ui
