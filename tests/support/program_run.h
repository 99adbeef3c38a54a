// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One run of one of our programs to its end, as at a terminal.

#include <QFile>
#include <QProcess>

struct ProgramRun {
  int exitCode = -1;  ///< -1: it crashed or did not end
  QByteArray out, err;
};

/// `name`: of a program of the build, such as "pitchboard-cli". `input`: all that it can read.
inline ProgramRun runProgram(const char* name, const QStringList& arguments,
                             const QByteArray& input = {}) {
  constexpr int longest_ms = 120'000;
  QProcess process;
  process.start(QStringLiteral(PITCHBOARD_BIN "/") + QLatin1String(name), arguments);
  process.write(input);
  process.closeWriteChannel();
  if (!process.waitForFinished(longest_ms)) return {};
  return {process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -1,
          process.readAllStandardOutput(), process.readAllStandardError()};
}

inline ProgramRun cli(const QStringList& arguments) {
  return runProgram("pitchboard-cli", arguments);
}

/// Of a file; empty if it cannot be read.
inline QByteArray contents(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}
