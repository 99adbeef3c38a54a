// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The page of memory that a match shares with the programs whose clocks follow it. ProgramClock
// (program_clock.h) writes it, the programs read it through libpitchboard_time.so. C and C++.
//
// At the instant t of CLOCK_MONOTONIC, in nanoseconds, every clock of the program is ahead of the
// computer's by offset + (rate - 1) * (t - since). With an offset of 0 and a rate of 1 nothing
// differs. A rate of 0 means that the match is paused.
//
// The writer makes `sequence` odd, writes the values, makes it even again and wakes the futex on
// it. A reader that saw it change, or odd, reads again.

#include <stdint.h>

struct pitchboard_time_page {
  uint32_t sequence;
  uint32_t reserved;
  int64_t since;
  int64_t offset;
  double rate;
};

/// The environment variable that names the file of the page.
#define PITCHBOARD_TIME_VARIABLE "PITCHBOARD_TIME"
