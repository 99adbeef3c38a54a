// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// While it lives, no file of this program, or of one that it starts, grows beyond so many bytes:
// for tests of what is left after a disk was full.

#include <sys/resource.h>

#include <csignal>

class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : m_signal(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &m_before);
    const rlimit less{bytes, m_before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &less);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &m_before);
    std::signal(SIGXFSZ, m_signal);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit m_before{};
  void (*m_signal)(int);
};
