// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Monte Carlo localization of one robot: where it stands on the field, from what it commanded, the
// bearings of the four field corners and its IMU's yaw. A pure class: no blackboard, no clock, one
// thread; metres, radians and the studio's frame throughout. The same inputs and seed give the same
// belief to the last bit.
//
// Sources. Particle filter with augmented recovery: Thrun, Burgard, Fox, "Probabilistic Robotics"
// (2005), tables 8.2 and 8.3; sensor resetting: Lenser and Veloso (2000), Gutmann and Fox (2002);
// number of particles: Fox, "Adapting the sample size in particle filters through KLD-sampling"
// (2003); likelihood of a bearing: the von Mises density exp((cos e - 1) / sigma^2), the normal law
// of a circle, which needs no arc tangent: cos e is a dot product of two directions.
//
// The symmetric field. Turned by 180 degrees about its centre the field looks the same, so unnamed
// corners could never tell the two halves apart. Two things can: the published corners have colours
// (each bearing belongs to one known corner), and the IMU, whose zero is the direction in which the
// robot started, that is towards the opponents' goal. Robots that start facing left therefore have
// a yaw that differs from the field's by 180 degrees (system.md section 4, "IMU"). With
// ImuZero::Right or ::Left the filter adds that offset. With ImuZero::Unknown both are taken as
// equally likely, and the coloured corners decide: nobody has to configure the side.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <base/geometry.h>
#include <base/result.h>
#include <simcore/world/field.h>

#include "localization/fast_noise.h"
#include "localization/particle_kernels.h"

namespace pitchboard {
class CounterRandom;
}

namespace pitchboard::link {

/// Which direction of the field the IMU calls zero.
enum class ImuZero { Unknown, Right, Left };

struct LocalizationParameters {
  int minParticles = 200;  ///< bounds of the adaptive number; equal = a fixed number
  int maxParticles = 5000;
  double bearingSigma = 0.105;  ///< rad, of a corner's bearing as the filter believes it (6 deg)
  double outlierShare = 0.02;   ///< bearings that mean nothing, 0..1; 0 = every one is trusted
  double imuSigma = 0.35;       ///< rad (20 deg); wide: successive values share their drift
  double walkSigma = 0.025;     ///< m in one second of motion, grows with the square root of time
  double walkShare = 0.08;      ///< of the distance walked, added to it
  double turnSigma = 0.026;     ///< rad in one second of motion (1.5 deg)
  double restSigma = 0.004;     ///< m (and rad) in one second at rest, keeps particles apart
  double kldError = 0.05;       ///< Fox's epsilon
  double kldQuantile = 2.326;   ///< Fox's z(1 - delta), delta = 1 %
  double kldCell = 0.30;        ///< m, side of a histogram cell; headings have 16 cells
  double slowRate = 0.05;       ///< Thrun's alpha_slow and alpha_fast, per second, so that the
  double fastRate = 0.8;        ///< cycle time does not change them
  /// Width of the kernel of the regularized particle filter (Musso, Oudjane, Le Gland 2001), as a
  /// share of the belief's sigma; keeps a small set from growing surer than its sensors allow.
  double kernel = 0.2;
  bool recovery = true;         ///< sensor resetting; off in the published filter
  bool yawByImu = true;         ///< turning is taken from the IMU while it agrees with commands
  bool resampleAlways = false;  ///< else only when half of the particles count for nothing

  /// The published filter (system.md section 5): 5000 particles, bearings with sigma 5 degrees, IMU
  /// yaw with sigma 30, resampling in every update, no recovery.
  static LocalizationParameters published();
};

/// What happened since the update before. Lengths in metres, angles in radians.
struct LocalizationInput {
  double seconds = 0.1;   ///< since the update before
  double forward = 0.0;   ///< commanded displacement along the heading
  double left = 0.0;      ///< and across it
  double turn = 0.0;      ///< commanded rotation, counter-clockwise
  bool inMotion = false;  ///< the gait runs (also in place)
  /// Bearings of the corners top left (blue), top right (red), bottom left (yellow), bottom right
  /// (purple) from the heading, left positive; absent = not seen.
  std::array<std::optional<double>, 4> corners;
  std::optional<double> imuYaw;  ///< as IMU_EULER_Z, relative to the IMU's zero
};

struct PoseBelief {
  Pose pose;           ///< mean of the strongest cluster
  double sigma = 0.0;  ///< m, standard deviation of all particles' positions
  int particles = 0;
};

class MonteCarloLocalization {
 public:
  static constexpr int headingCells = 16;  ///< of the histogram by which the number adapts

  /// The pose is unknown at first: anywhere on the field. Fails with a sentence on parameters that
  /// cannot work (counts outside 1..100000, sigmas that are not positive).
  static Result<MonteCarloLocalization> create(const sim::FieldSpec& field,
                                               const LocalizationParameters& parameters = {},
                                               ImuZero imuZero = ImuZero::Unknown,
                                               std::uint64_t seed = 1, int robot = 1);

  /// Forgets everything; the next update spreads the particles over the field.
  void reset();
  /// Starts over round a known pose. `sigma` in metres, of the heading `yawSigma` in radians or,
  /// when it is not told, tenths of a radian per metre.
  void reset(const Pose& pose, double sigma, std::optional<double> yawSigma = {});

  /// One cycle: motion, measurement, resampling. Values that are not finite are ignored. Allocates
  /// only when the number of particles changes a lot.
  void update(const LocalizationInput& input);

  const PoseBelief& belief() const { return m_belief; }
  /// Share of the particles that the last update drew from the sensors, 0..1.
  double resetShare() const { return m_resetShare; }

  /// A copy without room for more particles, to be kept. It goes on to the same last bit.
  MonteCarloLocalization compact() const;
  std::size_t compactBytes() const;

  int size() const { return m_count; }
  /// Pose of particle i, for drawing.
  Pose particle(int i) const;
  /// Its weight; not normalised.
  double weight(int i) const { return static_cast<double>(m_weight[i]); }

 private:
  using Array = Eigen::ArrayXf;
  // One array per coordinate, so that every kernel works on whole registers. A heading is kept as
  // its cosine and sine: turning and bearings are then products.
  struct Particles {
    Array x, y, c, s;
  };
  particles::Poses poses() {
    return {m_now.x.data(), m_now.y.data(), m_now.c.data(), m_now.s.data(), m_count};
  }
  particles::Grid grid() const;
  /// What a cycle needs in between; every filter of a thread uses the same.
  struct Scratch {
    Array a, b, d;
    Particles next;
    std::vector<std::int32_t> cells;
    std::vector<std::uint32_t> cellStamp;
    std::uint32_t stamp = 0;
    std::vector<float> cellWeight;
  };
  /// With room for all particles and cells of this filter.
  Scratch& scratch() const;
  /// Makes room for `count` particles, of which the present ones stay.
  void makeRoom(int count);
  struct Remembered {
    double bearing = 0.0;
    double age = 1e9;  // s
  };

  MonteCarloLocalization(const sim::FieldSpec& field, const LocalizationParameters& parameters,
                         ImuZero imuZero, std::uint64_t seed, int robot);
  void spread(const LocalizationInput& input);
  void move(const LocalizationInput& input);
  /// How many corners were seen; `sum`: of the weights before the yaw entered and all became 1.
  int weigh(const LocalizationInput& input, double& sum);
  double weighImu(double yaw);
  void resample(double resetShare);
  void regularize(int count);
  int wantedParticles();
  Pose drawFromSensors(CounterRandom& random) const;
  double drawYaw(CounterRandom& random) const;
  void remember(const LocalizationInput& input);
  void estimate();
  void strongestCluster(particles::Mean& mean);
  void makeAllAlike();
  bool onField(const Point& p) const;
  void put(int i, const Pose& pose);

  LocalizationParameters m_parameters;
  double m_halfLength, m_halfWidth, m_border;
  std::array<Point, 4> m_corners;
  ImuZero m_imuZero;
  std::uint64_t m_seed;
  int m_robot;
  FastNoise m_noise;
  std::uint64_t m_updates = 0;

  int m_count = 0;
  bool m_spread = false;  // particles have been placed
  Particles m_now;
  Array m_weight;
  std::array<Remembered, 4> m_remembered;
  std::optional<double> m_lastImu;
  double m_imuShift = 0.0;  // to be added to its yaw if its jumps were resets; 0: none was seen
  double m_slow = 0.0, m_fast = 0.0, m_sinceBearing = 0.0, m_resetShare = 0.0;
  int m_columns, m_rows;  // of the histogram
  PoseBelief m_belief;
};

}  // namespace pitchboard::link
