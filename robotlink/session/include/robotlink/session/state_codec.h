// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A WorldState as bytes, without loss: for checkpoints in memory and in session files. Little
// machine dependence: whole numbers are varints (LEB128, signed ones zigzag), doubles are their
// IEEE bits with trailing zero bytes left out. Bytes from a file are hostile: every count and every
// number is checked before it is used.

#include <string>
#include <string_view>

#include <base/result.h>
#include <simcore/world/world_state.h>

namespace pitchboard::link {

/// Appends to `out`. Any state of a Simulation can be encoded.
void encodeState(const sim::WorldState& state, std::string& out);
std::string encodeState(const sim::WorldState& state);

/// The equal state. Takes what it used off the front of `bytes`. Error ParseError for bytes that
/// are no state, Unsupported for a later version; both with the offset. What it returns can be put
/// into a simulation (Simulation::restore()).
Result<sim::WorldState> decodeState(std::string_view& bytes);

}  // namespace pitchboard::link
