// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The referee's log: what it has said of the match being simulated, a line each, newest last. UI
// thread only; the match must outlive it.

#include <QPlainTextEdit>
#include <deque>

namespace pitchboard::ui {

class MatchController;

class RefereeLog : public QPlainTextEdit {
 public:
  RefereeLog(MatchController* match, QWidget* parent);

 private:
  struct Line {
    double time;  // s of the match
    QString text;
  };
  std::deque<Line> m_lines;
};

}  // namespace pitchboard::ui
