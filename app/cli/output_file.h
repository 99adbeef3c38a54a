// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Files that a command writes: never over an existing one unless the user says --force.

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include <base/result.h>

namespace pitchboard::cli {

/// `what` begins the sentence of an error: "the trace". The caller closes the file.
Result<std::FILE*> openForWriting(const std::string& path, bool overwrite, const char* what);

/// Error of a write or close that failed with this errno.
tl::unexpected<Error> cannotWrite(const std::string& path, int reason, const char* what);

/// The whole text at once; a partial file is removed.
Result<void> writeFile(const std::string& path, bool overwrite, std::string_view text,
                       const char* what);

}  // namespace pitchboard::cli
