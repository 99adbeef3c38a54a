// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/referee_calls.h>

#include <QMenu>
#include <memory>
#include <utility>

#include <base/try.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <simcore/rules/check_call.h>
#include <ui/base/action_reason.h>
#include <ui/base/robot_text.h>
#include <ui/sources/match_controller.h>

namespace pitchboard::ui {
namespace {

/// What the decision changed; filled and read on the match's thread.
struct BeforeDecision {
  std::optional<sim::RefereeRules> rules;
  std::optional<Game> game;
  sim::RefereeMemory memory;
  sim::Score score;
  bool clockRunning = false;
  std::uint64_t clockTicks = 0;
  std::vector<sim::RobotIdentity> identities;  // they tell the sides
  std::optional<Point> ball;
  Velocity ballVelocity;
  std::vector<std::pair<RobotId, Pose>> moved;

  void take(const sim::WorldState& state) {
    *this = {};
    rules = state.settings.referee;
    game = state.game;
    memory = state.refereeMemory;
    score = state.score;
    clockRunning = state.clockRunning;
    clockTicks = state.clockTicks;
    identities = state.robots;
  }

  void putBack(sim::Simulation& simulation) const {
    sim::WorldState& state = simulation.editState();
    state.settings.referee = rules;
    state.game = game;
    state.refereeMemory = memory;
    state.score = score;
    state.clockRunning = clockRunning;
    state.clockTicks = clockTicks;
    for (sim::RobotIdentity& robot : state.robots) {
      for (const sim::RobotIdentity& known : identities) {
        if (known.id == robot.id) robot.imuStartsAt180 = known.imuStartsAt180;
      }
    }
    if (ball) (void)simulation.placeBall(*ball, ballVelocity);
    for (const auto& [robot, pose] : moved) (void)simulation.placeRobot(robot, pose);
  }
};

/// `decide` is carried out on the match's thread; undone, what follows from `cause` has not
/// happened.
template <class Decide>
EditStep decisionStep(std::uint32_t cause, Decide decide) {
  const auto before = std::make_shared<BeforeDecision>();
  return {[decide, before](link::SimulatedMatch& match) -> Result<void> {
            const sim::Simulation& simulation = match.simulation();
            const sim::Snapshot then = simulation.snapshot();
            before->take(simulation.state());
            if (auto decided = decide(match); !decided) return decided;
            const sim::Snapshot now = simulation.snapshot();
            if (now.ball != then.ball) {
              before->ball = then.ball;
              before->ballVelocity = then.ballVelocity;
            }
            for (std::size_t i = 0; i < now.robots.size(); ++i) {
              if (now.robots[i].pose == then.robots[i].pose) continue;
              before->moved.emplace_back(then.robots[i].identity.id, then.robots[i].pose);
            }
            return {};
          },
          [cause, before](link::SimulatedMatch& match) -> Result<void> {
            before->putBack(match.simulation());
            match.simulation().reportUndone(cause);
            return {};
          }};
}

const QString& notCarriedOut() {
  static const QString text = QStringLiteral("Could not make the referee call");
  return text;
}

}  // namespace

EditStep refereeStep(MatchEdits* edits, sim::RefereeCall call) {
  if (call.cause == 0) call.cause = edits->newCause();
  return decisionStep(
      call.cause, [call](link::SimulatedMatch& match) { return match.simulation().call(call); });
}

void callReferee(MatchEdits* edits, const sim::RefereeCall& call, const QString& text) {
  edits->perform({text, notCarriedOut(), {refereeStep(edits, call)}});
}

void callReferee(MatchEdits* edits, sim::RefereeCall call, const std::vector<RobotId>& robots,
                 const QString& text) {
  if (robots.empty()) return;
  call.cause = edits->newCause();
  std::vector<EditStep> steps;
  for (const RobotId robot : robots) {
    call.robot = robot;
    steps.push_back(refereeStep(edits, call));
  }
  edits->perform({text, notCarriedOut(), std::move(steps)});
}

void chooseReferee(MatchEdits* edits, const std::string& ruleSet, const QString& title) {
  const std::uint32_t cause = edits->newCause();
  const auto choose = [ruleSet, cause](link::SimulatedMatch& match) -> Result<void> {
    const auto rules = TRY(link::refereeRuleSet(ruleSet));
    TRY(match.simulation().setReferee(rules));
    match.simulation().reportChanged(sim::Setting::Rules, cause);
    return {};
  };
  edits->perform({QStringLiteral("rules: ") + title,
                  QStringLiteral("Could not change the rules"),
                  {decisionStep(cause, choose)}});
}

QString whyRefused(const link::MatchFrame* frame, const sim::RefereeCall& call) {
  if (frame == nullptr || !frame->rules) {
    return QStringLiteral("This match has no referee. Choose rules to get one.");
  }
  std::vector<sim::RobotIdentity> robots;
  for (const link::RobotFrame& robot : frame->robots) robots.push_back(robot.identity);
  const auto checked = sim::checkCall(*frame->game, *frame->rules, robots, call);
  return checked ? QString() : QString::fromStdString(checked.error().message);
}

namespace {

using sim::CallKind;

/// Grey with the reason while it would be refused.
QAction* addCall(QMenu* menu, MatchController* match, const QString& text,
                 const sim::RefereeCall& call, const std::vector<RobotId>& robots) {
  QAction* action = menu->addAction(text, match, [match, call, robots, text] {
    if (robots.empty())
      callReferee(match->edits(), call, text);
    else
      callReferee(match->edits(), call, robots, text);
  });
  sim::RefereeCall first = call;
  if (!robots.empty()) first.robot = robots.front();
  const QString why = match->edits()->isLocked() ? MatchEdits::lockedText()
                                                 : whyRefused(match->frame().get(), first);
  enableUnless(*action, why);
  return action;
}

}  // namespace

void addRefereeMenu(QMenu* menu, MatchController* match, const std::vector<RobotId>& robots) {
  const FramePtr frame = match->frame();
  if (robots.empty() || !frame || !frame->rules) return;
  QMenu* own = menu->addMenu(QStringLiteral("Referee"));
  own->setObjectName(QStringLiteral("refereeMenu"));
  QMenu* penalise = own->addMenu(QStringLiteral("Penalise"));
  penalise->setObjectName(QStringLiteral("refereePenalise"));
  for (int i = 1; i <= static_cast<int>(lastOf(PenaltyKind{})); ++i) {
    const auto kind = static_cast<PenaltyKind>(i);
    if (kind == PenaltyKind::SentOff) continue;  // the red card
    addCall(penalise, match,
            kind == PenaltyKind::Substitute ? QStringLiteral("Take off as a substitute")
                                            : capitalised(labelOf(kind)),
            {.kind = CallKind::Penalise, .penalty = kind}, robots);
  }
  addCall(own, match, QStringLiteral("Pardon"), {.kind = CallKind::Pardon}, robots)
      ->setObjectName(QStringLiteral("refereePardon"));
  QMenu* cards = own->addMenu(QStringLiteral("Card"));
  cards->setObjectName(QStringLiteral("refereeCard"));
  const char* const names[] = {"Warning", "Yellow card", "Red card"};
  for (int value = 0; value < 3; ++value) {
    addCall(cards, match, QString::fromUtf8(names[value]), {.kind = CallKind::Card, .value = value},
            robots);
  }
}

void addRefereeGround(QMenu* menu, MatchController* match, Point place) {
  const FramePtr frame = match->frame();
  if (!frame || !frame->rules) return;
  QMenu* own = menu->addMenu(QStringLiteral("Referee"));
  own->setObjectName(QStringLiteral("refereeMenu"));
  for (int team = 0; team < 2; ++team) {
    const auto& playing = frame->game->teams[static_cast<std::size_t>(team)];
    const QString colour = capitalised(info(playing.colour).name).toUpper();
    addCall(own, match, QStringLiteral("Goal for %1").arg(colour),
            {.kind = CallKind::Goal, .team = team, .value = 1}, {})
        ->setObjectName(QStringLiteral("refereeGoal%1").arg(team));
  }
  QMenu* ball = own->addMenu(QStringLiteral("Place the ball"));
  ball->setObjectName(QStringLiteral("refereeBall"));
  const sim::FieldSpec& field = frame->settings->field;
  const double mark = field.halfLength() - field.penaltyMarkDistance;
  const std::pair<const char*, Point> places[] = {{"Here", place},
                                                  {"Centre mark", {0, 0}},
                                                  {"Left penalty mark", {-mark, 0}},
                                                  {"Right penalty mark", {mark, 0}}};
  for (const auto& [name, where] : places) {
    QAction* action = ball->addAction(QString::fromUtf8(name), match,
                                      [match, where = where] { match->edits()->moveBall(where); });
    enableUnless(*action, match->edits()->isLocked() ? MatchEdits::lockedText() : QString());
  }
}

}  // namespace pitchboard::ui
