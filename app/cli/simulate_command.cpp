// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"

namespace pitchboard::cli {

void addSimulateCommand(CLI::App&, int&) {}

}  // namespace pitchboard::cli
