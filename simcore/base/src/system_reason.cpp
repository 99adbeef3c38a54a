// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/system_reason.h>

#include <system_error>

namespace pitchboard {

std::string systemReason(int error) {
  return std::generic_category().message(error);
}

}  // namespace pitchboard
