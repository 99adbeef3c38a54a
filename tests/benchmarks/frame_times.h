// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Times of single passes of a benchmark, beside the mean that Google Benchmark prints: on a machine
// that others use too, the least and the median say what the program itself needs.

#include <algorithm>
#include <chrono>
#include <vector>

#include <benchmark/benchmark.h>

class FrameTimes {
 public:
  /// `unit`: seconds in one of what is printed, 1e-3 for milliseconds.
  explicit FrameTimes(double unit) : m_unit(unit) {}

  void begin() { m_begin = Clock::now(); }
  void end() { m_times.push_back(std::chrono::duration<double>(Clock::now() - m_begin).count()); }

  /// Counters `best` and `median`.
  void report(benchmark::State& state) {
    if (m_times.empty()) return;
    std::ranges::sort(m_times);
    state.counters["best"] = m_times.front() / m_unit;
    state.counters["median"] = m_times[m_times.size() / 2] / m_unit;
  }

 private:
  using Clock = std::chrono::steady_clock;
  double m_unit;
  Clock::time_point m_begin;
  std::vector<double> m_times;
};
