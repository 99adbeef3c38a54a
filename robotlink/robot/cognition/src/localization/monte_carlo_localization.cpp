// SPDX-License-Identifier: GPL-3.0-or-later
#include "localization/monte_carlo_localization.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include <base/angles.h>
#include <base/random.h>
#include <base/repeatable_math.h>
#include <base/try.h>

#include "localization/monte_carlo_imu.h"

namespace pitchboard::link {
namespace {

using std::numbers::pi;

constexpr int maxCells = 1 << 21;
constexpr double imuJump = 0.26;         // rad: beyond it the IMU was reset or the robot carried
constexpr double clusterRadius = 1.0;    // m
constexpr double maxDisplacement = 1.0;  // m and rad of one update; more is not walking
constexpr double maxResetShare = 0.5;
constexpr double widestKernel = 0.8;  // m

bool usable(const std::optional<double>& value) {
  return value && std::isfinite(*value);
}

double finite(double value) {
  return std::isfinite(value) ? std::clamp(value, -maxDisplacement, maxDisplacement) : 0.0;
}

double cube(double x) {
  return x * x * x;
}

/// Cell of a heading without an arc tangent: the angle measured along a square ("diamond angle").
int headingCell(float c, float s) {
  const float d = s / (std::abs(c) + std::abs(s) + 1e-20F);
  const float around = c >= 0 ? d + 1.0F : 3.0F - d;  // 0..4
  return std::clamp(static_cast<int>(around * (MonteCarloLocalization::headingCells / 4.0F)), 0,
                    MonteCarloLocalization::headingCells - 1);
}

/// Where the first of the largest stands. Lanes side by side are what compilers make vectors of.
int firstLargest(std::span<const float> values) {
  constexpr std::size_t lanes = 16;
  std::array<float, lanes> most;
  most.fill(values.front());
  const auto raise = [](float& to, float value) { to = value > to ? value : to; };
  std::size_t i = 0;
  for (; i + lanes <= values.size(); i += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) raise(most[lane], values[i + lane]);
  }
  for (; i < values.size(); ++i) raise(most[0], values[i]);
  const float largest = *std::ranges::max_element(most);
  return static_cast<int>(std::ranges::find(values, largest) - values.begin());
}

}  // namespace

LocalizationParameters LocalizationParameters::published() {
  LocalizationParameters p;
  p.minParticles = p.maxParticles = 5000;
  p.bearingSigma = radiansFromDegrees(5);
  p.imuSigma = radiansFromDegrees(30);
  p.outlierShare = 0.0;
  p.recovery = false;
  p.kernel = 0.0;
  p.yawByImu = false;
  p.resampleAlways = true;
  return p;
}

Result<MonteCarloLocalization> MonteCarloLocalization::create(const sim::FieldSpec& field,
                                                              const LocalizationParameters& p,
                                                              ImuZero imuZero, std::uint64_t seed,
                                                              int robot) {
  TRY(sim::validate(field));
  const auto refuse = [](const char* why) {
    return failure(ErrorCode::InvalidArgument, why, "localization");
  };
  if (p.minParticles < 1 || p.maxParticles > 100000 || p.minParticles > p.maxParticles) {
    return refuse("The number of particles must lie in 1..100000, the least not above the most.");
  }
  for (const double sigma : {p.bearingSigma, p.imuSigma, p.kldError, p.kldCell}) {
    if (!std::isfinite(sigma) || sigma < 1e-3) {
      return refuse("Sigmas, the error bound and the cell size must be at least 0.001.");
    }
  }
  for (const double value : {p.walkSigma, p.walkShare, p.turnSigma, p.restSigma, p.outlierShare,
                             p.slowRate, p.fastRate, p.kldQuantile, p.kernel}) {
    if (!std::isfinite(value) || value < 0.0)
      return refuse("Rates and noise must not be negative.");
  }
  if (p.outlierShare >= 1.0) return refuse("The share of outliers must be below 1.");
  return MonteCarloLocalization(field, p, imuZero, seed, robot);
}

MonteCarloLocalization::MonteCarloLocalization(const sim::FieldSpec& field,
                                               const LocalizationParameters& parameters,
                                               ImuZero imuZero, std::uint64_t seed, int robot)
    : m_parameters(parameters),
      m_halfLength(field.halfLength()),
      m_halfWidth(field.halfWidth()),
      m_border(field.border),
      m_corners{{{-m_halfLength, m_halfWidth},
                 {m_halfLength, m_halfWidth},
                 {-m_halfLength, -m_halfWidth},
                 {m_halfLength, -m_halfWidth}}},
      m_imuZero(imuZero),
      m_seed(seed),
      m_robot(robot),
      m_noise(seed, robot) {
  const double lengthAll = 2 * (m_halfLength + m_border);
  const double widthAll = 2 * (m_halfWidth + m_border);
  // A huge field gets coarser cells rather than a huge table.
  while (std::ceil(lengthAll / m_parameters.kldCell) * std::ceil(widthAll / m_parameters.kldCell) *
             headingCells >
         maxCells) {
    m_parameters.kldCell *= 2;
  }
  m_columns = static_cast<int>(std::ceil(lengthAll / m_parameters.kldCell)) + 1;
  m_rows = static_cast<int>(std::ceil(widthAll / m_parameters.kldCell)) + 1;
}

particles::Grid MonteCarloLocalization::grid() const {
  return {static_cast<float>(m_halfLength + m_border), static_cast<float>(m_halfWidth + m_border),
          static_cast<float>(1.0 / m_parameters.kldCell), m_columns, m_rows};
}

void MonteCarloLocalization::makeAllAlike() {
  m_weight.head(m_count).setConstant(1.0F / static_cast<float>(m_count));
}

void MonteCarloLocalization::reset() {
  m_spread = false;
  m_slow = m_fast = m_sinceBearing = 0.0;
  m_lastImu.reset();
  m_imuShift = 0.0;
  m_remembered = {};
}

void MonteCarloLocalization::reset(const Pose& pose, double sigma, std::optional<double> yawSigma) {
  reset();
  CounterRandom random(m_seed, m_robot, NoiseStream::Behaviour, m_updates++);
  m_count = m_parameters.maxParticles;
  makeRoom(m_count);
  for (int i = 0; i < m_count; ++i) {
    const double x = random.normal(pose.position.x, sigma);
    const double y = random.normal(pose.position.y, sigma);
    put(i, {{x, y}, random.normal(pose.yaw, yawSigma.value_or(sigma * 0.1))});
  }
  makeAllAlike();
  m_spread = true;
  estimate();
}

void MonteCarloLocalization::put(int i, const Pose& pose) {
  const repeatable::SinCos heading = repeatable::sinCos(pose.yaw);
  m_now.x[i] = static_cast<float>(pose.position.x);
  m_now.y[i] = static_cast<float>(pose.position.y);
  m_now.c[i] = static_cast<float>(heading.cos);
  m_now.s[i] = static_cast<float>(heading.sin);
}

Pose MonteCarloLocalization::particle(int i) const {
  return {{m_now.x[i], m_now.y[i]}, repeatable::atan2(m_now.s[i], m_now.c[i])};
}

void MonteCarloLocalization::spread(const LocalizationInput& input) {
  if (usable(input.imuYaw)) m_lastImu = input.imuYaw;
  CounterRandom random(m_seed, m_robot, NoiseStream::Behaviour, m_updates++);
  m_count = m_parameters.maxParticles;
  makeRoom(m_count);
  for (int i = 0; i < m_count; ++i) {
    const double x = (2 * random.uniform() - 1) * m_halfLength;
    const double y = (2 * random.uniform() - 1) * m_halfWidth;
    put(i, {{x, y}, drawYaw(random)});
  }
  makeAllAlike();
  m_spread = true;
}

void MonteCarloLocalization::update(const LocalizationInput& input) {
  remember(input);
  m_sinceBearing += std::clamp(input.seconds, 0.0, 10.0);
  if (!m_spread) {
    spread(input);
  } else {
    move(input);
  }
  double sum = 0.0;
  const int seen = weigh(input, sum);
  // When no particle explains what is seen, nothing is known any more.
  if (!(sum > particles::minSum)) makeAllAlike();

  m_resetShare = 0.0;
  if (seen > 0) {
    // The mean weight of one bearing, so that it does not depend on how many were seen.
    const double likely = std::max(sum, 1e-12);
    const double mean = seen == 1   ? likely
                        : seen == 2 ? std::sqrt(likely)
                                    : repeatable::pow(likely, 1.0 / seen);
    if (m_slow == 0.0) m_slow = m_fast = mean;
    m_slow += std::min(1.0, m_parameters.slowRate * m_sinceBearing) * (mean - m_slow);
    m_fast += std::min(1.0, m_parameters.fastRate * m_sinceBearing) * (mean - m_fast);
    m_sinceBearing = 0.0;
    if (m_parameters.recovery) {
      m_resetShare = std::clamp(1.0 - m_fast / (0.85 * m_slow), 0.0, maxResetShare);
    }
  }
  const double effective = 1.0 / particles::kernels().sumOfSquares(m_weight.data(), m_count);
  if (m_parameters.resampleAlways || effective < 0.5 * m_count || m_resetShare > 0.0) {
    resample(m_resetShare);
  }
  estimate();
}

void MonteCarloLocalization::remember(const LocalizationInput& input) {
  for (std::size_t i = 0; i < m_remembered.size(); ++i) {
    Remembered& corner = m_remembered[i];
    corner.age += input.seconds;
    corner.bearing -= finite(input.turn);
    if (usable(input.corners[i])) corner = {*input.corners[i], 0.0};
  }
}

void MonteCarloLocalization::move(const LocalizationInput& input) {
  double forward = finite(input.forward);
  double left = finite(input.left);
  double turn = finite(input.turn);
  if (usable(input.imuYaw)) {
    if (m_lastImu && m_parameters.yawByImu) {
      const double turned = wrapToPi(*input.imuYaw - *m_lastImu);
      if (std::abs(turned - turn) < imuJump) {
        turn = turned;
      } else {
        m_imuShift = wrapToPi(m_imuShift + turn - turned);
      }
    }
    m_lastImu = input.imuYaw;
  }
  const double time = std::sqrt(std::clamp(input.seconds, 0.0, 10.0));
  const LocalizationParameters& p = m_parameters;
  const double distance = repeatable::hypot(forward, left);
  const auto walk = static_cast<float>(input.inMotion ? p.walkSigma * time + p.walkShare * distance
                                                      : p.restSigma * time);
  const auto rotation = static_cast<float>(
      input.inMotion ? p.turnSigma * time + p.walkShare * std::abs(turn) : p.restSigma * time);

  Scratch& noise = scratch();
  for (Array* one : {&noise.d, &noise.a, &noise.b}) m_noise.fillNormal(one->data(), m_count);
  particles::kernels().move(
      poses(),
      {static_cast<float>(forward), static_cast<float>(left), static_cast<float>(turn), walk,
       rotation, static_cast<float>(m_halfLength + m_border),
       static_cast<float>(m_halfWidth + m_border)},
      noise.d.data(), noise.a.data(), noise.b.data());
}

int MonteCarloLocalization::weigh(const LocalizationInput& input, double& sum) {
  const double sigma = m_parameters.bearingSigma;
  const particles::Likelihood likelihood{static_cast<float>(1.0 / (sigma * sigma)),
                                         static_cast<float>(m_parameters.outlierShare)};
  int seen = 0;
  for (std::size_t i = 0; i < m_corners.size(); ++i) {
    if (!usable(input.corners[i])) continue;
    ++seen;
    const repeatable::SinCos bearing = repeatable::sinCos(*input.corners[i]);
    particles::kernels().weighBearing(poses(), m_weight.data(), static_cast<float>(m_corners[i].x),
                                      static_cast<float>(m_corners[i].y),
                                      static_cast<float>(bearing.cos),
                                      static_cast<float>(bearing.sin), likelihood);
  }
  if (usable(input.imuYaw)) {
    sum = weighImu(*input.imuYaw);
  } else {
    sum = particles::kernels().sum(m_weight.data(), m_count);
    particles::kernels().scale(m_weight.data(), m_count, static_cast<float>(1.0 / sum));
  }
  return seen;
}

double MonteCarloLocalization::weighImu(double yaw) {
  const double offset = m_imuZero == ImuZero::Left ? pi : 0.0;
  particles::Headings headings{};
  const auto add = [&headings](double heading) {
    const repeatable::SinCos both = repeatable::sinCos(heading);
    headings.cosine[headings.count] = static_cast<float>(both.cos);
    headings.sine[headings.count++] = static_cast<float>(both.sin);
  };
  add(yaw + offset);
  // After a jump nothing but bearings can tell a robot that was turned from an IMU that was reset.
  if (m_imuShift != 0.0) add(yaw + offset + m_imuShift);
  // Not knowing where the IMU's zero is, yaw and yaw + 180 degrees are equally likely.
  headings.bothWays = m_imuZero == ImuZero::Unknown;
  const double sigma = m_parameters.imuSigma;
  return particles::kernels().weighHeading(
      poses(), m_weight.data(), scratch().a.data(), headings,
      {static_cast<float>(1.0 / (sigma * sigma)), static_cast<float>(imuOutliers)});
}

int MonteCarloLocalization::wantedParticles() {
  const LocalizationParameters& p = m_parameters;
  if (p.minParticles == p.maxParticles) return p.maxParticles;
  // Cells of the histogram that the resampled set will occupy: particles below half a mean weight
  // will most likely not be drawn.
  Scratch& used = scratch();
  if (++used.stamp == 0) {  // the stamps of long ago would look new
    std::ranges::fill(used.cellStamp, 0U);
    used.stamp = 1;
  }
  int occupied = 0;
  const float least = 0.5F / static_cast<float>(m_count);
  particles::kernels().cellsOf(poses(), grid(), used.cells.data());
  for (int i = 0; i < m_count; ++i) {
    if (m_weight[i] < least) continue;
    const auto place = static_cast<std::size_t>(used.cells[static_cast<std::size_t>(i)]);
    const auto heading = static_cast<std::size_t>(headingCell(m_now.c[i], m_now.s[i]));
    const std::size_t cell = place * headingCells + heading;
    occupied += used.cellStamp[cell] != used.stamp;
    used.cellStamp[cell] = used.stamp;
  }
  if (occupied < 2) return p.minParticles;
  const double k = occupied - 1;  // Fox (2003), equation 13: the Wilson-Hilferty approximation
  const double r = 2.0 / (9.0 * k);
  const double wanted = k / (2 * p.kldError) * cube(1.0 - r + std::sqrt(r) * p.kldQuantile);
  return std::clamp(static_cast<int>(std::min(wanted, 1e6)), p.minParticles, p.maxParticles);
}

void MonteCarloLocalization::resample(double resetShare) {
  CounterRandom random(m_seed, m_robot, NoiseStream::Behaviour, m_updates++);
  const int n = wantedParticles();
  const int fresh = static_cast<int>(resetShare * n);
  const int kept = n - fresh;
  const double stride = 1.0 / kept;
  double pointer = random.uniform() * stride;
  double cumulative = m_weight[0];
  int from = 0;
  Particles& next = scratch().next;
  for (int i = 0; i < kept; ++i, pointer += stride) {
    while (pointer > cumulative && from + 1 < m_count) cumulative += m_weight[++from];
    next.x[i] = m_now.x[from];
    next.y[i] = m_now.y[from];
    next.c[i] = m_now.c[from];
    next.s[i] = m_now.s[from];
  }
  makeRoom(n);
  m_now.x.head(kept) = next.x.head(kept);
  m_now.y.head(kept) = next.y.head(kept);
  m_now.c.head(kept) = next.c.head(kept);
  m_now.s.head(kept) = next.s.head(kept);
  if (m_parameters.kernel > 0.0) regularize(kept);
  for (int i = kept; i < n; ++i) put(i, drawFromSensors(random));
  m_count = n;
  makeAllAlike();
}

// Copies of one particle would say the same for ever: each moves a little, in proportion to what is
// uncertain.
void MonteCarloLocalization::regularize(int count) {
  const auto width =
      static_cast<float>(m_parameters.kernel * std::min(m_belief.sigma, widestKernel));
  Scratch& noise = scratch();
  for (Array* one : {&noise.a, &noise.b}) m_noise.fillNormal(one->data(), count);
  m_now.x.head(count) += width * noise.a.head(count);
  m_now.y.head(count) += width * noise.b.head(count);
}

// The mean of all particles where they are one cluster. Else that of those within a metre of the
// cell with most weight: the mean of all would stand between two hypotheses, where the robot surely
// is not.
void MonteCarloLocalization::estimate() {
  particles::Mean mean = particles::kernels().meanOf(poses(), m_weight.data());
  const particles::Spread spread = particles::kernels().spreadAbout(
      poses(), m_weight.data(), static_cast<float>(mean.x), static_cast<float>(mean.y));
  const double variance = spread.variance / mean.weight;
  if (spread.farthest > clusterRadius * clusterRadius) strongestCluster(mean);
  m_belief = {
      {{mean.x, mean.y}, repeatable::atan2(mean.sine, mean.cosine)}, std::sqrt(variance), m_count};
}

void MonteCarloLocalization::strongestCluster(particles::Mean& mean) {
  Scratch& used = scratch();
  const auto weights =
      std::span(used.cellWeight)
          .first(static_cast<std::size_t>(m_columns) * static_cast<std::size_t>(m_rows));
  particles::kernels().cellsOf(poses(), grid(), used.cells.data());
  std::ranges::fill(weights, 0.0F);
  for (int i = 0; i < m_count; ++i) {
    weights[static_cast<std::size_t>(used.cells[static_cast<std::size_t>(i)])] += m_weight[i];
  }
  const int best = firstLargest(weights);
  const double cell_m = m_parameters.kldCell;
  const int column = best % m_columns, row = best / m_columns;
  const double x = (column + 0.5) * cell_m - m_halfLength - m_border;
  const double y = (row + 0.5) * cell_m - m_halfWidth - m_border;
  mean =
      particles::kernels().meanNear(poses(), m_weight.data(), used.a.data(), static_cast<float>(x),
                                    static_cast<float>(y), static_cast<float>(clusterRadius));
}

}  // namespace pitchboard::link
