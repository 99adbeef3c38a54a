// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/calibrate/calibration_log.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include <base/angles.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/row_slot.h>
#include <robotlink/session/row_walk.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {
namespace {

constexpr double maxGap = 0.5;         // s; longer gaps are reported
constexpr double farthest = 100.0;     // m; a percept beyond it is no percept
constexpr double largestBelief = 1e6;  // cm or degrees
constexpr double lostSigma = 0.5;      // m; a team-mate that knows its place worse is no reference

/// A percept is new when its value has changed: vision writes a fresh random error every time. The
/// first value may be as old as the blackboard.
class FreshValue {
 public:
  std::optional<double> next(double value) {
    const bool fresh = m_any && std::isfinite(value) && value != m_last;
    m_any = true;
    m_last = value;
    return fresh ? std::optional<double>(value) : std::nullopt;
  }

 private:
  bool m_any = false;
  double m_last = 0.0;
};

/// Columns of what a robot believes of its place.
class BeliefColumns {
 public:
  BeliefColumns() = default;
  explicit BeliefColumns(const telemetry::GroupInfo& group)
      : m_x(findSlot(group, {"LOCALIZATION_X"})),
        m_y(findSlot(group, {"LOCALIZATION_Y"})),
        m_theta(findSlot(group, {"LOCALIZATION_THETA"})),
        m_belief(findSlot(group, {"LOCALIZATION_BELIEF"})) {}

  std::optional<CalibrationRow::Belief> read(const sim::FieldSpec& field,
                                             const telemetry::RowView& row) const {
    const double x = m_x.read(row), y = m_y.read(row), theta = m_theta.read(row);
    const double sigma_cm = m_belief.present() ? m_belief.read(row) : 20.0;
    if (!(std::abs(x) < largestBelief && std::abs(y) < largestBelief) ||
        !(std::abs(theta) < largestBelief) || !(sigma_cm > 0.0 && sigma_cm < largestBelief)) {
      return {};
    }
    return CalibrationRow::Belief{
        sim::published_frame::studioFromLocalization(field, {x, y, theta}),
        sim::published_frame::metresFromCm(sigma_cm)};
  }

 private:
  RowSlot m_x, m_y, m_theta, m_belief;
};

/// Columns of a robot that is seen, by the number of its blackboard; a percept is new when its
/// distance has changed.
class SeenRobotColumns {
 public:
  SeenRobotColumns() = default;
  SeenRobotColumns(const telemetry::GroupInfo& group, int robot) {
    char name[32];
    std::snprintf(name, sizeof name, "VISION_RBT%02d_DIST", robot);
    m_distance = findSlot(group, {name});
    std::snprintf(name, sizeof name, "VISION_RBT%02d_ANGLE", robot);
    m_bearing = findSlot(group, {name});
  }
  bool present() const { return m_distance.present() && m_bearing.present(); }

  std::optional<CalibrationRow::Seen> next(const telemetry::RowView& row) {
    if (!present()) return {};
    const auto distance = m_fresh.next(m_distance.read(row));
    const double bearing = m_bearing.read(row);
    if (!distance || !std::isfinite(bearing)) return {};
    const double metres = sim::published_frame::metresFromCm(*distance);
    if (metres <= 0.0 || metres > farthest) return {};
    // The published sign of this variable is right positive.
    return CalibrationRow::Seen{metres, wrapToPi(-radiansFromDegrees(bearing))};
  }

 private:
  RowSlot m_distance, m_bearing;
  FreshValue m_fresh;
};

/// Reads what a team-mate saw of the robot.
class MateReader {
 public:
  MateReader(const telemetry::GroupInfo& group, int robot)
      : m_belief(group), m_seen(group, robot) {}

  void read(const telemetry::GroupInfo& group, const telemetry::RowView& row, CalibrationLog& log) {
    const auto seen = m_seen.next(row);
    if (!seen) return;
    const auto belief = m_belief.read(log.field, row);
    if (!belief || belief->sigma > lostSigma) return;
    const double direction = belief->pose.yaw + seen->bearing;
    const Point& from = belief->pose.position;
    log.sightings.push_back({log.rows.size(),
                             group.name,
                             {from.x + seen->distance * std::cos(direction),
                              from.y + seen->distance * std::sin(direction)},
                             seen->distance,
                             belief->sigma});
  }

 private:
  BeliefColumns m_belief;
  SeenRobotColumns m_seen;
};

/// Reads rows of one group.
class LogReader {
 public:
  LogReader(const sim::FieldSpec& field, CalibrationLog& log) : m_field(field), m_log(log) {}

  void read(const telemetry::GroupInfo& group, const telemetry::RowView& row) {
    if (&group != m_group) useGroup(group);
    if (!std::isfinite(row.time)) return;
    if (!m_log.rows.empty() && row.time <= m_log.rows.back().time) return;
    CalibrationRow out;
    out.time = row.time;
    out.action = m_control.present() ? m_control.readInt(row) : m_decision.readInt(row);
    out.actionB = m_actionB.readInt(row);
    if (m_moving.present()) out.moving = m_moving.readInt(row) != 0;
    // Fresh memory holds zeros.
    if (const double yaw = m_imuYaw.read(row); std::isfinite(yaw) && yaw != 0.0) {
      out.imuYaw = wrapToPi(yaw);
    }
    out.fallen = m_imuState.readInt(row) != 0;
    out.looksForBall = m_look.readInt(row) == 0;
    out.searches = m_search.readInt(row) != 0;
    if (m_lost.present()) out.ballLost = m_lost.readInt(row, 1) != 0;
    readBall(row, out);
    for (std::size_t i = 0; i < m_corners.size(); ++i) {
      const auto value = m_cornerFresh[i].next(m_corners[i].read(row));
      if (value && std::abs(*value) <= 360.0) out.corners[i] = wrapToPi(radiansFromDegrees(*value));
    }
    for (std::size_t i = 0; i < m_robots.size(); ++i) {
      const auto seen = m_robots[i].next(row);
      if (seen) m_log.robots.push_back({m_log.rows.size(), static_cast<int>(i) + 1, *seen});
    }
    out.belief = m_belief.read(m_field, row);
    m_log.rows.push_back(out);
  }

 private:
  void useGroup(const telemetry::GroupInfo& group) {
    m_group = &group;
    const auto slot = [&](const char* name) {
      const RowSlot found = findSlot(group, {name});
      if (found.present() && !m_log.has(name)) m_log.variables.emplace_back(name);
      return found;
    };
    m_control = slot("CONTROL_ACTION");
    m_decision = slot("DECISION_ACTION_A");
    m_actionB = slot("DECISION_ACTION_B");
    m_moving = slot("CONTROL_MOVING");
    m_imuYaw = slot("IMU_EULER_Z");
    m_imuState = slot("IMU_STATE");
    m_look = slot("DECISION_ACTION_VISION");
    m_search = slot("DECISION_SEARCH_ON");
    m_lost = slot("VISION_LOST");
    m_ballDistance = slot("VISION_BALL_DIST");
    m_ballBearing = slot("VISION_BALL_ANGLE");
    if (!m_ballBearing.present()) m_ballBearing = slot("VISION_PAN_DEG");
    for (const char* name :
         {"LOCALIZATION_X", "LOCALIZATION_Y", "LOCALIZATION_THETA", "LOCALIZATION_BELIEF"}) {
      slot(name);
    }
    m_belief = BeliefColumns(group);
    m_corners = {slot("VISION_BLUE_LANDMARK_DEG"), slot("VISION_RED_LANDMARK_DEG"),
                 slot("VISION_YELLOW_LANDMARK_DEG"), slot("VISION_PURPLE_LANDMARK_DEG")};
    for (std::size_t i = 0; i < m_robots.size(); ++i) {
      m_robots[i] = SeenRobotColumns(group, static_cast<int>(i) + 1);
      if (m_robots[i].present() && !m_log.has("VISION_RBT")) {
        m_log.variables.emplace_back("VISION_RBT");
      }
    }
  }

  void readBall(const telemetry::RowView& row, CalibrationRow& out) {
    const auto distance = m_ballFresh.next(m_ballDistance.read(row));
    const double bearing = m_ballBearing.read(row);
    if (!distance || !std::isfinite(bearing) || out.ballLost.value_or(false)) return;
    const double metres = sim::published_frame::metresFromCm(*distance);
    if (metres <= 0.0 || metres > farthest) return;
    out.ball = CalibrationRow::Seen{metres, wrapToPi(radiansFromDegrees(bearing))};
  }

  sim::FieldSpec m_field;
  CalibrationLog& m_log;
  const telemetry::GroupInfo* m_group = nullptr;
  RowSlot m_control, m_decision, m_actionB, m_moving, m_imuYaw, m_imuState, m_look, m_search,
      m_lost, m_ballDistance, m_ballBearing;
  BeliefColumns m_belief;
  std::array<RowSlot, 4> m_corners;
  std::array<SeenRobotColumns, 22> m_robots;
  FreshValue m_ballFresh;
  std::array<FreshValue, 4> m_cornerFresh;
};

Result<CalibrationLog> checkedLog(CalibrationLog log) {
  if (log.rows.size() < 2) {
    return failure(ErrorCode::NotFound, "the recording has no rows of robot " + log.robot,
                   log.session);
  }
  if (!log.has("CONTROL_ACTION") && !log.has("DECISION_ACTION_A")) {
    return failure(ErrorCode::InvalidArgument,
                   "the recording does not say what robot " + log.robot +
                       " was told to do: record DECISION_ACTION_A or CONTROL_ACTION",
                   log.session);
  }
  std::vector<double> steps;
  std::size_t gaps = 0;
  for (std::size_t i = 1; i < log.rows.size(); ++i) {
    steps.push_back(log.rows[i].time - log.rows[i - 1].time);
    if (steps.back() > maxGap) ++gaps;
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  log.period = *middle;
  char text[128];
  if (log.period > 0.03) {
    std::snprintf(text, sizeof text,
                  "%s was recorded at %.0f Hz; times are known to one period only.",
                  log.session.c_str(), 1.0 / log.period);
    log.notes.emplace_back(text);
  } else if (gaps > 0) {
    std::snprintf(text, sizeof text,
                  "%s has %zu gaps of more than %.1f s; the fit starts again after each.",
                  log.session.c_str(), gaps, maxGap);
    log.notes.emplace_back(text);
  }
  return log;
}

template <class Rows>
Result<CalibrationLog> readLog(const Rows& rows, const sim::FieldSpec& field,
                               const std::string& name, const std::string& robot,
                               telemetry::TimeRange range) {
  CalibrationLog log;
  log.session = name;
  log.robot = robot;
  log.field = field;
  LogReader reader(field, log);
  const auto groups = rows.groupsNamed(robot);
  if (!groups) return failure(groups.error().code, groups.error().message, name);
  std::map<telemetry::GroupId, MateReader> mates;
  std::optional<TeamColor> team;
  int number = 0;  // of the robot's blackboard, once it is known
  forEachRow(
      rows, range,
      [&](telemetry::GroupId id, const telemetry::GroupInfo& group, const telemetry::RowView& row) {
        if (std::ranges::count(*groups, id) > 0) {
          reader.read(group, row);
          team = factsOf(group).team;
          number = factsOf(group).slot;
          return;
        }
        if (number <= 0 || !team || factsOf(group).team != team) return;
        mates.try_emplace(id, group, number).first->second.read(group, row, log);
      });
  std::erase_if(log.sightings,
                [&](const TeamMateSighting& seen) { return seen.row >= log.rows.size(); });
  return checkedLog(std::move(log));
}

}  // namespace

bool CalibrationLog::has(std::string_view variable) const {
  return std::ranges::find(variables, variable) != variables.end();
}

std::array<Point, 4> fieldCorners(const sim::FieldSpec& field) {
  const double x = field.halfLength(), y = field.halfWidth();
  return {{{-x, y}, {x, y}, {-x, -y}, {x, -y}}};
}

Result<CalibrationLog> readCalibrationLog(const telemetry::SessionReader& session,
                                          const std::string& name, const std::string& robot,
                                          telemetry::TimeRange range) {
  if (!session.ours()) {
    return failure(ErrorCode::InvalidArgument,
                   "this is not a recording of Pitchboard; record the robot with pitchboard-cli "
                   "record or the studio",
                   name);
  }
  auto log = readLog(session, backdropOf(session).field, name, robot, range);
  if (!log) return log;
  for (const std::string& note : session.notes()) log->notes.push_back(name + ": " + note);
  if (session.isGrowing()) {
    log->notes.push_back(name + " is still being recorded; everything so far was used.");
  } else if (!session.complete()) {
    log->notes.push_back(name + " is truncated; everything before the end was used.");
  }
  return log;
}

Result<CalibrationLog> readCalibrationLog(const telemetry::SeriesStore& rows,
                                          const sim::FieldSpec& field, const std::string& name,
                                          const std::string& robot, telemetry::TimeRange range) {
  return readLog(rows, field, name, robot, range);
}

}  // namespace pitchboard::link
