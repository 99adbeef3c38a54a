// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The system's own words for a call that failed, for the sentences of errors. Any thread.

#include <string>

namespace pitchboard {

/// `error`: an errno value.
std::string systemReason(int error);

}  // namespace pitchboard
