// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/scoreboard_state.h>

#include <QObject>
#include <algorithm>
#include <array>
#include <cmath>

#include <robotlink/frame/match_result.h>
#include <ui/base/elide_text.h>
#include <ui/base/referee_text.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

QString teamName(TeamColor team, const link::Teams& teams) {
  const auto known = std::ranges::find(teams, team, &link::Team::colour);
  const std::string_view name =
      known == teams.end() || known->name.empty() ? info(team).name : known->name;
  return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size())).toUpper();
}

QColor refereeColour(TeamColor colour) {
  if (const auto drawn = robotColor(colour)) return theme().team(*drawn);
  switch (colour) {  // what referees know besides the colours that robots are drawn in
    case TeamColor::White:
      return {245, 245, 245};
    case TeamColor::Green:
      return {58, 150, 80};
    case TeamColor::Purple:
      return {130, 70, 170};
    case TeamColor::Brown:
      return {125, 85, 50};
    case TeamColor::Gray:
      return {128, 128, 128};
    default:
      return {};
  }
}

QString refereeTip(const link::MatchFrame& frame) {
  const Game& game = *frame.game;
  QStringList tip;
  for (const bool right : {false, true}) tip << refereeTeamText(frame, game.teamAt(right));
  tip << refereeStateText(frame);
  if (const QString setPlay = refereeSetPlayText(frame); !setPlay.isEmpty()) tip << setPlay;
  tip << (game.kickOff >= 0 ? QStringLiteral("Kick-off: team %1")
                                  .arg(game.teams[static_cast<std::size_t>(game.kickOff)].number)
                            : QStringLiteral("Kick-off: none (drop ball)"));
  if (frame.origin != link::FrameOrigin::Live) return tip.join(QLatin1Char('\n'));
  const link::RefereeReception& reception = frame.reception;
  tip << (reception.simulated
              ? QStringLiteral("Simulated referee at %1, version %2, last packet %3 ago")
              : QStringLiteral("Referee at %1, version %2, last packet %3 ago"))
             .arg(QString::fromStdString(reception.sender))
             .arg(reception.version)
             .arg(durationText(reception.age, 1));
  if (reception.conflict) tip << QStringLiteral("A second referee program is sending.");
  if (const QString truth = refereeTruthText(frame); !truth.isEmpty()) tip << truth;
  return tip.join(QLatin1Char('\n'));
}

/// Which part of the game is played.
QString periodOf(const Game& game) {
  const auto period = game.period();
  if (!period) return QStringLiteral("PEN");
  static const std::array<QString, 4> names{QStringLiteral("1st"), QStringLiteral("2nd"),
                                            QStringLiteral("ET 1"), QStringLiteral("ET 2")};
  return names[std::min(*period, names.size() - 1)];
}

/// "72:05": a clock of a game does not turn to hours.
QString gameClock(double seconds) {
  const auto whole = static_cast<long long>(std::floor(std::max(seconds, 0.0)));
  const QLatin1Char zero('0');
  return QStringLiteral("%1:%2").arg(whole / 60, 2, 10, zero).arg(whole % 60, 2, 10, zero);
}

/// Left team first; empty before the second half, and where only packets are known.
QString halvesOf(const link::MatchFrame& frame) {
  if (!frame.rules) return {};
  const std::size_t left = frame.game->leftTeam();
  return QString::fromStdString(link::halvesText(link::goalsByHalf(*frame.game, left),
                                                 link::goalsByHalf(*frame.game, 1 - left)));
}

ScoreboardState refereeScoreboard(const link::MatchFrame& frame) {
  ScoreboardState state;
  if (!frame.game) {
    state.clock = QStringLiteral("--:--");
    state.state = QStringLiteral("NO REFEREE");
    state.tip = QStringLiteral("No referee packet received yet.");
    return state;
  }
  const Game& game = *frame.game;
  const GameTeam &leftTeam = game.teamAt(false), &rightTeam = game.teamAt(true);
  state.leftName = refereeTeamName(frame, leftTeam).toUpper();
  state.rightName = refereeTeamName(frame, rightTeam).toUpper();
  state.leftColour = refereeColour(leftTeam.colour);
  state.rightColour = refereeColour(rightTeam.colour);
  state.left = leftTeam.score;
  state.right = rightTeam.score;
  // It counts down to the end of the half; how long that is past is no time of play.
  state.clock = gameClock(game.secondsLeft());
  state.period = periodOf(game);
  QString play, team, countdown;  // beside the state
  const bool timedOut = frame.reception.timedOut;
  if (timedOut) {
    // what it said last is not said
  } else if (game.stopped) {
    play = QStringLiteral("stopped");
  } else if (game.setPlay() != SetPlay::None) {
    play = labelText(game.setPlay());
    const int taker = game.setPlayTeam();
    if (taker >= 0) {
      team = QStringLiteral(" %1").arg(game.teams[static_cast<std::size_t>(taker)].number);
    }
  } else if (game.phase != GamePhase::Normal) {
    play = labelText(game.phase);
  }
  if (!timedOut && game.countdownTo() != CountdownTo::Nothing) {
    countdown = durationText(game.countdownSeconds());
  }
  const QString name = timedOut ? QStringLiteral("REFEREE OFFLINE") : labelText(game.state);
  const auto joined = [](QStringList parts) {
    parts.removeAll(QString());
    return parts.join(QStringLiteral(" · "));
  };
  const bool simulated = frame.origin == link::FrameOrigin::Simulated;
  const QString paused = simulated && frame.paused ? QStringLiteral("paused") : QString();
  state.state = joined({name, play + team, countdown, paused});
  // The transport shows the pause, too, so it makes room first; numbers stay to the last.
  // Which set play it is says more than that the game is played.
  state.shorter = {joined({name, play + team, countdown}), joined({name, play, countdown})};
  if (!play.isEmpty()) {
    state.shorter << joined({play + team, countdown}) << joined({play, countdown});
  }
  state.shorter << joined({name, countdown});
  if (!play.isEmpty()) state.shorter << play;
  state.shorter << name;
  if (simulated && frame.finished) {
    state.state = QStringLiteral("FINAL WHISTLE");
    state.shorter.clear();
  }
  QStringList penalties;
  for (const link::RobotFrame& robot : frame.robots) {
    const auto& penalty = robot.penalty;
    if (!penalty || penalty->isSubstitute()) continue;
    const QString line =
        robotName(robot) +
        (penalty->secondsLeft > 0 ? QStringLiteral(" %1").arg(penalty->secondsLeft) : QString());
    // A second sender of its number is no second player.
    if (!penalties.contains(line)) penalties << line;
  }
  if (!penalties.isEmpty()) {
    state.penalties = QStringLiteral("Penalties: ") + penalties.join(QStringLiteral(" · "));
  }
  state.tip = refereeTip(frame);
  if (const QString halves = halvesOf(frame); !halves.isEmpty()) {
    state.tip += QStringLiteral("\nBy half: ") + halves;
  }
  return state;
}

}  // namespace

QString stateText(const ScoreboardState& board, const QFontMetricsF& metrics, double width) {
  const auto fits = [&](const QString& text) { return metrics.horizontalAdvance(text) <= width; };
  if (fits(board.state) || board.shorter.isEmpty()) {
    return elideText(metrics, board.state, width);
  }
  const auto found = std::ranges::find_if(board.shorter, fits);
  return found != board.shorter.end() ? *found : elideText(metrics, board.shorter.last(), width);
}

QString teamsText(const link::MatchFrame& frame) {
  if (std::ranges::all_of(frame.teams, [](const auto& team) { return team.name.empty(); })) {
    return {};
  }
  const ScoreboardState board = scoreboardOf(frame);
  return QStringLiteral("%1 – %2, ").arg(board.leftName, board.rightName);
}

ScoreboardState scoreboardOf(const link::MatchFrame& frame) {
  // Only who plays a match knows its score without a referee: not what is received, nor its past.
  const bool played = frame.truthKnown || frame.ballKnown;
  if (!played || frame.game) return refereeScoreboard(frame);
  ScoreboardState state;
  std::vector<sim::RobotIdentity> robots;
  for (const link::RobotFrame& robot : frame.robots) robots.push_back(robot.identity);
  const TeamColor leftTeam = link::teamOn(link::Side::Left, robots);
  const TeamColor rightTeam = link::teamOn(link::Side::Right, robots);
  state.leftName = teamName(leftTeam, frame.teams);
  state.rightName = teamName(rightTeam, frame.teams);
  state.leftColour = theme().team(leftTeam);
  state.rightColour = theme().team(rightTeam);
  state.left = frame.snapshot.score.left;
  state.right = frame.snapshot.score.right;
  state.clock = gameClock(frame.snapshot.clock);
  const bool past = frame.origin == link::FrameOrigin::Recorded;
  state.state = frame.finished                ? QStringLiteral("FINISHED")
                : frame.paused && !past       ? QStringLiteral("PAUSED")
                : frame.snapshot.clockRunning ? QStringLiteral("PLAYING")
                                              : QStringLiteral("CLOCK STOPPED");
  return state;
}

}  // namespace pitchboard::ui
