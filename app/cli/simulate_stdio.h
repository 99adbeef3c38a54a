// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// `simulate --stdio`: lines of JSON from standard input, an answer to each on standard output,
// until the input ends. For the program's first thread.

#include <base/result.h>
#include <robotlink/scenario/scenario.h>

namespace pitchboard::cli {

/// `usual`: what worlds are made of when a request names no scenario. Fails when an answer cannot
/// be written.
Result<void> serveWorldLines(link::Scenario usual);

}  // namespace pitchboard::cli
