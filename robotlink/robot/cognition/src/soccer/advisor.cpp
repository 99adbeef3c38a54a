// SPDX-License-Identifier: GPL-3.0-or-later
// The advisor: a process of a robot that learns at which part of the goal the opponents aim, and
// tells its decision process how far beside its usual place a keeper should stand
// (docs/advisor.md). It reads and writes its own robot's blackboard only.
#include <array>
#include <optional>
#include <utility>

#include <base/file_target.h>
#include <base/try.h>

#include "process_makers.h"
#include "soccer/aim_habit.h"
#include "soccer/soccer_board.h"

namespace pitchboard::link {
namespace {

/// Recognizes kicks of the opponents: a ball that has rolled far a moment after nobody of the own
/// team was at it. An opponent at the ball is seen too seldom to ask for one.
class KickWatch {
 public:
  /// Call it ten times a second.
  void update(const WorldModel& world, AimHabit& learned) {
    if (world.referee() != Referee::Play || !world.localized()) {
      m_roll.reset();
      return;
    }
    if (world.seesBall()) see(world, *world.ball(), learned);
  }

 private:
  struct Roll {
    Point from, last;
    double since = 0.0, seen = 0.0;  // s
  };

  void see(const WorldModel& world, const Point& ball, AimHabit& learned) {
    constexpr double ours = 0.55;                     // m
    constexpr double minRoll = 0.8, rests = 0.25;     // m that it rolls; that it may seem to roll
    constexpr double jump = 0.6;                      // m: put there by the referee
    constexpr double waits = 0.8, maxDuration = 2.0;  // s
    const double time = world.now();
    bool isOurs = distance(world.pose().position, ball) < ours;
    for (const auto& mate : world.mates()) {
      isOurs = isOurs || (mate && distance(mate->position, ball) < ours);
    }
    if (m_roll) {
      Roll& roll = *m_roll;
      const double age = time - roll.since;
      const bool lost = time < roll.seen || time - roll.seen > 0.5 || age > maxDuration ||
                        distance(roll.last, ball) > jump || isOurs;
      roll.last = ball;
      roll.seen = time;
      if (!lost && distance(roll.from, ball) >= minRoll) {
        learned.addKick(world.field(), turned(roll.from), turned(ball));
        m_roll.reset();
        return;
      }
      if (lost || (age > waits && distance(roll.from, ball) < rests)) m_roll.reset();
    }
    if (!m_roll && !isOurs) m_roll = Roll{ball, ball, time, time};
  }

  static Point turned(const Point& ours) { return {-ours.x, -ours.y}; }

  std::optional<Roll> m_roll;
};

class Advisor final : public CognitiveProcess {
 public:
  /// `known`: what it learned in earlier games.
  Advisor(const ProcessOptions& options, const AimHabit& known)
      : m_options(options),
        m_written(known),
        m_state{WorldModel(options.field, options.model, options.parameters, options.facesLeft),
                {},
                known} {}

  void step(Blackboard& board, const Clock& clock) override {
    m_board.read(board, m_state.world, m_input);
    m_state.world.update(m_input, clock.seconds);
    learn(board);
    const double shift = keeperShift(m_state.learned, m_options.field);
    writeIfPresent(board, m_variables.aim, static_cast<float>(m_state.learned.meanAim()));
    writeIfPresent(board, m_variables.aside, static_cast<float>(100.0 * shift));
  }

  double period() const override { return 0.1; }

  std::unique_ptr<const CognitiveProcess> remembered() const override {
    return std::make_unique<Advisor>(*this);
  }
  bool restore(const CognitiveProcess& memory) override {
    const auto* other = dynamic_cast<const Advisor*>(&memory);
    if (other) m_state = other->m_state;
    return other != nullptr;
  }
  void finish() override { keepMemory(); }

 private:
  /// All that it remembers.
  struct State {
    WorldModel world;
    KickWatch watch;
    AimHabit learned;
    bool hasBegun = false, hasPlayed = false;
  };

  /// What it has learned stands on the blackboard, from where an advisor continues that is started
  /// again, as when the teams change sides.
  void learn(Blackboard& board) {
    if (!std::exchange(m_state.hasBegun, true)) {
      std::array<std::int32_t, AimHabit::words> words{};
      for (std::size_t i = 0; i < words.size(); ++i) {
        words[i] = readOr(board, m_variables.evidence[i]);
      }
      const AimHabit before = AimHabit::fromWords(words);
      if (before != AimHabit{}) m_state.learned = before;
    }
    m_state.watch.update(m_state.world, m_state.learned);
    const auto words = m_state.learned.asWords();
    for (std::size_t i = 0; i < words.size(); ++i) {
      writeIfPresent(board, m_variables.evidence[i], words[i]);
    }
    const bool plays = m_state.world.referee() == Referee::Play;
    if (std::exchange(m_state.hasPlayed, plays) && !plays) keepMemory();
  }

  /// A disk that fails is no reason to play worse.
  void keepMemory() {
    const std::string& path = m_options.advisor.memory;
    if (path.empty() || !m_options.keepsMemory || m_state.learned == m_written) return;
    if (writeFile(path, habitToJson(m_state.learned), IfExists::Replace)) {
      m_written = m_state.learned;
    }
  }

  ProcessOptions m_options;
  AdvisorVariables m_variables;
  SoccerBoard m_board;
  SoccerInput m_input;  // of this cycle
  AimHabit m_written;   // what the file has
  State m_state;
};

}  // namespace

Result<std::unique_ptr<CognitiveProcess>> makeAdvisor(const ProcessOptions& options) {
  TRY(sim::validate(options.field));
  TRY(sim::validate(options.model));
  TRY(validate(options.parameters));
  AimHabit known;
  if (!options.advisor.memory.empty()) known = TRY(loadHabit(options.advisor.memory));
  return std::make_unique<Advisor>(options, known);
}

}  // namespace pitchboard::link
