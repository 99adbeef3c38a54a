// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a function that can fail for an outside reason (file, packet, argument, system call)
// returns: a value or an Error that a person can act on. Programmer errors are assertions instead.

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace pitchboard {

enum class ErrorCode {
  InvalidArgument,  ///< a value given by the user or a caller cannot be used
  NotFound,         ///< a name, file, key or robot does not exist
  ParseError,       ///< text or bytes do not follow their format
  SystemError,      ///< the operating system refused
  Conflict,         ///< exists already, or belongs to somebody else
  Unsupported       ///< understood, but not something that this program does
};

struct Error {
  ErrorCode code = ErrorCode::InvalidArgument;
  std::string message;  ///< a sentence: what happened and what to do
  std::string context;  ///< where: file and line, offset, key; empty when the sentence says it

  /// "context: message", as the command-line tools print it after "error: ".
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
