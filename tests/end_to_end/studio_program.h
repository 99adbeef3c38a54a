// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The studio as a program of its own, without a screen, for tests: settings, keys and ports of this
// test only. Nothing of it is left behind.

#include <QDir>
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>

#include <robotlink/blackboard/system_v.h>

#include "../support/segment_keys.h"

namespace studio_program {

class Studio : public QProcess {
 public:
  explicit Studio(const QTemporaryDir& folder) {
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("offscreen"));
    // The plugin studio_hand.
    environment.insert(QStringLiteral("QT_PLUGIN_PATH"), QStringLiteral(STUDIO_HAND_PLUGINS));
    environment.insert(QStringLiteral("QT_QPA_GENERIC_PLUGINS"), QStringLiteral("hand"));
    setProcessEnvironment(environment);
    m_common = {QStringLiteral("--settings"), folder.filePath(QStringLiteral("s.ini")),
                QStringLiteral("--key-base"), QString::number(keyBase())};
  }
  ~Studio() override {
    if (state() != NotRunning) {
      kill();
      waitForFinished();
    }
    for (const auto& segment : pitchboard::link::SystemVSegments::list(keyBase())) {
      (void)pitchboard::link::SystemVSegments::remove(segment.key);
    }
  }

  static QString program() { return QStringLiteral(PITCHBOARD_BIN "/pitchboard"); }
  QStringList with(const QStringList& arguments) const { return arguments + m_common; }
  bool launch(const QStringList& arguments) {
    start(program(), with(arguments));
    return waitForStarted();
  }
  static int keyBase() { return testKeyBase(); }
  static std::size_t segments() {
    return pitchboard::link::SystemVSegments::list(keyBase()).size();
  }
  /// Processes whose command line names one of our keys.
  static int robotProcesses() {
    int found = 0;
    for (const QString& pid : QDir(QStringLiteral("/proc")).entryList(QDir::Dirs)) {
      QFile file(QStringLiteral("/proc/%1/cmdline").arg(pid));
      if (!file.open(QIODevice::ReadOnly)) continue;
      const QByteArray line = file.readAll();
      if (line.contains("pitchboard-robot") && line.contains(QByteArray::number(keyBase() + 100))) {
        ++found;
      }
    }
    return found;
  }

 private:
  QStringList m_common;
};

}  // namespace studio_program
