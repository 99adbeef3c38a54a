// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The one table of the numbers of behaviours that a team tunes: from where they kick, how well they
// aim, how they search, where a keeper stands. Scenario files, experiments, the command line and
// docs/behaviours.md are made from it. In memory metres, radians, seconds; people write degrees.
// Any thread.

#include <array>
#include <span>
#include <string>
#include <string_view>

#include <base/lined_json.h>
#include <simcore/world/parameters.h>

namespace pitchboard::link {

struct BehaviourParameters {
  // With the ball.
  double kickDistance = 0.025;
  double kickBearing = 0.42 - 0.04;  // the published kick's sector reaches 30 degrees
  double behindBall = 0.14;
  double attackDistance = 0.26;
  double slowWithin = 0.12;
  double aimLeast = 0.12;
  double aimMost = 0.35;
  double aimFar = 0.30;
  double aimPressed = 0.7;
  double pressedWithin = 0.6;
  // Without it.
  double headTime = 4.5;
  double turnTime = 6.0;
  double placeTime = 22.0;
  double ballMemory = 8.0;
  double patience = 4.0;
  double opponentMemory = 3.0;
  // With team-mates.
  double leavesAfter = 0.5;  // s
  double takesAfter = 1.0;
  double passGain = 0.35;
  double passLane = 0.5;
  double atBallTime = 6.0;
  // Before the own goal.
  double keeperLine = 0.2;
  double keeperArc = 0.40;
  double clearWithin = 1.3;
  double clearUntil = 1.9;
  double clearDanger = 2.0;
  double keeperOut = 2.5;

  double distanceToKick = 25.0;  ///< cm; 25 in simulation, 40 on the published real robot

  bool operator==(const BehaviourParameters&) const = default;
};

struct BehaviourParameter : sim::Parameter<BehaviourParameters> {
  std::array<std::string_view, 3> of;  ///< behaviours that read it
  bool isOf(std::string_view behaviour) const;
};

namespace behaviour_sets {
inline constexpr std::array<std::string_view, 3> players{"striker", "supporter", "keeper"};
inline constexpr std::array<std::string_view, 3> field{"striker", "supporter"};
inline constexpr std::array<std::string_view, 3> keeper{"keeper"};
inline constexpr std::array<std::string_view, 3> naive{"naive"};
}  // namespace behaviour_sets

// clang-format off
inline constexpr auto behaviourParameters = std::to_array<BehaviourParameter>({
    {{"kick_distance", &BehaviourParameters::kickDistance, sim::units::metres, 0, 1,
      "Kick distance", "Kicks a ball that is nearer than this to its body; with a foot at least up to 6 cm inside its reach"}, behaviour_sets::players},
    {{"kick_bearing", &BehaviourParameters::kickBearing, sim::units::degrees, 0, 90,
      "Kick bearing", "Sidles until the ball is no farther from the heading"}, behaviour_sets::players},
    {{"behind_ball", &BehaviourParameters::behindBall, sim::units::metres, 0, 2,
      "Behind the ball", "From the body to the ball where an attack begins"}, behaviour_sets::players},
    {{"attack_distance", &BehaviourParameters::attackDistance, sim::units::metres, 0, 2,
      "Attack distance", "From the body to the ball: nearer it turns round the ball instead of walking a path behind it"}, behaviour_sets::players},
    {{"slow_within", &BehaviourParameters::slowWithin, sim::units::metres, 0, 2,
      "Slow within", "From the body to the ball: nearer it walks up to it slowly"}, behaviour_sets::players},
    {{"aim_least", &BehaviourParameters::aimLeast, sim::units::degrees, 0, 180,
      "Aim, least", "Off the aim that is good enough, however small the goal looks"}, behaviour_sets::players},
    {{"aim_most", &BehaviourParameters::aimMost, sim::units::degrees, 0, 180,
      "Aim, most", "Off the aim that is too much, however near the goal is"}, behaviour_sets::players},
    {{"aim_far", &BehaviourParameters::aimFar, sim::units::degrees, 0, 180,
      "Aim, far", "Off the aim that is good enough farther from the goal than 3 m and than its kick rolls"}, behaviour_sets::players},
    {{"aim_pressed", &BehaviourParameters::aimPressed, sim::units::degrees, 0, 180,
      "Aim, pressed", "Off the aim that is good enough while an opponent is at the ball"}, behaviour_sets::players},
    {{"pressed_within", &BehaviourParameters::pressedWithin, sim::units::metres, 0, 10,
      "Pressed within", "From an opponent to the ball"}, behaviour_sets::players},
    {{"head_time", &BehaviourParameters::headTime, sim::units::seconds, 0, 600,
      "Head search", "Looks for a lost ball with the head alone; a sweep takes 4.5 s"}, behaviour_sets::players},
    {{"turn_time", &BehaviourParameters::turnTime, sim::units::seconds, 0, 600,
      "Turn search", "Then turns for so long before it walks"}, behaviour_sets::players},
    {{"place_time", &BehaviourParameters::placeTime, sim::units::seconds, 1, 600,
      "Place search", "On the way to one place of the search, at most"}, behaviour_sets::players},
    {{"ball_memory", &BehaviourParameters::ballMemory, sim::units::seconds, 0, 600,
      "Ball memory", "Goes on to where it saw the ball"}, behaviour_sets::players},
    {{"patience", &BehaviourParameters::patience, sim::units::seconds, 0, 600,
      "Patience", "At a place where no ball is, before it searches"}, behaviour_sets::players},
    {{"opponent_memory", &BehaviourParameters::opponentMemory, sim::units::seconds, 0, 600,
      "Opponent memory", "Keeps an opponent in mind that it does not see"}, behaviour_sets::players},
    {{"leaves_after", &BehaviourParameters::leavesAfter, sim::units::seconds, 0, 60,
      "Leaves the ball", "To a team-mate that goes for it and is there sooner by more than this"}, behaviour_sets::field},
    {{"takes_after", &BehaviourParameters::takesAfter, sim::units::seconds, 0, 60,
      "Takes the ball", "From a team-mate that goes for it, when it is there sooner by more than this"}, behaviour_sets::field},
    {{"pass_gain", &BehaviourParameters::passGain, sim::units::plain, 0, 2,
      "Worth of a pass", "A ball that a team-mate has first; a sure goal is worth 1, a metre forward 0.08"}, behaviour_sets::players},
    {{"pass_lane", &BehaviourParameters::passLane, sim::units::metres, 0, 5,
      "Lane of a pass", "Beside the way of the ball, without an opponent"}, behaviour_sets::players},
    {{"at_ball_time", &BehaviourParameters::atBallTime, sim::units::seconds, 1, 600,
      "At the ball, at most", "While the ball does not get away it aims less and less well; after so long it takes almost any kick"}, behaviour_sets::players},
    {{"keeper_line", &BehaviourParameters::keeperLine, sim::units::metres, 0, 10,
      "Keeper's line", "Before the goal line, at the posts; farther out before the middle"}, behaviour_sets::keeper},
    {{"keeper_arc", &BehaviourParameters::keeperArc, sim::units::plain, 0, 2,
      "Keeper's arc", "Its radius, share of the goal's width"}, behaviour_sets::keeper},
    {{"clear_within", &BehaviourParameters::clearWithin, sim::units::metres, 0, 20,
      "Clears within", "Goes for a ball so near to the goal's centre"}, behaviour_sets::keeper},
    {{"clear_until", &BehaviourParameters::clearUntil, sim::units::metres, 0, 20,
      "Clears until", "Then follows it so far; at least as far as it begins"}, behaviour_sets::keeper},
    {{"clear_danger", &BehaviourParameters::clearDanger, sim::units::metres, 0, 20,
      "Danger", "A ball so near to the own goal is kicked away when an opponent is near"}, behaviour_sets::players},
    {{"keeper_out", &BehaviourParameters::keeperOut, sim::units::metres, 0, 20,
      "Comes out", "To a ball so near to the goal's centre that nobody reaches sooner"}, behaviour_sets::keeper},
    {{"distance_to_kick", &BehaviourParameters::distanceToKick, sim::Unit{"centimetres", "cm"}, 0, 10000,
      "Distance to kick", "As published: kicks a ball that it sees nearer; 25 in simulation, 40 on the real robot"}, behaviour_sets::naive},
});
// clang-format on

/// A behaviour and its numbers, as files and the command line have it.
struct BehaviourChoice {
  std::string name = "striker";
  BehaviourParameters parameters;
  bool operator==(const BehaviourChoice&) const = default;
};

/// The value of `key`: a name of `known`, or an object {"name": ..., "kick_distance": ...} with
/// numbers that this behaviour has. What is left out is a striker with the usual numbers.
BehaviourChoice readBehaviour(const JsonObject& parent, JsonReport& report, std::string_view key,
                              std::span<const std::string_view> known);
/// The same of a command line: a name of behaviours(), or such an object.
Result<BehaviourChoice> behaviourFromText(std::string_view nameOrJson, std::string_view source);
/// The name alone where nothing differs. Reading it gives exactly these numbers, as far as the
/// behaviour reads them.
std::string behaviourToText(std::string_view name, const BehaviourParameters& parameters);

/// Refuses a number that is not finite or out of its range: InvalidArgument, with the key as the
/// context ("behaviour.kick_distance").
Result<void> validate(const BehaviourParameters& parameters);

}  // namespace pitchboard::link
