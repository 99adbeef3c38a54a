// SPDX-License-Identifier: GPL-3.0-or-later
// `inspect` of folders: what it lists of a match is what the match printed when it was played and
// what `inspect` says of the file alone; files that cannot be read stay in the list; and rows are
// not read for it.
#include <QtTest>

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <algorithm>
#include <cmath>

#include <telemetry/session/session_notes.h>
#include <telemetry/session/session_reader.h>

#include "../support/program_run.h"

namespace tst_cli_inspect {

using namespace pitchboard;

class TestCliInspect : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;
  QJsonObject m_played;  // what the match printed

  QString path(const char* name) const { return m_folder.filePath(QLatin1String(name)); }
  static QJsonObject objectOf(const QByteArray& text) {
    return QJsonDocument::fromJson(text).object();
  }
  /// The line about each file, by its path.
  static QMap<QString, QJsonObject> listed(const QByteArray& out) {
    QMap<QString, QJsonObject> all;
    for (const QByteArray& line : out.split('\n')) {
      if (line.isEmpty()) continue;
      const QJsonObject one = objectOf(line);
      all[one["file"].toString()] = one;
    }
    return all;
  }

 private slots:
  void initTestCase() {
    QVERIFY(QDir(m_folder.path()).mkpath(QStringLiteral("matches/old")));
    const QStringList how{"--scenario", "match-3v3", "--seed", "12", "--duration", "1:50"};
    const ProgramRun played = cli(QStringList{"simulate", "--json"} + how);
    QVERIFY2(played.exitCode == 0, played.err.constData());
    m_played = objectOf(played.out);
    const ProgramRun run =
        cli(QStringList{"record", "-o", path("matches/old/b.mcap"), "--force"} + how);
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QVERIFY(
        telemetry::addSessionNote(path("matches/old/b.mcap").toStdString(), 3.0, "a lob, late"));
    QVERIFY(telemetry::addSessionNote(path("matches/old/b.mcap").toStdString(), 4.0, ""));
    QVERIFY(QFile::copy(QStringLiteral(PITCHBOARD_TEST_DATA "/recordings/robot_walks.mcap"),
                        path("matches/a.mcap")));
    const QByteArray whole = contents(path("matches/old/b.mcap"));
    QFile cut(path("matches/c.mcap"));
    QVERIFY(cut.open(QIODevice::WriteOnly) && cut.write(whole.left(whole.size() / 2)) > 0);
    QFile text(path("matches/d.mcap"));
    QVERIFY(text.open(QIODevice::WriteOnly) && text.write("no recording") > 0);
  }

  void aFolderIsListed() {
    const ProgramRun run = cli({"inspect", path("matches"), "--json"});
    QCOMPARE(run.exitCode, 1);  // not all of them are whole
    const auto all = listed(run.out);
    QCOMPARE(all.size(), 4);

    const QJsonObject match = all[path("matches/old/b.mcap")];
    const QJsonObject alone =
        objectOf(cli({"inspect", path("matches/old/b.mcap"), "--json", "--events"}).out);
    QVERIFY(match["readable"].toBool() && !match.contains("problem"));
    QCOMPARE(match["created"].toDouble(), alone["created"].toDouble());
    QCOMPARE(match["length"].toDouble(), alone["until"].toDouble() - alone["from"].toDouble());
    const QJsonObject score = m_played["score"].toObject();
    QVERIFY(score["left"].toInt() + score["right"].toInt() > 0);
    QCOMPARE(match["score"].toArray(), (QJsonArray{score["left"], score["right"]}));
    QCOMPARE(match["teams"].toArray(), (QJsonArray{"blue", "red"}));
    QCOMPARE(match["robots"].toArray(), (QJsonArray{"B1", "B2", "B3", "R1", "R2", "R3"}));
    QCOMPARE(match["bookmarks"].toInt(), 2);
    QCOMPARE(match["notes"].toArray(), QJsonArray{"a lob, late"});
    int events = 0;
    double goal = -1.0;
    for (const QJsonValue& event : alone["events"].toArray()) {
      events += event["kind"].toString() != QStringLiteral("bookmark");
      if (event["kind"].toString() == QStringLiteral("goal")) goal = event["time"].toDouble();
    }
    QCOMPARE(match["events"].toInt(), events);
    // The picture is that of the last goal.
    QVERIFY(goal > 0.0 && std::abs(match["telling_moment"].toDouble() - goal) < 0.2);

    const QJsonObject foreign = all[path("matches/a.mcap")], cut = all[path("matches/c.mcap")],
                      text = all[path("matches/d.mcap")];
    QVERIFY(!foreign["readable"].toBool());
    QVERIFY(foreign["problem"].toString().contains(QStringLiteral("Another program")));
    QVERIFY(cut["readable"].toBool());
    QVERIFY(cut["problem"].toString().contains(QStringLiteral("runcated")));
    QVERIFY(cut["length"].toDouble() > 10.0);
    QVERIFY(!text["readable"].toBool());
    QVERIFY(text["problem"].toString().contains(QStringLiteral("MCAP")));
  }

  void textAndCsvSayTheSame() {
    const QString file = path("matches/old/b.mcap");
    const QJsonObject score = m_played["score"].toObject();
    const int left = score["left"].toInt(), right = score["right"].toInt();
    const ProgramRun text = cli({"inspect", path("matches")});
    QCOMPARE(text.exitCode, 1);
    const QByteArray wanted = QStringLiteral("%1 : %2").arg(left).arg(right).toUtf8();
    QVERIFY2(text.out.contains(wanted) && text.out.contains("blue – red") &&
                 text.out.contains("6 robots") && text.out.contains("1 min 50 s") &&
                 text.out.contains("    a lob, late\n") && text.out.contains("Another program"),
             text.out.constData());
    const ProgramRun csv = cli({"inspect", file, "--csv"});
    QCOMPARE(csv.exitCode, 0);
    const QList<QByteArray> lines = csv.out.trimmed().split('\n');
    QCOMPARE(lines.size(), 2);
    QCOMPARE(lines[0].count(','), 10);
    QVERIFY2(lines[1].contains(QStringLiteral(",%1,%2,110.000,").arg(left).arg(right).toUtf8()) &&
                 lines[1].endsWith(",2,\"a lob, late\","),
             lines[1].constData());
  }

  void mistakesAreErrors() {
    QCOMPARE(cli({"inspect", path("matches"), "--events"}).exitCode, 2);
    QCOMPARE(cli({"inspect", path("matches"), "--csv", "--json"}).exitCode, 2);
    QVERIFY(QDir(m_folder.path()).mkpath(QStringLiteral("empty")));
    const ProgramRun none = cli({"inspect", path("empty")});
    QCOMPARE(none.exitCode, 2);
    QVERIFY2(none.err.contains("no recordings"), none.err.constData());
  }

  /// Damage in rows is not even noticed.
  void rowsAreNotRead() {
    const QString file = path("damaged.mcap");
    QVERIFY(QFile::copy(path("matches/old/b.mcap"), file));
    const auto session = telemetry::SessionReader::open(file.toStdString()).value();
    const auto& contents = session.file().contents();
    const auto events = std::ranges::find_if(
        contents.channels, [](const auto& channel) { return channel.second.topic == "/events"; });
    QVERIFY(events != contents.channels.end());
    QFile raw(file);
    QVERIFY(raw.open(QIODevice::ReadWrite));
    int damaged = 0;
    const auto& chunks = contents.chunks;
    for (std::size_t i = 0; i + 3 < chunks.size(); ++i) {
      const telemetry::McapChunkInfo& chunk = chunks[i];
      const bool hasEvents =
          std::ranges::find(chunk.channels, events->first) != chunk.channels.end();
      if (chunk.channels.empty() || hasEvents) continue;
      const auto middle = static_cast<qint64>(chunk.offset + chunk.length / 2);
      QVERIFY(raw.seek(middle) && raw.write("damage") == 6);
      ++damaged;
    }
    raw.close();
    QVERIFY(damaged > 3);
    const auto before = listed(cli({"inspect", path("matches/old"), "--json"}).out);
    QVERIFY(QDir(m_folder.path()).mkpath(QStringLiteral("one")));
    QVERIFY(QFile::rename(file, path("one/damaged.mcap")));
    const auto after = listed(cli({"inspect", path("one"), "--json"}).out);
    QJsonObject whole = before.first(), part = after.first();
    for (const char* own : {"file", "bookmarks", "notes"}) {
      whole.remove(QLatin1String(own));
      part.remove(QLatin1String(own));
    }
    QCOMPARE(part, whole);
    QCOMPARE(cli({"inspect", path("one/damaged.mcap")}).exitCode, 1);  // which reads all of it
  }
};

PITCHBOARD_TEST(TestCliInspect)

}  // namespace tst_cli_inspect

#include "tst_cli_inspect.moc"
