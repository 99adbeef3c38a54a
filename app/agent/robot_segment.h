// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The robot's blackboard as the agent reads it: attached read-only when there is one, and again
// when it was removed and another one made. One thread.

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/blackboard/variable_catalog.h>

namespace pitchboard::agent {

class RobotSegment {
 public:
  RobotSegment(int key, const link::SegmentLayout& layout) : m_key(key), m_layout(layout) {}

  /// Looks for it, at most five times a second. Returns what a person should be told, once for
  /// each change; empty: nothing.
  std::string look(std::chrono::microseconds now);

  bool isThere() const { return m_view.has_value(); }
  /// Each word of a variable is read atomically, one after the other.
  void read(std::span<const link::Variable> variables, std::vector<std::uint32_t>& words) const;

 private:
  int m_key;
  link::SegmentLayout m_layout;
  std::optional<link::SegmentView> m_view;
  std::optional<std::chrono::microseconds> m_looked;
  std::string m_reported;
};

}  // namespace pitchboard::agent
