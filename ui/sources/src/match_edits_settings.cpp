// SPDX-License-Identifier: GPL-3.0-or-later
// What is changed of the match's settings: physics, noise, clock, score.
#include <ui/sources/match_edits.h>

#include <utility>

#include <base/try.h>

namespace pitchboard::ui {

namespace {

/// Sets one value of the match; undone, it has the value that it had.
template <class Value, class Read, class Write>
EditStep settingStep(Value wanted, Read read, Write write) {
  const auto before = std::make_shared<Value>(wanted);
  return {
      [wanted, before, read, write](link::SimulatedMatch& match) {
        *before = read(match.simulation().state());
        return write(match.simulation(), wanted);
      },
      [before, write](link::SimulatedMatch& match) { return write(match.simulation(), *before); }};
}

}  // namespace

void MatchEdits::changeSetting(sim::Setting setting, const QString& text, const QString& whatFailed,
                               EditStep step) {
  // While a control is moved, its changes become one command, and one event.
  constexpr qint64 oneGesture = 500;  // ms, less than what EditCommand merges
  if (m_gesture.cause == 0 || m_gesture.setting != setting ||
      m_gesture.age.elapsed() > oneGesture) {
    m_gesture = {setting, newCause(), std::make_shared<bool>(false), {}};
  }
  m_gesture.age.start();
  // `reported` belongs to the match's thread.
  const auto reported = m_gesture.reported;
  const std::uint32_t cause = m_gesture.cause;
  EditStep reporting{
      [redo = std::move(step.redo), setting, cause, reported](link::SimulatedMatch& match) {
        auto done = redo(match);
        if (done && !std::exchange(*reported, true)) {
          match.simulation().reportChanged(setting, cause);
        }
        return done;
      },
      [undo = std::move(step.undo), cause, reported](link::SimulatedMatch& match) {
        auto undone = undo(match);
        if (undone && std::exchange(*reported, false)) match.simulation().reportUndone(cause);
        return undone;
      }};
  perform({text, whatFailed, {std::move(reporting)}, m_gesture.mergeKey()});
}

void MatchEdits::setNoise(const sim::NoiseParameters& noise) {
  changeSetting(sim::Setting::Noise, QStringLiteral("Change the noise"),
                QStringLiteral("Could not change the noise"),
                settingStep(
                    noise, [](const sim::WorldState& state) { return state.settings.noise; },
                    [](sim::Simulation& simulation, const sim::NoiseParameters& value) {
                      return simulation.setNoise(value);
                    }));
}

void MatchEdits::setRigidBody(const sim::RigidBodySettings& settings) {
  changeSetting(sim::Setting::Physics, QStringLiteral("Change the physics"),
                QStringLiteral("Could not change the physics"),
                settingStep(
                    settings, [](const sim::WorldState& state) { return state.settings.rigidBody; },
                    [](sim::Simulation& simulation, const sim::RigidBodySettings& value) {
                      return simulation.setRigidBody(value);
                    }));
}

void MatchEdits::setClockRunning(bool running) {
  perform({running ? QStringLiteral("Start the game clock") : QStringLiteral("Stop the game clock"),
           QStringLiteral("Could not change the clock"),
           {settingStep(
               running, [](const sim::WorldState& state) { return state.clockRunning; },
               [](sim::Simulation& simulation, bool value) -> Result<void> {
                 simulation.setClockRunning(value);
                 return {};
               })}});
}

void MatchEdits::resetScore() {
  using ScoreAndClock = std::pair<sim::Score, std::uint64_t>;
  changeSetting(sim::Setting::ScoreAndClock, QStringLiteral("Reset score and clock"),
                QStringLiteral("Could not change the score"),
                settingStep(
                    ScoreAndClock{},
                    [](const sim::WorldState& state) {
                      return ScoreAndClock{state.score, state.clockTicks};
                    },
                    [](sim::Simulation& simulation, const ScoreAndClock& value) -> Result<void> {
                      simulation.setScore(value.first);
                      simulation.editState().clockTicks = value.second;
                      return {};
                    }));
}

void MatchEdits::takePhysics(const std::string& name) {
  if (std::exchange(m_physics, name) != name) emit physicsChanged();
}

void MatchEdits::setPhysics(const QString& model) {
  const std::string after = model.toStdString(), before = m_physics;
  if (after == before) return;
  const std::uint32_t cause = newCause();
  MatchEdit edit{QStringLiteral("Play with %1 physics").arg(model),
                 QStringLiteral("Could not change the physics model"),
                 {{[after, cause](link::SimulatedMatch& match) -> Result<void> {
                     TRY(match.simulation().setPhysics(after));
                     match.simulation().reportChanged(sim::Setting::Physics, cause);
                     return {};
                   },
                   [before, cause](link::SimulatedMatch& match) -> Result<void> {
                     TRY(match.simulation().setPhysics(before));
                     match.simulation().reportUndone(cause);
                     return {};
                   }}}};
  edit.note = [this, after] { takePhysics(after); };
  edit.takeBack = [this, before] { takePhysics(before); };
  perform(std::move(edit));
}

}  // namespace pitchboard::ui
