// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The robot's blackboard, which the agent only reads. It is attached as soon as it exists, and
// attached again if it was removed and created anew. One thread at a time.

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

  /// Looks for the segment, at most five times a second. Returns a message for the log after each
  /// change, otherwise an empty text.
  std::string look(std::chrono::microseconds now);

  bool isThere() const { return m_view.has_value(); }
  /// Reads the variables into `words`, which becomes empty if there is no blackboard. Each word is
  /// read atomically, but not all at the same instant.
  void read(std::span<const link::Variable> variables, std::vector<std::uint32_t>& words) const;

 private:
  int m_key;
  link::SegmentLayout m_layout;
  std::optional<link::SegmentView> m_view;
  std::optional<std::chrono::microseconds> m_looked;
  std::string m_reported;
};

}  // namespace pitchboard::agent
