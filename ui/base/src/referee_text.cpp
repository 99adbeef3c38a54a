// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/referee_text.h>

#include <QStringList>
#include <cstdlib>

#include <ui/base/robot_text.h>

namespace pitchboard::ui {
namespace {

const QString comma = QStringLiteral(", ");

}  // namespace

QString refereeTeamName(const link::MatchFrame& frame, const GameTeam& team) {
  const std::string_view name = link::teamName(team.number, frame.teams);
  if (!name.empty()) return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
  if (team.colour == TeamColor::Unknown) return QStringLiteral("TEAM %1").arg(team.number);
  return QString::fromStdString(std::string(info(team.colour).name)).toUpper();
}

QString penaltyTag(const link::Penalty& penalty) {
  const QString text = labelText(penalty.kind).section(QStringLiteral(" or "), 0, 0);
  return penalty.secondsLeft > 0
             ? QStringLiteral("%1 %2").arg(text, durationText(penalty.secondsLeft))
             : text;
}

QString refereeClockText(int seconds) {
  return clockText(seconds);
}

QString refereeStateText(const link::MatchFrame& frame) {
  const Game& game = *frame.game;
  QStringList parts{labelText(game.state) + QLatin1Char(' ') + refereeClockText(game.secondsLeft()),
                    game.half == 1 ? QStringLiteral("first half") : QStringLiteral("second half")};
  if (game.phase != GamePhase::Normal) parts << labelText(game.phase);
  if (game.stopped) parts << QStringLiteral("stopped");
  if (frame.reception.timedOut) {
    parts << QStringLiteral("last packet %1 ago").arg(durationText(frame.reception.age));
  }
  return parts.join(comma);
}

QString refereeSetPlayText(const link::MatchFrame& frame) {
  const Game& game = *frame.game;
  QStringList parts;
  const auto nameOf = [&](int team) {
    return refereeTeamName(frame, game.teams[static_cast<std::size_t>(team)]);
  };
  const CountdownTo countdown = game.countdownTo();
  if (game.setPlay() != SetPlay::None) {
    const QString play = labelText(game.setPlay());
    parts << (game.setPlayTeam() >= 0
                  ? QStringLiteral("%1 for %2").arg(play, nameOf(game.setPlayTeam()))
                  : play);
    // Elsewhere a set play has no steps, but can be stopped.
    const bool hasSteps = game.league == League::Humanoid;
    if (hasSteps || game.restart.step == Restart::Step::Placing) {
      parts << labelText(game.restart.step);
    }
  } else if (game.kickOff >= 0 && countdown != CountdownTo::Nothing &&
             game.state != PlayState::Finished && game.phase != GamePhase::Timeout) {
    parts << QStringLiteral("kick-off for %1").arg(nameOf(game.kickOff));
  }
  if (countdown != CountdownTo::Nothing) {
    parts << QStringLiteral("%1 in %2")
                 .arg(labelText(countdown), durationText(game.countdownSeconds()));
  }
  return parts.join(comma);
}

QString refereeTruthText(const link::MatchFrame& frame) {
  if (!frame.reception.truth) return {};
  const Game& truth = *frame.reception.truth;
  QStringList parts{
      QStringLiteral("True state: %1 %2")
          .arg(labelText(truth.state), refereeClockText(truth.secondsLeft())),
      QStringLiteral("%1 : %2").arg(truth.teamAt(false).score).arg(truth.teamAt(true).score)};
  if (truth.setPlay() != SetPlay::None) {
    parts << labelText(truth.setPlay());
  } else if (truth.phase != GamePhase::Normal) {
    parts << labelText(truth.phase);
  }
  if (truth.countdownSeconds() != 0) {
    parts << QStringLiteral("secondary time %1 s").arg(truth.countdownSeconds());
  }
  parts << QStringLiteral("%1 ago").arg(durationText(frame.reception.truthAge, 1));
  return parts.join(comma);
}

QString refereeTeamText(const link::MatchFrame& frame, const GameTeam& team) {
  const std::string_view own = link::teamName(team.number, frame.teams);
  const QString name = own.empty() ? QStringLiteral("Team")
                                   : refereeTeamName(frame, team) + QStringLiteral(", team");
  const int ourTeam = frame.reception.ourTeam;
  const int left = team.playing();
  QString out =
      QStringLiteral("%1 %2 (%3)%4: %5 %6, %7 %8 left")
          .arg(name)
          .arg(team.number)
          .arg(QString::fromStdString(std::string(info(team.colour).name)))
          .arg(team.number == ourTeam && ourTeam != 0 ? QStringLiteral(", ours") : QString())
          .arg(team.score)
          .arg(team.score == 1 ? QStringLiteral("goal") : QStringLiteral("goals"))
          .arg(left)
          .arg(left == 1 ? QStringLiteral("player") : QStringLiteral("players"));
  if (team.messageBudget) {
    out += comma + QStringLiteral("message budget %1").arg(*team.messageBudget);
  }
  return out;
}

}  // namespace pitchboard::ui
