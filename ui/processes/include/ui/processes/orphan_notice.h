// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Blackboards that a crashed program left behind, told when the studio starts. Window thread.

namespace pitchboard::ui {

class MatchController;
class NoticeBar;

/// Offers to remove blackboards that nobody uses any more. Call it before a match is opened:
/// afterwards the match itself uses them.
void showOrphanNotice(NoticeBar* notices, MatchController* controller);

}  // namespace pitchboard::ui
