// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/beat.h>
#include <ui/referee/referee_panel.h>

#include <QAction>
#include <QBoxLayout>
#include <QMenu>
#include <QScrollArea>
#include <QShowEvent>
#include <algorithm>
#include <array>

#include <ui/base/referee_text.h>
#include <ui/base/robot_text.h>
#include <ui/base/table_style.h>
#include <ui/sources/referee_calls.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>

#include "next_steps.h"
#include "referee_log.h"
#include "rules_fold.h"
#include "team_column.h"

namespace pitchboard::ui {
namespace {

using sim::CallKind;
using sim::RefereeCall;

/// Calls that have keys, wherever the focus is while the panel is shown.
struct KeyedCall {
  const char* key;
  const char* text;
  RefereeCall call;
};
const KeyedCall keyedCalls[] = {
    {"Ctrl+Alt+R", "READY", {.kind = CallKind::State, .state = PlayState::Ready}},
    {"Ctrl+Alt+S", "SET", {.kind = CallKind::State, .state = PlayState::Set}},
    {"Ctrl+Alt+P", "PLAYING", {.kind = CallKind::State, .state = PlayState::Playing}},
    {"Ctrl+Alt+F", "FINISHED", {.kind = CallKind::State, .state = PlayState::Finished}},
    {"Ctrl+Alt+I", "next half", {.kind = CallKind::NextHalf}},
    {"Ctrl+Alt+O", "shoot-out", {.kind = CallKind::ShootOut}},
    {"Ctrl+Alt+X", "stop", {.kind = CallKind::Stop}},
    {"Ctrl+Alt+G", "go on", {.kind = CallKind::GoOn}},
    {"Ctrl+Alt+1", "goal", {.kind = CallKind::Goal, .team = 0, .value = 1}},
    {"Ctrl+Alt+2", "goal", {.kind = CallKind::Goal, .team = 1, .value = 1}},
    {"Ctrl+Alt+3", "kick-off", {.kind = CallKind::KickOff, .team = 0}},
    {"Ctrl+Alt+4", "kick-off", {.kind = CallKind::KickOff, .team = 1}},
    {"Ctrl+Alt+5", "timeout", {.kind = CallKind::Timeout, .team = 0}},
    {"Ctrl+Alt+6", "timeout", {.kind = CallKind::Timeout, .team = 1}},
    {"Ctrl+Alt+N", "next step", {.kind = CallKind::NextStep}},
    {"Ctrl+Alt+D", "drop ball", {.kind = CallKind::DropBall}},
};

QString keyOf(const RefereeCall& call) {
  const auto found = std::ranges::find_if(keyedCalls, [&call](const KeyedCall& one) {
    return one.call.kind == call.kind && one.call.state == call.state &&
           one.call.team == call.team && one.call.value == call.value;
  });
  return found == std::end(keyedCalls) ? QString()
                                       : QStringLiteral(" (%1)").arg(QString::fromUtf8(found->key));
}

class RefereePanel : public QScrollArea {
 public:
  RefereePanel(const RefereeContext& context, QWidget* parent)
      : QScrollArea(parent), m_context(context), m_inside(new QWidget(this)) {
    setObjectName(QStringLiteral("refereePanel"));
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_column = new QVBoxLayout(m_inside);
    const int edge = scaled(this, 8);
    m_column->setContentsMargins(edge, scaled(this, 4), edge, scaled(this, 4));
    m_column->setSpacing(scaled(this, 6));
    addState();
    addNextSteps();
    addTeams();
    addPenalties();
    addSetPlays();
    m_log = new RefereeLog(context.shown, m_inside);
    m_column->addWidget(m_log, 1);
    m_rules = new RulesFold(context.controller, m_inside);
    m_column->addWidget(m_rules);
    m_column->addStretch(0);  // only while the log is hidden
    setWidget(m_inside);
    for (const KeyedCall& one : keyedCalls) {
      addKey(QString::fromUtf8(one.text), one.key,
             [this, &one] { callReferee(edits(), one.call, QString::fromUtf8(one.text)); });
    }
    constexpr Beat::Milliseconds least{100};  // between two looks at frames
    m_later = Beat::display().add(this, least, [this] { refresh(); });
    connect(context.shown, &FrameSource::frameReceived, this, [this] { m_later->want(); });
    connect(context.shown, &FrameSource::restarted, this, &RefereePanel::refresh);
    connect(context.shown, &ShownMoment::sourceChosen, this, &RefereePanel::refresh);
    connect(edits(), &MatchEdits::lockedChanged, this, &RefereePanel::refresh);
    if (context.selection != nullptr) {
      connect(context.selection, &RobotSelection::changed, this, &RefereePanel::refresh);
    }
    refresh();
  }

 protected:
  void showEvent(QShowEvent* event) override {
    refresh();
    QScrollArea::showEvent(event);
  }
  void resizeEvent(QResizeEvent* event) override {
    QScrollArea::resizeEvent(event);
    // Five controls in a row would cut off each other's labels.
    const bool wide = event->size().width() >= scaled(this, 480);
    m_penaltyRows->setDirection(wide ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
  }
  QSize sizeHint() const override { return {scaled(this, 416), scaled(this, 416)}; }

 private:
  struct Chosen {
    std::vector<RobotId> robots;
    QStringList names;
  };

  MatchEdits* edits() const { return m_context.controller->edits(); }

  void addKey(const QString& text, const char* key, const std::function<void()>& pressed) {
    auto* action = new QAction(text, this);
    action->setShortcut(QKeySequence(QString::fromUtf8(key)));
    action->setAutoRepeat(false);
    connect(action, &QAction::triggered, this, [pressed] { pressed(); });
    addAction(action);
  }

  QPushButton* button(QWidget* owner, const QString& text, const std::function<void()>& pressed) {
    auto* made = new QPushButton(text, owner);
    made->setObjectName(QStringLiteral("referee ") + text);
    made->setMinimumWidth(scaled(this, 40));
    connect(made, &QPushButton::clicked, this, [pressed] { pressed(); });
    return made;
  }

  QWidget* addRow(QWidget*& row) {
    row = new QWidget(m_inside);
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(scaled(this, 4));
    m_column->addWidget(row);
    return row;
  }

  QLabel* label(const char* name, TypeRole role, bool bold = false) {
    auto* made = new QLabel(m_inside);
    made->setObjectName(QLatin1String(name));
    made->setFont(themeFont(role, bold));
    return made;
  }

  void addState() {
    addRow(m_stateRow);
    m_state = label("refereeState", TypeRole::Score);
    QFont large = m_state->font();
    large.setPointSizeF(large.pointSizeF() * 1.3);
    m_clock = label("refereeClock", TypeRole::Score);
    for (QLabel* one : {m_state, m_clock}) one->setFont(large);
    auto* row = static_cast<QHBoxLayout*>(m_stateRow->layout());
    row->addWidget(m_state);
    row->addStretch(1);
    row->addWidget(m_clock);
    for (auto [line, name] :
         {std::pair{&m_detail, "refereeSetPlay"}, std::pair{&m_truth, "refereeTruth"}}) {
      *line = label(name, TypeRole::Secondary);
      (*line)->setForegroundRole(QPalette::PlaceholderText);
      (*line)->setWordWrap(true);
      m_column->addWidget(*line);
    }
  }

  void addNextSteps() {
    addRow(m_next);
    for (QPushButton*& one : m_steps) {
      one = new QPushButton(m_next);
      one->setMinimumWidth(scaled(this, 40));
      one->setMinimumHeight(scaled(this, 32));
      m_next->layout()->addWidget(one);
      connect(one, &QPushButton::clicked, this, [this, &one] {
        const auto index = static_cast<std::size_t>(&one - m_steps.data());
        if (index >= m_offered.size()) return;
        const NextStep step = m_offered[index];
        if (step.call) {
          callReferee(edits(), *step.call, step.text);
        } else if (step.skips) {
          m_context.controller->skipToKickOff();
        } else {
          m_context.controller->restart();
          m_context.controller->setPaused(false);
        }
      });
    }
  }

  void addTeams() {
    m_teams = new QWidget(m_inside);
    m_teamRow = new QBoxLayout(QBoxLayout::LeftToRight, m_teams);
    m_teamRow->setContentsMargins(0, 0, 0, 0);
    m_teamRow->setSpacing(scaled(this, 12));
    for (const bool right : {false, true}) {
      auto*& column = m_columns[right ? 1 : 0];
      column = new TeamColumn(
          right,
          [this](const RefereeCall& call, const QString& text) {
            callReferee(edits(), call, text);
          },
          m_teams);
      m_teamRow->addWidget(column, 1);
      connect(column->table()->selectionModel(), &QItemSelectionModel::selectionChanged, this,
              [this] { showPenalties(m_why); });
    }
    m_column->addWidget(m_teams);
  }

  void addPenalties() {
    m_who = label("refereeChosen", TypeRole::Secondary);
    m_who->setForegroundRole(QPalette::PlaceholderText);
    m_who->setWordWrap(true);  // it would make the whole panel wider than its room
    m_column->addWidget(m_who);
    m_penalties = new QWidget(m_inside);
    m_penaltyRows = new QBoxLayout(QBoxLayout::LeftToRight, m_penalties);
    m_penaltyRows->setContentsMargins(0, 0, 0, 0);
    m_penaltyRows->setSpacing(scaled(this, 4));
    for (int i = 0; i < 2; ++i) {
      auto* row = new QHBoxLayout;
      row->setSpacing(scaled(this, 4));
      m_penaltyRows->addLayout(row, i == 0 ? 1 : 0);
    }
    m_column->addWidget(m_penalties);
    m_kind = new QComboBox(m_penalties);
    m_kind->setObjectName(QStringLiteral("refereePenalty"));
    m_kind->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_kind->setMinimumContentsLength(8);
    for (int i = 1; i <= static_cast<int>(lastOf(PenaltyKind{})); ++i) {
      const auto kind = static_cast<PenaltyKind>(i);
      // These have controls of their own.
      if (kind == PenaltyKind::SentOff || kind == PenaltyKind::Substitute) continue;
      m_kind->addItem(capitalised(labelOf(kind)), i);
    }
    m_kind->setCurrentIndex(m_kind->findData(static_cast<int>(PenaltyKind::Incapable)));
    penaltyRow(0)->addWidget(m_kind, 1);
    addForChosen("Penalise", "Ctrl+Alt+A", "The chosen robots leave the field for a while", [this] {
      return RefereeCall{.kind = CallKind::Penalise,
                         .penalty = static_cast<PenaltyKind>(m_kind->currentData().toInt())};
    });
    addForChosen("Pardon", "Ctrl+Alt+E", "The chosen robots may play again",
                 [] { return RefereeCall{.kind = CallKind::Pardon}; });
    m_card = new QPushButton(m_penalties);
    m_card->setObjectName(QStringLiteral("refereeCard"));
    m_card->setText(QStringLiteral("Card"));
    m_card->setMinimumWidth(scaled(this, 40));
    auto* menu = new QMenu(m_card);
    const std::array<std::pair<const char*, const char*>, 3> cards{
        {{"Warning", "Ctrl+Alt+W"}, {"Yellow card", "Ctrl+Alt+Y"}, {"Red card", "Ctrl+Alt+Z"}}};
    for (int value = 0; value < 3; ++value) {
      const QString text = QString::fromUtf8(cards[static_cast<std::size_t>(value)].first);
      addKey(text, cards[static_cast<std::size_t>(value)].second, [this, value, text] {
        callReferee(edits(), {.kind = CallKind::Card, .value = value}, chosen().robots,
                    text.toLower());
      });
      menu->addAction(actions().constLast());
    }
    m_card->setMenu(menu);
    penaltyRow(1)->addWidget(m_card);
    addForChosen(
        "Take off", "Ctrl+Alt+U",
        "Takes the robot off as a substitute. Pardon brings it or another one on",
        [] { return RefereeCall{.kind = CallKind::Penalise, .penalty = PenaltyKind::Substitute}; });
  }

  /// The kind; Penalise, Pardon, Card, Take off.
  QHBoxLayout* penaltyRow(int number) const {
    return static_cast<QHBoxLayout*>(m_penaltyRows->itemAt(number)->layout());
  }

  void addForChosen(const char* text, const char* key, const char* tip,
                    const std::function<RefereeCall()>& call) {
    const QString label = QString::fromUtf8(text);
    const auto pressed = [this, call, label] {
      callReferee(edits(), call(), chosen().robots, label.toLower());
    };
    QPushButton* made = button(m_penalties, label, pressed);
    penaltyRow(1)->addWidget(made);
    addKey(label, key, pressed);
    m_forChosen.push_back(
        {made, call,
         QStringLiteral("%1 (%2)").arg(QString::fromUtf8(tip), QString::fromUtf8(key))});
  }

  void addSetPlays() {
    addRow(m_setPlays);
    m_for = new QComboBox(m_setPlays);
    m_for->setObjectName(QStringLiteral("refereeTeam"));
    m_for->addItems({QStringLiteral("For BLUE"), QStringLiteral("For RED")});
    m_play = new QComboBox(m_setPlays);
    m_play->setObjectName(QStringLiteral("refereeSetPlay"));
    m_play->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_play->setMinimumContentsLength(8);
    for (int i = 1; i <= static_cast<int>(lastOf(SetPlay{})); ++i) {
      m_play->addItem(capitalised(labelOf(static_cast<SetPlay>(i))), i);
    }
    const auto give = [this] { callReferee(edits(), setPlay(), m_play->currentText()); };
    m_give = button(m_setPlays, QStringLiteral("Give"), give);
    addKey(QStringLiteral("Give"), "Ctrl+Alt+K", give);
    auto* row = static_cast<QHBoxLayout*>(m_setPlays->layout());
    row->addWidget(m_for);
    row->addWidget(m_play, 1);
    row->addWidget(m_give);
  }

  RefereeCall setPlay() const {
    return {.kind = CallKind::SetPlay,
            .team = m_for->currentIndex(),
            .setPlay = static_cast<SetPlay>(m_play->currentData().toInt())};
  }

  /// Of the tables, else of the field.
  Chosen chosen() const {
    Chosen all;
    const FramePtr frame = m_context.controller->frame();
    if (!frame || !frame->rules) return all;
    const auto add = [&all](const link::RobotFrame& robot) {
      all.robots.push_back(robot.slot());
      all.names << robotName(robot);
    };
    for (const TeamColumn* column : m_columns) {
      const auto& team = frame->game->teams[static_cast<std::size_t>(column->team())];
      for (const int number : column->chosen()) {
        for (const link::RobotFrame& robot : frame->robots) {
          if (robot.identity.team == team.colour && robot.identity.number == number) add(robot);
        }
      }
    }
    if (!all.robots.empty() || m_context.selection == nullptr) return all;
    for (const RobotUid uid : m_context.selection->ids()) {
      if (const link::RobotFrame* robot = frame->robot(uid)) add(*robot);
    }
    return all;
  }

  void refresh() {
    if (!isVisible()) return;
    const FramePtr frame = m_context.shown->frame();
    const bool simulating = m_context.shown->kind().canBeEdited;
    const bool refereed = frame && frame->game;
    m_why = edits()->isLocked() ? MatchEdits::lockedText() : QString();
    showState(frame.get());
    for (QWidget* part : {m_next, m_penalties, m_setPlays, static_cast<QWidget*>(m_who)}) {
      part->setVisible(simulating && refereed);
    }
    m_rules->setVisible(simulating);
    m_teams->setVisible(refereed);
    m_log->setVisible(frame != nullptr);
    m_column->setStretchFactor(m_teams, simulating ? 0 : 2);
    m_teamRow->setDirection(simulating ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    if (refereed) {
      for (TeamColumn* column : m_columns) column->show(*frame, simulating);
    }
    if (!simulating) return;
    m_rules->show(frame.get(), m_why);
    if (!refereed) return;
    showNextSteps();
    const link::MatchFrame* present = m_context.controller->frame().get();
    for (TeamColumn* column : m_columns) column->setLocked(present, m_why);
    showPenalties(m_why);
    showSetPlays(m_why);
  }

  void showState(const link::MatchFrame* frame) {
    const bool any = frame != nullptr && frame->game;
    m_stateRow->setVisible(any);
    m_log->setVisible(any || m_log->model()->rowCount() > 0);
    if (!any) {
      m_state->setText({});
      m_clock->setText({});
      const SourceKind& kind = m_context.shown->kind();
      m_detail->setText(
          kind.hasPresent && !kind.canBeEdited
              ? QStringLiteral(
                    "Waiting for the referee… Choose its port and version in Live settings.")
          : frame == nullptr ? m_context.shown->emptyText()
          : !kind.hasPresent
              ? QStringLiteral("This session has no referee at this moment.")
              : QStringLiteral("This match has no referee. Choose rules below to get "
                               "one."));
      m_detail->show();
      m_truth->hide();
      return;
    }
    const Game& game = *frame->game;
    m_state->setText(labelText(game.state));
    m_clock->setText(refereeClockText(game.secondsLeft()));
    QStringList parts{game.half == 1 ? QStringLiteral("First half")
                                     : QStringLiteral("Second half")};
    if (game.phase != GamePhase::Normal) parts << labelText(game.phase);
    if (game.stopped) parts << QStringLiteral("stopped");
    if (frame->reception.timedOut) {
      parts << QStringLiteral("last packet %1 ago").arg(durationText(frame->reception.age));
    }
    const QString play = refereeSetPlayText(*frame);
    if (!play.isEmpty()) parts << play;
    QString detail = parts.join(QStringLiteral(" · "));
    if (!m_why.isEmpty()) detail += QLatin1Char('\n') + m_why;
    m_detail->setText(detail);
    m_truth->setText(refereeTruthText(*frame));
    m_truth->setVisible(!m_truth->text().isEmpty());
  }

  void showNextSteps() {
    const FramePtr present = m_context.controller->frame();
    if (present && present->rules) m_offered = nextSteps(*present->game, *present->rules);
    for (std::size_t i = 0; i < m_steps.size(); ++i) {
      QPushButton* one = m_steps[i];
      one->setVisible(i < m_offered.size());
      one->setEnabled(i < m_offered.size() && m_why.isEmpty());
      if (i >= m_offered.size()) continue;
      const NextStep& step = m_offered[i];
      one->setText(step.text);
      one->setObjectName(QStringLiteral("referee ") + step.text);
      one->setToolTip(!m_why.isEmpty() ? m_why
                                       : step.tip + (step.call ? keyOf(*step.call) : QString()));
      setPrimary(one, i == 0);
    }
  }

  static void setPrimary(QPushButton* one, bool primary) {
    const ThemeColors& colors = theme();
    one->setStyleSheet(
        primary ? QStringLiteral("QPushButton:enabled { background: %1; color: white; border: 1px "
                                 "solid %1; border-radius: 3px; font-weight: bold; }"
                                 "QPushButton:enabled:hover { background: %2; }")
                      .arg(colors.accentFill.name(), colors.accentFill.lighter(112).name())
                : QString());
  }

  void showPenalties(const QString& why) {
    const Chosen who = chosen();
    m_who->setText(who.robots.empty()
                       ? QStringLiteral("Choose robots above or on the field to penalise them.")
                       : QStringLiteral("For %1:").arg(who.names.join(QStringLiteral(", "))));
    QString chooseFirst = QStringLiteral("Choose robots in the tables or on the field first.");
    const FramePtr frame = m_context.controller->frame();
    const auto reason = [&](RefereeCall call) {
      if (!why.isEmpty()) return why;
      if (who.robots.empty()) return chooseFirst;
      for (const RobotId robot : who.robots) {
        call.robot = robot;
        QString refusal = whyRefused(frame.get(), call);
        if (!refusal.isEmpty()) return refusal;
      }
      return QString();
    };
    for (const ForChosen& one : m_forChosen) {
      const QString refusal = reason(one.call());
      one.button->setEnabled(refusal.isEmpty());
      one.button->setToolTip(refusal.isEmpty() ? one.tip : refusal);
    }
    const QString refusal = reason({.kind = CallKind::Card});
    m_card->setEnabled(refusal.isEmpty());
    m_card->setToolTip(refusal.isEmpty() ? QStringLiteral("Two warnings are a yellow card, two "
                                                          "yellow cards are a red one")
                                         : refusal);
    m_kind->setEnabled(why.isEmpty());
    m_kind->setToolTip(why);
  }

  void showSetPlays(const QString& why) {
    const FramePtr frame = m_context.controller->frame();
    if (!frame || !frame->rules) return;
    for (int team = 0; team < 2; ++team) {
      m_for->setItemText(team,
                         QStringLiteral("For ") + teamText(frame->game->teams[std::size_t(team)]));
    }
    for (QComboBox* box : {m_for, m_play}) box->setEnabled(why.isEmpty());
    const QString refusal = why.isEmpty() ? whyRefused(frame.get(), setPlay()) : why;
    m_give->setEnabled(refusal.isEmpty());
    m_give->setToolTip(refusal.isEmpty() ? QStringLiteral("From where the ball lies (Ctrl+Alt+K)")
                                         : refusal);
  }

  struct ForChosen {
    QPushButton* button;
    std::function<RefereeCall()> call;
    QString tip;
  };

  RefereeContext m_context;
  QWidget* m_inside;
  QWidget* m_stateRow = nullptr;
  QVBoxLayout* m_column = nullptr;
  QLabel *m_state = nullptr, *m_clock = nullptr, *m_detail = nullptr, *m_truth = nullptr,
         *m_who = nullptr;
  QWidget *m_next = nullptr, *m_teams = nullptr, *m_penalties = nullptr, *m_setPlays = nullptr;
  QBoxLayout *m_teamRow = nullptr, *m_penaltyRows = nullptr;
  std::array<QPushButton*, 3> m_steps{};
  std::vector<NextStep> m_offered;
  std::array<TeamColumn*, 2> m_columns{};
  std::vector<ForChosen> m_forChosen;
  QComboBox *m_kind = nullptr, *m_for = nullptr, *m_play = nullptr;
  QPushButton *m_card = nullptr, *m_give = nullptr;
  RefereeLog* m_log = nullptr;
  RulesFold* m_rules = nullptr;
  std::unique_ptr<Beat::Part> m_later;
  QString m_why;  // everything is grey; empty: calls are as the game allows
};

}  // namespace

QWidget* makeRefereePanel(const RefereeContext& context, QWidget* parent) {
  return new RefereePanel(context, parent);
}

}  // namespace pitchboard::ui
