// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads a whole file into memory, never more than its reader can use. Also for pipes and for the
// files of /proc, which do not know their size. Any thread.

#include <cstddef>
#include <string>

#include <base/result.h>

namespace pitchboard {

/// `what` begins the sentence of an error: "The profile". Error NotFound when there is no such
/// file, Unsupported when it has more than `mostBytes`, SystemError for the rest (a folder too).
Result<std::string> readFile(const std::string& path, std::size_t mostBytes,
                             const std::string& what = "The file");
/// The same from an open descriptor, e.g. standard input, up to its end; it stays open.
Result<std::string> readDescriptor(int descriptor, std::size_t mostBytes, const std::string& what,
                                   const std::string& context);

}  // namespace pitchboard
