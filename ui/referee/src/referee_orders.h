// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a person decides as the referee, as undoable commands of the match: undoing one puts rules
// and game back as they were, and what it had moved. UI thread; carried out on the match's thread.

#include <QString>
#include <QUndoCommand>
#include <functional>
#include <memory>
#include <string>

#include <base/result.h>
#include <simcore/rules/referee.h>

namespace pitchboard::link {
class SimulatedMatch;
}

namespace pitchboard::ui {

class MatchEdits;

class RefereeCommand : public QUndoCommand {
 public:
  using Decide = std::function<Result<void>(link::SimulatedMatch&)>;
  /// `whatFailed` stands before the reason when `decide` fails.
  RefereeCommand(MatchEdits* edits, const QString& text, const QString& whatFailed, Decide decide);
  void redo() override;
  void undo() override;

 private:
  struct Before;
  MatchEdits* m_edits;
  QString m_whatFailed;
  Decide m_decide;
  std::shared_ptr<Before> m_before;
};

/// Makes the call; it is on the undo stack from then on.
void callReferee(MatchEdits* edits, const sim::RefereeCall& call, const QString& words);
/// The game begins anew with this rule set (a name of refereeRuleSets(); `published`: without a
/// referee).
void chooseReferee(MatchEdits* edits, const std::string& ruleSet, const QString& title);

}  // namespace pitchboard::ui
