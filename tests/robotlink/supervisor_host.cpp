// SPDX-License-Identifier: GPL-3.0-or-later
// For tst_process_supervisor: starts children, writes a line "child PID" for each, and waits to be
// killed.
#include <unistd.h>
#include <cstdio>

#include <robotlink/processes/process_supervisor.h>

int main() {
  pitchboard::link::ProcessSupervisor supervisor;
  for (const char* script : {"exec sleep 600", "trap '' TERM HUP INT; while :; do sleep 0.1; done",
                             "while :; do :; done"}) {
    const auto handle = supervisor.start({{1}, "child", {"sh", "-c", script}});
    if (!handle) {
      std::printf("error: %s\n", handle.error().text().c_str());
      return 1;
    }
  }
  for (const auto& child : supervisor.children()) std::printf("child %d\n", child.pid);
  std::fflush(stdout);
  while (true) ::pause();
}
