// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/window/scoreboard.h>

#include <QFontMetrics>
#include <QPainter>

#include <ui/base/robot_words.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

QString teamName(TeamColor team) {
  const std::string_view name = info(team).name;
  return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size())).toUpper();
}

QString scoreText(const ScoreboardState& state) {
  return QStringLiteral("%1 : %2").arg(state.left).arg(state.right);
}

QColor refereeColour(const std::string& words) {
  for (const TeamColorInfo& team : teamColors) {
    if (team.name == words) return theme().team(team.color);
  }
  // What referees know besides the colours that robots are drawn in.
  static const std::pair<const char*, QColor> others[] = {{"white", QColor(245, 245, 245)},
                                                          {"green", QColor(58, 150, 80)},
                                                          {"purple", QColor(130, 70, 170)},
                                                          {"brown", QColor(125, 85, 50)},
                                                          {"gray", QColor(128, 128, 128)}};
  for (const auto& [name, colour] : others) {
    if (words == name) return colour;
  }
  return {};
}

QString refereeTeam(const link::RefereeTeamView& team) {
  if (team.colour == "unknown") return QObject::tr("TEAM %1").arg(team.number);
  return QString::fromStdString(team.colour).toUpper();
}

QString refereeTip(const link::RefereeView& view) {
  QStringList tip;
  for (const link::RefereeTeamView& team : view.teams) {
    tip << QObject::tr("Team %1 (%2): %3 goals, %4 players on the field%5")
               .arg(team.number)
               .arg(QString::fromStdString(team.colour))
               .arg(team.score)
               .arg(team.playersLeft)
               .arg(team.number == view.ourTeam && view.ourTeam != 0 ? QObject::tr(", ours")
                                                                     : QString());
  }
  tip << (view.firstHalf ? QObject::tr("First half") : QObject::tr("Second half"));
  if (!view.phase.empty()) tip.back() += QStringLiteral(", ") + QString::fromStdString(view.phase);
  if (!view.setPlay.empty()) {
    tip.back() += QStringLiteral(", ") + QString::fromStdString(view.setPlay);
  }
  if (view.secondaryTime && *view.secondaryTime != 0) {
    tip << QObject::tr("Secondary time: %1 s").arg(*view.secondaryTime);
  }
  tip << (view.kickOffTeam ? QObject::tr("Kick-off: team %1").arg(*view.kickOffTeam)
                           : QObject::tr("Kick-off: nobody (drop ball)"));
  tip << QObject::tr("Referee at %1, version %2, heard %3 s ago")
             .arg(QString::fromStdString(view.sender))
             .arg(view.version)
             .arg(numberText(view.age, 1));
  if (view.conflict) tip << QObject::tr("A second referee program is heard.");
  if (view.trueData) tip << QObject::tr("Monitor mode: true data arrive.");
  return tip.join(QLatin1Char('\n'));
}

ScoreboardState refereeScoreboard(const link::MatchFrame& frame) {
  ScoreboardState state;
  if (!frame.referee) {
    state.clock = QStringLiteral("--:--");
    state.state = QObject::tr("NO REFEREE");
    state.tip = QObject::tr("No referee's packet has been heard yet.");
    return state;
  }
  const link::RefereeView& view = *frame.referee;
  state.leftName = refereeTeam(view.teams[0]);
  state.rightName = refereeTeam(view.teams[1]);
  state.leftColour = refereeColour(view.teams[0].colour);
  state.rightColour = refereeColour(view.teams[1].colour);
  state.left = view.teams[0].score;
  state.right = view.teams[1].score;
  state.clock = (view.secondsLeft < 0 ? QStringLiteral("−") : QString()) +
                clockText(std::abs(view.secondsLeft));
  state.state = QString::fromStdString(view.state);
  const std::string& more = !view.setPlay.empty() ? view.setPlay : view.phase;
  if (view.timedOut) {
    state.state = QObject::tr("REFEREE SILENT");
  } else if (view.stopped) {
    state.state += QStringLiteral(" · ") + QObject::tr("stopped");
  } else if (!more.empty()) {
    state.state += QStringLiteral(" · ") + QString::fromStdString(more);
  }
  state.tip = refereeTip(view);
  return state;
}

}  // namespace

ScoreboardState scoreboardOf(const link::MatchFrame& frame) {
  if (frame.origin == link::FrameOrigin::Live || frame.referee) return refereeScoreboard(frame);
  ScoreboardState state;
  TeamColor leftTeam = TeamColor::Blue, rightTeam = TeamColor::Red;
  for (const sim::RobotSnapshot& robot : frame.robots) {
    if (!info(robot.identity.team).facesLeft) {
      leftTeam = robot.identity.team;
      break;
    }
  }
  for (const sim::RobotSnapshot& robot : frame.robots) {
    if (info(robot.identity.team).facesLeft) {
      rightTeam = robot.identity.team;
      break;
    }
  }
  state.leftName = teamName(leftTeam);
  state.rightName = teamName(rightTeam);
  state.leftColour = theme().team(leftTeam);
  state.rightColour = theme().team(rightTeam);
  state.left = frame.snapshot.score.left;
  state.right = frame.snapshot.score.right;
  state.clock = clockText(frame.snapshot.clock);
  state.state = frame.finished                ? QStringLiteral("FINISHED")
                : frame.paused                ? QStringLiteral("PAUSED")
                : frame.snapshot.clockRunning ? QStringLiteral("PLAYING")
                                              : QStringLiteral("CLOCK STOPPED");
  return state;
}

Scoreboard::Scoreboard(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("scoreboard"));
}

void Scoreboard::setState(const ScoreboardState& state) {
  if (state == m_state) return;
  const QSize before = sizeHint();
  m_state = state;
  if (sizeHint() != before) updateGeometry();
  setToolTip(state.tip.isEmpty() ? tr("Score, time of play and state of the game") : state.tip);
  setAccessibleName(
      QStringLiteral("%1 %2 %3, %4, %5")
          .arg(state.leftName, scoreText(state), state.rightName, state.clock, state.state));
  update();
}

QSize Scoreboard::sizeHint() const {
  const QFontMetrics score(themeFont(TypeRole::Score));
  const QFontMetrics tag(themeFont(TypeRole::Secondary, true));
  const int words = score.horizontalAdvance(m_state.leftName + scoreText(m_state) +
                                            m_state.rightName + m_state.clock);
  return {words + tag.horizontalAdvance(m_state.state) + scaled(this, 2 * 10 + 5 * 8 + 4 * 12 + 16),
          scaled(this, 28)};
}

void Scoreboard::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const auto px = [this](double pixels) { return scaled(this, pixels); };
  int right = width() - px(4);

  const QFont tagFont = themeFont(TypeRole::Secondary, true);
  const int tagWidth = QFontMetrics(tagFont).horizontalAdvance(m_state.state) + px(16);
  const QRectF tag(right - tagWidth + 0.5, (height() - px(20)) / 2 + 0.5, tagWidth - 1, px(20) - 1);
  painter.setPen(theme().innerLine);
  painter.setBrush(theme().button);
  painter.drawRoundedRect(tag, 3, 3);
  painter.setFont(tagFont);
  painter.setPen(theme().text);
  painter.drawText(tag, Qt::AlignCenter, m_state.state);
  right -= tagWidth + px(8);

  const QFont font = themeFont(TypeRole::Score);
  const QFontMetrics metrics(font);
  painter.setFont(font);
  const auto word = [&](const QString& text, int gap) {
    const int wide = metrics.horizontalAdvance(text);
    painter.drawText(QRect(right - wide, 0, wide, height()), Qt::AlignVCenter, text);
    right -= wide + px(gap);
  };
  const auto square = [&](const QColor& colour, int gap) {
    const int side = px(10);
    const QRect box(right - side, (height() - side) / 2, side, side);
    if (colour.isValid()) {
      painter.fillRect(box, colour);
      // White on white and black on black must be seen.
      painter.setPen(theme().secondaryText);
      painter.setBrush(Qt::NoBrush);
      painter.drawRect(box.adjusted(0, 0, -1, -1));
      painter.setPen(theme().text);
    }
    right -= side + px(gap);
  };
  word(m_state.clock, 12);
  painter.fillRect(QRect(right, px(4), 1, height() - px(8)), theme().innerLine);
  right -= px(12);
  square(m_state.rightColour, 8);
  word(m_state.rightName, 12);
  if (!m_state.leftName.isEmpty()) word(scoreText(m_state), 12);
  word(m_state.leftName, 8);
  square(m_state.leftColour, 0);
}

}  // namespace pitchboard::ui
