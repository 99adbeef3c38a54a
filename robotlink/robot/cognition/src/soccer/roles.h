// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where those stand who do not go for the ball, and who of them stands where. Everybody computes
// the same from what the team tells. Turned so that the team attacks towards +x; metres. Pure
// functions.

#include <optional>
#include <span>

#include <base/geometry.h>
#include <base/inline_vector.h>
#include <simcore/world/field.h>

namespace pitchboard::link {

enum class Role { PassOffer, Cover, Wing, Reserve };

struct Placing {
  Role role = Role::Reserve;
  Point place;
  bool operator==(const Placing&) const = default;
};

using Placings = InlineVector<Placing, 22>;

/// Between two of them, and to the ball.
inline constexpr double placesApart = 1.2;

/// As many places as robots, the most important first, all on the field. `side`: +1 where the left
/// has more room, else -1. `passRange`: how far this team's passes roll, m.
Placings placingsFor(const sim::FieldSpec& field, const Point& ball, double side, double passRange,
                     std::size_t robots);

/// Which place the first of `robots` takes: whoever is nearest to one takes it. `kept`, its place
/// until now, counts as if it were nearer. There are at least as many places as robots.
std::size_t placeOf(std::span<const Point> robots, std::span<const Point> places,
                    std::optional<std::size_t> kept = {});

/// Where a team stands at a kick-off: ten places in its own half and outside the centre circle.
InlineVector<Point, 22> kickOffPlaces(const sim::FieldSpec& field);

}  // namespace pitchboard::link
