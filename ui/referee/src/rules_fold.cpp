// SPDX-License-Identifier: GPL-3.0-or-later
#include "rules_fold.h"

#include <QAbstractItemView>
#include <QAction>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <base/game.h>
#include <robotlink/frame/match_event.h>
#include <robotlink/frame/match_frame.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <simcore/rules/referee.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/referee_calls.h>

namespace pitchboard::ui {

/// Formations and set plays that can be loaded onto a running match: where the robots of two teams
/// and the ball stand. Pure; metres, the studio's frame.
struct Formation {
  const char* name;     ///< as in the list
  const char* meaning;  ///< its tip
};

struct FormationPlaces {
  Point ball;
  std::vector<std::pair<RobotId, Pose>> robots;  ///< of the two teams that play
  SetPlay setPlay = SetPlay::None;               ///< that begins like this
  TeamColor attackers = TeamColor::Blue;         ///< who has the ball
};

namespace {

enum Kind : std::size_t { KickOff, Corner, ThrowIn, GoalKick, FreeKick, PenaltyKick };

/// A place as shares of half the field's length and width, for a team that attacks right.
struct Share {
  double x, y;
};
using Line = std::array<Share, 6>;

// The first keeps the goal; more robots than places stand in a row behind.
constexpr Line kickOffWith{
    {{-0.93, 0}, {-0.10, 0}, {-0.30, 0.5}, {-0.30, -0.5}, {-0.6, 0.3}, {-0.6, -0.3}}};
constexpr Line kickOffWithout{
    {{-0.93, 0}, {-0.28, 0}, {-0.40, 0.5}, {-0.40, -0.5}, {-0.65, 0.3}, {-0.65, -0.3}}};
constexpr Line attack{{{-0.93, 0}, {0, 0}, {0.55, 0.1}, {0.45, -0.3}, {0.2, 0.3}, {0, -0.3}}};
constexpr Line defence{
    {{-0.95, 0}, {-0.7, 0.25}, {-0.7, -0.2}, {-0.55, 0.05}, {-0.35, 0.4}, {-0.35, -0.4}}};
constexpr Line behind{{{-0.97, 0}, {-0.3, 0.5}, {-0.3, -0.5}, {-0.25, 0.2}, {-0.25, -0.2}, {0, 0}}};

SetPlay setPlayOf(Kind kind) {
  switch (kind) {
    case KickOff:
      return SetPlay::None;
    case Corner:
      return SetPlay::CornerKick;
    case ThrowIn:
      return SetPlay::ThrowIn;
    case GoalKick:
      return SetPlay::GoalKick;
    case FreeKick:
      return SetPlay::DirectFreeKick;
    case PenaltyKick:
      return SetPlay::PenaltyKick;
  }
  return SetPlay::None;
}

/// Of a team that attacks right; the rules of the match say where, those of 2026 if it has none.
Point ballOf(Kind kind, const link::MatchFrame& frame) {
  const sim::FieldSpec& field = frame.settings->field;
  const double x = field.halfLength(), y = field.halfWidth();
  if (kind == KickOff) return {};
  const Point where = kind == ThrowIn    ? Point{0.3 * x, y}
                      : kind == FreeKick ? Point{0.45 * x, 0.2 * y}
                                         : Point{x, y};
  const sim::RefereeStyle style =
      frame.rules ? frame.rules->style : sim::RefereeStyle::HumanoidSoccer2026;
  return sim::setPlayPlace(setPlayOf(kind), 1.0, where, style, field);
}

}  // namespace

/// Every formation, in the order of the list.
const std::vector<Formation>& formations() {
  static const std::vector<Formation> all{
      {"Kick-off", "Both teams in their halves, the ball on the centre mark"},
      {"Corner kick", "The ball in the corner, the other team before its goal"},
      {"Throw-in", "The ball on the touch line"},
      {"Goal kick", "The ball where the rules put it"},
      {"Free kick", "The ball in the opponents' half"},
      {"Penalty kick", "The ball on the mark, the keeper on its line, everybody else behind"},
  };
  return all;
}

/// `leftAttacks`: the team that defends the left goal has the ball. `index` of formations().
FormationPlaces placesOf(std::size_t index, const link::MatchFrame& frame, bool leftAttacks) {
  const auto kind = static_cast<Kind>(std::min(index, formations().size() - 1));
  const sim::FieldSpec& field = frame.settings->field;
  std::vector<sim::RobotIdentity> robots;
  for (const link::RobotFrame& robot : frame.robots) robots.push_back(robot.identity);
  const auto staysOff = [&frame](RobotId id) { return frame.robot(id)->penalty.has_value(); };
  FormationPlaces places;
  const double turn = leftAttacks ? 1.0 : -1.0;
  const Point ball = ballOf(kind, frame);
  places.ball = {turn * ball.x, turn * ball.y};
  places.setPlay = setPlayOf(kind);
  places.attackers = link::teamOn(leftAttacks ? link::Side::Left : link::Side::Right, robots);
  for (const link::Side side : {link::Side::Left, link::Side::Right}) {
    const TeamColor team = link::teamOn(side, robots);
    std::vector<sim::RobotIdentity> own;
    for (const sim::RobotIdentity& robot : robots) {
      if (robot.team == team && !staysOff(robot.id)) own.push_back(robot);
    }
    std::sort(own.begin(), own.end(),
              [](const auto& a, const auto& b) { return a.number < b.number; });
    const bool attacks = (side == link::Side::Left) == leftAttacks;
    const Line& line = kind == KickOff       ? (attacks ? kickOffWith : kickOffWithout)
                       : kind == GoalKick    ? (attacks ? defence : attack)
                       : kind == PenaltyKick ? (attacks ? attack : behind)
                       : attacks             ? attack
                                             : defence;
    const double sign = side == link::Side::Left ? 1.0 : -1.0;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const Share& share = line[i % line.size()];
      const std::size_t rank = i / line.size();
      const double row = static_cast<double>(rank) * 0.35;
      Point place{share.x * field.halfLength() - row, share.y * field.halfWidth()};
      double yaw = 0.0;
      if (attacks && i == 1 && kind != KickOff && kind != GoalKick) {
        // The taker stands in front of the ball.
        place = {ball.x - 0.4, ball.y};
        if (kind == Corner) place = {ball.x - 0.1, ball.y + 0.45};
        yaw = kind == Corner ? -std::numbers::pi / 2 : 0.0;
      } else if (kind == PenaltyKick && i > 0) {
        // Behind the ball, for both.
        const double x = attacks ? 0.15 : -0.1;
        place = {(attacks ? 1.0 : -1.0) * x * field.halfLength() - (attacks ? 0.6 : 0.0),
                 (static_cast<double>(i) - 1.5) * 0.8 + (attacks ? 0.4 : 0.0)};
      }
      const double heading = sign > 0 ? yaw : std::numbers::pi + yaw;
      places.robots.emplace_back(own[i].id, Pose{{sign * place.x, sign * place.y}, heading});
    }
  }
  return places;
}

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
  m_match->edits()->moveBall(place);
}

void RulesFold::loadFormation(bool left) {
  const FramePtr frame = m_match->frame();
  if (!frame) return;
  const FormationPlaces places =
      placesOf(static_cast<std::size_t>(m_formation->currentIndex()), *frame, left);
  std::vector<EditStep> steps;
  for (const auto& [id, pose] : places.robots) steps.push_back(placementStep(id, pose));
  steps.push_back(ballStep(places.ball));
  if (m_asSetPlay->isChecked() && frame->game && places.setPlay != SetPlay::None) {
    steps.push_back(refereeStep(m_match->edits(), {.kind = CallKind::SetPlay,
                                                   .team = frame->game->teamOf(places.attackers),
                                                   .setPlay = places.setPlay,
                                                   .place = places.ball}));
  }
  m_match->edits()->perform({QStringLiteral("formation: ") + m_formation->currentText(),
                             QStringLiteral("Could not load the formation"), std::move(steps)});
}

void RulesFold::show(const link::MatchFrame* shown, const QString& why) {
  const auto set = [&why](QWidget* control, const char* tip) {
    control->setEnabled(why.isEmpty());
    control->setToolTip(why.isEmpty() ? QString::fromUtf8(tip) : why);
  };
  const bool refereed = shown != nullptr && shown->game;
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
    const QString name = QString::fromStdString(shown->rules ? shown->rules->name : std::string());
    const int index = m_rules->findData(name.isEmpty() ? QStringLiteral("published") : name);
    if (index != m_rules->currentIndex()) m_rules->setCurrentIndex(index);
  }
  if (shown->rules) m_automatic->setChecked(shown->rules->automatic);
  QStringList off;
  for (const link::RobotFrame& robot : shown->robots) {
    if (robot.penalty && !robot.penalty->isSubstitute()) off << robotName(robot);
  }
  m_staysOff->setVisible(!off.isEmpty());
  m_staysOff->setText(off.size() == 1
                          ? QStringLiteral("%1 is penalised and stays off the field.").arg(off[0])
                          : QStringLiteral("%1 are penalised and stay off the field.")
                                .arg(off.join(QStringLiteral(", "))));
}

}  // namespace pitchboard::ui
