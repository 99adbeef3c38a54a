// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Data files that are part of the program: variable map, scenarios, noise presets.

#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

namespace pitchboard {

struct Resource {
  std::string_view path;  ///< relative to resources/, e.g. "scenarios/match-3v3.json"
  std::string_view text;
};

/// Every embedded file, in order of path.
std::span<const Resource> resources();
/// The text of one file; empty when there is no such file.
std::string_view resourceText(std::string_view path);
/// What a folder ("noise") offers by name: its files without ".json", `first` before the others,
/// which follow by name. A new file is offered with no other line anywhere.
std::vector<std::string_view> resourceNames(std::string_view folder,
                                            std::initializer_list<std::string_view> first = {});

}  // namespace pitchboard
