// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot_segment.h"

#include <utility>

namespace pitchboard::agent {

std::string RobotSegment::look(std::chrono::microseconds now) {
  constexpr std::chrono::microseconds step = std::chrono::milliseconds(200);
  if (m_looked && now - *m_looked < step) return {};
  m_looked = now;
  if (m_view && m_view->isThere()) return {};
  auto view = link::SegmentView::attach(m_key, m_layout.bytes);
  const std::string name = "blackboard " + std::to_string(m_key);
  std::string text;
  const bool found = view.has_value();
  if (found) {
    text = m_view ? name + " was created again; reading the new one" : "reading " + name;
    m_view = *std::move(view);
  } else if (m_view && m_view->isShared()) {
    text = name + " was removed, but the robot's programs still use it; still reading it";
  } else {
    m_view.reset();
    text = view.error().code == ErrorCode::NotFound ? "waiting for " + name : view.error().text();
  }
  if (text == m_reported && !found) return {};
  return m_reported = std::move(text);
}

void RobotSegment::read(std::span<const link::Variable> variables,
                        std::vector<std::uint32_t>& words) const {
  words.clear();
  if (!m_view) return;
  for (const link::Variable& variable : variables) {
    const int offset = variable.type == link::VariableType::Float ? m_layout.floatOffset : 0;
    words.push_back(
        m_view->word(static_cast<std::size_t>(offset) + static_cast<std::size_t>(variable.index)));
  }
}

}  // namespace pitchboard::agent
