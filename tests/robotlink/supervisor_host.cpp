// SPDX-License-Identifier: GPL-3.0-or-later
// For tst_process_supervisor and tst_process_manager: starts children, writes a line "child PID"
// for each, and waits to be killed. With a program for the guard and a key it also makes that
// segment, and its children start others that leave their group.
#include <unistd.h>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/processes/process_supervisor.h>

using namespace pitchboard::link;

namespace {

int fail(const pitchboard::Error& error) {
  std::printf("error: %s\n", error.text().c_str());
  return 1;
}

int guarded(const std::string& program, int key) {
  auto board = SystemVSegments::open(key, AttachMode::AttachOrCreate);
  if (!board) return fail(board.error());
  ProcessSupervisor supervisor;
  if (const auto kept = supervisor.keepGuard(program); !kept) return fail(kept.error());
  supervisor.guardSegment(*board);
  for (const char* script : {"setsid sh -c 'sleep 600 & echo child $!'; exec sleep 600",
                             "sleep 600 & echo child $!; wait", "echo child $$; exec sleep 600"}) {
    ChildSpec spec{{1}, "child", {"sh", "-c", script}};
    spec.foreign = true;
    if (const auto started = supervisor.start(spec); !started) return fail(started.error());
  }
  while (true) {
    supervisor.poll();
    for (const ChildLine& line : supervisor.takeLines()) std::printf("%s\n", line.text.c_str());
    std::fflush(stdout);
    ::usleep(10'000);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3) return guarded(argv[1], std::atoi(argv[2]));
  ProcessSupervisor supervisor;
  for (const char* script : {"exec sleep 600", "trap '' TERM HUP INT; while :; do sleep 0.1; done",
                             "while :; do :; done"}) {
    const auto handle = supervisor.start({{1}, "child", {"sh", "-c", script}});
    if (!handle) return fail(handle.error());
  }
  for (const auto& child : supervisor.children()) std::printf("child %d\n", child.pid);
  std::fflush(stdout);
  while (true) ::pause();
}
