// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/recorded_frame.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include <base/angles.h>
#include <robotlink/frame/build_robot.h>
#include <robotlink/frame/drawing_origin.h>
#include <robotlink/frame/join_boards.h>
#include <robotlink/live/attached_robots.h>
#include <robotlink/scenario/scenario.h>
#include <robotlink/session/session_choice.h>

#include "recorded_layout.h"

namespace pitchboard::link {
namespace {

constexpr double maxAge = 1e6;  // s; beyond it no clock is right

std::uint32_t counter(double value) {
  return value >= 0.0 && value <= 4294967295.0 ? static_cast<std::uint32_t>(value) : 0U;
}

/// Returns the limits of the robot's model, or the usual ones if the recording has none.
telemetry::BatteryLimits batteryOf(const telemetry::GroupInfo& info) {
  const auto& battery = factsOf(info).battery;
  if (!battery) return telemetry::defaultBattery;
  sim::RobotModel model;
  model.batteryFull = battery->full;
  model.batteryLow = battery->low;
  model.batteryEmpty = battery->empty;
  return batteryLimitsOf(model);
}

}  // namespace

FrameSettings backdropOf(const telemetry::SessionReader& session) {
  FrameSettings out;
  if (const auto field = session.info().more.find("field"); field != session.info().more.end()) {
    if (auto known = sim::fieldByName(field->second)) out.field = *known;
  }
  if (const auto text = session.attachment("scenario.json")) {
    if (const auto scenario = scenarioFromJson(*text, "scenario.json")) {
      const sim::SimulationSettings& recorded = scenario->settings;
      out = {recorded.field, recorded.noise,    recorded.physics,
             recorded.seed,  recorded.tickRate, recorded.rigidBody};
    }
  }
  return out;
}

RecordedFrames::RecordedFrames(FrameSettings settings, RobotChoice robots)
    : m_given(std::move(settings)), m_robots(std::move(robots)) {}
RecordedFrames::~RecordedFrames() = default;

const RecordedFrames::Layout& RecordedFrames::layoutOf(std::size_t group) {
  auto& layout = m_layouts[group];
  const auto& columns = m_groups[group]->columns;
  if (!layout ||
      !std::ranges::equal(layout->types, columns, {}, {}, &telemetry::ColumnInfo::type)) {
    layout = std::make_unique<Layout>(*m_groups[group]);
  }
  return *layout;
}

MatchFrame RecordedFrames::frameAt(const telemetry::SeriesStore& rows, double time) {
  std::vector<RobotFrame> boards;
  MatchFrame frame = rowFrameAt(rows, time, boards);
  joinBoards(frame, std::move(boards));
  return frame;
}

std::vector<RobotFrame> RecordedFrames::boardsAt(const telemetry::SeriesStore& rows, double time) {
  std::vector<RobotFrame> boards;
  (void)rowFrameAt(rows, time, boards);
  return boards;
}

MatchFrame RecordedFrames::rowFrameAt(const telemetry::SeriesStore& rows, double time,
                                      std::vector<RobotFrame>& boards) {
  const std::size_t count = rows.groups();
  m_groups.assign(count, nullptr);
  m_rows.resize(count);
  m_views.assign(count, nullptr);
  for (std::size_t i = 0; i < count; ++i) {
    m_views[i] = rows.view(static_cast<telemetry::GroupId>(i));
    m_rows[i].present = m_views[i] && m_views[i]->rowAt(time + timeTolerance, m_rows[i].time,
                                                        m_rows[i].words, m_rows[i].values);
    if (m_views[i]) m_groups[i] = &m_views[i]->info();
  }
  const auto lookBack = [&](std::size_t group, const Layout&, double from, LampMemory& lamps) {
    for (std::size_t f = 0; f < telemetry::processCount; ++f) {
      const auto& columns = m_groups[group]->columns;
      const auto column = std::ranges::find(
          columns, telemetry::meaningTable[static_cast<std::size_t>(lampOf(f))].variable,
          &telemetry::ColumnInfo::name);
      if (column == columns.end()) continue;
      std::array<telemetry::SeriesBucket, 4> parts;
      const double step = (time + timeTolerance - from) / static_cast<double>(parts.size());
      m_views[group]->buckets(static_cast<std::uint32_t>(column - columns.begin()),
                              {from, time + timeTolerance}, parts);
      for (std::size_t p = 0; p < parts.size(); ++p) {
        if (parts[p].samples == 0 || !(parts[p].max > 0.0)) continue;
        lamps.saw(f, from + step * static_cast<double>(p));
      }
    }
  };
  MatchFrame frame = build(time, lookBack, boards);
  m_views.clear();
  return frame;
}

MatchFrame RecordedFrames::frameAt(const telemetry::SessionReader& session, double time) {
  MatchFrame frame = wholeFrameAt(session, time);
  keepRobots(frame, m_robots);
  return frame;
}

MatchFrame RecordedFrames::wholeFrameAt(const telemetry::SessionReader& session, double time) {
  std::optional<MatchFrame> seen;
  if (session.count(telemetry::SessionStream::LiveState) > 0) {
    seen = m_live.frameAt(SessionHistory(session), time);
  }
  // Blackboards of a live match are rows, all else of it are messages.
  std::vector<RobotFrame> boards;
  const bool hasBoards = !seen || std::ranges::any_of(session.groups(), [](const auto& group) {
    return factsOf(group.info).attached || !factsOf(group.info).sentFrom.empty() ||
           !factsOf(group.info).recordedBy.empty();
  });
  MatchFrame frame;
  if (hasBoards) frame = rowFrameAt(session, time, boards);
  if (seen) {
    frame = std::move(*seen);
    frame.serial = ++m_serial;
  }
  joinBoards(frame, std::move(boards));
  if (hasBoards && frame.game) penaliseImported(frame);
  return frame;
}

/// The referee's penalties of robots that were imported.
void RecordedFrames::penaliseImported(MatchFrame& frame) const {
  for (const telemetry::GroupInfo* group : m_groups) {
    const telemetry::RobotFacts& facts = factsOf(*group);
    if (facts.recordedBy.empty()) continue;
    const auto robot = std::ranges::find(frame.robots, facts.uid, &RobotFrame::uid);
    const int team = frame.game->teamNumbered(facts.teamNumber);
    if (robot == frame.robots.end() || team == Game::noTeam) continue;
    const GameTeam& own = frame.game->teams[static_cast<std::size_t>(team)];
    robot->penalty = penaltyOf(*frame.game, own.player(facts.number));
  }
}

MatchFrame RecordedFrames::rowFrameAt(const telemetry::SessionReader& session, double time,
                                      std::vector<RobotFrame>& boards) {
  const auto groups = session.groups();
  m_groups.resize(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) m_groups[i] = &groups[i].info;
  session.rowsAt(time + timeTolerance, m_rows);
  const auto lookBack = [&](std::size_t group, const Layout& layout, double from,
                            LampMemory& lamps) {
    const std::array<telemetry::GroupId, 1> only{static_cast<telemetry::GroupId>(group)};
    session.rows({from, time + timeTolerance}, only, [&](telemetry::GroupId, const auto& row) {
      for (std::size_t f = 0; f < telemetry::processCount; ++f) {
        if (layout.of(lampOf(f)).readOr(row, 0.0) != 0.0) lamps.saw(f, row.time);
      }
      return true;
    });
  };
  MatchFrame frame = build(time, lookBack, boards);
  if (session.count(telemetry::SessionStream::Telemetry) > 0) {
    frame.drawings = m_drawings.at(SessionHistory(session), time + timeTolerance);
    keyDrawings(frame);
  }
  return frame;
}

template <class LookBack>
MatchFrame RecordedFrames::build(double time, LookBack&& lookBack,
                                 std::vector<RobotFrame>& boards) {
  MatchFrame frame;
  frame.origin = FrameOrigin::Recorded;
  frame.serial = ++m_serial;
  frame.teams = teamsByColour();
  frame.paused = true;
  FrameSettings settings = m_given;
  frame.ballKnown = frame.truthKnown = false;
  frame.snapshot.time = time;

  // The newest row of a match says which robots were there: theirs have the same time.
  std::optional<std::size_t> match;
  for (std::size_t i = 0; i < m_groups.size(); ++i) {
    if (!m_groups[i] || !m_rows[i].present || !layoutOf(i).isMatch) continue;
    if (!match || m_rows[i].time > m_rows[*match].time) match = i;
  }
  if (match) fillMatch(*match, frame, settings);
  if (!m_settings || *m_settings != settings) {
    m_settings = std::make_shared<const FrameSettings>(std::move(settings));
  }
  frame.settings = m_settings;

  const bool jumps = time < m_lastTime || time - m_lastTime > flagMemory;
  m_lastTime = time;
  for (std::size_t i = 0; i < m_groups.size(); ++i) {
    if (!m_groups[i] || !m_rows[i].present) continue;
    const Layout& layout = layoutOf(i);
    const double rowTime = m_rows[i].time;
    if (layout.robot.value == 0) continue;
    if (match && std::abs(rowTime - m_rows[*match].time) > timeTolerance) continue;
    const auto [known, isNew] = m_lamps.try_emplace(i);
    // What a later moment had shown does not count before a process can have worked.
    if (jumps && time <= flagMemory) known->second = {};
    if (jumps) known->second.jump();
    if (jumps || isNew) lookBack(i, layout, time - flagMemory, known->second);
    RobotFrame robot = robotOf(i, time, known->second, frame);
    (layout.isBoard() ? boards : frame.robots).push_back(std::move(robot));
  }
  if (match) addGame(*match, frame);
  return frame;
}

RobotFrame RecordedFrames::robotOf(std::size_t group, double time, LampMemory& lamps,
                                   MatchFrame& frame) {
  const Layout& l = layoutOf(group);
  const telemetry::GroupInfo& info = *m_groups[group];
  const telemetry::RobotFacts& facts = factsOf(info);
  const telemetry::RowView row = m_rows[group].view();

  int number = facts.shirt > 0 ? facts.shirt : facts.number;
  if (number == 0) number = l.robot.value;
  const sim::RobotIdentity identity{l.isBoard() ? RobotId{} : l.robot, teamOf(info), number,
                                    facts.imuStartsAt180.value_or(false)};
  RobotFrame robot;
  robot.identity = identity;
  robot.key = l.isBoard() ? RobotKey{facts.place.value_or(placeByColour), identity.number, 0}
                          : frame.freeKey(keyOf(identity));
  robot.uid = uidOf(info, static_cast<telemetry::GroupId>(group));
  if (!facts.teamName.empty() && !l.isBoard()) {
    frame.teams[static_cast<std::size_t>(robot.key.team)].name = facts.teamName;
  }
  robot.name = identity.name();
  if (!l.isBoard() && info.name.starts_with(robot.name + ' ')) robot.name = info.name;
  robot.ownName = facts.name;
  robot.boardKey = facts.boardKey;
  robot.behaviour = facts.behaviour;
  robot.programs = facts.programs;
  robot.radius = facts.radius_m.value_or(robot.radius);
  if (facts.fieldOfView_deg) robot.fieldOfView = radiansFromDegrees(*facts.fieldOfView_deg);
  robot.visionRange = facts.visionRange_m.value_or(robot.visionRange);
  const bool truth = l.trueX.present() && l.trueY.present();
  if (truth) {
    const double yaw = l.trueYaw.readOr(row, 0.0);
    robot.pose = {{l.trueX.readOr(row, 0.0), l.trueY.readOr(row, 0.0)}, radiansFromDegrees(yaw)};
    robot.headYaw = radiansFromDegrees(l.headYaw.readOr(row, yaw));
    frame.truthKnown = true;
  }
  robot.velocity = {l.vx.readOr(row, 0.0), l.vy.readOr(row, 0.0)};
  robot.action = l.action.readInt(row);
  robot.fallen = l.fallen.readOr(row, 0.0) != 0.0;
  robot.statistics = {l.distance.readOr(row, 0.0), counter(l.kicks.readOr(row, 0.0)),
                      counter(l.falls.readOr(row, 0.0)), counter(l.unknownActions.readOr(row, 0.0)),
                      l.lastUnknown.readInt(row)};
  if (l.isBoard()) {
    // As Live showed it.
    const double rate = facts.rate_hz.value_or(l.attached ? AttachedBoard().rate : 0.0);
    const double timeout =
        facts.timeout_s.value_or(std::max(1.0, 2.0 / std::max(rate, AttachedBoard::slowest)));
    const double age = std::clamp(time - row.time, 0.0, maxAge);
    robot.link = boardLink(age, rate, age > timeout);
    robot.link->sender.address = l.sent;
  }
  const RobotReader reader = [&](FieldMeaning meaning) -> std::optional<double> {
    const double value = l.of(meaning).read(row);
    return std::isfinite(value) ? std::optional(meantBy(meaning, value)) : std::nullopt;
  };
  if (!robot.timedOut()) robot.lamps = lamps.note(reader, time);
  buildRobot(reader, frame.settings->field, batteryOf(info), truth, robot);
  if (l.isBoard()) {
    robot.action = robot.decided.value_or(0);
    robot.board.names = l.boardNames;
    for (const RowSlot& slot : l.board) robot.board.values.push_back(slot.read(row));
  }
  return robot;
}

}  // namespace pitchboard::link
