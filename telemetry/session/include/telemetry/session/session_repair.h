// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Recovers a truncated or damaged recording: reads what can be read, writes it into a new file, and
// reads that back to check it. The damaged file is not changed. Runs on the calling thread.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <base/file_target.h>
#include <base/result.h>

namespace pitchboard::telemetry {

struct RepairReport {
  std::uint64_t messages = 0;      ///< messages in the new file, all of them verified
  std::uint64_t bytes = 0;         ///< size of the new file
  double seconds = 0.0;            ///< from the first message to the last
  std::uint64_t lostMessages = 0;  ///< lost messages, as far as the damaged file shows
  bool lostMore = false;           ///< more messages are lost; their number is unknown
  bool brokeOff = false;           ///< the file was cut off, so its end may be missing
  bool complete = false;           ///< nothing is missing in the new file
  std::vector<std::string> notes;  ///< sentences: what was wrong or is missing, where and when
  /// Returns one line for people: what is in the new file and what is missing.
  std::string summary() const;
};

/// Repairs `from` into the new file `to`. `progress` is called with 0 to 1; if it returns false,
/// the new file is removed. Fails with Conflict if `to` exists or is `from` itself, with ParseError
/// if nothing can be read, and with the system's reason if reading or writing fails.
Result<RepairReport> repairSession(const std::string& from, const std::string& to,
                                   const std::function<bool(double)>& progress = {},
                                   IfExists ifExists = IfExists::Refuse);

}  // namespace pitchboard::telemetry
