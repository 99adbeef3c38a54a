// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The clock of a team's program, which knows nothing of the match: libpitchboard_time.so, loaded
// into the program, makes its clocks and waits run at the match's speed. It reads offset and rate
// from a page of memory that only this class writes, so that both can change while the program
// runs. Its time goes on from where it was, and stands still in a pause. One thread.

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <base/result.h>
#include <base/unique_fd.h>

struct pitchboard_time_page;

namespace pitchboard::link {

class ProgramClock {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// The file name of the library, without its folder.
  static constexpr const char* library = "libpitchboard_time.so";

  /// NotFound if the library is not where the programs of this installation look for it.
  static Result<std::unique_ptr<ProgramClock>> create();
  ~ProgramClock();
  ProgramClock(const ProgramClock&) = delete;
  ProgramClock& operator=(const ProgramClock&) = delete;

  /// The environment of a program that is started now. Its clocks begin with those of the computer.
  std::vector<std::pair<std::string, std::string>> start(double speed, Time now);
  /// Times real time; 0 in a pause.
  void setSpeed(double speed, Time now);

 private:
  ProgramClock(std::string path, UniqueFd file, pitchboard_time_page* page);
  void write(std::chrono::nanoseconds offset, double speed, Time now);

  std::string m_library;
  UniqueFd m_file;
  pitchboard_time_page* m_page;
};

}  // namespace pitchboard::link
