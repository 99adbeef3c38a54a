// SPDX-License-Identifier: GPL-3.0-or-later
#include "output_file.h"

#include <cerrno>
#include <cstring>

namespace pitchboard::cli {

tl::unexpected<Error> cannotWrite(const std::string& path, int reason, const char* what) {
  return failure(ErrorCode::SystemError,
                 std::string(what) + " cannot be written: " + std::strerror(reason), path);
}

Result<std::FILE*> openForWriting(const std::string& path, bool overwrite, const char* what) {
  std::FILE* file = std::fopen(path.c_str(), overwrite ? "we" : "wxe");
  if (file) return file;
  if (errno == EEXIST) {
    return failure(ErrorCode::Conflict, "this file exists; choose another name or add --force",
                   path);
  }
  return cannotWrite(path, errno, what);
}

Result<void> writeFile(const std::string& path, bool overwrite, std::string_view text,
                       const char* what) {
  auto file = openForWriting(path, overwrite, what);
  if (!file) return tl::unexpected(file.error());
  const bool written = std::fwrite(text.data(), 1, text.size(), *file) == text.size();
  const int reason = errno;
  const bool closed = std::fclose(*file) == 0;
  if (written && closed) return {};
  const auto error = cannotWrite(path, written ? errno : reason, what);
  std::remove(path.c_str());
  return error;
}

}  // namespace pitchboard::cli
