// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <base/angles.h>

namespace pitchboard::link {
namespace {

constexpr double tick = 1.0 / 60.0;
constexpr int longestDelayTicks = 30;
constexpr double leastDelay = 0.02;  // s, median of the prior where the base model has none
constexpr double derivativeStep = 1e-4;
constexpr int mostRounds = 25;
constexpr double skewedFrom = 0.12;   // of a logarithm's deviation
constexpr double nearEnough = 0.1;    // of a posterior deviation, while the delay is looked for
constexpr double closeEnough = 0.01;  // at last

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
constexpr auto count = static_cast<Eigen::Index>(motionParameterCount);

/// Standard deviation of noise from second differences, which a smooth motion does not change:
/// median of |a - 2b + c| / (0.6745 sqrt 6), Rousseeuw and Croux (1993).
class SecondDifferences {
 public:
  void add(double time, double value, bool angle) {
    if (m_count >= 2 && time - m_times[0] < 0.2) {
      double first = m_values[1] - m_values[0], second = value - m_values[1];
      if (angle) {
        first = wrapToPi(first);
        second = wrapToPi(second);
      }
      m_sizes.push_back(std::abs(second - first));
    }
    m_times = {m_times[1], time};
    m_values = {m_values[1], value};
    ++m_count;
  }
  std::optional<double> sigma() {
    if (m_sizes.size() < 30) return {};
    const auto middle = m_sizes.begin() + static_cast<std::ptrdiff_t>(m_sizes.size() / 2);
    std::nth_element(m_sizes.begin(), middle, m_sizes.end());
    const double out = *middle / (0.6745 * std::sqrt(6.0));
    return out > 0.0 ? std::optional<double>(out) : std::nullopt;
  }

 private:
  std::array<double, 2> m_times{-1e9, -1e9}, m_values{};
  int m_count = 0;
  std::vector<double> m_sizes;
};

/// Where the search begins: the prior, with the noise of the senses as differences show it, so that
/// the first gate of outliers is of the right size.
MotionLogs firstGuess(std::span<const CalibrationLog> logs, const MotionLogs& prior) {
  SecondDifferences imu, distance, bearing;
  std::array<SecondDifferences, 4> corners;
  for (const CalibrationLog& log : logs) {
    for (const CalibrationRow& row : log.rows) {
      if (row.imuYaw) imu.add(row.time, *row.imuYaw, true);
      if (row.ball) {
        distance.add(row.time, std::log(std::max(0.05, row.ball->distance)), false);
        bearing.add(row.time, row.ball->bearing, true);
      }
      for (std::size_t i = 0; i < corners.size(); ++i) {
        if (row.corners[i]) corners[i].add(row.time, *row.corners[i], true);
      }
    }
  }
  MotionLogs out = prior;
  const auto take = [&](std::size_t parameter, std::optional<double> sigma) {
    if (!sigma) return;
    out[parameter] = std::clamp(std::log(*sigma), prior[parameter] - 3.0 * sigmaPrior,
                                prior[parameter] + 3.0 * sigmaPrior);
  };
  take(motionImuWhite, imu.sigma());
  take(motionBallDistance, distance.sigma());
  take(motionBallBearing, bearing.sigma());
  std::optional<double> corner;
  for (SecondDifferences& one : corners) {
    if (const auto sigma = one.sigma()) corner = corner ? std::min(*corner, *sigma) : *sigma;
  }
  take(motionLandmark, corner);
  return out;
}

/// The search and what it keeps from round to round.
class Scoring {
 public:
  Scoring(std::span<const MotionFilter> filters, const sim::RobotModel& base)
      : m_filters(filters), m_base(base), m_prior(motionPrior(base)), m_decisions(filters.size()) {
    for (std::size_t i = 0; i < m_prior.size(); ++i) {
      m_precision[static_cast<Eigen::Index>(i)] =
          1.0 / (motionParameters[i].prior * motionParameters[i].prior);
    }
  }

  double delay = 0.0;
  MotionLogs logs{};
  Matrix information;  // of the likelihood, at `logs`

  const MotionLogs& prior() const { return m_prior; }
  void decideAnew() {
    for (FilterDecisions& one : m_decisions) one.recorded = false;
  }
  std::vector<FilterDecisions>& decisions() { return m_decisions; }

  sim::RobotModel modelAt(const MotionLogs& at) const {
    sim::RobotModel model = m_base;
    setMotion(model, at);
    return model;
  }

  double logPosterior(const MotionLogs& at, double atDelay) {
    double sum = 0.0;
    const sim::RobotModel model = modelAt(at);
    for (std::size_t f = 0; f < m_filters.size(); ++f) {
      m_filters[f].run(model, atDelay, m_decisions[f], m_scratch);
      sum += logLikelihood(m_scratch);
    }
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double off = at[i] - m_prior[i];
      sum -= 0.5 * off * off * m_precision[static_cast<Eigen::Index>(i)];
    }
    return sum;
  }

  /// One step of scoring; the length of the step in posterior deviations, largest component.
  double step() {
    Vector gradient = Vector::Zero(count);
    information = Matrix::Zero(count, count);
    double now = 0.0;
    for (std::size_t f = 0; f < m_filters.size(); ++f) now += addDerivatives(f, gradient);
    for (std::size_t i = 0; i < logs.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      gradient[k] -= m_precision[k] * (logs[i] - m_prior[i]);
      const double off = logs[i] - m_prior[i];
      now -= 0.5 * off * off * m_precision[k];
    }
    Matrix whole = information;
    whole.diagonal() += m_precision;
    const Eigen::LDLT<Matrix> solver(whole);
    Vector move = solver.solve(gradient);
    const Vector deviations =
        solver.solve(Matrix::Identity(count, count)).diagonal().cwiseMax(1e-16).cwiseSqrt();
    for (int halving = 0; halving < 8; ++halving) {
      const double longest = move.cwiseAbs().maxCoeff();
      if (longest > 1.0) move *= 1.0 / longest;
      MotionLogs next = logs;
      for (std::size_t i = 0; i < next.size(); ++i) {
        next[i] += move[static_cast<Eigen::Index>(i)];
      }
      const double after = logPosterior(next, delay);
      if (after >= now - 1e-6) {
        logs = next;
        return move.cwiseQuotient(deviations).cwiseAbs().maxCoeff();
      }
      move *= 0.4;
    }
    return 0.0;
  }

  /// Until a step is smaller than `enough` posterior deviations. False if cancelled.
  bool search(double enough, const std::function<bool()>& goOn) {
    for (int round = 0; round < mostRounds; ++round) {
      if (!goOn()) return false;
      if (step() < enough) break;
    }
    return true;
  }

 private:
  /// Adds gradient and information of one recording; gives its log-likelihood.
  double addDerivatives(std::size_t f, Vector& gradient) {
    m_filters[f].run(modelAt(logs), delay, m_decisions[f], m_centre);
    const auto rows = static_cast<Eigen::Index>(m_centre.size());
    m_values.resize(rows, count);
    m_variances.resize(rows, count);
    for (Eigen::Index p = 0; p < count; ++p) {
      MotionLogs at = logs;
      at[static_cast<std::size_t>(p)] += derivativeStep;
      m_filters[f].run(modelAt(at), delay, m_decisions[f], m_scratch);
      for (Eigen::Index i = 0; i < rows; ++i) {
        const auto k = static_cast<std::size_t>(i);
        // Divided by sqrt(S) and by S, so that the sums below are plain products.
        const double variance = m_centre[k].variance;
        const bool same = k < m_scratch.size() && m_scratch[k].sense == m_centre[k].sense;
        m_values(i, p) =
            same ? (m_scratch[k].value - m_centre[k].value) / (derivativeStep * std::sqrt(variance))
                 : 0.0;
        m_variances(i, p) =
            same ? (m_scratch[k].variance - m_centre[k].variance) / (derivativeStep * variance)
                 : 0.0;
      }
    }
    Vector share(rows), excess(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const Innovation& one = m_centre[static_cast<std::size_t>(i)];
      share[i] = one.value / std::sqrt(one.variance);
      excess[i] = share[i] * share[i] - 1.0;
    }
    gradient -= m_values.transpose() * share;
    gradient += 0.5 * (m_variances.transpose() * excess);
    information.noalias() += m_values.transpose() * m_values;
    information.noalias() += 0.5 * (m_variances.transpose() * m_variances);
    return logLikelihood(m_centre);
  }

  std::span<const MotionFilter> m_filters;
  const sim::RobotModel& m_base;
  MotionLogs m_prior;
  Eigen::Matrix<double, count, 1> m_precision;
  std::vector<FilterDecisions> m_decisions;
  std::vector<Innovation> m_centre, m_scratch;
  Matrix m_values, m_variances;
};

/// Posterior over the delay: the program sees whole ticks only, so that every number of a cell of
/// one tick has the same likelihood.
struct DelayPosterior {
  GridPosterior grid;
  int best = 0;
  double share = 1.0;  ///< deviation as a share of the prior's
};

DelayPosterior delayPosterior(Scoring& scoring, double prior) {
  std::array<double, longestDelayTicks + 1> likelihood{};
  DelayPosterior out;
  for (int d = 0; d <= longestDelayTicks; ++d) {
    // Other delays give other measurements their turn first: decisions are made anew for each.
    scoring.decideAnew();
    likelihood[static_cast<std::size_t>(d)] = scoring.logPosterior(scoring.logs, d * tick);
    if (likelihood[static_cast<std::size_t>(d)] > likelihood[static_cast<std::size_t>(out.best)]) {
      out.best = d;
    }
  }
  constexpr int perTick = 40;
  constexpr double cell = tick / perTick;
  const auto place = [](int i) { return (i + 0.5) * cell; };
  const int cells = longestDelayTicks * perTick;
  const auto weight = [&](int i, bool data) {
    const double value = place(i);
    const double z = std::log(value / prior) / sigmaPrior;
    const auto d = static_cast<std::size_t>(std::lround(value / tick));
    return -0.5 * z * z - std::log(value) + (data ? likelihood[d] : 0.0);
  };
  out.grid = posteriorOn(cells, place, [&](int i) { return weight(i, true); });
  const GridPosterior before = posteriorOn(cells, place, [&](int i) { return weight(i, false); });
  out.share = out.grid.deviation / before.deviation;
  return out;
}

/// Posterior of one logarithm from the likelihood itself: `direction` is how all of them move with
/// one deviation of it.
GridPosterior marginalAlong(Scoring& scoring, std::size_t parameter,
                            const Eigen::VectorXd& direction) {
  constexpr int points = 11;
  constexpr double reach = 3.75;
  std::vector<double> weights;
  for (int k = 0; k < points; ++k) {
    const double t = reach * (2.0 * k / (points - 1) - 1.0);
    MotionLogs at = scoring.logs;
    for (std::size_t i = 0; i < at.size(); ++i)
      at[i] += t * direction[static_cast<Eigen::Index>(i)];
    weights.push_back(scoring.logPosterior(at, scoring.delay));
  }
  constexpr int fine = 601;
  const double own = direction[static_cast<Eigen::Index>(parameter)];
  return posteriorOn(
      fine,
      [&](int i) { return scoring.logs[parameter] + own * reach * (2.0 * i / (fine - 1) - 1.0); },
      [&](int i) { return parabolaAt(weights, (points - 1.0) * i / (fine - 1)); });
}

}  // namespace

MotionFit fitMotion(std::span<const MotionFilter> filters, std::span<const CalibrationLog> logs,
                    const sim::RobotModel& base, const std::function<bool(double)>& progress) {
  Scoring scoring(filters, base);
  scoring.logs = firstGuess(logs, scoring.prior());
  const double prior = base.noise.visionDelay > 0.0 ? base.noise.visionDelay : leastDelay;
  scoring.delay = std::round(prior / tick) * tick;
  MotionFit fit;
  const auto goOn = [&](double part) { return !progress || progress(part); };
  DelayPosterior delay;
  for (int round = 0; round < 4; ++round) {
    scoring.decideAnew();
    const double part = 0.25 * round;
    if (!scoring.search(nearEnough, [&] { return goOn(part); })) return fit;
    delay = delayPosterior(scoring, prior);
    const double best = delay.best * tick;
    if (round > 0 && best == scoring.delay) break;
    scoring.delay = best;
  }
  scoring.decideAnew();
  if (!scoring.search(closeEnough, [&] { return goOn(0.8); })) return fit;
  scoring.step();  // the information at the mode

  fit.logs = scoring.logs;
  fit.delay = scoring.delay;
  fit.delayPosterior = delay.grid;
  fit.delayKnown = delay.share < 0.7;
  Matrix whole = scoring.information;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double sigma = motionParameters[static_cast<std::size_t>(i)].prior;
    whole(i, i) += 1.0 / (sigma * sigma);
  }
  fit.covariance = whole.ldlt().solve(Matrix::Identity(count, count));
  for (std::size_t i = 0; i < fit.information.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double sigma = motionParameters[i].prior;
    fit.information[i] = 1.0 - fit.covariance(k, k) / (sigma * sigma);
  }
  for (std::size_t i = motionNoiseForward; i < motionParameterCount; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double deviation = std::sqrt(fit.covariance(k, k));
    if (deviation < skewedFrom || fit.information[i] < 0.1) continue;
    if (!goOn(0.9)) return {};
    fit.marginals[i] = marginalAlong(scoring, i, fit.covariance.col(k) / deviation);
  }
  fit.model = scoring.modelAt(fit.logs);
  fit.model.noise.visionDelay = fit.delayKnown ? fit.delayPosterior.median : base.noise.visionDelay;
  for (std::size_t f = 0; f < filters.size(); ++f) {
    MotionFit::OfLog one;
    filters[f].run(fit.model, fit.delay, one.decisions, one.innovations, &one.states);
    fit.ofLogs.push_back(std::move(one));
  }
  return fit;
}

}  // namespace pitchboard::link
