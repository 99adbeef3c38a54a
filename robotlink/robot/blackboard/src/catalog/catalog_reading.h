// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the three catalog readers share: entries with the place they came from, and the checks that
// every text must pass before it is read.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <base/byte_sizes.h>
#include <robotlink/blackboard/variable_catalog.h>

namespace pitchboard::link {

/// A variable as found in a file. `where` is "file:line" or "file: JSON path", for messages.
/// `index` is wide, so that an absurd number is refused by range and not by overflow.
struct CatalogEntry {
  std::string name;
  VariableType type = VariableType::Int;
  long long index = 0;
  std::string where;
};

inline constexpr std::size_t maxCatalogBytes = mebibyte;
/// What a number of more digits than any index is read as: out of every range.
inline constexpr long long absurdIndex = 1'000'000'000'000LL;

std::string atLine(std::string_view source, int line);
/// An index in C or Python notation (decimal, 0x, leading 0 is octal); empty for anything else.
std::optional<long long> parseIndex(std::string_view digits);
bool isIdentifier(std::string_view name);
/// Size, emptiness and bytes that no text has; a UTF-8 byte-order mark is taken off `text`.
std::optional<Error> checkCatalogText(std::string_view& text, std::string_view source);

}  // namespace pitchboard::link
