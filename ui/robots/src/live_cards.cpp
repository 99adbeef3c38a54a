// SPDX-License-Identifier: GPL-3.0-or-later
#include <QStringList>
#include <algorithm>
#include <cmath>

#include <ui/base/robot_words.h>
#include <ui/robots/card_state.h>

namespace pitchboard::ui {
namespace {

QString detailOf(const link::RobotHealth& robot) {
  // A small age would only flicker: robots speak about once a second.
  QStringList parts{durationText(telemetry::secondsOf(robot.age), 1),
                    QStringLiteral("%1/s").arg(
                        numberText(robot.timedOut ? 0.0 : robot.rate, robot.timedOut ? 0 : 1))};
  if (robot.loss && !robot.timedOut) {
    parts << QStringLiteral("%1 %").arg(numberText(*robot.loss * 100, 1));
  }
  if (robot.errorCount > 0) parts << QStringLiteral("%1 bad").arg(countText(robot.errorCount));
  return parts.join(QStringLiteral(" · "));
}

QString tipOf(const link::RobotHealth& robot) {
  QStringList tip{
      QStringLiteral("Heard from %1").arg(QString::fromStdString(robot.sender.text())),
      QStringLiteral("Last message %1 ago, %2 per second, jitter %3 ms")
          .arg(durationText(telemetry::secondsOf(robot.age), 1), numberText(robot.rate, 1),
               numberText(robot.jitter * 1000, 0)),
      // A recording counts the bad ones only.
      robot.messages > 0
          ? QStringLiteral("%1 messages, %2 bytes, %3 bad ones")
                .arg(countText(robot.messages), countText(robot.bytes), countText(robot.errorCount))
          : QStringLiteral("%1 bad messages").arg(countText(robot.errorCount)),
      robot.loss ? QStringLiteral("%1 % lost").arg(numberText(*robot.loss * 100, 1))
                 : QStringLiteral("Loss is not known: the messages have no sequence number")};
  if (robot.recoveries > 0) tip << QStringLiteral("Came back %1 times").arg(robot.recoveries);
  if (!robot.poseKnown) tip << QStringLiteral("Its messages have no position");
  return tip.join(QLatin1Char('\n'));
}

void chooseTag(CardState& card, const link::RobotHealth& robot) {
  const auto put = [&card](TagKind kind, const QString& text) {
    card.tagKind = kind;
    card.tag = text;
  };
  if (robot.timedOut) {
    put(TagKind::Error,
        QStringLiteral("TIMEOUT %1").arg(durationText(telemetry::secondsOf(robot.age))));
  } else if (robot.conflict) {
    put(TagKind::Error, QStringLiteral("number sent twice"));
  } else if (robot.penalty) {
    // "pickup or incapable": the seconds must not be cut off.
    const QString words =
        QString::fromStdString(robot.penalty->words).section(QStringLiteral(" or "), 0, 0);
    put(TagKind::Warning,
        robot.penalty->secondsLeft > 0
            ? QStringLiteral("%1 %2").arg(words, durationText(robot.penalty->secondsLeft))
            : words);
  } else if (const auto silent =
                 std::find_if(card.lamps.begin(), card.lamps.end(),
                              [](const Lamp& lamp) { return lamp.state == LampState::Silent; });
             silent != card.lamps.end()) {
    put(TagKind::Error,
        QStringLiteral("%1 silent %2")
            .arg(QLatin1Char(
                CardState::letters[static_cast<std::size_t>(silent - card.lamps.begin())]))
            .arg(durationText(silent->seconds)));
  } else if (card.batteryLow()) {
    put(TagKind::Error, QStringLiteral("battery low"));
    card.tagIsBattery = true;
  }
}

Lamp lampOf(const telemetry::ProcessStatus& process) {
  const auto seconds = static_cast<int>(std::min(telemetry::secondsOf(process.since), 1e6));
  switch (process.state) {
    case telemetry::ProcessState::Working:
      return {LampState::Working, 0};
    case telemetry::ProcessState::Silent:
      return {LampState::Silent, seconds};
    case telemetry::ProcessState::Unknown:
      break;
  }
  return {};
}

}  // namespace

std::vector<CardState> liveCards(const link::MatchFrame& frame) {
  std::vector<CardState> cards;
  cards.reserve(frame.robots.size());
  for (const link::RobotFrame& heard : frame.robots) {
    if (!heard.health) continue;
    const link::RobotHealth& robot = *heard.health;
    const sim::RobotIdentity& identity = heard.identity;
    CardState card;
    card.id = heard.key;
    card.team = identity.team;
    card.number = identity.number;
    card.name = QString::fromStdString(heard.name);
    card.subtitle = subtitleOf(heard);
    card.live = true;
    card.timedOut = robot.timedOut;
    card.battery = robot.battery;
    for (std::size_t lamp = 0; lamp < card.lamps.size(); ++lamp) {
      card.lamps[lamp] = lampOf(robot.processes[lamp]);
    }
    card.action = robot.action ? actionText(*robot.action) : QString();
    if (robot.timedOut && !card.action.isEmpty()) {
      card.action = QStringLiteral("last: %1").arg(card.action);
    }
    card.detail = detailOf(robot);
    card.detailTip = tipOf(robot);
    for (const link::HeardValue& value : robot.values) {
      card.values.push_back({QString::fromStdString(value.name), QString::fromStdString(value.text),
                             QString::fromStdString(value.unit)});
    }
    chooseTag(card, robot);
    cards.push_back(std::move(card));
  }
  return cards;
}

}  // namespace pitchboard::ui
