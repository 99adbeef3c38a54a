// SPDX-License-Identifier: GPL-3.0-or-later

// Experiment files, and lines of their results (inputs that begin with a line's brace and "run").
// Whatever is accepted can be expanded, and its text is the same experiment again.

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <robotlink/experiment/experiment.h>

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
  const auto experiment = experimentFromJson(text, "fuzz");
  if (!experiment) return 0;
  (void)scenarioOf(*experiment, placeOf(*experiment, experiment->allRuns()));
  const auto again = experimentFromJson(experiment->text, "again");
  if (!again || again->text != experiment->text) std::abort();
  return 0;
}
