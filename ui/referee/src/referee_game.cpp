// SPDX-License-Identifier: GPL-3.0-or-later
#include "referee_game.h"

#include <QGridLayout>
#include <QLabel>
#include <QPushButton>

#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

#include "referee_buttons.h"
#include "referee_orders.h"

namespace pitchboard::ui {
namespace {

using sim::CallKind;
using sim::PlayState;
using sim::SetPlay;

QGridLayout* newGrid(const QWidget* owner) {
  auto* grid = new QGridLayout;
  grid->setSpacing(scaled(owner, 4));
  return grid;
}

}  // namespace

RefereeGame::RefereeGame(MatchController* match, QWidget* parent)
    : QWidget(parent), m_match(match), m_column(new QVBoxLayout(this)) {
  m_column->setContentsMargins(0, 0, 0, 0);
  m_column->setSpacing(scaled(this, 4));
  addStates();
  addTeams();
  addSetPlays();
  addBall();
}

void RefereeGame::call(const sim::RefereeCall& made, const QString& words) {
  callReferee(m_match->edits(), made, words);
}

QPushButton* RefereeGame::button(const QString& text, const QString& tip,
                                 const std::function<void()>& pressed, const char* key) {
  return makeRefereeButton(this, text, tip, pressed, QKeySequence(QString::fromUtf8(key)));
}

void RefereeGame::addStates() {
  m_column->addWidget(makeRefereeHeading(QStringLiteral("Game"), this));
  QGridLayout* grid = newGrid(this);
  const struct {
    PlayState state;
    const char *tip, *key;
  } states[] = {{PlayState::Ready, "Robots walk to their places", "Ctrl+Alt+R"},
                {PlayState::Set, "Robots stand", "Ctrl+Alt+S"},
                {PlayState::Playing, "The whistle", "Ctrl+Alt+P"},
                {PlayState::Finished, "The half is over", "Ctrl+Alt+F"}};
  int column = 0;
  for (const auto& one : states) {
    const std::string_view words = wordsOf(one.state);
    const QString name = QString::fromUtf8(words.data(), static_cast<qsizetype>(words.size()));
    const auto pressed = [this, state = one.state, name] {
      call({.kind = CallKind::State, .state = state}, name);
    };
    grid->addWidget(button(name, QString::fromUtf8(one.tip), pressed, one.key), 0, column++);
  }
  const struct {
    CallKind kind;
    const char *text, *tip, *key;
  } more[] = {{CallKind::NextHalf, "Next half", "INITIAL, after FINISHED", "Ctrl+Alt+I"},
              {CallKind::ShootOut, "Shoot-out", "After FINISHED", "Ctrl+Alt+O"},
              {CallKind::Stop, "Stop", "Play is stopped", "Ctrl+Alt+X"},
              {CallKind::GoOn, "Go on", "Play goes on", "Ctrl+Alt+G"}};
  column = 0;
  for (const auto& one : more) {
    const QString text = QString::fromUtf8(one.text);
    const auto pressed = [this, kind = one.kind, text] { call({.kind = kind}, text.toLower()); };
    grid->addWidget(button(text, QString::fromUtf8(one.tip), pressed, one.key), 1, column++);
  }
  m_column->addLayout(grid);
}

void RefereeGame::addTeams() {
  QGridLayout* grid = newGrid(this);
  for (int team = 0; team < 2; ++team) {
    const QString colour = team == 0 ? QStringLiteral("Blue") : QStringLiteral("Red");
    const auto calls = [this, team](CallKind kind, int value, const char* words) {
      return [this, team, kind, value, words] {
        call({.kind = kind, .team = team, .value = value}, QString::fromUtf8(words));
      };
    };
    const struct {
      QString text;
      const char* tip;
      CallKind kind;
      int value;
      const char *words, *key;
    } row[] = {{QStringLiteral("Goal %1").arg(colour), "A goal for this team", CallKind::Goal, 1,
                "goal", team == 0 ? "Ctrl+Alt+1" : "Ctrl+Alt+2"},
               {QStringLiteral("− %1").arg(colour), "Takes a goal of this team back",
                CallKind::Goal, -1, "goal taken back", ""},
               {QStringLiteral("Kick-off %1").arg(colour), "This team has the next kick-off",
                CallKind::KickOff, 0, "kick-off", team == 0 ? "Ctrl+Alt+3" : "Ctrl+Alt+4"},
               {QStringLiteral("Timeout %1").arg(colour), "In INITIAL, READY and SET",
                CallKind::Timeout, 0, "timeout", team == 0 ? "Ctrl+Alt+5" : "Ctrl+Alt+6"}};
    int column = 0;
    for (const auto& one : row) {
      grid->addWidget(button(one.text, QString::fromUtf8(one.tip),
                             calls(one.kind, one.value, one.words), one.key),
                      team, column++);
    }
  }
  m_column->addLayout(grid);
}

void RefereeGame::addSetPlays() {
  m_column->addWidget(makeRefereeHeading(QStringLiteral("Set plays"), this));
  auto* row = new QHBoxLayout;
  m_team = new QComboBox(this);
  m_team->setObjectName(QStringLiteral("refereeTeam"));
  m_team->addItems({QStringLiteral("For blue"), QStringLiteral("For red")});
  m_play = new QComboBox(this);
  m_play->setObjectName(QStringLiteral("refereeSetPlay"));
  for (int i = 1; i <= static_cast<int>(lastOf(SetPlay{})); ++i) {
    m_play->addItem(asLabel(wordsOf(static_cast<SetPlay>(i))), i);
  }
  row->addWidget(m_team);
  row->addWidget(m_play, 1);
  m_column->addLayout(row);
  QGridLayout* grid = newGrid(this);
  const auto give = [this] {
    call({.kind = CallKind::SetPlay,
          .team = m_team->currentIndex(),
          .setPlay = static_cast<SetPlay>(m_play->currentData().toInt())},
         m_play->currentText());
  };
  const auto simple = [this](CallKind kind, const char* words) {
    return [this, kind, words] { call({.kind = kind}, QString::fromUtf8(words)); };
  };
  grid->addWidget(button(QStringLiteral("Give"), QStringLiteral("From where the ball lies"), give,
                         "Ctrl+Alt+K"),
                  0, 0);
  grid->addWidget(button(QStringLiteral("Next step"),
                         QStringLiteral("Ball placed, prepared, executed, in play"),
                         simple(CallKind::NextStep, "next step"), "Ctrl+Alt+N"),
                  0, 1);
  grid->addWidget(button(QStringLiteral("Drop ball"), QStringLiteral("READY, nobody's kick-off"),
                         simple(CallKind::DropBall, "drop ball"), "Ctrl+Alt+D"),
                  0, 2);
  m_column->addLayout(grid);
}

void RefereeGame::addBall() {
  auto* row = new QHBoxLayout;
  row->addWidget(new QLabel(QStringLiteral("Ball"), this));
  const auto box = [&](const char* name, const char* tip) {
    constexpr double farthest = 30.0;  // m; the match keeps it inside its walls
    auto* made = new NumberBox(this);
    made->setObjectName(QString::fromUtf8(name));
    made->setRange(-farthest, farthest);
    made->setDecimals(2);
    made->setSingleStep(0.1);
    made->setSuffix(QStringLiteral(" m"));
    made->setToolTip(QString::fromUtf8(tip));
    row->addWidget(made, 1);
    return made;
  };
  m_x = box("refereeBallX", "To the right of the centre mark");
  m_y = box("refereeBallY", "Up from the centre mark");
  row->addWidget(button(
      QStringLiteral("Place"), QStringLiteral("Puts the ball there, at rest"),
      [this] {
        placeBall({m_x->value(), m_y->value()});
      },
      "Ctrl+Alt+B"));
  row->addWidget(button(
      QStringLiteral("To centre"), QStringLiteral("Puts the ball on the centre mark"),
      [this] { placeBall({}); }, "Ctrl+Alt+C"));
  m_column->addLayout(row);
}

void RefereeGame::placeBall(const Point& place) {
  if (const FramePtr frame = m_match->frame()) {
    m_match->edits()->moveBall(frame->snapshot.ball, place);
  }
}

}  // namespace pitchboard::ui
