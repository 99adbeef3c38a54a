// SPDX-License-Identifier: GPL-3.0-or-later
// How every header of the project begins (CONVENTIONS.md): the licence, one inclusion, and a
// paragraph that says what it is for, so that a reader knows before the first declaration.

#include <QDirIterator>
#include <QtTest>

namespace {

const QString source = QStringLiteral(PITCHBOARD_SOURCE_DIR "/");

/// What is wrong with the beginning of a header; empty: nothing.
QString problemOf(const QByteArray& text) {
  const QList<QByteArray> lines = text.split('\n');
  if (!lines.value(0).startsWith("// SPDX-License-Identifier: GPL-3.0-or-later")) {
    return QStringLiteral("has no licence in its first line");
  }
  if (lines.value(1) != "#pragma once") {
    return QStringLiteral("has no #pragma once in its second line");
  }
  if (!lines.value(2).isEmpty()) {
    return QStringLiteral("has no empty line after #pragma once");
  }
  QByteArray paragraph;
  for (qsizetype i = 3; lines.value(i).startsWith("// "); ++i) paragraph += lines[i].mid(2);
  // Fewer words tell nothing that the name of the file does not.
  constexpr int minWords = 6;
  if (paragraph.simplified().split(' ').size() < minWords) {
    return QStringLiteral("does not begin with a paragraph that says what it is for");
  }
  return {};
}

}  // namespace

class TestHeaders : public QObject {
  Q_OBJECT
 private slots:
  void everyHeaderExplainsItsPurpose_data() {
    QTest::addColumn<QString>("folder");
    for (const char* folder : {"simcore", "telemetry", "robotlink", "ui", "app", "tests"}) {
      QTest::newRow(folder) << QString::fromLatin1(folder);
    }
  }
  void everyHeaderExplainsItsPurpose() {
    QFETCH(const QString, folder);
    QDirIterator files(source + folder, {"*.h"}, QDir::Files, QDirIterator::Subdirectories);
    QStringList wrong;
    int seen = 0;
    while (files.hasNext()) {
      const QString path = files.next();
      // Headers of a foreign program, as they were published.
      if (path.startsWith(source + QStringLiteral("tests/data/"))) continue;
      QFile file(path);
      QVERIFY(file.open(QIODevice::ReadOnly));
      ++seen;
      const QString problem = problemOf(file.readAll());
      if (!problem.isEmpty()) wrong << path.mid(source.size()) + QLatin1Char(' ') + problem;
    }
    QVERIFY2(seen > 0, "no headers found: the rule would be checked against nothing");
    QVERIFY2(wrong.isEmpty(), qPrintable(wrong.join('\n')));
  }

  void theCheckSees_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("problem");
    const QByteArray licence = "// SPDX-License-Identifier: GPL-3.0-or-later\n";
    QTest::newRow("good") << licence +
                                 "#pragma once\n\n// Where balls are kept; metres, any thread.\n"
                          << QString();
    QTest::newRow("no licence") << QByteArray("#pragma once\n\n// Where balls are kept, in m.\n")
                                << QStringLiteral("licence");
    QTest::newRow("may be included twice")
        << licence + "\n\n// Where balls are kept; metres, any.\n"
        << QStringLiteral("#pragma once");
    QTest::newRow("no paragraph") << licence + "#pragma once\n\n#include <vector>\n"
                                  << QStringLiteral("paragraph");
    QTest::newRow("a word") << licence + "#pragma once\n\n// Balls.\n"
                            << QStringLiteral("paragraph");
  }
  void theCheckSees() {
    QFETCH(const QByteArray, text);
    QFETCH(const QString, problem);
    const QString found = problemOf(text);
    QCOMPARE(found.isEmpty(), problem.isEmpty());
    QVERIFY2(found.contains(problem), qPrintable(found));
  }
};

QTEST_GUILESS_MAIN(TestHeaders)
#include "tst_headers.moc"
