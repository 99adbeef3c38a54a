// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A tree of coordinate frames as ROS publishes it (tf2): each frame has a parent and a transform to
// it. Plain values in m and rad; private to import; one thread.

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <base/geometry.h>

namespace pitchboard::link {

/// A unit quaternion.
struct Rotation {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;

  /// Returns nothing if the numbers are not a rotation.
  static std::optional<Rotation> of(double x, double y, double z, double w);
  double yaw() const;   ///< about the vertical axis, of what points forward
  double tilt() const;  ///< rad, between the own and the vertical axis
};

struct Transform3 {
  double x = 0.0, y = 0.0, z = 0.0;
  Rotation rotation;
  /// Returns the transform of what `inner` places into this frame.
  Transform3 then(const Transform3& inner) const;
};

class TransformTree {
 public:
  static constexpr std::size_t maxFrames = 2000;
  static constexpr int maxDepth = 50;

  void set(const std::string& child, const std::string& parent, const Transform3& transform);
  /// Returns where `frame` is in `root`; nothing if no chain leads there.
  std::optional<Transform3> find(const std::string& frame, std::string_view root) const;
  /// Returns the frame without a parent above `frame`.
  std::string rootOf(const std::string& frame) const;

 private:
  struct Link {
    std::string parent;
    Transform3 transform;
  };
  std::map<std::string, Link> m_links;
};

}  // namespace pitchboard::link
