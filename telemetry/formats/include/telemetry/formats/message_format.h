// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tells which formats of messages are text: lines that a person can read and type, and that may end
// with a name in the profile. Pure functions; any thread.

#include <telemetry/formats/profile.h>

namespace pitchboard::telemetry {

constexpr bool isTextFormat(MessageFormat format) {
  return format == MessageFormat::Words || format == MessageFormat::KeyValue ||
         format == MessageFormat::Json || format == MessageFormat::Lua;
}

}  // namespace pitchboard::telemetry
