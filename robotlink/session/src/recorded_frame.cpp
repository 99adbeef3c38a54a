// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/session/recorded_frame.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <base/angles.h>
#include <robotlink/frame/belief.h>
#include <robotlink/frame/drawing_origin.h>
#include <robotlink/frame/working_flags.h>
#include <robotlink/live/attached_robots.h>
#include <robotlink/live/board_health.h>
#include <robotlink/live/live_rows.h>
#include <robotlink/scenario/scenario.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/session_choice.h>
#include <simcore/world/published_frame.h>

#include "recorded_layout.h"

namespace pitchboard::link {
namespace {

constexpr double longestAge = 1e6;  // s; beyond it no clock is right

constexpr std::array<bool RobotBoardView::*, 5> flagMembers{
    &RobotBoardView::controlWorking, &RobotBoardView::visionWorking,
    &RobotBoardView::localizationWorking, &RobotBoardView::decisionWorking,
    &RobotBoardView::imuWorking};

/// Numbers as a robot writes them: whole ones without a point.
std::string numberWord(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

/// The fields of a robot's message: what stands before the columns of its link.
std::vector<HeardValue> valuesOf(const telemetry::GroupInfo& group, const telemetry::RowView& row) {
  std::vector<HeardValue> values;
  std::size_t place = 0;
  for (const telemetry::ColumnInfo& column : group.columns) {
    if (column.type != telemetry::ColumnType::Float64) continue;
    const double value = place < row.values.size() ? row.values[place] : std::nan("");
    ++place;
    if (column.category == telemetry::linkCategory || std::isnan(value)) continue;
    values.push_back({column.name, numberWord(value), column.unit});
  }
  return values;
}

std::uint32_t counter(double value) {
  return value >= 0.0 && value <= 4294967295.0 ? static_cast<std::uint32_t>(value) : 0U;
}

}  // namespace

/// When a working flag was last seen set.
struct RecordedFrames::Flags {
  std::array<double, Layout::flagCount> seen;
};

FrameBackdrop backdropOf(const telemetry::SessionReader& session, std::vector<std::string> robots) {
  FrameBackdrop out;
  out.robots = std::move(robots);
  if (const auto field = session.info().more.find("field"); field != session.info().more.end()) {
    if (auto known = sim::fieldByName(field->second)) out.field = *known;
  }
  if (const auto text = session.attachment("scenario.json")) {
    if (const auto scenario = scenarioFromJson(*text, "scenario.json")) {
      out.field = scenario->settings.field;
      out.noise = scenario->settings.noise;
      out.physics = scenario->settings.physics;
      out.seed = scenario->settings.seed;
      out.tickRate = scenario->settings.tickRate;
    }
  }
  if (const auto text = session.attachment("profile.json")) {
    // Columns are of the values as they are shown.
    if (auto profile = telemetry::parseProfile(*text, "profile.json")) {
      out.profile = telemetry::TextDecoder(*profile).profile();
    }
  }
  return out;
}

RecordedFrames::RecordedFrames(FrameBackdrop backdrop) : m_backdrop(std::move(backdrop)) {}
RecordedFrames::~RecordedFrames() = default;

const RecordedFrames::Layout& RecordedFrames::layoutOf(std::size_t group) {
  auto& layout = m_layouts[group];
  if (!layout || layout->columns != m_groups[group]->columns.size()) {
    layout = std::make_unique<Layout>(*m_groups[group],
                                      m_backdrop.profile ? &*m_backdrop.profile : nullptr);
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
    for (std::size_t f = 0; f < Layout::flagCount; ++f) {
      const RowSlot& slot = layout.flags[f];
      if (!slot.present() || flags.seen[f] >= from) continue;
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
        flags.seen[f] = std::max(flags.seen[f], from + step * static_cast<double>(p));
      }
    }
  };
  MatchFrame frame = build(time, lookBack);
  m_views.clear();
  return frame;
}

MatchFrame RecordedFrames::frameAt(const telemetry::SessionReader& session, double time) {
  MatchFrame frame = wholeFrameAt(session, time);
  keepRobots(frame, m_backdrop.robots);
  return frame;
}

MatchFrame RecordedFrames::wholeFrameAt(const telemetry::SessionReader& session, double time) {
  if (session.count(telemetry::SessionStream::LiveState) == 0) return rowFrameAt(session, time);
  auto seen = m_live.frameAt(SessionHistory(session), time);
  if (!seen) return rowFrameAt(session, time);
  seen->serial = ++m_serial;
  // Robots that are this computer send nothing: their blackboards are rows.
  const bool hasBoards = std::ranges::any_of(
      session.groups(), [](const auto& group) { return attribute(group.info, "attached") == "1"; });
  if (hasBoards) {
    for (RobotFrame& robot : rowFrameAt(session, time).robots) {
      if (isAttached(robot.key)) seen->robots.push_back(std::move(robot));
    }
  }
  return std::move(*seen);
}

std::vector<RobotFrame> RecordedFrames::attachedAt(const telemetry::SeriesStore& rows,
                                                   double time) {
  std::vector<RobotFrame> out;
  for (RobotFrame& robot : frameAt(rows, time).robots) {
    if (isAttached(robot.key)) out.push_back(std::move(robot));
  }
  return out;
}

MatchFrame RecordedFrames::rowFrameAt(const telemetry::SessionReader& session, double time) {
  const auto groups = session.groups();
  m_groups.resize(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) m_groups[i] = &groups[i].info;
  session.rowsAt(time + timeTolerance, m_rows);
  const auto lookBack = [&](std::size_t group, const Layout& layout, double from, Flags& flags) {
    const std::array<telemetry::GroupId, 1> only{static_cast<telemetry::GroupId>(group)};
    session.rows({from, time + timeTolerance}, only, [&](telemetry::GroupId, const auto& row) {
      for (std::size_t f = 0; f < Layout::flagCount; ++f) {
        if (layout.flags[f].readOr(row, 0.0) != 0.0) flags.seen[f] = row.time;
      }
      return true;
    });
  };
  MatchFrame frame = build(time, lookBack);
  if (session.count(telemetry::SessionStream::Telemetry) > 0) {
    frame.drawings = m_drawings.at(SessionHistory(session), time + timeTolerance);
    keyDrawings(frame);
  }
  return frame;
}

template <class LookBack>
MatchFrame RecordedFrames::build(double time, LookBack&& lookBack) {
  MatchFrame frame;
  frame.origin = FrameOrigin::Recorded;
  frame.serial = ++m_serial;
  frame.teams = teamsByColour();
  frame.paused = true;
  frame.field = m_backdrop.field;
  frame.noise = m_backdrop.noise;
  frame.physics = m_backdrop.physics;
  frame.seed = m_backdrop.seed;
  frame.tickRate = m_backdrop.tickRate;
  frame.ballKnown = frame.truthKnown = false;
  frame.snapshot.time = time;

  // The newest row of a match says which robots were there: theirs have the same time.
  std::optional<std::size_t> match;
  for (std::size_t i = 0; i < m_groups.size(); ++i) {
    if (!m_groups[i] || !m_rows[i].present || !layoutOf(i).isMatch) continue;
    if (!match || m_rows[i].time > m_rows[*match].time) match = i;
  }
  if (match) fillMatch(*match, frame);

  if (time < m_lastTime || time - m_lastTime > flagMemory) m_flags.clear();
  m_lastTime = time;
  for (std::size_t i = 0; i < m_groups.size(); ++i) {
    if (!m_groups[i] || !m_rows[i].present) continue;
    const Layout& layout = layoutOf(i);
    const double rowTime = m_rows[i].time;
    if (layout.robot.value == 0) continue;
    if (match && !layout.live && std::abs(rowTime - m_rows[*match].time) > timeTolerance) continue;
    const auto [known, isNew] = m_flags.try_emplace(i);
    if (isNew) {
      known->second.seen.fill(-std::numeric_limits<double>::infinity());
      lookBack(i, layout, time - flagMemory, known->second);
    }
    addRobot(i, time, known->second, frame);
  }
  if (match) addGame(*match, frame);
  for (std::size_t a = 0; a < frame.robots.size(); ++a) {
    for (std::size_t b = a + 1; b < frame.robots.size(); ++b) {
      RobotFrame &one = frame.robots[a], &other = frame.robots[b];
      if (one.health && other.health && one.key.number == other.key.number) {
        noteConflict(*one.health, *other.health);
      }
    }
  }
  return frame;
}

void RecordedFrames::addRobot(std::size_t group, double time, Flags& flags, MatchFrame& frame) {
  const Layout& l = layoutOf(group);
  const telemetry::GroupInfo& info = *m_groups[group];
  const telemetry::RowView row = m_rows[group].view();

  const sim::RobotIdentity identity{
      l.live || l.attached ? RobotId{} : l.robot, teamOf(info),
      attributeNumber(info, "shirt", attributeNumber(info, "number", l.robot.value)),
      attribute(info, "imu180") == "1"};
  const RobotKey key =
      frame.freeKey(l.attached ? RobotKey{0, l.robot.value, attachedSender}
                    : l.live   ? keyOfOldId(l.robot.value, !attribute(info, "shirt").empty())
                               : keyOf(identity));
  RobotFrame& robot = frame.robots.emplace_back();
  robot.identity = identity;
  robot.key = key;
  robot.name = identity.name();
  robot.ownName = attribute(info, "name");
  RobotBoardView& board = robot.board.emplace();
  board.key = attributeNumber(info, "key");
  board.behaviour = attribute(info, "behaviour");
  board.actionA = l.actionA.readInt(row);
  board.voltage = l.voltage.readInt(row);
  board.ballDistCm = static_cast<float>(l.ballDist.readOr(row, -1.0));
  board.visionLost = l.lost.present() ? l.lost.readOr(row, 0.0) != 0.0 : !(board.ballDistCm > 0.0F);
  board.panDeg = static_cast<float>(l.pan.readOr(row, 0.0));
  board.localizationX = l.locX.readInt(row);
  board.localizationY = l.locY.readInt(row);
  board.localizationTheta = l.locTheta.readInt(row);
  board.belief = static_cast<float>(l.belief.readOr(row, 0.0));
  for (std::size_t f = 0; f < Layout::flagCount; ++f) {
    const bool set = l.flags[f].readOr(row, 0.0) != 0.0;
    if (set) flags.seen[f] = std::max(flags.seen[f], row.time);
    // A message that says "working" holds until the next one comes.
    board.*flagMembers[f] = flags.seen[f] >= time - flagMemory || (l.live && set);
  }

  if (l.trueX.present() && l.trueY.present()) {
    const double yaw = l.trueYaw.readOr(row, 0.0);
    robot.pose = {{l.trueX.readOr(row, 0.0), l.trueY.readOr(row, 0.0)}, radiansFromDegrees(yaw)};
    robot.headYaw = radiansFromDegrees(l.headYaw.readOr(row, yaw));
    frame.truthKnown = true;
  } else {
    robot.pose = sim::published_frame::studioFromLocalization(
        frame.field,
        {l.locX.readOr(row, 0.0), l.locY.readOr(row, 0.0), l.locTheta.readOr(row, 0.0)});
    robot.headYaw = robot.pose.yaw;
  }
  robot.velocity = {l.vx.readOr(row, 0.0), l.vy.readOr(row, 0.0)};
  robot.action = l.action.readInt(row);
  robot.fallen = l.fallen.readOr(row, 0.0) != 0.0;
  robot.statistics = {l.distance.readOr(row, 0.0), counter(l.kicks.readOr(row, 0.0)),
                      counter(l.falls.readOr(row, 0.0)), counter(l.unknownActions.readOr(row, 0.0)),
                      l.lastUnknown.readInt(row)};
  if (l.live) addHealth(group, time, frame.field, robot);
  if (l.attached) addBoardHealth(group, time, frame.field, robot);
}

/// As Live showed a robot that was its own computer.
void RecordedFrames::addBoardHealth(std::size_t group, double time, const sim::FieldSpec& field,
                                    RobotFrame& robot) {
  const Layout& l = layoutOf(group);
  const telemetry::RowView row = m_rows[group].view();
  const std::string_view rate = attribute(*m_groups[group], "rate");
  BoardHeard heard;
  heard.rate = AttachedBoard().rate;  // sessions of 0.3 do not say it
  std::from_chars(rate.data(), rate.data() + rate.size(), heard.rate);
  heard.age = std::clamp(time - row.time, 0.0, longestAge);
  heard.gone = heard.age > std::max(1.0, 2.0 / std::max(heard.rate, AttachedBoard::slowest));
  heard.poseKnown = l.locX.present() && l.locY.present();
  heard.pose = {l.locX.readOr(row, 0.0), l.locY.readOr(row, 0.0), l.locTheta.readOr(row, 0.0)};
  for (std::size_t f = 0; f < Layout::flagCount; ++f) {
    heard.hasFlag[f] = l.flags[f].present();
    if (heard.gone) (*robot.board).*flagMembers[f] = false;
  }
  fillBoardHealth(field, heard, robot);
}

/// Where a live robot's health stands at this moment.
std::optional<std::size_t> RecordedFrames::linkGroupOf(const telemetry::GroupInfo& robot) const {
  for (std::size_t i = 0; i < m_groups.size(); ++i) {
    if (m_groups[i] && m_rows[i].present && attribute(*m_groups[i], "link") == robot.name) return i;
  }
  return std::nullopt;
}

void RecordedFrames::addHealth(std::size_t group, double time, const sim::FieldSpec& field,
                               RobotFrame& robot) {
  const Layout& l = layoutOf(group);
  const telemetry::RowView row = m_rows[group].view();
  RobotHealth& health = robot.health.emplace();
  if (const auto address = telemetry::parseAddress(attribute(*m_groups[group], "sender"))) {
    health.sender.address = *address;
  }
  health.poseKnown = std::isfinite(l.locX.read(row)) && std::isfinite(l.locY.read(row));
  // Before 0.3 a message's row held its link's health as well, and its age was in it.
  const std::optional<std::size_t> linkGroup = linkGroupOf(*m_groups[group]);
  const Layout& link = linkGroup ? layoutOf(*linkGroup) : l;
  const telemetry::RowView linkRow = linkGroup ? m_rows[*linkGroup].view() : row;
  const double older = linkGroup ? 0.0 : l.age.readOr(row, 0.0);
  const double age = std::clamp(time - row.time + older, 0.0, longestAge);
  health.age = std::chrono::duration_cast<telemetry::Duration>(std::chrono::duration<double>(age));
  health.timedOut = health.age >= telemetry::MonitorOptions{}.timeout;
  health.rate = link.rate.readOr(linkRow, 0.0);
  health.jitter = link.jitter.readOr(linkRow, 0.0) / 1000.0;
  if (std::isfinite(link.loss.read(linkRow))) health.loss = link.loss.read(linkRow);
  health.lost = counter(link.lostMessages.readOr(linkRow, 0.0));
  health.duplicates = counter(link.duplicates.readOr(linkRow, 0.0));
  health.late = counter(link.late.readOr(linkRow, 0.0));
  health.errorCount = counter(link.errors.readOr(linkRow, 0.0));
  if (const double volts = link.volts.read(linkRow); std::isfinite(volts)) {
    health.battery = telemetry::batteryAt(volts, telemetry::usualBattery);
  }
  for (std::size_t f = 0; f < Layout::flagCount; ++f) {
    if (health.timedOut || !std::isfinite(l.flags[f].read(row))) continue;
    health.processes[f].state = l.flags[f].read(row) != 0.0 ? telemetry::ProcessState::Working
                                                            : telemetry::ProcessState::Silent;
  }
  if (std::isfinite(l.actionA.read(row))) health.action = robot.board->actionA;
  if (health.poseKnown) {
    health.ball =
        ballSeenFrom(robot.pose, l.ballDist.readOr(row, 0.0), l.pan.readOr(row, 0.0), field);
  }
  health.values = valuesOf(*m_groups[group], row);
}

}  // namespace pitchboard::link
