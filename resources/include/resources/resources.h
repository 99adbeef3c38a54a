// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The data files that are compiled into the program, such as scenarios, noise presets and the map
// of variables. Constant data; any thread.

#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

namespace pitchboard {

struct Resource {
  std::string_view path;  ///< relative to resources/, e.g. "scenarios/match-3v3.json"
  std::string_view text;
};

/// Returns all embedded files in order of path.
std::span<const Resource> resources();
/// Returns the text of a file; empty if there is no such file.
std::string_view resourceText(std::string_view path);
/// Returns the names of the files in a folder such as "noise", without ".json": those in `first`,
/// then the others in order of name. New files are found without a change in the code.
std::vector<std::string_view> resourceNames(std::string_view folder,
                                            std::initializer_list<std::string_view> first = {});

}  // namespace pitchboard
