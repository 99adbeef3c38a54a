// SPDX-License-Identifier: GPL-3.0-or-later
#include "recorded_robot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <base/try.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/recorded_frame.h>

namespace pitchboard::link {
namespace {

constexpr std::size_t measuredRows = 200;

Result<telemetry::GroupId> groupOfRobot(const telemetry::SessionReader& session,
                                        const std::string& name) {
  const auto groups = session.groups();
  if (std::ranges::none_of(groups, isRobotGroup)) {
    return failure(ErrorCode::NotFound, "This recording has no rows of a robot.");
  }
  // A live robot has messages and a blackboard: that with more words.
  std::optional<telemetry::GroupId> found;
  std::ptrdiff_t most = -1;
  for (const telemetry::GroupId id : TRY(session.groupsNamed(name))) {
    const std::ptrdiff_t words =
        std::ranges::count_if(groups[id].info.columns, [](const telemetry::ColumnInfo& column) {
          return column.type != telemetry::ColumnType::Float64;
        });
    if (!isRobotGroup(groups[id]) || words <= most) continue;
    found = id;
    most = words;
  }
  if (found) return *found;
  return failure(ErrorCode::NotFound, "There are no rows of \"" + name + "\".", "--robot");
}

Result<VariableCatalog> catalogOf(const telemetry::SessionReader& session,
                                  const std::string& file) {
  if (!file.empty()) return TRY(VariableCatalog::fromFile(file)).withExtension();
  const auto text = session.attachment(catalogAttachment);
  if (!text) return VariableCatalog::extended();
  return TRY(VariableCatalog::fromJson(*text, catalogAttachment)).withExtension();
}

/// The begin of the rows, and the usual time between two of them, from the first ones.
void measureRows(const telemetry::SessionReader& session, RecordedRobot& recorded) {
  std::vector<double> gaps;
  std::optional<double> last;
  const std::array only{recorded.group};
  session.rows({-1e18, 1e18}, only, [&](telemetry::GroupId, const telemetry::RowView& row) {
    if (last && row.time > *last + rowTolerance) gaps.push_back(row.time - *last);
    if (!last) recorded.begin = row.time;
    last = row.time;
    return gaps.size() < measuredRows;
  });
  if (gaps.empty()) return;
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  recorded.rowInterval = *middle;
}

/// Who plays, from the rows' facts and the scenario.
void knowRobot(const telemetry::SessionReader& session, RecordedRobot& recorded) {
  const telemetry::RobotFacts& facts = factsOf(session.groups()[recorded.group].info);
  RerunRobot& robot = recorded.robot;
  robot.id = RobotId{std::max(1, facts.slot)};
  robot.team = facts.team.value_or(TeamColor::Blue);
  robot.shirt = facts.number > 0 ? facts.number : robot.id.value;
  robot.behaviour = facts.behaviour == noBehaviour ? std::string() : facts.behaviour;
  robot.facesLeft = facts.imuStartsAt180;
  robot.field = backdropOf(session).field;
  if (!recorded.scenario) return;
  const Scenario& scenario = *recorded.scenario;
  robot.field = sim::playedField(scenario.settings);
  robot.seed = scenario.settings.seed;
  recorded.planned = scenario.writes;
  for (const ScenarioRobot& one : scenario.robots) {
    if (one.identity.id != robot.id) continue;
    robot.parameters = one.parameters;
    robot.model = one.model;
    recorded.runtime = scenario.runtimeOf(one);
  }
  std::erase_if(recorded.planned, [&robot](const BlackboardWrite& write) {
    return write.robot.value != 0 && write.robot != robot.id;
  });
}

}  // namespace

bool isRobotGroup(const telemetry::SessionGroup& group) {
  return group.info.robot.has_value() && !group.info.match && group.rows > 0;
}

Result<RecordedRobot> recordedRobot(const telemetry::SessionReader& session,
                                    const RerunOptions& options) {
  RecordedRobot recorded;
  recorded.group = TRY(groupOfRobot(session, options.robot));
  recorded.name = session.groups()[recorded.group].info.name;
  recorded.catalog = TRY(catalogOf(session, options.catalog));
  if (const auto text = session.attachment(scenarioAttachment)) {
    recorded.scenario = TRY(scenarioFromJson(*text, scenarioAttachment, recorded.catalog));
  }
  for (const telemetry::SessionGroup& group : session.groups()) {
    if (!group.info.match || !group.info.match->tickRate_hz) continue;
    recorded.hasWorld = session.count(telemetry::SessionStream::Checkpoints) > 0;
    recorded.tickRate = *group.info.match->tickRate_hz;
  }
  measureRows(session, recorded);
  knowRobot(session, recorded);
  return recorded;
}

std::uint64_t RecordedRobot::tickOf(double time) const {
  return static_cast<std::uint64_t>(std::llround(std::max(0.0, time) * tickRate));
}

std::string RecordedRobot::programOf(const std::string& process, const std::string& session) const {
  if (!scenario) return {};
  if (!runtime.isChosen()) return std::string(referenceProgram);
  if (process == "decision" && !runtime.decision.empty()) return runtime.decision;
  RuntimeChoice choice = runtime;
  choice.profile = besideRecording(choice.profile, session);
  if (const auto profile = loadRuntime(choice)) {
    const auto found = std::ranges::find(profile->processes, process, &ProfileProcess::name);
    if (found == profile->processes.end()) return {};
    if (found->isReference()) return std::string(referenceProgram);
  }
  return runtimeChoiceToText(choice);
}

}  // namespace pitchboard::link
