// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/new_file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "file_errors.h"

namespace pitchboard {
namespace {

namespace fs = std::filesystem;

/// Asks what the kernel says of the processes of this user.
bool isOpenForWriting(const struct stat& file) {
  const fs::directory_iterator end;
  std::error_code gone, hidden;
  for (fs::directory_iterator process("/proc", gone); !gone && process != end;
       process.increment(gone)) {
    const std::string name = process->path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    for (fs::directory_iterator it(process->path() / "fd", hidden); !hidden && it != end;
         it.increment(hidden)) {
      struct stat target {};
      if (::stat(it->path().c_str(), &target) != 0 || target.st_dev != file.st_dev ||
          target.st_ino != file.st_ino) {
        continue;
      }
      std::ifstream info(process->path() / "fdinfo" / it->path().filename());
      for (std::string key, value; info >> key >> value;) {
        if (key != "flags:") continue;
        if ((std::strtoul(value.c_str(), nullptr, 8) & O_ACCMODE) != O_RDONLY) return true;
        break;
      }
    }
  }
  return false;
}

struct flock wholeFile(short type) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

bool isBeingWritten(int descriptor, bool othersToo) {
  struct flock lock = wholeFile(F_RDLCK);
  if (::fcntl(descriptor, F_OFD_GETLK, &lock) == 0 && lock.l_type == F_WRLCK) return true;
  struct stat status {};
  return othersToo && ::fstat(descriptor, &status) == 0 && isOpenForWriting(status);
}

Result<NewFile> NewFile::replace(const std::string& path) {
  struct stat old {};
  if (::lstat(path.c_str(), &old) != 0) return create(path);
  if (!S_ISREG(old.st_mode)) return cannotMake(EEXIST, path);
  {
    const UniqueFd opened(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (opened && isBeingWritten(opened.get())) {
      return failure(ErrorCode::Conflict, "This file is still being recorded; choose another name.",
                     path);
    }
  }
  const std::string part = path + ".part";
  auto file = create(part, path);
  if (!file) return file;
  if (std::rename(part.c_str(), path.c_str()) != 0) {
    const int reason = errno;
    ::unlink(part.c_str());
    return cannotMake(reason, path);
  }
  return file;
}

Result<NewFile> NewFile::create(const std::string& path, const std::string& shownAs) {
  return open(path, O_CREAT | O_EXCL, shownAs.empty() ? path : shownAs);
}

Result<NewFile> NewFile::openDevice(const std::string& path) {
  return open(path, 0, path);
}

Result<NewFile> NewFile::open(const std::string& path, int flags, const std::string& shownAs) {
  UniqueFd descriptor;
  do {
    descriptor.reset(::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0644));
  } while (!descriptor && errno == EINTR);
  if (descriptor) {
    // A file system without locks is no reason to write nothing.
    struct flock lock = wholeFile(F_WRLCK);
    (void)::fcntl(descriptor.get(), F_OFD_SETLK, &lock);
    return NewFile(shownAs, std::move(descriptor));
  }
  return cannotMake(errno, shownAs);
}

Result<void> NewFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(m_fd.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return cannotWrite(written < 0 ? errno : ENOSPC, m_path);
    m_size += static_cast<std::uint64_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

void NewFile::startFlush(std::uint64_t offset, std::uint64_t bytes) const {
  const int before = errno;
  (void)::sync_file_range(m_fd.get(), static_cast<off_t>(offset), static_cast<off_t>(bytes),
                          SYNC_FILE_RANGE_WRITE);
  errno = before;  // a pipe cannot do it
}

Result<void> NewFile::sync() const {
  // Pipes and some network file systems do not know the call: nothing more can be done there.
  if (::fdatasync(m_fd.get()) == 0 || errno == EINVAL || errno == ENOSYS) return {};
  return cannotWrite(errno, m_path);
}

Result<void> NewFile::syncFolder() const {
  const std::string folder = std::filesystem::path(m_path).parent_path().string();
  const UniqueFd opened(
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // A folder that may be written but not read cannot be asked.
  if (!opened) return {};
  const int reason = ::fsync(opened.get()) == 0 ? 0 : errno;
  if (reason == 0 || reason == EINVAL || reason == ENOSYS) return {};
  return cannotWrite(reason, m_path);
}

void NewFile::cutAt(std::uint64_t size) {
  if (::ftruncate(m_fd.get(), static_cast<off_t>(size)) != 0) return;
  if (::lseek(m_fd.get(), static_cast<off_t>(size), SEEK_SET) >= 0) m_size = size;
}

Result<void> NewFile::keepFreeSpace(std::uint64_t bytes) {
  const bool kept = ::fallocate(m_fd.get(), FALLOC_FL_KEEP_SIZE, static_cast<off_t>(m_size),
                                static_cast<off_t>(bytes)) == 0;
  if (!kept && errno == ENOSPC) return cannotWrite(ENOSPC, m_path);
  return {};
}

Result<void> NewFile::stillThere() const {
  struct stat status {};
  if (::fstat(m_fd.get(), &status) != 0) return cannotWrite(errno, m_path);
  if (status.st_nlink > 0) return {};
  return failure(ErrorCode::SystemError, "The file was removed while it was being written.",
                 m_path);
}

Result<void> NewFile::close() {
  const int descriptor = m_fd.release();
  if (descriptor < 0 || ::close(descriptor) == 0 || errno == EINTR) return {};
  return cannotWrite(errno, m_path);
}

}  // namespace pitchboard
