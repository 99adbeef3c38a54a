// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The clock of a team's program, which knows nothing of the match: libpitchboard_time.so, loaded
// into the program, makes its clocks and waits run at the match's speed. It reads offset and rate
// from a page of memory that only this class writes, so that both can change while the program
// runs. Its time goes on from where it was, and stands still in a pause. At a rate of 1 the library
// passes every call through as it is. One thread.

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
  std::vector<std::pair<std::string, std::string>> start(double rate, Time now);
  /// Times real time; 0 in a pause.
  void setRate(double rate, Time now);
  double rate() const;
  /// The program's own time since start(), s.
  double seconds(Time now) const;

  /// The rate of a clock that is to go at `speed`, but is behind (s): a little faster, until it is
  /// right. One that is right to 20 ms of the computer's time goes at `speed` itself.
  static double rateFor(double behind, double speed);

 private:
  ProgramClock(std::string path, UniqueFd file, pitchboard_time_page* page);
  void write(std::chrono::nanoseconds offset, double rate, Time now);
  std::chrono::nanoseconds offset(Time now) const;

  std::string m_library;
  UniqueFd m_file;
  pitchboard_time_page* m_page;
  Time m_started{};
};

}  // namespace pitchboard::link
