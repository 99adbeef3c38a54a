// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes a simulated match as CSV: a row per tick, in metres, metres per second and degrees. The
// file appears when it is complete. One thread at a time.

#include <string>

#include <base/file_target.h>
#include <base/result.h>
#include <simcore/world/snapshot.h>

namespace pitchboard::cli {

class TraceWriter {
 public:
  /// Writes the header for the robots of `first`. Fails as FileTarget does; `source` is the file
  /// that is read and must not be overwritten.
  static Result<TraceWriter> create(const std::string& path, IfExists ifExists,
                                    const std::string& source, const sim::Snapshot& first);

  /// Adds a row. Fails if the system cannot write, for example because the disk is full.
  Result<void> add(const sim::Snapshot& snapshot);
  /// Completes the file, flushes it to the disk and gives it its name.
  Result<void> finish();

 private:
  TraceWriter(FileTarget target, NewFile file)
      : m_target(std::move(target)), m_file(std::move(file)) {}
  Result<void> endLine();
  Result<void> flush();

  FileTarget m_target;
  NewFile m_file;
  std::string m_text;  ///< lines that are not written yet
  std::string m_line;
};

}  // namespace pitchboard::cli
