// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where the pages of docs/ are on this computer. Any thread.

#include <string>

namespace pitchboard {

/// Returns the path of the page that says which page answers which question: installed with this
/// program, or in the checkout that built it. Empty if neither has it.
std::string documentationPath();

}  // namespace pitchboard
