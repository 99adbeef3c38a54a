// SPDX-License-Identifier: GPL-3.0-or-later
#include <simcore/rules/check_call.h>

#include <algorithm>
#include <bit>
#include <string>

#include <base/random.h>

namespace pitchboard::sim {
namespace {

using Allowed = Result<void>;

constexpr int countedShots = 15;  // bits of GameTeam::singleShots

int shotsScored(const Game& game, std::size_t team) {
  return std::popcount(static_cast<unsigned>(game.teams[team].singleShots));
}

tl::unexpected<Error> refused(const std::string& text) {
  return failure(ErrorCode::Conflict, text);
}

/// Which states may follow which: every other change is refused.
Allowed checkState(const Game& game, const RefereeRules& rules, PlayState state) {
  const PlayState from = game.state;
  const bool shootOut = game.phase == GamePhase::ShootOut;
  const bool possible = [&] {
    switch (state) {
      case PlayState::Initial:
        return from == PlayState::Finished;
      case PlayState::Ready:
        return (from == PlayState::Initial || from == PlayState::Playing) && !shootOut;
      case PlayState::Set:
        return from == PlayState::Ready ||
               (shootOut && (from == PlayState::Initial || from == PlayState::Finished));
      case PlayState::Playing:
        return from == PlayState::Set;
      case PlayState::Finished:
        return from != PlayState::Initial && from != PlayState::Finished;
      case PlayState::Standby:
      case PlayState::Unknown:
        return false;
    }
    return false;
  }();
  if (!possible) {
    return refused("The referee cannot go from " + std::string(labelOf(from)) + " to " +
                   std::string(labelOf(state)) + ".");
  }
  if (state == PlayState::Set && from != PlayState::Ready && shootOutDecided(game, rules)) {
    return refused("The shoot-out is decided.");
  }
  return {};
}

Allowed checkTimeout(const Game& game, int team) {
  if (game.state == PlayState::Finished || game.phase == GamePhase::Timeout ||
      (team >= 0 && game.state == PlayState::Playing)) {
    return refused("A timeout is possible only in INITIAL, READY or SET.");
  }
  if (game.phase == GamePhase::ShootOut && game.state != PlayState::Initial) {
    return refused("In a shoot-out, a timeout is possible only before the first shot.");
  }
  if (team >= 0 && game.teams[static_cast<std::size_t>(team)].timeouts > 0) {
    return refused("This team has already taken its timeout in this half.");
  }
  return {};
}

}  // namespace

Result<void> checkCall(const Game& game, const RefereeRules& rules,
                       std::span<const RobotIdentity> robots, const RefereeCall& call) {
  const bool needsTeam = call.kind == CallKind::Goal || call.kind == CallKind::SetPlay;
  if (call.team < Game::noTeam || call.team > 1 || (needsTeam && call.team < 0)) {
    return failure(ErrorCode::InvalidArgument, "This call needs one of the two teams.");
  }
  const auto robot = std::ranges::find(robots, call.robot, &RobotIdentity::id);
  const GamePlayer* player =
      robot == robots.end() ? nullptr : game.player(robot->team, robot->number);
  const bool needsRobot = call.kind == CallKind::Penalise || call.kind == CallKind::Pardon ||
                          call.kind == CallKind::Card;
  if (needsRobot && player == nullptr) {
    return failure(ErrorCode::NotFound,
                   "Robot " + std::to_string(call.robot.value) + " belongs to neither team.");
  }
  const bool playing = game.state == PlayState::Playing;
  const bool finished = game.state == PlayState::Finished;
  switch (call.kind) {
    case CallKind::State:
      return checkState(game, rules, call.state);
    case CallKind::Goal:
      if (call.value < 0) {
        if (game.teams[static_cast<std::size_t>(call.team)].score == 0) {
          return refused("This team has no goal to take back.");
        }
      } else if (!playing && !finished) {
        return refused("A goal counts only in PLAYING or FINISHED.");
      }
      return {};
    case CallKind::SetPlay:
      if (!playing || game.phase == GamePhase::Timeout) {
        return refused("Set plays are possible only in PLAYING.");
      }
      return {};
    case CallKind::NextStep:
      if (!game.restart.isAnnounced()) return refused("There is no set play to continue.");
      return {};
    case CallKind::DropBall:
      if (!playing) return refused("A drop ball is possible only in PLAYING.");
      return {};
    case CallKind::Penalise:
      if (call.penalty == PenaltyKind::None) return refused("Choose a reason for the penalty.");
      return {};
    case CallKind::Pardon:
      if (player->penalty == PenaltyKind::None) {
        return refused(robot->name() + " is not penalised.");
      }
      return {};
    case CallKind::NextHalf:
      if (!finished) return refused("The next half can start only after FINISHED.");
      return {};
    case CallKind::ShootOut:
      if (!finished) return refused("The shoot-out can start only after FINISHED.");
      return {};
    case CallKind::Timeout:
      return checkTimeout(game, call.team);
    case CallKind::Stop:
      if (game.stopped) return refused("Play is stopped already.");
      return {};
    case CallKind::GoOn:
      if (!game.stopped) return refused("Play is not stopped.");
      return {};
    case CallKind::KickOff:
    case CallKind::Card:
    case CallKind::Automatic:
      return {};
  }
  return {};
}

bool shootOutDecided(const Game& game, const RefereeRules& rules) {
  const int shots = rules.shots;
  const int taken0 = game.teams[0].penaltyShots, taken1 = game.teams[1].penaltyShots;
  const int lead = shotsScored(game, 0) - shotsScored(game, 1);
  if (taken0 < shots || taken1 < shots) {
    return lead > std::max(0, shots - taken1) || -lead > std::max(0, shots - taken0);
  }
  // As many each, and one is ahead or a coin decides. It is a draw after as many as bits count.
  const int suddenDeath = conductOf(rules.style).suddenDeathShots;
  const int last = suddenDeath > 0 ? std::min(countedShots, shots + suddenDeath) : countedShots;
  return taken0 == taken1 && (lead != 0 || taken0 >= last);
}

std::optional<int> tossWinner(const WorldState& world) {
  if (!world.game || !world.settings.referee) return {};
  const Game& game = *world.game;
  const RefereeRules& rules = *world.settings.referee;
  if (!game.over || game.phase != GamePhase::ShootOut || !shootOutDecided(game, rules) ||
      conductOf(rules.style).suddenDeathShots == 0 ||
      shotsScored(game, 0) != shotsScored(game, 1)) {
    return {};
  }
  return CounterRandom(world.settings.seed, 0, NoiseStream::Coin, 0).uniform() < 0.5 ? 0 : 1;
}

}  // namespace pitchboard::sim
