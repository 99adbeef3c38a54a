// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Ports on 127.0.0.1 for a watch in a test.

#include <robotlink/live/live_watch.h>

#include "../support/test_socket.h"

/// Ports of this test that nobody has at this moment: `robots` after a base and the referee's.
/// Variables are not received; as many ports behind the referee's are free for them.
inline pitchboard::link::LiveOptions freeOptions(int robots = 3) {
  for (int attempt = 0; attempt < 200; ++attempt) {
    const int base = TestSocket().port();
    const int count = 2 * robots + 1;
    bool free = base + count < 65536;
    for (int i = 1; free && i <= count; ++i) {
      free = TestSocket(INADDR_LOOPBACK, base + i).good();
    }
    if (!free) continue;
    pitchboard::link::LiveOptions made;
    made.bind = {INADDR_LOOPBACK};
    made.portBase = base;
    made.robots = robots;
    made.refereePort = base + robots + 1;
    made.variablesPortBase = 0;
    return made;
  }
  qFatal("no free ports");
}
