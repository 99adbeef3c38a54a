// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The table of all numbers that people can set: noise, robot models, ball and contacts, the field,
// the tick rate. Scenario files, the checks of the simulation, the Noise and physics panel and the
// tables of docs/scenarios.md are made from it. Ranges are in the unit that people write, which
// differs from the one in memory for angles only (degrees and radians). Defaults are those of the
// structs. Constant data; any thread.

#include <array>

#include <base/angles.h>
#include <base/result.h>
#include <simcore/world/world_state.h>

namespace pitchboard::sim {

/// The unit of a value as people write it.
struct ParameterUnit {
  const char* name = "";    ///< plural, for sentences; empty for a plain number
  const char* symbol = "";  ///< symbol, for tables
  bool angle = false;       ///< people write degrees, memory holds radians
};

/// How a value is shown as a slider with a number box. Not shown if `decimals` is negative.
struct ShownParameter {
  const char* unit = "";  ///< text after the number, with a leading space
  double factor = 1.0;    ///< shown value = written value × factor
  double least = 0.0;     ///< useful range, in the unit shown; more may be allowed
  double most = 0.0;
  int decimals = -1;
};

/// One number of `Values`: a measure, or a count if Number is int.
template <class Values, class Number = double>
struct Parameter {
  const char* key;  ///< its key in files
  Number Values::*member;
  ParameterUnit unit;
  double least;         ///< allowed minimum, in `unit`
  double most;          ///< allowed maximum, in `unit`
  const char* name;     ///< its name in tables and panels
  const char* meaning;  ///< what it does; empty if the name says it
  ShownParameter shown = {};

  double stored(double written) const { return unit.angle ? radiansFromDegrees(written) : written; }
  double written(double value) const { return unit.angle ? degreesFromRadians(value) : value; }
};

namespace units {
inline constexpr ParameterUnit plain{};
inline constexpr ParameterUnit metres{"metres", "m"};
inline constexpr ParameterUnit metresPerFrame{"metres per 1/60 s", "m per 1/60 s"};
inline constexpr ParameterUnit metresPerSecond{"metres per second", "m/s"};
inline constexpr ParameterUnit metresPerSecondSquared{"metres per second squared", "m/s²"};
inline constexpr ParameterUnit degrees{"degrees", "degrees", true};
inline constexpr ParameterUnit degreesPerFrame{"degrees per 1/60 s", "degrees per 1/60 s", true};
inline constexpr ParameterUnit degreesPerSecond{"degrees per second", "degrees/s", true};
inline constexpr ParameterUnit degreesPerSecondSquared{"degrees per second squared", "degrees/s²",
                                                       true};
inline constexpr ParameterUnit seconds{"seconds", "s"};
inline constexpr ParameterUnit kilograms{"kilograms", "kg"};
inline constexpr ParameterUnit newtonSeconds{"newton seconds", "N·s"};
inline constexpr ParameterUnit volts{"volts", "V"};
inline constexpr ParameterUnit ticksPerSecond{"ticks per second", "ticks/s"};
}  // namespace units

// Standard deviations (σ) are of zero-mean normal noise. What holds for 1/60 s is scaled with the
// square root of the tick. Tables, with two lines for each number:
// clang-format off
inline constexpr auto noiseParameters = std::to_array<Parameter<NoiseParameters>>({
    {"forward", &NoiseParameters::forward, units::metresPerFrame, 0, 1,
     "Forward", "σ per 1/60 s of walking", {" cm/frame", 100, 0, 2, 3}},
    {"sideways", &NoiseParameters::sideways, units::metresPerFrame, 0, 1,
     "Sideways", "σ per 1/60 s of walking", {" cm/frame", 100, 0, 2, 3}},
    {"rotation", &NoiseParameters::rotation, units::degreesPerFrame, 0, 180,
     "Rotation", "σ per 1/60 s of walking", {" °/frame", 1, 0, 2, 3}},
    {"kick_speed", &NoiseParameters::kickSpeed, units::metresPerSecond, 0, 20,
     "Kick speed", "σ of the ball's speed", {" m/s", 1, 0, 3, 2}},
    {"kick_angle", &NoiseParameters::kickAngle, units::degrees, 0, 180,
     "Kick angle", "σ of the ball's direction", {" °", 1, 0, 45, 1}},
    {"vision_distance", &NoiseParameters::visionDistance, units::plain, 0, 1,
     "Ball distance", "σ as a share of the distance", {" %", 100, 0, 50, 1}},
    {"vision_bearing", &NoiseParameters::visionBearing, units::degrees, 0, 180,
     "Ball bearing", "σ", {" °", 1, 0, 20, 1}},
    {"robot_distance", &NoiseParameters::robotDistance, units::metres, 0, 10,
     "Robot distance", "σ, for other robots", {" cm", 100, 0, 100, 0}},
    {"robot_bearing", &NoiseParameters::robotBearing, units::degrees, 0, 180,
     "Robot bearing", "σ, for other robots", {" °", 1, 0, 20, 1}},
    {"landmark_bearing", &NoiseParameters::landmarkBearing, units::degrees, 0, 180,
     "Landmark bearing", "σ, for the corners of the field", {" °", 1, 0, 30, 1}},
    {"landmark_probability", &NoiseParameters::landmarkProbability, units::plain, 0, 1,
     "Landmark seen", "Probability that a landmark in view is seen in a frame", {" %", 100, 0, 100, 0}},
    {"missed_detection", &NoiseParameters::missedDetection, units::plain, 0, 1,
     "Missed detections", "Probability that a ball or robot in view is not seen", {" %", 100, 0, 100, 0}},
    {"vision_delay", &NoiseParameters::visionDelay, units::seconds, 0, 2,
     "Vision delay", "Time from seeing something to writing it to the blackboard", {" ms", 1000, 0, 1000, 0}},
    {"imu_white", &NoiseParameters::imuWhite, units::degrees, 0, 180,
     "IMU yaw", "σ per tick", {" °", 1, 0, 10, 2}},
    {"imu_drift", &NoiseParameters::imuDrift, units::degreesPerFrame, 0, 180,
     "IMU drift", "σ per 1/60 s; accumulates", {" °/frame", 1, 0, 1, 3}},
});

inline constexpr auto rigidBodyParameters = std::to_array<Parameter<RigidBodySettings>>({
    {"ball_mass", &RigidBodySettings::ballMass, units::kilograms, 0.01, 5,
     "Ball mass", "The default is the field's", {" kg", 1, 0.01, 2, 2}},
    {"post_restitution", &RigidBodySettings::postRestitution, units::plain, 0, 1,
     "Bounce off posts", "Also off walls and nets", {" %", 100, 0, 100, 0}},
    {"robot_restitution", &RigidBodySettings::robotRestitution, units::plain, 0, 1,
     "Bounce off robots", "", {" %", 100, 0, 100, 0}},
});

inline constexpr auto robotModelParameters = std::to_array<Parameter<RobotModel>>({
    {"forward_fast", &RobotModel::forwardFast, units::metresPerSecond, 0, 10,
     "Forward, fast", "Action 1", {" m/s", 1, 0, 2, 2}},
    {"forward_slow", &RobotModel::forwardSlow, units::metresPerSecond, 0, 10,
     "Forward, slow", "Action 8; DECISION_ACTION_B below 10 gives tenths of it", {" m/s", 1, 0, 2, 2}},
    {"backward_fast", &RobotModel::backwardFast, units::metresPerSecond, 0, 10,
     "Backward, fast", "Action 17", {" m/s", 1, 0, 2, 2}},
    {"backward_slow", &RobotModel::backwardSlow, units::metresPerSecond, 0, 10,
     "Backward, slow", "Action 18", {" m/s", 1, 0, 2, 2}},
    {"sideways", &RobotModel::sideways, units::metresPerSecond, 0, 10,
     "Sideways", "Actions 6 and 7", {" m/s", 1, 0, 2, 2}},
    {"turn", &RobotModel::turn, units::degreesPerSecond, 0, 1000,
     "Turning", "Actions 2 and 3", {" °/s", 1, 0, 180, 0}},
    {"around_sideways", &RobotModel::aroundSideways, units::metresPerSecond, 0, 10,
     "Around the ball", "Sideways, actions 9 and 14", {" m/s", 1, 0, 2, 2}},
    {"around_turn", &RobotModel::aroundTurn, units::degreesPerSecond, 0, 1000,
     "Turning around it", "Actions 9 and 14", {" °/s", 1, 0, 180, 0}},
    {"max_acceleration", &RobotModel::maxAcceleration, units::metresPerSecondSquared, 0.01, 1000,
     "Acceleration", "Maximum of the gait", {" m/s²", 1, 0.05, 10, 2}},
    {"max_yaw_acceleration", &RobotModel::maxYawAcceleration, units::degreesPerSecondSquared, 1, 500000,
     "Yaw acceleration", "Maximum of the gait", {" °/s²", 1, 10, 2000, 0}},
    {"kick_speed", &RobotModel::kickSpeed, units::metresPerSecond, 0, 20,
     "Strong kick", "Speed of a ball hit squarely, actions 4 and 5", {" m/s", 1, 0, 6, 2}},
    {"weak_kick_speed", &RobotModel::weakKickSpeed, units::metresPerSecond, 0, 20,
     "Weak kick", "Actions 21 and 22", {" m/s", 1, 0, 6, 2}},
    {"pass_speed", &RobotModel::passSpeed, units::metresPerSecond, 0, 20,
     "Pass", "Actions 12 and 13", {" m/s", 1, 0, 6, 2}},
    {"kick_reach", &RobotModel::kickReach, units::metres, 0, 3,
     "Kick reach", "From the robot's centre to the ball's", {" cm", 100, 0, 100, 0}},
    {"kick_outer", &RobotModel::kickOuter, units::degrees, 0, 180,
     "Kick sector, outer", "From the heading to the foot's side; passes: to both sides", {" °", 1, 0, 90, 0}},
    {"kick_inner", &RobotModel::kickInner, units::degrees, 0, 180,
     "Kick sector, inner", "From the heading to the other side", {" °", 1, 0, 90, 0}},
    {"foot_side", &RobotModel::footSide, units::metres, 0, 1,
     "Foot", "From the middle of the robot", {" cm", 100, 0, 30, 1}},
    {"foot_width", &RobotModel::footWidth, units::metres, 0.001, 3,
     "Foot width", "A ball at this distance beside the foot gets 61 % of the speed", {" cm", 100, 1, 50, 0}},
    {"kick_time", &RobotModel::kickTime, units::seconds, 0, 60,
     "Kick duration", "", {" s", 1, 0, 10, 2}},
    {"kick_contact", &RobotModel::kickContact, units::seconds, 0, 60,
     "Foot hits after", "Time until the foot hits the ball; at most the whole kick", {" s", 1, 0, 10, 2}},
    {"radius", &RobotModel::radius, units::metres, 0, 1,
     "Radius", "Seen from above; 0 = the field's robot_radius", {" cm", 100, 0, 60, 1}},
    {"mass", &RobotModel::mass, units::kilograms, 0.1, 200,
     "Mass", "", {" kg", 1, 0.1, 50, 1}},
    {"fall_impulse", &RobotModel::fallImpulse, units::newtonSeconds, 0, 1000,
     "Fall impulse", "Impulse that makes it fall", {" N·s", 1, 0.05, 20, 2}},
    {"get_up_front", &RobotModel::getUpFront, units::seconds, 0, 600,
     "Up from the front", "", {" s", 1, 0.1, 30, 1}},
    {"get_up_back", &RobotModel::getUpBack, units::seconds, 0, 600,
     "Up from the back", "", {" s", 1, 0.1, 30, 1}},
    {"head_speed", &RobotModel::headSpeed, units::degreesPerSecond, 0, 5000,
     "Head speed", "", {" °/s", 1, 1, 720, 0}},
    {"pan_limit", &RobotModel::panLimit, units::degrees, 0, 180,
     "Head pan limit", "To either side", {" °", 1, 0, 180, 0}},
    {"field_of_view", &RobotModel::fieldOfView, units::degrees, 1, 360,
     "Field of view", "Total angle", {" °", 1, 1, 360, 0}},
    {"vision_range", &RobotModel::visionRange, units::metres, 0, 100,
     "Vision range", "", {" m", 1, 0.1, 20, 1}},
    {"camera_forward", &RobotModel::cameraForward, units::metres, -1, 1,
     "Camera forward", "In front of the robot's centre", {" cm", 100, -20, 20, 1}},
    {"camera_height", &RobotModel::cameraHeight, units::metres, 0, 5,
     "Camera height", "Used for distances from the lens", {" cm", 100, 0, 200, 0}},
    {"battery_full", &RobotModel::batteryFull, units::volts, 1, 100,
     "Battery full", "Voltage of a full battery", {" V", 1, 1, 60, 2}},
    {"battery_low", &RobotModel::batteryLow, units::volts, 1, 100,
     "Battery low", "Below this voltage the battery counts as low", {" V", 1, 1, 60, 2}},
    {"battery_empty", &RobotModel::batteryEmpty, units::volts, 0, 100,
     "Battery empty", "Voltage of an empty battery", {" V", 1, 0, 60, 2}},
});

inline constexpr auto fieldParameters = std::to_array<Parameter<FieldSpec>>({
    {"length", &FieldSpec::length, units::metres, 1, 200,
     "Length", "Goal line to goal line, outer edges"},
    {"width", &FieldSpec::width, units::metres, 1, 200,
     "Width", "Touch line to touch line"},
    {"border", &FieldSpec::border, units::metres, 0.1, 20,
     "Border", "From a line to the wall round the field"},
    {"goal_width", &FieldSpec::goalWidth, units::metres, 0.2, 100,
     "Goal width", "Between the centres of the posts; at most the width"},
    {"goal_depth", &FieldSpec::goalDepth, units::metres, 0.1, 20,
     "Goal depth", "From the goal line to the back of the goal; at most the border"},
    {"goal_height", &FieldSpec::goalHeight, units::metres, 0, 20,
     "Goal height", "For the record; the simulation is flat"},
    {"goal_post_radius", &FieldSpec::goalPostRadius, units::metres, 0.005, 1,
     "Goal post radius", ""},
    {"goal_area_length", &FieldSpec::goalAreaLength, units::metres, 0, 100,
     "Goal area length", "Along x; 0 = none"},
    {"goal_area_width", &FieldSpec::goalAreaWidth, units::metres, 0, 200,
     "Goal area width", "Along y"},
    {"penalty_area_length", &FieldSpec::penaltyAreaLength, units::metres, 0, 100,
     "Penalty area length", "Along x; 0 = none"},
    {"penalty_area_width", &FieldSpec::penaltyAreaWidth, units::metres, 0, 200,
     "Penalty area width", "Along y"},
    {"penalty_mark_distance", &FieldSpec::penaltyMarkDistance, units::metres, 0, 100,
     "Penalty mark", "From the goal line; 0 = none"},
    {"centre_circle_diameter", &FieldSpec::centreCircleDiameter, units::metres, 0, 100,
     "Centre circle", "Its diameter"},
    {"line_width", &FieldSpec::lineWidth, units::metres, 0.001, 1,
     "Line width", ""},
    {"mark_diameter", &FieldSpec::markDiameter, units::metres, 0, 1,
     "Mark diameter", "Of the penalty and centre marks; 0 = crosses"},
    {"corner_arc_radius", &FieldSpec::cornerArcRadius, units::metres, 0, 20,
     "Corner arcs", "Their radius, to the outer edge; 0 = none"},
    {"ball_radius", &FieldSpec::ballRadius, units::metres, 0.01, 0.5,
     "Ball radius", ""},
    {"ball_mass", &FieldSpec::ballMass, units::kilograms, 0.01, 5,
     "Ball mass", "Unless `rigid_body` says another"},
    {"robot_radius", &FieldSpec::robotRadius, units::metres, 0.02, 1,
     "Robot radius", "Of robots whose model names none"},
});

inline constexpr auto surfaceParameters = std::to_array<Parameter<Surface>>({
    {"rolling_deceleration", &Surface::deceleration, units::metresPerSecondSquared, 0, 100,
     "Rolling deceleration", "A rolling ball loses this speed every second"},
    {"rolling_speed_kept", &Surface::keptPerFrame, units::plain, 0, 1,
     "Rolling speed kept", "Share of its speed that a rolling ball keeps in 1/60 s; 1 on all fields but `published`"},
});

inline constexpr Parameter<SimulationSettings> tickRateParameter{
    "tick_rate", &SimulationSettings::tickRate, units::ticksPerSecond, 1, 10000,
    "Tick rate", "Ticks per simulated second"};
// clang-format on

/// The only switch among the constants of the body: whether robots can fall.
struct FallsSwitch {
  const char* key = "falls";
  const char* name = "Robots fall when hit hard";
};
inline constexpr FallsSwitch fallsSwitch;

/// Names of the values of KickLaw, in its order.
inline constexpr std::array<const char*, 2> kickLawNames{"published", "foot"};

/// From where RobotModel::fromCamera measures: no, yes.
inline constexpr std::array<const char*, 2> distanceFromNames{"body", "camera"};

// Each fails with InvalidArgument for a value that is not finite or out of range; the context is
// the key ("noise.forward"). validate() of field.h checks more of a field.
Result<void> validate(const NoiseParameters& noise);
Result<void> validate(const RigidBodySettings& body);
Result<void> validate(const SimulationSettings& settings);

}  // namespace pitchboard::sim
