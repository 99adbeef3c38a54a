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
#include "lookahead.h"
#include "opponent_file.h"
#include "opponent_watch.h"

namespace pitchboard::link {
namespace {

constexpr double stepPeriod = 0.1;       // s, as decision
constexpr double lookaheadPeriod = 1.0;  // s between the beginnings of two lookaheads
constexpr double quietPeriod = 2.0;      // s after one that found nothing better
constexpr int slices = 4;                // steps that a lookahead takes
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
        m_state(options) {
    m_state.learned = m_written = known;
  }

  void step(Blackboard& board, const Clock& clock) override {
    const double now = clock.seconds;
    const Situation& situation = m_state.reader.read(board, now);
    m_state.opponents.update(situation.opponents, now);
    if (m_options.advisor.learns) learn(board, situation, now);
    constexpr double longestWait = 5.0;                        // s, of a kick
    if (m_state.next > now + longestWait) m_state.next = now;  // the clock was put back
    const auto state = [&] {
      if (m_state.lookahead) return AdvisorState::Thinks;
      return enoughIsKnown(situation) ? AdvisorState::NothingToDecide
                                      : AdvisorState::TooLittleKnown;
    };
    // Rollouts know nothing of a kick that goes on, and nobody can change it.
    if (isKick(situation.doing))
      m_state.next = std::max(m_state.next, now + m_options.model.kickTime);
    if (!m_state.lookahead) begin(situation, now);
    writeIfPresent(board, m_variables.state, static_cast<int>(state()));
    if (m_state.lookahead) think(board);
  }

  double period() const override { return stepPeriod; }

  Advisor(const Advisor& other) = default;

  std::unique_ptr<const CognitiveProcess> remembered() const override {
    return std::make_unique<Advisor>(*this);
  }
  bool restore(const CognitiveProcess& memory) override {
    const auto* other = dynamic_cast<const Advisor*>(&memory);
    if (other) m_state = other->m_state;
    return other != nullptr;
  }
  void resume(const Blackboard& board) override {
    m_state.stamp = std::max(0, readOr(board, m_variables.stamp));
  }
  void finish() override { keepMemory(); }
  std::size_t memoryBytes() const override {
    constexpr std::size_t usual = 12000, ofRollout = 32;
    return usual + (m_state.lookahead
                        ? static_cast<std::size_t>(m_options.advisor.rollouts) * ofRollout
                        : 0);
  }

 private:
  /// All that it remembers.
  struct State {
    explicit State(const ProcessOptions& options)
        : reader(options), next(stepPeriod * (options.robot.value % 10)) {}
    SituationReader reader;
    OpponentMemory opponents;
    OpponentWatch watch;
    OpponentModel learned;
    bool hasBegun = false, hasPlayed = false;
    double next;  // s, when it thinks again
    std::optional<Lookahead> lookahead;
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
    if (!std::exchange(m_state.hasBegun, true)) {
      std::array<std::int32_t, OpponentModel::words> words{};
      for (std::size_t i = 0; i < words.size(); ++i)
        words[i] = readOr(board, m_variables.learned[i]);
      const OpponentModel before = OpponentModel::fromWords(words);
      if (before != OpponentModel{}) m_state.learned = before;
    }
    m_state.watch.update(situation, now, m_options.field, m_options.model, m_state.learned);
    const auto words = m_state.learned.asWords();
    for (std::size_t i = 0; i < words.size(); ++i) {
      writeIfPresent(board, m_variables.learned[i], words[i]);
    }
    writeIfPresent(board, m_variables.opponent, m_state.learned.summary());
    const bool plays = situation.referee == Referee::Play;
    if (std::exchange(m_state.hasPlayed, plays) && !plays) keepMemory();
  }

  /// A disk that fails is no reason to play worse.
  void keepMemory() {
    const std::string& path = m_options.advisor.memory;
    if (path.empty() || !m_options.keepsMemory || m_state.learned == m_written) return;
    if (writeFile(path, opponentsToJson(m_state.learned), IfExists::Replace)) {
      m_written = m_state.learned;
    }
  }

  void begin(const Situation& situation, double now) {
    constexpr double rounding = 1e-6;
    if (now < m_state.next - rounding) return;
    const Question question = questionOf(situation, thinker());
    if (question == Question::None) return;
    const Candidates candidates = candidatesFor(question, situation, thinker(), m_state.last);
    if (candidates.size() < 2) return;
    m_state.next = now + lookaheadPeriod;
    const LookaheadPlan plan =
        planFor(question, isFree() ? affordable() : m_options.advisor.rollouts,
                m_options.advisor.horizon, m_state.learned);
    // Other numbers for each robot and lookahead.
    const std::uint64_t seed =
        (m_options.seed * 1000003U + static_cast<std::uint64_t>(m_options.robot.value)) * 1000003U +
        static_cast<std::uint64_t>(m_state.stamp) * 10007U;
    m_state.lookahead.emplace(
        beliefOf(situation, m_state.opponents, now, m_options, m_state.learned), candidates, seed,
        plan);
    m_state.slice = 0;
    m_state.perSlice = std::max(1, (plan.rollouts + slices - 1) / slices);
  }

  /// What its share of a core allows in the time of a lookahead.
  int affordable() const {
    const double time = m_options.advisor.share * lookaheadPeriod;
    return std::clamp(static_cast<int>(time / std::max(1e-5, m_cost)), 24, mostRollouts);
  }

  /// One slice of the lookahead; the last one publishes its result.
  void think(Blackboard& board) {
    Lookahead& lookahead = *m_state.lookahead;
    const double begun = cpuTime();
    const bool isLast = ++m_state.slice >= slices;
    int played = 0;
    while (!lookahead.isDone() && (isLast || played < m_state.perSlice)) {
      lookahead.playOne(*m_rollouts, m_options.field);
      ++played;
    }
    if (played > 0) m_cost += 0.2 * ((cpuTime() - begun) / played - m_cost);
    if (!lookahead.isDone()) return;
    publish(board, lookahead);
    if (m_state.last.kind == AdviceKind::None) m_state.next += quietPeriod - lookaheadPeriod;
    m_state.lookahead.reset();
  }

  void publish(Blackboard& board, const Lookahead& lookahead) {
    const AdvisorVariables& v = m_variables;
    const LookaheadResult result = lookahead.result();
    const Candidates& candidates = lookahead.candidates();
    const auto inStudio = [&](Advice advice) {
      advice.place = m_state.reader.toStudio(advice.place);
      return advice;
    };
    const auto number = [](double value) { return static_cast<float>(value); };
    m_state.last = candidates[result.best];
    v.write(board, m_options.field, inStudio(m_state.last));
    writeIfPresent(board, v.value, number(result.value));
    writeIfPresent(board, v.gain, number(result.gain));
    writeIfPresent(board, v.gainLow, number(result.gainLow));
    writeIfPresent(board, v.goal, number(result.goal));
    writeIfPresent(board, v.goalAgainst, number(result.goalAgainst));
    writeIfPresent(board, v.rollouts, lookahead.played());
    writeIfPresent(board, v.candidates, static_cast<int>(candidates.size()));
    for (std::size_t i = 0; i < mostCandidates; ++i) {
      const bool known = i < candidates.size();
      writeIfPresent(
          board, v.candidate[i],
          known ? AdvisorVariables::packed(m_options.field, inStudio(candidates[i])) : 0);
      writeIfPresent(board, v.candidateValue[i], known ? number(lookahead.valueOf(i)) : 0.0F);
    }
    writeHeat(board, lookahead.heat(result.best));
    // Last, because decision takes what stands there when it sees another stamp.
    m_state.stamp = m_state.stamp == 1'000'000'000 ? 1 : m_state.stamp + 1;
    writeIfPresent(board, v.stamp, m_state.stamp);
  }

  /// In sixteen steps: the most frequent cell has 15, each step less is a third less.
  void writeHeat(Blackboard& board, const Lookahead::Heat& heat) const {
    const int most = *std::ranges::max_element(heat);
    std::array<std::uint32_t, heatWords> words{};
    for (std::size_t cell = 0; cell < heat.size(); ++cell) {
      if (heat[cell] == 0) continue;
      double share = static_cast<double>(heat[cell]) / most;
      std::uint32_t level = 15;
      constexpr double step = 2.0 / 3.0, middle = 0.8165;  // its root
      for (; level > 1 && share < middle; share /= step) --level;
      const std::size_t at = m_state.reader.attacksLeft() ? heat.size() - 1 - cell : cell;
      words[at / 8] |= level << (4 * (at % 8));
    }
    for (std::size_t i = 0; i < words.size(); ++i) {
      writeIfPresent(board, m_variables.heat[i], static_cast<int>(words[i]));
    }
  }

  ProcessOptions m_options;
  std::shared_ptr<rollout::Rollouts> m_rollouts;  // scratch memory: a copy may use the same
  AdvisorVariables m_variables;
  State m_state;
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
