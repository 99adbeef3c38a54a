// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A program into which the dynamic linker loads nothing of ours, because it runs with the rights of
// another user.

#include <sys/stat.h>
#include <unistd.h>

#include <QFile>
#include <QTemporaryDir>

/// A copy of sleep in `folder`; empty if only root could make it.
inline QString setuidSleep(const QTemporaryDir& folder) {
  if (::geteuid() != 0) return {};
  constexpr uid_t nobody = 65534;
  const QString program = folder.filePath(QStringLiteral("sleep"));
  const bool made = QFile::copy(QStringLiteral("/bin/sleep"), program) &&
                    ::chmod(qPrintable(folder.path()), 0755) == 0 &&
                    ::chown(qPrintable(program), nobody, nobody) == 0 &&
                    ::chmod(qPrintable(program), 04755) == 0;
  if (!made) qFatal("no setuid program can be made");
  return program;
}
