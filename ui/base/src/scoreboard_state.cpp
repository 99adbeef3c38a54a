// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/scoreboard_state.h>

#include <QObject>
#include <algorithm>

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

QColor refereeColour(const std::string& colourName) {
  if (const auto drawn = teamColorNamed(colourName)) return theme().team(*drawn);
  // What referees know besides the colours that robots are drawn in.
  static const std::pair<const char*, QColor> others[] = {{"white", QColor(245, 245, 245)},
                                                          {"green", QColor(58, 150, 80)},
                                                          {"purple", QColor(130, 70, 170)},
                                                          {"brown", QColor(125, 85, 50)},
                                                          {"gray", QColor(128, 128, 128)}};
  for (const auto& [name, colour] : others) {
    if (colourName == name) return colour;
  }
  return {};
}

QString refereeTeam(const link::RefereeTeamView& team) {
  if (!team.name.empty()) return QString::fromStdString(team.name).toUpper();
  if (team.colour == "unknown") return QStringLiteral("TEAM %1").arg(team.number);
  return QString::fromStdString(team.colour).toUpper();
}

QString refereeTip(const link::RefereeView& view, bool received) {
  QStringList tip;
  for (const link::RefereeTeamView& team : view.teams) tip << refereeTeamText(team, view.ourTeam);
  tip << refereeStateText(view);
  if (const QString setPlay = refereeSetPlayText(view); !setPlay.isEmpty()) tip << setPlay;
  tip << (view.kickOffTeam ? QStringLiteral("Kick-off: team %1").arg(*view.kickOffTeam)
                           : QStringLiteral("Kick-off: none (drop ball)"));
  if (!received) return tip.join(QLatin1Char('\n'));
  tip << QStringLiteral("Referee at %1, version %2, last packet %3 ago")
             .arg(QString::fromStdString(view.sender))
             .arg(view.version)
             .arg(durationText(view.age, 1));
  if (view.conflict) tip << QStringLiteral("A second referee program is sending.");
  if (const QString truth = refereeTruthText(view); !truth.isEmpty()) tip << truth;
  return tip.join(QLatin1Char('\n'));
}

/// Left team first; empty before the second half, and where only packets are known.
QString halvesOf(const link::MatchFrame& frame) {
  if (!frame.refereedGame) return {};
  const sim::GameState& game = frame.refereedGame->game;
  const std::size_t left = game.leftTeam();
  return QString::fromStdString(
      link::halvesText(link::goalsByHalf(game, left), link::goalsByHalf(game, 1 - left)));
}

ScoreboardState refereeScoreboard(const link::MatchFrame& frame) {
  ScoreboardState state;
  if (!frame.referee) {
    state.clock = QStringLiteral("--:--");
    state.state = QStringLiteral("NO REFEREE");
    state.tip = QStringLiteral("No referee packet received yet.");
    return state;
  }
  const link::RefereeView& view = *frame.referee;
  state.leftName = refereeTeam(view.teams[0]);
  state.rightName = refereeTeam(view.teams[1]);
  state.leftColour = refereeColour(view.teams[0].colour);
  state.rightColour = refereeColour(view.teams[1].colour);
  state.left = view.teams[0].score;
  state.right = view.teams[1].score;
  // It counts down to the end of the half; how long that is past is no time of play.
  state.clock = clockText(std::max(view.secondsLeft, 0));
  const std::string& more = !view.setPlay.empty() ? view.setPlay : view.phase;
  QString play, team, countdown;  // beside the state
  if (view.stopped && !view.timedOut) {
    play = QStringLiteral("stopped");
  } else if (!more.empty() && !view.timedOut) {
    play = QString::fromStdString(more);
    if (!view.setPlay.empty() && view.performingTeam) {
      team = QStringLiteral(" %1").arg(*view.performingTeam);
    }
  }
  if (!view.timedOut && !view.countdown.empty()) countdown = durationText(*view.secondaryTime);
  const QString name =
      view.timedOut ? QStringLiteral("REFEREE OFFLINE") : QString::fromStdString(view.state);
  const auto joined = [](QStringList parts) {
    parts.removeAll(QString());
    return parts.join(QStringLiteral(" · "));
  };
  const bool simulated = frame.origin == link::FrameOrigin::Simulated;
  const QString paused = simulated && frame.paused ? QStringLiteral("paused") : QString();
  state.state = joined({name, play + team, countdown, paused});
  // The transport shows the pause, too, so it makes room first; numbers stay to the last.
  state.shorter = {joined({name, play + team, countdown}), joined({name, play, countdown}),
                   joined({name, countdown})};
  if (simulated && frame.finished) {
    state.state = QStringLiteral("FINAL WHISTLE");
    state.shorter.clear();
  }
  QStringList penalties;
  for (const link::RobotFrame& robot : frame.robots) {
    const auto& penalty = robot.penalty;
    if (!penalty) continue;
    const QString line =
        robotName(robot) +
        (penalty->secondsLeft > 0 ? QStringLiteral(" %1").arg(penalty->secondsLeft) : QString());
    // A second sender of its number is no second player.
    if (!penalties.contains(line)) penalties << line;
  }
  state.penalties = penalties.join(QStringLiteral(" · "));
  state.tip = refereeTip(view, frame.origin == link::FrameOrigin::Live);
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
  if (!played || frame.referee) return refereeScoreboard(frame);
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
  state.clock = clockText(frame.snapshot.clock);
  const bool past = frame.origin == link::FrameOrigin::Recorded;
  state.state = frame.finished                ? QStringLiteral("FINISHED")
                : frame.paused && !past       ? QStringLiteral("PAUSED")
                : frame.snapshot.clockRunning ? QStringLiteral("PLAYING")
                                              : QStringLiteral("CLOCK STOPPED");
  return state;
}

}  // namespace pitchboard::ui
