// SPDX-License-Identifier: GPL-3.0-or-later
// For tst_process_manager: starts children that start others, writes a line "child PID" for each,
// and waits to be killed. Arguments: pitchboard-robot, and the key of a segment that it makes.
#include <unistd.h>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/processes/process_manager.h>

using namespace pitchboard::link;

namespace {

int fail(const pitchboard::Error& error) {
  std::printf("error: %s\n", error.text().c_str());
  return 1;
}

}  // namespace

int main(int, char** argv) {
  auto board = SystemVSegments::open(std::atoi(argv[2]), AttachMode::AttachOrCreate);
  if (!board) return fail(board.error());
  ProcessManager manager(argv[1]);
  if (const auto kept = manager.keepGuard(); !kept) return fail(kept.error());
  manager.guardSegment(*board);
  const auto add = [&](const char* script, bool isTeamProgram) {
    ManagedProcess process;
    process.spec = {{1}, "child", {"sh", "-c", script}};
    process.spec.isTeamProgram = isTeamProgram;
    return manager.add(process, *board, std::chrono::steady_clock::now());
  };
  for (const char* script :
       {"setsid sh -c 'sleep 600 & echo child $!'; exec sleep 600",
        "sleep 600 & echo child $!; wait", "echo child $$; exec sleep 600",
        "env -i setsid sh -c 'sleep 600 & echo child $!; exec >&- 2>&-; wait' & exec sleep 600"}) {
    if (const auto started = add(script, true); !started) return fail(started.error());
  }
  for (const char* script : {"echo child $$; exec sleep 600",
                             "trap '' TERM HUP INT; echo child $$; while :; do sleep 0.1; done",
                             "echo child $$; while :; do :; done"}) {
    if (const auto started = add(script, false); !started) return fail(started.error());
  }
  while (true) {
    (void)manager.step(std::chrono::steady_clock::now());
    for (const ProcessLine& line : manager.drainLines()) std::printf("%s\n", line.text.c_str());
    std::fflush(stdout);
    ::usleep(10'000);
  }
}
