// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_errors.h"

#include <cerrno>

#include <base/system_reason.h>

namespace pitchboard {

tl::unexpected<Error> cannotMake(int reason, const std::string& path) {
  switch (reason) {
    case EEXIST:
      return failure(ErrorCode::Conflict, "This file exists; choose another name.", path);
    case ENOENT:
      return failure(ErrorCode::SystemError, "The folder does not exist; choose another folder.",
                     path);
    case EACCES:
    case EROFS:
    case EPERM:
      return failure(ErrorCode::SystemError,
                     "Cannot create files in this folder; choose another folder.", path);
    default:
      return failure(ErrorCode::SystemError,
                     "Cannot create the file: " + systemReason(reason) + ".", path);
  }
}

tl::unexpected<Error> cannotWrite(int reason, const std::string& path) {
  switch (reason) {
    case ENOSPC:
    case EDQUOT:
      return failure(ErrorCode::SystemError,
                     "The disk is full; free some space or choose another disk.", path);
    case EFBIG:
      return failure(ErrorCode::SystemError, "The file has reached the size limit.", path);
    default:
      return failure(ErrorCode::SystemError, "Cannot write the file: " + systemReason(reason) + ".",
                     path);
  }
}

}  // namespace pitchboard
