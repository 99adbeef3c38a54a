// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The return type of functions that can fail for an outside reason (file, packet, system call): a
// value, or an Error that tells people what to do. Programmer errors are assertions. Plain values.

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace pitchboard {

enum class ErrorCode {
  InvalidArgument,  ///< a value given by the user or a caller cannot be used
  NotFound,         ///< a name, file, key or robot does not exist
  ParseError,       ///< text or bytes do not follow their format
  SystemError,      ///< the operating system refused
  Conflict,         ///< it exists already, or belongs to somebody else
  Unsupported       ///< valid, but this program cannot do it
};

struct Error {
  ErrorCode code = ErrorCode::InvalidArgument;
  std::string message;  ///< a sentence: what happened and what to do
  std::string context;  ///< where: file and line, offset, key; may be empty

  /// Returns "context: message", which the command line prints after "error: ".
  std::string text() const { return context.empty() ? message : context + ": " + message; }

  bool operator==(const Error&) const = default;
};

template <class T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> failure(ErrorCode code, std::string message,
                                     std::string context = {}) {
  return tl::unexpected<Error>(Error{code, std::move(message), std::move(context)});
}

}  // namespace pitchboard
