// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a ball moves that one robot sees: from the sightings of the last second, in the field's
// frame. Camera and belief err by several per cent of the distance, so that a ball counts as
// rolling only when it has gone farther than they could be wrong. Metres, seconds; a plain value.

#include <array>
#include <cstddef>

#include <base/geometry.h>
#include <simcore/world/field.h>

namespace pitchboard::link {

class BallTrack {
 public:
  /// Seen now at `place`, from `away` metres.
  void see(const Point& place, double away, double now);
  /// m/s; zero while it lies still, as far as this robot can tell.
  Velocity velocity(double now) const;
  /// Where a ball that is at `place` now comes to rest, at the latest at the lines of the field.
  Point stopsAt(const Point& place, const sim::FieldSpec& field, double now) const;

 private:
  struct Sighting {
    Point place;
    double away = 0.0, time = -1e9;
  };
  std::array<Sighting, 10> m_seen;  // the newest at m_next - 1
  std::size_t m_next = 0;
};

}  // namespace pitchboard::link
