// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Notices that the program of a rerun has changed. Editors replace a file by renaming another one,
// or write it in parts; so a change counts once the files have stayed as they are for a moment.
// Files are looked at, not waited for: one thread, and the caller's clock.

#include <chrono>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <robotlink/rerun/rerun.h>

namespace pitchboard::link {

/// Returns the files that these programs are made of: each word of their commands that is a file,
/// runtime profiles, and the .py files beside a .py file (at most 1000). Empty for processes of
/// ours, which do not change while Pitchboard runs.
std::vector<std::string> programFiles(std::span<const RerunProcess> processes);

class ProgramWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds settleTime{300};  ///< for which files stay the same

  /// Changes count from now on.
  explicit ProgramWatch(std::vector<RerunProcess> processes);

  /// Returns whether there is nothing to watch.
  bool isEmpty() const { return m_known.empty(); }
  /// Looks at the files. Returns true once for each change: when files that differ from those at
  /// the last change have settled, and none of them is missing or has become empty.
  bool hasChanged(Time now);
  /// Returns the name of a file that the last change was in, without its folder.
  const std::string& changedFile() const { return m_changed; }

 private:
  struct Stamp {
    std::int64_t seconds = 0, nanoseconds = 0;  // of the last write
    std::uint64_t size = 0, inode = 0;
    bool exists = false;
    bool operator==(const Stamp&) const = default;
  };
  using Stamps = std::map<std::string, Stamp>;
  static Stamps look(const std::vector<std::string>& files);

  std::vector<RerunProcess> m_processes;
  std::vector<std::string> m_files;
  Stamps m_known, m_seen;  // at the last change, at the last look
  Time m_since{};          // since when they are as they were seen
  std::string m_changed;
};

}  // namespace pitchboard::link
