// SPDX-License-Identifier: GPL-3.0-or-later
#include "team_mates.h"

#include <algorithm>
#include <array>

#include <base/try.h>

namespace pitchboard::link {
namespace {

const std::string teamProcess = "team";

/// The rows of those of our team that have a blackboard, in their order in the session.
std::vector<telemetry::GroupId> matesOf(const telemetry::SessionReader& session,
                                        const RecordedRobot& recorded) {
  std::vector<telemetry::GroupId> mates;
  const auto groups = session.groups();
  for (telemetry::GroupId id = 0; id < groups.size(); ++id) {
    const telemetry::RobotFacts& facts = factsOf(groups[id].info);
    const auto& columns = groups[id].info.columns;
    const bool hasBoard = std::ranges::any_of(columns, [](const telemetry::ColumnInfo& column) {
      return column.name == "LOCALIZATION_X" && column.type != telemetry::ColumnType::Float64;
    });
    const bool isOther = id != recorded.group && facts.slot != recorded.robot.id.value;
    if (isRobotGroup(groups[id]) && hasBoard && isOther && facts.slot > 0 &&
        facts.team == recorded.robot.team) {
      mates.push_back(id);
    }
  }
  return mates;
}

}  // namespace

bool TeamMates::areRecorded(const telemetry::SessionReader& session,
                            const RecordedRobot& recorded) {
  return !matesOf(session, recorded).empty();
}

TeamMates::TeamMates(const telemetry::SessionReader& session, const RecordedRobot& recorded)
    : m_tickRate(recorded.tickRate),
      m_channel(std::make_shared<InProcessTeamChannel>()),
      m_groups(matesOf(session, recorded)) {
  for (const telemetry::GroupId group : m_groups) {
    const telemetry::GroupInfo& info = session.groups()[group].info;
    const std::array processes{teamProcess};
    auto mate = std::make_unique<Mate>(
        Mate{Feed(recorded.catalog, processes, {}), Blackboard::onHeap(), recorded.robot, {}});
    mate->feed.setColumns(info);
    mate->robot.id = RobotId{factsOf(info).slot};
    mate->robot.teamChannel = m_channel;
    m_mates.push_back(std::move(mate));
  }
}

Result<void> TeamMates::take(telemetry::GroupId group, const telemetry::RowView& row) {
  const auto at = std::ranges::find(m_groups, group) - m_groups.begin();
  Mate& mate = *m_mates[static_cast<std::size_t>(at)];
  const auto tick = static_cast<std::uint64_t>(std::llround(std::max(0.0, row.time) * m_tickRate));
  mate.feed.take(row);
  if (!mate.program) {
    mate.feed.writeAll(mate.board);
    RerunChoice choice;
    choice.process = teamProcess;
    choice.isInside = true;
    mate.program = TRY(insideProgram(choice, mate.robot, mate.board, m_tickRate, tick, false));
  } else {
    mate.feed.before(mate.board, mate.program->turn());
    TRY(mate.program->cycle(tick));
    mate.feed.after(mate.board);
  }
  mate.feed.endTick();
  return {};
}

}  // namespace pitchboard::link
