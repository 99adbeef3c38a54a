// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A simulation with a referee and robots that stand where they are put, for tests of its rules. The
// test's thread; metres, seconds.

#include <QtTest>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <robotlink/match/referee_packet.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <simcore/simulation/simulation.h>

namespace pitchboard {

/// A simulation with three robots a side that stand where they are put.
struct RefereeGame {
  explicit RefereeGame(const char* rules, bool automatic = false, double rate = 60.0)
      : RefereeGame(named(rules, automatic), rate) {}
  explicit RefereeGame(const sim::RefereeRules& rules, double rate = 60.0) {
    sim::SimulationSettings settings;
    settings.tickRate = rate;
    settings.field = sim::fieldByName("kid-2020").value();
    settings.referee = rules;
    simulation.emplace(sim::Simulation::create(settings).value());
    for (int i = 0; i < 6; ++i) {
      const bool red = i >= 3;
      sim::RobotIdentity robot{RobotId{i + 1}, red ? TeamColor::Red : TeamColor::Blue, i % 3 + 1,
                               red};
      const double x = (red ? 1.0 : -1.0) * (i % 3 == 0 ? 4.2 : 2.5);
      const Pose pose{{x, i % 3 == 0 ? 0.0 : i % 3 == 1 ? 2.0 : -2.0}, red ? 3.14159 : 0.0};
      if (!simulation->addRobot(robot, pose)) qFatal("no robot");
    }
    if (!simulation->setReferee(settings.referee)) qFatal("no referee");
    commands.resize(6);
    percepts.resize(6);
    for (auto& command : commands) command.searchOn = 0;
  }
  static sim::RefereeRules named(const char* set, bool automatic) {
    sim::RefereeRules rules = link::refereeRuleSet(set).value().value();
    rules.automatic = automatic;
    rules.readyStillTime = 0.0;  // they stand from the beginning; READY lasts its time
    return rules;
  }
  const Game& game() const { return *simulation->state().game; }
  double now() const {
    return static_cast<double>(simulation->state().tick) / simulation->state().settings.tickRate;
  }
  void tick() {
    simulation->step(commands, percepts);
    for (const sim::Event& event : simulation->events()) events.push_back(event);
  }
  void runTo(double seconds) {
    const auto rate = simulation->state().settings.tickRate;
    while (simulation->state().tick < static_cast<std::uint64_t>(std::lround(seconds * rate))) {
      tick();
    }
  }
  bool call(sim::RefereeCall call) { return simulation->call(call).has_value(); }
  /// The ball lies at a robot, and rolls away from it.
  void touch(const Point& place, const Velocity& velocity) {
    QVERIFY(simulation->placeBall(place));
    tick();
    QVERIFY(simulation->placeBall(place, velocity));
  }
  /// From a robot's centre to that of a ball which lies 5 mm before it.
  double atTheBall() const {
    const sim::FieldSpec& field = simulation->state().settings.field;
    return sim::robotRadius(simulation->state(), 0) + field.ballRadius + 0.005;
  }
  bool state(PlayState state) { return call({.kind = sim::CallKind::State, .state = state}); }
  bool happened(sim::EventKind kind) const {
    return std::any_of(events.begin(), events.end(),
                       [kind](const sim::Event& event) { return event.kind == kind; });
  }
  telemetry::RefereeState packet() const { return link::refereePacket(simulation->state(), 7); }

  std::optional<sim::Simulation> simulation;
  std::vector<sim::RobotCommand> commands;
  std::vector<sim::Percepts> percepts;
  std::vector<sim::Event> events;
};

}  // namespace pitchboard
