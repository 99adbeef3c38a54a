// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The Referee panel of a paused match whose referee is a person.

#include <QPushButton>
#include <QTableView>
#include <QTest>
#include <QToolButton>
#include <QUndoStack>

#include <robotlink/scenario/scenario.h>
#include <ui/base/referee_text.h>
#include <ui/referee/referee_panel.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/shown_moment.h>

#include "referee_model.h"

namespace referee_rig {

using namespace pitchboard;
using namespace pitchboard::ui;

struct RefereeRig {
  RefereeRig() : controller(link::MatchOptions{}) {
    QObject::connect(&controller, &MatchController::errorOccurred, &controller,
                     [this](const QString& sentence) { errors << sentence; });
    link::Scenario scenario = link::loadScenario("match").value();
    scenario.settings.referee->automatic = false;
    for (auto& robot : scenario.robots) robot.behaviour = "none";
    dock.reset(makeRefereePanel({&controller, &moment}, nullptr));
    dock->resize(416, 900);
    dock->show();
    controller.open(scenario, true);
  }
  const link::MatchFrame& frame() const { return *controller.frame(); }
  QString state() const {
    const FramePtr frame = controller.frame();
    return frame && frame->game ? labelText(frame->game->state) : QString();
  }
  QPushButton* button(const char* name) const {
    return dock->findChild<QPushButton*>(QString("referee ") + QString::fromUtf8(name));
  }
  /// Once the button is there and may be pressed.
  void press(const char* name) {
    QTRY_VERIFY2(button(name) && button(name)->isEnabled(), name);
    QTest::mouseClick(button(name), Qt::LeftButton);
  }
  void reach(const char* wanted) {
    for (const char* next : {"READY", "SET", "PLAYING"}) {
      press(next);
      QTRY_COMPARE(state(), QString(next));
      if (QString(next) == QString(wanted)) return;
    }
  }
  QTableView* players(bool right = false) const {
    return dock->findChild<QTableView*>(right ? "refereeRightPlayers" : "refereeLeftPlayers");
  }
  void choose(int row, bool right = false) {
    QTRY_VERIFY(players(right)->model()->rowCount() > row);
    players(right)->selectRow(row);
  }
  QString shown(int row, int column = RefereeModel::State, bool right = false) const {
    return players(right)->model()->index(row, column).data().toString();
  }
  void openFold() const {
    auto* fold = dock->findChild<QToolButton*>("refereeFold");
    if (!fold->isChecked()) fold->click();
  }
  QUndoStack* undo() { return controller.edits()->undoStack(); }

  MatchController controller;
  ShownMoment moment{&controller};
  std::unique_ptr<QWidget> dock;
  QStringList errors;
};

}  // namespace referee_rig
