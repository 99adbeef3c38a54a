// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The blackboards of this computer that a person attached: one list for every source, kept in the
// settings. Live shows them as robots, and a simulated match has their variables beside those of
// its robots; they are only read. The list is LiveOptions::boards. UI thread only.

#include <QObject>
#include <QTimer>
#include <memory>
#include <vector>

#include <robotlink/live/attached_robots.h>

class QSettings;

namespace pitchboard::ui {

class LiveController;
class MatchController;
class SourceSwitch;

class AttachedBoards : public QObject {
 public:
  /// All of them outlive this; without `settings` nothing is kept.
  AttachedBoards(MatchController* match, LiveController* live, SourceSwitch* source,
                 QSettings* settings, QObject* parent = nullptr);
  ~AttachedBoards() override;

  const std::vector<link::AttachedBoard>& list() const;
  /// Adds it, in place of an attached one with its key. Fails where it is not valid, which changes
  /// nothing, and where its segment cannot be read now: then it is attached once it can be.
  Result<void> attach(const link::AttachedBoard& board);
  void detach(int key);
  /// Of every board in the list, in the source that is shown.
  std::vector<link::AttachedStatus> status() const;

 private:
  void use(const std::vector<link::AttachedBoard>& boards);
  void followMatch();
  void setBesideMatch();

  MatchController* m_match;
  LiveController* m_live;
  SourceSwitch* m_source;
  QSettings* m_settings;
  std::unique_ptr<link::BoardRowKeeper> m_rows;    // of the open match
  std::unique_ptr<link::AttachedRobots> m_robots;  // beside it; null without a match
  QTimer m_take;
};

}  // namespace pitchboard::ui
