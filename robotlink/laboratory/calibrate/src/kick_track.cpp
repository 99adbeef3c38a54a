// SPDX-License-Identifier: GPL-3.0-or-later
#include "kick_track.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include <base/angles.h>

namespace pitchboard::link {
namespace {

constexpr double rollTime = 2.5;        // s after the contact that are looked at
constexpr double restTime = 1.5;        // s before it
constexpr std::size_t minRolling = 20;  // percepts of a rolling ball
constexpr double border = 0.3;          // m before a goal line, and beyond a touch line

/// How far a ball has rolled that began with this speed and loses `loss` m/s every second
/// (rollingDistance() of simcore/world).
double rolled(double speed, double loss, double time) {
  const double t = std::clamp(time, 0.0, loss > 0.0 ? speed / loss : time);
  return speed * t - 0.5 * loss * t * t;
}

/// Residuals of all sights, in sigmas: along and across the ray.
void residualsOf(const Kick& kick, const Eigen::Matrix<double, 5, 1>& at, double loss,
                 Eigen::VectorXd& out) {
  out.resize(static_cast<Eigen::Index>(2 * kick.sights.size()));
  const double speed = std::max(1e-6, std::hypot(at[3], at[4]));
  for (std::size_t i = 0; i < kick.sights.size(); ++i) {
    const BallObservation& sight = kick.sights[i];
    const double rolledSoFar = rolled(speed, loss, sight.time - at[2]);
    const double dx = sight.x - (at[0] + at[3] / speed * rolledSoFar);
    const double dy = sight.y - (at[1] + at[4] / speed * rolledSoFar);
    const double c = std::cos(sight.bearing), s = std::sin(sight.bearing);
    out[static_cast<Eigen::Index>(2 * i)] = (c * dx + s * dy) / sight.radial;
    out[static_cast<Eigen::Index>(2 * i + 1)] = (c * dy - s * dx) / sight.round;
  }
}

}  // namespace

KickKind kindOf(int code) {
  return code == 12 || code == 13 ? PassKick : code == 21 || code == 22 ? WeakKick : StrongKick;
}

void fitKick(Kick& kick, double loss) {
  Eigen::VectorXd now, next;
  residualsOf(kick, kick.fitted, loss, now);
  double damping = 1e-3;
  Eigen::Matrix<double, 5, 5> normal;
  Eigen::MatrixXd jacobian(now.size(), 5);
  for (int round = 0; round < 40; ++round) {
    for (int p = 0; p < 5; ++p) {
      auto at = kick.fitted;
      at[p] += 1e-5;
      residualsOf(kick, at, loss, next);
      jacobian.col(p) = (next - now) / 1e-5;
    }
    normal = jacobian.transpose() * jacobian;
    const Eigen::Matrix<double, 5, 1> slope = jacobian.transpose() * now;
    bool better = false;
    double gained = 0.0;
    for (int tries = 0; tries < 8 && !better; ++tries) {
      Eigen::Matrix<double, 5, 5> damped = normal;
      damped.diagonal() *= 1.0 + damping;
      damped.diagonal().array() += 1e-9;
      const auto at = (kick.fitted - damped.ldlt().solve(slope)).eval();
      residualsOf(kick, at, loss, next);
      if (next.squaredNorm() < now.squaredNorm()) {
        gained = now.squaredNorm() - next.squaredNorm();
        kick.fitted = at;
        now = next;
        damping *= 0.3;
        better = true;
      } else {
        damping *= 5.0;
      }
    }
    if (!better || gained < 1e-6) break;
  }
  normal.diagonal().array() += 1e-9;
  kick.covariance = normal.inverse();
  kick.chi2 = now.squaredNorm();
}

std::optional<Kick> kickAt(const CalibrationLog& log, const MotionFilter& filter,
                           const MotionFit::OfLog& fit, const MotionFit& motion,
                           std::size_t first) {
  const auto& rows = log.rows;
  const MotionState& from = fit.states[first];
  if (!from.known) return {};
  Kick kick;
  kick.code = filter.actions()[first].code;
  const double began = rows[first].time, contact = motion.model.kickContact;
  const double yaw0 = from.mean[MotionState::Yaw];
  std::size_t rolling = 0;
  bool contactSeen = false;
  std::vector<double> distances;
  std::vector<Point> places;
  for (std::size_t i = first; i-- > 0 && began - rows[i].time < restTime + 1.0;) {
    if (filter.actions()[i].kicks) return {};  // the ball of the kick before may still roll
  }
  const auto imageOf = [&](std::size_t i) {  // the row in which the image of row i was taken
    const double time = rows[i].time - motion.delay - 0.25 * kickTick;
    while (i > 0 && rows[i - 1].time >= time) --i;
    return i;
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double since = rows[i].time - began;
    if (since < -restTime || !fit.states[i].known) continue;
    if (since > contact + rollTime) break;
    if (since > kickTick && filter.actions()[i].kicks && filter.actions()[i].began) break;
    if (!contactSeen && since >= contact) {
      contactSeen = true;
      kick.yawAtContact = wrapToPi(fit.states[i].mean[MotionState::Yaw] - yaw0);
      const double wx = fit.states[i].odometryX - from.odometryX;
      const double wy = fit.states[i].odometryY - from.odometryY;
      kick.xAtContact = std::cos(yaw0) * wx + std::sin(yaw0) * wy;
      kick.yAtContact = -std::sin(yaw0) * wx + std::cos(yaw0) * wy;
    }
    if (!rows[i].ball) continue;
    const std::size_t image = imageOf(i);
    const MotionState& state = fit.states[image];
    if (!state.known) continue;
    const double turned = wrapToPi(state.mean[MotionState::Yaw] - yaw0);
    const double ox = state.odometryX - from.odometryX, oy = state.odometryY - from.odometryY;
    BallObservation sight;
    sight.time = rows[image].time - began;
    // Before the kick only a ball at rest helps, and the last half second is the nearest to it.
    if (sight.time < -0.5) continue;
    sight.bearing = turned + rows[i].ball->bearing;
    const double d = rows[i].ball->distance;
    sight.x = std::cos(yaw0) * ox + std::sin(yaw0) * oy + d * std::cos(sight.bearing);
    sight.y = -std::sin(yaw0) * ox + std::cos(yaw0) * oy + d * std::sin(sight.bearing);
    distances.push_back(d);
    const double direction = state.mean[MotionState::Yaw] + rows[i].ball->bearing;
    places.push_back({state.mean[MotionState::X] + d * std::cos(direction),
                      state.mean[MotionState::Y] + d * std::sin(direction)});
    if (sight.time > contact + 0.1) ++rolling;
    kick.sights.push_back(sight);
  }
  if (!contactSeen || rolling < minRolling || kick.sights.size() < rolling + 10) return {};
  // The noise grows with the true distance, which a mean of neighbours is nearer to.
  for (std::size_t i = 0; i < kick.sights.size(); ++i) {
    constexpr std::size_t reach = 5;
    const std::size_t begin = i > reach ? i - reach : 0;
    const std::size_t end = std::min(kick.sights.size(), i + reach + 1);
    double d = 0.0;
    Point place;
    for (std::size_t k = begin; k < end; ++k) {
      const auto share = 1.0 / static_cast<double>(end - begin);
      d += share * distances[k];
      place.x += share * places[k].x;
      place.y += share * places[k].y;
    }
    // At a goal or a wall it does not roll freely any more.
    if (kick.sights[i].time > contact + 0.3 &&
        (std::abs(place.x) > log.field.halfLength() - border ||
         std::abs(place.y) > log.field.halfWidth() + border)) {
      kick.sights.resize(i);
      break;
    }
    kick.sights[i].radial = std::max(0.003, motion.model.noise.visionDistance * d);
    kick.sights[i].round = std::max(0.002, motion.model.noise.visionBearing * d);
  }
  rolling = 0;
  for (const BallObservation& sight : kick.sights) rolling += sight.time > contact + 0.1 ? 1 : 0;
  if (rolling < minRolling) return {};
  // Begin: at rest where it was seen before, then towards where it was seen last.
  double x = 0.0, y = 0.0, n = 0.0;
  for (const BallObservation& sight : kick.sights) {
    if (sight.time > 0.25) continue;
    x += sight.x;
    y += sight.y;
    n += 1.0;
  }
  if (n < 3.0) return {};
  const auto late = kick.sights.size() - std::min<std::size_t>(10, rolling);
  double lx = 0.0, ly = 0.0, lt = 0.0, ln = 0.0;
  for (std::size_t i = late; i < kick.sights.size(); ++i) {
    lx += kick.sights[i].x;
    ly += kick.sights[i].y;
    lt += kick.sights[i].time;
    ln += 1.0;
  }
  const double span = std::max(0.1, lt / ln - contact);
  kick.fitted << x / n, y / n, contact, (lx / ln - x / n) / span, (ly / ln - y / n) / span;
  return kick;
}

double footShare(const sim::RobotModel& base, const Kick& kick) {
  if (base.kickLaw != sim::KickLaw::Foot) return 1.0;
  const double c = std::cos(kick.yawAtContact), s = std::sin(kick.yawAtContact);
  const double y = c * (kick.fitted[1] - kick.yAtContact) - s * (kick.fitted[0] - kick.xAtContact);
  const bool right = kick.code == 4 || kick.code == 21;
  const double side = kindOf(kick.code) == PassKick ? (y < 0.0 ? -1.0 : 1.0) : (right ? -1.0 : 1.0);
  const double beside = (side * y - base.footSide) / base.footWidth;
  return std::exp(-0.5 * beside * beside);
}

}  // namespace pitchboard::link
