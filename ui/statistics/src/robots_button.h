// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Chooses the robots that a variable without a robot stands for: all, those that are selected on
// the field, or some by name; and, while sessions are compared, of which sessions. UI thread only.

#include <QStringList>
#include <QToolButton>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <telemetry/series/series_store.h>

namespace pitchboard::ui {

class ComparedSession;
class ComparedSessions;
class RobotSelection;
class ShownMoment;

class RobotsButton : public QToolButton {
  Q_OBJECT
 public:
  /// All must outlive it.
  RobotsButton(ShownMoment* shown, RobotSelection* selection, const ComparedSessions* compared,
               QWidget* parent);

  /// Returns the names of the groups; empty: all.
  std::vector<std::string> robots() const;
  bool takesShown() const { return !m_leftOut.contains(shownId); }
  bool takes(const ComparedSession& session) const;

 signals:
  void changed();

 private:
  static constexpr quint64 shownId = 0;  ///< no compared session has it
  void fill();
  void addSession(const QString& text, quint64 id);
  void label();
  void choose(bool followsSelection, const QStringList& groups);
  /// The groups in the order in which they are listed.
  std::vector<std::shared_ptr<const telemetry::GroupView>> listed() const;

  ShownMoment* m_shown;
  RobotSelection* m_selection;
  const ComparedSessions* m_compared;
  std::set<quint64> m_leftOut;  // ids of sessions
  bool m_followsSelection = false;
  QStringList m_groups;  // chosen one by one, by what isSameGroup() compares; empty: all
};

}  // namespace pitchboard::ui
