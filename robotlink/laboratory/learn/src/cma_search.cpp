// SPDX-License-Identifier: GPL-3.0-or-later
// The only file that includes pagmo, whose exceptions end here.
#include <robotlink/learn/cma_search.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <utility>

#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/config.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include <base/try.h>

namespace pitchboard::link {
namespace {

using Points = std::vector<std::vector<double>>;

/// Two processors may differ in the last bits of a logarithm.
constexpr double sameCoordinate = 1e-9;

/// What evolve() asks for and is told.
struct Exchange {
  Points asked;
  std::span<const double> known;  ///< empty: nothing is known yet
};

/// The problem that pagmo minimises. Its copies share one exchange.
struct AskTellProblem {
  std::size_t dimensions = 1;
  Exchange* exchange = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& point) const {
    exchange->asked.push_back(point);
    const std::size_t index = exchange->asked.size() - 1;
    return {index < exchange->known.size() ? -exchange->known[index] : 0.0};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(dimensions, 0.0), pagmo::vector_double(dimensions, 1.0)};
  }
};

/// The search knows no bounds: what leaves the cube comes back as from a mirror. (pagmo's own
/// bounds would spoil the covariance.)
double foldedCoordinate(double u) {
  const double inTwo = std::abs(std::fmod(u, 2.0));
  return inTwo > 1.0 ? 2.0 - inTwo : inTwo;
}

std::vector<double> folded(std::vector<double> point) {
  for (double& u : point) u = foldedCoordinate(u);
  return point;
}

pagmo::population evolvedOnce(const pagmo::cmaes& algorithm, const pagmo::population& population,
                              Exchange& exchange, std::span<const double> known) {
  exchange = {{}, known};
  return algorithm.evolve(population);
}

tl::unexpected<Error> searchFailed(const std::exception& e) {
  return failure(ErrorCode::SystemError, std::string("the search failed: ") + e.what());
}

}  // namespace

struct CmaSearch::State {
  explicit State(const SearchSettings& s)
      : algorithm(1, -1, -1, -1, -1, s.sigma, 0.0, 0.0, true, false, s.seed),
        population(pagmo::problem(AskTellProblem{s.start.size(), &exchange}), 0U, s.seed),
        mean(s.start) {
    // The distribution begins at the best of the population.
    for (std::size_t i = 0; i < s.population; ++i)
      population.push_back(s.start, {i == 0 ? 0.0 : 1.0});
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  Exchange exchange;
  pagmo::cmaes algorithm;  ///< with what it has learned
  pagmo::population population;
  std::vector<double> mean;  ///< not folded
};

CmaSearch::CmaSearch(std::unique_ptr<State> state) : m_state(std::move(state)) {}
CmaSearch::CmaSearch(CmaSearch&&) noexcept = default;
CmaSearch& CmaSearch::operator=(CmaSearch&&) noexcept = default;
CmaSearch::~CmaSearch() = default;

Result<CmaSearch> CmaSearch::create(const SearchSettings& settings) {
  constexpr std::size_t minPopulation = 5;
  const bool inside =
      std::ranges::all_of(settings.start, [](double u) { return u >= 0 && u <= 1; });
  if (settings.start.empty() || !inside) {
    return failure(ErrorCode::InvalidArgument, "the start must lie between 0 and 1");
  }
  if (settings.population < minPopulation) {
    return failure(ErrorCode::InvalidArgument, "a population has at least 5 points");
  }
  if (!(settings.sigma > 0.0) || !std::isfinite(settings.sigma)) {
    return failure(ErrorCode::InvalidArgument, "sigma must be greater than 0");
  }
  try {
    return CmaSearch(std::make_unique<State>(settings));
  } catch (const std::exception& e) {
    return searchFailed(e);
  }
}

/// A rehearsal: all points of a generation are drawn before the first value is used.
Result<Points> CmaSearch::ask() const {
  try {
    const pagmo::cmaes rehearsal = m_state->algorithm;
    evolvedOnce(rehearsal, m_state->population, m_state->exchange, {});
    Points points;
    for (const auto& point : m_state->exchange.asked) points.push_back(folded(point));
    return points;
  } catch (const std::exception& e) {
    return searchFailed(e);
  }
}

Result<void> CmaSearch::tell(std::span<const double> values) {
  const std::size_t count = m_state->population.size();
  if (values.size() != count ||
      !std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) {
    return failure(ErrorCode::InvalidArgument,
                   "a generation has " + std::to_string(count) + " finite values");
  }
  try {
    m_state->population =
        evolvedOnce(m_state->algorithm, m_state->population, m_state->exchange, values);
  } catch (const std::exception& e) {
    return searchFailed(e);
  }
  // pagmo does not show the mean: that of the better half, weighted as in Hansen (2006).
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return values[i]; });
  std::vector<double> mean(m_state->mean.size(), 0.0);
  double sum = 0.0;
  const std::size_t better = count / 2;
  for (std::size_t rank = 0; rank < better; ++rank) {
    const double weight =
        std::log(static_cast<double>(better) + 0.5) - std::log(static_cast<double>(rank) + 1.0);
    const auto& point = m_state->exchange.asked[order[rank]];
    for (std::size_t d = 0; d < mean.size(); ++d) mean[d] += weight * point[d];
    sum += weight;
  }
  for (double& u : mean) u /= sum;
  m_state->mean = std::move(mean);
  ++m_generationsDone;
  return {};
}

Result<void> CmaSearch::replay(const Generation& generation) {
  const auto points = TRY(ask());
  const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::ranges::equal(a, b,
                              [](double x, double y) { return std::abs(x - y) <= sameCoordinate; });
  };
  if (!std::ranges::equal(points, generation.points, same)) {
    return failure(
        ErrorCode::Conflict,
        "generation " + std::to_string(m_generationsDone + 1) +
            " has other points than this search draws; it was started by another version "
            "or with other settings");
  }
  return tell(generation.values);
}

std::vector<double> CmaSearch::mean() const {
  return folded(m_state->mean);
}

const char* searchLibrary() {
  return "pagmo " PAGMO_VERSION;
}

}  // namespace pitchboard::link
