// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot's card says, as a value: computed from the match's frames, drawn by RobotCard.

#include <QString>
#include <array>
#include <map>

#include <robotlink/match_runner.h>

namespace pitchboard::ui {

enum class LampState { Unknown, Working, Silent };

struct Lamp {
  LampState state = LampState::Unknown;
  int seconds = 0;     ///< silent for so long (real time); 0 otherwise
  bool operator==(const Lamp&) const = default;
};

enum class TagKind { None, Warning, Error };

struct CardState {
  static constexpr int lampCount = 5;
  static constexpr std::array<char, lampCount> letters{'C', 'V', 'L', 'D', 'I'};
  static constexpr std::array<const char*, lampCount> processes{
      "communication", "vision", "localization", "decision", "IMU"};

  RobotId id;
  TeamColor team = TeamColor::Blue;
  int number = 0;
  QString name;
  int voltage = 0;                       ///< tenths of a volt, 0 = not told
  std::array<Lamp, lampCount> lamps;
  QString tag;
  TagKind tagKind = TagKind::None;
  QString action;
  QString detail;                        ///< age of the tick and distance walked
  bool operator==(const CardState&) const = default;

  bool batteryLow() const { return voltage > 0 && voltage < lowVoltage; }
  /// Charge for the bar, 0..1, between empty and full of a four-cell battery.
  double charge() const;

  static constexpr int lowVoltage = 160;
};

/// Remembers since when each process has been silent. A process that was never seen working is
/// unknown, not silent. Time stands still while the match is paused.
class CardTracker {
 public:
  /// `milliseconds`: any monotonic real time. One entry per robot of the frame, in its order.
  std::vector<CardState> update(const link::MatchFrame& frame, qint64 milliseconds);
  /// Forgets everything: another match.
  void reset() { m_robots.clear(); m_age = 0.0; m_serial = 0; }

 private:
  struct History {
    std::array<bool, CardState::lampCount> seen{};
    std::array<qint64, CardState::lampCount> silentSince{};
    std::array<Lamp, CardState::lampCount> lamps{};
  };
  void updateLamps(History& history, const link::MatchFrame& frame,
                   const link::RobotBoardView& board);
  std::map<RobotId, History> m_robots;
  qint64 m_playing = 0;        // ms of unpaused time
  qint64 m_last = -1;
  qint64 m_changed = 0;        // when the frame's serial last changed, real ms
  std::uint64_t m_serial = 0;
  double m_age = 0.0;          // ms, smoothed
};

}  // namespace pitchboard::ui
