// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes a whole file of a recording that broke off or is damaged: reads what can be read, writes it
// into a new file and reads that back. The broken file is not touched. One thread.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <base/result.h>

namespace pitchboard::telemetry {

struct RepairReport {
  std::uint64_t messages = 0;      ///< rows and others, all verified in the new file
  std::uint64_t bytes = 0;         ///< of the new file
  double seconds = 0.0;            ///< from the first message to the last
  std::uint64_t lostMessages = 0;  ///< as far as the broken file says how many there were
  bool lostMore = false;           ///< and others, of which nobody knows how many
  bool brokeOff = false;           ///< the broken file has no end, so what came last may be missing
  bool complete = false;           ///< nothing is missing: all that was recorded is in the new file
  std::vector<std::string> notes;  ///< what was wrong and what is missing, with offset and time
  /// One line for the screen: what is in the new file and what is not.
  std::string summary() const;
};

/// `progress` gets 0 to 1; false stops and removes the new file. Error Conflict when `to` exists
/// (it is left alone) or is `from` itself, ParseError when nothing in `from` can be read, and those
/// of reading and writing.
Result<RepairReport> repairSession(const std::string& from, const std::string& to,
                                   const std::function<bool(double)>& progress = {});

}  // namespace pitchboard::telemetry
