// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/transform_tree.h>

#include <algorithm>
#include <cmath>

namespace pitchboard::link {
namespace {

Rotation product(const Rotation& a, const Rotation& b) {
  return {
      a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
      a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

}  // namespace

std::optional<Rotation> Rotation::of(double x, double y, double z, double w) {
  const double norm = std::sqrt(x * x + y * y + z * z + w * w);
  if (!(norm > 0.5) || !(norm < 2.0)) return {};
  return Rotation{x / norm, y / norm, z / norm, w / norm};
}

double Rotation::yaw() const {
  return std::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z));
}

double Rotation::tilt() const {
  return std::acos(std::clamp(1.0 - 2.0 * (x * x + y * y), -1.0, 1.0));
}

Transform3 Transform3::then(const Transform3& inner) const {
  const Rotation& q = rotation;
  // The vector, rotated: v + 2 q × (q × v + w v).
  const double cx = q.y * inner.z - q.z * inner.y + q.w * inner.x,
               cy = q.z * inner.x - q.x * inner.z + q.w * inner.y,
               cz = q.x * inner.y - q.y * inner.x + q.w * inner.z;
  return {x + inner.x + 2.0 * (q.y * cz - q.z * cy), y + inner.y + 2.0 * (q.z * cx - q.x * cz),
          z + inner.z + 2.0 * (q.x * cy - q.y * cx), product(q, inner.rotation)};
}

void TransformTree::set(const std::string& child, const std::string& parent,
                        const Transform3& transform) {
  if (m_links.size() < maxFrames || m_links.contains(child)) m_links[child] = {parent, transform};
}

std::optional<Transform3> TransformTree::find(const std::string& frame,
                                              std::string_view root) const {
  Transform3 sum;
  const std::string* at = &frame;
  for (int i = 0; i < maxDepth && *at != root; ++i) {
    const auto link = m_links.find(*at);
    if (link == m_links.end()) return {};
    sum = link->second.transform.then(sum);
    at = &link->second.parent;
  }
  if (*at != root) return {};
  return sum;
}

std::string TransformTree::rootOf(const std::string& frame) const {
  std::string at = frame;
  for (int i = 0; i < maxDepth; ++i) {
    const auto link = m_links.find(at);
    if (link == m_links.end()) break;
    at = link->second.parent;
  }
  return at;
}

}  // namespace pitchboard::link
