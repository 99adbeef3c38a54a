// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A file that did not exist before, written front to back. Every failure is a sentence that says
// what to do. One thread; sync() and syncFolder() may be called in another one meanwhile. A file
// that may be read only when it is whole is begun by FileTarget.

#include <cstdint>
#include <string>
#include <string_view>

#include <base/result.h>
#include <base/unique_fd.h>

namespace pitchboard {

class NewFile {
 public:
  /// Error Conflict when the file exists, SystemError when it cannot be made.
  /// `shownAs`: the name that errors say, when it is to be another one later.
  static Result<NewFile> create(const std::string& path, const std::string& shownAs = {});
  /// A device or a pipe, which exists already.
  static Result<NewFile> openDevice(const std::string& path);

  /// All or an error; after an error part of the bytes may be in the file.
  Result<void> write(std::string_view bytes);
  /// Waits until the disk has everything.
  Result<void> sync() const;
  /// The same for the file's name in its folder: without it a new file can be gone after a power
  /// cut.
  Result<void> syncFolder() const;
  /// Cuts what was written behind `size`, and gives room that was kept back.
  void cutAt(std::uint64_t size);
  /// Asks for room behind the end, so that the last words fit on a disk that becomes full. Error
  /// when the disk has no such room; file systems that cannot keep room have no objection.
  Result<void> keepRoom(std::uint64_t bytes);
  /// Error when the file is no longer in its folder (removed while it was written).
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
