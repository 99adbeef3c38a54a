// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What shared memory there is on this computer, for choosing what to attach. Any thread.

#include <vector>

#include <robotlink/blackboard/system_v.h>

namespace pitchboard::link {

/// Every segment that has a key, of any size and owner, in order of key.
std::vector<SegmentInfo> segmentsOfThisComputer();

}  // namespace pitchboard::link
