// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The variables of an attached blackboard and where its words lie. Private to robotlink/live. Any
// thread.

#include <robotlink/live/attached_robots.h>

namespace pitchboard::link {

struct BoardMap {
  VariableCatalog catalog;
  SegmentLayout layout;
};

/// Errors name the catalog and what does not fit.
Result<BoardMap> mapOf(const AttachedBoard& board,
                       const VariableCatalog& usual = VariableCatalog::published());

}  // namespace pitchboard::link
