// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/unique_fd.h>

#include <unistd.h>
#include <cerrno>
#include <utility>

namespace pitchboard {

void UniqueFd::reset(int value) {
  const int old = std::exchange(m_value, value);
  if (old < 0) return;
  const int reason = errno;
  ::close(old);
  errno = reason;
}

}  // namespace pitchboard
