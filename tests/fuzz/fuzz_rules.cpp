// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as rules of a referee, as a kind of robot, as a runtime profile, as a runtime choice:
// what is accepted can be played by, and can be written and read again.
#include <cstdlib>

#include <robotlink/models/robot_models.h>
#include <robotlink/processes/runtime_profile.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <simcore/rules/referee.h>

using namespace pitchboard;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto rules = link::refereeRulesFromJson(text, "fuzz")) {
    if (!sim::validate(*rules)) std::abort();
  }
  if (const auto model = link::robotModelFromText(text, "fuzz")) {
    if (!sim::validate(*model)) std::abort();
    const auto again = link::robotModelFromText(link::robotModelToText(*model), "again");
    if (!again || !sim::validate(*again)) std::abort();
  }
  if (const auto profile = link::runtimeProfileFromJson(text, "fuzz")) {
    for (const link::ProfileProcess& process : profile->processes) {
      if (process.isReference() == !process.command.empty()) std::abort();
      for (const std::string& word : process.command) (void)link::expanded(word, profile->values);
    }
  }
  if (const auto choice = link::runtimeChoiceFromText(text)) {
    const auto again = link::runtimeChoiceFromText(link::runtimeChoiceToText(*choice));
    if (!again || !(*again == *choice)) std::abort();
  }
  return 0;
}
