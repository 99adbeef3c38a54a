// SPDX-License-Identifier: GPL-3.0-or-later
// What packets say of the game: the codes of each league and version, and the reader.
#include <algorithm>

#include <telemetry/referee/gamecontroller.h>

#include "gamecontroller_layouts.h"

namespace pitchboard::telemetry {
namespace {

using Kind = PenaltyKind;
using Step = Restart::Step;

struct Code {
  int code;
  std::string_view name;  ///< as the controllers' sources call it
  PenaltyKind kind;
};

constexpr Code hl2013[] = {{0, "NONE", Kind::None},
                           {1, "HL_BALL_MANIPULATION", Kind::BallManipulation},
                           {2, "HL_PHYSICAL_CONTACT", Kind::Pushing},
                           {3, "HL_ILLEGAL_ATTACK", Kind::IllegalAttack},
                           {4, "HL_ILLEGAL_DEFENSE", Kind::IllegalDefence},
                           {5, "HL_PICKUP_OR_INCAPABLE", Kind::Incapable},
                           {6, "HL_SERVICE", Kind::Service},
                           {7, "HL_PICKUP_2_SERVICE", Kind::PickUpToService},
                           {14, "SUBSTITUTE", Kind::Substitute},
                           {15, "MANUAL", Kind::Manual}};
constexpr Code hl2017[] = {{0, "NONE", Kind::None},
                           {14, "SUBSTITUTE", Kind::Substitute},
                           {15, "MANUAL", Kind::Manual},
                           {30, "HL_BALL_MANIPULATION", Kind::BallManipulation},
                           {31, "HL_PHYSICAL_CONTACT", Kind::Pushing},
                           {32, "HL_ILLEGAL_ATTACK", Kind::IllegalAttack},
                           {33, "HL_ILLEGAL_DEFENSE", Kind::IllegalDefence},
                           {34, "HL_PICKUP_OR_INCAPABLE", Kind::Incapable},
                           {35, "HL_SERVICE", Kind::Service}};
constexpr Code spl2017[] = {{0, "NONE", Kind::None},
                            {1, "SPL_ILLEGAL_BALL_CONTACT", Kind::BallContact},
                            {2, "SPL_PLAYER_PUSHING", Kind::Pushing},
                            {3, "SPL_ILLEGAL_MOTION_IN_SET", Kind::MotionInSet},
                            {4, "SPL_INACTIVE_PLAYER", Kind::Inactive},
                            {5, "SPL_ILLEGAL_DEFENDER", Kind::IllegalDefender},
                            {6, "SPL_LEAVING_THE_FIELD", Kind::Leaving},
                            {7, "SPL_KICK_OFF_GOAL", Kind::KickOffGoal},
                            {8, "SPL_REQUEST_FOR_PICKUP", Kind::PickUp},
                            {9, "SPL_COACH_MOTION", Kind::CoachMotion},
                            {14, "SUBSTITUTE", Kind::Substitute},
                            {15, "MANUAL", Kind::Manual}};
constexpr Code spl2019[] = {{0, "NONE", Kind::None},
                            {1, "SPL_ILLEGAL_BALL_CONTACT", Kind::BallContact},
                            {2, "SPL_PLAYER_PUSHING", Kind::Pushing},
                            {3, "SPL_ILLEGAL_MOTION_IN_SET", Kind::MotionInSet},
                            {4, "SPL_INACTIVE_PLAYER", Kind::Inactive},
                            {5, "SPL_ILLEGAL_POSITION", Kind::IllegalPosition},
                            {6, "SPL_LEAVING_THE_FIELD", Kind::Leaving},
                            {7, "SPL_REQUEST_FOR_PICKUP", Kind::PickUp},
                            {8, "SPL_LOCAL_GAME_STUCK", Kind::LocalStuck},
                            {9, "SPL_ILLEGAL_POSITION_IN_SET", Kind::IllegalPositionInSet},
                            {10, "SPL_PLAYER_STANCE", Kind::Stance},
                            {11, "SPL_ILLEGAL_MOTION_IN_INITIAL", Kind::MotionInInitial},
                            {14, "SUBSTITUTE", Kind::Substitute},
                            {15, "MANUAL", Kind::Manual}};
constexpr Code hsl19[] = {{0, "NONE", Kind::None},
                          {1, "ILLEGAL_POSITIONING", Kind::IllegalPosition},
                          {2, "MOTION_IN_SET", Kind::MotionInSet},
                          {3, "LOCAL_GAME_STUCK", Kind::LocalStuck},
                          {4, "INCAPABLE_ROBOT", Kind::IncapableRobot},
                          {5, "PICK_UP", Kind::PickUp},
                          {6, "BALL_HOLDING", Kind::Holding},
                          {7, "LEAVING_THE_FIELD", Kind::Leaving},
                          {8, "PLAYING_WITH_ARMS_HANDS", Kind::Hands},
                          {9, "PLAYER_PUSHING", Kind::Pushing},
                          {10, "SENT_OFF", Kind::SentOff},
                          {11, "SUBSTITUTE", Kind::Substitute}};
constexpr Code hsl20[] = {{0, "NONE", Kind::None},
                          {1, "ILLEGAL_POSITIONING", Kind::IllegalPosition},
                          {2, "MOTION_IN_SET", Kind::MotionInSet},
                          {3, "MOTION_IN_STOP", Kind::MotionInStop},
                          {4, "LOCAL_GAME_STUCK", Kind::LocalStuck},
                          {5, "INCAPABLE_ROBOT", Kind::IncapableRobot},
                          {6, "PICK_UP", Kind::PickUp},
                          {7, "BALL_HOLDING", Kind::Holding},
                          {8, "LEAVING_THE_FIELD", Kind::Leaving},
                          {9, "PLAYING_WITH_ARMS_HANDS", Kind::Hands},
                          {10, "PLAYER_PUSHING", Kind::Pushing},
                          {11, "CAUTIONED", Kind::Cautioned},
                          {12, "SENT_OFF", Kind::SentOff},
                          {13, "SUBSTITUTE", Kind::Substitute}};

std::span<const Code> codesOf(const RefereeState& packet) {
  const RefereeLayout* layout =
      refereeLayout(packet.version, static_cast<std::size_t>(std::max(packet.size, 0)));
  switch (layout == nullptr ? PenaltyCodes::Hl2017 : layout->penalties) {
    case PenaltyCodes::Hl2013:
      return hl2013;
    case PenaltyCodes::Hl2017:
      return hl2017;
    case PenaltyCodes::Spl2017:
      return spl2017;
    case PenaltyCodes::Spl2019:
      return spl2019;
    case PenaltyCodes::Hsl19:
      return hsl19;
    case PenaltyCodes::Hsl20:
      return hsl20;
  }
  return hl2017;
}

/// What to send instead, in this order, in versions without the penalty.
struct Nearest {
  PenaltyKind kind;
  std::array<PenaltyKind, 2> instead;
};
constexpr Nearest nearest[] = {
    {Kind::BallManipulation, {Kind::BallContact, Kind::Hands}},
    {Kind::IllegalAttack, {Kind::IllegalPosition, Kind::IllegalDefender}},
    {Kind::IllegalDefence, {Kind::IllegalPosition, Kind::IllegalDefender}},
    {Kind::Incapable, {Kind::Inactive, Kind::IncapableRobot}},
    {Kind::Service, {Kind::PickUp, Kind::PickUp}},
    {Kind::IllegalPosition, {Kind::IllegalDefence, Kind::IllegalDefender}},
    {Kind::MotionInSet, {Kind::Incapable, Kind::Incapable}},
    {Kind::MotionInStop, {Kind::MotionInSet, Kind::Incapable}},
    {Kind::LocalStuck, {Kind::Incapable, Kind::Inactive}},
    {Kind::Holding, {Kind::BallManipulation, Kind::BallContact}},
    {Kind::Leaving, {Kind::Incapable, Kind::Incapable}},
    {Kind::Hands, {Kind::BallManipulation, Kind::BallContact}},
    {Kind::Cautioned, {Kind::Manual, Kind::Pushing}},
    {Kind::SentOff, {Kind::Manual, Kind::Manual}},
    {Kind::Manual, {Kind::PickUp, Kind::PickUp}},
};

struct SetPlayRow {
  SetPlay play;
  int humanoid, standard, soccer;  ///< 0: this league does not tell it
};
// Reading takes the first row with the code.
constexpr SetPlayRow setPlays[] = {
    {SetPlay::PushingFreeKick, 0, 2, 0}, {SetPlay::KickIn, 0, 4, 0},
    {SetPlay::DirectFreeKick, 4, 2, 1},  {SetPlay::IndirectFreeKick, 5, 2, 2},
    {SetPlay::PenaltyKick, 6, 5, 3},     {SetPlay::ThrowIn, 9, 4, 4},
    {SetPlay::GoalKick, 8, 1, 5},        {SetPlay::CornerKick, 7, 3, 6},
};
constexpr int firstOfSetPlays = 4;       // of secState; what is below are phases
constexpr int sizeWithThreeSteps = 688;  // until 2018 there were two, counted the other way

int codeOf(const SetPlayRow& row, League league) {
  return league == League::HumanoidSoccer     ? row.soccer
         : league == League::StandardPlatform ? row.standard
                                              : row.humanoid;
}

/// In the order of the codes.
constexpr TeamColor colours[] = {
    TeamColor::Blue,  TeamColor::Red,    TeamColor::Yellow, TeamColor::Black, TeamColor::White,
    TeamColor::Green, TeamColor::Orange, TeamColor::Purple, TeamColor::Brown, TeamColor::Gray};

GamePhase phaseOf(const RefereeState& packet) {
  // The Humanoid League has set plays in the same field, which hide the phase.
  const int code = packet.gamePhase.value_or(
      packet.secState.value_or(0) < firstOfSetPlays ? packet.secState.value_or(0) : 0);
  const bool known = code >= 0 && code <= static_cast<int>(lastOf(GamePhase{}));
  return known ? static_cast<GamePhase>(code) : GamePhase::Unknown;
}

SetPlay setPlayOf(const RefereeState& packet) {
  const bool humanoid = packet.league == League::Humanoid;
  const int code = packet.setPlay.value_or(humanoid ? packet.secState.value_or(0) : 0);
  if (code == 0 || (humanoid && code < firstOfSetPlays)) return SetPlay::None;
  for (const SetPlayRow& row : setPlays) {
    if (codeOf(row, packet.league) == code) return row.play;
  }
  return SetPlay::Unknown;
}

/// How the ball comes into play: who has it, and how far it is.
Restart restartOf(const RefereeState& packet, const Game& game) {
  Restart out;
  out.kind = setPlayOf(packet);
  if (out.kind == SetPlay::None) {
    // Only who has the kick-off may play it until the time is over.
    if (game.state != PlayState::Playing || game.countdown.ticks == 0) return out;
    out.step = Step::Executed;
    out.team = game.kickOff;
    return out;
  }
  out.step = game.stopped ? Step::Placing : Step::Taking;
  out.team = game.kickOff;
  if (packet.league == League::Humanoid && packet.secStateInfo) {
    const auto& [team, step, third, fourth] = *packet.secStateInfo;
    out.team = game.teamNumbered(team);
    if (packet.size >= sizeWithThreeSteps) {
      out.step = step == 0 ? Step::Placing : step == 1 ? Step::Preparing : Step::Taking;
    } else {
      out.step = step == 1 ? Step::Placing : Step::Preparing;
    }
  }
  return out;
}

GamePlayer playerOf(const RefereeState& packet, const RefereeTeam& team,
                    const RefereePlayer& sent) {
  GamePlayer out;
  out.penalty = penaltyOf(packet, sent.penalty);
  if (out.penalty != Kind::None && sent.red.value_or(0) > 0) out.penalty = Kind::SentOff;
  out.counting = out.penalty != Kind::None;
  out.ticksLeft = sent.secondsLeft;
  out.warnings = sent.warnings.value_or(0);
  out.yellow = sent.yellow.value_or(0);
  out.red = sent.red.value_or(0);
  out.cautions = sent.cautions.value_or(0);
  out.goalkeeper = sent.goalkeeper.value_or(0) != 0 || team.goalkeeper == sent.number;
  return out;
}

GameTeam teamOf(const RefereeState& packet, const RefereeTeam& sent) {
  GameTeam out;
  out.number = sent.number;
  out.colour = colourOf(sent.colour);
  out.score = sent.score;
  out.penaltyShots = sent.penaltyShot.value_or(0);
  out.singleShots = sent.singleShots.value_or(0);
  out.messageBudget = sent.messageBudget;
  for (const RefereePlayer& player : sent.players()) {
    const auto slot = static_cast<std::size_t>(player.number - 1);
    out.players[slot] = playerOf(packet, sent, player);
    out.shirts[slot] = player.unreliable ? 0 : player.number;
  }
  return out;
}

}  // namespace

Game gameOf(const RefereeState& packet) {
  Game game;
  game.league = packet.league;
  for (std::size_t i = 0; i < 2; ++i) game.teams[i] = teamOf(packet, packet.teams[i]);
  game.state = playStateOf(packet.state);
  game.phase = phaseOf(packet);
  game.half = packet.firstHalf != 0 ? 1 : 2;
  game.kickOff = game.teamNumbered(packet.kickOffTeam);
  game.stopped = packet.stopped.value_or(0) != 0;
  game.clock = packet.secsRemaining;
  game.countdown.ticks = packet.secondaryTime.value_or(0);
  game.countdown.runs = game.countdown.ticks > 0;
  game.restart = restartOf(packet, game);
  return game;
}

PlayState playStateOf(int code) {
  const bool known = code >= 0 && code < static_cast<int>(PlayState::Unknown);
  return known ? static_cast<PlayState>(code) : PlayState::Unknown;
}

TeamColor colourOf(int code) {
  return code >= 0 && static_cast<std::size_t>(code) < std::size(colours)
             ? colours[static_cast<std::size_t>(code)]
             : TeamColor::Unknown;
}

int colourCode(TeamColor colour) {
  const auto* const found = std::ranges::find(colours, colour);
  return found == std::end(colours) ? 0 : static_cast<int>(found - std::begin(colours));
}

PenaltyKind penaltyOf(const RefereeState& packet, int code) {
  const auto codes = codesOf(packet);
  const auto found = std::ranges::find(codes, code, &Code::code);
  return found == codes.end() ? Kind::Unknown : found->kind;
}

int penaltyCode(const RefereeState& packet, PenaltyKind penalty) {
  const auto codes = codesOf(packet);
  const auto find = [&codes](PenaltyKind kind) {
    return std::ranges::find(codes, kind, &Code::kind);
  };
  auto found = find(penalty);
  const auto* const row = std::ranges::find(nearest, penalty, &Nearest::kind);
  for (std::size_t i = 0; found == codes.end() && row != std::end(nearest) && i < 2; ++i) {
    found = find(row->instead[i]);
  }
  return found == codes.end() ? 0 : found->code;
}

int setPlayCode(const RefereeState& packet, SetPlay play) {
  constexpr int firstHumanoid = 11, without = 10;  // versions
  const bool humanoid = packet.league == League::Humanoid;
  if (humanoid ? packet.version < firstHumanoid : packet.version == without) return 0;
  const auto* const row = std::ranges::find(setPlays, play, &SetPlayRow::play);
  if (row == std::end(setPlays)) return 0;
  const int code = codeOf(*row, packet.league);
  // Corner kick and what follows came in 2021.
  constexpr int lastOf2018 = 6;
  return humanoid && packet.size != sizeWithThreeSteps && code > lastOf2018 ? 0 : code;
}

std::string_view penaltyName(const RefereeState& packet, int code) {
  const auto codes = codesOf(packet);
  const auto found = std::ranges::find(codes, code, &Code::code);
  return found == codes.end() ? "UNKNOWN" : found->name;
}

}  // namespace pitchboard::telemetry
