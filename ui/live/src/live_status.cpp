// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/live/live_status.h>

#include <QObject>
#include <QStringList>
#include <algorithm>
#include <cmath>

#include <ui/base/robot_words.h>

namespace pitchboard::ui {
namespace {

QString troubleOf(const link::LiveDetails& details, const link::MatchFrame* frame) {
  if (!details.networkProblem.empty()) return QString::fromStdString(details.networkProblem);
  if (!details.monitorProblem.empty()) return QString::fromStdString(details.monitorProblem);
  QStringList closed;
  for (const telemetry::PortStatus& port : details.network.ports) {
    if (!port.bound) closed << QString::number(port.port);
  }
  if (!closed.isEmpty()) {
    return QStringLiteral("Not received: port %1 (tried again)")
        .arg(closed.mid(0, 4).join(QStringLiteral(", ")) +
             (closed.size() > 4 ? QStringLiteral(", …") : QString()));
  }
  if (frame == nullptr) return {};
  for (const link::RobotFrame& robot : frame->robots) {
    if (!robot.link) continue;
    if (robot.link->conflict) {
      return QStringLiteral("Number %1 is sent by two programs").arg(robot.identity.number);
    }
    if (robot.timedOut()) {
      return QStringLiteral("%1 has not been heard for %2. Its card comes back by itself.")
          .arg(robotName(robot), durationText(telemetry::secondsOf(robot.link->age)));
    }
  }
  if (frame->referee && frame->referee->conflict) {
    return QStringLiteral("A second referee program is heard");
  }
  return {};
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
    text += QStringLiteral(", %1 changes wait for bandwidth").arg(*sent.waiting);
  }
  if (!sent.blackboard) text += QStringLiteral(", no blackboard on the robot");
  return text;
}

}  // namespace

LiveStatusText LiveStatus::update(const link::LiveDetails& details, const link::MatchFrame* frame,
                                  double seconds) {
  const quint64 referee = details.referee.shown + details.referee.compatibility +
                          details.referee.otherSenders + details.referee.trueData;
  quint64 datagrams = details.team.datagrams;
  for (const link::SentStatus& sent : details.sent) datagrams += sent.link.messages;
  if (seconds - m_before.seconds >= 1.0 || datagrams < m_before.datagrams) {
    m_before = m_now;
    m_now = {seconds, datagrams, referee};
    const double passed = m_now.seconds - m_before.seconds;
    const auto rate = [passed](quint64 now, quint64 before) {
      return passed > 0.0 && now >= before ? static_cast<double>(now - before) / passed : 0.0;
    };
    m_rate = rate(m_now.datagrams, m_before.datagrams);
    m_refereeRate = rate(m_now.referee, m_before.referee);
  }
  LiveStatusText text;
  quint64 lost = details.network.kernelDrops() + details.network.queueDrops;
  for (const telemetry::RobotStatus& robot : details.team.robots) lost += robot.lost;
  for (const link::SentStatus& sent : details.sent) lost += sent.link.lost;
  text.network = QStringLiteral("UDP %1/s, %2 lost, %3 bad")
                     .arg(countText(static_cast<qulonglong>(std::llround(m_rate))), countText(lost),
                          countText(details.team.errors.messages() + details.unknownReferee +
                                    details.badVariables));
  text.referee = frame == nullptr || !frame->referee ? QStringLiteral("No referee heard")
                                                     : QStringLiteral("Referee: version %1, %2/s")
                                                           .arg(frame->referee->version)
                                                           .arg(numberText(m_refereeRate, 0));
  text.trouble = troubleOf(details, frame);
  const quint64 refused = details.team.refusedByFilter + details.refusedVariables +
                          details.refusedReferees + details.team.refusedRobots;
  if (refused > 0) text.network += QStringLiteral(", %1 refused").arg(countText(refused));
  QStringList tip{QStringLiteral("%1 datagrams; lost: %2 in the kernel, %3 here")
                      .arg(countText(details.network.datagrams()),
                           countText(details.network.kernelDrops()),
                           countText(details.network.queueDrops))};
  if (refused > 0) {
    tip << QStringLiteral(
               "refused: %1 of robots and %2 of referees that are not on their lists, "
               "%3 of more robots than are kept")
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
  for (const link::SentStatus& sent : details.sent) tip << sentText(sent);
  text.tip = tip.join(QLatin1Char('\n'));
  return text;
}

}  // namespace pitchboard::ui
