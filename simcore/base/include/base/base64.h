// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Converts bytes to Base64 text (RFC 4648, the standard alphabet, with padding) and back. Pure
// functions; any thread.

#include <optional>
#include <string>
#include <string_view>

namespace pitchboard {

std::string toBase64(std::string_view bytes);
/// Decodes a text, with or without padding. Returns nothing if it has other characters.
std::optional<std::string> fromBase64(std::string_view letters);

}  // namespace pitchboard
