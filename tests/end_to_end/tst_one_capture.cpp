// SPDX-License-Identifier: GPL-3.0-or-later
// What arrives is the same wherever it is looked at: printed by listen, recorded, shown by the
// studio's Live, or read of a blackboard.

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <csignal>
#include <map>
#include <mutex>
#include <set>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/session/session_events.h>
#include <telemetry/session/session_reader.h>
#include <ui/sources/live_controller.h>

#include "../support/segment_keys.h"
#include "../support/session_values.h"
#include "../ui/live_rig.h"

namespace tst_one_capture {

using namespace pitchboard;
using namespace pitchboard::telemetry;

namespace {

const QString program = QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli");

using Values = std::map<QString, QVariant>;
using Event = std::pair<QString, QString>;  // kind, words

/// How many rows each robot has, and what stood in the last one.
class Rows : public RowSink {
 public:
  GroupId addGroup(const GroupInfo& info) override {
    const std::lock_guard lock(m_mutex);
    m_groups.push_back(info);
    return static_cast<GroupId>(m_groups.size() - 1);
  }
  void append(GroupId group, const RowView& row) override {
    const std::lock_guard lock(m_mutex);
    const GroupInfo& info = m_groups[group];
    if (!factsOf(info).linkOf.empty()) return;
    const QString name = QString::fromStdString(info.name);
    ++counts[name];
    Values& values = last[name];
    values.clear();
    for (std::size_t i = 0; i < info.columns.size(); ++i) {
      const double value = valueOf(info, row, i);
      if (std::isnan(value)) continue;
      const auto label = info.columns[i].labels.find(static_cast<int>(value));
      const bool isWord =
          info.columns[i].kind == ColumnKind::Text && label != info.columns[i].labels.end();
      values[QString::fromStdString(info.columns[i].name)] =
          isWord ? QVariant(QString::fromStdString(label->second)) : QVariant(value);
    }
  }

  std::map<QString, int> counts;
  std::map<QString, Values> last;

 private:
  std::mutex m_mutex;
  std::vector<GroupInfo> m_groups;
};

class RowObserver : public link::LiveObserver {
 public:
  std::shared_ptr<RowSink> rows() override { return kept; }
  std::shared_ptr<Rows> kept = std::make_shared<Rows>();
};

/// What each way says of the capture.
struct Seen {
  std::map<QString, int> rows;
  std::map<QString, Values> last;
  std::map<QString, std::array<int, 3>> health;  // received, duplicates, errors
  std::set<Event> events;
};

QString textOf(const std::set<Event>& events) {
  QStringList lines;
  for (const auto& [kind, words] : events) lines << kind + QStringLiteral(": ") + words;
  return lines.join(QLatin1Char('\n'));
}

struct Step {
  const TestSocket* from;
  int port;  // after the base
  std::string payload;
};

}  // namespace

class TestOneCapture : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

  QString write(const QString& name, const QByteArray& text) const {
    QFile file(m_folder.filePath(name));
    if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size()) return {};
    return file.fileName();
  }

 private slots:
  void oneCaptureThroughFourPaths() {
    const QString keys = write("keys.json", R"({"name": "keys", "format": "key=value", "end": "",
      "fields": [{"name": "id", "type": "int", "meaning": "robot"},
                 {"name": "x", "type": "float", "unit": "cm", "meaning": "x"},
                 {"name": "y", "type": "float", "unit": "cm", "meaning": "y"},
                 {"name": "th", "type": "float", "unit": "°", "meaning": "theta"},
                 {"name": "role", "type": "text"}]})");
    const QStringList teams{
        write("ours.json", R"({"name": "Ours", "number": 12, "colour": "blue",
          "senders": ["127.0.0.2", "127.0.0.4"], "profile": ")" +
                               keys.toUtf8() + R"("})"),
        write("theirs.json", R"({"number": 7, "colour": "red", "senders": ["127.0.0.3"],
          "profile": "upenn"})")};
    constexpr std::uint32_t loopback = INADDR_LOOPBACK;
    const TestSocket ours(loopback + 1), theirs(loopback + 2), second(loopback + 3),
        stranger(loopback + 8);
    const std::vector<Step> capture{
        {&ours, 3, "id=3 x=450 y=300 th=90 role=keeper foo=6"},
        {&ours, 3, "id=3 x=600 y=250 th=90 role=striker foo=7\nPBD1 3\nlayer a\ndisc 1 0 1\n"},
        {&ours, 3, "PBD1 3\nlayer b\ncircle 0.4 0.1 0.1\n"},
        {&ours, 3, "PBD1 3\nlayer b\nsquare 1\n"},
        {&theirs, 3, R"({["id"]=3,["pose"]={["x"]=1.5,["y"]=-0.5,["a"]=0}})"},
        {&theirs, 3, "nonsense"},
        {&ours, 5, "id=5 x=100 y=200 th=0 role=a"},
        {&second, 5, "id=5 x=700 y=200 th=0 role=b"},
        {&ours, 6, "id=6 x=100 y=200 th=0 role=a"},
        {&second, 6, "id=6 x=100 y=200 th=0 role=a"},
        {&stranger, 3, "id=3 x=1 y=1 th=1 role=c"},
        {&ours, 18, live_rig::packet("v12hl688_CORNER_KICK.bin")},
        {&ours, 18, "no packet"},
    };
    const std::vector<link::LiveOptions> ports{live_rig::options(), live_rig::options(),
                                               live_rig::options()};
    const auto arguments = [&](const link::LiveOptions& at) {
      return QStringList{"--bind",
                         "127.0.0.1",
                         "--port-base",
                         QString::number(at.portBase),
                         "--gamecontroller-port",
                         QString::number(at.refereePort),
                         "--variables-port-base",
                         "0",  // others have those ports
                         "--team",
                         teams[0],
                         "--team",
                         teams[1]};
    };
    QProcess listen, record;
    const QString file = m_folder.filePath("one.mcap");
    listen.start(program, QStringList{"listen", "--json"} + arguments(ports[0]));
    record.start(program, QStringList{"record", "--live", "-o", file} + arguments(ports[1]));
    for (QProcess* process : {&listen, &record}) {
      QByteArray reported;
      QTRY_VERIFY_WITH_TIMEOUT(
          (reported += process->readAllStandardError()).contains("listening at"), 30'000);
    }
    // A blackboard that says what robot 3 of ours says.
    const int key = testKeyBase() + 900;
    auto board = link::SystemVSegments::open(key, link::AttachMode::AttachOrCreate);
    QVERIFY(board);
    const link::VariableCatalog catalog = link::VariableCatalog::published();
    for (const auto& [name, value] :
         {std::pair{"LOCALIZATION_X", 600}, {"LOCALIZATION_Y", 250}, {"LOCALIZATION_THETA", 90}}) {
      board->write(link::IntVar{catalog.find(name)->index}, value);
    }
    ui::LiveController studio;
    link::LiveOptions live = ports[2];
    for (const QString& team : teams) {
      live.team.teams.push_back(telemetry::loadTeamSetup(team.toStdString()).value());
    }
    live.boards = {link::parseAttachedBoard(std::to_string(key) + ",robot=9").value()};
    studio.setOptions(live);
    const auto rows = std::make_shared<RowObserver>();
    studio.observe(rows);
    QSignalSpy given(&studio, &ui::LiveController::eventsReceived);
    studio.start();
    QTRY_VERIFY(studio.details().network.ports.size() == 17);

    for (const Step& step : capture) {
      for (const link::LiveOptions& at : ports) {
        QVERIFY(step.from->send(static_cast<std::uint16_t>(at.portBase + step.port), step.payload));
      }
    }

    Seen studioSaw;
    QTRY_COMPARE(studio.details().unknownReferee, std::uint64_t{1});
    QTRY_VERIFY(rows->kept->counts.contains("B9"));
    const auto isShown = [&](std::size_t robots) {
      return studio.frame() && studio.frame()->robots.size() == robots && studio.frame()->game;
    };
    QTRY_VERIFY(isShown(6));
    const ui::FramePtr frame = studio.frame();
    // Its last events and counts may wait for the next frame.
    QTRY_VERIFY(studio.frame()->serial > frame->serial + 3);
    const link::LiveDetails details = studio.details();
    for (const auto& args : given) {
      for (const auto& event : args[0].value<std::vector<link::MatchEvent>>()) {
        const SessionEvent words = link::sessionEvent(event);
        studioSaw.events.insert(
            {QString::fromStdString(words.kind), QString::fromStdString(words.text)});
      }
    }
    studio.stop();
    studioSaw.rows = rows->kept->counts;
    studioSaw.last = rows->kept->last;

    Seen listenSaw;
    kill(static_cast<pid_t>(listen.processId()), SIGINT);
    QVERIFY(listen.waitForFinished(30'000));
    const QByteArray summary = listen.readAllStandardError();
    int drawings = 0, badDrawings = 0, referees = 0, refused = 0;
    for (const QByteArray& line : listen.readAllStandardOutput().trimmed().split('\n')) {
      const QJsonObject object = QJsonDocument::fromJson(line).object();
      const QString type = object["type"].toString(), name = object["name"].toString();
      const QJsonArray errors = object["errors"].toArray();
      if (type == "health") {
        listenSaw.health[name] = {object["received"].toInt(), object["duplicates"].toInt(),
                                  object["errors"].toInt()};
      } else if (type == "event") {
        listenSaw.events.insert({object["kind"].toString(), object["text"].toString()});
      } else if (type == "drawing") {
        ++(object.contains("error") ? badDrawings : drawings);
      } else if (type == "referee") {
        ++referees;
      } else if (!object["accepted"].toBool()) {
        ++refused;
      } else if (errors.isEmpty()) {
        ++listenSaw.rows[name];
        Values& values = listenSaw.last[name];
        values.clear();
        const QJsonObject all = object["values"].toObject();
        for (auto value = all.begin(); value != all.end(); ++value) {
          if (value->isNull()) continue;
          values[value.key()] =
              value->isDouble() ? QVariant(value->toDouble()) : value->toVariant();
        }
      }
    }

    Seen recordSaw;
    kill(static_cast<pid_t>(record.processId()), SIGINT);
    QVERIFY(record.waitForFinished(30'000));
    const auto session = SessionReader::open(file.toStdString()).value();
    Rows recorded;
    for (const auto& group : session.groups()) recorded.addGroup(group.info);
    session.rows({-1e9, 1e9}, {}, [&](GroupId group, const RowView& row) {
      recorded.append(group, row);
      return true;
    });
    recordSaw.rows = recorded.counts;
    recordSaw.last = recorded.last;
    for (const SessionEvent& event : session.events()) {
      recordSaw.events.insert(
          {QString::fromStdString(event.kind), QString::fromStdString(event.text)});
    }

    // Robots, their names and values.
    studioSaw.rows.erase("B9");
    const std::map<QString, int> expected{
        {"B3", 2}, {"B5", 1}, {"B5 (2)", 1}, {"B6", 1}, {"R3", 1}};
    QCOMPARE(listenSaw.rows, expected);
    QCOMPARE(recordSaw.rows, expected);
    QCOMPARE(studioSaw.rows, expected);
    for (const auto& [name, count] : expected) {
      QCOMPARE(recordSaw.last[name], studioSaw.last[name]);
      for (const auto& [column, value] : listenSaw.last[name]) {
        QVERIFY2(recordSaw.last[name][column] == value, qPrintable(name + "/" + column));
      }
    }
    QCOMPARE(listenSaw.last["B3"]["foo"], QVariant(7.0));
    QCOMPARE(listenSaw.last["B3"]["role"], QVariant(QStringLiteral("striker")));
    // A drawing is no bad message.
    QCOMPARE(drawings, 1);
    QCOMPARE(badDrawings, 1);
    QCOMPARE(refused, 1);
    QCOMPARE(referees, 2);
    QVERIFY2(summary.contains("; bad: 3; refused: 1 from senders"), summary.constData());
    QCOMPARE(details.team.errors.messages() + details.unknownReferee, std::uint64_t{3});
    QCOMPARE(details.team.refusedByFilter, std::uint64_t{1});
    // Health of the same robots.
    QCOMPARE(listenSaw.health.size(), expected.size());
    for (const RobotStatus& robot : details.team.robots) {
      const QString name = QString::fromStdString(link::robotName(robot.key, details.teams));
      const std::array<int, 3> health{static_cast<int>(robot.messages),
                                      static_cast<int>(robot.duplicates),
                                      static_cast<int>(robot.errorCount)};
      QVERIFY2(listenSaw.health[name] == health, qPrintable(name));
    }
    QVERIFY(!listenSaw.events.empty());
    // Only the studio has the blackboard.
    std::erase_if(studioSaw.events, [](const Event& event) { return event.second.contains("B9"); });
    // They ended one after the other, and who is silent goes offline.
    for (Seen* seen : {&listenSaw, &recordSaw, &studioSaw}) {
      std::erase_if(seen->events, [](const Event& event) {
        return event.first == "timeout" || event.first == "referee-silent";
      });
    }
    QCOMPARE(textOf(listenSaw.events), textOf(recordSaw.events));
    QCOMPARE(textOf(studioSaw.events), textOf(recordSaw.events));
    // The blackboard is a robot like the one that sends the same.
    const auto robotOf = [&](int number) {
      return *std::ranges::find_if(frame->robots, [&](const link::RobotFrame& robot) {
        return robot.key.number == number && robot.identity.team == TeamColor::Blue;
      });
    };
    QVERIFY(std::abs(robotOf(9).pose.position.x - robotOf(3).pose.position.x) < 1e-9);
    QVERIFY(std::abs(robotOf(9).pose.position.y - robotOf(3).pose.position.y) < 1e-9);
    QVERIFY(std::abs(robotOf(9).pose.yaw - robotOf(3).pose.yaw) < 1e-9);
    QCOMPARE(frame->drawings.size(), std::size_t{1});
    QCOMPARE(frame->drawings[0].layers.size(), std::size_t{2});
  }
};

PITCHBOARD_GUI_TEST(TestOneCapture)

}  // namespace tst_one_capture

#include "tst_one_capture.moc"
