// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/cache_folder.h>

#include <QDir>
#include <QStandardPaths>

namespace pitchboard::ui {

std::unique_ptr<QTemporaryDir> makeCacheFolder(const QString& name) {
  const QString cache = QStandardPaths::writableLocation(QStandardPaths::CacheLocation);
  if (!cache.isEmpty() && QDir().mkpath(cache)) {
    auto made = std::make_unique<QTemporaryDir>(cache + QStringLiteral("/%1-XXXXXX").arg(name));
    if (made->isValid()) return made;
  }
  return std::make_unique<QTemporaryDir>();
}

}  // namespace pitchboard::ui
