// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <optional>

#include <base/angles.h>

#include "touched_noise.h"

namespace pitchboard::link {
namespace {

constexpr double tick = 1.0 / 60.0;
constexpr int maxDelayTicks = 30;
constexpr double minDelay = 0.02;  // s, median of the prior where the base model has none
constexpr double derivativeStep = 1e-4;
constexpr int maxRounds = 25;
constexpr double skewedFrom = 0.12;   // of a logarithm's deviation
constexpr double nearEnough = 0.2;    // of a posterior deviation, while the delay is looked for
constexpr double closeEnough = 0.03;  // at last
constexpr double knownSpeed = 0.05;   // of the logarithm, after the first search
constexpr double blockLength = 10.0;  // s; innovations farther apart are not alike
constexpr double minBlocks = 12.0;
// Among others a robot is also touched too weakly to be noticed: by so much larger the deviations
// were than the likelihood says (calibration_proof with `match`).
constexpr double weakTouches = 1.25;
constexpr double likelyNoise = 2.0;  // times the prior's median, of a gait that may be pushed

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
  Scoring(std::span<MotionFilter> filters, const sim::RobotModel& base)
      : m_filters(filters), m_base(base), m_prior(motionPrior(base)), m_decisions(filters.size()) {
    for (std::size_t i = 0; i < m_prior.size(); ++i) {
      m_precision[static_cast<Eigen::Index>(i)] =
          1.0 / (motionParameters[i].prior * motionParameters[i].prior);
    }
  }

  double delay = 0.0;
  MotionLogs logs{};

  const MotionLogs& prior() const { return m_prior; }
  void decideAnew() {
    for (FilterDecisions& one : m_decisions) one.recorded = false;
  }
  /// Also where the robot is at the beginning and where it is disturbed, by the gait as it is known
  /// now.
  void startAnew(double gaitSpread) {
    decideAnew();
    sim::RobotModel known = modelAt(logs);
    for (MotionFilter& one : m_filters) one.findDisturbed(known, delay);
    if (!m_jumpsKnown) {
      // So far they were taken for noise of the gait.
      for (const std::size_t noise : {motionNoiseForward, motionNoiseSideways}) {
        double& value = valueOf(known, motionParameters[noise]);
        value = std::min(value, likelyNoise * std::exp(m_prior[noise]));
      }
    }
    m_jumpsKnown = true;
    for (MotionFilter& one : m_filters) one.findJumps(known, delay);
    for (FilterDecisions& one : m_decisions) {
      one.starts.clear();
      one.gaitSpread = gaitSpread;
    }
  }
  std::size_t outliers() const {
    std::size_t sum = 0;
    for (const FilterDecisions& one : m_decisions) sum += one.outliers;
    return sum;
  }

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

  /// Of the log posterior; `precision` is the expected information and the prior's.
  struct Derivatives {
    double value = 0.0;
    Vector gradient = Vector::Zero(count);
    Matrix precision = Matrix::Zero(count, count);
  };
  Derivatives derivativesAt(const MotionLogs& at) {
    Derivatives out;
    m_blocks.clear();
    for (std::size_t f = 0; f < m_filters.size(); ++f) addDerivatives(f, at, out);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const double off = at[i] - m_prior[i];
      out.gradient[k] -= m_precision[k] * off;
      out.value -= 0.5 * off * off * m_precision[k];
    }
    out.precision.diagonal() += m_precision;
    return out;
  }

  /// By which factor the deviations of the posterior have to be larger than `here`, the derivatives
  /// at the mode that were found last, says, because the innovations are alike over time or not as
  /// the model has them: the covariance of the estimates from how much the gradients of stretches
  /// of time differ (the sandwich of Huber, Proceedings of the Fifth Berkeley Symposium 1, 1967).
  Vector excessOf(const Derivatives& here) const {
    Vector out = Vector::Ones(count);
    const auto blocks = static_cast<double>(m_blocks.size());
    if (blocks < minBlocks) return out;
    Matrix meat = Matrix::Zero(count, count);
    Vector mean = Vector::Zero(count);
    for (const Vector& one : m_blocks) mean += one / blocks;
    for (const Vector& one : m_blocks) meat.noalias() += (one - mean) * (one - mean).transpose();
    meat.diagonal() += m_precision;
    const Matrix covariance = here.precision.ldlt().solve(Matrix::Identity(count, count));
    const Matrix robust = covariance * meat * covariance;
    // What a right model makes of so few stretches by chance is no excess.
    const double byChance = 1.0 + std::sqrt(2.0 / blocks);
    for (Eigen::Index i = 0; i < count; ++i) {
      const double ratio = robust(i, i) / covariance(i, i);
      if (ratio > byChance) out[i] = std::sqrt(ratio);
    }
    return out;
  }

  /// The logarithm of the likelihood of each stretch of time; those of all delays are of the same
  /// times.
  std::vector<double> blockLogs(double atDelay) {
    std::vector<double> out;
    const sim::RobotModel model = modelAt(logs);
    for (std::size_t f = 0; f < m_filters.size(); ++f) {
      m_filters[f].run(model, atDelay, m_decisions[f], m_scratch);
      const std::size_t first = out.size();
      const double begin = m_filters[f].timeOf(0);
      const double length = m_filters[f].lastTime() - begin;
      out.resize(first + static_cast<std::size_t>(length / blockLength) + 1, 0.0);
      for (const Innovation& one : m_scratch) {
        const double since = m_filters[f].timeOf(one.row) - begin;
        out[first + static_cast<std::size_t>(since / blockLength)] += logLikelihood(one);
      }
    }
    return out;
  }

  /// One step of scoring; the length of the step in posterior deviations, largest component.
  double step() {
    const Derivatives here = derivativesAt(logs);
    const double now = here.value;
    const Eigen::LDLT<Matrix> solver(here.precision);
    Vector move = solver.solve(here.gradient);
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
    for (int round = 0; round < maxRounds; ++round) {
      if (!goOn()) return false;
      if (step() < enough) break;
    }
    return true;
  }

 private:
  /// Adds those of one recording's log-likelihood.
  void addDerivatives(std::size_t f, const MotionLogs& centre, Derivatives& out) {
    m_filters[f].run(modelAt(centre), delay, m_decisions[f], m_centre);
    const auto rows = static_cast<Eigen::Index>(m_centre.size());
    m_values.resize(rows, count);
    m_variances.resize(rows, count);
    for (Eigen::Index p = 0; p < count; ++p) {
      if (!m_filters[f].dependsOn(static_cast<std::size_t>(p))) {
        m_values.col(p).setZero();
        m_variances.col(p).setZero();
        continue;
      }
      MotionLogs at = centre;
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
    out.gradient -= m_values.transpose() * share;
    out.gradient += 0.5 * (m_variances.transpose() * excess);
    addBlocks(f, share, excess);
    out.precision.noalias() += m_values.transpose() * m_values;
    out.precision.noalias() += 0.5 * (m_variances.transpose() * m_variances);
    out.value += logLikelihood(m_centre);
  }

  /// The gradients of stretches of time, from m_values and m_variances.
  void addBlocks(std::size_t f, const Vector& share, const Vector& excess) {
    double end = -1e18;
    for (Eigen::Index i = 0; i < share.size(); ++i) {
      const double time = m_filters[f].timeOf(m_centre[static_cast<std::size_t>(i)].row);
      if (time >= end) {
        end = time + blockLength;
        m_blocks.emplace_back(Vector::Zero(count));
      }
      m_blocks.back() +=
          0.5 * excess[i] * m_variances.row(i).transpose() - share[i] * m_values.row(i).transpose();
    }
  }

  std::span<MotionFilter> m_filters;
  const sim::RobotModel& m_base;
  MotionLogs m_prior;
  Eigen::Matrix<double, count, 1> m_precision;
  std::vector<FilterDecisions> m_decisions;
  bool m_jumpsKnown = false;
  std::vector<Innovation> m_centre, m_scratch;
  Matrix m_values, m_variances;
  std::vector<Vector> m_blocks;
};

/// Whether something that it did not see moved it, or somebody else the ball.
bool othersTookPart(std::span<const MotionFilter> filters) {
  return std::ranges::any_of(filters, [](const MotionFilter& one) {
    const auto isSet = [](bool row) { return row; };
    return std::ranges::any_of(one.pushed(), isSet) || std::ranges::any_of(one.ballMoves(), isSet);
  });
}

/// Posterior over the delay: the program sees whole ticks only, so that every number of a cell of
/// one tick has the same likelihood.
struct DelayPosterior {
  GridPosterior grid;
  std::vector<double> ofTicks;  ///< probability of 0, 1, 2… whole ticks
  int best = 0;
  double share = 1.0;  ///< deviation as a share of the prior's
};

/// Which share of the difference between two log-likelihoods counts, from the differences in
/// stretches of time. In a right model the variance of their sum is twice its size; innovations
/// that are alike over time, or larger at times than the model has them, make it larger, and so
/// many fewer measurements there are in effect (magnitude adjustment; Pauli, Racugno, Ventura,
/// Statistica Sinica 21, 2011).
double effectiveShare(const std::vector<double>& differences) {
  const auto blocks = static_cast<double>(differences.size());
  if (blocks < minBlocks) return 1.0;
  double sum = 0.0, squares = 0.0;
  for (const double one : differences) sum += one;
  for (const double one : differences) {
    squares += (one - sum / blocks) * (one - sum / blocks);
  }
  const double variance = squares * blocks / (blocks - 1.0);
  const double ratio = 2.0 * std::abs(sum) / std::max(variance, 1e-12);
  const double byChance = 1.0 + std::sqrt(2.0 / blocks);
  return ratio * byChance < 1.0 ? ratio : 1.0;
}

/// Looks at the ticks up to `reach` from the scoring's delay; the likelihood is taken to be
/// negligible farther away.
DelayPosterior delayPosterior(Scoring& scoring, double prior, int reach, bool amongOthers) {
  std::array<double, maxDelayTicks + 1> likelihood;
  likelihood.fill(-1e300);
  std::array<std::vector<double>, maxDelayTicks + 1> blocks;
  DelayPosterior out;
  const int middle = static_cast<int>(std::lround(scoring.delay / tick));
  const int first = std::max(0, middle - reach), last = std::min(maxDelayTicks, middle + reach);
  out.best = first;
  for (int d = first; d <= last; ++d) {
    // Other delays give other measurements their turn first: decisions are made again for each.
    scoring.decideAnew();
    const auto k = static_cast<std::size_t>(d);
    blocks[k] = scoring.blockLogs(d * tick);
    const double sum = std::accumulate(blocks[k].begin(), blocks[k].end(), 0.0);
    if (std::isfinite(sum)) likelihood[k] = sum;
    if (likelihood[k] > likelihood[static_cast<std::size_t>(out.best)]) out.best = d;
  }
  const auto best = static_cast<std::size_t>(out.best);
  for (int d = first; amongOthers && d <= last; ++d) {
    const auto k = static_cast<std::size_t>(d);
    if (k == best) continue;
    std::vector<double> differences(blocks[k].size());
    std::ranges::transform(blocks[k], blocks[best], differences.begin(), std::minus<>());
    likelihood[k] = likelihood[best] + effectiveShare(differences) / (weakTouches * weakTouches) *
                                           (likelihood[k] - likelihood[best]);
  }
  constexpr int perTick = 40;
  constexpr double cell = tick / perTick;
  const auto place = [](int i) { return (i + 0.5) * cell; };
  const int cells = maxDelayTicks * perTick;
  const auto tickOf = [&](int i) { return static_cast<std::size_t>(std::lround(place(i) / tick)); };
  const auto weight = [&](int i, bool data) {
    const double value = place(i);
    const double z = std::log(value / prior) / sigmaPrior;
    return -0.5 * z * z - std::log(value) + (data ? likelihood[tickOf(i)] : 0.0);
  };
  out.grid = posteriorOn(cells, place, [&](int i) { return weight(i, true); });
  const GridPosterior before = posteriorOn(cells, place, [&](int i) { return weight(i, false); });
  out.share = out.grid.deviation / before.deviation;
  out.ofTicks.assign(likelihood.size(), 0.0);
  const double most = likelihood[static_cast<std::size_t>(out.best)];
  double all = 0.0;
  for (int i = 0; i < cells; ++i) {
    const double share = std::exp(weight(i, true) - most);
    out.ofTicks[tickOf(i)] += share;
    all += share;
  }
  for (double& share : out.ofTicks) share /= all;
  return out;
}

/// What a standard deviation of noise that is not known well makes of the others: the posterior of
/// its logarithm, and how much less or more sure the others are at each of its values. A nested
/// Laplace approximation (Rue, Martino, Chopin, Journal of the Royal Statistical Society B 71,
/// 2009).
struct NoisePosterior {
  static constexpr int points = 601;
  static constexpr double reach = 3.75;  // deviations to either side
  std::size_t parameter = 0;
  Vector direction;                 // how all of them move with one deviation of it
  std::vector<double> probability;  // at deviations placeAt(i)
  std::vector<double> cumulative;
  std::array<Vector, 3> logVariances;  // of the others given it, at -nodeAt, 0, nodeAt deviations
  static constexpr double nodeAt = 2.0;

  static double placeAt(double i) { return reach * (2.0 * i / (points - 1) - 1.0); }
  double quantile(double share) const {
    const auto found = std::ranges::lower_bound(cumulative, share);
    return placeAt(
        static_cast<double>(std::min<std::ptrdiff_t>(found - cumulative.begin(), points - 1)));
  }
};

/// The parabola through values at -1, 0 and 1.
double parabolaThrough(double before, double middle, double after, double at) {
  return middle + 0.5 * (after - before) * at + (0.5 * (after + before) - middle) * at * at;
}

NoisePosterior noisePosterior(Scoring& scoring, std::size_t parameter,
                              const Scoring::Derivatives& atMode, const Matrix& covariance) {
  constexpr int coarse = 11;
  const auto own = static_cast<Eigen::Index>(parameter);
  NoisePosterior out;
  out.parameter = parameter;
  out.direction = covariance.col(own) / std::sqrt(covariance(own, own));
  const auto along = [&](double t) {
    MotionLogs at = scoring.logs;
    for (std::size_t i = 0; i < at.size(); ++i) {
      at[i] += t * out.direction[static_cast<Eigen::Index>(i)];
    }
    return at;
  };
  std::vector<double> weights;
  for (int k = 0; k < coarse; ++k) {
    const double t = NoisePosterior::reach * (2.0 * k / (coarse - 1) - 1.0);
    weights.push_back(scoring.logPosterior(along(t), scoring.delay));
  }
  // The integral over the others: of a normal distribution about their mode, which is a step of
  // Newton away.
  std::array<double, 3> volume{};
  for (std::size_t n = 0; n < 3; ++n) {
    const double t = NoisePosterior::nodeAt * (static_cast<double>(n) - 1.0);
    auto here = n == 1 ? atMode : scoring.derivativesAt(along(t));
    here.precision.row(own).setZero();
    here.precision.col(own).setZero();
    here.precision(own, own) = 1.0;
    here.gradient[own] = 0.0;
    const Eigen::LDLT<Matrix> solver(here.precision);
    volume[n] = 0.5 * here.gradient.dot(solver.solve(here.gradient)) -
                0.5 * solver.vectorD().array().max(1e-300).log().sum();
    out.logVariances[n] =
        solver.solve(Matrix::Identity(count, count)).diagonal().array().max(1e-300).log();
  }
  double most = -1e300, sum = 0.0;
  for (int i = 0; i < NoisePosterior::points; ++i) {
    const double at = std::clamp(NoisePosterior::placeAt(i) / NoisePosterior::nodeAt, -1.5, 1.5);
    out.probability.push_back(
        parabolaAt(weights, (coarse - 1.0) * i / (NoisePosterior::points - 1)) +
        parabolaThrough(volume[0], volume[1], volume[2], at));
    most = std::max(most, out.probability.back());
  }
  for (double& one : out.probability) sum += one = std::exp(one - most);
  double so = 0.0;
  for (double& one : out.probability) {
    so += one /= sum;
    out.cumulative.push_back(so - 0.5 * one);
  }
  return out;
}

/// Marginal posteriors of all logarithms: normal distributions, mixed over the noise that is not
/// known well.
std::array<GridPosterior, motionParameterCount> marginals(
    const MotionLogs& logs, const Matrix& covariance, const std::vector<NoisePosterior>& noise) {
  constexpr int samples = 1000;
  std::array<GridPosterior, motionParameterCount> out;
  std::vector<std::vector<double>> places(noise.size());  // deviations, by noise and sample
  double irrational = std::numbers::phi - 1.0;            // an even sequence in every dimension
  for (std::size_t n = 0; n < noise.size(); ++n) {
    for (int i = 0; i < samples; ++i) {
      const double share = n == 0 ? (i + 0.5) / samples : std::fmod(0.5 + i * irrational, 1.0);
      places[n].push_back(noise[n].quantile(share));
    }
    irrational = std::fmod(irrational * std::numbers::sqrt2 + 0.1, 1.0);
  }
  for (std::size_t p = 0; p < logs.size(); ++p) {
    const auto k = static_cast<Eigen::Index>(p);
    std::vector<double> means(samples, logs[p]), deviations(samples);
    double given = covariance(k, k);
    for (const NoisePosterior& one : noise) given -= one.direction[k] * one.direction[k];
    given = std::max(given, 1e-4 * covariance(k, k));
    for (int i = 0; i < samples; ++i) {
      const auto s = static_cast<std::size_t>(i);
      double logVariance = std::log(given);
      for (std::size_t n = 0; n < noise.size(); ++n) {
        const double t = places[n][s];
        means[s] += t * noise[n].direction[k];
        if (noise[n].parameter == p) continue;
        const auto& variances = noise[n].logVariances;
        const double at = std::clamp(t / NoisePosterior::nodeAt, -1.5, 1.5);
        logVariance += parabolaThrough(variances[0][k] - variances[1][k], 0.0,
                                       variances[2][k] - variances[1][k], at);
      }
      deviations[s] = std::exp(0.5 * logVariance);
    }
    const auto quantile = [&](double share) {
      double low = logs[p] - 10.0 * std::sqrt(covariance(k, k));
      double high = 2.0 * logs[p] - low;
      for (int round = 0; round < 40; ++round) {
        const double middle = 0.5 * (low + high);
        double below = 0.0;
        for (std::size_t s = 0; s < means.size(); ++s) {
          below += 0.5 * std::erfc((means[s] - middle) / (deviations[s] * std::numbers::sqrt2));
        }
        (below < share * samples ? low : high) = middle;
      }
      return 0.5 * (low + high);
    };
    out[p] = {quantile(0.5), quantile(0.025), quantile(0.975), 0.0};
  }
  return out;
}

}  // namespace

MotionFit fitMotion(std::span<MotionFilter> filters, std::span<const CalibrationLog> logs,
                    const sim::RobotModel& base, const std::function<bool(double)>& progress) {
  Scoring scoring(filters, base);
  scoring.logs = firstGuess(logs, scoring.prior());
  const double prior = base.noise.visionDelay > 0.0 ? base.noise.visionDelay : minDelay;
  scoring.delay = std::round(prior / tick) * tick;
  MotionFit fit;
  const auto goOn = [&](double part) { return !progress || progress(part); };
  DelayPosterior delay;
  for (int round = 0; round < 4; ++round) {
    if (round > 0) scoring.startAnew(knownSpeed);
    const double part = 0.25 * round;
    if (!scoring.search(nearEnough, [&] { return goOn(part); })) return fit;
    delay = delayPosterior(scoring, prior, round == 0 ? maxDelayTicks : 4, othersTookPart(filters));
    const double best = delay.best * tick;
    if (round > 0 && best == scoring.delay) break;
    scoring.delay = best;
  }
  scoring.startAnew(knownSpeed);
  for (std::size_t outliers = 0, round = 0; round < 4; ++round) {
    if (!scoring.search(closeEnough, [&] { return goOn(0.8); })) return fit;
    // What was an outlier for the first guess of a noise may be none for the last.
    if (scoring.outliers() == outliers) break;
    outliers = scoring.outliers();
    scoring.decideAnew();
  }

  fit.delay = scoring.delay;
  fit.delayPosterior = delay.grid;
  fit.delayOfTicks = delay.ofTicks;
  fit.delayKnown = delay.share < 0.7;
  const auto atMode = scoring.derivativesAt(scoring.logs);
  Vector excess = scoring.excessOf(atMode);
  if (othersTookPart(filters)) excess *= weakTouches;
  fit.covariance = atMode.precision.ldlt().solve(Matrix::Identity(count, count));
  for (std::size_t i = 0; i < fit.information.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double sigma = motionParameters[i].prior;
    fit.information[i] = 1.0 - fit.covariance(k, k) / (sigma * sigma);
  }
  std::vector<NoisePosterior> noise;
  for (std::size_t i = motionNoiseForward; i < motionParameterCount; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (std::sqrt(fit.covariance(k, k)) < skewedFrom || fit.information[i] < 0.1) continue;
    if (!goOn(0.9)) return {};
    noise.push_back(noisePosterior(scoring, i, atMode, fit.covariance));
  }
  fit.marginals = marginals(scoring.logs, fit.covariance, noise);
  for (std::size_t i = 0; i < fit.marginals.size(); ++i) {
    const double factor = excess[static_cast<Eigen::Index>(i)];
    GridPosterior& one = fit.marginals[i];
    one.low = one.median - factor * (one.median - one.low);
    one.high = one.median + factor * (one.high - one.median);
    fit.information[i] = 1.0 - factor * factor * (1.0 - fit.information[i]);
  }
  fit.covariance = excess.asDiagonal() * fit.covariance * excess.asDiagonal();
  for (std::size_t i = 0; i < fit.logs.size(); ++i) fit.logs[i] = fit.marginals[i].median;
  fit.model = scoring.modelAt(fit.logs);
  // The model goes on with all noise that this recording has; what is reported is the robot's own.
  for (const std::size_t gait : {motionNoiseForward, motionNoiseSideways}) {
    if (!othersTookPart(filters)) break;
    const auto own =
        withoutTouches(fit.marginals[gait], scoring.prior()[gait], motionParameters[gait].prior);
    fit.marginals[gait] = own;
    fit.information[gait] = 1.0 - own.share * own.share;
  }
  fit.model.noise.visionDelay = fit.delayKnown ? fit.delayPosterior.median : base.noise.visionDelay;
  for (std::size_t f = 0; f < filters.size(); ++f) {
    MotionFit::OfLog one;
    one.decisions.gaitSpread = knownSpeed;
    filters[f].run(fit.model, fit.delay, one.decisions, one.innovations, &one.states);
    fit.ofLogs.push_back(std::move(one));
  }
  return fit;
}

}  // namespace pitchboard::link
