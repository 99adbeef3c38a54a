// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/processes/team_program.h>

#include <filesystem>
#include <system_error>

namespace pitchboard::link {

Result<std::string> teamProgram() {
  std::error_code error;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) return path.string();
  return failure(ErrorCode::SystemError,
                 "cannot find the path of this program: " + error.message());
}

std::string besideTeamProgram(const std::string& name) {
  const Result<std::string> own = teamProgram();
  return own ? (std::filesystem::path(*own).parent_path() / name).string() : name;
}

}  // namespace pitchboard::link
