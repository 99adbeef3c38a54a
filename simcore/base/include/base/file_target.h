// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The name under which a file is to appear when it is whole. It is written beside, under
// partPath(), and gets its name at the end: whatever fails before leaves the old file as it was and
// nothing else in the folder. A symbolic link stays one; the file it points to is replaced. A
// device or a pipe cannot be replaced and is written to directly. One thread.

#include <cstdint>
#include <string>
#include <string_view>

#include <base/new_file.h>
#include <base/result.h>

namespace pitchboard {

enum class IfExists : std::uint8_t {
  Refuse,  ///< also when the file appears while the new one is written
  Replace
};

/// The same file on the disk, also by another spelling, a symbolic or a hard link. False when one
/// does not exist.
bool isSameFile(const std::string& a, const std::string& b);

class FileTarget {
 public:
  /// `source`: the file that is read meanwhile; it is never the target. Error Conflict for the
  /// source and for a file that exists (with Refuse), SystemError when the folder is not there or
  /// the old file may not be written.
  static Result<FileTarget> at(const std::string& path, IfExists ifExists,
                               const std::string& source = {});
  FileTarget(FileTarget&& other) noexcept;
  FileTarget& operator=(FileTarget&& other) noexcept;
  ~FileTarget();  ///< without commit(): removes what was written

  /// For writers that open a file by its name; they close it before commit().
  const std::string& partPath() const { return m_part; }
  /// Begins the file. Its errors name the target.
  Result<NewFile> open() const;
  /// Waits until the disk has the file, gives it its name and waits for the folder.
  Result<void> commit();

 private:
  FileTarget() = default;

  std::string m_path;  ///< links resolved
  std::string m_part;  ///< empty when there is nothing to remove
  IfExists m_ifExists = IfExists::Refuse;
  bool m_direct = false;  ///< a device or a pipe
};

/// All bytes at once. Errors as FileTarget.
Result<void> writeFile(const std::string& path, std::string_view bytes, IfExists ifExists,
                       const std::string& source = {});

}  // namespace pitchboard
