// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a scenario, as a field, and as the INI file of a robot: what is accepted comes back
// from its own text.
#include <cstdlib>

#include <robotlink/processes/management_config.h>
#include <robotlink/scenario/scenario.h>
#include <simcore/world/field_text.h>

using namespace pitchboard;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto scenario = link::scenarioFromJson(text, "fuzz")) {
    // Angles may come back one unit in the last place away, and then stay.
    const auto second = link::scenarioFromJson(link::scenarioToJson(*scenario), "second");
    if (!second) std::abort();
    const std::string written = link::scenarioToJson(*second);
    const auto third = link::scenarioFromJson(written, "third");
    if (!third || link::scenarioToJson(*third) != written) std::abort();
  }
  if (const auto field = sim::fieldFromText(text, "fuzz")) {
    const auto again = sim::fieldFromText(sim::fieldToText(*field), "again");
    if (!again || !(*again == *field)) std::abort();
  }
  if (const auto file = link::iniFromText(text, "fuzz")) {
    for (const link::IniEntry& entry : file->entries) {
      if (entry.line < 1 || entry.name.empty()) std::abort();
      if (file->find(entry.section, entry.name) == nullptr) std::abort();
    }
    if (const auto robot = link::robotFromIni(*file)) {
      if (robot->value < 1 || robot->value > 64) std::abort();
    }
    if (const auto management = link::managementFromIni(*file, {"vision", "decision"})) {
      if (management->timing.responseTimeout.count() <= 0.0) std::abort();
      for (const auto& [name, words] : management->commands) {
        if (words.empty()) std::abort();
      }
    }
  }
  return 0;
}
