// SPDX-License-Identifier: GPL-3.0-or-later
#include "soccer/ball_track.h"

#include <algorithm>
#include <cmath>

namespace pitchboard::link {
namespace {

constexpr double trackMemory = 1.0;  // s
constexpr double minSpan = 0.35;     // s between the first and the last sighting
constexpr double minSpeed = 0.25;    // m/s
constexpr double errorShare = 0.08;  // of the distance
constexpr double errorLeast = 0.03;  // m
constexpr double surely = 2.5;       // standard deviations
constexpr std::size_t minCount = 4;

}  // namespace

void BallTrack::see(const Point& place, double away, double now) {
  m_seen[m_next] = {place, away, now};
  m_next = (m_next + 1) % m_seen.size();
}

/// The straight line through the sightings, by least squares.
Velocity BallTrack::velocity(double now) const {
  double count = 0.0, time = 0.0, x = 0.0, y = 0.0, away = 0.0, first = now,
         last = now - trackMemory;
  for (const Sighting& one : m_seen) {
    if (now - one.time > trackMemory) continue;
    count += 1.0;
    time += one.time;
    x += one.place.x;
    y += one.place.y;
    away += one.away;
    first = std::min(first, one.time);
    last = std::max(last, one.time);
  }
  if (count < static_cast<double>(minCount) || last - first < minSpan) return {};
  time /= count;
  x /= count;
  y /= count;
  double spread = 0.0, alongX = 0.0, alongY = 0.0;
  for (const Sighting& one : m_seen) {
    if (now - one.time > trackMemory) continue;
    const double t = one.time - time;
    spread += t * t;
    alongX += t * (one.place.x - x);
    alongY += t * (one.place.y - y);
  }
  const Velocity v{alongX / spread, alongY / spread};
  const double error = (errorLeast + errorShare * away / count) / std::sqrt(spread);
  return length({v.x, v.y}) > minSpeed + surely * error ? v : Velocity{};
}

Point BallTrack::stopsAt(const Point& place, const sim::FieldSpec& field, double now) const {
  const Velocity v = velocity(now);
  const double speed = length({v.x, v.y});
  if (speed <= 0.0) return place;
  double range = sim::rollingDistance(field.surface, speed);
  const auto clip = [&range, speed](double from, double along, double most) {
    if (along == 0.0) return;
    const double left = (along > 0.0 ? most - from : most + from) * speed / std::abs(along);
    range = std::min(range, std::max(0.0, left));
  };
  clip(place.x, v.x, field.halfLength());
  clip(place.y, v.y, field.halfWidth());
  return {place.x + range * v.x / speed, place.y + range * v.y / speed};
}

}  // namespace pitchboard::link
