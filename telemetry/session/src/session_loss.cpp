// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_loss.h"

#include <cstdio>

namespace pitchboard::telemetry {
namespace {

std::string secondsText(std::uint64_t logTime, WallTime start) {
  const auto zero = static_cast<std::uint64_t>(start.time_since_epoch().count());
  const double seconds = static_cast<double>(static_cast<std::int64_t>(logTime - zero)) * 1e-9;
  char text[48];
  std::snprintf(text, sizeof text, "%.3f s", seconds);
  return text;
}

}  // namespace

std::string lossText(const McapLoss& loss, WallTime start) {
  // Also a part of definitions, which stand elsewhere in the file once more, has no times.
  if (loss.messages.value_or(0) == 0 && loss.end == 0) return "No message is known to be lost.";
  std::string text = loss.messages ? std::to_string(*loss.messages) : "An unknown number of";
  text += loss.messages && *loss.messages == 1 ? " message is lost" : " messages are lost";
  if (loss.start == 0) {
    return text + (loss.end == 0 ? "." : ", all before " + secondsText(loss.end, start) + ".");
  }
  return text + ", between " + secondsText(loss.start, start) + " and " +
         secondsText(loss.end, start) + ".";
}

}  // namespace pitchboard::telemetry
