// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The same work for several parts of a picture on all cores, while the window's thread waits: for
// work of some milliseconds, shorter than a frame.

#include <functional>

namespace pitchboard::ui {

/// Calls work(0) to work(parts - 1), each once, on this thread and on idle ones of sharedWorkers();
/// returns when all are done. `work` must not throw and must not wait for another part.
void sideBySide(int parts, const std::function<void(int)>& work);

}  // namespace pitchboard::ui
