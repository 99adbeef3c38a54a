// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Blackboards of this computer that a person asked to look at beside those of the match: only read,
// each at its own rate. They are taken along from match to match. UI thread only.

#include <QHash>
#include <QObject>
#include <QTimer>
#include <memory>
#include <vector>

#include <robotlink/live/attached_robots.h>

namespace pitchboard::ui {

class MatchController;

class AttachedBoards : public QObject {
 public:
  explicit AttachedBoards(MatchController* controller, QObject* parent = nullptr);
  ~AttachedBoards() override;

  /// Samples this System V key from now on; a key that is attached already gets the new rate. Fails
  /// with the reason and leaves everything as it was.
  Result<void> attach(int key, double rate);
  void detach(int key);
  bool contains(int key) const;
  /// Of every attached board. One that waits for a match or for its segment says so.
  std::vector<link::AttachedStatus> status() const;
  /// Of its rows, in the match that there is; also once it is detached.
  QString groupName(int key) const { return m_names.value(key); }

 private:
  void follow();
  void set();

  MatchController* m_controller;
  std::vector<link::AttachedBoard> m_boards;
  QHash<int, QString> m_names;                     // by key
  std::unique_ptr<link::BoardRowKeeper> m_rows;    // of the match that there is
  std::unique_ptr<link::AttachedRobots> m_robots;  // null without a match
  QTimer m_take;
};

}  // namespace pitchboard::ui
