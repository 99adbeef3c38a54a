// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which formats of messages are text: their datagrams are lines that a person can read and type,
// and may end with a word of the profile. Pure.

#include <telemetry/wire/profile.h>

namespace pitchboard::telemetry {

constexpr bool isTextFormat(MessageFormat format) {
  return format == MessageFormat::Words || format == MessageFormat::KeyValue ||
         format == MessageFormat::Json || format == MessageFormat::Lua;
}

}  // namespace pitchboard::telemetry
