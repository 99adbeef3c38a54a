// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/statistics/distributions.h>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/hypergeometric.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace pitchboard::telemetry {
namespace {

namespace math = boost::math;

math::hypergeometric_distribution<> tablesOf(const DrawnSuccesses& of) {
  const auto whole = [](std::size_t value) { return static_cast<unsigned>(value); };
  return {whole(of.successes), whole(of.drawn), whole(of.all)};
}

}  // namespace

double normalCdf(double z) {
  return math::cdf(math::normal(), z);
}
double normalQuantile(double p) {
  return math::quantile(math::normal(), p);
}

double chiSquaredQuantile(double freedom, double p) {
  return math::quantile(math::chi_squared(freedom), p);
}

double studentTail(double freedom, double t) {
  return math::cdf(math::complement(math::students_t(freedom), t));
}
double studentUpperQuantile(double freedom, double tail) {
  return math::quantile(math::complement(math::students_t(freedom), tail));
}

RateBounds clopperPearson(double successes, double trials, double tail) {
  using Binomial = math::binomial_distribution<>;
  return {Binomial::find_lower_bound_on_p(trials, successes, tail),
          Binomial::find_upper_bound_on_p(trials, successes, tail)};
}

double DrawnSuccesses::probability(std::size_t x) const {
  return math::pdf(tablesOf(*this), static_cast<unsigned>(x));
}
double DrawnSuccesses::upTo(std::size_t x) const {
  return math::cdf(tablesOf(*this), static_cast<unsigned>(x));
}
double DrawnSuccesses::above(std::size_t x) const {
  return math::cdf(math::complement(tablesOf(*this), static_cast<unsigned>(x)));
}

}  // namespace pitchboard::telemetry
