// SPDX-License-Identifier: GPL-3.0-or-later
// Poses drawn from what the sensors say, for particles that start over (sensor resetting).
#include <cmath>
#include <numbers>

#include <base/random.h>
#include <base/repeatable_math.h>
#include "localization/monte_carlo_localization.h"

#include "localization/monte_carlo_imu.h"

namespace pitchboard::link {
namespace {

using std::numbers::pi;

constexpr double bearingMemory = 1.5;  // s for which a bearing serves

}  // namespace

double MonteCarloLocalization::drawYaw(CounterRandom& random) const {
  if (!m_lastImu || random.uniform() < imuOutliers) return (2 * random.uniform() - 1) * pi;
  const bool left =
      m_imuZero == ImuZero::Left || (m_imuZero == ImuZero::Unknown && random.uniform() < 0.5);
  const double shift = m_imuShift != 0.0 && random.uniform() < 0.5 ? m_imuShift : 0.0;
  return random.normal(*m_lastImu + (left ? pi : 0.0) + shift, 0.5 * m_parameters.imuSigma);
}

bool MonteCarloLocalization::onField(const Point& p) const {
  return std::abs(p.x) <= m_halfLength + m_border && std::abs(p.y) <= m_halfWidth + m_border;
}

// A pose that explains what was seen lately: with a yaw from the IMU, the robot stands on the line
// through each corner in the direction of its bearing; two lines cross where it stands.
Pose MonteCarloLocalization::drawFromSensors(CounterRandom& random) const {
  std::array<std::size_t, 4> known{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < m_remembered.size(); ++i) {
    if (m_remembered[i].age < bearingMemory) known[count++] = i;
  }
  const double yaw = drawYaw(random);
  const auto lineOf = [&](std::size_t i) {
    return yaw + random.normal(m_remembered[i].bearing, m_parameters.bearingSigma);
  };
  if (count >= 2) {
    const auto first = static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
    const auto step =
        1 + static_cast<std::size_t>(random.uniform() * static_cast<double>(count - 1));
    const std::size_t i = known[first], j = known[(first + step) % count];
    const double u = lineOf(i), v = lineOf(j);
    const double cross = repeatable::sin(v - u);
    if (std::abs(cross) > 0.05) {
      // p = corner_i - t * (cos u, sin u) = corner_j - r * (cos v, sin v)
      const double dx = m_corners[i].x - m_corners[j].x, dy = m_corners[i].y - m_corners[j].y;
      const double t = (dx * repeatable::sin(v) - dy * repeatable::cos(v)) / cross;
      const double r = (dx * repeatable::sin(u) - dy * repeatable::cos(u)) / cross;
      const Point p{m_corners[i].x - t * repeatable::cos(u),
                    m_corners[i].y - t * repeatable::sin(u)};
      if (t > 0 && r > 0 && onField(p)) return {p, yaw};
    }
  }
  if (count >= 1) {
    const std::size_t i =
        known[static_cast<std::size_t>(random.uniform() * static_cast<double>(count))];
    const double u = lineOf(i);
    const double t = random.uniform() * 2 * repeatable::hypot(m_halfLength, m_halfWidth);
    const Point p{m_corners[i].x - t * repeatable::cos(u), m_corners[i].y - t * repeatable::sin(u)};
    if (onField(p)) return {p, yaw};
  }
  const double x = (2 * random.uniform() - 1) * m_halfLength;
  const double y = (2 * random.uniform() - 1) * m_halfWidth;
  if (count == 0) return {{x, y}, yaw};
  const std::size_t i = known[0];
  return {{x, y}, direction({x, y}, m_corners[i]) - m_remembered[i].bearing};
}

}  // namespace pitchboard::link
