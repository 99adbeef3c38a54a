// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A match number for one test, so that tests that play matches may run beside each other.

#include <QtGlobal>

#include <optional>
#include <utility>

#include <robotlink/blackboard/match_number.h>
#include <robotlink/blackboard/system_v.h>

/// A match number that no other test has while this one lives, and that programs may take: they
/// look for a free one from 0 upwards, this looks from the highest one downwards.
class OwnMatchNumber {
 public:
  OwnMatchNumber() {
    using namespace pitchboard::link;
    for (m_number.value = MatchNumber::most; m_number.value > 9; --m_number.value) {
      // The key of a robot that there is not: tests exclude each other with it, and nobody else.
      auto reserved = BridgeClaim::take(m_number.keyBase() + 9900);
      if (!reserved || !MatchClaim::take(m_number.value)) continue;
      m_reserved.emplace(std::move(*reserved));
      return;
    }
    qFatal("every match number is taken");
  }
  int value() const { return m_number.value; }
  const pitchboard::link::MatchNumber& number() const { return m_number; }

 private:
  pitchboard::link::MatchNumber m_number;
  std::optional<pitchboard::link::BridgeClaim> m_reserved;
};
