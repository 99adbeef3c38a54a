// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reads and changes those parts of an experiment's file that a form can edit: seed, runs and
// conditions. Everything else in the file is kept. Pure functions of the file's text; any thread.

#include <base/result.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pitchboard::link {

struct ConditionEdit {
  std::optional<std::size_t> from;  ///< index in the file's list; empty: a new condition
  std::string name;
  std::string settings;  ///< "noise = paper, robots[B1].behaviour = keeper"; empty: the scenario's
  bool operator==(const ConditionEdit&) const = default;
};

struct ExperimentEdits {
  std::uint64_t seed = 1;
  std::size_t runs = 1;
  std::vector<ConditionEdit> conditions;
  bool isGrid = false;  ///< conditions come from "grid" and can be edited only in the file
  bool operator==(const ExperimentEdits&) const = default;
};

/// Reads the file. Fails, with the line, if it is not JSON.
Result<ExperimentEdits> editsOf(std::string_view text);
/// Returns the file with these edits. Conditions that are not in the list are removed. A value that
/// is not JSON is taken as text. Fails if the file is not JSON, or if a setting lacks key or value.
Result<std::string> withEdits(std::string_view text, const ExperimentEdits& edits);

}  // namespace pitchboard::link
