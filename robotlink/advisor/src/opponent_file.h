// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The file in which an advisor keeps what it has learned of the opponents (docs/advisor.md). Any
// thread.

#include <string>

#include <base/result.h>

#include "opponent_model.h"

namespace pitchboard::link {

std::string opponentsToJson(const OpponentModel& model);
/// `source` names the text in errors.
Result<OpponentModel> opponentsFromJson(std::string_view text, std::string_view source);
/// Nothing learned if there is no such file.
Result<OpponentModel> loadOpponents(const std::string& path);

}  // namespace pitchboard::link
