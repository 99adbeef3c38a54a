// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes a simulated match as CSV: one row per tick, metres, metres per second and degrees.

#include <cstdio>
#include <memory>
#include <string>

#include <base/result.h>
#include <simcore/world/snapshot.h>

namespace pitchboard::cli {

class TraceWriter {
 public:
  /// Writes the header for the robots of `first`. Refuses an existing file unless `overwrite`.
  static Result<TraceWriter> create(const std::string& path, bool overwrite,
                                    const sim::Snapshot& first);

  /// Fails when the system cannot write (a full disk, ...).
  Result<void> add(const sim::Snapshot& snapshot);
  /// Everything is on its way to the disk.
  Result<void> finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  TraceWriter(std::FILE* file, std::string path) : m_file(file), m_path(std::move(path)) {}
  Result<void> write();

  std::unique_ptr<std::FILE, Close> m_file;
  std::string m_path;
  std::string m_line;
};

}  // namespace pitchboard::cli
