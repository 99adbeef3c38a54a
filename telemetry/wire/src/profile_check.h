// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What makes a profile valid, with the place to complain about. Private to wire. Any thread.

#include <string>
#include <vector>

#include <telemetry/wire/profile.h>

namespace pitchboard::telemetry {

/// `where`: of each field; `whole`: of the profile.
Result<void> validateAt(const Profile& profile, const std::vector<std::string>& where,
                        const std::string& whole);

}  // namespace pitchboard::telemetry
