// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Searches for the point of a unit cube where an unknown, noisy function is largest, with CMA-ES
// (Hansen 2006) from pagmo and an ask-and-tell interface. The state of a search depends only on its
// settings and the values that it got so far, so replaying them restores it. One thread at a time.

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

/// The points of a generation and the value of each. Larger values are better.
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

  /// Returns the points of the next generation; the same ones until tell().
  Result<std::vector<std::vector<double>>> ask() const;
  /// Takes a finite value for each of these points. Fails with InvalidArgument otherwise.
  Result<void> tell(std::span<const double> values);
  /// Replays a generation. Fails with Conflict if its points are not those that ask() returns.
  Result<void> replay(const Generation& generation);

  /// Returns the centre of the distribution from which the next points are drawn.
  std::vector<double> mean() const;
  std::size_t generationsDone() const {
    return m_generationsDone;
  }  ///< number of generations so far

 private:
  struct State;
  explicit CmaSearch(std::unique_ptr<State> state);
  std::unique_ptr<State> m_state;
  std::size_t m_generationsDone = 0;
};

/// Returns pagmo's version, for the header of files.
const char* searchLibrary();

}  // namespace pitchboard::link
