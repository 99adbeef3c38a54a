// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A team setup as it is typed: what is no setup yet stays the text that it is. Plain values and
// pure functions.

#include <QString>

#include <telemetry/monitor/team_setup.h>

namespace pitchboard::ui {

struct TeamDraft {
  telemetry::TeamSetup setup;
  QString senders;  ///< "192.168.0.7, 192.168.18.0/24"
  QString robots;   ///< "1 Ana, 2 Bo"
};

TeamDraft draftOf(const telemetry::TeamSetup& setup);
/// Errors name the team and what is wrong.
Result<telemetry::TeamSetup> setupOf(const TeamDraft& draft);

}  // namespace pitchboard::ui
