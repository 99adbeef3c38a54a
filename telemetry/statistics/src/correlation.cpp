// SPDX-License-Identifier: GPL-3.0-or-later
#include "correlation.h"

#include <Eigen/Core>
#include <unsupported/Eigen/FFT>

#include <bit>
#include <complex>

namespace pitchboard::telemetry {

std::vector<double> shiftedProducts(std::span<const double> a, std::span<const double> b,
                                    std::size_t most) {
  // Padded, so that the ends do not meet: the transform is of a circle.
  const std::size_t size = std::bit_ceil(std::max(a.size(), b.size()) + most + 1);
  const auto transformed = [size](std::span<const double> values, Eigen::FFT<double>& fft) {
    std::vector<double> padded(size, 0.0);
    std::copy(values.begin(), values.end(), padded.begin());
    std::vector<std::complex<double>> out;
    fft.fwd(out, padded);
    return out;
  };
  Eigen::FFT<double> fft;
  const std::vector<std::complex<double>> first = transformed(a, fft);
  std::vector<std::complex<double>> product = transformed(b, fft);
  for (std::size_t i = 0; i < product.size(); ++i) product[i] *= std::conj(first[i]);
  std::vector<double> circle;
  fft.inv(circle, product);
  std::vector<double> out(2 * most + 1);
  for (std::size_t lag = 0; lag <= most; ++lag) {
    out[most + lag] = circle[lag];
    if (lag > 0) out[most - lag] = circle[size - lag];
  }
  return out;
}

}  // namespace pitchboard::telemetry
