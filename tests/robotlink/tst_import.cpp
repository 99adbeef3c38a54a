// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings of other programs as sessions: robots on the field, their ball, battery and falls,
// the referee, log lines and events, with the built-in mapping and with one from a file.

#include <QtTest>

#include <cmath>
#include <fstream>

#include <base/angles.h>
#include <base/base64.h>
#include <robotlink/import/import_session.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/session_events.h>
#include <telemetry/referee/gamecontroller_encoder.h>
#include <telemetry/session/session_reader.h>

namespace tst_import {

using namespace pitchboard;
using namespace pitchboard::link;
using telemetry::SessionReader;
using telemetry::SessionStream;

namespace {

std::string recording(const std::string& name) {
  return std::string(PITCHBOARD_SOURCE_DIR "/tests/data/recordings/") + name;
}

/// The mapping of the team whose robot walks in robot_walks.mcap.
constexpr const char* teamMapping = R"({
  "mapping": 1,
  "robots": [
    {"number": 3, "team": "red", "name": "Lena",
     "pose": {"topic": "/robot3/amcl_pose", "x": "pose.pose.position.x",
              "y": "pose.pose.position.y", "orientation": "pose.pose.orientation",
              "covariance": "pose.covariance"},
     "ball": {"topic": "/robot3/ball", "x": "x_mm", "y": "y_mm", "unit": "mm", "seen": "seen"},
     "battery": {"topic": "/robot3/battery_state", "volts": "voltage", "charge": "percentage",
                 "full": 12.6, "low": 11.2, "empty": 9.9}}
  ],
  "log": [{"topic": "/rosout", "text": "msg", "level": "level", "origin": "name"}],
  "referee": {"topic": "/gamestate", "state": "state", "secondsLeft": "seconds",
              "leftScore": "own_score", "rightScore": "rival_score", "left": "red", "right": "blue"}
})";

const RobotFrame* robotNamed(const MatchFrame& frame, const std::string& name) {
  for (const RobotFrame& robot : frame.robots) {
    if (robot.name == name) return &robot;
  }
  return nullptr;
}

std::vector<std::string> eventsOf(const SessionReader& session) {
  std::vector<std::string> out;
  for (const auto& event : session.events()) out.push_back(event.kind);
  return out;
}

}  // namespace

class TestImport : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;

  std::string path(const char* name) const { return m_folder.filePath(name).toStdString(); }

  std::string import(const std::vector<std::string>& files, const char* name,
                     const ImportOptions& options = {}) {
    const std::string to = path(name);
    const auto report = importRecordings(files, to, options);
    if (!report) qFatal("%s", report.error().text().c_str());
    m_report = *report;
    return to;
  }
  ImportReport m_report;

 private slots:
  void robotOfRos2IsOnTheField() {
    const auto session =
        SessionReader::open(import({recording("robot_walks.mcap")}, "walk.mcap")).value();
    QVERIFY(session.ours() && session.complete());
    QCOMPARE(m_report.robots, (std::vector<std::string>{"B3", "B7"}));  // of topics, and of tf
    RecordedFrames frames(backdropOf(session));
    // Times are those of the headers: 5 s is the 50th pose.
    const MatchFrame frame = frames.frameAt(session, 5.0);
    const RobotFrame* robot = robotNamed(frame, "B3");
    QVERIFY(robot != nullptr && robot->belief && robot->sigma);
    QVERIFY(std::abs(robot->belief->position.x - (-3 + 50 * 0.02)) < 1e-6);
    QVERIFY(std::abs(robot->belief->position.y - std::sin(50 * 0.05)) < 1e-6);
    QVERIFY(std::abs(robot->belief->yaw - 0.5) < 1e-6);
    QVERIFY(std::abs(*robot->sigma - 0.2) < 1e-6);
    QVERIFY(robot->link && !robot->timedOut());
    QVERIFY(robot->battery && std::abs(robot->battery->volts - 11.6) < 0.01);
    QVERIFY(!robot->fallen);
    QVERIFY(robotNamed(frames.frameAt(session, 11.0), "B3")->fallen);
    QVERIFY(!robotNamed(frames.frameAt(session, 15.0), "B3")->fallen);
    // map -> odom (1, 0, 90°) -> base_link (0.5, 0).
    const RobotFrame* other = robotNamed(frame, "B7");
    QVERIFY(other != nullptr && other->belief);
    QVERIFY(std::abs(other->belief->position.x - 1.0) < 1e-6);
    QVERIFY(std::abs(other->belief->position.y - 0.5) < 1e-6);
    QVERIFY(std::abs(other->belief->yaw - radiansFromDegrees(90.0)) < 1e-6);
    QCOMPARE(other->ownName, std::string("robot7"));
  }

  void everyFieldIsAVariable() {
    const auto session =
        SessionReader::open(import({recording("robot_walks.mcap")}, "fields.mcap")).value();
    std::map<std::string, const telemetry::SessionGroup*> groups;
    for (const auto& group : session.groups()) groups[group.info.name] = &group;
    QVERIFY(groups.contains("robot3/joint_states"));
    const auto& joints = groups["robot3/joint_states"]->info;
    const auto knee =
        std::ranges::find(joints.columns, "position[left_knee]", &telemetry::ColumnInfo::name);
    QVERIFY(knee != joints.columns.end());
    QCOMPARE(knee->unit, std::string("rad"));
    QCOMPARE(groups["robot3/joint_states"]->rows, std::uint64_t{200});
    std::vector<telemetry::SessionRow> rows;
    session.rowsAt(10.0, rows);
    const auto index = static_cast<std::size_t>(
        std::find_if(session.groups().begin(), session.groups().end(),
                     [](const auto& group) { return group.info.name == "robot3/joint_states"; }) -
        session.groups().begin());
    const auto head =
        std::ranges::find(joints.columns, "position[head_yaw]", &telemetry::ColumnInfo::name);
    QCOMPARE(rows[index].values[static_cast<std::size_t>(head - joints.columns.begin())], 0.1);
    QVERIFY(!groups.contains("camera/image"));
    QVERIFY2(
        m_report.notes.size() == 1 && m_report.notes[0].find("/camera/image") != std::string::npos,
        m_report.notes.empty() ? "" : m_report.notes[0].c_str());
  }

  void logAndEvents() {
    const auto session =
        SessionReader::open(import({recording("robot_walks.mcap")}, "log.mcap")).value();
    std::vector<LogLine> lines;
    session.messages(SessionStream::Log, {-1e18, 1e18}, [&](double, std::string_view json) {
      lines.push_back(telemetry::sessionLogLine(json).value());
      return true;
    });
    QCOMPARE(lines.size(), std::size_t{20});
    QCOMPARE(lines[5].text, std::string("step 50"));
    QCOMPARE(lines[5].origin, std::string("walker"));
    QVERIFY(lines[5].level == LogLevel::Error && lines[4].level == LogLevel::Info);
    const auto events = eventsOf(session);
    const auto has = [&](const char* kind) { return std::ranges::count(events, kind); };
    QCOMPARE(has("fall"), std::ptrdiff_t{1});
    QCOMPARE(has("got-up"), std::ptrdiff_t{1});
    QVERIFY(has("battery-low") >= 1);
  }

  void mappingOfATeam() {
    ImportOptions options;
    const auto mapping = mappingFromJson(teamMapping, "team.json");
    QVERIFY2(mapping, mapping ? "" : mapping.error().text().c_str());
    options.mapping = *mapping;
    const auto session =
        SessionReader::open(import({recording("robot_walks.mcap")}, "team.mcap", options)).value();
    RecordedFrames frames(backdropOf(session));
    const MatchFrame frame = frames.frameAt(session, 13.05);
    const RobotFrame* robot = robotNamed(frame, "R3");
    QVERIFY(robot != nullptr && robot->ball);
    QCOMPARE(robot->ownName, std::string("Lena"));
    QVERIFY(std::abs(robot->ball->distance - std::hypot(1.0, 0.65)) < 1e-6);
    QVERIFY(std::abs(robot->ball->bearing - std::atan2(0.65, 1.0)) < 1e-6);
    QVERIFY(frame.game && frame.game->state == PlayState::Playing);
    QCOMPARE(frame.game->secondsLeft(), 587);
    QCOMPARE(frame.game->teamAt(false).score, 1);
    QVERIFY(frame.game->teamAt(false).colour == TeamColor::Red);
    QVERIFY(!robotNamed(frames.frameAt(session, 19.0), "R3")->ball);
    const auto events = eventsOf(session);
    for (const char* kind : {"goal", "ball-lost", "referee"}) {
      QVERIFY2(std::ranges::count(events, kind) >= 1, kind);
    }
  }

  void mappingsReadBack() {
    const auto mapping = mappingFromJson(teamMapping, "team.json").value();
    const auto again = mappingFromJson(mappingText(mapping), "again.json");
    QVERIFY2(again, again ? "" : again.error().text().c_str());
    QVERIFY(*again == mapping);
    const auto readers = telemetry::openRecordings({recording("robot_walks.mcap")}).value();
    const TopicMapping usual = builtInMapping(readers.front()->topics());
    const auto usualAgain = mappingFromJson(mappingText(usual), "usual.json");
    QVERIFY2(usualAgain, usualAgain ? "" : usualAgain.error().text().c_str());
    QVERIFY(*usualAgain == usual);
  }

  void wrongMappings_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("wanted");
    QTest::newRow("not JSON") << "{"
                              << "m.json:1";
    QTest::newRow("version") << "{\"mapping\": 2}"
                             << "mapping";
    QTest::newRow("key") << "{\"mapping\": 1,\n \"robot\": []}"
                         << "m.json:2";
    QTest::newRow("number") << R"({"mapping": 1, "robots": [{"team": "red"}]})"
                            << "number";
    QTest::newRow("team") << R"({"mapping": 1, "robots": [{"number": 1, "team": "rde"}]})"
                          << "red";
    QTest::newRow("unit")
        << R"({"mapping": 1, "robots": [{"number": 1, "pose": {"topic": "a", "x": "b", "y": "c",
            "unit": "inch"}}]})"
        << "inch";
    QTest::newRow("field") << R"({"mapping": 1, "field": "moon"})"
                           << "moon";
    QTest::newRow("ball") << R"({"mapping": 1, "robots": [{"number": 1, "ball": {"topic": "a",
            "x": "b"}}]})"
                          << "x and y";
  }
  void wrongMappings() {
    QFETCH(QString, text);
    QFETCH(QString, wanted);
    const auto read = mappingFromJson(text.toStdString(), "m.json");
    QVERIFY(!read);
    QVERIFY2(read.error().text().find(wanted.toStdString()) != std::string::npos,
             read.error().text().c_str());
  }

  /// A mapping that fits nothing is told.
  void mappingThatFitsNothing() {
    ImportOptions options;
    options.mapping = mappingFromJson(R"({"mapping": 1, "robots": [{"number": 5, "pose":
        {"topic": "/nosuch", "x": "x", "y": "y"}}]})",
                                      "m.json")
                          .value();
    (void)import({recording("json.mcap")}, "nothing.mcap", options);
    QVERIFY(m_report.robots.empty());
    QVERIFY(std::ranges::any_of(m_report.notes, [](const std::string& note) {
      return note.find("Robot B5: no message") != std::string::npos;
    }));
  }

  void textsThatKeepChangingAreLogLines() {
    const auto session =
        SessionReader::open(import({recording("ros2/split_0.mcap"), recording("ros2/split_1.mcap"),
                                    recording("ros2/split_2.mcap")},
                                   "texts.mcap"))
            .value();
    QCOMPARE(session.count(SessionStream::Log), std::uint64_t{3726});
    std::uint64_t rows = 0;
    for (const auto& group : session.groups()) {
      rows += group.rows;
      QVERIFY(group.info.columns[0].labels.size() <= 65);
    }
    QCOMPARE(rows, std::uint64_t{3726});
    QCOMPARE(session.groups().size(), std::size_t{8});
  }

  void headerOrLogTime() {
    ImportOptions options;
    const auto first = [&](RecordingClock clock, const char* name) {
      options.clock = clock;
      const auto session =
          SessionReader::open(import({recording("ros1.mcap")}, name, options)).value();
      return session.info().start.time_since_epoch() +
             std::chrono::nanoseconds(std::llround(session.range()->begin * 1e9));
    };
    // The headers count from 100 s after 1970, half a century before the log times.
    QCOMPARE(first(RecordingClock::Header, "header.mcap").count(), std::int64_t{100'000'000'005});
    QCOMPARE(first(RecordingClock::Log, "logtime.mcap").count(),
             std::int64_t{1'751'364'000'000'000'000});
    QCOMPARE(first(RecordingClock::Auto, "auto.mcap").count(),
             std::int64_t{1'751'364'000'000'000'000});
    QVERIFY(std::ranges::any_of(m_report.notes, [](const std::string& note) {
      return note.find("another clock") != std::string::npos;
    }));
  }

  void refereeLogShowsGameAndRobots() {
    telemetry::RobotReply reply;
    reply.version = 4;
    reply.team = 12;
    reply.player = 2;
    reply.fallen = 0;
    reply.pose = {1500.0F, -500.0F, 0.0F};
    reply.ballAge = 0.1F;
    reply.ball = {1000.0F, 0.0F};
    const std::string status = toBase64(*telemetry::encodeReply(reply));
    const auto state = [](int secs, const char* name, int score, const char* penalty) {
      return "- timestamp: {secs: " + std::to_string(secs) +
             ", nanos: 0}\n  entry: !gameState\n    sides: homeDefendsRightGoal\n    stopped: "
             "false\n    phase: firstHalf\n    state: " +
             name +
             "\n    setPlay: noSetPlay\n    kickingSide: home\n    primaryTimer: !started\n      "
             "remaining: [600, 0]\n      runCondition: playing\n      behaviorAtZero: overflow\n   "
             " "
             "secondaryTimer: stopped\n    teams:\n      home: {goalkeeper: 1, score: " +
             std::to_string(score) +
             ", messageBudget: 9, players: [{penalty: noPenalty, "
             "penaltyTimer: stopped}, {penalty: " +
             penalty +
             ", penaltyTimer: stopped}]}\n      away: {goalkeeper: 1, score: 0, messageBudget: 9, "
             "players: [{penalty: noPenalty, penaltyTimer: stopped}]}\n";
    };
    std::string text =
        "- timestamp: {secs: 0, nanos: 0}\n  entry: !metadata\n    creator: GameController\n    "
        "version: 6\n    timestamp: 2026-07-01T10:00:00Z\n    params: {competition: {division: "
        "small, playersPerTeam: 4, halfDuration: {secs: 600, nanos: 0}}, game: {teams: {home: "
        "{number: 12, fieldPlayerColor: white, goalkeeperColor: black}, away: {number: 7, "
        "fieldPlayerColor: red, goalkeeperColor: black}}}}\n";
    text += state(1, "set", 0, "noPenalty") + state(3, "playing", 0, "noPenalty");
    for (int i = 4; i < 20; ++i) {
      text += "- timestamp: {secs: " + std::to_string(i) +
              ", nanos: 0}\n  entry: !statusMessage {host: 10.0.12.2, data: " + status + "}\n";
    }
    text += state(20, "playing", 1, "pushing") + state(25, "finished", 1, "pushing");
    text += "- timestamp: {secs: 26, nanos: 0}\n  entry: end\n";
    const std::string log = path("referee.yaml");
    std::ofstream(log) << text;
    const auto session = SessionReader::open(import({log}, "referee.mcap")).value();
    QCOMPARE(m_report.robots, std::vector<std::string>{"B2"});
    RecordedFrames frames(backdropOf(session));
    const MatchFrame frame = frames.frameAt(session, 10.2);
    QVERIFY(frame.game && frame.game->state == PlayState::Playing);
    QCOMPARE(frame.game->secondsLeft(), 592);  // second 0 is that of the first state
    const RobotFrame* robot = robotNamed(frame, "B2");
    QVERIFY(robot != nullptr && robot->belief && robot->ball && !robot->penalty);
    // The home team defends the right goal: it plays towards -x.
    QVERIFY(std::abs(robot->belief->position.x + 1.5) < 1e-6);
    QVERIFY(std::abs(robot->belief->position.y - 0.5) < 1e-6);
    QVERIFY(std::abs(robot->ball->place.x + 2.5) < 1e-6);
    const MatchFrame later = frames.frameAt(session, 20.9);
    QVERIFY(robotNamed(later, "B2")->penalty);
    QVERIFY(robotNamed(later, "B2")->penalty->kind == PenaltyKind::Pushing);
    const auto events = eventsOf(session);
    for (const char* kind : {"goal", "referee", "penalty", "timeout"}) {
      QVERIFY2(std::ranges::count(events, kind) >= 1, kind);
    }
    QVERIFY2(m_report.notes.empty(), m_report.notes.empty() ? "" : m_report.notes[0].c_str());
  }

  void nothingIsLeftBehind() {
    const std::string to = path("refused.mcap");
    const auto empty = importRecordings({recording("ros2/metadata.yaml")}, to, {});
    QVERIFY(!empty && !QFile::exists(QString::fromStdString(to)));
    const auto stopped =
        importRecordings({recording("robot_walks.mcap")}, to, {}, [](double) { return false; });
    QVERIFY(!stopped && !QFile::exists(QString::fromStdString(to)));
    std::ofstream(to) << "mine";
    const auto exists = importRecordings({recording("json.mcap")}, to, {});
    QVERIFY(!exists && exists.error().code == ErrorCode::Conflict);
    const auto itself = importRecordings({to}, to, {});
    QVERIFY(!itself && itself.error().code == ErrorCode::Conflict);
    QCOMPARE(m_folder.path().isEmpty(), false);
    QCOMPARE(QDir(m_folder.path()).entryList({"*refused*"}, QDir::Files | QDir::Hidden).size(), 1);
  }
};

PITCHBOARD_TEST(TestImport)

}  // namespace tst_import

#include "tst_import.moc"
