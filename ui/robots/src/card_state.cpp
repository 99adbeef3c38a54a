// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/robots/card_state.h>

#include <QStringList>
#include <algorithm>

#include <robotlink/frame/belief.h>
#include <ui/base/robot_words.h>

namespace pitchboard::ui {
namespace {

// A communication process sets no flag on its blackboard: its child process tells.
bool communicationRuns(const link::RobotFrame& robot) {
  const auto processes = robot.processes();
  return std::any_of(processes.begin(), processes.end(), [](const link::ProcessStatus& one) {
    return one.name == "communication" && one.state == link::ProcessState::Running;
  });
}

/// Which processes run for it, on a line of its own.
QString runsText(const link::RobotFrame& robot) {
  QStringList names;
  for (const link::ProcessStatus& one : robot.processes()) {
    if (one.pid != 0) names << QString::fromStdString(one.name);
  }
  return names.isEmpty() ? QString()
                         : QStringLiteral("\nRuns: ") + names.join(QStringLiteral(", "));
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
    if (one.state == link::ProcessState::Silent) {
      card.tagKind = TagKind::Warning;
      card.tag = QStringLiteral("%1 silent").arg(name);
    } else if (card.tag.isEmpty() && one.foreign && one.achieved > 0.0 &&
               one.achieved < 0.95 * one.speed) {
      card.tagKind = TagKind::Warning;
      card.tag = QStringLiteral("%1 reaches ×%2").arg(name).arg(one.achieved, 0, 'f', 1);
      const QString why = QString::fromUtf8(link::whyRealTime(one.clock));
      if (!why.isEmpty()) {
        card.tagTip = QStringLiteral("%1 %2 keeps real time: %3").arg(card.name, name, why);
      }
    }
  }
}

void chooseTag(CardState& card, const sim::RobotStatistics& statistics, int action, bool fallen) {
  for (std::size_t i = 0; i < card.lamps.size(); ++i) {
    if (card.lamps[i].state != LampState::Silent) continue;
    card.tagKind = TagKind::Error;
    card.tag = QStringLiteral("%1 silent %2")
                   .arg(QLatin1Char(CardState::letters[i]))
                   .arg(durationText(card.lamps[i].seconds));
    return;
  }
  if (card.batteryLow()) {
    card.tagKind = TagKind::Error;
    card.tag = QStringLiteral("battery low");
    card.tagIsBattery = true;
  } else if (fallen) {
    card.tagKind = TagKind::Warning;
    card.tag = QStringLiteral("fallen");
  } else if (statistics.unknownActions > 0 && statistics.lastUnknownAction == action) {
    card.tagKind = TagKind::Warning;
    card.tag = QStringLiteral("unknown action");
  }
}

std::vector<CardValue> boardValues(const sim::RobotSnapshot& robot,
                                   const link::RobotBoardView& board) {
  const auto whole = [](int value) { return numberText(value, 0); };
  const auto real = [](double value, int decimals) { return numberText(value, decimals); };
  const QString cm = QStringLiteral("cm"), degree = QStringLiteral("°");
  return {{QStringLiteral("TRUE_X"), real(robot.pose.position.x, 2), QStringLiteral("m")},
          {QStringLiteral("TRUE_Y"), real(robot.pose.position.y, 2), QStringLiteral("m")},
          {QStringLiteral("LOCALIZATION_X"), whole(board.localizationX), cm},
          {QStringLiteral("LOCALIZATION_Y"), whole(board.localizationY), cm},
          {QStringLiteral("LOCALIZATION_THETA"), whole(board.localizationTheta), degree},
          {QStringLiteral("LOCALIZATION_RBT01_X"), real(double(board.belief), 1), cm},
          {QStringLiteral("VISION_BALL_DIST"), real(double(board.ballDistCm), 1), cm},
          {QStringLiteral("VISION_PAN_DEG"), real(double(board.panDeg), 1), degree},
          {QStringLiteral("DECISION_ACTION_A"), whole(board.actionA), {}}};
}

QString ageText(double milliseconds) {
  if (milliseconds < 1000) return QStringLiteral("%1 ms").arg(qRound(milliseconds));
  return durationText(milliseconds / 1000, 1);
}

}  // namespace

QString CardState::process(std::size_t lamp) const {
  return lamp == 0 && live ? QStringLiteral("control") : QLatin1String(processes[lamp]);
}

void CardTracker::updateLamps(History& history, const link::RobotFrame& robot, bool still) {
  const link::RobotBoardView& board = *robot.board;
  const std::array<bool, CardState::lampCount> working{
      communicationRuns(robot), board.visionWorking, board.localizationWorking,
      board.decisionWorking, board.imuWorking};
  for (std::size_t i = 0; i < working.size(); ++i) {
    Lamp& lamp = history.lamps[i];
    if (working[i]) {
      history.seen[i] = true;
      lamp = {LampState::Working, 0};
    } else if (history.seen[i] && !still) {
      if (lamp.state != LampState::Silent) history.silentSince[i] = m_playing;
      lamp = {LampState::Silent, static_cast<int>((m_playing - history.silentSince[i]) / 1000)};
    }
  }
}

QString subtitleOf(const link::RobotFrame& robot) {
  QStringList parts;
  if (!robot.ownName.empty()) parts << QString::fromStdString(robot.ownName);
  if (robot.board && !robot.board->behaviour.empty()) {
    parts << (robot.board->behaviour == link::noBehaviour ? QStringLiteral("own process")
                                                          : capitalised(robot.board->behaviour));
  }
  return parts.join(QStringLiteral(" · "));
}

std::vector<CardState> CardTracker::update(const link::MatchFrame& frame, qint64 now) {
  const bool heard = std::any_of(frame.robots.begin(), frame.robots.end(),
                                 [](const auto& robot) { return robot.health.has_value(); });
  if (heard || frame.origin == link::FrameOrigin::Live) return liveCards(frame);
  const qint64 passed = m_last >= 0 ? now - m_last : 0;
  // Processes rest while the match does, and are not to blame for it.
  const bool still = frame.paused || frame.finished;
  if (!still) m_playing += passed;
  m_last = now;
  if (frame.serial != m_serial) {
    m_changed = now;
    m_serial = frame.serial;
  }
  constexpr double smoothing = 0.1;
  const double age = static_cast<double>(now - m_changed) + 500.0 / std::max(1.0, frame.tickRate);
  m_age += smoothing * (age - m_age);

  std::vector<CardState> cards;
  cards.reserve(frame.robots.size());
  for (const link::RobotFrame& robot : frame.robots) {
    CardState card;
    card.id = robot.key;
    card.team = robot.identity.team;
    card.number = robot.identity.number;
    card.name = robotName(robot.identity);
    card.subtitle = subtitleOf(robot);
    card.runtime = QString::fromStdString(robot.runtime);
    int action = robot.action;
    History& history = m_robots[card.id];
    card.battery = link::batteryOf(robot);
    if (robot.board) {
      updateLamps(history, robot, still);
      action = robot.board->actionA;
    }
    card.lamps = history.lamps;
    card.action = actionText(action);
    // Age only matters when it grows; a small one would flicker.
    card.detail = (frame.finished ? QStringLiteral("finished")
                   : frame.paused ? QStringLiteral("paused")
                                  : ageText(m_age)) +
                  QStringLiteral(" · %1 m").arg(numberText(robot.statistics.distanceWalked, 1));
    card.detailTip = QStringLiteral("Age of the tick shown; distance walked") + runsText(robot);
    if (robot.board) card.values = boardValues(robot, *robot.board);
    chooseTag(card, robot.statistics, action, robot.fallen);
    if (card.tagKind == TagKind::None && robot.penalty) {
      card.tagKind = TagKind::Warning;
      card.tag = QStringLiteral("penalised %1").arg(durationText(robot.penalty->secondsLeft));
    }
    if (card.tagKind == TagKind::None) tagProcesses(card, robot);
    cards.push_back(std::move(card));
  }
  std::erase_if(m_robots,
                [&frame](const auto& entry) { return frame.robot(entry.first) == nullptr; });
  return cards;
}

}  // namespace pitchboard::ui
