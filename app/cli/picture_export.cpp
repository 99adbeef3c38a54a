// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture_export.h"

#include <spawn.h>
#include <sys/wait.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include <base/file_target.h>
#include <base/system_reason.h>
#include <robotlink/report/field_svg.h>
#include <robotlink/session/recorded_frame.h>

extern char** environ;

namespace pitchboard::cli {
namespace {

constexpr double mostRate = 120.0;
constexpr double mostPictures = 200'000;

struct Format {
  std::string_view name;
  std::vector<std::string> arguments;  // of ffmpeg, behind what it reads
};

const std::array<Format, 4>& formats() {
  static const std::array<Format, 4> all{{
      {"svg", {}},
      {"png", {"-frames:v", "1", "-c:v", "png", "-f", "image2"}},
      {"mp4",
       {"-c:v", "libx264", "-preset", "veryfast", "-crf", "20", "-pix_fmt", "yuv420p", "-movflags",
        "+faststart", "-f", "mp4"}},
      {"webm",
       {"-c:v", "libvpx-vp9", "-crf", "32", "-b:v", "0", "-pix_fmt", "yuv420p", "-f", "webm"}},
  }};
  return all;
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

/// The file that ffmpeg read: places count from 0.
std::string pictureName(const std::string& folder, std::uint64_t number) {
  char name[32];
  std::snprintf(name, sizeof name, "/%08llu.svg", static_cast<unsigned long long>(number));
  return folder + name;
}

Result<void> runFfmpeg(std::vector<std::string> arguments) {
  std::vector<char*> plain;
  for (std::string& argument : arguments) plain.push_back(argument.data());
  plain.push_back(nullptr);
  pid_t process = 0;
  const int failed = posix_spawnp(&process, "ffmpeg", nullptr, nullptr, plain.data(), environ);
  if (failed == ENOENT) {
    return failure(ErrorCode::NotFound,
                   "Pictures and videos are made by ffmpeg, which is not installed here. Install "
                   "the package ffmpeg and try again, or choose svg.");
  }
  if (failed != 0) {
    return failure(ErrorCode::SystemError, "ffmpeg cannot be started: " + systemReason(failed));
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    return failure(ErrorCode::SystemError,
                   "ffmpeg ended with an error; what it said stands above.");
  }
  return {};
}

}  // namespace

bool isPictureFormat(std::string_view format) {
  return std::ranges::find(formats(), format, &Format::name) != formats().end();
}

Result<void> exportPictures(const telemetry::SessionReader& session, const PictureRequest& request,
                            const telemetry::ExportProgress& progress) {
  const Format& format = *std::ranges::find(formats(), request.format, &Format::name);
  const bool video = format.name == "mp4" || format.name == "webm";
  if (request.output.empty()) {
    return failure(ErrorCode::InvalidArgument, "a picture needs a file; add -o FILE");
  }
  const auto all = session.range();
  if (!all) return failure(ErrorCode::NotFound, "there is nothing in this session");
  const double from = std::clamp(request.from.value_or(all->begin), all->begin, all->end);
  const double until = std::clamp(request.until.value_or(all->end), all->begin, all->end);
  if (video && (!(request.rate >= 1.0) || request.rate > mostRate)) {
    return failure(ErrorCode::InvalidArgument, "a video has 1 to 120 pictures a second");
  }
  const double count = video ? std::floor((until - from) * request.rate) + 1.0 : 1.0;
  if (count < 1.0 || count > mostPictures) {
    return failure(ErrorCode::InvalidArgument,
                   "a video has 1 to 200000 pictures; choose --from, --until and --rate");
  }
  auto target = FileTarget::at(request.output, IfExists::Refuse, session.file().name());
  if (!target) return tl::unexpected(target.error());
  link::RecordedFrames frames(link::backdropOf(session, request.robots));
  if (format.arguments.empty()) {
    if (auto written = writeFile(target->partPath(), link::fieldSvg(frames.frameAt(session, from)),
                                 IfExists::Replace);
        !written) {
      return written;
    }
    return target->commit();
  }
  const Folder folder;
  if (folder.path().empty()) {
    return failure(ErrorCode::SystemError, "the folder for temporary files cannot be used");
  }
  const auto pictures = static_cast<std::uint64_t>(count);
  for (std::uint64_t i = 0; i < pictures; ++i) {
    const double time = from + static_cast<double>(i) / request.rate;
    const auto written =
        writeFile(pictureName(folder.path(), i), link::fieldSvg(frames.frameAt(session, time)),
                  IfExists::Replace);
    if (!written) return written;
    if (progress && !progress(0.5 * static_cast<double>(i) / count)) {
      return failure(ErrorCode::Conflict, "The export was stopped.");
    }
  }
  // Codecs want an even number of pixels.
  std::vector<std::string> arguments{"ffmpeg",
                                     "-nostdin",
                                     "-loglevel",
                                     "error",
                                     "-xerror",  // no room for the end of the file is an error
                                     "-y",
                                     "-framerate",
                                     std::to_string(request.rate),
                                     "-i",
                                     folder.path() + "/%08d.svg",
                                     "-vf",
                                     "scale=trunc(iw/2)*2:trunc(ih/2)*2"};
  arguments.insert(arguments.end(), format.arguments.begin(), format.arguments.end());
  arguments.push_back(target->partPath());
  if (auto made = runFfmpeg(std::move(arguments)); !made) return made;
  return target->commit();
}

}  // namespace pitchboard::cli
