// SPDX-License-Identifier: GPL-3.0-or-later
// The command line records a match, goes on from a moment of it, and writes its report.
#include <QtTest>

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <cmath>

#include "../support/program_run.h"

namespace tst_cli_moments {

namespace {

using Run = ProgramRun;

/// The probability of at least `least` successes in `trials`, by the binomial formula.
double atLeast(int least, int trials, double p) {
  double sum = 0.0;
  for (int k = least; k <= trials; ++k) {
    const double ways = std::lgamma(trials + 1.0) - std::lgamma(k + 1.0) -
                        std::lgamma(static_cast<double>(trials - k) + 1.0);
    sum += std::exp(ways + k * std::log(p) + (trials - k) * std::log1p(-p));
  }
  return sum;
}

}  // namespace

class TestCliMoments : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  QString m_session;

 private slots:
  void initTestCase() {
    m_session = m_folder.filePath("match.mcap");
    const Run run = cli({"record", "--duration", "12", "--noise", "paper", "-o", m_session});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const Run again = cli({"record", "--duration", "1", "-o", m_session});
    QCOMPARE(again.exitCode, 2);
  }

  void aMomentIsContinued() {
    const QString moment = m_folder.filePath("moment.json");
    const Run run = cli({"simulate", "--from", m_session, "--at", "5", "--duration", "3", "--json",
                         "--save-moment", moment});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QFile file(moment);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray text = file.readAll();
    QVERIFY2(text.contains("at 8.0 s"), text.left(300).constData());
    // The same again: entered exactly, and played from there without chance.
    const QString second = m_folder.filePath("moment2.json");
    QCOMPARE(cli({"simulate", "--from", m_session, "--at", "0:05", "--duration", "0:03",
                  "--save-moment", second})
                 .exitCode,
             0);
    QFile other(second);
    QVERIFY(other.open(QIODevice::ReadOnly));
    QCOMPARE(other.readAll(), text);
  }

  /// What its robots had done before belongs to the recording.
  void whatRobotsDidCountsFromTheMoment() {
    const Run run =
        cli({"simulate", "--from", m_session, "--at", "5", "--duration", "0.1", "--json"});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const auto robots = QJsonDocument::fromJson(run.out).object()["robots"].toArray();
    QVERIFY(!robots.isEmpty());
    for (const QJsonValue& robot : robots) {
      QVERIFY2(robot["distance_m"].toDouble(-1) >= 0 && robot["distance_m"].toDouble() < 0.1,
               run.out.constData());
    }
  }

  /// A goal was scored; in other runs the keeper is luckier. The ends of an exact interval are
  /// those rates for which the result, or a more extreme one, has a probability of 2.5 %.
  void outcomesAreRatesWithExactIntervals() {
    const QString scenario = m_folder.filePath("duel.json"),
                  session = m_folder.filePath("duel.mcap");
    QFile file(scenario);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(R"({"version": 1, "name": "duel", "noise": "realistic", "ball": {"x": 2.6, "y": 0.3},
      "robots": [
        {"team": "blue", "number": 1, "x": 2.3, "y": 0.3, "heading": 0, "behaviour": "striker"},
        {"team": "red", "number": 1, "x": 4.2, "y": 0, "heading": 180, "behaviour": "keeper"}],
      "stop": {"goal": true}, "writes": [{"time": 0, "variable": "COM_REFEREE", "value": 2}]})");
    file.close();
    QCOMPARE(
        cli({"record", "--scenario", scenario, "--seed", "9", "--duration", "30", "-o", session})
            .exitCode,
        0);
    const QStringList whatIf{"simulate", "--from",   session,     "--at",   "4",  "--duration",
                             "15",       "--follow", "blue,ball", "--runs", "40", "--json"};
    const Run run = cli(whatIf);
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const QJsonObject result = QJsonDocument::fromJson(run.out).object();
    QCOMPARE(result["recorded"]["goal"], QJsonValue("left"));
    QCOMPARE(result["believed"], QJsonValue(false));
    int all = 0, inner = 0;
    for (const QJsonValue& outcome : result["outcomes"].toArray()) {
      const int hits = outcome["runs"].toInt();
      const double low = outcome["interval"][0].toDouble(),
                   high = outcome["interval"][1].toDouble();
      all += hits;
      QCOMPARE(outcome["rate"].toDouble(), hits / 40.0);
      if (hits > 0) QVERIFY(std::abs(atLeast(hits, 40, low) - 0.025) < 1e-6);
      if (hits < 40) QVERIFY(std::abs(1.0 - atLeast(hits + 1, 40, high) - 0.025) < 1e-6);
      inner += hits > 0 && hits < 40;
    }
    QCOMPARE(all, 40);
    QVERIFY(inner >= 2);
    QVERIFY(!result["let_go_s"].toArray().isEmpty());
    QCOMPARE(cli(whatIf).out, run.out);
    // A single match tells when and why.
    const QByteArray one = cli(whatIf.mid(0, 9)).out;
    QVERIFY2(one.contains("Let go     at "), one.constData());
    const Run nobody = cli(whatIf.mid(0, 8) + QStringList{"B7"});
    QCOMPARE(nobody.exitCode, 2);
    QVERIFY2(nobody.err.contains("there is no robot, team or ball \"B7\""), nobody.err.constData());
  }

  void badRequestsAreSentences_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("words");
    QTest::newRow("before the beginning")
        << QStringList{"simulate", "--from", "SESSION", "--at", "-3"}
        << "is outside the session, which goes from 0:00 to 0:12";
    QTest::newRow("behind the end")
        << QStringList{"simulate", "--from", "SESSION", "--at", "9999"}
        << "--at: \"9999\" is outside the session, which goes from 0:00 to 0:12";
    QTest::newRow("another day") << QStringList{"simulate", "--from", "SESSION", "--at",
                                                "1999-12-31 14:03:20"}
                                 << "is outside the session";
    QTest::newRow("report of nothing")
        << QStringList{"export", "SESSION", "--to", "report", "-o", "x.html", "--from", "14:03:20"}
        << "for a time of day add its date or --clock";
    QTest::newRow("no time") << QStringList{"simulate", "--from", "SESSION"} << "--at";
    QTest::newRow("both") << QStringList{"simulate", "--from", "SESSION", "--at",
                                         "1",        "--seed", "3"}
                          << "--seed";
    QTest::newRow("no file") << QStringList{"simulate", "--from", "/nonexistent.mcap", "--at", "1"}
                             << "/nonexistent.mcap";
    QTest::newRow("report without a file")
        << QStringList{"export", "SESSION", "--to", "report"} << "-o FILE.html";
  }
  void badRequestsAreSentences() {
    QFETCH(QStringList, arguments);
    QFETCH(QString, words);
    arguments.replaceInStrings("SESSION", m_session);
    const Run run = cli(arguments);
    QCOMPARE(run.exitCode, 2);
    QVERIFY2(run.err.startsWith("error: ") && run.err.contains(words.toUtf8()),
             run.err.constData());
  }

  void theReportIsWritten() {
    const QString path = m_folder.filePath("report.html");
    const Run run = cli({"export", m_session, "--to", "report", "-o", path});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QFile file(path);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray html = file.readAll();
    // The studio paints; a build without it says so.
    const char* picture = QFile::exists(QStringLiteral(PITCHBOARD_BIN "/pitchboard"))
                              ? "data:image/svg+xml;base64,"
                              : "Could not paint the field";
    for (const char* words :
         {"<!DOCTYPE html>", picture, ">B1<", "Belief error", "0:12 of play recorded"}) {
      QVERIFY2(html.contains(words), words);
    }
    QCOMPARE(cli({"export", m_session, "--to", "report", "-o", path}).exitCode, 2);
    if (const QByteArray keep = qgetenv("PITCHBOARD_KEEP_REPORT"); !keep.isEmpty()) {
      QFile::remove(QString::fromUtf8(keep));
      QVERIFY(file.copy(QString::fromUtf8(keep)));
    }
  }
};

PITCHBOARD_TEST(TestCliMoments)

}  // namespace tst_cli_moments

#include "tst_cli_moments.moc"
