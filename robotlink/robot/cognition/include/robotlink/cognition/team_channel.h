// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A channel on which the robots of a team exchange messages: one robot posts a text, each of the
// others takes it. There are three kinds: UDP between processes, memory between robots inside one
// program, and lock-step slots between separate processes. With the latter two a message arrives
// at the same tick in every run.

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <base/ids.h>
#include <base/result.h>

namespace pitchboard::link {

/// One thread at a time. post() and take() never block; losing a message is not an error.
class TeamChannel {
 public:
  virtual ~TeamChannel() = default;
  virtual void post(RobotId from, std::string_view message) = 0;
  /// Returns what others posted since this robot's last call, oldest first, at most 64 messages.
  virtual std::vector<std::string> take(RobotId to) = 0;
};

/// For robots inside one program, in lock-step: each posted message is available to the others at
/// their next take(), in the order of posting. Shared by the robots of a team; used on one thread.
class InProcessTeamChannel final : public TeamChannel {
 public:
  void post(RobotId from, std::string_view message) override;
  std::vector<std::string> take(RobotId to) override;
  /// Drops all messages that have not been taken.
  void clear();

 private:
  struct Box {
    RobotId owner;
    std::deque<std::string> messages;
  };
  std::vector<Box> m_boxes;
};

class LockStepSlot;

/// Makes the channel of a separate process that runs in step with a match. In lock-step, messages
/// are passed through the shared slot, so that they arrive at the same tick in every run; otherwise
/// they come by `udp`. Posted messages are always sent by UDP, too, so that others can receive
/// them.
std::unique_ptr<TeamChannel> makeLockStepChannel(std::shared_ptr<LockStepSlot> slot,
                                                 std::unique_ptr<TeamChannel> udp);

/// Makes a channel of UDP broadcasts on port `portBase` + team; base 10000 is the convention of the
/// Humanoid Soccer League 2026. A datagram has at most 512 bytes. With `address` 127.0.0.1 messages
/// stay on this computer (its broadcast address is 127.255.255.255); the broadcast address of a
/// network reaches real robots. Fails if address, team (0 to 99) or port cannot be used.
Result<std::unique_ptr<TeamChannel>> makeUdpTeamChannel(const std::string& address, int team,
                                                        int portBase = 10000);

}  // namespace pitchboard::link
