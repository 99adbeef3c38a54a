// SPDX-License-Identifier: GPL-3.0-or-later
#include "scoreboard.h"

#include <QFontMetrics>
#include <QPainter>

#include <ui/theme.h>

#include "robot_words.h"

namespace pitchboard::ui {
namespace {

QString teamName(TeamColor team) {
  const std::string_view name = info(team).name;
  return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size())).toUpper();
}

QString scoreText(const ScoreboardState& state) {
  return QStringLiteral("%1 : %2").arg(state.left).arg(state.right);
}

}  // namespace

ScoreboardState scoreboardOf(const link::MatchFrame& frame) {
  ScoreboardState state;
  for (const sim::RobotSnapshot& robot : frame.snapshot.robots) {
    if (!info(robot.identity.team).facesLeft) {
      state.leftTeam = robot.identity.team;
      break;
    }
  }
  for (const sim::RobotSnapshot& robot : frame.snapshot.robots) {
    if (info(robot.identity.team).facesLeft) {
      state.rightTeam = robot.identity.team;
      break;
    }
  }
  state.left = frame.snapshot.score.left;
  state.right = frame.snapshot.score.right;
  state.clock = clockText(frame.snapshot.clock);
  state.state = frame.finished                 ? QStringLiteral("FINISHED")
                : frame.paused                 ? QStringLiteral("PAUSED")
                : frame.snapshot.clockRunning  ? QStringLiteral("PLAYING")
                                               : QStringLiteral("CLOCK STOPPED");
  return state;
}

Scoreboard::Scoreboard(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("scoreboard"));
  setToolTip(tr("Score, time of play and state of the game"));
}

void Scoreboard::setState(const ScoreboardState& state) {
  if (state == m_state) return;
  const QSize before = sizeHint();
  m_state = state;
  if (sizeHint() != before) updateGeometry();
  setAccessibleName(QStringLiteral("%1 %2 %3, %4, %5")
                        .arg(teamName(state.leftTeam), scoreText(state),
                             teamName(state.rightTeam), state.clock, state.state));
  update();
}

QSize Scoreboard::sizeHint() const {
  const QFontMetrics score(themeFont(TypeRole::Score));
  const QFontMetrics tag(themeFont(TypeRole::Secondary, true));
  const int words = score.horizontalAdvance(teamName(m_state.leftTeam) + scoreText(m_state) +
                                            teamName(m_state.rightTeam) + m_state.clock);
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
  const auto square = [&](TeamColor team, int gap) {
    const int side = px(10);
    painter.fillRect(QRect(right - side, (height() - side) / 2, side, side), theme().team(team));
    right -= side + px(gap);
  };
  word(m_state.clock, 12);
  painter.fillRect(QRect(right, px(4), 1, height() - px(8)), theme().innerLine);
  right -= px(12);
  square(m_state.rightTeam, 8);
  word(teamName(m_state.rightTeam), 12);
  word(scoreText(m_state), 12);
  word(teamName(m_state.leftTeam), 8);
  square(m_state.leftTeam, 0);
}

}  // namespace pitchboard::ui
