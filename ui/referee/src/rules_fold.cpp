// SPDX-License-Identifier: GPL-3.0-or-later
#include "rules_fold.h"

#include <QAbstractItemView>
#include <QAction>
#include <QPushButton>
#include <QVBoxLayout>

#include <robotlink/scenario/referee_rule_sets.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/referee_calls.h>

#include "formations.h"

namespace pitchboard::ui {
namespace {

using sim::CallKind;

QHBoxLayout* addRow(QWidget* inside) {
  auto* row = new QHBoxLayout;
  row->setSpacing(scaled(inside, 4));
  static_cast<QVBoxLayout*>(inside->layout())->addLayout(row);
  return row;
}

}  // namespace

RulesFold::RulesFold(MatchController* match, QWidget* parent)
    : QWidget(parent), m_match(match), m_fold(new QToolButton(this)), m_inside(new QWidget(this)) {
  m_fold->setObjectName(QStringLiteral("refereeFold"));
  m_fold->setText(QStringLiteral("Rules, formations, ball"));
  m_fold->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  m_fold->setArrowType(Qt::RightArrow);
  m_fold->setAutoRaise(true);
  m_fold->setCheckable(true);
  connect(m_fold, &QToolButton::toggled, this, [this](bool open) {
    m_fold->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
    m_inside->setVisible(open);
  });
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(scaled(this, 4));
  column->addWidget(m_fold);
  column->addWidget(m_inside);
  auto* rows = new QVBoxLayout(m_inside);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(scaled(this, 4));
  addRules();
  addFormations();
  addBall();
  m_inside->hide();
}

void RulesFold::addRules() {
  m_rules = new QComboBox(m_inside);
  m_rules->setObjectName(QStringLiteral("refereeRules"));
  m_rules->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  for (const link::RuleSetInfo& set : link::refereeRuleSets()) {
    m_rules->addItem(QString::fromStdString(set.title), QString::fromStdString(set.name));
    m_rules->setItemData(m_rules->count() - 1, QString::fromStdString(set.description),
                         Qt::ToolTipRole);
  }
  connect(m_rules, &QComboBox::activated, this, [this] {
    chooseReferee(m_match->edits(), m_rules->currentData().toString().toStdString(),
                  m_rules->currentText());
  });
  QHBoxLayout* row = addRow(m_inside);
  row->addWidget(new QLabel(QStringLiteral("Rules"), m_inside));
  row->addWidget(m_rules, 1);
  m_automatic = new QCheckBox(QStringLiteral("Automatic referee"), m_inside);
  m_automatic->setObjectName(QStringLiteral("refereeAutomatic"));
  connect(m_automatic, &QCheckBox::clicked, this, [this](bool on) {
    callReferee(m_match->edits(), {.kind = CallKind::Automatic, .value = on ? 1 : 0},
                on ? QStringLiteral("automatic referee") : QStringLiteral("referee by hand"));
  });
  addRow(m_inside)->addWidget(m_automatic);
}

void RulesFold::addFormations() {
  QHBoxLayout* row = addRow(m_inside);
  m_formation = new QComboBox(m_inside);
  m_formation->setObjectName(QStringLiteral("refereeFormation"));
  for (const Formation& one : formations()) {
    m_formation->addItem(QString::fromUtf8(one.name));
    m_formation->setItemData(m_formation->count() - 1, QString::fromUtf8(one.meaning),
                             Qt::ToolTipRole);
  }
  row->addWidget(m_formation, 1);
  row = addRow(m_inside);  // a docked panel has no room for three
  for (const bool left : {true, false}) {
    auto* load = new QPushButton(
        left ? QStringLiteral("Left attacks") : QStringLiteral("Right attacks"), m_inside);
    connect(load, &QPushButton::clicked, this, [this, left] { loadFormation(left); });
    row->addWidget(load, 1);
  }
  m_asSetPlay = new QCheckBox(QStringLiteral("Also award the set play"), m_inside);
  m_asSetPlay->setObjectName(QStringLiteral("refereeAsSetPlay"));
  addRow(m_inside)->addWidget(m_asSetPlay);
  m_staysOff = new QLabel(m_inside);
  m_staysOff->setObjectName(QStringLiteral("refereeStaysOff"));
  m_staysOff->setFont(themeFont(TypeRole::Secondary));
  m_staysOff->setWordWrap(true);
  addRow(m_inside)->addWidget(m_staysOff);
}

void RulesFold::addBall() {
  QHBoxLayout* row = addRow(m_inside);
  row->addWidget(new QLabel(QStringLiteral("Ball"), m_inside));
  const auto box = [&](const char* name, const char* tip) {
    constexpr double farthest = 30.0;  // m; the match keeps it inside its walls
    auto* made = new NumberBox(m_inside);
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
  row = addRow(m_inside);
  const auto place = [&](const char* text, const char* tip, const char* key,
                         const std::function<Point()>& where) {
    auto* button = new QPushButton(QString::fromUtf8(text), m_inside);
    button->setObjectName(QStringLiteral("referee ") + QString::fromUtf8(text));
    button->setToolTip(
        QStringLiteral("%1 (%2)").arg(QString::fromUtf8(tip), QString::fromUtf8(key)));
    connect(button, &QPushButton::clicked, this, [this, where] { placeBall(where()); });
    row->addWidget(button);
    // Works folded away, too.
    auto* action = new QAction(this);
    action->setShortcut(QKeySequence(QString::fromUtf8(key)));
    action->setAutoRepeat(false);
    connect(action, &QAction::triggered, this, [this, where] { placeBall(where()); });
    addAction(action);
  };
  place("Place", "Places the ball there without motion", "Ctrl+Alt+B", [this] {
    return Point{m_x->value(), m_y->value()};
  });
  place("To centre", "Puts the ball on the centre mark", "Ctrl+Alt+C", [] { return Point{}; });
}

void RulesFold::placeBall(Point place) {
  if (const FramePtr frame = m_match->frame()) {
    m_match->edits()->moveBall(frame->snapshot.ball, place);
  }
}

void RulesFold::loadFormation(bool left) {
  const FramePtr frame = m_match->frame();
  if (!frame) return;
  const FormationPlaces places =
      placesOf(static_cast<std::size_t>(m_formation->currentIndex()), *frame, left);
  using Poses = std::vector<std::pair<RobotId, Pose>>;
  const auto put = [](sim::Simulation& simulation, const Poses& robots, Point ball,
                      Velocity velocity) {
    // A robot that left meanwhile has nothing to be placed.
    for (const auto& [id, pose] : robots) (void)simulation.placeRobot(id, pose);
    return simulation.placeBall(ball, velocity);
  };
  const auto before = std::make_shared<sim::Snapshot>();
  std::vector<EditStep> steps{{[places, before, put](link::SimulatedMatch& match) {
                                 *before = match.simulation().snapshot();
                                 return put(match.simulation(), places.robots, places.ball, {});
                               },
                               [before, put](link::SimulatedMatch& match) {
                                 Poses robots;
                                 for (const sim::RobotSnapshot& one : before->robots) {
                                   robots.emplace_back(one.identity.id, one.pose);
                                 }
                                 return put(match.simulation(), robots, before->ball,
                                            before->ballVelocity);
                               }}};
  if (m_asSetPlay->isChecked() && frame->refereedGame && places.setPlay != sim::SetPlay::None) {
    steps.push_back(
        refereeStep(m_match->edits(), {.kind = CallKind::SetPlay,
                                       .team = frame->refereedGame->game.teamOf(places.attackers),
                                       .setPlay = places.setPlay,
                                       .place = places.ball}));
  }
  m_match->edits()->performOrder(QStringLiteral("formation: ") + m_formation->currentText(),
                                 QStringLiteral("Could not load the formation"), std::move(steps));
}

void RulesFold::show(const link::MatchFrame* shown, const QString& why) {
  const auto set = [&why](QWidget* control, const char* tip) {
    control->setEnabled(why.isEmpty());
    control->setToolTip(why.isEmpty() ? QString::fromUtf8(tip) : why);
  };
  const bool refereed = shown != nullptr && shown->referee;
  // Without a referee nothing else is there.
  if (shown != nullptr && std::exchange(m_refereed, refereed) != refereed) {
    m_fold->setChecked(!refereed);
  }
  set(m_rules, "Restarts the game in INITIAL with these rules. Undo brings the old game back.");
  set(m_automatic, "When off, only your calls and the end of READY change the game.");
  set(m_formation, "Positions of both teams and the ball");
  set(m_asSetPlay,
      "During PLAYING, also awards the corner kick, throw-in, … to the attacking side");
  for (auto* button : m_inside->findChildren<QPushButton*>()) button->setEnabled(why.isEmpty());
  for (NumberBox* box : {m_x, m_y}) box->setEnabled(why.isEmpty());
  m_automatic->setEnabled(why.isEmpty() && refereed);
  m_asSetPlay->setEnabled(why.isEmpty() && refereed);
  if (shown == nullptr) return;
  if (!m_rules->view()->isVisible()) {
    const QString name = QString::fromStdString(shown->refereeRules);
    const int index = m_rules->findData(name.isEmpty() ? QStringLiteral("published") : name);
    if (index != m_rules->currentIndex()) m_rules->setCurrentIndex(index);
  }
  if (shown->refereedGame) m_automatic->setChecked(shown->refereedGame->rules.automatic);
  QStringList off;
  for (const link::RobotFrame& robot : shown->robots) {
    if (robot.penalty) off << robotName(robot);
  }
  m_staysOff->setVisible(!off.isEmpty());
  m_staysOff->setText(off.size() == 1
                          ? QStringLiteral("%1 is penalised and stays off the field.").arg(off[0])
                          : QStringLiteral("%1 are penalised and stay off the field.")
                                .arg(off.join(QStringLiteral(", "))));
}

}  // namespace pitchboard::ui
