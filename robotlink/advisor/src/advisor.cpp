// SPDX-License-Identifier: GPL-3.0-or-later
#include "advisor.h"

#include <time.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <base/file_target.h>
#include <base/try.h>
#include <robotlink/processes/lock_step_slots.h>

#include "candidates.h"
#include "game_belief.h"
#include "opponent_file.h"
#include "opponent_watch.h"
#include "thought.h"

namespace pitchboard::link {
namespace {

constexpr double stepPeriod = 0.1;     // s, as decision
constexpr double thoughtPeriod = 1.0;  // s between the beginnings of two thoughts
constexpr double quietPeriod = 2.0;    // s after one that found nothing better
constexpr int slices = 4;              // steps that a thought takes
constexpr int mostRollouts = 5000;

/// s of this thread.
double cpuTime() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

class Advisor final : public CognitiveProcess {
 public:
  /// `known`: what it learned in earlier games.
  Advisor(const ProcessOptions& options, rollout::Rollouts rollouts, const OpponentModel& known)
      : m_options(options),
        m_rollouts(std::make_shared<rollout::Rollouts>(std::move(rollouts))),
        m_mind(options) {
    m_mind.learned = m_written = known;
  }

  void step(Blackboard& board, const Clock& clock) override {
    const double now = clock.seconds;
    const Situation& situation = m_mind.reader.read(board, now);
    m_mind.opponents.update(situation.opponents, now);
    if (m_options.advisor.learns) learn(board, situation, now);
    constexpr double longestWait = 5.0;                      // s, of a kick
    if (m_mind.next > now + longestWait) m_mind.next = now;  // the clock was put back
    const auto state = [&] {
      if (m_mind.thought) return AdvisorState::Thinks;
      return knowsEnough(situation) ? AdvisorState::NothingToDecide : AdvisorState::KnowsTooLittle;
    };
    // Rollouts know nothing of a kick that goes on, and nobody can change it.
    if (isKick(situation.doing))
      m_mind.next = std::max(m_mind.next, now + m_options.model.kickTime);
    if (!m_mind.thought) begin(situation, now);
    writeIfPresent(board, m_variables.state, static_cast<int>(state()));
    if (m_mind.thought) think(board);
  }

  double period() const override { return stepPeriod; }

  Advisor(const Advisor& other) = default;

  std::unique_ptr<const CognitiveProcess> remembered() const override {
    return std::make_unique<Advisor>(*this);
  }
  bool restore(const CognitiveProcess& memory) override {
    const auto* other = dynamic_cast<const Advisor*>(&memory);
    if (other) m_mind = other->m_mind;
    return other != nullptr;
  }
  void resume(const Blackboard& board) override {
    m_mind.stamp = std::max(0, readOr(board, m_variables.stamp));
  }
  void finish() override { keepMemory(); }
  std::size_t memoryBytes() const override {
    constexpr std::size_t usual = 12000, ofRollout = 32;
    return usual +
           (m_mind.thought ? static_cast<std::size_t>(m_options.advisor.rollouts) * ofRollout : 0);
  }

 private:
  /// All that it remembers.
  struct Mind {
    explicit Mind(const ProcessOptions& options)
        : reader(options), next(stepPeriod * (options.robot.value % 10)) {}
    SituationReader reader;
    OpponentMemory opponents;
    OpponentWatch watch;
    OpponentModel learned;
    bool hasBegun = false, hasPlayed = false;
    double next;  // s, when it thinks again
    std::optional<Thought> thought;
    int slice = 0, perSlice = 1;
    int stamp = 0;  // as it stands on the blackboard
    Advice last;    // turned
  };

  Thinker thinker() const {
    return {m_options.field, m_options.model, m_options.behaviour == "keeper",
            m_options.parameters};
  }
  bool isFree() const {
    return m_options.advisor.share > 0.0 &&
           !(m_options.lockStepSlot && m_options.lockStepSlot->inLockStep());
  }

  /// What it has learned stands on the blackboard, from where an advisor goes on that is started
  /// again, as when the teams change sides.
  void learn(Blackboard& board, const Situation& situation, double now) {
    if (!std::exchange(m_mind.hasBegun, true)) {
      std::array<std::int32_t, OpponentModel::words> words{};
      for (std::size_t i = 0; i < words.size(); ++i)
        words[i] = readOr(board, m_variables.learned[i]);
      const OpponentModel before = OpponentModel::fromWords(words);
      if (before != OpponentModel{}) m_mind.learned = before;
    }
    m_mind.watch.update(situation, now, m_options.field, m_options.model, m_mind.learned);
    const auto words = m_mind.learned.asWords();
    for (std::size_t i = 0; i < words.size(); ++i) {
      writeIfPresent(board, m_variables.learned[i], words[i]);
    }
    writeIfPresent(board, m_variables.opponent, m_mind.learned.summary());
    const bool plays = situation.referee == Referee::Play;
    if (std::exchange(m_mind.hasPlayed, plays) && !plays) keepMemory();
  }

  /// A disk that fails is no reason to play worse.
  void keepMemory() {
    const std::string& path = m_options.advisor.memory;
    if (path.empty() || !m_options.keepsMemory || m_mind.learned == m_written) return;
    if (writeFile(path, opponentsToJson(m_mind.learned), IfExists::Replace)) {
      m_written = m_mind.learned;
    }
  }

  void begin(const Situation& situation, double now) {
    constexpr double rounding = 1e-6;
    if (now < m_mind.next - rounding) return;
    const Question question = questionOf(situation, thinker());
    if (question == Question::None) return;
    const Candidates candidates = candidatesFor(question, situation, thinker(), m_mind.last);
    if (candidates.size() < 2) return;
    m_mind.next = now + thoughtPeriod;
    const ThoughtPlan plan = planFor(question, isFree() ? affordable() : m_options.advisor.rollouts,
                                     m_options.advisor.horizon);
    // Other numbers for each robot and thought.
    const std::uint64_t seed =
        (m_options.seed * 1000003U + static_cast<std::uint64_t>(m_options.robot.value)) * 1000003U +
        static_cast<std::uint64_t>(m_mind.stamp) * 10007U;
    m_mind.thought.emplace(beliefOf(situation, m_mind.opponents, now, m_options, m_mind.learned),
                           candidates, seed, plan);
    m_mind.slice = 0;
    m_mind.perSlice = std::max(1, (plan.rollouts + slices - 1) / slices);
  }

  /// What its share of a core allows in the time of a thought.
  int affordable() const {
    const double time = m_options.advisor.share * thoughtPeriod;
    return std::clamp(static_cast<int>(time / std::max(1e-5, m_cost)), 24, mostRollouts);
  }

  /// One slice of the thought; the last one says what came out.
  void think(Blackboard& board) {
    Thought& thought = *m_mind.thought;
    const double begun = cpuTime();
    const bool isLast = ++m_mind.slice >= slices;
    int played = 0;
    while (!thought.isDone() && (isLast || played < m_mind.perSlice)) {
      thought.playOne(*m_rollouts, m_options.field);
      ++played;
    }
    if (played > 0) m_cost += 0.2 * ((cpuTime() - begun) / played - m_cost);
    if (!thought.isDone()) return;
    publish(board, thought);
    if (m_mind.last.kind == AdviceKind::None) m_mind.next += quietPeriod - thoughtPeriod;
    m_mind.thought.reset();
  }

  void publish(Blackboard& board, const Thought& thought) {
    const AdvisorVariables& v = m_variables;
    const ThoughtResult result = thought.result();
    const Candidates& candidates = thought.candidates();
    const auto inStudio = [&](Advice advice) {
      advice.place = m_mind.reader.toStudio(advice.place);
      return advice;
    };
    const auto number = [](double value) { return static_cast<float>(value); };
    m_mind.last = candidates[result.best];
    v.write(board, m_options.field, inStudio(m_mind.last));
    writeIfPresent(board, v.value, number(result.value));
    writeIfPresent(board, v.gain, number(result.gain));
    writeIfPresent(board, v.gainLow, number(result.gainLow));
    writeIfPresent(board, v.goal, number(result.goal));
    writeIfPresent(board, v.goalAgainst, number(result.goalAgainst));
    writeIfPresent(board, v.rollouts, thought.played());
    writeIfPresent(board, v.candidates, static_cast<int>(candidates.size()));
    for (std::size_t i = 0; i < mostCandidates; ++i) {
      const bool known = i < candidates.size();
      writeIfPresent(
          board, v.candidate[i],
          known ? AdvisorVariables::packed(m_options.field, inStudio(candidates[i])) : 0);
      writeIfPresent(board, v.candidateValue[i], known ? number(thought.valueOf(i)) : 0.0F);
    }
    writeHeat(board, thought.heat(result.best));
    // Last, because decision takes what stands there when it sees another stamp.
    m_mind.stamp = m_mind.stamp == 1'000'000'000 ? 1 : m_mind.stamp + 1;
    writeIfPresent(board, v.stamp, m_mind.stamp);
  }

  /// In sixteen steps: the most frequent cell has 15, each step less is a third less.
  void writeHeat(Blackboard& board, const Thought::Heat& heat) const {
    const int most = *std::ranges::max_element(heat);
    std::array<std::uint32_t, heatWords> words{};
    for (std::size_t cell = 0; cell < heat.size(); ++cell) {
      if (heat[cell] == 0) continue;
      double share = static_cast<double>(heat[cell]) / most;
      std::uint32_t level = 15;
      constexpr double step = 2.0 / 3.0, middle = 0.8165;  // its root
      for (; level > 1 && share < middle; share /= step) --level;
      const std::size_t at = m_mind.reader.attacksLeft() ? heat.size() - 1 - cell : cell;
      words[at / 8] |= level << (4 * (at % 8));
    }
    for (std::size_t i = 0; i < words.size(); ++i) {
      writeIfPresent(board, m_variables.heat[i], static_cast<int>(words[i]));
    }
  }

  ProcessOptions m_options;
  std::shared_ptr<rollout::Rollouts> m_rollouts;  // scratch memory: a copy may use the same
  AdvisorVariables m_variables;
  Mind m_mind;
  OpponentModel m_written;  // what the file has
  double m_cost = 0.001;    // s of a rollout
};

}  // namespace

Result<std::unique_ptr<CognitiveProcess>> makeAdvisor(const ProcessOptions& options) {
  TRY(sim::validate(options.field));
  TRY(sim::validate(options.model));
  TRY(validate(options.parameters));
  const AdvisorOptions& numbers = options.advisor;
  if (numbers.rollouts < 4 || numbers.rollouts > mostRollouts) {
    return failure(ErrorCode::InvalidArgument, "an advisor plays 4 to 5000 rollouts for a decision",
                   "rollouts");
  }
  if (!(numbers.horizon >= 0.5 && numbers.horizon <= 30.0)) {
    return failure(ErrorCode::InvalidArgument, "a rollout of an advisor takes 0.5 to 30 s",
                   "horizon");
  }
  if (!(numbers.share >= 0.0 && numbers.share <= 1.0)) {
    return failure(ErrorCode::InvalidArgument, "an advisor's share of a core is 0 to 1", "share");
  }
  OpponentModel known;
  if (numbers.learns && !numbers.memory.empty()) known = TRY(loadOpponents(numbers.memory));
  return std::make_unique<Advisor>(options, TRY(rollout::Rollouts::create(setupFor(options))),
                                   known);
}

}  // namespace pitchboard::link
