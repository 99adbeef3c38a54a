// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate_stdio.h"

#include <cerrno>
#include <cstdio>

#include <base/system_reason.h>
#include <robotlink/capi/world_lines.h>

namespace pitchboard::cli {
namespace {

/// The next line, without its end; of one that is too long only the beginning, which is too long,
/// too. False at the end of the input.
bool nextLine(std::string& line) {
  line.clear();
  int byte = 0;
  while ((byte = std::getc(stdin)) != EOF && byte != '\n') {
    if (line.size() <= link::WorldLines::longestLine) line += static_cast<char>(byte);
  }
  return byte != EOF || !line.empty();
}

}  // namespace

Result<void> serveWorldLines(link::Scenario usual) {
  link::WorldLines lines(std::move(usual));
  std::string line;
  while (nextLine(line)) {
    if (line.empty() || line == "\r") continue;
    const std::string answer = lines.answer(line) + '\n';
    if (std::fwrite(answer.data(), 1, answer.size(), stdout) != answer.size() ||
        std::fflush(stdout) != 0) {
      return failure(ErrorCode::SystemError,
                     "an answer could not be written: " + systemReason(errno), "standard output");
    }
  }
  return {};
}

}  // namespace pitchboard::cli
