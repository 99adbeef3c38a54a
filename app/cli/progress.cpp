// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress.h"

#include <unistd.h>
#include <cstdio>
#include <utility>

#include "interrupt.h"

namespace pitchboard::cli {
namespace {

constexpr auto interval = std::chrono::milliseconds(250);

}  // namespace

Progress::Progress(std::string what, bool wanted)
    : m_what(std::move(what)),
      m_terminal(::isatty(STDERR_FILENO) == 1),
      m_shown(wanted || m_terminal) {}

Progress::~Progress() {
  if (m_open && m_terminal) std::fprintf(stderr, "\r\033[K");
}

bool Progress::operator()(double part) {
  if (m_shown) show(std::to_string(static_cast<int>(part * 100.0)) + " %");
  return !interrupted;
}

void Progress::show(const std::string& text) {
  const auto now = std::chrono::steady_clock::now();
  if (!m_shown || (m_open && now - m_last < interval)) return;
  m_last = now;
  m_open = true;
  if (m_terminal)
    std::fprintf(stderr, "\r\033[K%s: %s", m_what.c_str(), text.c_str());
  else
    std::fprintf(stderr, "%s: %s\n", m_what.c_str(), text.c_str());
}

}  // namespace pitchboard::cli
