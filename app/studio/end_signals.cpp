// SPDX-License-Identifier: GPL-3.0-or-later
#include "end_signals.h"

#include <fcntl.h>
#include <unistd.h>
#include <QSocketNotifier>
#include <csignal>

namespace pitchboard::studio {
namespace {

// A signal handler may do little more than write to a pipe, and finds it only by a global.
int pipeEnds[2] = {-1, -1};

void wakeUp(int) {
  const char byte = 1;
  const auto written = write(pipeEnds[1], &byte, 1);
  static_cast<void>(written);
}

}  // namespace

EndSignals::EndSignals(QObject* parent) : QObject(parent) {
  if (pipe2(pipeEnds, O_CLOEXEC | O_NONBLOCK) != 0) return;
  auto* notifier = new QSocketNotifier(pipeEnds[0], QSocketNotifier::Read, this);
  connect(notifier, &QSocketNotifier::activated, this, [this] {
    char byte = 0;
    while (read(pipeEnds[0], &byte, 1) == 1) {
    }
    emit received();
  });
  struct sigaction action {};
  action.sa_handler = wakeUp;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

EndSignals::~EndSignals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  for (int& end : pipeEnds) {
    if (end >= 0) ::close(end);
    end = -1;
  }
}

}  // namespace pitchboard::studio
