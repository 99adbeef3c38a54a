// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/robots/card_state.h>

#include <QStringList>
#include <algorithm>
#include <cmath>

#include <base/angles.h>
#include <robotlink/processes/process_manager.h>
#include <simcore/world/published_frame.h>
#include <ui/base/referee_text.h>
#include <ui/base/robot_text.h>
#include <ui/sources/decider_text.h>

namespace pitchboard::ui {
namespace {

/// Which processes run for it, on a line of its own.
QString runsText(const link::RobotFrame& robot) {
  QStringList names;
  for (const link::ProcessStatus& one : robot.processes()) {
    if (one.pid != 0) names << QString::fromStdString(one.name);
  }
  return names.isEmpty() ? QString()
                         : QStringLiteral("\nRuns: ") + names.join(QStringLiteral(", "));
}

/// Its clocks do not go with the match. A program that was meant to keep real time is in nobody's
/// way at ×1; one that the match's clock cannot be loaded into is named at once, as the match may
/// have slowed down to it.
bool keepsRealTime(const link::ProcessStatus& program) {
  const bool isMeant = program.clock == link::ProcessClock::Real;
  return program.isTeamProgram && program.clock != link::ProcessClock::Match &&
         (!isMeant || program.speed != 1.0);
}

bool isStopped(const link::RobotFrame& robot, const QString& process) {
  return std::ranges::any_of(robot.processes(), [&](const link::ProcessStatus& one) {
    return one.state == link::ProcessState::Stopped && QString::fromStdString(one.name) == process;
  });
}

/// What is wrong with the separate processes of the robot; the least of it is one that is slow.
void tagProcesses(CardState& card, const link::RobotFrame& robot) {
  for (const link::ProcessStatus& one : robot.processes()) {
    const QString name = QString::fromStdString(one.name);
    if (one.state == link::ProcessState::GivenUp) {
      card.tagKind = TagKind::Error;
      card.tag = QStringLiteral("%1 given up").arg(name);
      return;
    }
    if (one.state == link::ProcessState::NotResponding) {
      card.tagKind = TagKind::Warning;
      card.tag = QStringLiteral("%1 not responding").arg(name);
    } else if (card.tag.isEmpty() && keepsRealTime(one)) {
      card.tagKind = TagKind::Warning;
      card.tag = QStringLiteral("%1 uses real time").arg(name);
      card.tagTip = QStringLiteral("%1 %2 uses real time: %3")
                        .arg(card.name, name, QString::fromUtf8(link::whyRealTime(one.clock)));
    } else if (card.tag.isEmpty() && one.isTeamProgram && one.achieved > 0.0 &&
               one.achieved < 0.95 * one.speed) {
      card.tagKind = TagKind::Warning;
      card.tag = QStringLiteral("%1 reaches ×%2").arg(name).arg(one.achieved, 0, 'f', 1);
      card.tagTip =
          QStringLiteral("%1 %2 cannot keep up with ×%3 and has missed %4 cycles")
              .arg(card.name, name, numberText(one.speed, 1), countText(one.missedCycles));
    }
  }
}

QString linkText(const telemetry::LinkHealth& link) {
  // A small age would only flicker: robots speak about once a second.
  QStringList parts{durationText(telemetry::secondsOf(link.age), 1),
                    QStringLiteral("%1/s").arg(
                        numberText(link.timedOut ? 0.0 : link.rate, link.timedOut ? 0 : 1))};
  if (link.loss && !link.timedOut) {
    parts << QStringLiteral("%1 %").arg(numberText(*link.loss * 100, 1));
  }
  if (link.errorCount > 0) parts << QStringLiteral("%1 bad").arg(countText(link.errorCount));
  return parts.join(QStringLiteral(" · "));
}

QString linkTip(const link::RobotFrame& robot) {
  const telemetry::LinkHealth& link = *robot.link;
  QStringList tip{
      QStringLiteral("Sender: %1").arg(QString::fromStdString(link.sender.text())),
      QStringLiteral("Last message %1 ago, %2 per second, jitter %3 ms")
          .arg(durationText(telemetry::secondsOf(link.age), 1), numberText(link.rate, 1),
               numberText(link.jitter * 1000, 0)),
      // A recording counts the bad ones only.
      link.messages > 0
          ? QStringLiteral("%1 messages, %2 bytes, %3 bad")
                .arg(countText(link.messages), countText(link.bytes), countText(link.errorCount))
          : QStringLiteral("%1 bad messages").arg(countText(link.errorCount)),
      link.loss ? QStringLiteral("%1 % lost").arg(numberText(*link.loss * 100, 1))
                : QStringLiteral("Packet loss unknown: the messages have no sequence number")};
  if (link.recoveries > 0) {
    const QString times = link.recoveries == 1
                              ? QStringLiteral("Was offline once")
                              : QStringLiteral("Was offline %1 times").arg(link.recoveries);
    tip << QStringLiteral("%1, for %2 altogether")
               .arg(times, durationText(telemetry::secondsOf(link.offline)));
  }
  if (!robot.poseKnown()) tip << QStringLiteral("No position in its messages");
  return tip.join(QLatin1Char('\n'));
}

/// "chase.py", or "decision" of a process of ours.
QString programName(const link::ProcessStatus& process) {
  return QString::fromStdString(process.isTeamProgram ? process.program() : process.name);
}

/// A crash that nobody has looked at yet, although the program may run again.
bool tagCrash(CardState& card, const link::RobotFrame& robot, const Crashes& seen) {
  for (const link::ProcessStatus& one : robot.processes()) {
    const auto known = seen.find(one.id);
    if (one.deaths <= (known == seen.end() ? 0 : known->second)) continue;
    const QString name = programName(one);
    const QString crashed = one.deaths == 1 ? QStringLiteral("crashed")
                                            : QStringLiteral("crashed %1 times").arg(one.deaths);
    card.tagKind = TagKind::Error;
    card.tag = name + QLatin1Char(' ') + crashed;
    const QString process = QString::fromStdString(one.name);
    card.tagTip =
        QStringLiteral("%1 %2 %3%4 %5. Click the card to hide this.")
            .arg(card.name, name == process ? name : QStringLiteral("%1 (%2)").arg(process, name),
                 crashed,
                 one.deaths == 1 ? QStringLiteral(" with") : QStringLiteral(", the last time with"),
                 QString::fromStdString(one.lastDeath));
    return true;
  }
  return false;
}

void chooseTag(CardState& card, const link::RobotFrame& robot, const Crashes& seen) {
  const auto put = [&card](TagKind kind, const QString& text) {
    card.tagKind = kind;
    card.tag = text;
  };
  const auto notResponding = std::ranges::find(card.lamps, LampState::NotResponding, &Lamp::state);
  const sim::RobotStatistics& statistics = robot.statistics;
  if (robot.timedOut()) {
    put(TagKind::Error,
        QStringLiteral("TIMEOUT %1").arg(durationText(telemetry::secondsOf(robot.link->age))));
  } else if (robot.link && robot.link->conflict) {
    put(TagKind::Error, QStringLiteral("two senders"));
  } else if (tagCrash(card, robot, seen)) {
    return;
  } else if (robot.penalty) {
    put(TagKind::Warning, penaltyTag(*robot.penalty));
  } else if (notResponding != card.lamps.end()) {
    const QLatin1Char letter(
        CardState::letters[static_cast<std::size_t>(notResponding - card.lamps.begin())]);
    if (notResponding->stopped)
      put(TagKind::Warning, QStringLiteral("%1 stopped").arg(letter));
    else
      put(TagKind::Error,
          QStringLiteral("%1 no reply %2").arg(letter).arg(durationText(notResponding->seconds)));
  } else if (card.batteryLow()) {
    put(TagKind::Error, QStringLiteral("battery low"));
    card.tagIsBattery = true;
  } else if (robot.fallen) {
    put(TagKind::Warning, QStringLiteral("fallen"));
  } else if (statistics.unknownActions > 0 &&
             statistics.lastUnknownAction == robot.decided.value_or(robot.action)) {
    put(TagKind::Warning, QStringLiteral("unknown action"));
  } else {
    tagProcesses(card, robot);
  }
}

/// Under the names of the blackboard's variables; a dash for what the robot does not know.
std::vector<CardValue> boardValues(const link::RobotFrame& robot, const sim::FieldSpec& field) {
  std::vector<CardValue> values;
  const auto put = [&values](const char* name, std::optional<double> value, int decimals,
                             const char* unit) {
    values.push_back({QString::fromLatin1(name),
                      value ? numberText(*value, decimals) : QStringLiteral("\u2013"),
                      QString::fromUtf8(unit)});
  };
  std::optional<double> x, y, theta, sigma, distance, bearing, action;
  if (robot.belief) {
    const auto written = sim::published_frame::localizationFromStudio(field, *robot.belief);
    x = written.x;
    y = written.y;
    theta = written.degrees;
  }
  if (robot.sigma) sigma = sim::published_frame::cmFromMetres(*robot.sigma);
  if (robot.ball) {
    distance = sim::published_frame::cmFromMetres(robot.ball->distance);
    bearing = degreesFromRadians(robot.ball->bearing);
  }
  if (robot.decided) action = *robot.decided;
  put("TRUE_X", robot.pose.position.x, 2, "m");
  put("TRUE_Y", robot.pose.position.y, 2, "m");
  put("LOCALIZATION_X", x, 0, "cm");
  put("LOCALIZATION_Y", y, 0, "cm");
  put("LOCALIZATION_THETA", theta, 0, "°");
  put("LOCALIZATION_RBT01_X", sigma, 1, "cm");
  put("VISION_BALL_DIST", distance, 1, "cm");
  put("VISION_PAN_DEG", bearing, 1, "°");
  put("DECISION_ACTION_A", action, 0, "");
  return values;
}

QString ageText(double milliseconds) {
  if (milliseconds < 1000) return QStringLiteral("%1 ms").arg(qRound(milliseconds));
  return durationText(milliseconds / 1000, 1);
}

}  // namespace

QString CardState::process(std::size_t lamp) const {
  const auto written = QString::fromUtf8(telemetry::processNames[lamp]);
  return written == QStringLiteral("IMU") ? written : written.toLower();
}

QString subtitleOf(const link::RobotFrame& robot) {
  QStringList parts;
  if (!robot.ownName.empty()) parts << QString::fromStdString(robot.ownName);
  if (const QString decider = deciderText(robot); !decider.isEmpty()) parts << decider;
  return parts.join(QStringLiteral(" · "));
}

namespace {

/// What tells it from another robot with its number and colour; short.
QString apartText(const link::RobotFrame& robot) {
  if (robot.key.sender > 0) return QStringLiteral("(%1)").arg(robot.key.sender + 1);
  if (!robot.link) return {};
  const QString address = QString::fromStdString(robot.link->sender.address.text());
  return address.mid(address.lastIndexOf(QLatin1Char('.')));
}

}  // namespace

CardState cardOf(const link::RobotFrame& robot, const sim::FieldSpec& field, const QString& detail,
                 const Crashes& seen) {
  CardState card;
  card.id = robot.uid;
  card.team = robot.identity.team;
  card.number = robot.identity.number;
  card.name = QString::fromStdString(robot.name);
  card.subtitle = subtitleOf(robot);
  card.runtime = QString::fromStdString(robot.runtime);
  card.live = robot.link.has_value();
  card.timedOut = robot.timedOut();
  card.battery = robot.battery;
  for (std::size_t i = 0; i < card.lamps.size(); ++i) {
    const telemetry::ProcessHeartbeat& lamp = robot.lamps[i];
    const double seconds = std::min(telemetry::secondsOf(lamp.since), 1e6);
    const bool isNotResponding = lamp.state == LampState::NotResponding;
    card.lamps[i] = {lamp.state, isNotResponding ? static_cast<int>(seconds) : 0,
                     isNotResponding && isStopped(robot, card.process(i))};
  }
  if (robot.decided || !robot.link) card.action = actionText(robot.decided.value_or(robot.action));
  if (card.timedOut && !card.action.isEmpty()) {
    card.action = QStringLiteral("last: %1").arg(card.action);
  }
  if (robot.link) {
    if (robot.link->sender.address != telemetry::Address{}) {
      card.address = QString::fromStdString(robot.link->sender.address.text());
    }
    card.detail = linkText(*robot.link);
    card.detailTip = linkTip(robot);
    for (const link::ReceivedValue& value : robot.values) {
      card.values.push_back({QString::fromStdString(value.name), QString::fromStdString(value.text),
                             QString::fromStdString(value.unit)});
    }
  } else {
    const QString walked =
        QStringLiteral("%1 m").arg(numberText(robot.statistics.distanceWalked, 1));
    card.detail = detail.isEmpty() ? walked : detail + QStringLiteral(" · ") + walked;
    card.detailTip = (detail.isEmpty() ? QStringLiteral("Distance walked")
                                       : QStringLiteral("Age of the tick shown; distance walked")) +
                     runsText(robot);
    card.values = boardValues(robot, field);
  }
  chooseTag(card, robot, seen);
  return card;
}

std::vector<CardState> CardTracker::update(const link::MatchFrame& frame, qint64 now) {
  if (frame.serial != m_serial) {
    m_changed = now;
    m_serial = frame.serial;
  }
  // A tenth in a tenth of a second.
  const auto passed = m_updated < 0 ? 100.0 : static_cast<double>(now - m_updated);
  const double smoothing = 1.0 - std::pow(0.9, passed / 100.0);
  m_updated = now;
  const double age =
      static_cast<double>(now - m_changed) + 500.0 / std::max(1.0, frame.settings->tickRate);
  m_age += smoothing * (age - m_age);
  // Age only matters when it grows; a small one would flicker.
  // What was recorded has no age, whether it is played or not.
  const bool isRecorded = frame.origin == link::FrameOrigin::Recorded;
  const QString detail = isRecorded       ? QString()
                         : frame.finished ? QStringLiteral("finished")
                         : frame.paused   ? QStringLiteral("paused")
                                          : ageText(m_age);
  std::vector<CardState> cards;
  cards.reserve(frame.robots.size());
  for (const link::RobotFrame& robot : frame.robots) {
    Crashes& crashes = m_crashes[robot.uid];
    crashes.clear();
    for (const link::ProcessStatus& one : robot.processes()) crashes[one.id] = one.deaths;
    CardState& card =
        cards.emplace_back(cardOf(robot, frame.settings->field, detail, m_seen[robot.uid]));
    card.order = orderOf(robot.key, frame.teams);
    const auto place = static_cast<std::size_t>(robot.key.team);
    if (place < frame.teams.size()) {
      card.teamName = QString::fromStdString(frame.teams[place].name);
    }
    const bool hasTwin = std::ranges::any_of(frame.robots, [&robot](const link::RobotFrame& other) {
      return other.uid != robot.uid && other.identity.number == robot.identity.number &&
             other.identity.team == robot.identity.team;
    });
    if (hasTwin) card.apart = apartText(robot);
  }
  return cards;
}

}  // namespace pitchboard::ui
