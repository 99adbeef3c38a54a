// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The export dialog of the window, as tests use it. UI thread.

#include <QComboBox>
#include <QDir>
#include <QEventLoop>
#include <QFile>
#include <QLabel>
#include <QTimer>

#include <ui/session/export_dialog.h>

#include "../support/program_run.h"
#include "session_rig.h"

namespace session_rig {

inline ExportDialog* openExport(Studio& s) {
  s.action("exportSession")->trigger();
  return s.window.findChild<ExportDialog*>(QStringLiteral("exportDialog"));
}

inline void choose(ExportDialog* dialog, const QString& form) {
  auto* box = dialog->findChild<QComboBox*>(QStringLiteral("exportFormat"));
  for (int i = 0; i < box->count(); ++i) {
    if (box->itemText(i).contains(form)) box->setCurrentIndex(i);
  }
  QVERIFY2(box->currentText().contains(form), qPrintable(form));
}

inline QString message(ExportDialog* dialog) {
  return dialog->findChild<QLabel*>(QStringLiteral("exportMessage"))->text();
}

/// Chooses the smallest size.
inline void small(ExportDialog* dialog) {
  auto* size = dialog->findChild<QComboBox*>(QStringLiteral("exportSize"));
  size->setCurrentIndex(size->findData(QSize(640, 360)));
}

inline void overwrite(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
}

struct Ending {
  int written = 0, failed = 0;
};

/// Exports and waits for the end. In a loop of events of its own: QTRY_ sleeps between events, and
/// a video goes to ffmpeg by as many of them as its pipe is small.
inline Ending exported(ExportDialog* dialog, const QString& path) {
  Ending ending;
  QEventLoop loop;
  QTimer::singleShot(60'000, &loop, &QEventLoop::quit);
  QObject::connect(dialog, &ExportDialog::written, &loop, [&] { ++ending.written, loop.quit(); });
  QObject::connect(dialog, &ExportDialog::failed, &loop, [&] { ++ending.failed, loop.quit(); });
  dialog->exportTo(path);
  if (ending.written + ending.failed == 0) loop.exec();
  return ending;
}

/// What unfinished writers would leave.
inline QStringList parts(const QString& folder) {
  return QDir(folder).entryList({QStringLiteral("*.part")}, QDir::Files | QDir::Hidden);
}

}  // namespace session_rig
