// SPDX-License-Identifier: GPL-3.0-or-later

// Experiment files, lines of their results (inputs that begin with a line's brace and "run"), and
// files of `learn` (those with "opponents"). Whatever is accepted can be expanded, and its text is
// the same experiment again.

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <robotlink/experiment/experiment.h>
#include <robotlink/learn/learning.h>

#include "result_line.h"

using namespace pitchboard::link;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (text.starts_with("{\"run\"")) {
    static const Experiment small =
        *experimentFromJson(R"({"version": 1, "scenario": {"version": 1}, "runs": 9})", "small");
    const std::size_t metrics = metricsOf(small).size();
    if (const auto result = resultFromLine(text, small, metrics)) {
      const std::string line = lineOf(*result);
      if (!resultFromLine(line, small, metrics)) std::abort();
    }
    return 0;
  }
  if (text.find("\"opponents\"") != std::string_view::npos) {
    if (const auto learning = learningFromJson(text, "fuzz")) {
      Candidate one{"candidate", {}};
      for (const LearnedParameter& parameter : learning->parameters) {
        one.values.push_back(parameter.at(1.0));
      }
      (void)trainingOf(*learning, "generation", {&one, 1}, learning->matches, firstTrainingSeed);
      const auto again = learningFromJson(learning->text, "again");
      if (!again || again->text != learning->text) std::abort();
    }
    return 0;
  }
  const auto experiment = experimentFromJson(text, "fuzz");
  if (!experiment) return 0;
  (void)scenarioOf(*experiment, placeOf(*experiment, experiment->allRuns()));
  const auto again = experimentFromJson(experiment->text, "again");
  if (!again || again->text != experiment->text) std::abort();
  return 0;
}
