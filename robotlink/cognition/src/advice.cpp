// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/cognition/advice.h>

#include <cmath>
#include <string>

#include <simcore/world/published_frame.h>

#include "team/team_variables.h"

namespace pitchboard::link {

AdvisorVariables::AdvisorVariables(const VariableCatalog& catalog) {
  const auto whole = [&catalog](const std::string& name) {
    return catalog.intVar("ADVISOR_" + name).value_or(IntVar{-1});
  };
  const auto real = [&catalog](const std::string& name) {
    return catalog.floatVar("ADVISOR_" + name).value_or(FloatVar{-1});
  };
  stamp = whole("STAMP");
  state = whole("STATE");
  choice = whole("CHOICE");
  rollouts = whole("ROLLOUTS");
  candidates = whole("CANDIDATES");
  opponent = whole("OPPONENT");
  x = real("X");
  y = real("Y");
  theta = real("THETA");
  value = real("VALUE");
  gain = real("GAIN");
  gainLow = real("GAIN_LOW");
  goal = real("GOAL");
  goalAgainst = real("GOAL_AGAINST");
  for (std::size_t i = 0; i < mostCandidates; ++i) {
    candidate[i] = whole("CANDIDATE" + std::to_string(i + 1));
    candidateValue[i] = real("VALUE" + std::to_string(i + 1));
  }
  const auto numbered = [&whole](const std::string& name, auto& all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::string number = std::to_string(i + 1);
      all[i] = whole(name + (number.size() < 2 ? "0" + number : number));
    }
  };
  numbered("HEAT", heat);
  numbered("LEARNED", learned);
}

Advice AdvisorVariables::read(const Blackboard& board, const sim::FieldSpec& field) const {
  const int kind = readOr(board, choice);
  const sim::published_frame::CmPose cm{static_cast<double>(readOr(board, x)),
                                        static_cast<double>(readOr(board, y)),
                                        static_cast<double>(readOr(board, theta))};
  constexpr double farthest = 1e5;  // cm, degrees
  const auto isSane = [](double number) { return std::abs(number) < farthest; };
  if (kind <= 0 || kind > static_cast<int>(lastOf(AdviceKind{})) || !isSane(cm.x) ||
      !isSane(cm.y) || !isSane(cm.degrees)) {
    return {};
  }
  return {static_cast<AdviceKind>(kind), sim::published_frame::studioFromLocalization(field, cm)};
}

void AdvisorVariables::write(Blackboard& board, const sim::FieldSpec& field,
                             const Advice& advice) const {
  const auto cm = sim::published_frame::localizationFromStudio(field, advice.place);
  writeIfPresent(board, x, static_cast<float>(cm.x));
  writeIfPresent(board, y, static_cast<float>(cm.y));
  writeIfPresent(board, theta, static_cast<float>(cm.degrees));
  writeIfPresent(board, choice, static_cast<int>(advice.kind));
}

int AdvisorVariables::packed(const sim::FieldSpec& field, const Advice& advice) {
  const auto cm = sim::published_frame::localizationFromStudio(field, advice.place);
  return static_cast<int>(advice.kind) * 100'000'000 +
         packPlace(static_cast<int>(std::lround(cm.x)), static_cast<int>(std::lround(cm.y)));
}

}  // namespace pitchboard::link
