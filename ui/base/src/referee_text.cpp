// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/referee_text.h>

#include <QStringList>
#include <cstdlib>

#include <ui/base/robot_text.h>

namespace pitchboard::ui {
namespace {

const QString comma = QStringLiteral(", ");

QString text(const std::string& text) {
  return QString::fromStdString(text);
}

/// "BLUE", or the team's own name.
QString teamOf(const link::RefereeView& view, int number) {
  for (const link::RefereeTeamView& team : view.teams) {
    if (team.number != number) continue;
    if (!team.name.empty()) return text(team.name);
    if (!team.colour.empty()) return text(team.colour).toUpper();
  }
  return QStringLiteral("team %1").arg(number);
}

}  // namespace

QString penaltyTag(const std::string& penalty, int secondsLeft) {
  const QString text = QString::fromStdString(penalty).section(QStringLiteral(" or "), 0, 0);
  return secondsLeft > 0 ? QStringLiteral("%1 %2").arg(text, durationText(secondsLeft)) : text;
}

QString refereeClockText(int seconds) {
  return (seconds < 0 ? QString(QChar(0x2212)) : QString()) + clockText(std::abs(seconds));
}

QString refereeStateText(const link::RefereeView& view) {
  QStringList parts{text(view.state) + QLatin1Char(' ') + refereeClockText(view.secondsLeft),
                    view.firstHalf ? QStringLiteral("first half") : QStringLiteral("second half")};
  if (!view.phase.empty()) parts << text(view.phase);
  if (view.stopped) parts << QStringLiteral("stopped");
  if (view.timedOut) {
    parts << QStringLiteral("last packet %1 ago").arg(durationText(view.age));
  }
  return parts.join(comma);
}

QString refereeSetPlayText(const link::RefereeView& view) {
  QStringList parts;
  if (!view.setPlay.empty()) {
    parts << (view.performingTeam ? QStringLiteral("%1 for %2")
                                        .arg(text(view.setPlay), teamOf(view, *view.performingTeam))
                                  : text(view.setPlay));
  } else if (view.kickOffTeam && !view.countdown.empty() && view.state != "FINISHED") {
    parts << QStringLiteral("kick-off for %1").arg(teamOf(view, *view.kickOffTeam));
  }
  if (!view.setPlayStep.empty()) parts << text(view.setPlayStep);
  if (!view.countdown.empty()) {
    parts
        << QStringLiteral("%1 in %2").arg(text(view.countdown), durationText(*view.secondaryTime));
  }
  return parts.join(comma);
}

QString refereeTruthText(const link::RefereeView& view) {
  if (!view.truth) return {};
  const link::RefereeTruth& truth = *view.truth;
  QStringList parts{QStringLiteral("True state: %1 %2")
                        .arg(text(truth.state), refereeClockText(truth.secondsLeft)),
                    QStringLiteral("%1 : %2").arg(truth.scores[0]).arg(truth.scores[1])};
  if (!truth.setPlay.empty()) parts << text(truth.setPlay);
  if (truth.secondaryTime.value_or(0) != 0) {
    parts << QStringLiteral("secondary time %1 s").arg(*truth.secondaryTime);
  }
  parts << QStringLiteral("%1 ago").arg(durationText(truth.age, 1));
  return parts.join(comma);
}

QString refereeTeamText(const link::RefereeTeamView& team, int ourTeam) {
  const QString name = team.name.empty()
                           ? QStringLiteral("Team")
                           : QString::fromStdString(team.name) + QStringLiteral(", team");
  return QStringLiteral("%1 %2 (%3)%4: %5 %6, %7 %8 left")
      .arg(name)
      .arg(team.number)
      .arg(text(team.colour))
      .arg(team.number == ourTeam && ourTeam != 0 ? QStringLiteral(", ours") : QString())
      .arg(team.score)
      .arg(team.score == 1 ? QStringLiteral("goal") : QStringLiteral("goals"))
      .arg(team.playersLeft)
      .arg(team.playersLeft == 1 ? QStringLiteral("player") : QStringLiteral("players"));
}

}  // namespace pitchboard::ui
