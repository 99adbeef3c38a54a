// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The topic of a group's rows in session files, and of whoever shows them elsewhere: letters and
// digits of the group's name, "/robots/B1/row". Two groups can have one topic. Pure function; any
// thread.

#include <string>

#include <telemetry/series/series_types.h>

namespace pitchboard::telemetry {

std::string rowTopic(const GroupInfo& group);

}  // namespace pitchboard::telemetry
