// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds the recordings in folders. Pure functions; any thread.

#include <functional>
#include <string>
#include <vector>

#include <base/result.h>

namespace pitchboard::telemetry {

/// Returns the recordings (*.mcap) in a folder and the folders in it, in order of their names.
/// Folders that may not be read, and links to folders, are left out. `goOn` is asked for each file;
/// after false the list is what was found until then. Fails with SystemError if the folder cannot
/// be read.
Result<std::vector<std::string>> recordingsIn(const std::string& folder,
                                              const std::function<bool()>& goOn = {});

}  // namespace pitchboard::telemetry
