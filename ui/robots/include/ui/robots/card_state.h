// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The content of a robot's card, computed from the source's frames and drawn by RobotCard. Plain
// values; any thread.

#include <QString>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::ui {

using LampState = telemetry::HeartbeatState;

struct Lamp {
  LampState state = LampState::Unknown;
  int seconds = 0;       ///< how long the process has not responded, in real time; otherwise 0
  bool stopped = false;  ///< not responding because somebody stopped it
  bool operator==(const Lamp&) const = default;
};

enum class TagKind { None, Warning, Error };

/// An additional value on a card, such as "VISION_BALL_DIST", "83.2", "cm".
struct CardValue {
  QString name, text, unit;
  bool operator==(const CardValue&) const = default;
};

struct CardState {
  static constexpr int lampCount = 5;
  static constexpr std::array<char, lampCount> letters{'C', 'V', 'L', 'D', 'I'};

  RobotUid id;
  RobotOrder order;  ///< place in lists
  TeamColor team = TeamColor::Blue;
  int number = 0;
  QString name;
  /// Set if another robot has the same number and colour: the end of its address, or "(2)" for the
  /// second program with its number. A collapsed card shows it where the name has no room.
  QString apart;
  QString teamName;  ///< such as "RoboFEI"; may be empty
  QString address;   ///< from which a live robot sends; may be empty
  QString subtitle;  ///< the robot's name in its team and its behaviour; may be empty
  QString runtime;   ///< the runtime profile if one was chosen
  std::array<Lamp, lampCount> lamps;
  QString tag;
  QString tagTip;  ///< tool tip that explains the tag in a sentence
  TagKind tagKind = TagKind::None;
  bool tagIsBattery = false;  ///< the tag repeats what the red battery shows
  QString action;
  QString detail;  ///< simulated: distance walked; live: state of the link
  QString detailTip;
  bool live = false;                          ///< a live robot
  bool timedOut = false;                      ///< offline: the card is grey
  std::optional<telemetry::Battery> battery;  ///< empty if the robot sends no voltage
  std::vector<CardValue> values;              ///< shown if the user chose them
  bool operator==(const CardState&) const = default;

  bool batteryLow() const { return battery && battery->low; }

  /// Returns the process of a lamp. In Live, the letter C stands for control.
  QString process(std::size_t lamp) const;
};

/// Returns the text behind the name on a card: the robot's name in its team, and its behaviour.
QString subtitleOf(const link::RobotFrame& robot);

/// How often each process of a robot has crashed, by ProcessStatus::id.
using Crashes = std::map<int, int>;

/// `detail` is CardState::detail of robots that are not live. Crashes beyond `seen` are shown.
CardState cardOf(const link::RobotFrame& robot, const sim::FieldSpec& field, const QString& detail,
                 const Crashes& seen = {});

/// Makes cards from successive frames and tracks the age of what they show.
class CardTracker {
 public:
  /// Returns a state for each robot of the frame, in its order. `milliseconds` is from a monotonic
  /// clock.
  std::vector<CardState> update(const link::MatchFrame& frame, qint64 milliseconds);
  /// Somebody has looked at this card: its crashes so far are not shown any more.
  void looked(RobotUid robot) { m_seen[robot] = m_crashes[robot]; }
  /// Forgets everything, for another match.
  void reset() { *this = {}; }

 private:
  qint64 m_changed = 0;  // when the frame's serial last changed, real ms
  std::uint64_t m_serial = 0;
  double m_age = 0.0;     // ms, smoothed
  qint64 m_updated = -1;  // the last time, real ms; none
  std::map<RobotUid, Crashes> m_crashes, m_seen;
};

}  // namespace pitchboard::ui
