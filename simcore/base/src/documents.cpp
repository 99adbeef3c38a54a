// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/documents.h>

#include <filesystem>
#include <system_error>

namespace pitchboard {

std::string documentationPath() {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return {};
  // Below /usr, and in build/PRESET/bin of a checkout.
  for (const char* docs : {"../share/doc/pitchboard/docs", "../../../docs"}) {
    const fs::path page = (folder / docs / "index.md").lexically_normal();
    if (fs::exists(page, error)) return page.string();
  }
  return {};
}

}  // namespace pitchboard
