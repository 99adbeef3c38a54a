// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds the value of a mapped field in messages. Not thread-safe.

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <telemetry/recordings/recording.h>

namespace pitchboard::link {

/// Finds the value of a path in messages; the place is looked up once for each shape.
class TopicPath {
 public:
  explicit TopicPath(std::string path = {}) : m_path(std::move(path)) {}
  bool isEmpty() const { return m_path.empty(); }
  /// Returns nothing if the message does not have it, or has a text or NaN there.
  std::optional<double> number(const telemetry::RecordedMessage& message) const;
  std::optional<std::string_view> text(const telemetry::RecordedMessage& message) const;

 private:
  std::optional<std::size_t> find(const telemetry::RecordedMessage& message) const;
  std::string m_path;
  mutable std::shared_ptr<const telemetry::RecordedShape> m_shape;  ///< of the place
  mutable std::optional<std::size_t> m_index;
};

}  // namespace pitchboard::link
