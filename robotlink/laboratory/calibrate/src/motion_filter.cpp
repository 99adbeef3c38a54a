// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <base/angles.h>

#include "gait_step.h"
#include "jump_test.h"
#include "motion_parameters.h"

namespace pitchboard::link {
namespace {

using State = MotionState;

constexpr double frame = 1.0 / 60.0;      // s, in which noise is given
constexpr double maxPause = 0.5;          // s without rows; then the filter starts again
constexpr double maxDelay = 0.52;         // s
constexpr double gateSigmas = 6.0;        // of an outlier
constexpr int maxOutliers = 8;            // hardly anything else between; then something was moved
constexpr double ballTouch = 0.45;        // m; a robot that is nearer may push it
constexpr double pushNoise = 0.03;        // m per 1/60 s, of a robot that may push something
constexpr double kickRest = 20.0;         // s after a kick until the ball is at rest
constexpr double startRest = 5.0;         // s after a start until its measurements count
constexpr double startInterval = 2.0;     // s between two looks for where it is
constexpr double maxBelievedSigma = 0.7;  // m, of a place to begin from
constexpr double beliefInterval = 2.0;    // s; errors of a belief closer together are the same
constexpr double believedYawSpread = 0.06;  // rad

/// s without rows after which the filter starts again.
double pauseOf(const CalibrationLog& log) {
  return std::max(maxPause, 3.0 * log.period);
}

/// One pass over a recording.
class Pass {
 public:
  Pass(const CalibrationLog& log, const std::vector<ExecutedAction>& actions,
       const std::vector<bool>& disturbed, const std::vector<bool>& ballMoves,
       const std::vector<bool>& counted, const std::array<Point, 4>& corners,
       const sim::RobotModel& model, FilterDecisions& decisions, std::vector<Innovation>& out)
      : m_log(log),
        m_actions(actions),
        m_disturbed(disturbed),
        m_ballMoves(ballMoves),
        m_counted(counted),
        m_corners(corners),
        m_model(model),
        m_decisions(decisions),
        m_out(out) {}

  State state;
  double lastBelief = -1e9;
  JumpTest* jumps = nullptr;  ///< if wanted

  void start(const MotionStart& from, double time) {
    state.placed = !from.covariance.isZero();
    m_countedFrom = time + (state.placed ? startRest : 0.0);
    state.mean.setZero();
    state.covariance.setZero();
    state.mean[State::X] = from.pose.position.x;
    state.mean[State::Y] = from.pose.position.y;
    state.mean[State::Yaw] = from.pose.yaw;
    state.covariance.topLeftCorner<3, 3>() = from.covariance;
    forgetImu();
    if (jumps) jumps->forget();
    if (!state.known) m_gait = {};
    state.known = true;
    state.ballKnown = false;
  }
  void forgetPose() {
    state.known = false;
    if (jumps) jumps->forget();
  }
  void settle(const ExecutedAction& action) {
    m_gait.advance(m_model, action, 100.0);  // whatever it did in a gap, it has done for long
  }

  void predict(std::uint32_t row, double dt) {
    if (!state.known) return;
    const int steps = std::clamp(static_cast<int>(std::ceil(dt / frame - 0.01)), 1, 64);
    for (int i = 0; i < steps; ++i) step(m_actions[row], dt / steps, m_disturbed[row]);
  }

  void measureImu(std::uint32_t row) {
    if (!state.known || !m_log.rows[row].imuYaw) return;
    State::Vector h = State::Vector::Zero();
    h[State::Yaw] = h[State::ImuError] = 1.0;
    const double expected = state.mean[State::Yaw] + state.mean[State::ImuError];
    const double white = m_model.noise.imuWhite;
    // A robot that started with another yaw: the first value tells the error.
    if (m_imuUnknown) {
      m_imuUnknown = false;
      state.mean[State::ImuError] = wrapToPi(*m_log.rows[row].imuYaw - state.mean[State::Yaw]);
      // The sum of yaw and error is known up to the white noise.
      state.covariance.row(State::ImuError) = -state.covariance.row(State::Yaw);
      state.covariance.col(State::ImuError) = -state.covariance.col(State::Yaw);
      state.covariance(State::ImuError, State::ImuError) =
          state.covariance(State::Yaw, State::Yaw) + white * white;
      if (jumps) jumps->setImu();
      return;
    }
    update(row, Sense::Imu, h, wrapToPi(*m_log.rows[row].imuYaw - expected), white * white);
  }

  void measureImage(std::uint32_t row) {
    if (!state.known) return;
    const CalibrationRow& seen = m_log.rows[row];
    for (std::size_t i = 0; i < seen.corners.size(); ++i) {
      if (!seen.corners[i] || !state.placed) continue;
      const Relative to = relativeTo(m_corners[i].x, m_corners[i].y);
      State::Vector h = State::Vector::Zero();
      h[State::X] = to.dy / to.square;
      h[State::Y] = -to.dx / to.square;
      h[State::Yaw] = -1.0;
      const double sigma = m_model.noise.landmarkBearing;
      update(row, Sense::Corner, h, wrapToPi(*seen.corners[i] - to.bearing), sigma * sigma);
    }
    if (seen.ball) measureBall(row, *seen.ball);
  }

  void measureBelief(std::uint32_t row) {
    const CalibrationRow& seen = m_log.rows[row];
    if (!state.known || !state.placed || !seen.belief || seen.time - lastBelief < beliefInterval)
      return;
    lastBelief = seen.time;
    const double variance = seen.belief->sigma * seen.belief->sigma + 0.02 * 0.02;
    measurePlace(row, Sense::Belief, seen.belief->pose.position, variance);
    State::Vector h = State::Vector::Zero();
    h[State::Yaw] = 1.0;
    update(row, Sense::Belief, h, wrapToPi(seen.belief->pose.yaw - state.mean[State::Yaw]),
           believedYawSpread * believedYawSpread);
  }

  /// Where a team-mate saw the robot.
  void measureSighting(const TeamMateSighting& seen) {
    const auto row = static_cast<std::uint32_t>(seen.row);
    const double time = m_log.rows[row].time;
    double& last = m_lastSighting.try_emplace(seen.mate, -1e9).first->second;
    if (!state.known || !state.placed || time - last < beliefInterval) return;
    last = time;
    const double across = seen.distance * std::hypot(m_model.noise.robotBearing, believedYawSpread);
    const double variance = seen.sigma * seen.sigma +
                            m_model.noise.robotDistance * m_model.noise.robotDistance +
                            across * across;
    measurePlace(row, Sense::TeamMate, seen.place, variance);
  }

  void forgetBall(double time, double rest) {
    state.ballKnown = false;
    m_ballUsedFrom = std::max(m_ballUsedFrom, time + rest);
  }
  void copyGait() {
    state.forward = m_gait.forward;
    state.left = m_gait.left;
    state.turn = m_gait.turn;
  }

 private:
  struct Relative {
    double dx, dy, square, distance, bearing;
  };

  const CalibrationLog& m_log;
  const std::vector<ExecutedAction>& m_actions;
  const std::vector<bool>& m_disturbed;
  const std::vector<bool>& m_ballMoves;
  const std::vector<bool>& m_counted;
  const std::array<Point, 4>& m_corners;
  const sim::RobotModel& m_model;
  FilterDecisions& m_decisions;
  std::vector<Innovation>& m_out;
  GaitStep m_gait;
  double m_countedFrom = -1e9;  // s
  bool m_imuUnknown = true;
  double m_ballUsedFrom = -1e9;
  std::map<std::string, double> m_lastSighting;  // by the team-mate, s
  std::size_t m_next = 0;                        // of the decisions
  int m_rejectedImu = 0, m_rejectedBall = 0, m_rejectedCorners = 0;

  void forgetImu() { m_imuUnknown = true; }

  Relative relativeTo(double x, double y) const {
    double fromX = state.mean[State::X], fromY = state.mean[State::Y];
    if (m_model.fromCamera) {
      fromX += m_model.cameraForward * std::cos(state.mean[State::Yaw]);
      fromY += m_model.cameraForward * std::sin(state.mean[State::Yaw]);
    }
    Relative to{};
    to.dx = x - fromX;
    to.dy = y - fromY;
    to.square = std::max(1e-4, to.dx * to.dx + to.dy * to.dy);
    to.distance = std::sqrt(to.square);
    to.bearing = std::atan2(to.dy, to.dx) - state.mean[State::Yaw];
    return to;
  }

  void step(const ExecutedAction& action, double dt, bool disturbed) {
    m_gait.advance(m_model, action, dt);
    State::Vector& m = state.mean;
    State::Matrix& p = state.covariance;
    m[State::Yaw] += m_gait.turn * dt;
    const double c = std::cos(m[State::Yaw]), s = std::sin(m[State::Yaw]);
    const double dx = (c * m_gait.forward - s * m_gait.left) * dt;
    const double dy = (s * m_gait.forward + c * m_gait.left) * dt;
    m[State::X] += dx;
    m[State::Y] += dy;
    state.odometryX += dx;
    state.odometryY += dy;
    // F P F' with F = 1 but for x and y by yaw.
    p.row(State::X) -= dy * p.row(State::Yaw);
    p.row(State::Y) += dx * p.row(State::Yaw);
    p.col(State::X) -= dy * p.col(State::Yaw);
    p.col(State::Y) += dx * p.col(State::Yaw);
    if (jumps) jumps->predict(dx, dy);
    const double frames = dt / frame;
    p(State::ImuError, State::ImuError) += m_model.noise.imuDrift * m_model.noise.imuDrift * frames;
    if (disturbed) {
      p(State::X, State::X) += pushNoise * pushNoise * frames;
      p(State::Y, State::Y) += pushNoise * pushNoise * frames;
    }
    if (!m_gait.moves) return;
    const double along = m_model.noise.forward * m_model.noise.forward * frames;
    const double across = m_model.noise.sideways * m_model.noise.sideways * frames;
    p(State::X, State::X) += c * c * along + s * s * across;
    p(State::Y, State::Y) += s * s * along + c * c * across;
    p(State::X, State::Y) += c * s * (along - across);
    p(State::Y, State::X) += c * s * (along - across);
    p(State::Yaw, State::Yaw) += m_model.noise.rotation * m_model.noise.rotation * frames;
  }

  void measurePlace(std::uint32_t row, Sense sense, const Point& place, double variance) {
    for (const int axis : {int(State::X), int(State::Y)}) {
      State::Vector h = State::Vector::Zero();
      h[axis] = 1.0;
      update(row, sense, h, (axis == State::X ? place.x : place.y) - state.mean[axis], variance);
    }
  }

  void measureBall(std::uint32_t row, const CalibrationRow::Seen& ball) {
    const double time = m_log.rows[row].time;
    if (m_actions[row].kicks) forgetBall(time, kickRest);
    const double ground = groundDistance(m_model, ball.distance, m_log.field.ballRadius);
    if (ground < ballTouch) forgetBall(time, ballRest);
    if (m_ballMoves[row]) forgetBall(time, 0.0);
    if (time < m_ballUsedFrom || m_ballMoves[row]) return;
    const double height = m_model.fromCamera ? m_model.cameraHeight - m_log.field.ballRadius : 0.0;
    if (!state.ballKnown) {
      placeBall(ground, ball);
      return;
    }
    const Relative to = relativeTo(state.mean[State::BallX], state.mean[State::BallY]);
    const double far = std::sqrt(to.square + height * height);
    State::Vector h = State::Vector::Zero();
    h[State::BallX] = to.dx / far;
    h[State::BallY] = to.dy / far;
    h[State::X] = -h[State::BallX];
    h[State::Y] = -h[State::BallY];
    const double sigma = m_model.noise.visionDistance * far;
    update(row, Sense::BallDistance, h, ball.distance - far, sigma * sigma);
    if (!state.ballKnown) return;
    const Relative now = relativeTo(state.mean[State::BallX], state.mean[State::BallY]);
    h.setZero();
    h[State::X] = now.dy / now.square;
    h[State::Y] = -now.dx / now.square;
    h[State::BallX] = -h[State::X];
    h[State::BallY] = -h[State::Y];
    h[State::Yaw] = -1.0;
    const double bearing = m_model.noise.visionBearing;
    update(row, Sense::BallBearing, h, wrapToPi(ball.bearing - now.bearing), bearing * bearing);
  }

  /// The first sight of the ball: its place, and how it depends on the pose.
  void placeBall(double ground, const CalibrationRow::Seen& ball) {
    const double direction = state.mean[State::Yaw] + ball.bearing;
    const double c = std::cos(direction), s = std::sin(direction);
    state.mean[State::BallX] = state.mean[State::X] + ground * c;
    state.mean[State::BallY] = state.mean[State::Y] + ground * s;
    State::Matrix& p = state.covariance;
    Eigen::Matrix<double, 2, State::Size> jacobian = Eigen::Matrix<double, 2, State::Size>::Zero();
    jacobian(0, State::X) = jacobian(1, State::Y) = 1.0;
    jacobian(0, State::Yaw) = -ground * s;
    jacobian(1, State::Yaw) = ground * c;
    p.bottomRows<2>().setZero();
    p.rightCols<2>().setZero();
    const Eigen::Matrix<double, 2, State::Size> cross = jacobian * p;
    Eigen::Matrix2d own = cross * jacobian.transpose();
    const double radial = m_model.noise.visionDistance * ground;
    const double round = m_model.noise.visionBearing * ground;
    own(0, 0) += c * c * radial * radial + s * s * round * round;
    own(1, 1) += s * s * radial * radial + c * c * round * round;
    own(0, 1) += c * s * (radial * radial - round * round);
    own(1, 0) = own(0, 1);
    p.bottomRows<2>() = cross;
    p.rightCols<2>() = cross.transpose();
    p.bottomRightCorner<2, 2>() = own;
    state.ballKnown = true;
    m_rejectedBall = 0;
    if (jumps) jumps->placeBall(jacobian);
  }

  /// Of a measurement that is far from what was expected.
  std::uint8_t decide(Sense sense, double share) {
    int& count = sense == Sense::Imu                                           ? m_rejectedImu
                 : sense == Sense::BallDistance || sense == Sense::BallBearing ? m_rejectedBall
                                                                               : m_rejectedCorners;
    if (share <= gateSigmas * gateSigmas) {
      count = std::max(0, count - 1);
      return FilterDecisions::Use;
    }
    ++m_decisions.outliers;
    count += 2;
    if (count < 2 * maxOutliers) return FilterDecisions::Reject;
    count = 0;
    if (sense == Sense::Imu) {
      ++m_decisions.imuResets;
      return FilterDecisions::ForgetImu;
    }
    if (sense == Sense::BallDistance || sense == Sense::BallBearing) {
      ++m_decisions.ballMoves;
      return FilterDecisions::ForgetBall;
    }
    ++m_decisions.jumps;
    return FilterDecisions::ForgetPose;
  }

  void update(std::uint32_t row, Sense sense, const State::Vector& h, double innovation,
              double noise) {
    if (!state.known) return;
    const State::Vector ph = state.covariance * h;
    const double variance = h.dot(ph) + noise;
    std::uint8_t decision = FilterDecisions::Use;
    if (m_decisions.recorded) {
      if (m_next < m_decisions.all.size()) decision = m_decisions.all[m_next++];
    } else {
      decision = decide(sense, innovation * innovation / variance);
      m_decisions.all.push_back(decision);
    }
    switch (decision) {
      case FilterDecisions::Use:
        break;
      case FilterDecisions::ForgetImu:
        forgetImu();
        return;
      case FilterDecisions::ForgetBall:
        forgetBall(m_log.rows[row].time, ballRest);
        return;
      case FilterDecisions::ForgetPose:
        forgetPose();
        return;
      default:
        return;
    }
    if (m_counted[row] && m_log.rows[row].time >= m_countedFrom)
      m_out.push_back({innovation, variance, row, sense});
    const State::Vector gain = ph / variance;
    if (jumps) jumps->update(h, gain, innovation, variance);
    state.mean += gain * innovation;
    state.covariance.noalias() -= gain * ph.transpose();
  }
};

}  // namespace

double logLikelihood(const Innovation& one) {
  return -0.5 *
         (one.value * one.value / one.variance + std::log(2.0 * std::numbers::pi * one.variance));
}

double logLikelihood(const std::vector<Innovation>& innovations) {
  double sum = 0.0;
  for (const Innovation& one : innovations) sum += logLikelihood(one);
  return std::isfinite(sum) ? sum : -std::numeric_limits<double>::infinity();
}

MotionFilter::MotionFilter(const CalibrationLog& log, const sim::RobotModel& base)
    : m_log(log), m_actions(executedActions(log, base)), m_corners(fieldCorners(log.field)) {
  std::size_t corners = 0;
  for (std::size_t i = 0; i < log.rows.size(); ++i) {
    const CalibrationRow& row = log.rows[i];
    const bool seesCorner =
        std::ranges::any_of(row.corners, [](const auto& one) { return one.has_value(); });
    if (seesCorner) ++corners;
    if (seesCorner || row.ball) m_percepts.push_back(static_cast<std::uint32_t>(i));
  }
  m_seesCorners = corners >= 50;
  for (const ExecutedAction& action : m_actions) m_executed.insert(action.code);
  findDisturbed(base, base.noise.visionDelay);
}

bool MotionFilter::dependsOn(std::size_t parameter) const {
  const std::set<int> actions = actionsOf(parameter);
  return actions.empty() ||
         std::ranges::any_of(actions, [&](int code) { return m_executed.contains(code); });
}

bool MotionFilter::beginsAnew(std::uint32_t row) const {
  if (m_actions[row].down) return false;
  return row == 0 || m_log.rows[row].time - m_log.rows[row - 1].time > pauseOf(m_log) ||
         m_actions[row - 1].down;
}

const MotionStart& MotionFilter::startAt(std::uint32_t row, const sim::RobotModel& model,
                                         double delay, FilterDecisions& decisions) const {
  const auto [place, isNew] = decisions.starts.try_emplace(row);
  MotionStart& start = place->second;
  if (!isNew) return start;
  start.row = row;
  if (m_seesCorners) {
    const auto found = startFromCorners(m_log, m_actions, model, decisions.gaitSpread, delay, row);
    if (found) start = *found;
    return start;
  }
  for (std::size_t k = row;
       k < m_log.rows.size() && m_log.rows[k].time < m_log.rows[row].time + 0.5; ++k) {
    if (!m_log.rows[k].belief || m_log.rows[k].belief->sigma >= maxBelievedSigma) continue;
    start = startFromBelief(row, *m_log.rows[k].belief);
    break;
  }
  return start;
}

void MotionFilter::run(const sim::RobotModel& model, double delay, FilterDecisions& decisions,
                       std::vector<Innovation>& out, std::vector<MotionState>* states,
                       JumpTest* jumps) const {
  out.clear();
  if (!decisions.recorded) {
    decisions.all.clear();
    decisions.outliers = decisions.imuResets = decisions.ballMoves = decisions.jumps = 0;
  }
  if (states) states->assign(m_log.rows.size(), {});
  Pass pass(m_log, m_actions, m_disturbed, m_ballMoves, m_counted, m_corners, model, decisions,
            out);
  pass.jumps = jumps;
  std::size_t percept = 0, sighting = 0;
  double lastLook = -1e9;
  for (std::uint32_t i = 0; i < m_log.rows.size(); ++i) {
    const CalibrationRow& row = m_log.rows[i];
    const double dt = i > 0 ? row.time - m_log.rows[i - 1].time : 0.0;
    const ExecutedAction& action = m_actions[i];
    const bool gap = dt > pauseOf(m_log);
    if (action.down || gap) {
      pass.forgetPose();
      pass.forgetBall(row.time, ballRest);
    } else if (i > 0) {
      pass.predict(i, dt);
    }
    const bool again = beginsAnew(i);
    const bool looks = (!pass.state.known || !pass.state.placed) && !action.down &&
                       row.time - lastLook >= startInterval;
    if (again || looks) {
      lastLook = row.time;
      const MotionStart& start = startAt(i, model, delay, decisions);
      // Without a place, what it knows of its yaw is as good as before.
      if (!pass.state.known || !start.covariance.isZero()) {
        const bool settles = !pass.state.known && (gap || !again);
        pass.start(start, row.time);
        if (settles) pass.settle(action);
      }
    }
    if (action.kicks && action.began) pass.forgetBall(row.time, kickRest);
    pass.measureImu(i);
    // Percepts are of the image that was taken `delay` before they were published.
    const double tolerance = 0.25 * std::min(m_log.period, frame);
    while (percept < m_percepts.size() &&
           m_log.rows[m_percepts[percept]].time - delay <= row.time + tolerance) {
      const double age = row.time - (m_log.rows[m_percepts[percept]].time - delay);
      // The first images are left out for every delay, so that likelihoods can be compared.
      const bool early = m_log.rows[m_percepts[percept]].time - m_log.rows[0].time < maxDelay;
      if (!early && age <= 1.5 * std::max(dt, frame)) pass.measureImage(m_percepts[percept]);
      ++percept;
    }
    for (; sighting < m_log.sightings.size() && m_log.sightings[sighting].row <= i; ++sighting) {
      if (!m_seesCorners) pass.measureSighting(m_log.sightings[sighting]);
    }
    if (!m_seesCorners) pass.measureBelief(i);
    if (jumps && pass.state.placed && pass.state.known) {
      jumps->begin(i, row.time, pass.state.ballKnown);
    }
    if (states) {
      pass.copyGait();
      (*states)[i] = pass.state;
    }
  }
  decisions.recorded = true;
}

}  // namespace pitchboard::link
