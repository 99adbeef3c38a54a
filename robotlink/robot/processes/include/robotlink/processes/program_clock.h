// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The clock of a team program, which knows nothing of the match: libpitchboard_time.so, which is
// loaded into the program, makes its clocks and waits run at the match's speed. The library reads
// offset and rate from a page of memory that only this class writes, so both can change while the
// program runs. Its time never jumps and stands still in a pause. At a rate of 1 the library passes
// every call through unchanged. One thread at a time.

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

  /// The file name of the library, without folder.
  static constexpr const char* library = "libpitchboard_time.so";

  /// Fails with NotFound if the library is not where this installation expects it.
  static Result<std::unique_ptr<ProgramClock>> create();
  ~ProgramClock();
  ProgramClock(const ProgramClock&) = delete;
  ProgramClock& operator=(const ProgramClock&) = delete;

  /// Returns the environment for a program that starts now, with the computer's time.
  std::vector<std::pair<std::string, std::string>> start(double rate, Time now);
  /// Sets the rate, times real time; 0 in a pause. With 0 it returns when the programs have stopped
  /// their timers, or after 0.2 s.
  void setRate(double rate, Time now);
  double rate() const;
  /// Returns the program's own time since start(), in s.
  double seconds(Time now) const;

  /// Returns the rate of a clock that should run at `speed` but is `behind` by some s: slightly
  /// faster, until it is right. Within 20 ms of the computer's time it is `speed` itself.
  static double rateFor(double behind, double speed);

 private:
  ProgramClock(std::string path, UniqueFd file, pitchboard_time_page* page);
  /// Returns how many programs were woken by it.
  long write(std::chrono::nanoseconds offset, double rate, Time now);
  std::chrono::nanoseconds offset(Time now) const;

  std::string m_library;
  UniqueFd m_file;
  pitchboard_time_page* m_page;
  Time m_started{};
};

}  // namespace pitchboard::link
