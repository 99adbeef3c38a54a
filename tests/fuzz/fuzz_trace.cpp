// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a recorded trace: up to the first zero byte its description, behind it the rows
// (zlib reads them as they are, or packed).
#include <unistd.h>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "trace_file.h"

namespace {

/// Of this run alone; gone with it.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("fuzz-trace-" + std::to_string(::getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() {
    std::error_code gone;
    std::filesystem::remove_all(path, gone);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  static const Folder folder;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(bytes.find('\0'), size);
  const auto write = [](const char* name, std::string_view text) {
    std::ofstream(folder.path / name, std::ios::binary) << text;
  };
  write("t.json", bytes.substr(0, end));
  write("t.csv.gz", bytes.substr(std::min(end + 1, size)));
  const auto trace = pitchboard::link::readTrace((folder.path / "t.json").string());
  if (!trace) {
    if (trace.error().message.empty()) std::abort();
    return 0;
  }
  for (const auto& row : trace->rows) {
    if (row.size() != trace->columns.size()) std::abort();
  }
  return 0;
}
