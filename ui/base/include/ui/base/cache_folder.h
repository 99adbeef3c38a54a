// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A folder for sessions that live as long as the studio. Any thread.

#include <QString>
#include <QTemporaryDir>
#include <memory>

namespace pitchboard::ui {

/// Makes a folder in the user's cache, which is on the disk, where the folder for temporary files
/// may be in memory; in that one if there is no cache. It goes with the object.
std::unique_ptr<QTemporaryDir> makeCacheFolder(const QString& name);

}  // namespace pitchboard::ui
