// SPDX-License-Identifier: GPL-3.0-or-later
#include "next_steps.h"

#include <simcore/rules/check_call.h>

namespace pitchboard::ui {
namespace {

using sim::CallKind;

NextStep toState(PlayState state, const char* text, const char* tip) {
  return {sim::RefereeCall{.kind = CallKind::State, .state = state}, QString::fromUtf8(text),
          QString::fromUtf8(tip)};
}

NextStep calling(CallKind kind, const char* text, const char* tip) {
  return {sim::RefereeCall{.kind = kind}, QString::fromUtf8(text), QString::fromUtf8(tip)};
}

NextStep skipToKickOff() {
  return {std::nullopt, QStringLiteral("Skip to kick-off"),
          QStringLiteral("Plays at full speed until kick-off"), true};
}

NextStep nextOfSetPlay(Restart::Step step) {
  using Step = Restart::Step;
  const bool placing = step == Step::Placing, preparing = step == Step::Preparing;
  return calling(CallKind::NextStep,
                 placing     ? "Next step: prepare"
                 : preparing ? "Next step: ready"
                             : "Next step: ball in play",
                 placing     ? "The ball is placed; the team that takes it may come"
                 : preparing ? "The ball may be kicked"
                             : "Anybody may play the ball");
}

std::vector<NextStep> afterTheEnd(const Game& game) {
  const bool shootOut = game.phase == GamePhase::ShootOut;
  if (shootOut && !game.over) {
    return {toState(PlayState::Set, "Next shot", "The next robot places itself")};
  }
  if (game.half == 1 && !game.over) {
    return {calling(CallKind::NextHalf, "Second half", "INITIAL; the teams change sides")};
  }
  std::vector<NextStep> steps;
  if (!shootOut) {
    steps.push_back(calling(CallKind::NextHalf,
                            game.phase == GamePhase::ExtraTime ? "Next half" : "Extra time",
                            "Two shorter halves"));
    steps.push_back(calling(CallKind::ShootOut, "Penalty shoot-out", "One robot against a keeper"));
  }
  steps.push_back({std::nullopt, QStringLiteral("Play again"),
                   QStringLiteral("Restarts the match. Undo brings this one back")});
  return steps;
}

}  // namespace

std::vector<NextStep> nextSteps(const Game& game, const sim::RefereeRules& rules) {
  const bool shootOut = game.phase == GamePhase::ShootOut;
  std::vector<NextStep> steps;
  if (game.stopped && game.state != PlayState::Finished) {
    return {calling(CallKind::GoOn, "Resume play", "Robots may play again")};
  }
  switch (game.state) {
    case PlayState::Initial:
      if (shootOut)
        steps.push_back(toState(PlayState::Set, "Next shot", "The next robot places itself"));
      else
        steps.push_back(toState(PlayState::Ready, "READY", "Robots walk to their places"));
      if (!shootOut && rules.automatic) steps.push_back(skipToKickOff());
      break;
    case PlayState::Ready:
      steps.push_back(toState(PlayState::Set, "SET", "Robots stand still"));
      if (rules.automatic) steps.push_back(skipToKickOff());
      break;
    case PlayState::Set:
      steps.push_back(toState(PlayState::Playing, "PLAYING", "Starts play"));
      break;
    case PlayState::Playing:
      if (game.restart.isAnnounced()) steps.push_back(nextOfSetPlay(game.restart.step));
      steps.push_back(calling(CallKind::Stop, "Stop", "Play is stopped"));
      if (!shootOut && !game.restart.isAnnounced()) {
        steps.push_back(
            calling(CallKind::DropBall, "Drop ball", "READY, no team has the kick-off"));
      }
      steps.push_back(shootOut ? toState(PlayState::Finished, "End shot", "No goal")
                               : toState(PlayState::Finished, "End half", "FINISHED"));
      break;
    case PlayState::Finished:
      steps = afterTheEnd(game);
      break;
    case PlayState::Standby:
    case PlayState::Unknown:
      break;
  }
  std::erase_if(steps, [&](const NextStep& step) {
    return step.call && !sim::checkCall(game, rules, {}, *step.call);
  });
  return steps;
}

QString teamText(const GameTeam& team) {
  const std::string_view name = info(team.colour).name;
  return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size())).toUpper();
}

}  // namespace pitchboard::ui
