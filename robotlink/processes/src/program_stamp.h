// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Notices that a program on the disk is another one than the one that was started. Any thread.

#include <string>

#include <robotlink/processes/child_process.h>

namespace pitchboard::link {

/// Changes when the program, or a script among its arguments, is replaced; empty when there is
/// none.
std::string programStamp(const ChildSpec& spec);

}  // namespace pitchboard::link
