// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/frame/advice_view.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include <simcore/world/published_frame.h>

namespace pitchboard::link {
namespace {

enum AdviceWord : std::size_t {
  adviceStamp,
  adviceState,
  adviceChoice,
  adviceRollouts,
  adviceCandidateCount,
  adviceValue,
  adviceGain,
  adviceGoal,
  adviceGoalAgainst,
  firstAdviceCandidate,
  firstAdviceValue = firstAdviceCandidate + adviceCandidates,
  firstAdviceHeat = firstAdviceValue + adviceCandidates
};
static_assert(firstAdviceHeat + adviceHeatWords == adviceVariableCount);

constexpr int thinkingState = 2;
constexpr int heatColumns = 16, heatRows = 10, cellsPerWord = 8, highestLevel = 15;
constexpr double levelRatio = 2.0 / 3.0;  // of a level to the next
constexpr int packedChoice = 100'000'000, packedX = 10'000;
constexpr double mostGoals = 1000.0;

constexpr std::array<std::string_view, 7> choiceTexts{
    "as usual", "strong kick", "weak kick", "dribble", "go to the ball", "leave the ball", "stand"};

class AdviceMaker {
 public:
  AdviceMaker(const AdviceReader& reader, const sim::FieldSpec& field)
      : m_reader(reader), m_field(field) {}

  int whole(std::size_t variable) const {
    const double value = m_reader(variable).value_or(0.0);
    return std::abs(value) <= 2147483648.0 ? static_cast<int>(value) : 0;
  }
  double number(std::size_t variable) const {
    const double value = m_reader(variable).value_or(0.0);
    return std::isfinite(value) ? std::clamp(value, -mostGoals, mostGoals) : 0.0;
  }

  AdviceView make() const {
    AdviceView view;
    view.isThinking = whole(adviceState) == thinkingState;
    view.choice = whole(adviceChoice);
    view.value = number(adviceValue);
    view.gain = number(adviceGain);
    view.goal = number(adviceGoal);
    view.goalAgainst = number(adviceGoalAgainst);
    view.rollouts = whole(adviceRollouts);
    takeCandidates(view);
    view.heat = heat();
    return view;
  }

 private:
  void takeCandidates(AdviceView& view) const {
    const auto count = static_cast<std::size_t>(
        std::clamp(whole(adviceCandidateCount), 0, static_cast<int>(adviceCandidates)));
    for (std::size_t i = 0; i < count; ++i) {
      const int packed = whole(firstAdviceCandidate + i);
      if (packed < 0 || packed / packedChoice >= static_cast<int>(choiceTexts.size())) continue;
      AdviceCandidate& one = view.candidates.emplace_back();
      one.choice = packed / packedChoice;
      const double x = packed % packedChoice / packedX, y = packed % packedX;
      one.place = sim::published_frame::studioFromLocalization(m_field, {x, y, 0.0}).position;
      one.value = number(firstAdviceValue + i);
    }
    // The value says which of several kicks it is.
    AdviceCandidate* chosen = nullptr;
    for (AdviceCandidate& one : view.candidates) {
      if (one.choice != view.choice) continue;
      const bool nearer = chosen == nullptr ||
                          std::abs(one.value - view.value) < std::abs(chosen->value - view.value);
      if (nearer) chosen = &one;
    }
    if (chosen != nullptr) chosen->isChosen = true;
  }

  std::shared_ptr<const BallHeat> heat() const {
    auto made = std::make_shared<BallHeat>(BallHeat{heatColumns, heatRows, {}});
    bool any = false;
    for (std::size_t word = 0; word < adviceHeatWords; ++word) {
      const auto bits = static_cast<std::uint32_t>(whole(firstAdviceHeat + word));
      any = any || bits != 0;
      for (int cell = 0; cell < cellsPerWord; ++cell) {
        const int level = static_cast<int>(bits >> (4 * cell) & 0xFU);
        made->cells.push_back(
            level == 0 ? 0.0F : static_cast<float>(std::pow(levelRatio, highestLevel - level)));
      }
    }
    return any ? made : nullptr;
  }

  const AdviceReader& m_reader;
  const sim::FieldSpec& m_field;
};

std::string_view numberedName(std::size_t variable) {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> made;
    for (const char* name : {"ADVISOR_CANDIDATE", "ADVISOR_VALUE"}) {
      for (std::size_t i = 1; i <= adviceCandidates; ++i) made.push_back(name + std::to_string(i));
    }
    for (std::size_t i = 1; i <= adviceHeatWords; ++i) {
      made.push_back("ADVISOR_HEAT" + std::string(i < 10 ? "0" : "") + std::to_string(i));
    }
    return made;
  }();
  return names[variable - firstAdviceCandidate];
}

}  // namespace

std::string_view adviceText(int choice) {
  const auto at = static_cast<std::size_t>(choice);
  return choice >= 0 && at < choiceTexts.size() ? choiceTexts[at] : std::string_view();
}

const std::array<std::string_view, adviceVariableCount>& adviceVariables() {
  static const auto names = [] {
    std::array<std::string_view, adviceVariableCount> made{
        "ADVISOR_STAMP",    "ADVISOR_STATE",      "ADVISOR_CHOICE",
        "ADVISOR_ROLLOUTS", "ADVISOR_CANDIDATES", "ADVISOR_VALUE",
        "ADVISOR_GAIN",     "ADVISOR_GOAL",       "ADVISOR_GOAL_AGAINST"};
    for (std::size_t i = firstAdviceCandidate; i < made.size(); ++i) made[i] = numberedName(i);
    return made;
  }();
  return names;
}

std::shared_ptr<const AdviceView> readAdvice(const AdviceReader& reader,
                                             const sim::FieldSpec& field) {
  if (!reader) return nullptr;
  const AdviceMaker maker(reader, field);
  if (maker.whole(adviceStamp) <= 0 || maker.whole(adviceState) == 0) return nullptr;
  return std::make_shared<const AdviceView>(maker.make());
}

}  // namespace pitchboard::link
