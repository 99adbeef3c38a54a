// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/session/recording_health.h>

#include <cmath>
#include <cstdio>

namespace pitchboard::telemetry {
namespace {

constexpr double maxAnswer = 2.0;         // s; a healthy disk takes milliseconds
constexpr double littleTime = 15.0 * 60;  // s; enough to make room or to go to another disk
constexpr std::uint64_t littleSpace = 64'000'000;

std::string bytesText(std::uint64_t bytes) {
  char text[32];
  const auto amount = static_cast<double>(bytes);
  if (amount < 999.5e6) {
    std::snprintf(text, sizeof text, "%.0f MB", amount / 1e6);
  } else {
    std::snprintf(text, sizeof text, "%.1f GB", amount / 1e9);
  }
  return text;
}

std::string timeText(double seconds) {
  char text[48];
  const double minutes = std::floor(seconds / 60);
  if (minutes < 1) return "less than a minute";
  if (minutes < 60) {
    std::snprintf(text, sizeof text, "%.0f min", minutes);
  } else if (minutes < 48 * 60) {
    std::snprintf(text, sizeof text, "%.0f h %.0f min", std::floor(minutes / 60),
                  std::fmod(minutes, 60));
  } else {
    return "more than 2 days";
  }
  return text;
}

}  // namespace

std::optional<double> secondsLeft(const SessionStatus& status) {
  if (!status.freeBytes || !(status.bytesPerSecond > 0)) return {};
  return static_cast<double>(*status.freeBytes) / status.bytesPerSecond;
}

RecordingTrouble troubleOf(const SessionStatus& status) {
  if (status.syncLatency > maxAnswer) return RecordingTrouble::DiskBehind;
  const auto left = secondsLeft(status);
  if ((left && *left < littleTime) ||
      (!left && status.freeBytes.value_or(littleSpace) < littleSpace))
    return RecordingTrouble::LittleSpace;
  return status.dropped > 0 ? RecordingTrouble::Dropped : RecordingTrouble::None;
}

std::string troubleText(const SessionStatus& status) {
  const std::string missing =
      status.dropped > 0 ? " " + std::to_string(status.dropped) + " rows and messages are missing."
                         : std::string();
  switch (troubleOf(status)) {
    case RecordingTrouble::DiskBehind: {
      char text[160];
      std::snprintf(text, sizeof text,
                    "The disk cannot keep up: no write has finished for %.0f s. A power failure "
                    "now would lose everything recorded since then.",
                    status.syncLatency);
      return text + missing;
    }
    case RecordingTrouble::LittleSpace: {
      const auto left = secondsLeft(status);
      const std::string free = bytesText(*status.freeBytes) + " free";
      return (left ? "The disk will be full in " + timeText(*left) + " (" + free + ")"
                   : "The disk is nearly full (" + free + ")") +
             ": free some space, or record to another disk." + missing;
    }
    case RecordingTrouble::Dropped:
      return "The disk could not keep up:" + missing;
    case RecordingTrouble::None:
      break;
  }
  return {};
}

std::string freeSpaceText(const SessionStatus& status) {
  if (!status.freeBytes) return {};
  const auto left = secondsLeft(status);
  return left ? timeText(*left) + " until the disk is full"
              : bytesText(*status.freeBytes) + " free";
}

}  // namespace pitchboard::telemetry
