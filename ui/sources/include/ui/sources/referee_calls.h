// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a person decides as the referee, as edits of the match: undoing one puts rules and game back
// as they were, and what it had moved. And the menus of field and robots that decide. UI thread;
// carried out on the match's thread.

#include <QString>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/frame/match_frame.h>
#include <simcore/rules/referee.h>
#include <ui/sources/match_edits.h>

class QMenu;

namespace pitchboard::ui {

/// Makes the call; it is on the undo stack once the match has carried it out.
void callReferee(MatchEdits* edits, const sim::RefereeCall& call, const QString& words);
/// The same call for each of these robots, as one step of undo.
void callReferee(MatchEdits* edits, sim::RefereeCall call, const std::vector<RobotId>& robots,
                 const QString& words);
/// The call as a part of a larger edit.
EditStep refereeStep(MatchEdits* edits, sim::RefereeCall call);
/// The game begins anew with this rule set (a name of refereeRuleSets(); `published`: without a
/// referee).
void chooseReferee(MatchEdits* edits, const std::string& ruleSet, const QString& title);

/// Why this call would be refused now; empty: it is allowed.
QString whyRefused(const link::MatchFrame* frame, const sim::RefereeCall& call);

/// What the referee can do with these robots: penalise, pardon, show cards. Nothing where the match
/// has no referee.
void addRefereeMenu(QMenu* menu, MatchController* match, const std::vector<RobotId>& robots);
/// What the referee can do on the ground: goals, and the ball at `place` or on a mark.
void addRefereeGround(QMenu* menu, MatchController* match, Point place);

/// "corner kick" as "Corner kick".
QString asLabel(std::string_view words);

}  // namespace pitchboard::ui
