// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A new file that is written from front to back, and locked for others until it is closed
// (isBeingWritten()). Every error is a sentence that says what to do.
// Used by one thread; sync() and syncFolder() may run on another one meanwhile. Use FileTarget for
// files that must only appear when they are complete.

#include <cstdint>
#include <string>
#include <string_view>

#include <base/result.h>
#include <base/unique_fd.h>

namespace pitchboard {

/// Returns whether somebody has this open file open for writing: the owner of a NewFile, also in
/// another process, or with `othersToo` any program of this user on this computer, which takes
/// longer. Any thread.
bool isBeingWritten(int descriptor, bool othersToo = false);

class NewFile {
 public:
  /// Creates a file. Fails with Conflict if it exists, with SystemError if it cannot be created.
  /// Errors name `shownAs` instead of `path` if it is given, for a file that is renamed later.
  static Result<NewFile> create(const std::string& path, const std::string& shownAs = {});
  /// Creates a file that takes the place of an old one, if there is one, at once. Fails with
  /// Conflict if the old one is being written, with SystemError if it cannot be replaced.
  static Result<NewFile> replace(const std::string& path);
  /// Opens a device or a pipe, which exists already.
  static Result<NewFile> openDevice(const std::string& path);

  /// Writes all bytes. After an error, part of them may be in the file.
  Result<void> write(std::string_view bytes);
  /// Lets the system begin to write a part to the disk, so that a later flush is short. Only a
  /// hint.
  void startFlush(std::uint64_t offset, std::uint64_t bytes) const;
  /// Waits until everything is on the disk.
  Result<void> sync() const;
  /// Waits until the file's name is on the disk; without it, a new file can be lost in a power
  /// failure.
  Result<void> syncFolder() const;
  /// Truncates the file to `size` and releases reserved space.
  void cutAt(std::uint64_t size);
  /// Reserves space after the end, so that the last bytes still fit on a disk that becomes full.
  /// Fails if the disk does not have that space; succeeds on file systems that cannot reserve any.
  Result<void> keepFreeSpace(std::uint64_t bytes);
  /// Fails if somebody removed the file while it was written.
  Result<void> stillThere() const;
  Result<void> close();

  std::uint64_t size() const { return m_size; }
  const std::string& path() const { return m_path; }

 private:
  NewFile(std::string path, UniqueFd descriptor)
      : m_path(std::move(path)), m_fd(std::move(descriptor)) {}
  static Result<NewFile> open(const std::string& path, int flags, const std::string& shownAs);

  std::string m_path;
  UniqueFd m_fd;
  std::uint64_t m_size = 0;
};

}  // namespace pitchboard
