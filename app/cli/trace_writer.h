// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes a simulated match as CSV: one row per tick, metres, metres per second and degrees. The
// file appears when it is whole.

#include <string>

#include <base/file_target.h>
#include <base/result.h>
#include <simcore/world/snapshot.h>

namespace pitchboard::cli {

class TraceWriter {
 public:
  /// Writes the header for the robots of `first`. Errors as FileTarget; `source` is what is read.
  static Result<TraceWriter> create(const std::string& path, IfExists ifExists,
                                    const std::string& source, const sim::Snapshot& first);

  /// Fails when the system cannot write (a full disk, ...).
  Result<void> add(const sim::Snapshot& snapshot);
  /// The file is whole, on the disk and has its name.
  Result<void> finish();

 private:
  TraceWriter(FileTarget target, NewFile file)
      : m_target(std::move(target)), m_file(std::move(file)) {}
  Result<void> endLine();
  Result<void> flush();

  FileTarget m_target;
  NewFile m_file;
  std::string m_text;  ///< lines that wait
  std::string m_line;
};

}  // namespace pitchboard::cli
