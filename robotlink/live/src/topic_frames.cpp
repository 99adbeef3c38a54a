// SPDX-License-Identifier: GPL-3.0-or-later
#include "topic_frames.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pitchboard::link {

using telemetry::RecordedKind;
using telemetry::RecordedMessage;

namespace {

std::string lastPart(const std::string& frame) {
  const auto slash = frame.rfind('/');
  return slash == frame.npos ? frame : frame.substr(slash + 1);
}

}  // namespace

std::string prefixOf(const std::string& frame) {
  const auto slash = frame.rfind('/');
  if (slash == frame.npos || slash == 0) return {};
  return frame.substr(frame.starts_with('/') ? 1 : 0, slash - (frame.starts_with('/') ? 1 : 0));
}

bool isFieldFrame(const std::string& frame) {
  static constexpr std::array<std::string_view, 5> names{"map", "world", "field", "soccer_field",
                                                         "global"};
  return std::ranges::find(names, lastPart(frame)) != names.end();
}

bool isRobotFrame(const std::string& frame) {
  static constexpr std::array<std::string_view, 7> names{
      "base_footprint", "base_link", "torso", "trunk", "pelvis", "body", "base"};
  return std::ranges::find(names, lastPart(frame)) != names.end();
}

std::vector<std::string> takeTransforms(const RecordedMessage& message, TransformTree& tree) {
  // Each transform begins with the frame that it is relative to.
  const auto& fields = message.shape->fields;
  constexpr std::string_view parentEnd = "].header.frame_id", begin = "transforms[";
  std::size_t text = 0;
  std::vector<std::string> moved;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].kind != RecordedKind::Text) continue;
    const std::string_view parent = message.texts[text++];
    if (!fields[i].path.starts_with(begin) || !fields[i].path.ends_with(parentEnd)) continue;
    // Behind it: the frame, three numbers of the translation, four of the rotation.
    if (i + 8 >= fields.size() || text >= message.texts.size()) continue;
    const std::string child(message.texts[text]);
    const auto* values = message.values.data() + i + 2;
    const auto rotation = Rotation::of(values[3], values[4], values[5], values[6]);
    const bool isFinite =
        std::all_of(values, values + 3, [](double v) { return std::isfinite(v); });
    if (!fields[i + 1].path.ends_with("].child_frame_id") || !rotation || !isFinite) continue;
    tree.set(child, std::string(parent), {values[0], values[1], values[2], *rotation});
    moved.push_back(child);
  }
  return moved;
}

}  // namespace pitchboard::link
