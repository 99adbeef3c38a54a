// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/live/live_status.h>

#include <QObject>
#include <QStringList>
#include <algorithm>
#include <cmath>

#include <ui/base/robot_text.h>
#include <ui/base/scoreboard_state.h>

namespace pitchboard::ui {
namespace {

/// The most urgent first.
std::vector<LiveTrouble> troublesOf(const link::LiveDetails& details,
                                    const link::MatchFrame* frame) {
  std::vector<LiveTrouble> all;
  const auto add = [&all](const QString& key, const QString& text) { all.push_back({key, text}); };
  if (!details.networkProblem.empty())
    add(QStringLiteral("network"), QString::fromStdString(details.networkProblem));
  if (!details.monitorProblem.empty())
    add(QStringLiteral("monitor"), QString::fromStdString(details.monitorProblem));
  QStringList closed;
  bool isShared = false;
  for (const telemetry::PortStatus& port : details.network.ports) {
    if (!port.bound) closed << QString::number(port.port);
    isShared = isShared || port.broadcastsOnly || port.othersTakeAll;
  }
  if (!closed.isEmpty()) {
    add(QStringLiteral("ports"), QStringLiteral("Cannot receive on port %1 (retrying)")
                                     .arg(closed.mid(0, 4).join(QStringLiteral(", ")) +
                                          (closed.size() > 4 ? QStringLiteral(", …") : QString())));
  }
  if (isShared && !details.sharedPorts.empty())
    add(QStringLiteral("shared"), QString::fromStdString(details.sharedPorts));
  for (const link::TopicSourceStatus& source : details.topics) {
    const QString address = QString::fromStdString(source.source.address.text());
    if (source.client.state == telemetry::FoxgloveState::Waiting)
      add(address, QString::fromStdString(source.client.problem) + QStringLiteral(" (retrying)"));
    else if (!source.client.serverText.empty())
      add(address,
          address + QStringLiteral(": ") + QString::fromStdString(source.client.serverText));
  }
  if (frame == nullptr) return all;
  if (frame->reception.conflict)
    add(QStringLiteral("referee"), QStringLiteral("A second referee program is sending"));
  for (const link::RobotFrame& robot : frame->robots) {
    if (!robot.link) continue;
    const QString key = QString::number(robot.uid.value);
    if (robot.link->conflict) {
      add(QStringLiteral("two ") + key,
          QStringLiteral("Two programs send as robot %1").arg(robot.identity.number));
    }
    // Another program that sends the same number is enough.
    const bool stillReceived = std::ranges::any_of(frame->robots, [&robot](const auto& other) {
      return other.link && !other.timedOut() && other.key.team == robot.key.team &&
             other.key.number == robot.key.number;
    });
    if (robot.timedOut() && !stillReceived) {
      add(QStringLiteral("offline ") + key,
          QStringLiteral("%1 has been offline for %2. Its card returns when it sends again.")
              .arg(robotName(robot), durationText(telemetry::secondsOf(robot.link->age))));
    }
  }
  return all;
}

QString sentText(const link::SentStatus& sent) {
  const telemetry::LinkHealth& link = sent.link;
  QString text =
      QStringLiteral(
          "%1 sends %2 variables: %3/s, %4 % lost, %5 late, %6 duplicates, jitter %7 ms, "
          "clock offset %8 s")
          .arg(QString::fromStdString(sent.name))
          .arg(sent.variables)
          .arg(numberText(link.rate, 1), numberText(link.loss.value_or(0.0) * 100, 1),
               countText(link.late), countText(link.duplicates), numberText(link.jitter * 1000, 0),
               numberText(sent.clockOffset, 3));
  if (sent.waiting.value_or(0) > 0) {
    text += QStringLiteral(", %1 changes waiting").arg(*sent.waiting);
  }
  if (!sent.blackboard) text += QStringLiteral(", no blackboard on the robot");
  return text;
}

}  // namespace

QString topicsText(const link::TopicSourceStatus& source) {
  const telemetry::FoxgloveClientStatus& client = source.client;
  if (client.state != telemetry::FoxgloveState::Connected) {
    return client.problem.empty() ? QStringLiteral("connecting…")
                                  : QString::fromStdString(client.problem);
  }
  QString text =
      QStringLiteral(
          "%1, %2 of %3 topics, %4/s, %5 dropped, %6 bad, delay %7 ms above the shortest, clock "
          "offset %8 s, loss unknown")
          .arg(QString::fromStdString(client.server), QString::number(source.decoded),
               QString::number(source.channels), numberText(source.rate, 1),
               countText(client.dropped), countText(client.malformed + source.wrong),
               numberText(source.delay * 1000, 0), numberText(source.clockOffset, 3));
  for (const std::string& reason : source.unread) {
    text += QStringLiteral("\nnot read: ") + QString::fromStdString(reason);
  }
  return text;
}

double RateWindow::look(double seconds, quint64 count) {
  constexpr double window = 5.0;  // s
  if (!m_looks.empty() && (count < m_looks.back().second || seconds < m_looks.back().first)) {
    m_looks.clear();  // counted again
  }
  m_looks.emplace_back(seconds, count);
  while (m_looks.size() > 2 && seconds - m_looks[1].first >= window) m_looks.pop_front();
  const auto& [began, first] = m_looks.front();
  return seconds > began ? static_cast<double>(count - first) / (seconds - began) : 0.0;
}

QString LiveStatus::newestOf(const std::vector<LiveTrouble>& troubles, double seconds) {
  std::map<QString, double> since;
  const LiveTrouble* newest = nullptr;
  for (const LiveTrouble& one : troubles) {
    const auto known = m_since.find(one.key);
    since[one.key] = known == m_since.end() ? seconds : known->second;
    if (newest == nullptr || since[one.key] > since[newest->key]) newest = &one;
  }
  m_since = std::move(since);
  if (newest == nullptr) return {};
  return troubles.size() == 1
             ? newest->text
             : QStringLiteral("%1 (+%2 more)").arg(newest->text).arg(troubles.size() - 1);
}

LiveStatusText LiveStatus::update(const link::LiveDetails& details, const link::MatchFrame* frame,
                                  double seconds) {
  const quint64 referee = details.referee.shown + details.referee.repeated + details.referee.late +
                          details.referee.compatibility + details.referee.otherSenders +
                          details.referee.trueData;
  quint64 datagrams = details.team.datagrams;
  for (const link::SentStatus& sent : details.sent) datagrams += sent.link.messages;
  const double rate = m_robots.look(seconds, datagrams);
  const double refereeRate = m_referee.look(seconds, referee);
  LiveStatusText text;
  quint64 lost = details.network.kernelDrops() + details.network.queueDrops;
  for (const telemetry::RobotStatus& robot : details.team.robots) lost += robot.lost;
  for (const link::SentStatus& sent : details.sent) lost += sent.link.lost;
  text.network = QStringLiteral("UDP %1/s, %2 lost, %3 bad")
                     .arg(rate < 9.95 ? numberText(rate, 1)
                                      : countText(static_cast<qulonglong>(std::llround(rate))),
                          countText(lost),
                          countText(details.team.errors.messages() + details.unknownReferee +
                                    details.badVariables));
  text.referee = frame == nullptr || !frame->game
                     ? QStringLiteral("No referee")
                     : QStringLiteral("%1%2: version %3, %4/s")
                           .arg(teamsText(*frame), frame->reception.simulated
                                                       ? QStringLiteral("Simulated referee")
                                                       : QStringLiteral("Referee"))
                           .arg(frame->reception.version)
                           .arg(numberText(refereeRate, 1));
  const std::vector<LiveTrouble> troubles = troublesOf(details, frame);
  text.trouble = newestOf(troubles, seconds);
  const quint64 refused = details.team.refusedByFilter + details.refusedVariables +
                          details.refusedReferees + details.team.refusedRobots;
  if (refused > 0) text.network += QStringLiteral(", %1 refused").arg(countText(refused));
  QStringList tip;
  for (const LiveTrouble& one : troubles) tip << one.text;
  tip << QStringLiteral("%1 datagrams; lost: %2 in the kernel, %3 here")
             .arg(countText(details.network.datagrams()), countText(details.network.kernelDrops()),
                  countText(details.network.queueDrops));
  if (refused > 0) {
    tip << QStringLiteral(
               "refused: %1 from robots and %2 from referees not on the lists, %3 beyond the robot "
               "limit")
               .arg(countText(details.team.refusedByFilter + details.refusedVariables),
                    countText(details.refusedReferees), countText(details.team.refusedRobots));
  }
  for (const telemetry::PortStatus& port : details.network.ports) {
    if (!port.bound)
      tip << QString::fromStdString(port.problem);
    else if (port.datagrams > 0) {
      tip << QStringLiteral("port %1: %2 datagrams").arg(port.port).arg(countText(port.datagrams));
    }
  }
  if (!details.sharedPorts.empty()) tip << QString::fromStdString(details.sharedPorts);
  if (details.ignoredSimulated > 0) {
    tip << QStringLiteral("%1 datagrams of simulated matches ignored (Live > Settings and teams)")
               .arg(countText(details.ignoredSimulated));
  }
  for (const link::SentStatus& sent : details.sent) tip << sentText(sent);
  for (const link::TopicSourceStatus& source : details.topics) {
    tip << QString::fromStdString(source.source.address.text()) + QStringLiteral(": ") +
               topicsText(source);
  }
  text.tip = tip.join(QLatin1Char('\n'));
  return text;
}

}  // namespace pitchboard::ui
