// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A robot whose one program keeps the computer's clock, and so cannot follow a match at another
// speed than ×1.

#include <QFile>
#include <QTemporaryDir>

#include <robotlink/scenario/scenario.h>

/// The profile, written into `folder`.
inline QString realTimeProfile(const QTemporaryDir& folder) {
  QFile file(folder.filePath(QStringLiteral("own.json")));
  if (!file.open(QIODevice::WriteOnly)) qFatal("no profile can be written");
  file.write(R"({"version": 1, "name": "own", "processes": [{"name": "decision",
    "command": ["/bin/sleep", "600"], "clock": "real"}]})");
  return file.fileName();
}

/// The scenario one-robot, played by it.
inline pitchboard::link::Scenario realTimeRobot(const QTemporaryDir& folder) {
  auto scenario = pitchboard::link::loadScenario("one-robot").value();
  scenario.robots[0].runtime.profile = realTimeProfile(folder).toStdString();
  return scenario;
}
