// SPDX-License-Identifier: GPL-3.0-or-later
#include "write_rate.h"

namespace pitchboard::telemetry {
namespace {

constexpr double window = 60.0;     // s
constexpr double shortest = 3.0;    // s; less says nothing about the next minutes
constexpr double betweenTwo = 0.5;  // s

}  // namespace

void WriteRate::note(double seconds, std::uint64_t bytes) {
  if (m_samples.size() >= 2 && seconds - m_samples[m_samples.size() - 2].seconds < betweenTwo) {
    m_samples.back() = {seconds, bytes};
  } else {
    m_samples.push_back({seconds, bytes});
  }
  while (m_samples.size() > 2 && seconds - m_samples[1].seconds >= window) m_samples.pop_front();
}

double WriteRate::bytesPerSecond() const {
  if (m_samples.empty()) return 0.0;
  const Sample &first = m_samples.front(), &last = m_samples.back();
  const double seconds = last.seconds - first.seconds;
  if (seconds < shortest || last.bytes <= first.bytes) return 0.0;
  return static_cast<double>(last.bytes - first.bytes) / seconds;
}

}  // namespace pitchboard::telemetry
