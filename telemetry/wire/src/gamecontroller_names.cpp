// SPDX-License-Identifier: GPL-3.0-or-later
#include <telemetry/wire/gamecontroller.h>

#include <algorithm>

#include "gamecontroller_layouts.h"

namespace pitchboard::telemetry {
namespace {

struct Code {
  int code;
  std::string_view name;  ///< as the controllers' sources call it
  std::string_view text;  ///< for the screen
};

constexpr Code hl2013[] = {{0, "NONE", ""},
                           {1, "HL_BALL_MANIPULATION", "ball manipulation"},
                           {2, "HL_PHYSICAL_CONTACT", "pushing"},
                           {3, "HL_ILLEGAL_ATTACK", "illegal attack"},
                           {4, "HL_ILLEGAL_DEFENSE", "illegal defence"},
                           {5, "HL_PICKUP_OR_INCAPABLE", "pickup or incapable"},
                           {6, "HL_SERVICE", "service"},
                           {7, "HL_PICKUP_2_SERVICE", "pickup to service"},
                           {14, "SUBSTITUTE", "substitute"},
                           {15, "MANUAL", "manual penalty"}};
constexpr Code hl2017[] = {{0, "NONE", ""},
                           {14, "SUBSTITUTE", "substitute"},
                           {15, "MANUAL", "manual penalty"},
                           {30, "HL_BALL_MANIPULATION", "ball manipulation"},
                           {31, "HL_PHYSICAL_CONTACT", "pushing"},
                           {32, "HL_ILLEGAL_ATTACK", "illegal attack"},
                           {33, "HL_ILLEGAL_DEFENSE", "illegal defence"},
                           {34, "HL_PICKUP_OR_INCAPABLE", "pickup or incapable"},
                           {35, "HL_SERVICE", "service"}};
constexpr Code spl2017[] = {{0, "NONE", ""},
                            {1, "SPL_ILLEGAL_BALL_CONTACT", "ball contact"},
                            {2, "SPL_PLAYER_PUSHING", "pushing"},
                            {3, "SPL_ILLEGAL_MOTION_IN_SET", "motion in SET"},
                            {4, "SPL_INACTIVE_PLAYER", "inactive"},
                            {5, "SPL_ILLEGAL_DEFENDER", "illegal defender"},
                            {6, "SPL_LEAVING_THE_FIELD", "leaving the field"},
                            {7, "SPL_KICK_OFF_GOAL", "kick-off goal"},
                            {8, "SPL_REQUEST_FOR_PICKUP", "pickup"},
                            {9, "SPL_COACH_MOTION", "coach motion"},
                            {14, "SUBSTITUTE", "substitute"},
                            {15, "MANUAL", "manual penalty"}};
constexpr Code spl2019[] = {{0, "NONE", ""},
                            {1, "SPL_ILLEGAL_BALL_CONTACT", "ball contact"},
                            {2, "SPL_PLAYER_PUSHING", "pushing"},
                            {3, "SPL_ILLEGAL_MOTION_IN_SET", "motion in SET"},
                            {4, "SPL_INACTIVE_PLAYER", "inactive"},
                            {5, "SPL_ILLEGAL_POSITION", "illegal position"},
                            {6, "SPL_LEAVING_THE_FIELD", "leaving the field"},
                            {7, "SPL_REQUEST_FOR_PICKUP", "pickup"},
                            {8, "SPL_LOCAL_GAME_STUCK", "local game stuck"},
                            {9, "SPL_ILLEGAL_POSITION_IN_SET", "illegal position in SET"},
                            {10, "SPL_PLAYER_STANCE", "stance"},
                            {11, "SPL_ILLEGAL_MOTION_IN_INITIAL", "motion in INITIAL or STANDBY"},
                            {14, "SUBSTITUTE", "substitute"},
                            {15, "MANUAL", "manual penalty"}};
constexpr Code hsl19[] = {{0, "NONE", ""},
                          {1, "ILLEGAL_POSITIONING", "illegal position"},
                          {2, "MOTION_IN_SET", "motion in SET"},
                          {3, "LOCAL_GAME_STUCK", "local game stuck"},
                          {4, "INCAPABLE_ROBOT", "incapable"},
                          {5, "PICK_UP", "pickup"},
                          {6, "BALL_HOLDING", "ball holding"},
                          {7, "LEAVING_THE_FIELD", "leaving the field"},
                          {8, "PLAYING_WITH_ARMS_HANDS", "playing with the hands"},
                          {9, "PLAYER_PUSHING", "pushing"},
                          {10, "SENT_OFF", "sent off"},
                          {11, "SUBSTITUTE", "substitute"}};
constexpr Code hsl20[] = {{0, "NONE", ""},
                          {1, "ILLEGAL_POSITIONING", "illegal position"},
                          {2, "MOTION_IN_SET", "motion in SET"},
                          {3, "MOTION_IN_STOP", "motion while stopped"},
                          {4, "LOCAL_GAME_STUCK", "local game stuck"},
                          {5, "INCAPABLE_ROBOT", "incapable"},
                          {6, "PICK_UP", "pickup"},
                          {7, "BALL_HOLDING", "ball holding"},
                          {8, "LEAVING_THE_FIELD", "leaving the field"},
                          {9, "PLAYING_WITH_ARMS_HANDS", "playing with the hands"},
                          {10, "PLAYER_PUSHING", "pushing"},
                          {11, "CAUTIONED", "cautioned"},
                          {12, "SENT_OFF", "sent off"},
                          {13, "SUBSTITUTE", "substitute"}};

std::span<const Code> codesOf(const RefereeState& state) {
  const RefereeLayout* layout =
      refereeLayout(state.version, static_cast<std::size_t>(std::max(state.size, 0)));
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

const Code* find(std::span<const Code> codes, int code) {
  const auto found =
      std::find_if(codes.begin(), codes.end(), [code](const Code& c) { return c.code == code; });
  return found == codes.end() ? nullptr : &*found;
}

template <std::size_t N>
constexpr std::string_view pick(const std::string_view (&names)[N], int index,
                                std::string_view otherwise) {
  return index >= 0 && static_cast<std::size_t>(index) < N ? names[index] : otherwise;
}

}  // namespace

std::string_view stateName(int state) {
  static constexpr std::string_view names[] = {"INITIAL", "READY",    "SET",
                                               "PLAYING", "FINISHED", "STANDBY"};
  return pick(names, state, "UNKNOWN");
}

std::string_view secStateName(int secState) {
  static constexpr std::string_view names[] = {
      "NORMAL",      "PENALTYSHOOT", "OVERTIME",  "TIMEOUT", "DIRECT_FREEKICK", "INDIRECT_FREEKICK",
      "PENALTYKICK", "CORNER_KICK",  "GOAL_KICK", "THROW_IN"};
  return pick(names, secState, "UNKNOWN");
}

std::string_view gameTypeName(int gameType) {
  static constexpr std::string_view names[] = {"ROUNDROBIN", "PLAYOFF", "DROPIN"};
  return pick(names, gameType, "UNKNOWN");
}

std::string_view gamePhaseLabel(int gamePhase) {
  static constexpr std::string_view names[] = {"normal", "penalty shoot-out", "overtime",
                                               "timeout"};
  return pick(names, gamePhase, "unknown");
}

std::string_view setPlayName(League league, int setPlay) {
  static constexpr std::string_view spl[] = {"none",   "goal kick", "pushing free kick",
                                             "corner", "kick-in",   "penalty"};
  static constexpr std::string_view hsl[] = {"none",    "direct free kick", "indirect free kick",
                                             "penalty", "throw-in",         "goal kick",
                                             "corner"};
  return league == League::HumanoidSoccer ? pick(hsl, setPlay, "unknown")
                                          : pick(spl, setPlay, "unknown");
}

std::string_view setPlayLabel(League league, int setPlay) {
  static constexpr int firstOfHl = 4;  // of the secondary state; what is below are phases
  static constexpr std::string_view hl[] = {"direct free kick", "indirect free kick",
                                            "penalty kick",     "corner kick",
                                            "goal kick",        "throw-in"};
  if (league == League::Humanoid) {
    return setPlay < firstOfHl ? gamePhaseLabel(setPlay) : pick(hl, setPlay - firstOfHl, "unknown");
  }
  const std::string_view name = setPlayName(league, setPlay);
  return name == "corner" ? "corner kick" : name == "penalty" ? "penalty kick" : name;
}

std::string_view colourLabel(int colour) {
  static constexpr std::string_view names[] = {"blue",  "red",    "yellow", "black", "white",
                                               "green", "orange", "purple", "brown", "gray"};
  return pick(names, colour, "unknown");
}

std::string_view penaltyName(const RefereeState& state, int penalty) {
  const Code* code = find(codesOf(state), penalty);
  return code == nullptr ? "UNKNOWN" : code->name;
}

std::string_view penaltyLabel(const RefereeState& state, const RefereePlayer& player) {
  if (player.penalty != 0 && player.red.value_or(0) > 0) return "sent off";
  const Code* code = find(codesOf(state), player.penalty);
  return code == nullptr ? "unknown penalty" : code->text;
}

bool isSubstitute(const RefereeState& state, const RefereePlayer& player) {
  return penaltyName(state, player.penalty) == "SUBSTITUTE";
}

}  // namespace pitchboard::telemetry
