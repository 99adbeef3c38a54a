// SPDX-License-Identifier: GPL-3.0-or-later
#include "percept_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include <base/angles.h>

namespace pitchboard::link {
namespace {

constexpr double enough = 0.7;       // a posterior wider than this share of the prior's is none
constexpr double maxMissing = 0.25;  // s; a ball that is lost for longer was out of view
constexpr double coarsest = 0.03;    // s; rows farther apart do not show single images
constexpr double standing = 1.0;     // s of standing before percepts are compared

CalibratedValue valueOf(const char* key, const GridPosterior& posterior, std::size_t samples,
                        const char* of) {
  return {key, posterior.median, posterior.low, posterior.high, samples, of};
}

// ---- how often something in view is missed
// -------------------------------------------------------

/// Beta posterior (conjugate to the binomial) on a grid of the rate, prior with the base's mean.
GridPosterior ratePosterior(double base, const std::function<double(double)>& logLikelihood) {
  constexpr int count = 2000;
  const double a = ratePrior * std::clamp(base, 0.02, 0.98);
  const double b = ratePrior - a;
  const auto place = [](int i) { return (i + 0.5) / count; };
  return posteriorOn(count, place, [&](int i) {
    const double p = place(i);
    return (a - 1.0) * std::log(p) + (b - 1.0) * std::log1p(-p) + logLikelihood(p);
  });
}

struct MissedImages {
  std::size_t missed = 0, all = 0;
};

/// Nine of ten balls that were seen were nearer. m.
double defaultDistance(const CalibrationLog& log) {
  std::vector<double> all;
  for (const CalibrationRow& row : log.rows) {
    if (row.ball) all.push_back(row.ball->distance);
  }
  if (all.empty()) return 0.0;
  const auto at = all.begin() + static_cast<std::ptrdiff_t>(all.size() * 9 / 10);
  std::nth_element(all.begin(), at, all.end());
  return *at;
}

/// Counts the images between the first and the last that show the ball. Both were chosen because
/// they show it, and do not count themselves. A ball at the edge of the view or of the range comes
/// and goes: what is near a moment in which it came or went is left out, and so is a ball that was
/// last seen far away or beside the robot.
MissedImages missedImages(const CalibrationLog& log, double panLimit) {
  constexpr double edge = 0.5;  // s
  const auto& rows = log.rows;
  const double far = defaultDistance(log);
  MissedImages out;
  std::optional<std::size_t> first, last;  // seen
  bool cameIntoView = false;
  double looksSince = -1e9;
  const auto close = [&](bool leftView) {
    if (!first) return;
    const double from = rows[*first].time + (cameIntoView ? edge : 0.0);
    const double to = rows[*last].time - (leftView ? edge : 0.0);
    bool wellInView = false;
    for (std::size_t i = *first; i < *last; ++i) {
      const bool lost = rows[i].ballLost.value_or(true);
      if (!lost && !rows[i].ball) continue;  // no new image
      if (wellInView && i > *first && rows[i].time >= from && rows[i].time <= to) {
        ++out.all;
        if (lost) ++out.missed;
      }
      if (!lost) {
        wellInView = rows[i].ball->distance < far && std::abs(rows[i].ball->bearing) < panLimit;
      }
    }
    first.reset();
  };
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double time = rows[i].time;
    const bool lost = rows[i].ballLost.value_or(true);
    if (!rows[i].looksForBall || !rows[i - 1].looksForBall || rows[i].fallen) {
      close(first && time - rows[*last].time >= maxMissing);
      looksSince = time;
      continue;
    }
    if (first && time - rows[*last].time >= maxMissing) close(true);
    if (lost || !rows[i].ball) continue;
    if (!first) {
      first = i;
      cameIntoView = time - looksSince >= maxMissing;
    }
    last = i;
  }
  close(true);
  return out;
}

void fitMissed(std::span<const CalibrationLog> logs, Calibration& out) {
  const char* key = "noise.missed_detection";
  std::size_t missed = 0, all = 0;
  for (const CalibrationLog& log : logs) {
    if (!log.has("VISION_LOST") || log.period > 0.12) continue;
    const MissedImages images = missedImages(log, out.base.panLimit);
    missed += images.missed;
    all += images.all;
  }
  if (all < 200) {
    out.kept[key] = "the ball was in view for too short a time";
    return;
  }
  const auto k = static_cast<double>(missed), n = static_cast<double>(all);
  take(out,
       valueOf(key,
               ratePosterior(out.base.noise.missedDetection,
                             [&](double p) { return k * std::log(p) + (n - k) * std::log1p(-p); }),
               all, "images"));
}

void fitCorners(std::span<const MotionFilter> filters, std::span<const CalibrationLog> logs,
                const MotionFit& motion, Calibration& out) {
  const char* key = "noise.landmark_probability";
  constexpr double margin = 0.14;                 // rad, round the border of what the body faces
  std::map<std::pair<int, int>, double> counted;  // in view and seen: how often
  std::size_t all = 0;
  for (std::size_t f = 0; f < logs.size(); ++f) {
    const CalibrationLog& log = logs[f];
    const auto corners = fieldCorners(log.field);
    const auto delay = static_cast<std::size_t>(std::lround(motion.delay / log.period));
    for (std::size_t i = delay; i < log.rows.size(); ++i) {
      const MotionState& state = motion.ofLogs[f].states[i - delay];
      if (!state.known || !state.placed || filters[f].disturbed()[i]) continue;
      int inView = 0, seen = 0;
      bool sure = true;
      for (std::size_t c = 0; c < corners.size(); ++c) {
        const double bearing = wrapToPi(std::atan2(corners[c].y - state.mean[MotionState::Y],
                                                   corners[c].x - state.mean[MotionState::X]) -
                                        state.mean[MotionState::Yaw]);
        const double beyond = std::abs(bearing) - std::numbers::pi / 2.0;
        sure = sure && std::abs(beyond) > margin;
        if (beyond < 0.0) ++inView;
        if (log.rows[i].corners[c]) ++seen;
      }
      // Rows without any may be those in which localization has cleared the variables.
      if (!sure || seen == 0 || seen > inView) continue;
      counted[{inView, seen}] += 1.0;
      all += static_cast<std::size_t>(inView);
    }
  }
  if (all < 200) {
    out.kept[key] = "too few corners of the field were seen";
    return;
  }
  take(out, valueOf(key,
                    ratePosterior(out.base.noise.landmarkProbability,
                                  [&](double p) {
                                    double sum = 0.0;
                                    for (const auto& [what, times] : counted) {
                                      const auto [n, k] = what;
                                      // Binomial, given that at least one was seen.
                                      sum += times * (k * std::log(p) + (n - k) * std::log1p(-p) -
                                                      std::log1p(-std::pow(1.0 - p, n)));
                                    }
                                    return sum;
                                  }),
                    all, "corners in view"));
}

// ---- field of view and range
// -----------------------------------------------------------------------

/// Of every row: where the head looks, by the law of the simulated head: it follows a ball that is
/// seen, as fast as it can, and stays where it is while the ball is lost and nobody searches.
std::vector<std::optional<double>> headYaws(const CalibrationLog& log,
                                            const sim::RobotModel& base) {
  constexpr double settled = 1.5;  // s of following after which any head points at the ball
  std::vector<std::optional<double>> out(log.rows.size());
  std::optional<double> head;
  double seenSince = -1.0;
  for (std::size_t i = 1; i < log.rows.size(); ++i) {
    const CalibrationRow& row = log.rows[i];
    const double dt = row.time - log.rows[i - 1].time;
    if (row.ball) {
      if (seenSince < 0.0) seenSince = row.time;
      const double goal = std::clamp(row.ball->bearing, -base.panLimit, base.panLimit);
      const double most = base.headSpeed * dt;
      if (head) {
        head = *head + std::clamp(goal - *head, -most, most);
      } else if (row.time - seenSince > settled) {
        head = goal;
      }
    } else {
      if (log.rows[i - 1].searches || row.fallen || dt > 0.1) head.reset();
      if (i > 30 && !log.rows[i - 30].ball) seenSince = -1.0;
    }
    out[i] = head;
  }
  return out;
}

/// A ball that leaves the view or comes into it: the quantity that decides (an angle, a distance)
/// in the last row in which it was seen, and in the rows beyond.
struct Crossing {
  double seen = 0.0;
  std::vector<double> beyond;
  double sigma = 0.0;  ///< of the quantity, common to all of them

  /// P(data | threshold): beyond the threshold nothing is seen, within it a ball is missed with the
  /// probability `missed`.
  double likelihood(double threshold, double missed) const {
    if (seen > threshold) return 0.0;
    double out = 1.0;
    for (const double one : beyond) out *= one < threshold ? missed : 1.0;
    return out;
  }
};

/// A standard normal distribution at equally spaced places: place and weight.
template <int count>
std::array<std::pair<double, double>, count> normalNodes() {
  std::array<std::pair<double, double>, count> out{};
  for (int i = 0; i < count; ++i) {
    const double z = -3.0 + 6.0 * i / (count - 1);
    out[static_cast<std::size_t>(i)] = {z, std::exp(-0.5 * z * z)};
  }
  return out;
}

/// log P(data | threshold). The error of each crossing's quantity is integrated out. `common` of
/// its variance is the same for all crossings: that of where the ball lies.
double logLikelihood(const std::vector<Crossing>& all, double threshold, double missed,
                     double common) {
  static const std::array own = normalNodes<31>();
  static const std::array shared = normalNodes<11>();
  const double ownShare = std::sqrt(1.0 - common);
  const auto given = [&](double commonError) {
    double sum = 0.0;
    for (const Crossing& one : all) {
      double average = 0.0;
      for (const auto& [z, weight] : own) {
        const double error = (commonError + ownShare * z) * one.sigma;
        average += weight * one.likelihood(threshold - error, missed);
      }
      sum += std::log(std::max(average, 1e-30));
    }
    return sum;
  };
  if (common == 0.0) return given(0.0);
  std::array<double, shared.size()> logs{};
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const auto& [z, weight] = shared[i];
    logs[i] = std::log(weight) + given(std::sqrt(common) * z);
  }
  return logSumExp(logs);
}

struct Crossings {
  std::vector<Crossing> angles, distances;
};

void findCrossings(const CalibrationLog& log, const MotionFilter& filter,
                   const MotionFit::OfLog& fit, double delay_s, const sim::RobotModel& model,
                   Crossings& out) {
  constexpr double quiet = 0.3;              // s without the ball on the far side
  constexpr double stretch = 0.25;           // s that are looked at on the far side
  constexpr double crossingInterval = 10.0;  // s
  constexpr double later = 2.0;  // s after which the place of a ball that has come is known well
  const auto& rows = log.rows;
  if (log.period > coarsest || !log.has("VISION_LOST")) return;
  const auto heads = headYaws(log, model);
  const auto delay = static_cast<std::size_t>(std::lround(delay_s / log.period));
  const auto ticks = [&](double seconds) {
    return static_cast<std::size_t>(std::lround(seconds / log.period));
  };
  const std::size_t far = ticks(quiet), near = ticks(quiet);
  const auto seenAt = [&](std::size_t i) { return rows[i].ball.has_value(); };
  double lastAngle = -1e9, lastDistance = -1e9;  // s, of a crossing that counts
  const double farthest = defaultDistance(log);  // beyond, it may be the range that ends
  for (std::size_t i = near + delay + 1; i + near + delay + ticks(later) < rows.size(); ++i) {
    if (!seenAt(i)) continue;
    const auto none = [&](std::size_t from, std::size_t to) {
      for (std::size_t k = from; k <= to; ++k) {
        if (seenAt(k) || !rows[k].looksForBall || rows[k].fallen || filter.actions()[k].kicks) {
          return false;
        }
      }
      return true;
    };
    const auto most = [&](std::size_t from, std::size_t to) {
      std::size_t count = 0;
      for (std::size_t k = from; k <= to; ++k) count += seenAt(k) ? 1 : 0;
      return 2 * count > to - from + 1;
    };
    const bool leaves = none(i + 1, i + far) && most(i - near, i);
    const bool comes = none(i - far, i - 1) && most(i, i + near);
    if (leaves == comes) continue;
    const std::size_t image = i - delay;
    const std::size_t anchor = leaves ? image : image + ticks(later);
    const MotionState& known = fit.states[anchor];
    if (!known.known || !known.ballKnown) continue;
    struct Sight {
      double distance, angle;
    };
    const auto sightAt = [&](std::size_t k) -> std::optional<Sight> {
      const MotionState& state = fit.states[k];
      if (!state.known) return {};
      const double yaw = state.mean[MotionState::Yaw];
      const double x = known.mean[MotionState::X] + state.odometryX - known.odometryX +
                       model.cameraForward * std::cos(yaw);
      const double y = known.mean[MotionState::Y] + state.odometryY - known.odometryY +
                       model.cameraForward * std::sin(yaw);
      const double dx = known.mean[MotionState::BallX] - x;
      const double dy = known.mean[MotionState::BallY] - y;
      const double head = heads[k].value_or(0.0);
      return Sight{std::hypot(dx, dy), std::abs(wrapToPi(std::atan2(dy, dx) - yaw - head))};
    };
    const auto at = sightAt(image);
    if (!at) continue;
    // What the filter does not know of the ball as seen from the robot.
    const double dx = known.mean[MotionState::BallX] - known.mean[MotionState::X];
    const double dy = known.mean[MotionState::BallY] - known.mean[MotionState::Y];
    const double d = std::max(0.2, std::hypot(dx, dy));
    MotionState::Vector h = MotionState::Vector::Zero();
    h[MotionState::BallX] = dx / d;
    h[MotionState::BallY] = dy / d;
    h[MotionState::X] = -dx / d;
    h[MotionState::Y] = -dy / d;
    const double frames = leaves ? 8.0 : 60.0 * later;
    const double step = model.noise.forward * model.noise.forward * frames;
    const double radial = std::sqrt(h.dot(known.covariance * h) + step);
    h[MotionState::BallX] = -dy / (d * d);
    h[MotionState::BallY] = dx / (d * d);
    h[MotionState::X] = dy / (d * d);
    h[MotionState::Y] = -dx / (d * d);
    h[MotionState::Yaw] = -1.0;
    const double white = model.noise.imuWhite;
    const double round = std::sqrt(h.dot(known.covariance * h) + step / (d * d) + white * white);

    // In the middle of the picture it can only be too far away; at its edge only there.
    const bool byDistance = heads[image].has_value() && at->angle < 0.17 && at->distance > 1.0;
    const bool byAngle =
        heads[image].has_value() && at->angle > 0.26 && at->distance < 0.9 * farthest;
    if (!byDistance && !byAngle) continue;
    Crossing crossing;
    crossing.seen = byAngle ? at->angle : at->distance;
    crossing.sigma = byAngle ? round : radial;
    for (std::size_t n = 1; n <= ticks(stretch); ++n) {
      const auto next = sightAt(leaves ? image + n : image - n);
      if (!next || (leaves ? image + n : n) == 0) break;
      crossing.beyond.push_back(byAngle ? next->angle : next->distance);
    }
    if (crossing.beyond.empty() || crossing.beyond.back() <= crossing.seen) continue;
    // What the filter does not know of the ball is the same for crossings close together.
    double& last = byAngle ? lastAngle : lastDistance;
    if (rows[i].time - last < crossingInterval) continue;
    last = rows[i].time;
    (byAngle ? out.angles : out.distances).push_back(std::move(crossing));
  }
}

void fitView(std::span<const MotionFilter> filters, std::span<const CalibrationLog> logs,
             const MotionFit& motion, Calibration& out) {
  Crossings crossings;
  for (std::size_t f = 0; f < logs.size(); ++f) {
    findCrossings(logs[f], filters[f], motion.ofLogs[f], motion.delay, out.model, crossings);
  }
  const double missed = std::clamp(out.model.noise.missedDetection, 1e-6, 0.9);
  const auto fit = [&](const char* key, const std::vector<Crossing>& all, double common,
                       double base, double factor, const char* none) {
    if (all.empty()) {
      out.kept[key] = none;
      return;
    }
    const auto posterior = positivePosterior(
        base, viewPrior,
        [&](double value) { return logLikelihood(all, value * factor, missed, common); }, 6001);
    if (posterior.share > enough) {
      out.kept[key] = none;
      return;
    }
    take(out, valueOf(key, posterior, all.size(), "times the ball left or entered the view"));
  };
  fit("field_of_view", crossings.angles, 0.0, out.base.fieldOfView, 0.5,
      "the ball never left the view to the side of a head that had reached its limit");
  // As measured over recordings of robots whose range is known: the correlation between the errors
  // of two crossings (calibration_proof, seeds from 10001 on).
  constexpr double commonDistance = 0.4;
  const bool isPlayed = std::ranges::any_of(filters, [](const MotionFilter& one) {
    return std::ranges::find(one.ballMoves(), true) != one.ballMoves().end();
  });
  if (isPlayed) {
    out.kept["vision_range"] = "others moved the ball, and may have hidden it";
    return;
  }
  fit("vision_range", crossings.distances, commonDistance, out.base.visionRange, 1.0,
      "the ball was never seen just within the range and lost just beyond it");
}

// ---- other robots
// ------------------------------------------------------------------------------------

/// Sum of squares about a line through a few percepts.
struct LineFit {
  std::vector<double> times, values;
  double squares(double& freedom) const {
    const auto n = static_cast<double>(times.size());
    double t = 0.0, v = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      t += times[i] / n;
      v += values[i] / n;
    }
    double tt = 0.0, tv = 0.0, vv = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      tt += (times[i] - t) * (times[i] - t);
      tv += (times[i] - t) * (values[i] - v);
      vv += (values[i] - v) * (values[i] - v);
    }
    freedom += n - 2.0;
    return std::max(0.0, vv - (tt > 0.0 ? tv * tv / tt : 0.0));
  }
};

void fitRobots(std::span<const MotionFilter> filters, std::span<const CalibrationLog> logs,
               Calibration& out) {
  constexpr double piece = 1.0;  // s; within it another robot walks straight ahead or not at all
  constexpr std::size_t minPiece = 5;
  double distanceSum = 0.0, bearingSum = 0.0, freedom = 0.0;
  std::size_t samples = 0;
  for (std::size_t f = 0; f < logs.size(); ++f) {
    const CalibrationLog& log = logs[f];
    const auto& actions = filters[f].actions();
    std::vector<bool> stands(log.rows.size());
    double since = 0.0;
    for (std::size_t i = 0; i < log.rows.size(); ++i) {
      const bool moves = sim::gaitSpeed(out.base, actions[i].code, actions[i].b).inMotion;
      if (moves || actions[i].kicks || actions[i].down || i == 0) since = log.rows[i].time;
      stands[i] = log.rows[i].time - since > standing;
    }
    std::map<int, std::pair<LineFit, LineFit>> open;
    std::map<int, double> began;
    const auto close = [&](int robot) {
      auto& [distance, bearing] = open[robot];
      if (distance.times.size() >= minPiece) {
        samples += distance.times.size();
        double unused = 0.0;
        distanceSum += distance.squares(freedom);
        bearingSum += bearing.squares(unused);
      }
      distance = bearing = {};
    };
    for (const SeenRobotPercept& seen : log.robots) {
      if (seen.row >= log.rows.size() || !stands[seen.row]) continue;
      const double time = log.rows[seen.row].time;
      auto& [distance, bearing] = open[seen.robot];
      if (!distance.times.empty() && time - began[seen.robot] > piece) close(seen.robot);
      if (distance.times.empty()) began[seen.robot] = time;
      distance.times.push_back(time);
      distance.values.push_back(seen.seen.distance);
      bearing.times.push_back(time);
      bearing.values.push_back(bearing.values.empty()
                                   ? seen.seen.bearing
                                   : bearing.values.front() +
                                         wrapToPi(seen.seen.bearing - bearing.values.front()));
    }
    for (const auto& [robot, unused] : began) close(robot);
  }
  const auto fit = [&](const char* key, double base, double least, double squares) {
    if (freedom < 20.0) {
      out.kept[key] = "the robot did not look at another robot while it stood";
      return;
    }
    const auto posterior = positivePosterior(
        base > 0.0 ? base : least, sigmaPrior,
        [&](double sigma) { return -freedom * std::log(sigma) - squares / (2.0 * sigma * sigma); });
    take(out, valueOf(key, posterior, samples, "percepts"));
  };
  fit("noise.robot_distance", out.base.noise.robotDistance, 0.1, distanceSum);
  fit("noise.robot_bearing", out.base.noise.robotBearing, 0.03, bearingSum);
}

}  // namespace

void fitPercepts(std::span<const MotionFilter> filters, std::span<const CalibrationLog> logs,
                 const MotionFit& motion, Calibration& out) {
  fitMissed(logs, out);
  fitCorners(filters, logs, motion, out);
  fitView(filters, logs, motion, out);
  fitRobots(filters, logs, out);
}

}  // namespace pitchboard::link
