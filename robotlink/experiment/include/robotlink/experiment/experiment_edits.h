// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a form edits of an experiment's file: seed, runs and conditions. Everything else in the file
// stays as it is. Pure functions of the file's text; any thread.

#include <base/result.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pitchboard::link {

struct ConditionEdit {
  std::optional<std::size_t> from;  ///< its place in the file's list; nothing: a new one
  std::string name;
  std::string settings;  ///< "noise = paper, robots[B1].behaviour = keeper"; empty: the scenario's
  bool operator==(const ConditionEdit&) const = default;
};

struct ExperimentEdits {
  std::uint64_t seed = 1;
  std::size_t runs = 1;
  std::vector<ConditionEdit> conditions;
  bool isGrid = false;  ///< conditions follow from "grid" and are edited in the file
  bool operator==(const ExperimentEdits&) const = default;
};

/// What the file says. Fails if it is not JSON, with the line.
Result<ExperimentEdits> editsOf(std::string_view text);
/// The file with these in place; conditions that are no longer listed leave. A value without quotes
/// that is not JSON is a text. Fails if the file is not JSON or a setting has no key or no value.
Result<std::string> withEdits(std::string_view text, const ExperimentEdits& edits);

}  // namespace pitchboard::link
