// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Brings values that a person typed to the blackboards of a simulated match, and says when one did
// not stay there. UI thread only.

#include <QObject>
#include <vector>

#include <base/ids.h>

#include "value_watch.h"

class QModelIndex;

namespace pitchboard::ui {

class InPlaceMessage;
class MatchController;
class VariablesModel;

class ValueWriter : public QObject {
  Q_OBJECT
 public:
  ValueWriter(MatchController* controller, VariablesModel* model, InPlaceMessage* message,
              QObject* parent);

  /// To be called now and then, as long as rows come.
  void check();
  /// Forgets what was written: the source is another one.
  void forget();

 private:
  void write(const QModelIndex& index, double value);
  void written(RobotId robot, const QString& name, double time);

  struct Pending {
    RobotId robot;
    UserWrite value;
  };
  MatchController* m_controller;
  VariablesModel* m_model;
  InPlaceMessage* m_message;
  std::vector<Pending> m_pending;  // on their way to the match
  ValueWatch m_watch;
};

}  // namespace pitchboard::ui
