// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sums of products of shifted series, by the fast Fourier transform. Private to the library; pure
// function.

#include <span>
#include <vector>

namespace pitchboard::telemetry {

/// Returns the sum over i of a[i] * b[i + lag] for each lag from -most to +most; values beyond the
/// ends count as 0. Rounding leaves an error of about 1e-15 of the largest sum.
std::vector<double> shiftedProducts(std::span<const double> a, std::span<const double> b,
                                    std::size_t most);

}  // namespace pitchboard::telemetry
