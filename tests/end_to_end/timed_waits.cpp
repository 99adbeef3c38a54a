// SPDX-License-Identifier: GPL-3.0-or-later
// Waits with a time limit of a second each, and says when one of them has returned.
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>

int main() {
  using namespace std::chrono_literals;
  const auto report = [](const char* what) {
    std::puts(what);
    std::fflush(stdout);
  };
  std::condition_variable condition;
  std::mutex mutex;
  std::unique_lock lock(mutex);
  const auto never = [] { return false; };
  report("began");
  condition.wait_for(lock, 1s, never);
  report("wait_for");
  condition.wait_until(lock, std::chrono::steady_clock::now() + 1s, never);
  report("wait_until");
  while (true) condition.wait_for(lock, 60s, never);
}
