// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/foxglove_source.h>

#include <algorithm>
#include <charconv>

#include <base/try.h>
#include <robotlink/live/topic_mapping.h>

namespace pitchboard::link {
namespace {

constexpr int maxShirtNumber = 99;

tl::unexpected<Error> wrongSource(std::string sentence, std::string_view part) {
  return failure(ErrorCode::InvalidArgument, std::move(sentence),
                 "--foxglove " + std::string(part.substr(0, 100)));
}

}  // namespace

Result<FoxgloveSource> parseFoxgloveSource(std::string_view text) {
  FoxgloveSource source;
  const auto end = std::min(text.find(','), text.size());
  source.address = TRY(telemetry::parseFoxgloveAddress(text.substr(0, end)));
  text.remove_prefix(std::min(end + 1, text.size()));
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view part = text.substr(0, comma);
    text.remove_prefix(std::min(comma + 1, text.size()));
    const std::size_t equals = part.find('=');
    const std::string_view name = part.substr(0, equals);
    const std::string_view value = equals == part.npos ? "" : part.substr(equals + 1);
    if (name == "robot") {
      const auto read = std::from_chars(value.data(), value.data() + value.size(), source.robot);
      if (read.ec != std::errc() || read.ptr != value.data() + value.size() || source.robot < 1 ||
          source.robot > maxShirtNumber) {
        return wrongSource("The robot's number must be from 1 to 99.", part);
      }
    } else if (name == "team") {
      const auto team = teamColorNamed(value);
      if (!team) return wrongSource("The team must be a colour, such as blue or red.", part);
      source.team = *team;
    } else if (name == "map" && !value.empty()) {
      source.mappingFile = value;
    } else {
      return wrongSource(
          "This is not understood. After the address there can be robot=N, team=COLOUR and "
          "map=FILE, each behind a comma.",
          part);
    }
  }
  return source;
}

std::string foxgloveSourceText(const FoxgloveSource& source) {
  std::string text = source.address.text();
  if (source.robot > 0) text += ",robot=" + std::to_string(source.robot);
  if (source.team != FoxgloveSource().team) {
    text += ",team=" + std::string(info(source.team).name);
  }
  if (!source.mappingFile.empty()) text += ",map=" + source.mappingFile;
  return text;
}

Result<void> validate(const std::vector<FoxgloveSource>& sources) {
  if (sources.size() > maxFoxgloveSources) {
    return failure(ErrorCode::InvalidArgument, "There can be at most " +
                                                   std::to_string(maxFoxgloveSources) +
                                                   " Foxglove bridges at a time.");
  }
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const FoxgloveSource& source = sources[i];
    for (std::size_t j = 0; j < i; ++j) {
      if (sources[j].address == source.address) {
        return wrongSource("This bridge is in the list twice.", source.address.text());
      }
    }
    if (!source.mappingFile.empty()) TRY(mappingFromFile(source.mappingFile));
  }
  return {};
}

}  // namespace pitchboard::link
