// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Shows the progress of a command in a line on stderr, if that is a terminal or the user asked for
// it. One thread at a time.

#include <chrono>
#include <string>

namespace pitchboard::cli {

class Progress {
 public:
  /// `what` begins the line: "exporting".
  Progress(std::string what, bool wanted);
  ~Progress();  ///< removes the line from a terminal
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows the progress, 0 to 1. Returns false if the user interrupted the command (interrupt.h).
  bool operator()(double part);
  /// Shows a text instead of a percentage.
  void show(const std::string& text);
  /// What to print before another line on stderr, so that it does not continue this line.
  std::string fresh() const { return m_open && m_terminal ? "\r\033[K" : ""; }

 private:
  std::string m_what;
  bool m_terminal;
  bool m_shown;
  bool m_open = false;
  std::chrono::steady_clock::time_point m_last;
};

}  // namespace pitchboard::cli
