// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a robot's card says, as a value: computed from the source's frames, drawn by RobotCard.

#include <QString>
#include <array>
#include <optional>
#include <vector>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::ui {

using LampState = telemetry::HeartbeatState;

struct Lamp {
  LampState state = LampState::Unknown;
  int seconds = 0;  ///< silent for so long (real time); 0 otherwise
  bool operator==(const Lamp&) const = default;
};

enum class TagKind { None, Warning, Error };

/// A further value that a card can show: "VISION_BALL_DIST", "83.2", "cm".
struct CardValue {
  QString name, text, unit;
  bool operator==(const CardValue&) const = default;
};

struct CardState {
  static constexpr int lampCount = 5;
  static constexpr std::array<char, lampCount> letters{'C', 'V', 'L', 'D', 'I'};
  static constexpr std::array<const char*, lampCount> processes{"communication", "vision",
                                                                "localization", "decision", "IMU"};

  RobotKey id;
  TeamColor team = TeamColor::Blue;
  int number = 0;
  QString name;
  QString teamName;  ///< "RoboFEI"; empty: it has none
  QString subtitle;  ///< what its team calls it, and its behaviour; may be empty
  QString runtime;   ///< who runs, where somebody has chosen
  std::array<Lamp, lampCount> lamps;
  QString tag;
  QString tagTip;  ///< a whole sentence where the tag is not all there is to say
  TagKind tagKind = TagKind::None;
  bool tagIsBattery = false;  ///< volts and bar, which are red, say the same
  QString action;
  QString detail;  ///< age of the tick and distance walked; or how it is heard
  QString detailTip;
  bool live = false;                          ///< heard by network
  bool timedOut = false;                      ///< greyed
  std::optional<telemetry::Battery> battery;  ///< nothing: it tells no voltage
  std::vector<CardValue> values;              ///< shown where the user asked for them
  bool operator==(const CardState&) const = default;

  bool batteryLow() const { return battery && battery->low; }

  /// What lamp i stands for: in Live the letter C is control, not communication.
  QString process(std::size_t lamp) const;
};

/// What stands behind the name on a card: what its team calls it, its behaviour.
QString subtitleOf(const link::RobotFrame& robot);

/// `detail`: of a robot that is not heard, the age of what is shown.
CardState cardOf(const link::RobotFrame& robot, const sim::FieldSpec& field, const QString& detail);

/// Remembers how old frames are when they are shown.
class CardTracker {
 public:
  /// `milliseconds`: any monotonic real time. One entry per robot of the frame, in its order.
  std::vector<CardState> update(const link::MatchFrame& frame, qint64 milliseconds);
  /// Forgets everything: another match.
  void reset() { *this = {}; }

 private:
  qint64 m_changed = 0;  // when the frame's serial last changed, real ms
  std::uint64_t m_serial = 0;
  double m_age = 0.0;     // ms, smoothed
  qint64 m_updated = -1;  // the last time, real ms; none
};

}  // namespace pitchboard::ui
