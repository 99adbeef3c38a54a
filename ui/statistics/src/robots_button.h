// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Chooses the robots that a variable without a robot stands for: all, those that are selected on
// the field, or some by name. UI thread only.

#include <QStringList>
#include <QToolButton>
#include <memory>
#include <string>
#include <vector>

#include <telemetry/series/series_store.h>

namespace pitchboard::ui {

class RobotSelection;
class ShownMoment;

class RobotsButton : public QToolButton {
  Q_OBJECT
 public:
  /// Both must outlive it.
  RobotsButton(ShownMoment* shown, RobotSelection* selection, QWidget* parent);

  /// Returns the names of the groups; empty: all.
  std::vector<std::string> robots() const;

 signals:
  void changed();

 private:
  void fill();
  void label();
  void choose(bool followsSelection, const QStringList& groups);
  /// The groups in the order in which they are listed.
  std::vector<std::shared_ptr<const telemetry::GroupView>> listed() const;

  ShownMoment* m_shown;
  RobotSelection* m_selection;
  bool m_followsSelection = false;
  QStringList m_groups;  // chosen one by one, by what isSameGroup() compares; empty: all
};

}  // namespace pitchboard::ui
