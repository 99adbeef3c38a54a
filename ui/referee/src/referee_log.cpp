// SPDX-License-Identifier: GPL-3.0-or-later
#include "referee_log.h"

#include <QScrollBar>

#include <robotlink/frame/match_event.h>
#include <ui/base/robot_words.h>
#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>

namespace pitchboard::ui {
namespace {

/// Events that the referee makes.
bool isOfReferee(link::MatchEventKind kind) {
  using Kind = link::MatchEventKind;
  switch (kind) {
    case Kind::Goal:
    case Kind::ScoreCorrected:
    case Kind::BallOut:
    case Kind::GameState:
    case Kind::MatchOver:
    case Kind::Half:
    case Kind::SetPlay:
    case Kind::GamePhase:
    case Kind::PlayStopped:
    case Kind::PlayGoesOn:
    case Kind::Penalised:
    case Kind::PenaltyOver:
      return true;
    default:
      return false;
  }
}

}  // namespace

RefereeLog::RefereeLog(MatchController* match, QWidget* parent) : QPlainTextEdit(parent) {
  constexpr int mostLines = 2000;
  setObjectName(QStringLiteral("refereeLog"));
  setReadOnly(true);
  setMaximumBlockCount(mostLines);
  setMinimumHeight(scaled(this, 90));
  connect(match, &MatchController::scenarioChanged, this, [this] {
    m_lines.clear();
    clear();
  });
  connect(match, &MatchController::eventsReceived, this,
          [this](const std::vector<link::MatchEvent>& events) {
            for (const link::MatchEvent& event : events) {
              if (!isOfReferee(event.kind)) continue;
              m_lines.push_back({event.time, clockText(event.time) + QStringLiteral("  ") +
                                                 QString::fromStdString(sentenceOf(event))});
              if (m_lines.size() > mostLines) m_lines.pop_front();
              appendPlainText(m_lines.back().text);
            }
          });
  connect(match, &MatchController::rewound, this, [this](double time) {
    if (std::erase_if(m_lines, [time](const Line& line) { return line.time > time; }) == 0) return;
    QStringList texts;
    for (const Line& line : m_lines) texts << line.text;
    setPlainText(texts.join(QLatin1Char('\n')));
    verticalScrollBar()->setValue(verticalScrollBar()->maximum());
  });
}

}  // namespace pitchboard::ui
