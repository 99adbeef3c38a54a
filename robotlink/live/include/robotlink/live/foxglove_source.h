// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A program whose topics Live shows, such as the Foxglove bridge of a robot, and whose robots they
// are. Plain values; any thread.

#include <string>
#include <string_view>
#include <vector>

#include <base/result.h>
#include <base/team_color.h>
#include <telemetry/foxglove/foxglove_address.h>

namespace pitchboard::link {

struct FoxgloveSource {
  telemetry::FoxgloveAddress address;
  int robot = 0;  ///< number of the robot whose topics have no namespace; 0: from host or topics
  TeamColor team = TeamColor::Blue;  ///< of its robots
  std::string mappingFile{};         ///< what topics mean (topic_mapping.h); empty: the usual
  bool operator==(const FoxgloveSource&) const = default;
};
inline constexpr std::size_t maxFoxgloveSources = 64;

/// Reads "ws://robot3:8765,robot=3,team=red,map=FILE". Fails with InvalidArgument.
Result<FoxgloveSource> parseFoxgloveSource(std::string_view text);
/// Returns a text that parseFoxgloveSource() reads back, if the file's path has no comma.
std::string foxgloveSourceText(const FoxgloveSource& source);
/// Fails for too many sources, two with one address, or a mapping that cannot be read.
Result<void> validate(const std::vector<FoxgloveSource>& sources);

}  // namespace pitchboard::link
