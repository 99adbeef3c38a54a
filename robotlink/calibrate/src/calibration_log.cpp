// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/calibrate/calibration_log.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <base/angles.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/row_slot.h>
#include <robotlink/session/row_walk.h>
#include <simcore/world/published_frame.h>

namespace pitchboard::link {
namespace {

constexpr double longestGap = 0.5;     // s; longer ones are told
constexpr double farthest = 100.0;     // m; a percept beyond it is no percept
constexpr double largestBelief = 1e6;  // cm or degrees

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
    readRobots(row);
    readBelief(row, out);
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
    m_x = slot("LOCALIZATION_X");
    m_y = slot("LOCALIZATION_Y");
    m_theta = slot("LOCALIZATION_THETA");
    m_belief = slot("LOCALIZATION_BELIEF");
    m_corners = {slot("VISION_BLUE_LANDMARK_DEG"), slot("VISION_RED_LANDMARK_DEG"),
                 slot("VISION_YELLOW_LANDMARK_DEG"), slot("VISION_PURPLE_LANDMARK_DEG")};
    for (std::size_t i = 0; i < m_robotDistance.size(); ++i) {
      char name[32];
      std::snprintf(name, sizeof name, "VISION_RBT%02zu_DIST", i + 1);
      m_robotDistance[i] = findSlot(group, {name});
      std::snprintf(name, sizeof name, "VISION_RBT%02zu_ANGLE", i + 1);
      m_robotBearing[i] = findSlot(group, {name});
      if (m_robotDistance[i].present() && !m_log.has("VISION_RBT")) {
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

  void readRobots(const telemetry::RowView& row) {
    for (std::size_t i = 0; i < m_robotDistance.size(); ++i) {
      if (!m_robotDistance[i].present() || !m_robotBearing[i].present()) continue;
      const auto distance = m_robotFresh[i].next(m_robotDistance[i].read(row));
      const double bearing = m_robotBearing[i].read(row);
      if (!distance || !std::isfinite(bearing)) continue;
      const double metres = sim::published_frame::metresFromCm(*distance);
      if (metres <= 0.0 || metres > farthest) continue;
      // The published sign of this variable is right positive.
      m_log.robots.push_back({m_log.rows.size(),
                              static_cast<int>(i) + 1,
                              {metres, wrapToPi(-radiansFromDegrees(bearing))}});
    }
  }

  void readBelief(const telemetry::RowView& row, CalibrationRow& out) const {
    const double x = m_x.read(row), y = m_y.read(row), theta = m_theta.read(row);
    const double sigma_cm = m_belief.present() ? m_belief.read(row) : 20.0;
    if (!(std::abs(x) < largestBelief && std::abs(y) < largestBelief) ||
        !(std::abs(theta) < largestBelief) || !(sigma_cm > 0.0 && sigma_cm < largestBelief)) {
      return;
    }
    out.belief =
        CalibrationRow::Belief{sim::published_frame::studioFromLocalization(m_field, {x, y, theta}),
                               sim::published_frame::metresFromCm(sigma_cm)};
  }

  sim::FieldSpec m_field;
  CalibrationLog& m_log;
  const telemetry::GroupInfo* m_group = nullptr;
  RowSlot m_control, m_decision, m_actionB, m_moving, m_imuYaw, m_imuState, m_look, m_search,
      m_lost, m_ballDistance, m_ballBearing, m_x, m_y, m_theta, m_belief;
  std::array<RowSlot, 4> m_corners;
  std::array<RowSlot, 22> m_robotDistance, m_robotBearing;
  FreshValue m_ballFresh;
  std::array<FreshValue, 4> m_cornerFresh;
  std::array<FreshValue, 22> m_robotFresh;
};

Result<CalibrationLog> checkedLog(CalibrationLog log, const std::vector<std::string>& present) {
  if (log.rows.size() < 2) {
    std::string names;
    for (const std::string& name : present) names += (names.empty() ? "" : ", ") + name;
    return failure(ErrorCode::NotFound,
                   "there are no rows of robot " + log.robot +
                       (names.empty() ? std::string("; the recording has no robots")
                                      : "; the recording has " + names),
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
    if (steps.back() > longestGap) ++gaps;
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
    std::snprintf(text, sizeof text, "%s has %zu gaps of more than %.1f s; each one starts anew.",
                  log.session.c_str(), gaps, longestGap);
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
  std::vector<std::string> present;
  forEachRow(
      rows, range,
      [&](telemetry::GroupId, const telemetry::GroupInfo& group, const telemetry::RowView& row) {
        if (group.name == robot) {
          reader.read(group, row);
        } else if (attribute(group, "team") != "" &&
                   std::ranges::find(present, group.name) == present.end()) {
          present.push_back(group.name);
        }
      });
  return checkedLog(std::move(log), present);
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
  if (!session.complete()) {
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
