// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <resources/resources.h>

namespace pitchboard {

std::vector<std::string_view> resourceNames(std::string_view folder,
                                            std::initializer_list<std::string_view> first) {
  constexpr std::string_view suffix = ".json";
  std::vector<std::string_view> names;
  for (const Resource& resource : resources()) {
    if (!resource.path.starts_with(folder) || !resource.path.ends_with(suffix)) continue;
    std::string_view name = resource.path.substr(folder.size());
    if (!name.starts_with('/') || name.find('/', 1) != std::string_view::npos) continue;
    name.remove_prefix(1);
    names.push_back(name.substr(0, name.size() - suffix.size()));
  }
  const auto place = [&first](std::string_view name) {
    return std::find(first.begin(), first.end(), name) - first.begin();
  };
  std::stable_sort(names.begin(), names.end(), [&place](std::string_view a, std::string_view b) {
    return place(a) < place(b);
  });
  return names;
}

}  // namespace pitchboard
