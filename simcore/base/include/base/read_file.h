// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads a whole file into memory, up to a limit. Also works for pipes and files of /proc, which do
// not know their size. Pure functions; any thread.

#include <cstddef>
#include <string>

#include <base/result.h>

namespace pitchboard {

/// Returns the content of a file; `what` begins an error: "The profile". Fails with NotFound, with
/// Unsupported if it has more than `maxBytes`, or with SystemError (also for a folder).
Result<std::string> readFile(const std::string& path, std::size_t maxBytes,
                             const std::string& what = "The file");
/// The same for an open descriptor such as standard input; it stays open.
Result<std::string> readDescriptor(int descriptor, std::size_t maxBytes, const std::string& what,
                                   const std::string& context);

}  // namespace pitchboard
