// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes a file so that it appears only when it is complete. The data go to partPath() beside it,
// which commit() renames. If anything fails before that, an old file is unchanged and nothing else
// is left in the folder. The target of a symbolic link is replaced, not the link; devices and pipes
// are written directly. One thread at a time.

#include <cstdint>
#include <string>
#include <string_view>

#include <base/new_file.h>
#include <base/result.h>

namespace pitchboard {

enum class IfExists : std::uint8_t {
  Refuse,  ///< also if the file appears while the new one is written
  Replace
};

/// Returns whether two paths are the same file, also by links or another spelling. False if one
/// does not exist.
bool isSameFile(const std::string& a, const std::string& b);

class FileTarget {
 public:
  /// Prepares a target. `source` is a file that is read meanwhile and must not be overwritten.
  /// Fails with Conflict for the source, and with Refuse for an existing file; with SystemError if
  /// the folder is missing or the old file may not be written.
  static Result<FileTarget> at(const std::string& path, IfExists ifExists,
                               const std::string& source = {});
  FileTarget(FileTarget&& other) noexcept;
  FileTarget& operator=(FileTarget&& other) noexcept;
  ~FileTarget();  ///< removes what was written unless commit() was called

  /// The path to write to, for writers that open a file by name. Close it before commit().
  const std::string& partPath() const { return m_part; }
  /// Creates the file. Errors name the target.
  Result<NewFile> open() const;
  /// Flushes the file to the disk, renames it, and flushes the folder.
  Result<void> commit();

 private:
  FileTarget() = default;

  std::string m_path;  ///< links resolved
  std::string m_part;  ///< empty when there is nothing to remove
  IfExists m_ifExists = IfExists::Refuse;
  bool m_direct = false;  ///< a device or a pipe
};

/// Writes a whole file. Fails as FileTarget does.
Result<void> writeFile(const std::string& path, std::string_view bytes, IfExists ifExists,
                       const std::string& source = {});

}  // namespace pitchboard
