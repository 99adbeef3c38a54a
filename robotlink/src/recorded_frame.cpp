// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/recorded_frame.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <base/angles.h>
#include <robotlink/scenario.h>
#include <simcore/published_frame.h>

#include "row_slot.h"

namespace pitchboard::link {
namespace {

constexpr double flagMemory = 1.0;        // s, as in the frames of a running match
constexpr double timeTolerance = 1e-6;    // s; files keep whole nanoseconds
constexpr std::size_t flagCount = 5;

constexpr std::array<bool RobotBoardView::*, flagCount> flagMembers{
    &RobotBoardView::controlWorking, &RobotBoardView::visionWorking,
    &RobotBoardView::localizationWorking, &RobotBoardView::decisionWorking,
    &RobotBoardView::imuWorking};

TeamColor teamOf(const telemetry::GroupInfo& group) {
  const std::string_view name = attribute(group, "team");
  for (const TeamColorInfo& team : teamColors) {
    if (team.name == name) return team.color;
  }
  return TeamColor::Blue;
}

std::uint32_t counter(double value) {
  return value >= 0.0 && value <= 4294967295.0 ? static_cast<std::uint32_t>(value) : 0U;
}

}  // namespace

/// Where one group keeps what frames need.
struct RecordedFrames::Layout {
  explicit Layout(const telemetry::GroupInfo& group)
      : columns(group.columns.size()),
        robot{attributeNumber(group, "robot")},
        isMatch(robot.value == 0 && findSlot(group, {"BALL_X"}).present()) {
    if (isMatch) {
      tick = findSlot(group, {"TICK"});
      ballX = findSlot(group, {"BALL_X"});
      ballY = findSlot(group, {"BALL_Y"});
      ballVx = findSlot(group, {"BALL_VX"});
      ballVy = findSlot(group, {"BALL_VY"});
      clock = findSlot(group, {"CLOCK"});
      clockRunning = findSlot(group, {"CLOCK_RUNNING"});
      scoreLeft = findSlot(group, {"SCORE_LEFT"});
      scoreRight = findSlot(group, {"SCORE_RIGHT"});
      tickTime = findSlot(group, {"TICK_TIME"});
      return;
    }
    trueX = findSlot(group, {"TRUE_X"});
    trueY = findSlot(group, {"TRUE_Y"});
    trueYaw = findSlot(group, {"TRUE_YAW"});
    headYaw = findSlot(group, {"HEAD_YAW"});
    vx = findSlot(group, {"VX"});
    vy = findSlot(group, {"VY"});
    action = findSlot(group, {"ACTION", "CONTROL_ACTION", "ACTION_A", "DECISION_ACTION_A"});
    fallen = findSlot(group, {"FALLEN", "IMU_STATE"});
    distance = findSlot(group, {"DISTANCE_WALKED"});
    kicks = findSlot(group, {"KICKS"});
    falls = findSlot(group, {"FALLS"});
    unknownActions = findSlot(group, {"UNKNOWN_ACTIONS"});
    lastUnknown = findSlot(group, {"LAST_UNKNOWN_ACTION"});
    actionA = findSlot(group, {"DECISION_ACTION_A", "ACTION_A"});
    voltage = findSlot(group, {"VOLTAGE"});
    lost = findSlot(group, {"VISION_LOST"});
    ballDist = findSlot(group, {"VISION_BALL_DIST", "BALL_DIST"});
    pan = findSlot(group, {"VISION_PAN_DEG", "BALL_ANGLE"});
    locX = findSlot(group, {"LOCALIZATION_X", "X"});
    locY = findSlot(group, {"LOCALIZATION_Y", "Y"});
    locTheta = findSlot(group, {"LOCALIZATION_THETA", "THETA"});
    // The published localization publishes its belief under this name (SYSTEM.md section 5).
    belief = findSlot(group, {"LOCALIZATION_RBT01_X", "BELIEF"});
    flags = {findSlot(group, {"CONTROL_WORKING", "CONTROL"}),
             findSlot(group, {"VISION_WORKING", "VISION"}),
             findSlot(group, {"LOCALIZATION_WORKING", "LOCALIZATION"}),
             findSlot(group, {"DECISION_WORKING", "DECISION"}),
             findSlot(group, {"IMU_WORKING", "IMU"})};
  }

  std::size_t columns;
  RobotId robot;
  bool isMatch;
  RowSlot tick, ballX, ballY, ballVx, ballVy, clock, clockRunning, scoreLeft, scoreRight, tickTime;
  RowSlot trueX, trueY, trueYaw, headYaw, vx, vy, action, fallen, distance, kicks, falls,
      unknownActions, lastUnknown;
  RowSlot actionA, voltage, lost, ballDist, pan, locX, locY, locTheta, belief;
  std::array<RowSlot, flagCount> flags;
};

/// When a working flag was last seen set.
struct RecordedFrames::Flags {
  std::array<double, flagCount> seen;
};

FrameBackdrop backdropOf(const telemetry::SessionReader& session) {
  FrameBackdrop out;
  if (const auto text = session.attachment("scenario.json")) {
    if (const auto scenario = scenarioFromJson(*text, "scenario.json")) {
      out.field = scenario->settings.field;
      out.noise = scenario->settings.noise;
      out.physics = scenario->settings.physics;
      out.seed = scenario->settings.seed;
      out.tickRate = scenario->settings.tickRate;
    }
  }
  return out;
}

RecordedFrames::RecordedFrames(FrameBackdrop backdrop) : m_backdrop(std::move(backdrop)) {}
RecordedFrames::~RecordedFrames() = default;

const RecordedFrames::Layout& RecordedFrames::layoutOf(std::size_t group) {
  auto& layout = m_layouts[group];
  if (!layout || layout->columns != m_groups[group]->columns.size()) {
    layout = std::make_unique<Layout>(*m_groups[group]);
  }
  return *layout;
}

MatchFrame RecordedFrames::frameAt(const telemetry::SeriesStore& rows, double time) {
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
  const auto lookBack = [&](std::size_t group, const Layout& layout, double from, Flags& flags) {
    for (std::size_t f = 0; f < flagCount; ++f) {
      const RowSlot& slot = layout.flags[f];
      if (!slot.present() || flags.seen[f] >= from) continue;
      std::size_t column = static_cast<std::size_t>(slot.place);
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
        flags.seen[f] = std::max(flags.seen[f], from + step * static_cast<double>(p));
      }
    }
  };
  MatchFrame frame = build(time, lookBack);
  m_views.clear();
  return frame;
}

MatchFrame RecordedFrames::frameAt(const telemetry::SessionReader& session, double time) {
  const auto groups = session.groups();
  m_groups.resize(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) m_groups[i] = &groups[i].info;
  session.rowsAt(time + timeTolerance, m_rows);
  const auto lookBack = [&](std::size_t group, const Layout& layout, double from, Flags& flags) {
    const std::array<telemetry::GroupId, 1> only{static_cast<telemetry::GroupId>(group)};
    session.rows({from, time + timeTolerance}, only, [&](telemetry::GroupId, const auto& row) {
      for (std::size_t f = 0; f < flagCount; ++f) {
        if (layout.flags[f].readOr(row, 0.0) != 0.0) flags.seen[f] = row.time;
      }
      return true;
    });
  };
  return build(time, lookBack);
}

template <class LookBack>
MatchFrame RecordedFrames::build(double time, LookBack&& lookBack) {
  MatchFrame frame;
  frame.origin = FrameOrigin::Recorded;
  frame.serial = ++m_serial;
  frame.paused = true;
  frame.field = m_backdrop.field;
  frame.noise = m_backdrop.noise;
  frame.physics = m_backdrop.physics;
  frame.seed = m_backdrop.seed;
  frame.tickRate = m_backdrop.tickRate;
  frame.ballKnown = false;
  frame.snapshot.time = time;

  // The newest row of a match says which robots were there: theirs have the same time.
  std::optional<std::size_t> match;
  for (std::size_t i = 0; i < m_groups.size(); ++i) {
    if (!m_groups[i] || !m_rows[i].present || !layoutOf(i).isMatch) continue;
    if (!match || m_rows[i].time > m_rows[*match].time) match = i;
  }
  if (match) {
    const Layout& l = layoutOf(*match);
    const telemetry::RowView row = m_rows[*match].view();
    const telemetry::GroupInfo& group = *m_groups[*match];
    sim::Snapshot& s = frame.snapshot;
    s.time = row.time;
    s.ball = {l.ballX.readOr(row, 0.0), l.ballY.readOr(row, 0.0)};
    frame.ballKnown = std::isfinite(l.ballX.read(row)) && std::isfinite(l.ballY.read(row));
    s.ballVelocity = {l.ballVx.readOr(row, 0.0), l.ballVy.readOr(row, 0.0)};
    s.clock = l.clock.readOr(row, 0.0);
    s.clockRunning = l.clockRunning.readOr(row, 0.0) != 0.0;
    s.score = {l.scoreLeft.readInt(row), l.scoreRight.readInt(row)};
    s.tick = static_cast<std::uint64_t>(std::clamp(l.tick.readOr(row, 0.0), 0.0, 9e15));
    frame.tickMicroseconds = l.tickTime.readOr(row, 0.0);
    if (const auto physics = attribute(group, "physics"); !physics.empty()) frame.physics = physics;
    if (const std::string seed(attribute(group, "seed")); !seed.empty()) {
      frame.seed = std::strtoull(seed.c_str(), nullptr, 10);
    }
    const std::string rate(attribute(group, "tick_rate"));
    const double ticks = std::strtod(rate.c_str(), nullptr);
    if (ticks >= 1.0 && ticks <= 10000.0) frame.tickRate = ticks;
  }

  const bool jumped = time < m_lastTime || time - m_lastTime > flagMemory;
  if (jumped) m_flags.clear();
  const double memoryFrom = time - flagMemory;
  frame.truthKnown = false;
  for (std::size_t i = 0; i < m_groups.size(); ++i) {
    if (!m_groups[i] || !m_rows[i].present) continue;
    const Layout& l = layoutOf(i);
    if (l.robot.value == 0) continue;
    const telemetry::RowView row = m_rows[i].view();
    const bool hasTruth = l.trueX.present() && l.trueY.present();
    if (match && hasTruth && std::abs(row.time - m_rows[*match].time) > timeTolerance) continue;
    const telemetry::GroupInfo& group = *m_groups[i];

    RobotBoardView board;
    board.id = l.robot;
    board.key = attributeNumber(group, "key");
    board.behaviour = attribute(group, "behaviour");
    board.actionA = l.actionA.readInt(row);
    board.voltage = l.voltage.readInt(row);
    board.ballDistCm = static_cast<float>(l.ballDist.readOr(row, -1.0));
    board.visionLost = l.lost.present() ? l.lost.readOr(row, 0.0) != 0.0 : !(board.ballDistCm > 0);
    board.panDeg = static_cast<float>(l.pan.readOr(row, 0.0));
    board.localizationX = l.locX.readInt(row);
    board.localizationY = l.locY.readInt(row);
    board.localizationTheta = l.locTheta.readInt(row);
    board.belief = static_cast<float>(l.belief.readOr(row, 0.0));

    const auto [known, isNew] = m_flags.try_emplace(i);
    Flags& flags = known->second;
    if (isNew) flags.seen.fill(-1e300);
    bool unsure = false;
    for (std::size_t f = 0; f < flagCount; ++f) {
      if (l.flags[f].readOr(row, 0.0) != 0.0) flags.seen[f] = std::max(flags.seen[f], row.time);
      unsure = unsure || (l.flags[f].present() && flags.seen[f] < memoryFrom);
    }
    if (isNew && unsure) lookBack(i, l, memoryFrom, flags);
    for (std::size_t f = 0; f < flagCount; ++f) {
      // A message that says "working" holds until the next one comes.
      const bool holds = !hasTruth && l.flags[f].readOr(row, 0.0) != 0.0;
      board.*flagMembers[f] = flags.seen[f] >= memoryFrom || holds;
    }

    sim::RobotSnapshot robot;
    robot.identity = {l.robot, teamOf(group), attributeNumber(group, "number", l.robot.value),
                      attribute(group, "imu180") == "1"};
    const Pose believed = sim::published_frame::studioFromLocalization(
        frame.field, {l.locX.readOr(row, 0.0), l.locY.readOr(row, 0.0), l.locTheta.readOr(row, 0.0)});
    if (hasTruth) {
      robot.pose = {{l.trueX.readOr(row, 0.0), l.trueY.readOr(row, 0.0)},
                    radiansFromDegrees(l.trueYaw.readOr(row, 0.0))};
      robot.headYaw = radiansFromDegrees(l.headYaw.readOr(row, l.trueYaw.readOr(row, 0.0)));
      frame.truthKnown = true;
    } else {
      robot.pose = believed;
      robot.headYaw = believed.yaw;
    }
    robot.velocity = {l.vx.readOr(row, 0.0), l.vy.readOr(row, 0.0)};
    robot.action = l.action.readInt(row);
    robot.fallen = l.fallen.readOr(row, 0.0) != 0.0;
    robot.statistics.distanceWalked = l.distance.readOr(row, 0.0);
    robot.statistics.kicks = counter(l.kicks.readOr(row, 0.0));
    robot.statistics.falls = counter(l.falls.readOr(row, 0.0));
    robot.statistics.unknownActions = counter(l.unknownActions.readOr(row, 0.0));
    robot.statistics.lastUnknownAction = l.lastUnknown.readInt(row);
    frame.snapshot.robots.push_back(std::move(robot));
    frame.boards.push_back(std::move(board));
  }
  m_lastTime = time;
  return frame;
}

}  // namespace pitchboard::link
