// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/new_file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <base/system_reason.h>

namespace pitchboard {

Result<NewFile> NewFile::create(const std::string& path, const std::string& shownAs) {
  return open(path, O_CREAT | O_EXCL, shownAs.empty() ? path : shownAs);
}

Result<NewFile> NewFile::openDevice(const std::string& path) {
  return open(path, 0, path);
}

Result<NewFile> NewFile::open(const std::string& path, int flags, const std::string& shownAs) {
  Descriptor descriptor;
  do {
    descriptor.reset(::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0644));
  } while (!descriptor && errno == EINTR);
  if (descriptor) return NewFile(shownAs, std::move(descriptor));
  switch (errno) {
    case EEXIST:
      return failure(ErrorCode::Conflict, "This file exists; choose another name.", shownAs);
    case ENOENT:
      return failure(ErrorCode::SystemError, "The folder does not exist; choose another one.",
                     shownAs);
    case EACCES:
    case EROFS:
    case EPERM:
      return failure(ErrorCode::SystemError,
                     "This folder does not allow new files; choose another one.", shownAs);
    default:
      return failure(ErrorCode::SystemError,
                     "The file cannot be made: " + systemReason(errno) + ".", shownAs);
  }
}

tl::unexpected<Error> NewFile::failed(int reason) const {
  switch (reason) {
    case ENOSPC:
    case EDQUOT:
      return failure(ErrorCode::SystemError,
                     "The disk is full; free some room or choose another disk.", m_path);
    case EFBIG:
      return failure(ErrorCode::SystemError,
                     "The file has reached the largest size that is allowed here.", m_path);
    default:
      return failure(ErrorCode::SystemError,
                     "The file cannot be written: " + systemReason(reason) + ".", m_path);
  }
}

Result<void> NewFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(m_descriptor.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return failed(written < 0 ? errno : ENOSPC);
    m_size += static_cast<std::uint64_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

Result<void> NewFile::sync() const {
  // Pipes and some network file systems do not know the call: nothing more can be done there.
  if (::fdatasync(m_descriptor.get()) == 0 || errno == EINVAL || errno == ENOSYS) return {};
  return failed(errno);
}

Result<void> NewFile::syncFolder() const {
  const std::string folder = std::filesystem::path(m_path).parent_path().string();
  const Descriptor opened(
      ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // A folder that may be written but not read cannot be asked.
  if (!opened) return {};
  const int reason = ::fsync(opened.get()) == 0 ? 0 : errno;
  if (reason == 0 || reason == EINVAL || reason == ENOSYS) return {};
  return failed(reason);
}

void NewFile::cutAt(std::uint64_t size) {
  if (::ftruncate(m_descriptor.get(), static_cast<off_t>(size)) != 0) return;
  if (::lseek(m_descriptor.get(), static_cast<off_t>(size), SEEK_SET) >= 0) m_size = size;
}

bool NewFile::keepRoom(std::uint64_t bytes) {
  return ::fallocate(m_descriptor.get(), FALLOC_FL_KEEP_SIZE, static_cast<off_t>(m_size),
                     static_cast<off_t>(bytes)) == 0 ||
         errno != ENOSPC;
}

Result<void> NewFile::stillThere() const {
  struct stat status {};
  if (::fstat(m_descriptor.get(), &status) != 0) return failed(errno);
  if (status.st_nlink > 0) return {};
  return failure(ErrorCode::SystemError, "The file was removed while it was written.", m_path);
}

Result<void> NewFile::close() {
  const int descriptor = m_descriptor.release();
  if (descriptor < 0 || ::close(descriptor) == 0 || errno == EINTR) return {};
  return failed(errno);
}

}  // namespace pitchboard
