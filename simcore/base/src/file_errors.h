// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is said of a file that cannot be made or written, and what a person can do about it. Any
// thread. `reason`: an errno value; `path` as people know the file.

#include <string>

#include <base/result.h>

namespace pitchboard {

tl::unexpected<Error> cannotMake(int reason, const std::string& path);
tl::unexpected<Error> cannotWrite(int reason, const std::string& path);

}  // namespace pitchboard
