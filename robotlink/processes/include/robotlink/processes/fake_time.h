// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The clock of a program that knows nothing of the match: the packaged libfaketime, loaded into it,
// makes its clocks and sleeps run at the match's speed. The program reads offset and rate from a
// nameless file of ours, so that both can change while it runs, and it never sees a jump: its time
// goes on from where it was, and stands still while it is stopped. One thread.

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <base/descriptor.h>
#include <base/result.h>

namespace pitchboard::link {

class FakeTime {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// The library's file; empty when it is not installed.
  static std::string library();
  /// NotFound when the library is not installed.
  static Result<std::unique_ptr<FakeTime>> create();

  /// For the program that is started now, at this speed.
  std::vector<std::pair<std::string, std::string>> start(double speed, Time now);
  /// 0 while it is stopped.
  void setSpeed(double speed, Time now);

  /// What the library of a process that was killed leaves in /dev/shm.
  static void removeRemains(int pid);

 private:
  explicit FakeTime(Descriptor file) : m_file(std::move(file)) {}
  void write() const;

  Descriptor m_file;
  Time m_started{}, m_changed{};
  double m_passed = 0.0;  // s of its own time until m_changed
  double m_speed = 1.0;
};

}  // namespace pitchboard::link
