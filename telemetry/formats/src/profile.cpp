// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/formats/profile.h>

#include <algorithm>

#include <base/lined_json.h>
#include <base/read_file.h>
#include <resources/resources.h>

#include <telemetry/formats/profile_names.h>

namespace pitchboard::telemetry {
namespace {

constexpr std::string_view folder = "profiles/";
constexpr std::string_view suffix = ".json";

/// What can only be the path of a file.
bool isPath(std::string_view text) {
  return text.find('/') != text.npos || text.ends_with(suffix);
}

}  // namespace

std::string_view meaningName(FieldMeaning meaning) {
  return info(meaning).profileKey;
}

std::string_view formatName(MessageFormat format) {
  return profile_names::formats[static_cast<std::size_t>(format)];
}

std::optional<std::size_t> Profile::indexOf(FieldMeaning meaning) const {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].meaning == meaning) return i;
  }
  return std::nullopt;
}

std::vector<std::string> builtInProfiles() {
  const std::vector<std::string_view> names = resourceNames("profiles");
  return {names.begin(), names.end()};
}

Result<Profile> loadProfile(const std::string& pathOrName) {
  const std::string resource = std::string(folder) + pathOrName + std::string(suffix);
  if (const std::string_view text = resourceText(resource); !text.empty()) {
    return parseProfile(text, resource);
  }
  const auto text = readFile(pathOrName, profile_names::maxFileBytes, "The profile");
  if (text) return parseProfile(*text, pathOrName);
  if (text.error().code != ErrorCode::NotFound || isPath(pathOrName)) {
    return tl::unexpected(text.error());
  }
  const std::vector<std::string> names = builtInProfiles();
  const std::vector<std::string_view> known(names.begin(), names.end());
  return failure(ErrorCode::NotFound, unknownName("profile or file", pathOrName, known));
}

const Profile& publishedProfile() {
  // The resource is part of the program: a test parses it, so it cannot fail here.
  static const Profile profile =
      parseProfile(resourceText("profiles/published.json"), "profiles/published.json")
          .value_or(Profile{});
  return profile;
}

}  // namespace pitchboard::telemetry
