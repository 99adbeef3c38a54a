// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a person decides as the referee, as edits of the match: undoing one puts rules and game back
// as they were, and what it had moved. UI thread; carried out on the match's thread.

#include <QString>
#include <string>

#include <simcore/rules/referee.h>

namespace pitchboard::ui {

class MatchEdits;

/// Makes the call; it is on the undo stack from then on.
void callReferee(MatchEdits* edits, const sim::RefereeCall& call, const QString& words);
/// The game begins anew with this rule set (a name of refereeRuleSets(); `published`: without a
/// referee).
void chooseReferee(MatchEdits* edits, const std::string& ruleSet, const QString& title);

}  // namespace pitchboard::ui
