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
  std::string text = "At byte " + std::to_string(loss.offset) + " (" + std::to_string(loss.bytes) +
                     (loss.bytes == 1 ? " byte): " : " bytes): ") + loss.reason;
  // A part of definitions, which stand elsewhere in the file once more, has no messages.
  if (loss.messages == 0U) return text + " No message is known to be lost.";
  text += loss.atLeast ? " At least " : " ";
  text += loss.messages ? std::to_string(*loss.messages) : "An unknown number of";
  text += loss.messages == 1U ? " message is lost" : " messages are lost";
  const std::string from = secondsText(loss.start, start), to = secondsText(loss.end, start);
  if (loss.start != 0 && loss.end != 0) return text + ", between " + from + " and " + to + '.';
  if (loss.start != 0) return text + ", after " + from + '.';
  if (loss.end != 0) return text + ", before " + to + '.';
  return text + '.';
}

}  // namespace pitchboard::telemetry
