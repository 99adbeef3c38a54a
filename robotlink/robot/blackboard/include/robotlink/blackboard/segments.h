// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Lists the shared memory of this computer, for choosing what to attach. Pure function; any thread.

#include <vector>

#include <robotlink/blackboard/system_v.h>

namespace pitchboard::link {

/// Returns every segment that has a key, of any size and owner, in order of keys.
std::vector<SegmentInfo> segmentsOfThisComputer();

}  // namespace pitchboard::link
