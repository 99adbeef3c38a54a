// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds when a robot was moved by something that it did not see, or a ball that should lie still
// was moved: the generalized likelihood ratio of a jump of its place in the innovations of the
// filter that follow (Willsky and Jones, IEEE Transactions on Automatic Control 21, 1976). The jump
// may have any size and direction, with a wide prior. Private to calibrate. One thread.

#include <Eigen/Core>
#include <Eigen/LU>
#include <cstdint>
#include <deque>
#include <vector>

#include "motion_filter.h"

namespace pitchboard::link {

/// Twice the logarithm of the likelihood ratio, of two degrees of freedom each.
struct JumpEvidence {
  std::uint32_t row = 0;
  double robot = 0.0, ball = 0.0;
};

class JumpTest {
 public:
  /// After the measurements of a row, if the pose is known. A jump is looked for in steps.
  void begin(std::uint32_t row, double time, bool ballKnown) {
    while (!m_open.empty() && time - m_open.front().time >= window) close();
    if (!m_open.empty() && time - m_open.back().time < interval) return;
    Candidate& one = m_open.emplace_back();
    one.row = row;
    one.time = time;
    one.error(MotionState::X, RobotX) = one.error(MotionState::Y, RobotY) = 1.0;
    if (ballKnown)
      one.error(MotionState::BallX, BallX) = one.error(MotionState::BallY, BallY) = 1.0;
  }
  /// The robot walked so far, m: an error of its yaw becomes one of its place.
  void predict(double dx, double dy) {
    for (Candidate& one : m_open) {
      one.error.row(MotionState::X) -= dy * one.error.row(MotionState::Yaw);
      one.error.row(MotionState::Y) += dx * one.error.row(MotionState::Yaw);
    }
  }
  void update(const MotionState::Vector& h, const MotionState::Vector& gain, double innovation,
              double variance) {
    for (Candidate& one : m_open) {
      const Eigen::Matrix<double, 1, 4> seen = h.transpose() * one.error;
      one.weighted += seen.transpose() * (innovation / variance);
      one.information += seen.transpose() * seen / variance;
      one.error -= gain * seen;
    }
  }
  /// The ball was found anew, from a pose that may be wrong.
  void placeBall(const Eigen::Matrix<double, 2, MotionState::Size>& byPose) {
    for (Candidate& one : m_open) {
      const Eigen::Matrix<double, 2, 4> ball = byPose * one.error;
      one.error.bottomRows<2>() = ball;
    }
  }
  /// The error of the IMU was found anew, from a yaw that may be wrong.
  void setImu() {
    for (Candidate& one : m_open) {
      one.error.row(MotionState::ImuError) = -one.error.row(MotionState::Yaw);
    }
  }
  /// What comes says nothing of what was.
  void forget() {
    while (!m_open.empty()) close();
  }
  const std::vector<JumpEvidence>& found() const { return m_found; }

 private:
  static constexpr double interval = 0.25;  // s
  static constexpr double window = 2.0;     // s
  static constexpr double prior = 0.3;      // m, of a jump
  enum : int { RobotX, RobotY, BallX, BallY };
  struct Candidate {
    std::uint32_t row = 0;
    double time = 0.0;
    /// What is wrong in the filter's state for each coordinate of a jump of 1 m.
    Eigen::Matrix<double, MotionState::Size, 4> error =
        Eigen::Matrix<double, MotionState::Size, 4>::Zero();
    Eigen::Vector4d weighted = Eigen::Vector4d::Zero();
    Eigen::Matrix4d information = Eigen::Matrix4d::Zero();

    double evidence(int first) const {
      const Eigen::Matrix2d all =
          information.block<2, 2>(first, first) + Eigen::Matrix2d::Identity() / (prior * prior);
      const Eigen::Vector2d part = weighted.segment<2>(first);
      return part.dot(all.inverse() * part);
    }
  };

  void close() {
    const Candidate& one = m_open.front();
    m_found.push_back({one.row, one.evidence(RobotX), one.evidence(BallX)});
    m_open.pop_front();
  }

  std::deque<Candidate> m_open;
  std::vector<JumpEvidence> m_found;
};

}  // namespace pitchboard::link
