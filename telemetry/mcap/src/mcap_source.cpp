// SPDX-License-Identifier: GPL-3.0-or-later
#include "mcap_source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <base/new_file.h>
#include <base/system_reason.h>

namespace pitchboard::telemetry {
Result<McapSource> McapSource::file(const std::string& path) {
  McapSource source;
  source.m_name = path;
  source.m_fd = UniqueFd(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!source.m_fd) {
    if (errno == ENOENT) return failure(ErrorCode::NotFound, "There is no such file.", path);
    return failure(ErrorCode::SystemError,
                   "The file cannot be opened: " + systemReason(errno) + ".", path);
  }
  // Asked first: who has closed it by then has written all of it.
  source.m_isBeingWritten = pitchboard::isBeingWritten(source.m_fd.get());
  struct stat status {};
  if (::fstat(source.m_fd.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
    return failure(ErrorCode::InvalidArgument, "This is not a file.", path);
  }
  source.m_size = static_cast<std::uint64_t>(status.st_size);
  return source;
}

McapSource McapSource::memory(std::string bytes) {
  McapSource source;
  source.m_name = "bytes in memory";
  source.m_size = bytes.size();
  source.m_bytes = std::move(bytes);
  return source;
}

bool McapSource::isBeingWritten(bool othersToo) const {
  return m_isBeingWritten ||
         (othersToo && m_fd && pitchboard::isBeingWritten(m_fd.get(), othersToo));
}

std::size_t McapSource::readSome(std::uint64_t offset, char* to, std::size_t count) const {
  if (offset >= m_size) return 0;
  count = static_cast<std::size_t>(std::min<std::uint64_t>(count, m_size - offset));
  if (!m_fd) {
    std::memcpy(to, m_bytes.data() + offset, count);
    return count;
  }
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got =
        ::pread(m_fd.get(), to + done, count - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;  // the file was truncated meanwhile, or the disk failed
    done += static_cast<std::size_t>(got);
  }
  return done;
}

bool McapSource::read(std::uint64_t offset, std::size_t count, std::string& out) const {
  if (offset > m_size || count > m_size - offset) return false;
  out.resize(count);
  return readSome(offset, out.data(), count) == count;
}

std::string_view McapSource::look(std::uint64_t offset, std::size_t count,
                                  std::size_t window) const {
  if (offset >= m_size) return {};
  count = static_cast<std::size_t>(std::min<std::uint64_t>(count, m_size - offset));
  if (!m_fd) return std::string_view(m_bytes).substr(offset, count);
  if (offset < m_windowOffset || offset + count > m_windowOffset + m_window.size()) {
    m_window.resize(std::max(count, window));
    m_window.resize(readSome(offset, m_window.data(), m_window.size()));
    m_windowOffset = offset;
  }
  return std::string_view(m_window).substr(static_cast<std::size_t>(offset - m_windowOffset),
                                           count);
}

}  // namespace pitchboard::telemetry
