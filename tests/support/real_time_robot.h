// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A robot whose one program keeps the computer's clock, and so cannot follow a match at another
// speed than ×1: because its profile says so, or because nothing can be loaded into it.

#include <QFile>
#include <QTemporaryDir>

#include <robotlink/scenario/scenario.h>

/// A profile of one program, which is called with 600, written into `folder`.
inline QString profileOfOne(const QTemporaryDir& folder, const QString& program,
                            const char* clock) {
  QFile file(folder.filePath(QStringLiteral("own.json")));
  if (!file.open(QIODevice::WriteOnly)) qFatal("no profile can be written");
  file.write(R"({"version": 1, "name": "own", "processes": [{"name": "decision", "command": [")" +
             program.toUtf8() + R"(", "600"], "clock": ")" + clock + R"("}]})");
  return file.fileName();
}
inline QString realTimeProfile(const QTemporaryDir& folder) {
  return profileOfOne(folder, QStringLiteral("/bin/sleep"), "real");
}

/// The scenario one-robot, played by it.
inline pitchboard::link::Scenario realTimeRobot(const QTemporaryDir& folder) {
  auto scenario = pitchboard::link::loadScenario("one-robot").value();
  scenario.robots[0].runtime.profile = realTimeProfile(folder).toStdString();
  return scenario;
}
