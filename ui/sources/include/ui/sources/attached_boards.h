// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The blackboards of this computer that the user has attached. All sources share the list, which is
// kept in the settings and is also LiveOptions::boards. Live shows the blackboards as robots; a
// simulated match shows their variables beside those of its own robots. They are only read. UI
// thread only.

#include <QObject>
#include <QTimer>
#include <memory>
#include <vector>

#include <robotlink/live/attached_robots.h>

class QSettings;

namespace pitchboard::ui {

class LiveController;
class MatchController;
class ShownMoment;

class AttachedBoards : public QObject {
 public:
  /// All arguments must outlive this object; `settings` may be null.
  AttachedBoards(MatchController* match, LiveController* live, ShownMoment* shown,
                 QSettings* settings, QObject* parent = nullptr);
  ~AttachedBoards() override;

  const std::vector<link::AttachedBoard>& list() const;
  /// Attaches a blackboard, replacing one with the same key. Fails without a change if it is not
  /// valid. Also fails if its segment cannot be read now, but then attaches it as soon as it can
  /// be.
  Result<void> attach(const link::AttachedBoard& board);
  void detach(int key);
  /// Returns the status of each blackboard in the list, in the source that is shown.
  std::vector<link::AttachedStatus> status() const;

 private:
  void use(const std::vector<link::AttachedBoard>& boards);
  void followMatch();
  void setBesideMatch();

  MatchController* m_match;
  LiveController* m_live;
  ShownMoment* m_shown;
  QSettings* m_settings;
  std::unique_ptr<link::BoardRowKeeper> m_rows;    // of the open match
  std::unique_ptr<link::AttachedRobots> m_robots;  // beside it; null without a match
  QTimer m_take;
};

}  // namespace pitchboard::ui
