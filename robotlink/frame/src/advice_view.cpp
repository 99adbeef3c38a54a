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
  firstAdviceValue = firstAdviceCandidate + mostCandidates,
  firstAdviceHeat = firstAdviceValue + mostCandidates
};
static_assert(firstAdviceHeat + std::size_t{heatWords} == adviceVariableCount);

constexpr int cellsPerWord = 8, highestLevel = 15;
constexpr double levelRatio = 2.0 / 3.0;  // of a level to the next
constexpr int packedKind = 100'000'000, packedX = 10'000;
constexpr double mostGoals = 1000.0;

constexpr std::array<std::string_view, static_cast<std::size_t>(lastOf(AdviceKind{})) + 1>
    kindTexts{"as usual",       "strong kick",    "weak kick", "dribble",
              "go to the ball", "leave the ball", "stand"};

std::optional<AdviceKind> kindOf(int number) {
  if (number < 0 || number > static_cast<int>(lastOf(AdviceKind{}))) return {};
  return static_cast<AdviceKind>(number);
}

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
    view.isThinking = whole(adviceState) == static_cast<int>(AdvisorState::Thinks);
    view.choice = kindOf(whole(adviceChoice)).value_or(AdviceKind::None);
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
        std::clamp(whole(adviceCandidateCount), 0, static_cast<int>(mostCandidates)));
    for (std::size_t i = 0; i < count; ++i) {
      const int packed = whole(firstAdviceCandidate + i);
      const auto kind = kindOf(packed < 0 ? packed : packed / packedKind);
      if (!kind) continue;
      AdviceCandidate& one = view.candidates.emplace_back();
      one.kind = *kind;
      const int column = packed % packedKind / packedX, row = packed % packedX;
      one.place = sim::published_frame::studioFromLocalization(
                      m_field, {static_cast<double>(column), static_cast<double>(row), 0.0})
                      .position;
      one.value = number(firstAdviceValue + i);
    }
    // The value says which of several kicks it is.
    AdviceCandidate* chosen = nullptr;
    for (AdviceCandidate& one : view.candidates) {
      if (one.kind != view.choice) continue;
      const bool nearer = chosen == nullptr ||
                          std::abs(one.value - view.value) < std::abs(chosen->value - view.value);
      if (nearer) chosen = &one;
    }
    if (chosen != nullptr) chosen->isChosen = true;
  }

  std::shared_ptr<const BallHeat> heat() const {
    auto made = std::make_shared<BallHeat>(BallHeat{heatColumns, heatRows, {}});
    bool any = false;
    for (std::size_t word = 0; word < std::size_t{heatWords}; ++word) {
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
      for (std::size_t i = 1; i <= mostCandidates; ++i) made.push_back(name + std::to_string(i));
    }
    for (std::size_t i = 1; i <= std::size_t{heatWords}; ++i) {
      made.push_back("ADVISOR_HEAT" + std::string(i < 10 ? "0" : "") + std::to_string(i));
    }
    return made;
  }();
  return names[variable - firstAdviceCandidate];
}

}  // namespace

std::string_view adviceText(AdviceKind kind) {
  return kindTexts[static_cast<std::size_t>(kind)];
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
  if (maker.whole(adviceStamp) <= 0 ||
      maker.whole(adviceState) == static_cast<int>(AdvisorState::Off))
    return nullptr;
  return std::make_shared<const AdviceView>(maker.make());
}

}  // namespace pitchboard::link
