// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Encodes a WorldState as bytes without loss, for checkpoints in memory and in session files. Whole
// numbers are varints (LEB128, signed ones zigzag); doubles are their IEEE bits without trailing
// zero bytes. Bytes of a file are not trusted: every count and number is checked before it is used.
// Pure functions; any thread.

#include <string>
#include <string_view>

#include <base/result.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link {

/// Appends the encoded state to `out`. Every state of a Simulation can be encoded.
void encodeState(const sim::WorldState& state, std::string& out);
std::string encodeState(const sim::WorldState& state);

/// Decodes a state, and removes the bytes that it used from the front of `bytes`. Fails with
/// ParseError if they are no state, with Unsupported for a later version, both with the offset. The
/// result can be passed to Simulation::restore().
Result<sim::WorldState> decodeState(std::string_view& bytes);

}  // namespace pitchboard::link
