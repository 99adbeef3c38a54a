// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The parameters of behaviours that a team can tune: from where robots kick, how precisely they
// aim, how they search, where a keeper stands. Scenario files, experiments, the command line and
// the table of docs/behaviours.md all use the table below, which describes each parameter. Metres,
// radians and seconds in memory; degrees in files. Plain values; any thread.

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
  double aimSide = 0.0;
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
  double keeperAside = 0.0;
  double clearWithin = 1.3;
  double clearUntil = 1.9;
  double clearDanger = 2.0;
  double keeperOut = 2.5;

  double distanceToKick = 25.0;  ///< cm; 25 in simulation, 40 on the published real robot

  bool operator==(const BehaviourParameters&) const = default;
};

struct BehaviourParameter : sim::Parameter<BehaviourParameters> {
  std::array<std::string_view, 3> of;  ///< the behaviours that use it
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
      "Kick distance", "Kicks the ball if it is closer than this to the body (models with a foot: at least up to 6 cm inside their reach)"}, behaviour_sets::players},
    {{"kick_bearing", &BehaviourParameters::kickBearing, sim::units::degrees, 0, 90,
      "Kick bearing", "Steps sideways until the ball is within this angle of the heading"}, behaviour_sets::players},
    {{"behind_ball", &BehaviourParameters::behindBall, sim::units::metres, 0, 2,
      "Behind the ball", "Distance from the body to the ball at which an attack begins"}, behaviour_sets::players},
    {{"attack_distance", &BehaviourParameters::attackDistance, sim::units::metres, 0, 2,
      "Attack distance", "Closer to the ball than this, it turns around the ball instead of walking a path behind it"}, behaviour_sets::players},
    {{"slow_within", &BehaviourParameters::slowWithin, sim::units::metres, 0, 2,
      "Slow within", "Closer to the ball than this, it walks slowly"}, behaviour_sets::players},
    {{"aim_least", &BehaviourParameters::aimLeast, sim::units::degrees, 0, 180,
      "Aiming error, smallest", "Smallest accepted aiming error, however small the goal looks"}, behaviour_sets::players},
    {{"aim_most", &BehaviourParameters::aimMost, sim::units::degrees, 0, 180,
      "Aiming error, largest", "Largest accepted aiming error, however close the goal is"}, behaviour_sets::players},
    {{"aim_far", &BehaviourParameters::aimFar, sim::units::degrees, 0, 180,
      "Aiming error, far", "Accepted aiming error more than 3 m from the goal, if its kick does not roll that far"}, behaviour_sets::players},
    {{"aim_pressed", &BehaviourParameters::aimPressed, sim::units::degrees, 0, 180,
      "Aiming error, pressed", "Accepted aiming error while an opponent is at the ball"}, behaviour_sets::players},
    {{"pressed_within", &BehaviourParameters::pressedWithin, sim::units::metres, 0, 10,
      "Pressed within", "An opponent closer to the ball than this counts as being at the ball"}, behaviour_sets::players},
    {{"aim_side", &BehaviourParameters::aimSide, sim::units::plain, -0.9, 0.9,
      "Side of the goal", "Aims only at a part of the goal: 0 at all of it, 0.5 at its left half, -0.5 at its right half, 0.9 close to the left post"}, behaviour_sets::players},
    {{"head_time", &BehaviourParameters::headTime, sim::units::seconds, 0, 600,
      "Head search", "First searches a lost ball with the head alone; one sweep takes 4.5 s"}, behaviour_sets::players},
    {{"turn_time", &BehaviourParameters::turnTime, sim::units::seconds, 0, 600,
      "Turn search", "Then turns in place for this time, before it walks"}, behaviour_sets::players},
    {{"place_time", &BehaviourParameters::placeTime, sim::units::seconds, 1, 600,
      "Place search", "Longest time on the way to one place of the search"}, behaviour_sets::players},
    {{"ball_memory", &BehaviourParameters::ballMemory, sim::units::seconds, 0, 600,
      "Ball memory", "Keeps walking to where it saw the ball"}, behaviour_sets::players},
    {{"patience", &BehaviourParameters::patience, sim::units::seconds, 0, 600,
      "Patience", "Waits at a place without a ball before it searches"}, behaviour_sets::players},
    {{"opponent_memory", &BehaviourParameters::opponentMemory, sim::units::seconds, 0, 600,
      "Opponent memory", "Remembers an opponent that it no longer sees"}, behaviour_sets::players},
    {{"leaves_after", &BehaviourParameters::leavesAfter, sim::units::seconds, 0, 60,
      "Leaves the ball", "Leaves the ball to a team-mate that will be there earlier by more than this"}, behaviour_sets::field},
    {{"takes_after", &BehaviourParameters::takesAfter, sim::units::seconds, 0, 60,
      "Takes the ball", "Takes the ball from a team-mate if it will be there earlier by more than this"}, behaviour_sets::field},
    {{"pass_gain", &BehaviourParameters::passGain, sim::units::plain, 0, 2,
      "Value of a pass", "Value of a ball that a team-mate gets first (a certain goal is worth 1, a metre forward 0.08)"}, behaviour_sets::players},
    {{"pass_lane", &BehaviourParameters::passLane, sim::units::metres, 0, 5,
      "Pass lane", "Distance to the path of the ball within which no opponent may stand"}, behaviour_sets::players},
    {{"at_ball_time", &BehaviourParameters::atBallTime, sim::units::seconds, 1, 600,
      "Time at the ball", "Accepts larger aiming errors the longer it has the ball; after this time it takes almost any kick"}, behaviour_sets::players},
    {{"keeper_line", &BehaviourParameters::keeperLine, sim::units::metres, 0, 10,
      "Keeper's line", "Distance to the goal line at the posts; larger in front of the middle"}, behaviour_sets::keeper},
    {{"keeper_arc", &BehaviourParameters::keeperArc, sim::units::plain, 0, 2,
      "Keeper's arc", "Radius of the arc on which it stands, as a share of the goal's width; 0: it does not follow the ball"}, behaviour_sets::keeper},
    {{"keeper_aside", &BehaviourParameters::keeperAside, sim::units::metres, -2, 2,
      "Keeper aside", "Stands so far to the left of where it would stand otherwise"}, behaviour_sets::keeper},
    {{"clear_within", &BehaviourParameters::clearWithin, sim::units::metres, 0, 20,
      "Clears within", "Goes for a ball that is closer than this to the goal's centre"}, behaviour_sets::keeper},
    {{"clear_until", &BehaviourParameters::clearUntil, sim::units::metres, 0, 20,
      "Clears until", "Then follows the ball up to this distance"}, behaviour_sets::keeper},
    {{"clear_danger", &BehaviourParameters::clearDanger, sim::units::metres, 0, 20,
      "Danger", "Kicks a ball away that is closer than this to the own goal while an opponent is near"}, behaviour_sets::players},
    {{"keeper_out", &BehaviourParameters::keeperOut, sim::units::metres, 0, 20,
      "Comes out", "Comes out to a ball closer than this to the goal's centre, if nobody else reaches it earlier"}, behaviour_sets::keeper},
    {{"distance_to_kick", &BehaviourParameters::distanceToKick, sim::ParameterUnit{"centimetres", "cm"}, 0, 10000,
      "Distance to kick", "Kicks a ball that it sees closer than this; published: 25 in simulation, 40 on the real robot"}, behaviour_sets::naive},
});
// clang-format on

/// A behaviour with its parameters.
struct BehaviourChoice {
  std::string name = "striker";
  BehaviourParameters parameters;
  bool operator==(const BehaviourChoice&) const = default;
};

/// Reads the value of `key`: a name out of `known`, or an object {"name": ..., "kick_distance":
/// ...} with parameters of that behaviour. A missing name means "striker", a missing parameter its
/// default, or with "from": ..., a built-in name, a file or an object of parameters, the value
/// there.
BehaviourChoice readBehaviour(const JsonObject& parent, JsonReport& report, std::string_view key,
                              std::span<const std::string_view> known);
/// Reads the same from text: a name out of behaviours(), or such an object. `usual` has the values
/// of missing parameters.
Result<BehaviourChoice> behaviourFromText(std::string_view nameOrJson, std::string_view source,
                                          const BehaviourParameters& usual = {});
/// Returns the names of the built-in parameters of a team: "learned", "hand-tuned".
std::span<const std::string_view> builtInParameters();
/// Reads the parameters of a team: built-in ones by their name, or a file as `pitchboard-cli learn`
/// writes it: {"version": 1, "parameters": {"kick_distance": 0.03}}. A missing parameter has its
/// default. Errors: NotFound, with similar names; ParseError, with the line.
Result<BehaviourParameters> loadBehaviourParameters(const std::string& nameOrPath);
/// Writes such a text: only the name if all parameters have their defaults. Reading it back gives
/// the same values for all parameters that the behaviour uses.
std::string behaviourToText(std::string_view name, const BehaviourParameters& parameters);

/// Error InvalidArgument if a number is not finite or out of its range; the context is its key,
/// such as "behaviour.kick_distance".
Result<void> validate(const BehaviourParameters& parameters);

}  // namespace pitchboard::link
