// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture_export.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include <app/command_line.h>
#include <base/file_target.h>
#include <base/read_file.h>
#include <base/system_reason.h>
#include <base/unique_fd.h>
#include <robotlink/processes/team_program.h>

#include "interrupt.h"

extern char** environ;

namespace pitchboard::cli {
namespace {

constexpr std::array<std::string_view, 4> formats{"svg", "png", "mp4", "webm"};

std::string studioProgram() {
  if (const char* named = std::getenv("PITCHBOARD_STUDIO")) return named;
  const std::string beside = link::besideTeamProgram("pitchboard");
  return access(beside.c_str(), X_OK) == 0 ? beside : "pitchboard";
}

/// What the studio prints: the share that is done, or why it failed.
struct StudioOutput {
  std::string line, last;

  void take(std::string_view text, const telemetry::ExportProgress& progress) {
    for (const char c : text) {
      if (c != '\n') {
        line += c;
        continue;
      }
      if (const auto part = shared::numberFrom(line); part && progress)
        progress(*part);
      else if (!last.starts_with("error: "))
        last = line;
      line.clear();
    }
  }
};

Result<void> runStudio(std::vector<std::string> arguments,
                       const telemetry::ExportProgress& progress) {
  std::vector<char*> plain;
  for (std::string& argument : arguments) plain.push_back(argument.data());
  plain.push_back(nullptr);
  setenv("QT_QPA_PLATFORM", "offscreen", 1);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    return failure(ErrorCode::SystemError, "cannot create a pipe: " + systemReason(errno));
  }
  const UniqueFd output(ends[0]);
  UniqueFd input(ends[1]);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input.get(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, input.get(), STDERR_FILENO);
  pid_t process = 0;
  const int failed = posix_spawnp(&process, plain[0], &actions, nullptr, plain.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  input.reset();
  if (failed != 0) {
    return failure(failed == ENOENT ? ErrorCode::NotFound : ErrorCode::SystemError,
                   "Pictures and videos are painted by the studio, but " + arguments[0] +
                       " cannot be started (" + systemReason(failed) +
                       "). Install the studio, or name its program in PITCHBOARD_STUDIO.");
  }
  StudioOutput studio;
  std::array<char, 4096> buffer{};
  for (bool asked = false;;) {
    if (interrupted && !std::exchange(asked, true)) kill(process, SIGTERM);
    const ssize_t count = read(output.get(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    studio.take({buffer.data(), static_cast<std::size_t>(count)}, progress);
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  if (interrupted) return failure(ErrorCode::Conflict, "Export cancelled.");
  constexpr std::string_view error = "error: ";
  const bool isError = studio.last.starts_with(error);
  return failure(ErrorCode::SystemError,
                 isError ? studio.last.substr(error.size())
                         : "The studio ended without painting. Its last output: " + studio.last);
}

std::vector<std::string> paintArguments(const std::string& session, const std::string& picture,
                                        double from, const std::vector<std::string>& robots) {
  // The colours are those of the dark theme on every desktop.
  std::vector<std::string> arguments{studioProgram(), "--theme", "dark",
                                     "--paint",       session,   "--picture",
                                     picture,         "--from",  std::to_string(from)};
  for (const std::string& robot : robots) arguments.insert(arguments.end(), {"--only", robot});
  return arguments;
}

/// Gone with everything in it.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "pitchboard-XXXXXX").string();
    if (mkdtemp(pattern.data()) != nullptr) m_path = pattern;
  }
  ~Folder() {
    std::error_code ignored;
    if (!m_path.empty()) std::filesystem::remove_all(m_path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::string& path() const { return m_path; }

 private:
  std::string m_path;
};

}  // namespace

bool isPictureFormat(std::string_view format) {
  return std::ranges::find(formats, format) != formats.end();
}

Result<void> exportPictures(const telemetry::SessionReader& session, const PictureRequest& request,
                            const telemetry::ExportProgress& progress) {
  if (request.output.empty()) {
    return failure(ErrorCode::InvalidArgument, "pictures need a file: add -o FILE");
  }
  const auto all = session.range();
  if (!all) return failure(ErrorCode::NotFound, "the recording is empty");
  const std::string& file = session.file().contents().name;
  auto target = FileTarget::at(request.output, request.ifExists, file);
  if (!target) return tl::unexpected(target.error());
  // The studio knows the format by the name.
  const std::string picture = target->partPath() + '.' + request.format;
  auto arguments = paintArguments(file, picture, request.from.value_or(all->begin), request.robots);
  for (const auto& [option, value] :
       {std::pair{"--until", request.until.value_or(all->end)}, {"--rate", request.rate}}) {
    arguments.insert(arguments.end(), {option, std::to_string(value)});
  }
  if (auto painted = runStudio(std::move(arguments), progress); !painted) return painted;
  if (std::rename(picture.c_str(), target->partPath().c_str()) != 0) {
    return failure(ErrorCode::SystemError, "cannot rename the picture: " + systemReason(errno));
  }
  return target->commit();
}

Result<std::string> svgPicture(const telemetry::SessionReader& session, double time,
                               const std::vector<std::string>& robots) {
  constexpr std::size_t maxBytes = std::size_t{64} << 20;
  const Folder folder;
  if (folder.path().empty()) {
    return failure(ErrorCode::SystemError, "cannot use the folder for temporary files");
  }
  const std::string picture = folder.path() + "/field.svg";
  const auto painted =
      runStudio(paintArguments(session.file().contents().name, picture, time, robots), {});
  if (!painted) return tl::unexpected(painted.error());
  return readFile(picture, maxBytes);
}

}  // namespace pitchboard::cli
