// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes as a map of the blackboard in its three forms, and as meanings of variables: what is
// accepted has one word of the memory for every name, and comes back from its own text.
#include <cstdlib>
#include <set>

#include <robotlink/blackboard/variable_catalog.h>
#include <robotlink/blackboard/variable_meanings.h>

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

void check(const Result<VariableCatalog>& catalog) {
  if (!catalog) {
    if (catalog.error().message.empty()) std::abort();
    return;
  }
  std::set<int> words;
  for (const Variable& variable : catalog->variables()) {
    const int offset = variable.type == VariableType::Int ? 0 : Blackboard::floatOffset;
    const int word = variable.index + offset;
    if (variable.index < 0 || word >= static_cast<int>(Blackboard::bytes / 4)) std::abort();
    if (!words.insert(word).second) std::abort();
    if (catalog->find(variable.name) == nullptr) std::abort();
  }
  const auto again = VariableCatalog::fromJson(catalog->toJson(), "again");
  if (!again || !(*again == *catalog)) std::abort();
  (void)catalog->withExtension();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check(VariableCatalog::fromJson(text, "fuzz.json"));
  check(VariableCatalog::fromHeader(text, "fuzz.h"));
  check(VariableCatalog::fromPython(text, "fuzz.py"));
  if (const auto meanings = VariableMeanings::parse(text, "fuzz")) {
    telemetry::ColumnInfo column;
    column.name = "VISION_BALL_DIST";
    meanings->describe(column);
    (void)meanings->absent(column.name);
  }
  return 0;
}
