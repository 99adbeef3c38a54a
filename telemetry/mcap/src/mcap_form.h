// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which records may follow which, and which lengths they can have, by the MCAP specification
// (mcap.dev/spec). A walk through a damaged file trusts nothing else: opcodes and lengths have no
// checksum. Any thread.

#include <cstdint>
#include <optional>
#include <string_view>

#include <telemetry/mcap/mcap_records.h>

#include "mcap_source.h"

namespace pitchboard::telemetry {

/// What stands in front of every record.
struct RecordHead {
  McapOp op{};
  std::uint64_t length = 0;  ///< of the content
  bool whole = false;        ///< false: there were not enough bytes for it
};
RecordHead headIn(std::string_view bytes);

/// False for opcodes that are private or reserved for later versions; 0 is never valid.
bool isKnownRecord(McapOp op);
/// A file is laid out so that `op` can stand directly behind `before`.
bool mayFollow(McapOp before, McapOp op);
/// Records of this kind can have content of this length.
bool lengthFits(McapOp op, std::uint64_t length);
/// The lengths inside the content add up to exactly `length`. `beginning` needs to hold the content
/// up to its last inner length; maxHeadLength is enough. Without inner lengths: lengthFits().
bool formFits(McapOp op, std::string_view beginning, std::uint64_t length);
/// A record of kind `before` can end at `at`: the file ends there, or what begins there may follow.
bool mayEnd(const McapSource& source, std::uint64_t at, McapOp before);

struct McapFooter {
  std::uint64_t offset = 0;
  std::uint64_t summary = 0;  ///< where it begins; 0: there is none
  std::uint32_t crc = 0;      ///< of the summary; 0: none
};
/// Nothing when the file does not end as it should.
std::optional<McapFooter> footerOf(const McapSource& source);
/// The DataEnd at `at` is one: the summary follows, or the footer says that it does.
bool dataEndsAt(const McapSource& source, std::uint64_t at);

}  // namespace pitchboard::telemetry
