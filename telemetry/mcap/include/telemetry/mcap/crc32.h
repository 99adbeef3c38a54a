// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The CRC-32 of zip, PNG and MCAP. On x86 processors that multiply without carry it takes a
// fraction of zlib's time, which counts because every byte of a recording is summed when it is
// written and when it is read. Pure function; any thread.

#include <cstdint>
#include <string_view>

namespace pitchboard::telemetry {

/// Returns the CRC-32 of bytes that continue others with the checksum `crc`; 0 if they are the
/// first. The same number as zlib's crc32().
std::uint32_t extendedCrc(std::uint32_t crc, std::string_view bytes);

/// Returns the checksum of two parts: `first` is that of the first one, `second` that of the other
/// one, which has `size` bytes.
std::uint32_t joinedCrc(std::uint32_t first, std::uint32_t second, std::uint64_t size);

}  // namespace pitchboard::telemetry
