// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Looks for the point of a unit cube at which an unknown, noisy function is largest: CMA-ES (Hansen
// 2006) by pagmo, as ask and tell. A search is a pure function of its settings and the values that
// it was told, so that replaying them leads to the same state. One thread at a time.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <base/result.h>

namespace pitchboard::link {

struct SearchSettings {
  std::vector<double> start;    ///< where it begins, each coordinate in [0, 1]
  std::size_t population = 16;  ///< points of a generation, at least 5
  double sigma = 0.2;           ///< first standard deviation of each coordinate
  std::uint32_t seed = 1;
  bool operator==(const SearchSettings&) const = default;
};

/// Points that were asked for, and the value of each. Larger values are better.
struct Generation {
  std::vector<std::vector<double>> points;  ///< each coordinate in [0, 1]
  std::vector<double> values;
  bool operator==(const Generation&) const = default;
};

class CmaSearch {
 public:
  /// Error InvalidArgument for settings that CMA-ES cannot use.
  static Result<CmaSearch> create(const SearchSettings& settings);
  CmaSearch(CmaSearch&&) noexcept;
  CmaSearch& operator=(CmaSearch&&) noexcept;
  ~CmaSearch();

  /// The points of the next generation; the same ones until tell().
  Result<std::vector<std::vector<double>>> ask() const;
  /// A finite value for each of them. InvalidArgument otherwise.
  Result<void> tell(std::span<const double> values);
  /// Tells what was told before. Conflict if its points are not those that ask() gives.
  Result<void> replay(const Generation& generation);

  /// The centre of the distribution from which the next points are drawn.
  std::vector<double> mean() const;
  std::size_t told() const { return m_told; }  ///< generations

 private:
  struct State;
  explicit CmaSearch(std::unique_ptr<State> state);
  std::unique_ptr<State> m_state;
  std::size_t m_told = 0;
};

/// pagmo's version, for the head of files.
const char* searchLibrary();

}  // namespace pitchboard::link
