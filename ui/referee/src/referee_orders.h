// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The referee's calls as undoable commands of the match: undoing one puts the game back as it was
// when it was called, and what it had moved. UI thread; carried out on the match's thread.

#include <QString>
#include <QUndoCommand>
#include <memory>

#include <simcore/rules/referee.h>

namespace pitchboard::ui {

class MatchController;

class RefereeCommand : public QUndoCommand {
 public:
  RefereeCommand(MatchController* match, const sim::RefereeCall& call, const QString& words);
  void redo() override;
  void undo() override;

 private:
  struct Before;
  MatchController* m_match;
  sim::RefereeCall m_call;
  std::shared_ptr<Before> m_before;
};

/// Makes the call; it is on the undo stack from then on.
void callReferee(MatchController* match, const sim::RefereeCall& call, const QString& words);

}  // namespace pitchboard::ui
