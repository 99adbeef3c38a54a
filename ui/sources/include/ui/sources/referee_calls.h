// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Referee calls by the user as edits of the match, and the menus for them. Undoing a call restores
// rules, game and whatever it had moved. UI thread only; calls are carried out on the match's
// thread.

#include <QString>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <simcore/rules/referee.h>
#include <ui/sources/match_edits.h>

class QMenu;

namespace pitchboard::ui {

/// Makes a call. It is put on the undo stack, as `text`, once the match has carried it out.
void callReferee(MatchEdits* edits, const sim::RefereeCall& call, const QString& text);
/// Makes the same call for each of these robots, as a single undo command.
void callReferee(MatchEdits* edits, sim::RefereeCall call, const std::vector<RobotId>& robots,
                 const QString& text);
/// Returns the call as a part of a larger edit.
EditStep refereeStep(MatchEdits* edits, sim::RefereeCall call);
/// Restarts the game with a rule set: a name of refereeRuleSets(), or `published` for a match
/// without a referee.
void chooseReferee(MatchEdits* edits, const std::string& ruleSet, const QString& title);

/// Returns why this call is not possible now; empty: it is.
QString whyRefused(const link::MatchFrame* frame, const sim::RefereeCall& call);

/// Adds the calls for these robots: penalties, pardon, cards. Adds nothing without a referee.
void addRefereeMenu(QMenu* menu, MatchController* match, const std::vector<RobotId>& robots);
/// Adds the calls for a place on the field: goals, and the ball at `place` or on a mark.
void addRefereeGround(QMenu* menu, MatchController* match, Point place);

}  // namespace pitchboard::ui
