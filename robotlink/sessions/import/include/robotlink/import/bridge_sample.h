// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Listens to a program that speaks Foxglove's protocol for a while and keeps its messages in
// memory, to be read like a recording: for who makes a mapping for it. Blocks the calling thread.

#include <functional>

#include <base/result.h>
#include <robotlink/import/mapping_sample.h>
#include <telemetry/foxglove/foxglove_address.h>

namespace pitchboard::link {

/// Bytes of messages that are kept; listening ends there.
inline constexpr std::size_t maxBridgeSample = std::size_t{32} << 20;

/// Listens for `seconds` from the first channels on. Fails with SystemError if the program cannot
/// be reached, with NotFound if it offers no channels in time, with Conflict if `goesOn` returns
/// false.
Result<OpenRecordings> listenToBridge(const telemetry::FoxgloveAddress& address, double seconds,
                                      const std::function<bool()>& goesOn);

}  // namespace pitchboard::link
