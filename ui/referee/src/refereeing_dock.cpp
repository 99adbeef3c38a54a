// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/referee/refereeing_dock.h>

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QTableWidget>
#include <QUndoStack>
#include <QVBoxLayout>
#include <functional>

#include <robotlink/scenario/referee_rule_sets.h>
#include <ui/base/robot_words.h>
#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

#include "formations.h"
#include "referee_log.h"
#include "referee_orders.h"

namespace pitchboard::ui {
namespace {

using sim::CallKind;
using sim::PenaltyKind;
using sim::PlayState;
using sim::SetPlay;

QString words(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

QString sentenceCase(QString text) {
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

class RefereeingDock : public QScrollArea {
 public:
  RefereeingDock(MatchController* controller, QWidget* parent)
      : QScrollArea(parent), m_match(controller) {
    setObjectName(QStringLiteral("refereeingDock"));
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* form = new QWidget(this);
    m_column = new QVBoxLayout(form);
    const int edge = scaled(this, 8);
    m_column->setContentsMargins(edge, 0, edge, edge);
    m_column->setSpacing(scaled(this, 4));
    addRules(form);
    m_calls = new QWidget(form);
    m_callColumn = new QVBoxLayout(m_calls);
    m_callColumn->setContentsMargins(0, 0, 0, 0);
    m_callColumn->setSpacing(scaled(this, 4));
    addStates();
    addTeams();
    addBall();
    addPenalties();
    m_column->addWidget(m_calls);
    addFormations(form);
    addLog(form);
    setWidget(form);
    setMinimumWidth(form->minimumSizeHint().width() + scaled(this, 14));
    connect(m_match, &MatchController::frameReceived, this,
            [this](const FramePtr& frame) { show(frame); });
    show(m_match->frame());
  }

 private:
  QLabel* heading(const QString& text, QWidget* parent) {
    auto* label = new QLabel(text, parent);
    label->setFont(themeFont(TypeRole::Body, true));
    label->setContentsMargins(0, scaled(this, 6), 0, 0);
    return label;
  }

  void call(sim::RefereeCall made, const QString& text) { callReferee(m_match, made, text); }

  /// A button, and its key, which works in the whole window.
  QPushButton* button(const QString& text, const QString& tip, std::function<void()> pressed,
                      const QKeySequence& key = {}) {
    auto* made = new QPushButton(text, m_calls);
    made->setObjectName(QStringLiteral("referee ") + text);
    made->setMinimumWidth(scaled(this, 40));
    made->setToolTip(
        key.isEmpty() ? tip
                      : tip + QStringLiteral(" (%1)").arg(key.toString(QKeySequence::NativeText)));
    connect(made, &QPushButton::clicked, this, [pressed] { pressed(); });
    if (!key.isEmpty()) {
      auto* action = new QAction(text, this);
      action->setShortcut(key);
      connect(action, &QAction::triggered, made, [made] { made->click(); });
      addAction(action);
    }
    return made;
  }

  void addRules(QWidget* form) {
    m_column->addWidget(heading(QStringLiteral("Rules"), form));
    m_rules = new QComboBox(form);
    m_rules->setObjectName(QStringLiteral("refereeRules"));
    for (const link::RuleSetInfo& set : link::refereeRuleSets()) {
      m_rules->addItem(QString::fromStdString(set.title), QString::fromStdString(set.name));
      m_rules->setItemData(m_rules->count() - 1, QString::fromStdString(set.description),
                           Qt::ToolTipRole);
    }
    m_rules->setToolTip(QStringLiteral("Choosing rules begins the game anew, in INITIAL."));
    connect(m_rules, &QComboBox::activated, this, [this] { chooseRules(); });
    m_column->addWidget(m_rules);
    m_automatic = new QCheckBox(QStringLiteral("The referee calls by itself"), form);
    m_automatic->setObjectName(QStringLiteral("refereeAutomatic"));
    m_automatic->setToolTip(
        QStringLiteral("Off: only your calls, and READY that runs out, change the game."));
    connect(m_automatic, &QCheckBox::clicked, this, [this](bool on) {
      call({.kind = CallKind::Automatic, .value = on ? 1 : 0},
           on ? QStringLiteral("automatic referee") : QStringLiteral("referee by hand"));
    });
    m_column->addWidget(m_automatic);
    m_state = new QLabel(form);
    m_state->setObjectName(QStringLiteral("refereeState"));
    m_state->setWordWrap(true);
    m_column->addWidget(m_state);
  }

  void chooseRules() {
    const std::string name = m_rules->currentData().toString().toStdString();
    m_match->post(MatchOrder{QStringLiteral("The rules were not changed"),
                             [name](link::SimulatedMatch& match) -> Result<void> {
                               auto rules = link::refereeRuleSet(name);
                               if (!rules) return tl::unexpected(rules.error());
                               return match.simulation().setReferee(*rules);
                             }});
    m_match->edits()->undoStack()->clear();
  }

  void addStates() {
    m_callColumn->addWidget(heading(QStringLiteral("Game"), m_calls));
    auto* grid = new QGridLayout;
    grid->setSpacing(scaled(this, 4));
    const struct {
      PlayState state;
      const char* tip;
      const char* key;
    } states[] = {{PlayState::Ready, "Robots walk to their places", "Ctrl+Alt+R"},
                  {PlayState::Set, "Robots stand", "Ctrl+Alt+S"},
                  {PlayState::Playing, "The whistle", "Ctrl+Alt+P"},
                  {PlayState::Finished, "The half is over", "Ctrl+Alt+F"}};
    int column = 0;
    for (const auto& one : states) {
      const QString name = words(wordsOf(one.state));
      grid->addWidget(button(
                          name, QString::fromUtf8(one.tip),
                          [this, state = one.state, name] {
                            call({.kind = CallKind::State, .state = state}, name);
                          },
                          QKeySequence(QString::fromUtf8(one.key))),
                      0, column++);
    }
    const auto simple = [this](CallKind kind, const QString& text) {
      return [this, kind, text] { call({.kind = kind}, text); };
    };
    grid->addWidget(button(QStringLiteral("Next half"), QStringLiteral("After FINISHED"),
                           simple(CallKind::NextHalf, QStringLiteral("next half"))),
                    1, 0);
    grid->addWidget(button(QStringLiteral("Shoot-out"), QStringLiteral("After FINISHED"),
                           simple(CallKind::ShootOut, QStringLiteral("shoot-out"))),
                    1, 1);
    grid->addWidget(button(QStringLiteral("Stop"), QStringLiteral("Play is stopped"),
                           simple(CallKind::Stop, QStringLiteral("stop")),
                           QKeySequence(QStringLiteral("Ctrl+Alt+X"))),
                    1, 2);
    grid->addWidget(button(QStringLiteral("Go on"), QStringLiteral("Play goes on"),
                           simple(CallKind::GoOn, QStringLiteral("go on")),
                           QKeySequence(QStringLiteral("Ctrl+Alt+G"))),
                    1, 3);
    m_callColumn->addLayout(grid);
  }

  void addTeams() {
    auto* grid = new QGridLayout;
    grid->setSpacing(scaled(this, 4));
    for (int team = 0; team < 2; ++team) {
      const QString colour = team == 0 ? QStringLiteral("Blue") : QStringLiteral("Red");
      grid->addWidget(new QLabel(colour, m_calls), team, 0);
      grid->addWidget(
          button(
              QStringLiteral("Goal %1").arg(colour), QStringLiteral("A goal for this team"),
              [this, team] {
                call({.kind = CallKind::Goal, .team = team, .value = 1}, QStringLiteral("goal"));
              },
              QKeySequence(team == 0 ? QStringLiteral("Ctrl+Alt+1")
                                     : QStringLiteral("Ctrl+Alt+2"))),
          team, 1);
      grid->addWidget(button(QStringLiteral("− %1").arg(colour),
                             QStringLiteral("Takes a goal of this team back"),
                             [this, team] {
                               call({.kind = CallKind::Goal, .team = team, .value = -1},
                                    QStringLiteral("goal taken back"));
                             }),
                      team, 2);
      grid->addWidget(button(QStringLiteral("Kick-off %1").arg(colour),
                             QStringLiteral("This team has the next kick-off"),
                             [this, team] {
                               call({.kind = CallKind::KickOff, .team = team},
                                    QStringLiteral("kick-off"));
                             }),
                      team, 3);
      grid->addWidget(button(QStringLiteral("Timeout %1").arg(colour),
                             QStringLiteral("In INITIAL, READY and SET"),
                             [this, team] {
                               call({.kind = CallKind::Timeout, .team = team},
                                    QStringLiteral("timeout"));
                             }),
                      team, 4);
    }
    m_callColumn->addLayout(grid);
  }

  void addBall() {
    m_callColumn->addWidget(heading(QStringLiteral("Set plays"), m_calls));
    auto* row = new QHBoxLayout;
    m_team = new QComboBox(m_calls);
    m_team->setObjectName(QStringLiteral("refereeTeam"));
    m_team->addItems({QStringLiteral("For blue"), QStringLiteral("For red")});
    m_play = new QComboBox(m_calls);
    m_play->setObjectName(QStringLiteral("refereeSetPlay"));
    for (int i = 1; i <= static_cast<int>(lastOf(SetPlay{})); ++i) {
      m_play->addItem(sentenceCase(words(wordsOf(static_cast<SetPlay>(i)))), i);
    }
    row->addWidget(m_team);
    row->addWidget(m_play, 1);
    m_callColumn->addLayout(row);
    auto* grid = new QGridLayout;
    grid->setSpacing(scaled(this, 4));
    grid->addWidget(button(
                        QStringLiteral("Give"), QStringLiteral("From where the ball lies"),
                        [this] {
                          call({.kind = CallKind::SetPlay,
                                .team = m_team->currentIndex(),
                                .setPlay = static_cast<SetPlay>(m_play->currentData().toInt())},
                               m_play->currentText());
                        },
                        QKeySequence(QStringLiteral("Ctrl+Alt+K"))),
                    0, 0);
    grid->addWidget(
        button(
            QStringLiteral("Next step"), QStringLiteral("Ball placed, prepared, executed, in play"),
            [this] { call({.kind = CallKind::NextStep}, QStringLiteral("next step")); },
            QKeySequence(QStringLiteral("Ctrl+Alt+N"))),
        0, 1);
    grid->addWidget(button(
                        QStringLiteral("Drop ball"), QStringLiteral("READY, nobody's kick-off"),
                        [this] { call({.kind = CallKind::DropBall}, QStringLiteral("drop ball")); },
                        QKeySequence(QStringLiteral("Ctrl+Alt+D"))),
                    0, 2);
    grid->addWidget(
        button(QStringLiteral("Ball to centre"), QStringLiteral("Puts the ball on the centre mark"),
               [this] {
                 const FramePtr frame = m_match->frame();
                 if (frame) m_match->edits()->moveBall(frame->snapshot.ball, {});
               }),
        0, 3);
    m_callColumn->addLayout(grid);
  }

  void addPenalties() {
    m_callColumn->addWidget(heading(QStringLiteral("Penalties"), m_calls));
    m_kind = new QComboBox(m_calls);
    m_kind->setObjectName(QStringLiteral("refereePenalty"));
    for (int i = 1; i <= static_cast<int>(lastOf(PenaltyKind{})); ++i) {
      m_kind->addItem(sentenceCase(words(wordsOf(static_cast<PenaltyKind>(i)))), i);
    }
    m_kind->setCurrentIndex(static_cast<int>(PenaltyKind::Incapable) - 1);
    auto* row = new QHBoxLayout;
    row->addWidget(m_kind, 1);
    row->addWidget(button(
        QStringLiteral("Penalise"), QStringLiteral("The robots chosen in the table"),
        [this] {
          for (const RobotId robot : chosen()) {
            call({.kind = CallKind::Penalise,
                  .robot = robot,
                  .penalty = static_cast<PenaltyKind>(m_kind->currentData().toInt())},
                 QStringLiteral("penalty"));
          }
        },
        QKeySequence(QStringLiteral("Ctrl+Alt+A"))));
    row->addWidget(
        button(QStringLiteral("Pardon"), QStringLiteral("The robots chosen in the table"), [this] {
          for (const RobotId robot : chosen()) {
            call({.kind = CallKind::Pardon, .robot = robot}, QStringLiteral("pardon"));
          }
        }));
    m_callColumn->addLayout(row);
    m_robots = new QTableWidget(0, 3, m_calls);
    m_robots->setObjectName(QStringLiteral("refereeRobots"));
    m_robots->setHorizontalHeaderLabels(
        {QStringLiteral("Robot"), QStringLiteral("Penalty"), QStringLiteral("Seconds")});
    m_robots->verticalHeader()->hide();
    m_robots->horizontalHeader()->setSectionResizeMode(1, QHeaderView::Stretch);
    m_robots->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_robots->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_robots->setMinimumHeight(scaled(this, 120));
    m_callColumn->addWidget(m_robots);
  }

  std::vector<RobotId> chosen() const {
    std::vector<RobotId> robots;
    for (const QModelIndex& index : m_robots->selectionModel()->selectedRows()) {
      robots.push_back(RobotId{m_robots->item(index.row(), 0)->data(Qt::UserRole).toInt()});
    }
    return robots;
  }

  void addFormations(QWidget* form) {
    m_column->addWidget(heading(QStringLiteral("Formations"), form));
    auto* row = new QHBoxLayout;
    m_formation = new QComboBox(form);
    m_formation->setObjectName(QStringLiteral("refereeFormation"));
    for (const Formation& one : formations()) {
      m_formation->addItem(QString::fromUtf8(one.name));
      m_formation->setItemData(m_formation->count() - 1, QString::fromUtf8(one.meaning),
                               Qt::ToolTipRole);
    }
    row->addWidget(m_formation, 1);
    for (const bool left : {true, false}) {
      auto* load = new QPushButton(
          left ? QStringLiteral("Left attacks") : QStringLiteral("Right attacks"), form);
      load->setToolTip(QStringLiteral("Puts ball and robots there; play goes on"));
      connect(load, &QPushButton::clicked, this, [this, left] { loadFormation(left); });
      row->addWidget(load);
    }
    m_column->addLayout(row);
  }

  void loadFormation(bool left) {
    const FramePtr frame = m_match->frame();
    if (!frame) return;
    const FormationPlaces places =
        placesOf(static_cast<std::size_t>(m_formation->currentIndex()), *frame, left);
    std::vector<RobotPlacement> moves;
    for (const auto& [id, pose] : places.robots) {
      if (const link::RobotFrame* robot = frame->robot(id)) {
        moves.push_back({id, robot->pose, pose});
      }
    }
    QUndoStack* undo = m_match->edits()->undoStack();
    undo->beginMacro(QStringLiteral("formation: ") + m_formation->currentText());
    m_match->edits()->moveRobots(moves);
    m_match->edits()->moveBall(frame->snapshot.ball, places.ball);
    undo->endMacro();
  }

  void addLog(QWidget* form) {
    m_column->addWidget(heading(QStringLiteral("Log of the referee"), form));
    m_column->addWidget(new RefereeLog(m_match, form), 1);
  }

  void show(const FramePtr& frame) {
    const bool refereed = frame && frame->referee;
    m_calls->setEnabled(refereed);
    m_automatic->setEnabled(refereed);
    m_rules->setEnabled(frame != nullptr);
    if (!m_rules->view()->isVisible()) {
      const QString name =
          frame ? QString::fromStdString(frame->refereeRules) : QStringLiteral("published");
      const int index = m_rules->findData(name.isEmpty() ? QStringLiteral("published") : name);
      if (index != m_rules->currentIndex()) m_rules->setCurrentIndex(index);
    }
    if (!refereed) {
      m_state->setText(QStringLiteral("This match has no referee. Choose rules to get one."));
      m_robots->setRowCount(0);
      return;
    }
    const link::RefereeView& view = *frame->referee;
    m_automatic->setChecked(frame->refereeAutomatic);
    QString text = QString::fromStdString(view.state);
    if (!view.setPlay.empty()) text += QStringLiteral(", ") + QString::fromStdString(view.setPlay);
    if (!view.phase.empty()) text += QStringLiteral(", ") + QString::fromStdString(view.phase);
    text += view.firstHalf ? QStringLiteral(", first half") : QStringLiteral(", second half");
    if (view.stopped) text += QStringLiteral(", stopped");
    if (view.secondaryTime) text += QStringLiteral(", %1 s").arg(*view.secondaryTime);
    m_state->setText(text);
    m_robots->setRowCount(static_cast<int>(frame->robots.size()));
    for (int row = 0; row < m_robots->rowCount(); ++row) {
      const link::RobotFrame& robot = frame->robots[static_cast<std::size_t>(row)];
      cell(row, 0, robotName(robot.identity))->setData(Qt::UserRole, robot.id().value);
      cell(row, 1, robot.penalty ? QString::fromStdString(robot.penalty->words) : QString());
      cell(row, 2, robot.penalty ? QString::number(robot.penalty->secondsLeft) : QString());
    }
  }

  QTableWidgetItem* cell(int row, int column, const QString& text) {
    QTableWidgetItem* item = m_robots->item(row, column);
    if (item == nullptr) {
      item = new QTableWidgetItem;
      m_robots->setItem(row, column, item);
    }
    if (item->text() != text) item->setText(text);
    return item;
  }

  MatchController* m_match;
  QVBoxLayout* m_column = nullptr;
  QVBoxLayout* m_callColumn = nullptr;
  QWidget* m_calls = nullptr;
  QComboBox *m_rules = nullptr, *m_team = nullptr, *m_play = nullptr, *m_kind = nullptr,
            *m_formation = nullptr;
  QCheckBox* m_automatic = nullptr;
  QLabel* m_state = nullptr;
  QTableWidget* m_robots = nullptr;
};

}  // namespace

QWidget* makeRefereeingDock(MatchController* controller, QWidget* parent) {
  return new RefereeingDock(controller, parent);
}

}  // namespace pitchboard::ui
