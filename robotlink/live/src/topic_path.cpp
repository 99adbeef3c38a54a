// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/topic_path.h>

#include <algorithm>
#include <cmath>

namespace pitchboard::link {

using telemetry::RecordedKind;
using telemetry::RecordedMessage;

std::optional<std::size_t> TopicPath::find(const RecordedMessage& message) const {
  if (m_path.empty()) return {};
  if (m_shape != message.shape) {
    m_shape = message.shape;
    const auto& fields = message.shape->fields;
    const auto found = std::ranges::find(fields, m_path, &telemetry::RecordedField::path);
    m_index.reset();
    if (found != fields.end()) m_index = static_cast<std::size_t>(found - fields.begin());
  }
  return m_index;
}

std::optional<double> TopicPath::number(const RecordedMessage& message) const {
  const auto place = find(message);
  if (!place || !std::isfinite(message.values[*place])) return {};
  return message.values[*place];
}

std::optional<std::string_view> TopicPath::text(const RecordedMessage& message) const {
  const auto place = find(message);
  if (!place || message.shape->fields[*place].kind != RecordedKind::Text) return {};
  const auto& fields = message.shape->fields;
  const auto before =
      std::count_if(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(*place),
                    [](const auto& field) { return field.kind == RecordedKind::Text; });
  return message.texts[static_cast<std::size_t>(before)];
}

}  // namespace pitchboard::link
