// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The likelihood of a recording: an extended Kalman filter (Jazwinski, Stochastic Processes and
// Filtering Theory, 1970, chapter 8) over pose, IMU error and the place of a ball at rest, which
// follows the commands through the gait of a robot model and is corrected by IMU, ball and field
// corners. Its innovations v with variance S give the log-likelihood
//   -1/2 sum(v^2/S + log(2 pi S))   (Schweppe, IEEE Trans. Information Theory 11, 1965).
// Private to calibrate. One thread each.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include <robotlink/calibrate/calibration_log.h>
#include <simcore/world/robot_model.h>

#include "executed_actions.h"
#include "motion_parameters.h"
#include "motion_start.h"

namespace pitchboard::link {

inline constexpr double ballRest = 4.0;  ///< s after it moved until the ball is used again

/// Along the ground, m, of something that is seen at a distance and whose middle has this height.
inline double groundDistance(const sim::RobotModel& model, double distance, double height) {
  if (!model.fromCamera) return distance;
  const double drop = model.cameraHeight - height;
  return std::sqrt(std::max(0.01, distance * distance - drop * drop));
}

/// Where a measurement came from.
enum class Sense : std::uint8_t { Imu, BallDistance, BallBearing, Corner, Belief, TeamMate };

struct Innovation {
  double value = 0.0;
  double variance = 1.0;
  std::uint32_t row = 0;
  Sense sense = Sense::Imu;
};

/// What the filter knew after a row.
struct MotionState {
  enum : int { X, Y, Yaw, ImuError, BallX, BallY, Size };
  using Vector = Eigen::Matrix<double, Size, 1>;
  using Matrix = Eigen::Matrix<double, Size, Size>;
  Vector mean = Vector::Zero();
  Matrix covariance = Matrix::Zero();
  double forward = 0.0, left = 0.0, turn = 0.0;  ///< speeds of the gait, m/s and rad/s
  double odometryX = 0.0, odometryY = 0.0;       ///< m, way so far by the gait alone
  bool known = false;                            ///< there is a pose
  bool placed = false;                           ///< and it is one on the field
  bool ballKnown = false;
};

/// What a run of the filter decided about measurements. Derivatives of the likelihood need the same
/// decisions at neighbouring parameters.
struct FilterDecisions {
  enum : std::uint8_t { Use, Reject, ForgetImu, ForgetBall, ForgetPose };
  std::vector<std::uint8_t> all;
  bool recorded = false;
  std::size_t outliers = 0, imuResets = 0, ballMoves = 0, jumps = 0;
  /// Where it was found to begin, by row. They are kept when measurements are decided again, until
  /// they are cleared.
  std::map<std::uint32_t, MotionStart> starts;
  double gaitSpread = speedPrior;  ///< for looking for them, see startFromCorners()
};

class JumpTest;

class MotionFilter {
 public:
  /// `log` must outlive it.
  MotionFilter(const CalibrationLog& log, const sim::RobotModel& base);
  /// Finds disturbed() again, for a model that is nearer to the robot than the base. Ends what runs
  /// before it have decided.
  void findDisturbed(const sim::RobotModel& known, double delay);
  /// Finds when it was moved by something that it did not see, and when the ball was moved. The
  /// model has to be near to the robot. Adds to disturbed().
  void findJumps(const sim::RobotModel& known, double delay);

  /// Measurements in order. `delay`: s between an image and its percepts. Makes the decisions if
  /// they are not recorded, else follows them. `states`: one for each row, if wanted. `jumps`:
  /// looks for jumps, if wanted.
  void run(const sim::RobotModel& model, double delay, FilterDecisions& decisions,
           std::vector<Innovation>& out, std::vector<MotionState>* states = nullptr,
           JumpTest* jumps = nullptr) const;

  /// Whether a motion parameter changes anything here: speeds of actions that the robot never
  /// carried out do not.
  bool dependsOn(std::size_t parameter) const;
  double timeOf(std::uint32_t row) const { return m_log.rows[row].time; }
  double lastTime() const { return m_log.rows.back().time; }
  const std::vector<ExecutedAction>& actions() const { return m_actions; }
  /// Rows in which the robot may push the ball, another robot, a goal or a wall: its gait does not
  /// say how it moves.
  const std::vector<bool>& disturbed() const { return m_disturbed; }
  /// Rows of these round a moment in which it was moved by something that it did not see.
  const std::vector<bool>& pushed() const { return m_pushed; }
  /// Rows in which the ball does not lie still.
  const std::vector<bool>& ballMoves() const { return m_ballMoves; }

 private:
  void findCounted();
  bool beginsAnew(std::uint32_t row) const;
  /// Remembers in `decisions` what it finds.
  const MotionStart& startAt(std::uint32_t row, const sim::RobotModel& model, double delay,
                             FilterDecisions& decisions) const;

  const CalibrationLog& m_log;
  std::vector<ExecutedAction> m_actions;
  std::set<int> m_executed;  // codes
  std::vector<bool> m_disturbed, m_pushed, m_ballMoves;
  // Rows whose measurements count in the likelihood: not while it is disturbed, nor until it is
  // known again where it is. By the row that shows a percept, whatever its delay, so that
  // likelihoods of all delays are of the same measurements.
  std::vector<bool> m_counted;
  std::vector<std::uint32_t> m_percepts;  // rows with ball or corners
  std::array<Point, 4> m_corners;
  bool m_seesCorners = false;
};

double logLikelihood(const Innovation& innovation);
double logLikelihood(const std::vector<Innovation>& innovations);

}  // namespace pitchboard::link
