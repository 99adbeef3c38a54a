// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Returns the system's text for a failed call, for error messages. Pure function; any thread.

#include <string>

namespace pitchboard {

/// `error` is a value of errno.
std::string systemReason(int error);

}  // namespace pitchboard
