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

constexpr double longestAge = 1e6;  // s; beyond it no clock is right

std::uint32_t counter(double value) {
  return value >= 0.0 && value <= 4294967295.0 ? static_cast<std::uint32_t>(value) : 0U;
}

/// Returns an attribute as a number, or `value` if it is missing.
double numberOr(const telemetry::GroupInfo& info, const char* name, double value) {
  const std::string_view text = attribute(info, name);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// Returns the limits of the robot's model, or the usual ones if the recording has none.
telemetry::BatteryLimits batteryOf(const telemetry::GroupInfo& info) {
  if (attribute(info, "battery_low").empty()) return telemetry::usualBattery;
  sim::RobotModel model;
  model.batteryFull = numberOr(info, "battery_full", model.batteryFull);
  model.batteryLow = numberOr(info, "battery_low", model.batteryLow);
  model.batteryEmpty = numberOr(info, "battery_empty", model.batteryEmpty);
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

RecordedFrames::RecordedFrames(FrameSettings settings, std::vector<std::string> robots)
    : m_given(std::move(settings)), m_robots(std::move(robots)) {}
RecordedFrames::~RecordedFrames() = default;

const RecordedFrames::Layout& RecordedFrames::layoutOf(std::size_t group) {
  auto& layout = m_layouts[group];
  if (!layout || layout->columns != m_groups[group]->columns.size()) {
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
  const auto lookBack = [&](std::size_t group, const Layout& layout, double from,
                            LampMemory& lamps) {
    for (std::size_t f = 0; f < telemetry::processCount; ++f) {
      const RowSlot& slot = layout.of(lampOf(f));
      if (!slot.present()) continue;
      std::size_t column = static_cast<std::size_t>(slot.index);
      if (slot.type == telemetry::ColumnType::Float64) {
        for (const auto& info : m_groups[group]->columns) {
          column += info.type != telemetry::ColumnType::Float64 ? 1U : 0U;
        }
      }
      std::array<telemetry::SeriesBucket, 4> parts;
      const double step = (time + timeTolerance - from) / static_cast<double>(parts.size());
      m_views[group]->buckets(static_cast<std::uint32_t>(column), {from, time + timeTolerance},
                              parts);
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
    return attribute(group.info, "attached") == "1" || !attribute(group.info, "sent").empty();
  });
  MatchFrame frame;
  if (hasBoards) frame = rowFrameAt(session, time, boards);
  if (seen) {
    frame = std::move(*seen);
    frame.serial = ++m_serial;
  }
  joinBoards(frame, std::move(boards));
  return frame;
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
  const telemetry::RowView row = m_rows[group].view();

  const sim::RobotIdentity identity{
      l.isBoard() ? RobotId{} : l.robot, teamOf(info),
      attributeNumber(info, "shirt", attributeNumber(info, "number", l.robot.value)),
      attribute(info, "imu180") == "1"};
  RobotFrame robot;
  robot.identity = identity;
  robot.key = l.isBoard()
                  ? RobotKey{attributeNumber(info, "place", placeByColour), identity.number, 0}
                  : frame.freeKey(keyOf(identity));
  if (const auto team = attribute(info, "team_name"); !team.empty() && !l.isBoard()) {
    frame.teams[static_cast<std::size_t>(robot.key.team)].name = team;
  }
  robot.name = identity.name();
  robot.ownName = attribute(info, "name");
  if (!attribute(info, "key").empty()) robot.boardKey = attributeNumber(info, "key");
  robot.behaviour = attribute(info, "behaviour");
  robot.radius = numberOr(info, "radius", robot.radius);
  robot.fieldOfView =
      radiansFromDegrees(numberOr(info, "field_of_view", degreesFromRadians(robot.fieldOfView)));
  robot.visionRange = numberOr(info, "vision_range", robot.visionRange);
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
    const double rate = numberOr(info, "rate", l.attached ? AttachedBoard().rate : 0.0);
    const double timeout =
        numberOr(info, "timeout", std::max(1.0, 2.0 / std::max(rate, AttachedBoard::slowest)));
    const double age = std::clamp(time - row.time, 0.0, longestAge);
    robot.link = boardLink(age, rate, age > timeout);
    robot.link->sender.address = l.sent;
  }
  const RobotReader reader = [&](FieldMeaning meaning) -> std::optional<double> {
    // The flag of a simulated robot's control says nothing of its communication.
    if (meaning == FieldMeaning::Control && !l.isBoard()) return std::nullopt;
    const double value = l.of(meaning).read(row);
    return std::isfinite(value) ? std::optional(meantBy(meaning, value)) : std::nullopt;
  };
  if (!robot.timedOut()) robot.lamps = lamps.note(reader, time);
  const AdviceReader advice = [&](std::size_t variable) -> std::optional<double> {
    return l.advice[variable].present() ? std::optional(l.advice[variable].read(row))
                                        : std::nullopt;
  };
  buildRobot(reader, advice, frame.settings->field, batteryOf(info), truth, robot);
  if (l.isBoard()) {
    robot.action = robot.decided.value_or(0);
    robot.board.names = l.boardNames;
    for (const RowSlot& slot : l.board) robot.board.values.push_back(slot.read(row));
  }
  return robot;
}

}  // namespace pitchboard::link
