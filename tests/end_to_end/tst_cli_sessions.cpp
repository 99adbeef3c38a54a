// SPDX-License-Identifier: GPL-3.0-or-later
// record, inspect, export and repair as people run them; what comes out is compared with the rows
// that the session holds.
#include <QtTest>

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <bit>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <map>

#include <telemetry/session/session_reader.h>

#include "../support/program_run.h"
#include "../support/session_values.h"

namespace tst_cli_sessions {

using namespace pitchboard;
using namespace pitchboard::telemetry;

namespace {

const QString program = QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli");
constexpr TimeRange always{-1e9, 1e9};

using Run = ProgramRun;

/// A float is written with as few digits as give its 32 bits back.
bool same(double a, double b) {
  if (const auto single = static_cast<float>(b); double(single) == b)
    return static_cast<float>(a) == single;
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

/// As the exports write numbers; NaN for what is unknown.
double numberOf(const QByteArray& text) {
  return text.isEmpty() ? std::nan("") : std::strtod(text.constData(), nullptr);
}

/// By time, robot and variable.
using Values = std::map<std::tuple<double, std::string, std::string>, double>;

Values valuesOf(const QString& path, TimeRange range, const std::vector<std::string>& robots = {},
                const std::vector<std::string>& variables = {}) {
  Values out;
  const auto session = SessionReader::open(path.toStdString());
  if (!session) return out;
  const auto wanted = [](const std::vector<std::string>& names, const std::string& name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  };
  session->rows(range, {}, [&](GroupId id, const RowView& row) {
    const GroupInfo& info = session->groups()[id].info;
    if (!wanted(robots, info.name)) return true;
    for (std::size_t i = 0; i < info.columns.size(); ++i) {
      if (!wanted(variables, info.columns[i].name)) continue;
      out[{row.time, info.name, info.columns[i].name}] = valueOf(info, row, i);
    }
    return true;
  });
  return out;
}

void compare(const Values& found, const Values& wanted) {
  QCOMPARE(found.size(), wanted.size());
  for (auto a = found.begin(), b = wanted.begin(); a != found.end(); ++a, ++b) {
    const auto& [time, robot, name] = b->first;
    QVERIFY2(a->first == b->first && same(a->second, b->second),
             qPrintable(QString("%1 s %2.%3: %4, not %5")
                            .arg(time)
                            .arg(robot.c_str(), name.c_str())
                            .arg(a->second)
                            .arg(b->second)));
  }
}

}  // namespace

class TestCliSessions : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  QString m_session;
  int m_files = 0;

  QString newPath(const char* ending) {
    return m_folder.filePath(QString::number(++m_files) + ending);
  }

 private slots:
  void initTestCase() {
    m_session = m_folder.filePath("match.mcap");
    const Run run = cli({"record", "--scenario", "match-3v3", "--duration", "10", "--noise",
                         "realistic", "--seed", "7", "-o", m_session});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QVERIFY2(run.out.contains("10.000 s, 4207 rows"), run.out.constData());
  }

  void inspectListsTheContents() {
    const Run run = cli({"inspect", m_session, "--json", "--events"});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const QJsonObject json = QJsonDocument::fromJson(run.out).object();
    const auto session = SessionReader::open(m_session.toStdString());
    QVERIFY(json["complete"].toBool());
    QCOMPARE(json["source"].toString(), QStringLiteral("simulation"));
    QCOMPARE(json["seed"].toInt(), 7);
    QCOMPARE(json["from"].toDouble(), 0.0);
    QVERIFY(std::abs(json["until"].toDouble() - 10.0) < 1e-6);
    QCOMPARE(json["bytes"].toInteger(), QFileInfo(m_session).size());
    const QJsonArray groups = json["groups"].toArray();
    QCOMPARE(groups.size(), 7);
    for (const QJsonValue& group : groups) QCOMPARE(group["rows"].toInt(), 601);
    QCOMPARE(json["events"].toArray().size(), static_cast<qsizetype>(session->events().size()));
    QVERIFY(json["messages"]["checkpoints"].toInt() >= 10);
    QCOMPARE(json["attachments"].toArray().size(), 2);
    QVERIFY(json["notes"].toArray().isEmpty());
  }

  void wideCsvHasEveryValue() {
    const QString path = newPath(".csv");
    const Run run = cli({"export", m_session, "--to", "csv-wide", "-o", path});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    Values found;
    std::vector<std::pair<std::string, std::string>> names;
    for (const QByteArray& line : contents(path).split('\n')) {
      const QList<QByteArray> cells = line.split(',');
      if (names.empty()) {
        for (const QByteArray& cell : cells) {
          const auto dot = cell.indexOf('.');
          names.emplace_back(cell.left(dot).toStdString(), cell.mid(dot + 1).toStdString());
        }
        continue;
      }
      if (line.isEmpty()) continue;
      QCOMPARE(cells.size(), static_cast<qsizetype>(names.size()));
      for (qsizetype i = 1; i < cells.size(); ++i) {
        const auto& [robot, name] = names[static_cast<std::size_t>(i)];
        if (!cells[i].isEmpty()) found[{numberOf(cells[0]), robot, name}] = numberOf(cells[i]);
      }
    }
    Values known = valuesOf(m_session, always);
    std::erase_if(known, [](const auto& one) { return std::isnan(one.second); });
    compare(found, known);
  }

  void longCsvHasTheSelectedVariables() {
    const QString path = newPath(".csv");
    const Run run =
        cli({"export", m_session, "--to", "csv-long", "--robots", "B1,R2", "--variables",
             "TRUE_X,VISION_BALL_DIST,BELIEF_ERROR", "--from", "2", "--until", "5", "-o", path});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    Values found;
    const QList<QByteArray> lines = contents(path).split('\n');
    QCOMPARE(lines.first(), QByteArray("time,robot,variable,value"));
    for (const QByteArray& line : lines.mid(1)) {
      const QList<QByteArray> cells = line.split(',');
      if (cells.size() == 4) {
        found[{numberOf(cells[0]), cells[1].toStdString(), cells[2].toStdString()}] =
            numberOf(cells[3]);
      }
    }
    QCOMPARE(found.size(), std::size_t{181 * 2 * 3});
    compare(found, valuesOf(m_session, {2, 5}, {"B1", "R2"},
                            {"TRUE_X", "VISION_BALL_DIST", "BELIEF_ERROR"}));
  }

  void jsonLinesHaveRowsAndMessages() {
    const Run run =
        cli({"export", m_session, "--to", "jsonl", "--robots", "match", "--until", "4"});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    Values found;
    int events = 0;
    for (const QByteArray& line : run.out.split('\n')) {
      if (line.isEmpty()) continue;
      const QJsonObject json = QJsonDocument::fromJson(line).object();
      QVERIFY2(json["time"].isDouble(), line.constData());
      if (json["stream"] == "events") ++events;
      const QJsonObject values = json["values"].toObject();
      for (auto value = values.begin(); value != values.end(); ++value) {
        found[{json["time"].toDouble(), json["robot"].toString().toStdString(),
               value.key().toStdString()}] = value->isNull() ? std::nan("") : value->toDouble();
      }
    }
    compare(found, valuesOf(m_session, {-1, 4}, {"match"}));
    const auto all = SessionReader::open(m_session.toStdString())->events();
    QCOMPARE(events, static_cast<int>(std::count_if(all.begin(), all.end(), [](const auto& event) {
               return event.time <= 4.0 && event.group.empty();  // of no robot
             })));
  }

  void aClipIsASession() {
    const QString path = newPath(".mcap");
    const Run run = cli({"export", m_session, "--to", "mcap", "--from", "3", "--until", "6",
                         "--robots", "B2,match", "-o", path});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    compare(valuesOf(path, always), valuesOf(m_session, {3, 6}, {"B2", "match"}));
    QCOMPARE(cli({"inspect", path}).exitCode, 0);
  }

  void aCutFileIsRepaired() {
    const QString broken = newPath(".mcap"), whole = newPath(".mcap");
    const QByteArray bytes = contents(m_session);
    const auto session = SessionReader::open(m_session.toStdString());
    const auto& chunks = session->file().contents().chunks;
    const auto cut = std::find_if(chunks.begin() + static_cast<std::ptrdiff_t>(chunks.size() / 2),
                                  chunks.end(), [](const auto& one) { return one.end != 0; });
    const auto size = static_cast<qsizetype>(cut->offset + cut->length / 2);
    QFile file(broken);
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes.left(size)) == size);
    file.close();
    const Run look = cli({"inspect", broken});
    QCOMPARE(look.exitCode, 1);
    QVERIFY2(look.out.contains("pitchboard-cli repair"), look.out.constData());
    const Run run = cli({"repair", broken, whole});
    QVERIFY2(run.exitCode == 1, run.err.constData());  // its end is missing
    QVERIFY2(run.err.contains("cut off") && run.err.contains("lost, "), run.err.constData());
    QCOMPARE(contents(broken).size(), size);
    QCOMPARE(cli({"inspect", whole}).exitCode, 0);
    // The last tick may lie in two chunks.
    const Values all = valuesOf(whole, always);
    QVERIFY(all.size() > 1000);
    const double last = std::get<0>(all.rbegin()->first) - 0.01;
    compare(valuesOf(whole, {-1, last}), valuesOf(m_session, {-1, last}));
    const Run again = cli({"repair", broken, whole});
    QCOMPARE(again.exitCode, 2);
    QVERIFY2(again.err.contains("--force"), again.err.constData());
    QCOMPARE(cli({"repair", broken, whole, "--force"}).exitCode, 1);
    QCOMPARE(cli({"inspect", whole}).exitCode, 0);
  }

  /// Every command that prints says when it could not, here for a disk that is full.
  void outputThatCannotBeWrittenIsAnError_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::newRow("inspect") << QStringList{"inspect", m_session};
    QTest::newRow("inspect --json") << QStringList{"inspect", m_session, "--json", "--events"};
    QTest::newRow("export") << QStringList{"export", m_session, "--robots", "match"};
    QTest::newRow("decode") << QStringList{"decode", "telemetry", "-"};
    QTest::newRow("simulate --list") << QStringList{"simulate", "--list"};
    QTest::newRow("simulate") << QStringList{"simulate", "--duration", "1"};
    QTest::newRow("experiment --list") << QStringList{"experiment", "--list"};
    QTest::newRow("--help") << QStringList{"export", "--help"};
    QTest::newRow("--version") << QStringList{"--version"};
  }
  void outputThatCannotBeWrittenIsAnError() {
    QFETCH(QStringList, arguments);
    QProcess process;
    process.setStandardOutputFile("/dev/full");
    process.start(program, arguments);
    process.write("1 450 300 0 9.5 80 10 1 1 1 1 1 8 0.1 189 OUT\n");
    process.closeWriteChannel();
    QVERIFY(process.waitForFinished(60'000));
    const QByteArray error = process.readAllStandardError();
    QVERIFY2(process.exitCode() == 2, error.constData());
    QVERIFY2(error.count("error: ") == 1, error.constData());
    QVERIFY2(error.contains("Cannot write to standard output"), error.constData());
  }

  void theNameOfTheOutputTellsTheFormat() {
    const QString lines = newPath(".jsonl"), odd = newPath(".dat");
    const Run run = cli({"export", m_session, "--robots", "match", "--until", "1", "-o", lines});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    QVERIFY(contents(lines).startsWith("{\"time\":0,"));
    const Run refused = cli({"export", m_session, "-o", odd});
    QCOMPARE(refused.exitCode, 2);
    QVERIFY2(refused.err.contains("does not tell the format") && refused.err.contains("--to"),
             refused.err.constData());
    QVERIFY(!QFile::exists(odd));
    QCOMPARE(cli({"export", m_session, "--until", "1", "--to", "csv-wide", "-o", odd}).exitCode, 0);
    // Options of another format are refused by the same rule.
    const Run rate = cli({"export", m_session, "--rate", "5", "-o", newPath(".csv")});
    QVERIFY2(rate.exitCode == 2 && rate.err.contains("csv-even"), rate.err.constData());
  }

  void forceReplacesFiles() {
    const QString session = newPath(".mcap"), table = newPath(".csv");
    const QStringList record{"record", "--scenario", "one-robot", "--duration", "1", "-o", session};
    const QStringList write{"export", session, "--to", "csv-wide", "-o", table};
    for (const QStringList& command : {record, write}) {
      QCOMPARE(cli(command).exitCode, 0);
      const Run again = cli(command);
      QCOMPARE(again.exitCode, 2);
      QVERIFY2(again.err.contains("--force"), again.err.constData());
      const Run forced = cli(command + QStringList{"--force"});
      QVERIFY2(forced.exitCode == 0, forced.err.constData());
    }
    QCOMPARE(cli({"inspect", session}).exitCode, 0);
    // With a scenario that cannot be played, the old recording stays.
    const QByteArray before = contents(session);
    QCOMPARE(cli({"record", "--scenario", "chess", "-o", session, "--force"}).exitCode, 2);
    QVERIFY(contents(session) == before);
    QVERIFY(!QFile::exists(session + ".part"));
  }

  void aFileThatIsBeingRecordedIsNotDamaged() {
    const QString path = newPath(".mcap");
    QProcess process;
    process.start(program, {"record", "--duration", "1e8", "--speed", "4", "-o", path});
    QTRY_VERIFY_WITH_TIMEOUT(QFileInfo(path).size() > 200'000, 60'000);
    const Run look = cli({"inspect", path});
    QVERIFY2(look.exitCode == 0, (look.out + look.err).constData());
    QVERIFY2(look.out.contains("still being recorded"), look.out.constData());
    QVERIFY2(!look.out.contains("damaged") && !look.out.contains("lost"), look.out.constData());
    const Run part = cli({"export", path, "--robots", "match", "--variables", "BALL_X"});
    QVERIFY2(part.exitCode == 0 && part.out.count('\n') > 50, part.err.constData());
    for (const QStringList& command :
         {QStringList{"repair", path, newPath(".mcap")},
          QStringList{"record", "--duration", "1", "-o", path, "--force"}}) {
      const Run refused = cli(command);
      QCOMPARE(refused.exitCode, 2);
      QVERIFY2(refused.err.contains("still being recorded"), refused.err.constData());
    }
    // Killed, it is what it was: cut off.
    process.kill();
    QVERIFY(process.waitForFinished(20'000));
    const Run killed = cli({"inspect", path});
    QVERIFY2(killed.exitCode == 1 && killed.out.contains("pitchboard-cli repair"),
             killed.out.constData());
  }

  void damageInsideIsFoundAndRepaired() {
    const QString damaged = newPath(".mcap"), whole = newPath(".mcap");
    QByteArray bytes = contents(m_session);
    const auto session = SessionReader::open(m_session.toStdString());
    const auto& chunk = session->file().contents().chunks.front();
    const auto at = static_cast<qsizetype>(chunk.offset + chunk.length) - 20;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    QFile file(damaged);
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
    file.close();
    const Run look = cli({"inspect", damaged});
    QCOMPARE(look.exitCode, 1);
    QVERIFY2(look.out.contains(" lost, between "), look.out.constData());
    QVERIFY2(look.out.contains("pitchboard-cli repair"), look.out.constData());
    const Run run = cli({"repair", damaged, whole});
    QVERIFY2(run.exitCode == 1, run.err.constData());
    QVERIFY2(run.out.contains(" were saved; ") && run.out.contains(" lost."), run.out.constData());
    QVERIFY2(run.err.contains(" lost, between "), run.err.constData());
    QCOMPARE(cli({"inspect", whole}).exitCode, 0);
    // Only the summary is damaged: nothing is missing.
    bytes = contents(m_session);
    bytes[bytes.size() - 40] = static_cast<char>(bytes[bytes.size() - 40] ^ 1);
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
    file.close();
    const Run all = cli({"repair", damaged, newPath(".mcap")});
    QVERIFY2(all.exitCode == 0 && all.err.contains("summary"), all.err.constData());
    QVERIFY2(all.out.endsWith(" were saved.\n"), all.out.constData());
    // A session is never overwritten by its own export, whatever the format.
    for (const QString format : {"csv-wide", "mcap", "report"}) {
      const Run self = cli({"export", m_session, "--to", format, "-o", m_session});
      QCOMPARE(self.exitCode, 2);
      QVERIFY2(self.err.contains("being read"), self.err.constData());
    }
  }

  void badRequestsAreSentences_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("words");
    const QString nowhere = m_folder.filePath("nowhere.mcap"), there = m_session;
    const QString fresh = m_folder.filePath("fresh"), text = m_folder.filePath("text.mcap");
    QFile file(text);
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write("time,robot\n1,2\n") > 0);
    for (const char* command : {"inspect", "export"}) {
      QTest::addRow("%s: no file", command) << QStringList{command, nowhere} << "nowhere.mcap";
      QTest::addRow("%s: no session", command) << QStringList{command, text} << "text.mcap";
    }
    QTest::newRow("export: a folder") << QStringList{"export", m_folder.path()} << m_folder.path();
    QTest::newRow("repair: no file") << QStringList{"repair", nowhere, fresh} << "nowhere.mcap";
    QTest::newRow("repair: over a file") << QStringList{"repair", there, there} << there;
    QTest::newRow("record: over a file") << QStringList{"record", "-o", there} << there;
    QTest::newRow("record: no folder")
        << QStringList{"record", "-o", "/no/such/x.mcap"} << "/no/such";
    QTest::newRow("record: no scenario")
        << QStringList{"record", "--scenario", "chess", "-o", fresh} << "chess";
    QTest::newRow("record: no duration")
        << QStringList{"record", "--duration", "-1", "-o", fresh} << "duration";
    QTest::newRow("record live: over a file")
        << QStringList{"record",      "--live",   "--bind",
                       "127.0.0.1",   "--robots", "1",
                       "--port-base", "40501",    "--gamecontroller-port",
                       "40511",       "-o",       there}
        << there;
    QTest::newRow("record live: no address")
        << QStringList{"record", "--live", "--bind", "home", "-o", fresh} << "home";
    QTest::newRow("record live: foreign address")
        << QStringList{"record", "--live", "--bind", "192.0.2.1", "-o", fresh} << "192.0.2.1";
    QTest::newRow("export: over a file") << QStringList{"export", there, "-o", there} << there;
    QTest::newRow("export: no robot") << QStringList{"export", there, "--robots", "B9"} << "B9";
    QTest::newRow("export: no variable")
        << QStringList{"export", there, "--variables", "NOTHING_*"} << "NOTHING_*";
    QTest::newRow("export: backwards")
        << QStringList{"export", there, "--from", "6", "--until", "3"} << "before";
    QTest::newRow("report: backwards")
        << QStringList{"export", there,     "--to", "report", "--from",
                       "6",      "--until", "3",    "-o",     fresh}
        << "before";
    QTest::newRow("export: no form")
        << QStringList{"export", there, "--to", "xls"} << "report, svg, png";
    QTest::newRow("export: clip to nowhere")
        << QStringList{"export", there, "--to", "mcap"} << "-o FILE";
  }
  void badRequestsAreSentences() {
    QFETCH(QStringList, arguments);
    QFETCH(QString, words);
    const QByteArray before = contents(m_session);
    const Run run = cli(arguments);
    QVERIFY2(run.exitCode == 2, run.out.left(200) + run.err);
    const QList<QByteArray> lines = run.err.trimmed().split('\n');
    QVERIFY2(lines[0].startsWith("error: ") && lines[0].contains(words.toUtf8()),
             run.err.constData());
    QVERIFY2(
        lines.size() == 1 || (lines.size() == 2 && lines[1].startsWith("Run \"pitchboard-cli ")),
        run.err.constData());
    QVERIFY(contents(m_session) == before);
    QVERIFY(!QFile::exists(m_folder.filePath("fresh")));
  }

  void anInterruptedRecordingIsWhole() {
    const QString path = newPath(".mcap");
    QProcess process;
    process.start(program, {"record", "--duration", "1e8", "-o", path});
    QTRY_VERIFY_WITH_TIMEOUT(QFileInfo(path).size() > 1'000'000, 20'000);
    ::kill(static_cast<pid_t>(process.processId()), SIGINT);
    QVERIFY(process.waitForFinished(20'000));
    QCOMPARE(process.exitCode(), 0);
    QCOMPARE(cli({"inspect", path}).exitCode, 0);
  }
};

PITCHBOARD_TEST(TestCliSessions)

}  // namespace tst_cli_sessions

#include "tst_cli_sessions.moc"
