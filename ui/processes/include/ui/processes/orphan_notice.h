// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The notice about blackboards that a crashed program left behind, shown when the studio starts. UI
// thread only.

namespace pitchboard::ui {

class MatchController;
class NoticeBar;

/// Offers to remove blackboards that no process uses any more. Call it before a match is opened,
/// because the match uses blackboards with the same keys.
void showOrphanNotice(NoticeBar* notices, MatchController* controller);

}  // namespace pitchboard::ui
