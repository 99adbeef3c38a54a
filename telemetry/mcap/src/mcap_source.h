// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The bytes of a file, or bytes in memory, read piece by piece. Plain reads and no memory map: a
// file that another program cuts while we read it must not end the process. One thread.

#include <cstdint>
#include <string>
#include <string_view>

#include <base/result.h>
#include <base/unique_fd.h>

namespace pitchboard::telemetry {

class McapSource {
 public:
  static Result<McapSource> file(const std::string& path);
  static McapSource memory(std::string bytes);

  std::uint64_t size() const { return m_size; }
  /// Returns whether a recorder of ours had the file open when its size was read; with `othersToo`
  /// also whether any program has it open for writing now.
  bool isBeingWritten(bool othersToo) const;
  const std::string& name() const { return m_name; }
  /// Exactly `count` bytes from `offset`, into `out`. False: they are not there.
  bool read(std::uint64_t offset, std::size_t count, std::string& out) const;
  /// Exactly `count` bytes from `offset`, to `to`. False: they are not there.
  bool readInto(std::uint64_t offset, char* to, std::size_t count) const {
    return readSome(offset, to, count) == count;
  }
  static constexpr std::size_t windowBytes = 256U << 10U;
  /// At most `count` bytes (fewer at the end); small ones come from a window that is kept, of which
  /// a new one has `window` bytes. Valid until the next call.
  std::string_view look(std::uint64_t offset, std::size_t count,
                        std::size_t window = windowBytes) const;

 private:
  McapSource() = default;
  std::size_t readSome(std::uint64_t offset, char* to, std::size_t count) const;

  std::string m_name;
  std::string m_bytes;
  UniqueFd m_fd;
  std::uint64_t m_size = 0;
  bool m_isBeingWritten = false;
  mutable std::string m_window;
  mutable std::uint64_t m_windowOffset = 0;
};

}  // namespace pitchboard::telemetry
