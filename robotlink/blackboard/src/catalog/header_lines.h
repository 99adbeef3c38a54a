// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A C header as a preprocessor sees it: lines with their comments taken aside.

#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>

namespace pitchboard::link {

struct HeaderLine {
  int number = 0;       ///< of its first line, from 1
  std::string code;     ///< continued lines joined, a blank for each comment
  std::string comment;  ///< text of all comments that end or run on this line
};

/// Fails, with the line, when a comment is never closed.
Result<std::vector<HeaderLine>> headerLines(std::string_view text, std::string_view source);

}  // namespace pitchboard::link
