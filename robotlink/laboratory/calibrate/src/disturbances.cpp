// SPDX-License-Identifier: GPL-3.0-or-later
// When a robot may be held or moved by something, and when a ball that should lie still is moved.
#include <algorithm>
#include <cmath>

#include "jump_test.h"
#include "motion_filter.h"

namespace pitchboard::link {
namespace {

constexpr double ballPush = 0.55;       // m; a ball that is nearer may slow the robot down
constexpr double robotPush = 0.6;       // m, between the centres
constexpr double obstaclePush = 0.2;    // m, between its edge and a post, net or wall
constexpr double pushTime = 1.0;        // s before and after
constexpr double doubtfulGait = 0.005;  // m per 1/60 s, noise of a gait that may be obstructed
constexpr double pushRest = 2.0;        // s after it until its place is known again
constexpr double surelyMoved = 20.0;    // of JumpEvidence, by chance once in 20 000 looks
constexpr double jumpsApart = 2.0;      // s; of the evidence of one jump only the strongest counts
constexpr int maxJumpRounds = 4;

/// Whether a robot, of whose place (m, centred) `unsure` is not known, may be at a wall, or at a
/// post or net of a goal.
bool isAtObstacle(const sim::FieldSpec& field, double radius, const Point& place, double unsure) {
  const double reach = radius + obstaclePush + std::min(unsure, 0.5);
  // The field is symmetric about both axes.
  const double x = std::abs(place.x), y = std::abs(place.y);
  const double line = field.halfLength(), back = line + field.goalDepth;
  const double post = field.goalWidth / 2.0;
  if (x > line + field.border - reach || y > field.halfWidth() + field.border - reach) return true;
  const double sideNet = std::hypot(x - std::clamp(x, line, back), y - post);
  const double backNet = std::hypot(x - back, y - std::min(y, post));
  return std::min(sideNet, backNet) < reach + field.goalPostRadius;
}

}  // namespace

void MotionFilter::findDisturbed(const sim::RobotModel& known, double delay) {
  const auto& rows = m_log.rows;
  // A robot that stands pushes nothing.
  const auto walks = [&](std::size_t row) {
    const ExecutedAction& action = m_actions[row];
    return action.kicks || sim::gaitSpeed(known, action.code, action.b).inMotion;
  };
  std::vector<bool> near(rows.size());
  for (const std::uint32_t row : m_percepts) {
    if (!rows[row].ball || !walks(row)) continue;
    const double ball = rows[row].ball->distance;
    if (groundDistance(known, ball, m_log.field.ballRadius) < ballPush) near[row] = true;
  }
  for (const SeenRobotPercept& seen : m_log.robots) {
    if (seen.row >= rows.size()) continue;
    if (groundDistance(known, seen.seen.distance, 0.0) < robotPush) near[seen.row] = true;
  }
  // Where it is tells a run that trusts its senses more than its gait.
  sim::RobotModel model = known;
  model.noise.forward = model.noise.sideways = doubtfulGait;
  m_disturbed.assign(rows.size(), false);
  m_pushed.assign(rows.size(), false);
  m_ballMoves.assign(rows.size(), false);
  m_counted.assign(rows.size(), false);
  FilterDecisions decisions;
  std::vector<Innovation> unused;
  std::vector<MotionState> states;
  run(model, delay, decisions, unused, &states);
  const double radius = known.radius > 0.0 ? known.radius : m_log.field.robotRadius;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const MotionState& state = states[i];
    if (!state.known || !state.placed) continue;
    const double unsure = std::sqrt(state.covariance(MotionState::X, MotionState::X) +
                                    state.covariance(MotionState::Y, MotionState::Y));
    const Point place{state.mean[MotionState::X], state.mean[MotionState::Y]};
    if (walks(i) && isAtObstacle(m_log.field, radius, place, unsure)) near[i] = true;
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (!near[row]) continue;
    const double time = rows[row].time;
    for (std::size_t i = row; i-- > 0 && rows[i].time > time - pushTime && !m_disturbed[i];) {
      m_disturbed[i] = true;
    }
    m_disturbed[row] = true;
    for (std::size_t i = row + 1; i < rows.size() && rows[i].time < time + pushTime && !near[i];
         ++i) {
      m_disturbed[i] = true;
    }
  }
  findCounted();
}

void MotionFilter::findCounted() {
  double last = -1e9;
  for (std::size_t i = 0; i < m_log.rows.size(); ++i) {
    if (m_disturbed[i]) last = m_log.rows[i].time;
    m_counted[i] = m_log.rows[i].time - last > pushRest;
  }
}

/// Marks the rows within `before` and `after` seconds of a row.
static void markAround(const std::vector<CalibrationRow>& rows, std::size_t row, double before,
                       double after, std::vector<bool>& out) {
  const double time = rows[row].time;
  for (std::size_t i = row; i < rows.size() && rows[i].time <= time + after; ++i) out[i] = true;
  for (std::size_t i = row; i-- > 0 && rows[i].time >= time - before;) out[i] = true;
}

void MotionFilter::findJumps(const sim::RobotModel& known, double delay) {
  FilterDecisions decisions;
  std::vector<Innovation> unused;
  for (int round = 0; round < maxJumpRounds; ++round) {
    JumpTest test;
    decisions.recorded = false;
    run(known, delay, decisions, unused, nullptr, &test);
    test.forget();
    const auto& all = test.found();
    const auto strength = [](const JumpEvidence& one) { return std::max(one.robot, one.ball); };
    bool isNew = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double time = m_log.rows[all[i].row].time;
      bool strongest = strength(all[i]) > surelyMoved;
      for (std::size_t k = i;
           strongest && k-- > 0 && time - m_log.rows[all[k].row].time < jumpsApart;) {
        strongest = strength(all[k]) <= strength(all[i]);
      }
      for (std::size_t k = i + 1;
           strongest && k < all.size() && m_log.rows[all[k].row].time - time < jumpsApart; ++k) {
        strongest = strength(all[k]) < strength(all[i]);
      }
      if (!strongest) continue;
      isNew = true;
      if (all[i].ball > all[i].robot) {
        markAround(m_log.rows, all[i].row, pushTime, ballRest, m_ballMoves);
      } else {
        markAround(m_log.rows, all[i].row, pushTime, pushTime, m_disturbed);
        markAround(m_log.rows, all[i].row, pushTime, pushTime, m_pushed);
      }
    }
    if (!isNew) break;
  }
  findCounted();
}

}  // namespace pitchboard::link
