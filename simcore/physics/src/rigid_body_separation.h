// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Pushes things apart that still overlap after a tick's contacts: pair after pair, round after
// round, until none of them does or a heap has had its share of rounds. What a pair does depends on
// its two bodies only; therefore pairs that have none in common may change places, and do, so that
// the processor can work on several of them at once, with the same bits. Metres. Scratch memory of
// the one who owns it; one thread.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rigid_body_contacts.h"

namespace pitchboard::sim::rigid {

class Separation {
 public:
  /// What a round needs of a NearPair.
  struct Pair {
    std::uint32_t first, second;
    bool obstacle;
    double touching;     ///< m between the middles
    double overlap;      ///< m that may stay
    double far2;         ///< m²: farther apart there is surely nothing to do
    double firstsShare;  ///< of a push
    double secondsShare;
  };

  /// `radius` of each of the `bodies`; `ball`: which MovingBody::body is the ball. Overlaps of
  /// pairs may stay.
  void separate(std::span<MovingBody> bodies, std::span<const double> radius,
                std::span<const NearPair> pairs, const Obstacles& obstacles, std::size_t ball);

  /// Room for so many, so that separate() allocates nothing.
  void reserve(std::size_t bodies, std::size_t pairs) {
    m_places.reserve(bodies);
    m_turns.reserve(bodies);
    m_given.reserve(pairs);
    m_ordered.reserve(pairs);
    m_turn.reserve(pairs);
    m_begins.reserve(pairs + 2);
  }

 private:
  Pair pairOf(const NearPair& pair, std::span<const MovingBody> bodies,
              std::span<const double> radius, const Obstacles& obstacles, std::size_t ball) const;
  void order(std::span<const Pair> pairs);

  std::vector<Point> m_places;          // of the bodies
  std::vector<Pair> m_given;            // in the caller's order
  std::vector<Pair> m_ordered;          // neighbours have no body in common, where possible
  std::vector<std::uint32_t> m_turns;   // per body: how many pairs it has been in
  std::vector<std::uint32_t> m_turn;    // per pair: when it is due
  std::vector<std::uint32_t> m_begins;  // per turn: its place among the ordered
};

}  // namespace pitchboard::sim::rigid
