// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What localization does to all its particles at once: loops over plain arrays that every compiler
// makes vectors of, without functions of the C library or of the processor whose last bits differ.
// Each value depends on its own particle only, and sums are made in a fixed order: the same bits
// everywhere. Metres and radians in single precision; a heading is its cosine and sine. Pure
// functions; the arrays belong to the filter and have `capacityFor(n)` places.

#include <array>
#include <cstdint>

#include <base/simd_level.h>

namespace pitchboard::link::particles {

/// Kernels may write past n, up to whole blocks.
inline constexpr int block = 16;
constexpr int capacityFor(int n) {
  return (n + block - 1) / block * block;
}

/// Weights that add up to less say nothing.
inline constexpr double minSum = 1e-30;

/// Where they stand: arrays of n.
struct Poses {
  float* x;
  float* y;
  float* c;
  float* s;
  int n;
};

struct Motion {
  float forward, left, turn;  ///< what was commanded
  float walkSigma, turnSigma;
  float limitX, limitY;  ///< nobody leaves the walls
};
/// exp(kappa (cosine - 1)) is the likelihood of an error; `floor` what is believed of any.
struct Likelihood {
  float kappa, floor;
};
/// Directions that a heading may have; of several the likeliest counts.
struct Headings {
  float cosine[2], sine[2];
  int count;      ///< 1 or 2
  bool bothWays;  ///< or 180 degrees away
};
struct Mean {
  double weight = 0.0;  ///< the sum
  double x = 0.0, y = 0.0, cosine = 0.0, sine = 0.0;
};

struct Spread {
  double variance = 0.0;  ///< sum of the weighted squares of the distances
  double farthest = 0.0;  ///< largest square of a distance
};

/// Numbers of the cells of a grid that begins at (-left, -bottom).
struct Grid {
  float left, bottom, perMetre;
  int columns, rows;
};

/// Sixteen random generators side by side (xorshift128, Marsaglia 2003); no state may be zero.
struct NoiseLanes {
  std::array<std::uint32_t, block> x, y, z, w;
};

/// All that is done to particles. `scratch` has n places; no two arrays may be the same.
struct Kernels {
  /// Each particle moves with normal noise of its own: arrays of n.
  void (*move)(const Poses& poses, const Motion& motion, const float* noiseTurn,
               const float* noiseAlong, const float* noiseAcross);
  /// Multiplies the weights by the likelihood of a corner at (x, y) seen in this direction from the
  /// heading.
  void (*weighBearing)(const Poses& poses, float* weight, float x, float y, float cosine,
                       float sine, const Likelihood& likelihood);
  /// The same for the yaw; then the weights add up to 1. Gives the sum that they had before, so
  /// that the yaw does not enter it; what is below minSum cannot be trusted, nor what came of it.
  double (*weighHeading)(const Poses& poses, float* weight, float* scratch,
                         const Headings& headings, const Likelihood& likelihood);
  double (*sum)(const float* values, int n);
  double (*sumOfSquares)(const float* values, int n);
  void (*scale)(float* values, int n, float factor);
  Mean (*meanOf)(const Poses& poses, const float* weight);
  /// The same of those within `reach` of (x, y).
  Mean (*meanNear)(const Poses& poses, const float* weight, float* scratch, float x, float y,
                   float reach);
  Spread (*spreadAbout)(const Poses& poses, const float* weight, float x, float y);
  void (*cellsOf)(const Poses& poses, const Grid& grid, std::int32_t* cells);
  /// Nearly normal numbers: each is the sum of the four bytes of a random one (Irwin-Hall: mean 0,
  /// variance 1, nothing beyond +-3.46, 1021 steps).
  void (*fillNormal)(NoiseLanes& lanes, float* out, int n);
};

/// Returns null if the processor or compiler lacks this level. All levels give the same bits.
const Kernels* kernelsOf(SimdLevel level);
/// Returns those of the highest level that the processor has.
const Kernels& kernels();

}  // namespace pitchboard::link::particles
