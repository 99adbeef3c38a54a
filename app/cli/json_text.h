// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes JSON without building a document first: the same bytes as dump() makes of one
// (live_json.h), for lines that are printed by the hundred thousand. Pure functions; any thread.

#include <string>
#include <string_view>

namespace pitchboard::cli {

/// Appends a string in quotation marks; bytes that are not UTF-8 are replaced.
void addJsonText(std::string& out, std::string_view text);
/// Appends a number, with a decimal point or an exponent; null if it is not finite.
void addJsonNumber(std::string& out, double value);
/// Appends the key of the next member of an object that `out` ends in, with comma and colon.
void addJsonKey(std::string& out, std::string_view key);

}  // namespace pitchboard::cli
