// SPDX-License-Identifier: GPL-3.0-or-later
// What only one program of this computer may have: the simulated side of a robot, a match number.
#include <base/try.h>
#include <robotlink/blackboard/match_number.h>
#include <robotlink/blackboard/system_v.h>

#include "name_lock.h"

namespace pitchboard::link {

Result<BridgeClaim> BridgeClaim::take(int key) {
  const std::string context = "blackboard " + std::to_string(key);
  auto lock = TRY(lockName("bridge-" + std::to_string(key), context));
  if (lock.socket) return BridgeClaim(std::move(lock.socket));
  return failure(ErrorCode::Conflict,
                 lock.holder.empty()
                     ? "another program is just taking or giving up this robot; try again"
                     : "is being simulated already by " + lock.holder +
                           "; end that one, or choose another robot number or match number",
                 context);
}

Result<MatchClaim> MatchClaim::take(int number) {
  const std::string context = "match " + std::to_string(number);
  if (number < 0 || number > MatchNumber::most) {
    return failure(ErrorCode::InvalidArgument,
                   "match numbers are 0 to " + std::to_string(MatchNumber::most), context);
  }
  auto lock = TRY(lockName("match-" + std::to_string(number), context));
  if (lock.socket) return MatchClaim(MatchNumber{number}, std::move(lock.socket), {});
  return failure(ErrorCode::Conflict,
                 "is played already" +
                     (lock.holder.empty() ? std::string() : " by " + lock.holder) +
                     "; leave the number out to get the next free one",
                 context);
}

Result<MatchClaim> MatchClaim::takeFree() {
  std::string holder;
  for (int number = 0; number <= MatchNumber::most; ++number) {
    auto lock = TRY(lockName("match-" + std::to_string(number), "match " + std::to_string(number)));
    if (lock.socket) return MatchClaim(MatchNumber{number}, std::move(lock.socket), holder);
    if (number == 0) holder = lock.holder.empty() ? "another program" : lock.holder;
  }
  return failure(ErrorCode::Conflict, "all " + std::to_string(MatchNumber::most + 1) +
                                          " match numbers of this computer are in use; end a match "
                                          "whose processes run separately");
}

}  // namespace pitchboard::link
