// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/file_target.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <utility>

#include <base/try.h>

#include "file_errors.h"

namespace pitchboard {
namespace {

namespace fs = std::filesystem;

/// Short, so that it fits where the name of the file does; hidden, so that it is not opened.
std::string partName() {
  static std::atomic<unsigned> counter{0};
  return ".pitchboard-" + std::to_string(::getpid()) + "-" + std::to_string(++counter) + ".part";
}

std::string folderOf(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? std::string(".") : folder.string();
}

/// 0, or the errno of what failed.
int syncPath(const std::string& path, int flags) {
  const UniqueFd descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags));
  if (!descriptor) return errno;
  const int error = ::fsync(descriptor.get()) == 0 ? 0 : errno;
  // Some network file systems do not know the call: nothing more can be done there.
  return error == EINVAL || error == ENOSYS ? 0 : error;
}

/// Gives `from` the name `to` unless that is taken. 0, or the errno of what failed.
int renameIfFree(const std::string& from, const std::string& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  // The file system cannot: a second name can be given only where none is, too.
  if (::link(from.c_str(), to.c_str()) != 0) return errno;
  ::unlink(from.c_str());
  return 0;
}

}  // namespace

bool isSameFile(const std::string& a, const std::string& b) {
  std::error_code missing;
  return fs::equivalent(a, b, missing);
}

Result<FileTarget> FileTarget::at(const std::string& path, IfExists ifExists,
                                  const std::string& source) {
  if (!source.empty() && isSameFile(path, source)) {
    return failure(ErrorCode::Conflict,
                   "This file is being read; choose another name for the new one.", path);
  }
  FileTarget target;
  target.m_path = path;
  target.m_ifExists = ifExists;
  struct stat link {};
  const bool taken = ::lstat(path.c_str(), &link) == 0;
  if (taken && ifExists == IfExists::Refuse) return cannotMake(EEXIST, path);
  if (taken && S_ISLNK(link.st_mode)) {
    std::error_code dangling;
    const fs::path real = fs::canonical(path, dangling);
    if (!dangling) target.m_path = real.string();
  }
  struct stat old {};
  if (taken && ::stat(target.m_path.c_str(), &old) == 0) {
    if (S_ISDIR(old.st_mode)) return cannotWrite(EISDIR, path);
    if (::access(target.m_path.c_str(), W_OK) != 0) return cannotWrite(errno, path);
    target.m_direct = !S_ISREG(old.st_mode);
  }
  if (target.m_direct) return target;
  const std::string folder = folderOf(target.m_path);
  struct stat place {};
  if (::stat(folder.c_str(), &place) != 0 || !S_ISDIR(place.st_mode)) {
    return cannotMake(ENOENT, path);
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    return cannotMake(EACCES, path);
  }
  target.m_part = (fs::path(folder) / partName()).string();
  return target;
}

FileTarget::FileTarget(FileTarget&& other) noexcept
    : m_path(std::move(other.m_path)),
      m_part(std::exchange(other.m_part, {})),
      m_ifExists(other.m_ifExists),
      m_direct(other.m_direct) {}

FileTarget& FileTarget::operator=(FileTarget&& other) noexcept {
  std::swap(m_path, other.m_path);
  std::swap(m_part, other.m_part);
  std::swap(m_ifExists, other.m_ifExists);
  std::swap(m_direct, other.m_direct);
  return *this;
}

FileTarget::~FileTarget() {
  if (!m_part.empty()) ::unlink(m_part.c_str());
}

Result<NewFile> FileTarget::open() const {
  return m_direct ? NewFile::openDevice(m_path) : NewFile::create(m_part, m_path);
}

Result<void> FileTarget::commit() {
  if (m_direct) return {};
  const auto failed = [this](int error) -> Result<void> {
    return error == EEXIST ? cannotMake(error, m_path) : cannotWrite(error, m_path);
  };
  struct stat old {};
  if (m_ifExists == IfExists::Replace && ::stat(m_path.c_str(), &old) == 0) {
    // The new file gets the permissions of the old one if the file system allows it.
    if (::chmod(m_part.c_str(), old.st_mode & 07777U) != 0) errno = 0;
  }
  if (const int error = syncPath(m_part, 0); error != 0) return failed(error);
  const int error = m_ifExists == IfExists::Refuse ? renameIfFree(m_part, m_path)
                    : std::rename(m_part.c_str(), m_path.c_str()) == 0 ? 0
                                                                       : errno;
  if (error != 0) return failed(error);
  m_part.clear();
  // The file is there; a folder that cannot be synced makes it no less whole.
  (void)syncPath(folderOf(m_path), O_DIRECTORY);
  return {};
}

Result<void> writeFile(const std::string& path, std::string_view bytes, IfExists ifExists,
                       const std::string& source) {
  auto target = TRY(FileTarget::at(path, ifExists, source));
  auto file = TRY(target.open());
  TRY(file.write(bytes));
  TRY(file.close());
  return target.commit();
}

}  // namespace pitchboard
