// SPDX-License-Identifier: GPL-3.0-or-later
#include "side_by_side.h"

#include <QSemaphore>
#include <QThreadPool>
#include <algorithm>
#include <atomic>

namespace pitchboard::ui {

void sideBySide(int parts, const std::function<void(int)>& work) {
  std::atomic<int> next{0};
  const auto takeParts = [&] {
    for (int part = next++; part < parts; part = next++) work(part);
  };
  QThreadPool* pool = QThreadPool::globalInstance();
  const int wanted = std::min(parts, pool->maxThreadCount()) - 1;
  QSemaphore finished;
  int helpers = 0;
  // A pool that is busy with long computations must not make a picture wait: only idle threads.
  while (helpers < wanted && pool->tryStart([&] {
    takeParts();
    finished.release();
  })) {
    ++helpers;
  }
  takeParts();
  finished.acquire(helpers);
}

}  // namespace pitchboard::ui
