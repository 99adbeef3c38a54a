// SPDX-License-Identifier: GPL-3.0-or-later
#include "c_interface.h"

#include <algorithm>
#include <cstring>

namespace {

// In fixed memory, so that "out of memory" can be told, too.
constexpr std::size_t maxErrorLength = 2000;
thread_local char lastError[maxErrorLength] = "";

}  // namespace

const char* pb_last_error(void) {
  return lastError;
}

namespace pitchboard::link::capi {

pb_status reportStatus(pb_status status, std::string_view sentence) {
  const std::size_t length = std::min(sentence.size(), maxErrorLength - 1);
  std::memcpy(lastError, sentence.data(), length);
  lastError[length] = '\0';
  return status;
}

pb_status reportStatus(const Result<void>& result) {
  if (result) return reportStatus(PB_OK, "");
  const auto code = [&] {
    switch (result.error().code) {
      case ErrorCode::InvalidArgument:
        return PB_INVALID_ARGUMENT;
      case ErrorCode::NotFound:
        return PB_NOT_FOUND;
      case ErrorCode::ParseError:
        return PB_PARSE_ERROR;
      case ErrorCode::SystemError:
        return PB_SYSTEM_ERROR;
      case ErrorCode::Conflict:
        return PB_CONFLICT;
      case ErrorCode::Unsupported:
        return PB_UNSUPPORTED;
    }
    return PB_INVALID_ARGUMENT;
  }();
  return reportStatus(code, result.error().text());
}

pb_status missing(const char* what) {
  return reportStatus(PB_INVALID_ARGUMENT, std::string(what) + " must not be null");
}

}  // namespace pitchboard::link::capi
