// SPDX-License-Identifier: GPL-3.0-or-later
// Every form of the export dialog on a disk that is full: a sentence, the old file as it was, and
// the next export works.
#include <QDoubleSpinBox>
#include <QPushButton>
#include <QStandardPaths>

#include <ui/base/theme.h>

#include "../support/small_disk.h"
#include "export_rig.h"

namespace tst_session_export_full {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace session_rig;

class TestSessionExportFull : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void everyFormKeepsTheOldFile() {
    Studio s(120);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(120), 20'000);
    const QString session = s.recorded(60);
    QVERIFY(!session.isEmpty());
    s.window.openSession(session);
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    ExportDialog* dialog = openExport(s);
    QVERIFY(dialog != nullptr);
    small(dialog);
    // Half a second is enough to be half written.
    auto* begin = dialog->findChild<QDoubleSpinBox*>(QStringLiteral("exportBegin"));
    dialog->findChild<QDoubleSpinBox*>(QStringLiteral("exportEnd"))->setValue(begin->value() + 0.5);
    const bool video = !QStandardPaths::findExecutable(QStringLiteral("ffmpeg")).isEmpty();
    const QDir folder(s.folder.filePath(QStringLiteral("written")));
    QVERIFY(folder.mkpath(QStringLiteral(".")));
    auto* box = dialog->findChild<QComboBox*>(QStringLiteral("exportFormat"));
    QStringList names;
    for (int form = 0; form < box->count(); ++form) {
      box->setCurrentIndex(form);
      const QByteArray what = box->currentText().toUtf8();
      if (what.startsWith("Video") && !video) continue;
      names << QString::number(form) + dialog->suffix();
      const QString path = folder.filePath(names.last());
      const Ending first = exported(dialog, path);
      QVERIFY2(first.written == 1, (what + ": " + message(dialog).toUtf8()).constData());
      const auto whole = static_cast<rlim_t>(contents(path).size());
      QVERIFY2(whole > 1000, what.constData());
      // Full at once, and full when half of it is written.
      for (const rlim_t room : {rlim_t{64}, whole / 2}) {
        overwrite(path, "old");
        {
          const SmallDisk disk(room);
          const Ending ending = exported(dialog, path);
          QVERIFY2(ending.written == 0 && ending.failed == 1, what.constData());
        }
        QVERIFY2(contents(path) == "old", what.constData());
        // The file is too large here: that is what this disk has for "full".
        QVERIFY2(message(dialog).contains(QStringLiteral("reached the size limit")),
                 (what + ": " + message(dialog).toUtf8()).constData());
        QVERIFY2(!dialog->isWriting(), what.constData());
      }
      const Ending again = exported(dialog, path);
      QVERIFY2(again.written == 1 && again.failed == 0, qPrintable(message(dialog)));
      QVERIFY2(contents(path).size() > 1000, what.constData());
    }
    names.sort();
    // No parts of files, seen or hidden.
    QCOMPARE(folder.entryList(QDir::Files | QDir::Hidden, QDir::Name), names);
    const auto* button = dialog->findChild<QPushButton*>(QStringLiteral("exportButton"));
    QCOMPARE(button->text(), QStringLiteral("Export…"));
  }

  /// What is exported from memory is a session first, which finds no room either.
  void memoryThatDoesNotFitIsReported() {
    Studio s(120);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(120), 20'000);
    ExportDialog* dialog = openExport(s);
    QVERIFY(dialog != nullptr);
    for (const char* form : {"row per time", "Report"}) {
      choose(dialog, QLatin1String(form));
      const QString path = s.folder.filePath(QStringLiteral("out") + dialog->suffix());
      overwrite(path, "old");
      {
        const SmallDisk disk(64);
        const Ending ending = exported(dialog, path);
        QVERIFY2(ending.written == 0 && ending.failed == 1, form);
      }
      QVERIFY2(contents(path) == "old", form);
      QVERIFY2(message(dialog).contains(QStringLiteral("size limit")), qPrintable(message(dialog)));
      QVERIFY2(exported(dialog, path).written == 1, qPrintable(message(dialog)));
      QVERIFY2(contents(path).size() > 1000, form);
    }
    QVERIFY(parts(s.folder.path()).isEmpty());
  }
};

PITCHBOARD_GUI_TEST(TestSessionExportFull)

}  // namespace tst_session_export_full

#include "tst_session_export_full.moc"
