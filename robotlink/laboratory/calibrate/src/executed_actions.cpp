// SPDX-License-Identifier: GPL-3.0-or-later
#include "executed_actions.h"

#include <simcore/world/action_codes.h>

namespace pitchboard::link {
namespace {

constexpr double afterFall = 0.5;  // s behind getting up that are not used

bool isKick(int code) {
  return code >= 0 && code < static_cast<int>(knownActions.size()) &&
         knownActions[static_cast<std::size_t>(code)].kind == ActionKind::Kick;
}

}  // namespace

std::vector<ExecutedAction> executedActions(const CalibrationLog& log,
                                            const sim::RobotModel& base) {
  std::vector<ExecutedAction> out(log.rows.size());
  ExecutedAction now;
  double kickBegan = 0.0, lastFallen = -1e9;
  for (std::size_t i = 0; i < log.rows.size(); ++i) {
    const CalibrationRow& row = log.rows[i];
    const bool wasDown = now.down;
    now.began = false;
    if (row.fallen) lastFallen = row.time;
    now.down = row.time - lastFallen < afterFall;
    if (now.down) {
      now.began = !wasDown;
      now.code = row.action;
      now.kicks = false;
    } else if (now.kicks) {
      const bool over = row.moving ? !*row.moving : row.time - kickBegan >= base.kickTime;
      if (over) now = {};
    } else if (row.action != now.code || wasDown) {
      now.code = row.action;
      now.b = row.actionB;
      now.began = true;
      now.kicks = isKick(row.action) && (row.moving ? *row.moving : base.kickTime > 0.0);
      kickBegan = row.time;
    }
    out[i] = now;
  }
  return out;
}

}  // namespace pitchboard::link
