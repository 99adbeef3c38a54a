// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/own_program.h>

#include <filesystem>
#include <system_error>

namespace pitchboard::link {

Result<std::string> ownProgram() {
  std::error_code error;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) return path.string();
  return failure(ErrorCode::SystemError,
                 "cannot find out where this program is: " + error.message());
}

std::string besideOwnProgram(const std::string& name) {
  const Result<std::string> own = ownProgram();
  return own ? (std::filesystem::path(*own).parent_path() / name).string() : name;
}

}  // namespace pitchboard::link
