// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Decides whether a process of a robot works. Robots clear their *_WORKING flags after each
// message, so a busy process may miss one; the published filter forgives that (system.md section
// 7).

#include <algorithm>

namespace pitchboard::telemetry {

class ProcessFilter {
 public:
  ProcessFilter() = default;
  /// Continues from the probability of another filter.
  explicit ProcessFilter(double probability) : m_p(std::clamp(probability, 0.001, 0.999)) {}
  /// Takes the flag of a message.
  void update(bool flag) {
    m_p = flag ? 0.9 * m_p / (0.01 + 0.89 * m_p) : 0.1 * m_p / (0.99 - 0.89 * m_p);
    m_p = std::clamp(m_p, 0.001, 0.999);
  }
  /// Returns the probability that the process works, 0.001 to 0.999; 0.5 before the first message.
  double probability() const { return m_p; }
  bool working() const { return m_p >= 0.5; }

 private:
  double m_p = 0.5;
};

}  // namespace pitchboard::telemetry
