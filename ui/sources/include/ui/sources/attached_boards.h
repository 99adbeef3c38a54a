// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Blackboards of this computer that a person asked to look at beside those of the match: only read,
// each at its own rate. They are taken along from match to match. UI thread only.

#include <QObject>
#include <map>
#include <memory>

#include <robotlink/session/board_sampler.h>

namespace pitchboard::ui {

class MatchController;

class AttachedBoards : public QObject {
  Q_OBJECT
 public:
  explicit AttachedBoards(MatchController* controller, QObject* parent = nullptr);
  ~AttachedBoards() override;

  /// Samples this System V key from now on; a key that is attached already gets the new rate. Fails
  /// with the reason and leaves everything as it was.
  Result<void> attach(int key, double rate);
  void detach(int key);
  bool contains(int key) const { return m_boards.count(key) != 0; }
  /// Of every attached board, by key. A board that waits for a match or for its segment says so.
  std::map<int, link::BoardSamplerStatus> status() const;
  /// Of its rows, in the match that there is.
  QString groupName(int key) const;

 signals:
  void changed();

 private:
  struct Board {
    double rate = 0.0;
    std::unique_ptr<link::BoardSampler> sampler;  // none: to be tried again
    std::string problem;
  };
  Result<std::unique_ptr<link::BoardSampler>> start(int key, double rate) const;
  void follow();

  MatchController* m_controller;
  std::map<int, Board> m_boards;
};

}  // namespace pitchboard::ui
