// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How robots of one team talk: a robot posts a text, every other robot of the team takes it. Two
// kinds: UDP between operating-system processes, and memory between robots that run in lock-step in
// one program, where a message must arrive at the same tick in every run.

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <base/ids.h>
#include <base/result.h>

namespace pitchboard::link {

/// One thread at a time. post() and take() never block; a lost message is no error.
class TeamChannel {
 public:
  virtual ~TeamChannel() = default;
  virtual void post(RobotId from, std::string_view message) = 0;
  /// What others posted since this robot's last call, oldest first, at most 64 messages.
  virtual std::vector<std::string> take(RobotId to) = 0;
};

/// For robots that run in lock-step: what a robot posts is there for the others at their next
/// take(), in the order of posting. Shared by the robots of one team; use from one thread.
class InProcessTeamChannel final : public TeamChannel {
 public:
  void post(RobotId from, std::string_view message) override;
  std::vector<std::string> take(RobotId to) override;
  /// Everything that nobody has taken yet is lost.
  void clear();

 private:
  struct Box {
    RobotId owner;
    std::deque<std::string> messages;
  };
  std::vector<Box> m_boxes;
};

class ProcessTurns;

/// Of a process that takes its turns from a match: in lock-step messages travel with the turns, so
/// that they arrive at the same tick in every run, else by `udp`. What is posted can be heard by
/// UDP in any case.
std::unique_ptr<TeamChannel> makeTurnsChannel(std::shared_ptr<ProcessTurns> turns,
                                              std::unique_ptr<TeamChannel> udp);

/// Broadcast on port `portBase` + team; 10000 is the convention of the Humanoid Soccer League 2026;
/// a datagram has at most 512 bytes. `address` 127.0.0.1 keeps everything on this computer
/// (127.255.255.255 is its broadcast address); a network's broadcast address reaches real robots.
/// Fails with the reason when the address, the team (0..99) or the port cannot be used.
Result<std::unique_ptr<TeamChannel>> makeUdpTeamChannel(const std::string& address, int team,
                                                        int portBase = 10000);

}  // namespace pitchboard::link
