// SPDX-License-Identifier: GPL-3.0-or-later
#include <base/descriptor.h>

#include <unistd.h>
#include <cerrno>
#include <utility>

namespace pitchboard {

void Descriptor::reset(int value) {
  const int old = std::exchange(m_value, value);
  if (old < 0) return;
  const int reason = errno;
  ::close(old);
  errno = reason;
}

}  // namespace pitchboard
