// SPDX-License-Identifier: GPL-3.0-or-later
// The index of the library: what was written is read again, and of a damaged or strange file only
// what is intact.
#include <QtTest>

#include <cmath>

#include <robotlink/library/session_index.h>

namespace tst_session_index {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

IndexedSession made(const std::string& path) {
  IndexedSession one{path, {12'345, 1'700'000'000'123'456'789, 7}, {}};
  one.overview.isReadable = true;
  one.overview.created = telemetry::WallTime(std::chrono::milliseconds(1'700'000'000'250));
  one.overview.source = "live";
  one.overview.title = "Final \"2026\"\nsecond half";
  one.overview.length = 612.25;
  one.overview.teams = {"RoboFEI", "Gäste"};
  one.overview.score = {3, 1};
  one.overview.robots = {"B1", "R4"};
  one.overview.events = 41;
  one.overview.bookmarks = 2;
  one.overview.notes = {"late, but in"};
  one.overview.telling = 601.5;
  return one;
}

}  // namespace

class TestSessionIndex : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

  std::string file() const { return m_folder.filePath("index.jsonl").toStdString(); }
  void write(const QByteArray& bytes) const {
    QFile out(QString::fromStdString(file()));
    QVERIFY(out.open(QIODevice::WriteOnly) && out.write(bytes) == bytes.size());
  }
  QByteArray written() const {
    QFile in(QString::fromStdString(file()));
    return in.open(QIODevice::ReadOnly) ? in.readAll() : QByteArray();
  }

 private slots:
  void whatIsWrittenIsRead() {
    IndexedSession bad{"/b.mcap", {3, 4, 0}, {}};
    bad.overview.problem = "This is not an MCAP file.";
    const std::vector<IndexedSession> sessions{made("/a \"b\".mcap"), bad};
    QVERIFY(writeSessionIndex(file(), sessions));
    QVERIFY(readSessionIndex(file()) == sessions);
    QVERIFY(readSessionIndex(m_folder.filePath("none").toStdString()).empty());
    QCOMPARE(teamsText(sessions[0].overview), std::string("RoboFEI – Gäste"));
    QCOMPARE(scoreText(sessions[0].overview), std::string("3 : 1"));
    QVERIFY(scoreText(bad.overview).empty() && teamsText(bad.overview).empty());
  }

  void damageCostsItsLine() {
    QVERIFY(writeSessionIndex(file(), std::vector{made("/a"), made("/b"), made("/c")}));
    QList<QByteArray> lines = written().split('\n');
    QCOMPARE(lines.size(), 5);
    lines[2].replace("\"live\"", "\"live");
    write(lines.join('\n'));
    const auto left = readSessionIndex(file());
    QCOMPARE(left.size(), std::size_t(2));
    QVERIFY(left[0] == made("/a") && left[1] == made("/c"));
    lines[0].replace("\"version\":1", "\"version\":2");
    write(lines.join('\n'));
    QVERIFY(readSessionIndex(file()).empty());
  }

  void strangeValuesAreHarmless() {
    QVERIFY(writeSessionIndex(file(), {}));
    write(written() +
          R"({"file":"/x","readable":true,"created":1e300,"length":-5,"score":[1e99,2],)"
          R"("robots":{"a":1},"notes":[1,null,"n"],"events":-1,"bytes":-1})" +
          "\n" + QByteArray(100'000, '[') + "\n{\"file\":7,\"readable\":true}\n");
    const auto found = readSessionIndex(file());
    QCOMPARE(found.size(), std::size_t(1));
    const SessionOverview& overview = found[0].overview;
    QVERIFY(overview.created == telemetry::WallTime() && overview.length == 0.0);
    QVERIFY(!overview.score && overview.robots.empty() && overview.events == 0);
    QCOMPARE(overview.notes, std::vector<std::string>{"n"});
  }
};

PITCHBOARD_TEST(TestSessionIndex)

}  // namespace tst_session_index

#include "tst_session_index.moc"
