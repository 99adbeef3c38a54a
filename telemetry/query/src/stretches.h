// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The stretches in which a condition holds, found from its samples in order of time. A stretch ends
// at the next sample at which the condition does not hold; at its own last sample if no other one
// follows within 10 s. Private to the library; plain value. Times are s.

#include <cmath>
#include <vector>

#include <telemetry/query/find_moments.h>
#include <telemetry/series/series_summary.h>

namespace pitchboard::telemetry {

class Stretches {
 public:
  /// How far a sample exceeds the limit, and the value that does; NaN if there is none.
  struct Excess {
    double amount, value;
  };

  /// `excessOf` is called only where the condition holds.
  template <class ExcessOf>
  void add(double time, bool holds, ExcessOf excessOf) {
    if (m_isEmpty) m_first = time, m_isFirstTrue = holds, m_isEmpty = false;
    follow(time, holds);
    if (holds) take(m_found.back(), excessOf(), time);
  }
  /// Adds the stretches of the samples that follow.
  void append(const Stretches& next) {
    if (next.m_isEmpty) return;
    if (m_isEmpty) {
      *this = next;
      return;
    }
    const bool isOne =
        m_isOpen && next.m_isFirstTrue && next.m_first - m_last <= SummaryPart::maxSilence;
    follow(next.m_first, next.m_isFirstTrue);
    auto from = next.m_found.begin();
    if (next.m_isFirstTrue) {
      const bool isWorse =
          next.m_found.front().excess > m_found.back().excess || std::isnan(m_found.back().excess);
      Found whole = isOne && !isWorse ? m_found.back() : next.m_found.front();
      whole.from = isOne ? m_found.back().from : next.m_found.front().from;
      whole.until = next.m_found.front().until;
      m_found.back() = whole;
      ++from;
    }
    m_found.insert(m_found.end(), from, next.m_found.end());
    m_last = next.m_last;
    m_isOpen = next.m_isOpen;
  }

  struct Found {
    double from = 0.0, until = 0.0;
    double excess = 0.0, value = 0.0, valueAt = 0.0;
  };
  const std::vector<Found>& found() const { return m_found; }

  /// Whether the last stretch goes on at the last sample.
  bool isOpen() const { return m_isOpen; }
  /// Ends the last stretch if its last sample is too long ago.
  void endIfSilent(double now) { m_isOpen = m_isOpen && now - m_last <= SummaryPart::maxSilence; }
  /// Removes and returns the stretches that have ended.
  std::vector<Found> takeEnded() {
    const auto end = m_found.end() - (m_isOpen ? 1 : 0);
    std::vector<Found> out(m_found.begin(), end);
    m_found.erase(m_found.begin(), end);
    return out;
  }

 private:
  /// Ends or begins a stretch.
  void follow(double time, bool holds) {
    if (m_isOpen) {
      const bool isSilent = time - m_last > SummaryPart::maxSilence;
      m_found.back().until = isSilent ? m_last : time;
      m_isOpen = !isSilent && holds;
    }
    if (holds && !m_isOpen) {
      m_found.push_back({time, time, std::nan(""), std::nan(""), time});
      m_isOpen = true;
    }
    m_last = time;
  }
  static void take(Found& found, Excess excess, double time) {
    if (std::isnan(excess.amount) || excess.amount <= found.excess) return;
    found.excess = excess.amount;
    found.value = excess.value;
    found.valueAt = time;
  }

  std::vector<Found> m_found;
  double m_first = 0.0, m_last = 0.0;
  bool m_isEmpty = true, m_isFirstTrue = false, m_isOpen = false;
};

}  // namespace pitchboard::telemetry
