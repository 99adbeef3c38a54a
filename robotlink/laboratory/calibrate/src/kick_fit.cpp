// SPDX-License-Identifier: GPL-3.0-or-later
#include "kick_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <base/angles.h>
#include <simcore/world/action.h>

#include "kick_track.h"
#include "percept_fit.h"

namespace pitchboard::link {
namespace {

constexpr std::size_t minKicks = 3;    // of a kind
constexpr double slowest = 0.25;       // m/s; a ball that is slower was not hit
constexpr double worstFit = 6.0;       // sigmas of the mean square; beyond, something was hit
constexpr double surfacePrior = 0.35;  // of the logarithm of the rolling deceleration
constexpr double surfaceMedian = 0.3;  // m/s^2, grass (simcore/world/field.h)

// A ball that was touched before the foot hit it seems to begin to roll some ticks early: this much
// on average. Some robots touch it more often than others, as measured over recordings of robots
// whose contact is known (calibration_proof, seeds 801 to 1000 and from 10001 on).
constexpr double touchedEarly = 2.5 * kickTick;
constexpr std::array touchedShares{0.05, 0.2, 0.5};  // of a robot's kicks; equally likely

/// The kicks as they are fitted with one rolling deceleration, and the logarithm of its posterior.
struct KicksAt {
  double logWeight = 0.0;
  std::vector<double> begins, variances;  ///< of each kick: when the ball begins to roll, s
};
struct RollingFit {
  GridPosterior posterior;
  std::vector<KicksAt> candidates;
};

/// By how much the residuals' squares exceed what the percepts' sigmas explain, at least 1 (the
/// Birge ratio; Birge 1932).
double scatterOf(const std::vector<Kick>& kicks) {
  double chi2 = 0.0, freedom = 0.0;
  for (const Kick& kick : kicks) {
    chi2 += kick.chi2;
    freedom += static_cast<double>(2 * kick.sights.size()) - 5.0;
  }
  return freedom > 0.0 ? std::max(1.0, chi2 / freedom) : 1.0;
}

/// Rolling deceleration: all tracks share it; for each candidate every track is fitted again.
RollingFit fitRolling(const std::vector<Kick>& kicks) {
  constexpr int candidates = 41;
  std::vector<double> chi2(candidates);
  RollingFit out;
  const double scatter = scatterOf(kicks);
  const auto zAt = [](double i) { return -3.5 + 7.0 * i / (candidates - 1); };
  const auto at = [&](double i) { return surfaceMedian * std::exp(surfacePrior * zAt(i)); };
  for (int i = 0; i < candidates; ++i) {
    KicksAt& here = out.candidates.emplace_back();
    double& sum = chi2[static_cast<std::size_t>(i)];
    for (Kick kick : kicks) {
      fitKick(kick, at(i));
      sum += kick.chi2 / scatter;
      here.begins.push_back(kick.fitted[2]);
      here.variances.push_back(scatter * kick.covariance(2, 2));
    }
    here.logWeight = -0.5 * (sum + zAt(i) * zAt(i));
  }
  // Between the candidates by parabolas through three of them.
  constexpr int fine = 1201;
  const auto index = [](int k) { return static_cast<double>(k) * (candidates - 1) / (fine - 1); };
  out.posterior = posteriorOn(
      fine, [&](int k) { return at(index(k)); },
      [&](int k) {
        const double z = zAt(index(k));
        return -0.5 * (parabolaAt(chi2, index(k)) + z * z);
      });
  return out;
}

/// Speeds of all kinds with one common spread: v_i ~ N(mean_kind x share_i, spread^2 + s_i^2), on a
/// grid of spread and mean.
void fitSpeeds(const std::vector<Kick>& kicks, Calibration& out) {
  const std::array<const char*, kickKinds> keys{"kick_speed", "weak_kick_speed", "pass_speed"};
  const std::array<double, kickKinds> bases{out.base.kickSpeed, out.base.weakKickSpeed,
                                            out.base.passSpeed};
  constexpr int means = 301, spreads = 121;
  constexpr double reach = 3.5;
  const double spreadBase = out.base.noise.kickSpeed > 0.0 ? out.base.noise.kickSpeed : 0.1;
  const auto spreadAt = [&](int i) {
    return spreadBase * std::exp(sigmaPrior * reach * (2.0 * i / (spreads - 1) - 1.0));
  };
  struct OfKind {
    std::vector<double> speed, variance, share;
    std::vector<std::array<double, means>> joint;  // by spread
    std::array<double, spreads> marginal{};        // log, over the mean
  };
  std::array<OfKind, kickKinds> kinds;
  std::size_t all = 0;
  for (const Kick& kick : kicks) {
    OfKind& kind = kinds[kindOf(kick.code)];
    kind.speed.push_back(kick.speed());
    kind.variance.push_back(kick.speedVariance());
    kind.share.push_back(footShare(out.base, kick));
  }
  const auto meanAt = [&](std::size_t k, int i) {
    return bases[k] * std::exp(speedPrior * reach * (2.0 * i / (means - 1) - 1.0));
  };
  for (std::size_t k = 0; k < kickKinds; ++k) {
    OfKind& kind = kinds[k];
    if (kind.speed.size() < minKicks) continue;
    all += kind.speed.size();
    kind.joint.resize(spreads);
    for (int s = 0; s < spreads; ++s) {
      auto& row = kind.joint[static_cast<std::size_t>(s)];
      for (int m = 0; m < means; ++m) {
        const double z = reach * (2.0 * m / (means - 1) - 1.0);
        double sum = -0.5 * z * z;
        for (std::size_t i = 0; i < kind.speed.size(); ++i) {
          const double variance = spreadAt(s) * spreadAt(s) + kind.variance[i];
          const double off = kind.speed[i] - meanAt(k, m) * kind.share[i];
          sum -= 0.5 * (off * off / variance + std::log(variance));
        }
        row[static_cast<std::size_t>(m)] = sum;
      }
      kind.marginal[static_cast<std::size_t>(s)] = logSumExp(row);
    }
  }
  const auto spreadWeight = [&](int s, std::size_t without) {
    const double z = reach * (2.0 * s / (spreads - 1) - 1.0);
    double sum = -0.5 * z * z;
    for (std::size_t k = 0; k < kickKinds; ++k) {
      if (k != without && !kinds[k].joint.empty()) {
        sum += kinds[k].marginal[static_cast<std::size_t>(s)];
      }
    }
    return sum;
  };
  for (std::size_t k = 0; k < kickKinds; ++k) {
    const OfKind& kind = kinds[k];
    if (kind.joint.empty()) {
      out.kept[keys[k]] = std::to_string(kind.speed.size()) + " such kicks were seen; " +
                          std::to_string(minKicks) + " are needed";
      continue;
    }
    const GridPosterior posterior = posteriorOn(
        means, [&](int m) { return meanAt(k, m); },
        [&](int m) {
          std::array<double, spreads> logs{};
          for (std::size_t s = 0; s < spreads; ++s) {
            logs[s] =
                spreadWeight(static_cast<int>(s), k) + kind.joint[s][static_cast<std::size_t>(m)];
          }
          return logSumExp(logs);
        });
    take(out,
         {keys[k], posterior.median, posterior.low, posterior.high, kind.speed.size(), "kicks"});
  }
  if (all < minKicks + 2) {
    out.kept["noise.kick_speed"] = "too few kicks were seen";
    return;
  }
  const GridPosterior spread =
      posteriorOn(spreads, spreadAt, [&](int s) { return spreadWeight(s, kickKinds); });
  take(out, {"noise.kick_speed", spread.median, spread.low, spread.high, all, "kicks"});
}

void fitDirections(const std::vector<Kick>& kicks, Calibration& out) {
  if (kicks.size() < minKicks + 2) {
    out.kept["noise.kick_angle"] = "too few kicks were seen";
    return;
  }
  const double base = out.base.noise.kickAngle > 0.0 ? out.base.noise.kickAngle : 0.05;
  const auto posterior = positivePosterior(base, sigmaPrior, [&](double sigma) {
    double sum = 0.0;
    for (const Kick& kick : kicks) {
      const sim::Action* action = sim::findAction(kick.code);
      const double aim = radiansFromDegrees(action != nullptr ? action->kick.direction : 0.0);
      const double off = wrapToPi(kick.direction() - kick.yawAtContact - aim);
      const double variance = sigma * sigma + kick.directionVariance();
      sum -= 0.5 * (off * off / variance + std::log(variance));
    }
    return sum;
  });
  take(out, {"noise.kick_angle", posterior.median, posterior.low, posterior.high, kicks.size(),
             "kicks"});
}

/// Each candidate with each likely delay between an image and its percepts: the shorter the delay,
/// the later the kicks began.
std::vector<KicksAt> withDelays(std::span<const KicksAt> candidates, const MotionFit& motion) {
  constexpr double unlikely = 1e-4;
  std::vector<KicksAt> out;
  for (std::size_t ticks = 0; ticks < motion.delayOfTicks.size(); ++ticks) {
    const double share = motion.delayOfTicks[ticks];
    if (share < unlikely) continue;
    const double later = motion.delay - static_cast<double>(ticks) * kickTick;
    for (const KicksAt& candidate : candidates) {
      KicksAt& one = out.emplace_back(candidate);
      one.logWeight += std::log(share);
      for (double& begin : one.begins) begin += later;
    }
  }
  return out;
}

/// How likely a ball that the foot hits at `contact` is seen to begin to roll at `begin`.
struct BeginDensity {
  double untouched, touched;

  /// A normal distribution; if the ball was touched, less an exponential one (Grushka, Analytical
  /// Chemistry 44, 1972).
  BeginDensity(double begin, double variance, double contact) {
    const double early = contact - begin, deviation = std::sqrt(variance);
    untouched =
        std::exp(-0.5 * early * early / variance) / (deviation * std::sqrt(2.0 * std::numbers::pi));
    const double far = (variance / touchedEarly - early) / (std::numbers::sqrt2 * deviation);
    constexpr double negligible = 25.0;
    touched = far > negligible
                  ? 0.0
                  : 0.5 / touchedEarly *
                        std::exp((0.5 * variance / touchedEarly - early) / touchedEarly) *
                        std::erfc(far);
  }
};

/// The moment of the contact: the ball begins to roll with a tick, so that all numbers of one tick
/// look the same. A ball that loses its speed faster began later: mixed over the decelerations that
/// are likely, and over how often the robot touches the ball before.
void fitContact(std::span<const KicksAt> candidates, Calibration& out) {
  const char* key = "kick_contact";
  const std::size_t kicks = candidates.empty() ? 0 : candidates.front().begins.size();
  if (out.base.kickContact <= 0.0 || kicks < minKicks) {
    out.kept[key] = "too few kicks were seen";
    return;
  }
  std::vector<double> sums(candidates.size() * touchedShares.size());
  const auto logLikelihood = [&](double starts) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const auto& [logWeight, begins, variances] = candidates[i];
      double* const of = &sums[i * touchedShares.size()];
      std::fill_n(of, touchedShares.size(), logWeight);
      for (std::size_t k = 0; k < kicks; ++k) {
        const BeginDensity density(begins[k], variances[k] + 1e-6, starts);
        for (std::size_t s = 0; s < touchedShares.size(); ++s) {
          of[s] += std::log(1e-300 + (1.0 - touchedShares[s]) * density.untouched +
                            touchedShares[s] * density.touched);
        }
      }
    }
    return logSumExp(sums);
  };
  std::map<double, double> known;  // of each tick
  const auto posterior = positivePosterior(
      out.base.kickContact, speedPrior,
      [&](double contact) {
        const double starts = std::floor(contact / kickTick + 1e-6) * kickTick;
        const auto [found, isNew] = known.try_emplace(starts);
        if (isNew) found->second = logLikelihood(starts);
        return found->second;
      },
      6001);
  take(out, {key, posterior.median, posterior.low, posterior.high, kicks, "kicks"});
}

/// Times that are seen as a number of rows: what is left of the prior in the cell that all of them
/// have in common.
void fitCell(const char* key, double base, const std::vector<std::pair<double, double>>& cells,
             Calibration& out, const char* of, const char* none) {
  if (cells.empty() || base <= 0.0) {
    out.kept[key] = none;
    return;
  }
  const auto posterior = positivePosterior(
      base, speedPrior,
      [&](double value) {
        double sum = 0.0;
        for (const auto& [low, high] : cells) sum += value > low && value <= high ? 0.0 : -20.0;
        return sum;
      },
      20001);
  take(out, {key, posterior.median, posterior.low, posterior.high, cells.size(), of});
}

void fitTimes(std::span<const MotionFilter> filters, std::span<const CalibrationLog> logs,
              Calibration& out) {
  std::vector<std::pair<double, double>> kicks, front, back;
  for (std::size_t f = 0; f < logs.size(); ++f) {
    const auto& rows = logs[f].rows;
    const auto& actions = filters[f].actions();
    const double coarse = logs[f].period > 1.5 * kickTick ? logs[f].period : 0.0;
    const auto cell = [&](double seconds) {
      return std::pair{seconds - std::max(kickTick, coarse) - 1e-6, seconds + coarse + 1e-6};
    };
    for (std::size_t i = 1; i < rows.size(); ++i) {
      if (actions[i].kicks && actions[i].began && logs[f].has("CONTROL_MOVING")) {
        std::size_t end = i;
        while (end < rows.size() && actions[end].kicks) ++end;
        if (end < rows.size() && rows[end].time - rows[end - 1].time < 0.3) {
          kicks.push_back(cell(rows[end].time - rows[i].time));
        }
      }
      // Control says 15 or 16 while the robot gets up (docs/reference/SYSTEM.md).
      const int up = rows[i].action;
      if (rows[i].fallen && rows[i - 1].fallen && (up == 15 || up == 16) &&
          rows[i - 1].action != up) {
        std::size_t end = i;
        while (end < rows.size() && rows[end].fallen) ++end;
        if (end < rows.size()) {
          (up == 15 ? front : back).push_back(cell(rows[end].time - rows[i].time));
        }
      }
    }
  }
  fitCell("kick_time", out.base.kickTime, kicks, out, "kicks", "no whole kick was recorded");
  fitCell("get_up_front", out.base.getUpFront, front, out, "times",
          "the robot did not get up from its front");
  fitCell("get_up_back", out.base.getUpBack, back, out, "times",
          "the robot did not get up from its back");
}

/// Whether another robot is seen so near that it may touch the ball that is kicked in row `first`.
bool isContested(const CalibrationLog& log, const sim::RobotModel& base, std::size_t first) {
  constexpr double from = -1.0, until = 2.5;  // s
  constexpr double tooNear = 2.0;             // m
  return std::ranges::any_of(log.robots, [&](const SeenRobotPercept& seen) {
    if (seen.row >= log.rows.size()) return false;
    const double later = log.rows[seen.row].time - log.rows[first].time;
    return later > from && later < until && groundDistance(base, seen.seen.distance, 0.0) < tooNear;
  });
}

}  // namespace

void fitKicks(std::span<const MotionFilter> filters, std::span<const CalibrationLog> logs,
              const MotionFit& motion, Calibration& out) {
  std::vector<Kick> kicks;
  bool rollsEvenly = true;
  for (std::size_t f = 0; f < logs.size(); ++f) {
    rollsEvenly = rollsEvenly && logs[f].field.surface.keptPerFrame == 1.0;
    const auto& actions = filters[f].actions();
    for (std::size_t i = 0; i < actions.size(); ++i) {
      if (!actions[i].kicks || !actions[i].began || isContested(logs[f], out.base, i)) continue;
      if (auto kick = kickAt(logs[f], filters[f], motion.ofLogs[f], motion, i)) {
        kicks.push_back(std::move(*kick));
      }
    }
  }
  double loss = surfaceMedian;
  const auto keepGood = [&] {
    for (Kick& kick : kicks) fitKick(kick, loss);
    std::erase_if(kicks, [](const Kick& kick) {
      const auto freedom = static_cast<double>(2 * kick.sights.size());
      return kick.speed() < slowest || kick.chi2 > freedom + worstFit * std::sqrt(2.0 * freedom);
    });
  };
  keepGood();
  if (kicks.size() >= minKicks && rollsEvenly) {
    // Whether a track is good depends on the deceleration: once more with the one that was found.
    loss = fitRolling(kicks).posterior.median;
    keepGood();
  }
  const char* key = "field.rolling_deceleration";
  std::vector<KicksAt> candidates;
  if (kicks.size() < minKicks || !rollsEvenly) {
    out.kept[key] = rollsEvenly ? "too few kicks were seen"
                                : "the ball does not roll with an even deceleration there";
    KicksAt& usual = candidates.emplace_back();
    for (const Kick& kick : kicks) {
      usual.begins.push_back(kick.fitted[2]);
      usual.variances.push_back(kick.covariance(2, 2));
    }
  } else {
    RollingFit rolling = fitRolling(kicks);
    for (Kick& kick : kicks) fitKick(kick, rolling.posterior.median);
    take(out, {key, rolling.posterior.median, rolling.posterior.low, rolling.posterior.high,
               kicks.size(), "kicks"});
    candidates = std::move(rolling.candidates);
  }
  const double scatter = scatterOf(kicks);
  for (Kick& kick : kicks) kick.covariance *= scatter;
  fitSpeeds(kicks, out);
  fitDirections(kicks, out);
  fitContact(withDelays(candidates, motion), out);
  fitTimes(filters, logs, out);
}

}  // namespace pitchboard::link
