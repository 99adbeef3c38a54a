// SPDX-License-Identifier: GPL-3.0-or-later
#include "side_by_side.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>

#include <ui/base/workers.h>

namespace pitchboard::ui {

void sideBySide(int parts, const std::function<void(int)>& work) {
  std::atomic<int> next{0};
  const auto takeParts = [&] {
    for (int part = next++; part < parts; part = next++) work(part);
  };
  Workers& workers = sharedWorkers();
  const int wanted = std::min(parts, static_cast<int>(workers.threads())) - 1;
  std::mutex mutex;
  std::condition_variable finished;
  int helpers = 0, ended = 0;
  // Workers that are busy with long computations must not make a picture wait: only idle threads.
  while (helpers < wanted && workers.tryStart([&] {
    takeParts();
    const std::lock_guard lock(mutex);
    ++ended;
    finished.notify_one();
  })) {
    ++helpers;
  }
  takeParts();
  std::unique_lock lock(mutex);
  finished.wait(lock, [&] { return ended == helpers; });
}

}  // namespace pitchboard::ui
