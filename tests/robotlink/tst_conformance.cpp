// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/conformance/conformance.h>

#include <QDir>
#include <QTemporaryDir>
#include <QtTest>

namespace tst_conformance {

using namespace pitchboard;

class TestConformance : public QObject {
  Q_OBJECT
 private slots:
  void recordedTraceIsReproduced_data() {
    QTest::addColumn<QString>("path");
    const QDir traces(QStringLiteral(PITCHBOARD_TEST_DATA "/traces"));
    const QStringList files = traces.entryList({"*.json"}, QDir::Files, QDir::Name);
    QVERIFY(files.size() >= 90);
    for (const QString& file : files) {
      QTest::newRow(qPrintable(QFileInfo(file).baseName())) << traces.filePath(file);
    }
  }
  void recordedTraceIsReproduced() {
    QFETCH(QString, path);
    const auto report = link::runConformance(path.toStdString());
    QVERIFY2(report.has_value(), report ? "" : report.error().text().c_str());
    QVERIFY2(report->conforms(), report->firstDifference.c_str());
    QVERIFY(report->rows > 0);
    QVERIFY(report->values > report->rows);
    QVERIFY(report->largestDeviation <= link::conformanceTolerance);
  }

  void changedTraceIsReportedAsDifferent() {
    // The same recording with another start: every comparison must notice.
    QTemporaryDir folder;
    const QString name = QStringLiteral("ii_walk_kick_walk");
    const QString source = QStringLiteral(PITCHBOARD_TEST_DATA "/traces/") + name;
    QVERIFY(QFile::copy(source + ".csv.gz", folder.filePath(name + ".csv.gz")));
    QFile in(source + ".json");
    QVERIFY(in.open(QIODevice::ReadOnly));
    QByteArray text = in.readAll();
    QVERIFY(text.contains("\"x\": 320.0"));
    text.replace("\"x\": 320.0", "\"x\": 320.001");
    QFile out(folder.filePath(name + ".json"));
    QVERIFY(out.open(QIODevice::WriteOnly));
    out.write(text);
    out.close();
    const auto report = link::runConformance(out.fileName().toStdString());
    QVERIFY(report.has_value());
    QVERIFY(!report->conforms());
    QCOMPARE(QString::fromStdString(report->firstDifference),
             QStringLiteral("frame 0, r1_x: 320 recorded, 320.00099999999998 computed"));
    QVERIFY(report->largestDeviation > 0.0009);
  }

  void malformedTraceIsRefused_data() {
    QTest::addColumn<QByteArray>("json");
    QTest::addColumn<QString>("message");
    const QByteArray good =
        R"({"name":"t","frames":1,"ball":{"x":1,"y":2,"friction":0.95},"robots":[],"schedule":[]})";
    const auto without = [&good](const char* from, const char* to) {
      return QByteArray(good).replace(from, to);
    };
    QTest::newRow("empty") << QByteArray() << QStringLiteral("Not a trace: ");
    QTest::newRow("not JSON") << QByteArray("frames: 3") << QStringLiteral("Not a trace: ");
    QTest::newRow("a list") << QByteArray("[]") << QStringLiteral("must be an object in braces");
    QTest::newRow("no name") << without(R"("name":"t",)", "")
                             << QStringLiteral("bad.json:1: Not a trace: name: is missing");
    QTest::newRow("negative frames") << without(R"("frames":1)", R"("frames":-1)")
                                     << QStringLiteral("frames: must be a whole number");
    QTest::newRow("text for a number")
        << without(R"("x":1)", R"("x":"1")") << QStringLiteral("ball.x: must be a number");
    QTest::newRow("unknown operation")
        << without(R"("schedule":[])", R"("schedule":[{"frame":1,"op":"fly"}])")
        << QStringLiteral("schedule[0].op: there is no operation \"fly\"; known are");
    QTest::newRow("robot that is not there")
        << without(R"("schedule":[])",
                   R"("schedule":[{"frame":1,"op":"bkb_int","robot":1,"var":"X","value":1}])")
        << QStringLiteral("schedule[0].robot: must be a whole number from 1 to 0");
    QTest::newRow("rows are missing")
        << good << QStringLiteral("The recorded rows cannot be opened.");
  }
  void malformedTraceIsRefused() {
    QFETCH(QByteArray, json);
    QFETCH(QString, message);
    QTemporaryDir folder;
    QFile file(folder.filePath("bad.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(json);
    file.close();
    const auto report = link::runConformance(file.fileName().toStdString());
    QVERIFY(!report.has_value());
    QVERIFY2(QString::fromStdString(report.error().text()).contains(message),
             report.error().text().c_str());
    QVERIFY(QString::fromStdString(report.error().context).contains("bad"));
  }

  void damagedRowsAreRefused() {
    QTemporaryDir folder;
    const QString name = QStringLiteral("i_action_00");
    const QString source = QStringLiteral(PITCHBOARD_TEST_DATA "/traces/") + name;
    QVERIFY(QFile::copy(source + ".json", folder.filePath(name + ".json")));
    QFile rows(source + ".csv.gz");
    QVERIFY(rows.open(QIODevice::ReadOnly));
    QFile cut(folder.filePath(name + ".csv.gz"));
    QVERIFY(cut.open(QIODevice::WriteOnly));
    cut.write(rows.readAll().chopped(2000));
    cut.close();
    const auto report = link::runConformance(folder.filePath(name + ".json").toStdString());
    QVERIFY(!report.has_value());
    QVERIFY(report.error().code == ErrorCode::ParseError);
  }
};

}  // namespace tst_conformance

QTEST_GUILESS_MAIN(tst_conformance::TestConformance)

#include "tst_conformance.moc"
