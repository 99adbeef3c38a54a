// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/robot_uids.h>

#include <algorithm>
#include <array>
#include <string_view>

#include <robotlink/frame/teams.h>
#include <telemetry/monitor/team_monitor.h>

#include "uid_ranges.h"

namespace pitchboard::link {

static_assert(RobotUids::maxRobots >
              telemetry::MonitorOptions::maxRobots(telemetry::TeamSetup::maxTeams + 1));

namespace {

using uid_ranges::mask;
using uid_ranges::ofNetwork;

/// The first datagram says who it is, so that a part of a recording gives the same uids.
RobotUid firstUid(int place, int number, telemetry::Address sender) {
  std::uint64_t bits = static_cast<std::uint64_t>(place) << 58 ^
                       static_cast<std::uint64_t>(number) << 32 ^ sender.value;
  bits *= 0x9e37'79b9'7f4a'7c15U;
  bits ^= bits >> 32;
  bits *= 0xd6e8'feb8'6659'fd93U;
  return {ofNetwork | (static_cast<std::uint32_t>(bits >> 32) & mask)};
}

}  // namespace

/// Returns the robot at this index, or a new one behind the last index.
RobotUids::Known& RobotUids::take(std::size_t index, int place, int number,
                                  telemetry::Address sender) {
  if (index < m_known.size()) {
    const auto robot = m_known.begin() + static_cast<std::ptrdiff_t>(index);
    std::rotate(robot, robot + 1, m_known.end());
    return m_known.back();
  }
  if (m_known.size() == maxRobots) {
    const auto isOther = [](const Known& known) {
      return !known.key || !telemetry::hasOwnPlace(*known.key);
    };
    m_known.erase(std::ranges::find_if(m_known, isOther));
  }
  // Another robot may have begun here, and has another key or address now.
  RobotUid uid = firstUid(place, number, sender);
  while (std::ranges::find(m_known, uid, &Known::uid) != m_known.end()) {
    uid = {ofNetwork | ((uid.value + 1) & mask)};
  }
  m_known.emplace_back().uid = uid;
  return m_known.back();
}

RobotUid RobotUids::ofMessages(const RobotKey& key, telemetry::Address sender) {
  std::size_t index = find([&](const Known& known) { return known.key == key; });
  if (index == m_known.size()) {
    index = find([&](const Known& known) {
      const bool isSameTeam = known.place == key.team || known.place == 0 || key.team == 0;
      return known.sendsVariables && !known.key && known.number == key.number &&
             known.sender == sender && isSameTeam;
    });
  }
  Known& robot = take(index, key.team, key.number, sender);
  robot.key = key;
  robot.number = key.number;
  robot.place = key.team;
  robot.sender = sender;
  return robot.uid;
}

RobotUid RobotUids::ofVariables(int number, telemetry::Address sender, int place,
                                const std::function<bool(RobotUid)>& isReceived) {
  const auto mayBe = [&](const Known& known) {
    return known.number == number && !isReceived(known.uid);
  };
  std::size_t index = find([&](const Known& known) {
    return mayBe(known) && known.sender == sender && known.place == place;
  });
  if (index == m_known.size()) {
    index = find([&](const Known& known) {
      return mayBe(known) && known.sender == sender && (known.place == 0 || place == 0);
    });
  }
  if (index == m_known.size()) {
    index = find([&](const Known& known) {
      return mayBe(known) && known.sendsVariables && !known.key && known.place == place;
    });
  }
  Known& robot = take(index, place, number, sender);
  robot.number = number;
  robot.sender = sender;
  if (!robot.key) robot.place = place;
  robot.sendsVariables = true;
  return robot.uid;
}

void RobotUids::move(RobotUid uid, telemetry::Address sender) {
  const std::size_t index = find([uid](const Known& known) { return known.uid == uid; });
  if (index < m_known.size()) m_known[index].sender = sender;
}

void RobotUids::rename(const std::vector<telemetry::Renaming>& renamings) {
  using telemetry::Renaming;
  // A robot that is not received any more may still have a key that another one gets now.
  std::erase_if(m_known, [&](Known& known) {
    if (!known.key) return false;
    const bool isRenamed =
        std::ranges::find(renamings, *known.key, &Renaming::from) != renamings.end();
    const bool isTaken = std::ranges::find(renamings, *known.key, &Renaming::to) != renamings.end();
    if (isRenamed || !isTaken) return false;
    known.key.reset();
    return !known.sendsVariables;
  });
  for (Known& known : m_known) {
    if (!known.key) continue;
    const auto found = std::ranges::find(renamings, *known.key, &Renaming::from);
    if (found == renamings.end()) continue;
    known.key = found->to;
    known.place = found->to.team;
  }
}

void RobotUids::keepOnly(const std::vector<RobotKey>& keys) {
  std::erase_if(m_known, [&](Known& known) {
    if (!known.key || std::ranges::find(keys, *known.key) != keys.end()) return false;
    known.key.reset();
    return !known.sendsVariables;
  });
}

std::optional<RobotKey> RobotUids::keyOf(RobotUid robot) const {
  const auto found = std::ranges::find(m_known, robot, &Known::uid);
  return found == m_known.end() ? std::nullopt : found->key;
}

RobotUid RobotUids::withKey(const RobotKey& key) const {
  const std::size_t index = find([&key](const Known& known) { return known.key == key; });
  return index == m_known.size() ? uidOf(key) : m_known[index].uid;
}

std::string earlierName(std::string_view name, std::set<std::string>& taken) {
  constexpr std::string_view earlier = " (earlier";
  std::string free(name);
  const std::string base = free.substr(0, free.find(earlier));
  for (int i = 1; !taken.insert(free).second; ++i) {
    free = base + std::string(earlier) + (i > 1 ? " " + std::to_string(i) : "") + ")";
  }
  return free;
}

std::string groupId(RobotUid robot, RobotRows rows) {
  constexpr std::array<std::string_view, 4> names{"messages", "link", "variables", "agent"};
  return std::to_string(robot.value) + " " + std::string(names[static_cast<std::size_t>(rows)]);
}

}  // namespace pitchboard::link
