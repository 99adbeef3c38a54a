// SPDX-License-Identifier: GPL-3.0-or-later
// A recording runs through separate programs again: one that cooperates gives the same bits, one
// that does not is compared over time, and what goes wrong is said.
#include <QtTest>

#include <netinet/in.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <cmath>
#include <set>
#include <thread>

#include <base/unique_fd.h>
#include <robotlink/blackboard/system_v.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/cognition/referee_orders.h>
#include <robotlink/rerun/program_watch.h>
#include <robotlink/rerun/rerun_text.h>
#include <robotlink/session/row_slot.h>
#include <telemetry/referee/gamecontroller_encoder.h>
#include <telemetry/session/session_writer.h>

#include "../support/own_match_number.h"
#include "../support/referee_game.h"
#include "rerun_rig.h"

namespace tst_rerun_programs {

using namespace rerun_rig;
using namespace std::chrono_literals;

namespace {

constexpr const char* robotProgram = PITCHBOARD_BIN "/pitchboard-robot";

/// A UDP port that nobody has.
std::uint16_t unusedPort() {
  const UniqueFd socket(::socket(AF_INET, SOCK_DGRAM, 0));
  sockaddr_in here{};
  here.sin_family = AF_INET;
  socklen_t size = sizeof here;
  auto* const address = reinterpret_cast<sockaddr*>(&here);
  if (::bind(socket.get(), address, size) != 0 ||
      ::getsockname(socket.get(), address, &size) != 0) {
    qFatal("no port");
  }
  return ntohs(here.sin_port);
}

QByteArray exampleText(const char* name) {
  QFile file(QString(PITCHBOARD_SOURCE_DIR "/tests/end_to_end/") + name);
  if (!file.open(QIODevice::ReadOnly)) qFatal("there is no %s", name);
  return file.readAll();
}

}  // namespace

class TestRerunPrograms : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  std::uint16_t m_port = 0;

  std::string write(const QString& name, const QByteArray& text) const {
    QFile file(m_folder.filePath(name));
    if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write");
    file.write(text);
    return file.fileName().toStdString();
  }
  /// A match of a robot that this program decides for, in lock-step; recorded once.
  std::string recordWith(const std::string& program, const char* noise) const {
    const QString name = QString("separate-") + noise;
    const QString known = m_folder.filePath(name + ".mcap");
    if (QFile::exists(known)) return known.toStdString();
    const std::string profile =
        write("profile.json",
              R"({"version": 1, "name": "team", "cycle": "MATCH_CYCLE", "processes": [
             {"name": "decision", "command": ["python3", ")" +
                  QByteArray::fromStdString(program) + R"(", "${key}"]}]})");
    Recorded how{scenarioWith("one-robot", noise), 30.0};
    how.scenario.robots[0].runtime.profile = profile;
    how.options.robotProgram = robotProgram;
    how.options.newBoards = true;
    bool ready = false;
    return record(m_folder, name, how, [&](MatchPlayer& player) {
      while (!ready) {
        const auto now = MatchPlayer::Clock::now();
        player.lookAfterProcesses(now);
        ready = !player.match().pace().awaitsPrograms(ProcessPace::Await::AllPrograms, now);
        std::this_thread::yield();
      }
    });
  }
  static RerunOptions optionsOf(const std::string& program) {
    RerunOptions options = optionsFor("B1", {{"decision", program}});
    options.robotProgram = robotProgram;
    return options;
  }

  /// A live robot whose communication sets COM_REFEREE to what a datagram says.
  std::string recordReferee(const char* name, bool withDatagrams) const {
    const std::string path = m_folder.filePath(name).toStdString();
    telemetry::SessionWriterOptions writing;
    writing.waitWhenFull = true;
    auto writer = telemetry::SessionWriter::create(path, {}, writing).value();
    telemetry::GroupInfo group{"B1", {}};
    for (const char* variable : {"COM_REFEREE", "VISION_LOST"}) {
      group.columns.emplace_back();
      group.columns.back().name = variable;
      group.columns.back().type = telemetry::ColumnType::Int32;
    }
    group.robot.emplace();
    group.robot->slot = group.robot->number = 1;
    group.robot->sentFrom = "10.0.0.3";
    const auto id = writer->addGroup(group);
    const auto send = [&](double time, const char* from, const char* payload) {
      telemetry::SessionDatagram datagram{
          time, {telemetry::parseAddress(from).value(), 4000}, m_port, payload};
      writer->append(telemetry::SessionStream::RefereeRaw, datagram);
    };
    for (int i = 0; i <= 120; ++i) {  // six seconds
      const double time = 0.05 * i;
      const std::uint32_t state = time < 1.0 ? 0 : time < 3.0 ? 5 : 7;
      if (withDatagrams && i == 20) send(time, "10.0.0.9", "5");
      if (withDatagrams && i == 40) send(time, "10.0.0.3", "9");  // its own comes not back
      if (withDatagrams && i == 60) send(time, "10.0.0.9", "7");
      writer->append(id, {time, std::array<std::uint32_t, 2>{state, 0}, {}});
    }
    if (!writer->finish()) qFatal("not written");
    return path;
  }

  /// A live robot with our communication, and the packets that it got: kick-off, a penalty and a
  /// goal in 70 s. Between `deafFrom` and `deafUntil` the robot heard none of them.
  std::string recordOurs(const char* name, bool setPlay, double deafFrom, double deafUntil) const {
    const std::string path = m_folder.filePath(name).toStdString();
    const VariableCatalog& map = VariableCatalog::extended();
    telemetry::SessionWriterOptions writing;
    writing.waitWhenFull = true;
    auto writer = telemetry::SessionWriter::create(path, {}, writing).value();
    telemetry::GroupInfo group{"R2", {}};
    std::vector<IntVar> words;
    for (const char* variable : {"ROBOT_NUMBER", "COM_REFEREE", "COM_SET_PLAY", "COM_GOALS_OWN",
                                 "COM_GOALS_THEIRS", "COM_SECONDS_LEFT", "VISION_LOST"}) {
      group.columns.emplace_back();
      group.columns.back().name = variable;
      group.columns.back().type = telemetry::ColumnType::Int32;
      words.push_back(map.intVar(variable).value());
    }
    group.robot.emplace();
    group.robot->slot = group.robot->number = 2;
    group.robot->team = TeamColor::Red;
    const auto id = writer->addGroup(group);

    RefereeGame game("humanoid-2021", true);
    telemetry::DatagramBatch arrived;
    ProcessOptions options;
    options.robot = RobotId{2};
    options.shirt = 2;
    options.refereeTeam = game.packet().teams[1].number;
    options.announceSetPlay = setPlay;
    options.sends = false;
    options.refereeDatagrams = [&](telemetry::DatagramBatch& batch) {
      batch.clear();
      std::swap(batch, arrived);
      return !batch.empty();
    };
    auto communication = findProcess("communication")->make(options).value();
    Blackboard board = Blackboard::onHeap();
    const telemetry::Sender referee{telemetry::parseAddress("10.0.0.9").value(), 3838};
    for (int i = 0; i <= 1400; ++i) {
      const double time = 0.05 * i;
      game.runTo(time);
      if (i == 900)
        game.call({.kind = sim::CallKind::Penalise,
                   .robot = RobotId{5},
                   .penalty = PenaltyKind::Pushing});
      if (i == 1200) (void)game.simulation->placeBall({4.7, 0.0});
      if (i % 10 == 7) {
        const std::string packet = telemetry::encodeReferee(game.packet()).value();
        telemetry::SessionDatagram datagram{time - 0.01, referee, 3838, packet};
        writer->append(telemetry::SessionStream::RefereeRaw, datagram);
        const telemetry::WallTime at(telemetry::Duration(std::llround(datagram.time * 1e9)));
        if (time < deafFrom || time >= deafUntil) {
          arrived.append({at, referee, 3838, false, packet});
        }
      }
      communication->step(board, Clock{time});
      std::vector<std::uint32_t> row;
      for (const IntVar word : words) row.push_back(static_cast<std::uint32_t>(board.read(word)));
      writer->append(id, {time, row, {}});
    }
    if (!writer->finish()) qFatal("not written");
    return path;
  }

 private slots:
  void initTestCase() { QVERIFY(m_folder.isValid()); }

  void aCooperatingProgramGivesTheSameBits_data() {
    QTest::addColumn<QString>("noise");
    for (const char* noise : {"none", "realistic"}) QTest::newRow(noise) << QString(noise);
  }
  void aCooperatingProgramGivesTheSameBits() {
    QFETCH(QString, noise);
    const std::string program = write("decide.py", exampleText("ball_robot.py"));
    const auto session = opened(recordWith(program, qPrintable(noise)));
    const auto same = rerun(session, optionsOf(program));
    QVERIFY2(same, same ? "" : same.error().text().c_str());
    QVERIFY(same->inLockStep);
    QVERIFY2(same->unequal() == 0, qPrintable(shown(*same)));
    QVERIFY(variable(*same, "DECISION_ACTION_A").compared > 1700);

    // A planted change, where the recording crosses it and nowhere else.
    QByteArray changed = exampleText("ball_robot.py");
    changed.replace("KICK_DISTANCE = 25", "KICK_DISTANCE = 35");
    const auto other = rerun(session, optionsOf(write("changed.py", changed)));
    QVERIFY2(other, other ? "" : other.error().text().c_str());
    std::set<double> expected;
    const auto& group = session.groups()[1].info;
    QCOMPARE(group.name, std::string("B1"));
    const RowSlot lost = findSlot(group, {"VISION_LOST"}),
                  pan = findSlot(group, {"VISION_PAN_DEG"}),
                  dist = findSlot(group, {"VISION_BALL_DIST"});
    const std::array<telemetry::GroupId, 1> only{1};
    session.rows({-1e18, 1e18}, only, [&](telemetry::GroupId, const telemetry::RowView& row) {
      const double tick = std::round(row.time * 60.0);
      const bool decides = std::fmod(tick, 6.0) == 0.0 && tick > 0;
      const bool crosses = lost.read(row) != 1.0 && std::abs(std::trunc(pan.read(row))) <= 40.0 &&
                           dist.read(row) >= 25.0 && dist.read(row) < 35.0;
      if (decides && crosses) expected.insert(tick);
      return true;
    });
    QVERIFY(!expected.empty());
    std::set<double> begins;
    const ComparedVariable& action = variable(*other, "DECISION_ACTION_A");
    for (const DifferentStretch& stretch : action.stretches) {
      const bool lasts = stretch.end >= other->end - 1e-6;  // to the end of the recording
      const double begin = std::round(stretch.begin * 60.0);
      const double end = std::round(stretch.end * 60.0) + (lasts ? 1.0 : 0.0);
      QVERIFY2(expected.count(begin) > 0, qPrintable(QString::number(begin)));
      for (auto tick = expected.begin(); tick != expected.end();) {
        tick = *tick >= begin && *tick < end ? expected.erase(tick) : std::next(tick);
      }
    }
    QVERIFY2(expected.empty(), qPrintable(QString::number(*expected.begin())));
  }

  /// The documented example sleeps between its cycles. At another speed it acts at other moments.
  void aProgramWithASleepIsComparedOverTime() {
    const std::string program = write("decide.py", exampleText("ball_robot.py"));
    const auto session = opened(recordWith(program, "none"));
    RerunOptions options =
        optionsOf("python3 " PITCHBOARD_SOURCE_DIR "/tests/end_to_end/naive_robot.py ${key} 0.05");
    options.speed = 4.0;
    options.from = 1.0;  // its first cycle sees a blackboard that nobody has written yet
    options.until = 12.0;
    const auto result = rerun(session, options);
    QVERIFY2(result, result ? "" : result.error().text().c_str());
    QVERIFY(!result->inLockStep);
    QCOMPARE(result->slack, 0.5);
    // The same rule: the same actions, at nearly the same time.
    QVERIFY2(!variable(*result, "DECISION_ACTION_A").differs(), qPrintable(shown(*result)));
  }

  /// One of them cooperates, and the match waits for it alone.
  void allProgramsOfAProfileRunAtOnce() {
    const std::string program = write("decide.py", exampleText("ball_robot.py"));
    const auto session = opened(recordWith(program, "none"));
    const int word = VariableCatalog::published().find("LOCALIZATION_X")->index;
    const std::string locator = write("locate.py", R"(
import ctypes, sys, time
libc = ctypes.CDLL(None)
libc.shmat.restype = ctypes.c_void_p
address = libc.shmat(libc.shmget(int(sys.argv[1]), 2048, 0), None, 0)
ints = (ctypes.c_int * 512).from_address(address)
while True:
    ints[)" + QByteArray::number(word) + R"(] = 123  # LOCALIZATION_X
    time.sleep(0.005)
)");
    const std::string profile =
        write("both.json", R"({"version": 1, "name": "both", "cycle": "MATCH_CYCLE", "processes": [
             {"name": "localization", "command": ["python3", ")" +
                               QByteArray::fromStdString(locator) + R"(", "${key}"]},
             {"name": "decision", "command": ["python3", ")" +
                               QByteArray::fromStdString(program) + R"(", "${key}"]}]})");
    RerunOptions options = optionsFor("B1", {rerunProcessFromText(profile).value()});
    options.robotProgram = robotProgram;
    options.speed = 10.0;
    const auto result = rerun(session, options);
    QVERIFY2(result, result ? "" : result.error().text().c_str());
    QCOMPARE(result->processes.size(), std::size_t(2));
    // One does not cooperate, so that all is compared over time.
    QVERIFY(!result->inLockStep && result->slack >= 0.5);
    QVERIFY2(!variable(*result, "DECISION_ACTION_A").differs(), qPrintable(shown(*result)));
    const ComparedVariable& x = variable(*result, "LOCALIZATION_X");
    QVERIFY2(x.differs() && x.stretches.front().rerun == 123.0, qPrintable(shown(*result)));
    QVERIFY(!programFiles(options.processes).empty());
  }

  void messagesThatArrivedAreSentAgainAtTheirTimes() {
    m_port = unusedPort();
    const std::string program = write("hear.py", R"(
import ctypes, socket, sys, time
port = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
port.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
port.bind(("", )" + QByteArray::number(m_port) + R"())
port.setblocking(False)
libc = ctypes.CDLL(None)
libc.shmat.restype = ctypes.c_void_p
address = libc.shmat(libc.shmget(int(sys.argv[1]), 2048, 0), None, 0)
ints = (ctypes.c_int * 512).from_address(address)
while True:
    try:
        ints[51] = int(port.recv(100))  # COM_REFEREE
    except BlockingIOError:
        time.sleep(0.005)
)");
    RerunOptions options = optionsFor("B1", {{"communication", program}});
    options.robotProgram = robotProgram;
    options.speed = 2.0;
    options.from = 0.2;
    const auto heard = rerun(opened(recordReferee("heard.mcap", true)), options);
    QVERIFY2(heard, heard ? "" : heard.error().text().c_str());
    QVERIFY2(!variable(*heard, "COM_REFEREE").differs(), qPrintable(shown(*heard)));
    QVERIFY2(std::ranges::none_of(heard->notes,
                                  [](const std::string& note) {
                                    return note.find("datagrams") != std::string::npos;
                                  }),
             qPrintable(shown(*heard)));
    // Without any it hears nothing, and that is known before it starts.
    const auto session = opened(recordReferee("deaf.mcap", false));
    const auto plan = planRerun(session, options);
    QVERIFY2(plan, plan ? "" : plan.error().text().c_str());
    QVERIFY2(std::ranges::any_of(plan->notes,
                                 [](const std::string& note) {
                                   return note.starts_with("The recording has no datagrams");
                                 }),
             plan->notes.empty() ? "nothing" : plan->notes[0].c_str());
    const auto deaf = rerun(session, options);
    QVERIFY2(deaf && variable(*deaf, "COM_REFEREE").differs(),
             deaf ? qPrintable(shown(*deaf)) : "");
  }

  void ourCommunicationHearsTheRefereeAgain_data() {
    QTest::addColumn<bool>("setPlay");
    QTest::newRow("COM_REFEREE") << false;
    QTest::newRow("with set play, score and time") << true;
  }
  void ourCommunicationHearsTheRefereeAgain() {
    QFETCH(bool, setPlay);
    const RerunOptions options = optionsFor("R2", {{"communication", "reference"}});
    const std::string path = recordOurs(setPlay ? "told.mcap" : "ours.mcap", setPlay, 99.0, 99.0);
    const auto same = rerun(opened(path), options);
    QVERIFY2(same, same ? "" : same.error().text().c_str());
    QVERIFY2(same->unequal() == 0, qPrintable(shown(*same)));
    QVERIFY(variable(*same, "COM_REFEREE").compared > 1300);
    QCOMPARE(same->variables.size(), std::size_t(setPlay ? 7 : 2));
    std::set<std::uint32_t> orders;
    opened(path).rows({0.0, 70.0}, {}, [&](telemetry::GroupId, const telemetry::RowView& row) {
      orders.insert(row.words[1]);
      return true;
    });
    QVERIFY2(orders.size() >= 4, QByteArray::number(orders.size()));  // ready, set, play, stop

    // A robot that did not hear its penalty: the rerun obeys, from then on and nowhere else.
    const auto deaf = rerun(
        opened(recordOurs(setPlay ? "deaf-told.mcap" : "deaf-ours.mcap", setPlay, 45.0, 50.0)),
        options);
    QVERIFY2(deaf, deaf ? "" : deaf.error().text().c_str());
    const ComparedVariable& order = variable(*deaf, "COM_REFEREE");
    QVERIFY2(order.stretches.size() == 1, qPrintable(shown(*deaf)));
    QVERIFY2(order.stretches[0].begin > 45.0 && order.stretches[0].begin < 46.0 &&
                 order.stretches[0].end < 51.0,
             qPrintable(shown(*deaf)));
    QCOMPARE(order.stretches[0].rerun, double(refereeStop));
  }

  void aProgramThatDiesIsNamedWithItsLastWords() {
    const std::string program = write("decide.py", exampleText("ball_robot.py"));
    const auto session = opened(recordWith(program, "none"));
    QByteArray dies = exampleText("ball_robot.py");
    dies.replace("    tick = ints[CYCLE]",
                 "    if ints[CYCLE] > 300: sys.exit(\"no idea\")\n    tick = ints[CYCLE]");
    const auto result = rerun(session, optionsOf(write("dies.py", dies)));
    QVERIFY(!result);
    const QString text = QString::fromStdString(result.error().text());
    QVERIFY2(text.contains("exit code 1") && text.contains("no idea"), qPrintable(text));
    const auto atOnce = rerun(session, optionsOf("sh -c \"exit 3\""));
    QVERIFY(!atOnce);
    QVERIFY2(QString::fromStdString(atOnce.error().text()).contains("exit code"),
             atOnce.error().text().c_str());
  }

  void aSegmentThatDisappearsIsNamed() {
    const std::string program = write("decide.py", exampleText("ball_robot.py"));
    const auto session = opened(recordWith(program, "none"));
    RerunOptions options = optionsOf(program);
    const OwnMatchNumber own;
    options.match = own.value();
    const int key = blackboardKey(RobotId{1}, own.number().keyBase());
    options.speed = 2.0;
    options.progress = [key](double part) {
      const int shmid = shmget(key, 0, 0);
      if (part > 0.05 && shmid >= 0) shmctl(shmid, IPC_RMID, nullptr);
      return true;
    };
    const auto result = rerun(session, options);
    QVERIFY(!result);
    const QString text = QString::fromStdString(result.error().text());
    QVERIFY2(text.contains("was removed") && text.contains(QString::number(key)), qPrintable(text));
  }

  void aBlackboardOfOthersIsLeftAlone() {
    const std::string program = write("decide.py", exampleText("ball_robot.py"));
    const auto session = opened(recordWith(program, "none"));
    RerunOptions options = optionsOf(program);
    const OwnMatchNumber own;
    options.match = own.value();
    const int key = blackboardKey(RobotId{1}, own.number().keyBase());
    QVERIFY(SystemVSegments::create(key));
    const auto result = rerun(session, options);
    QVERIFY(SystemVSegments::remove(key));
    QVERIFY(!result && result.error().code == ErrorCode::Conflict);
    QVERIFY2(QString::fromStdString(result.error().text()).contains("--match"),
             result.error().text().c_str());
    // And nothing of ours is left behind.
    QVERIFY(rerun(session, options));
    QVERIFY(!SystemVSegments::info(key));
  }

  /// Programs that were killed may have left one. Without a number, the rerun takes another one.
  void aBlackboardThatWasLeftIsPassedBy() {
    const std::string program = write("decide.py", exampleText("ball_robot.py"));
    Recorded how{scenarioWith("one-robot", "none"), 5.0};
    how.scenario.robots[0].identity.id = RobotId{64};  // no other test has keys of this robot
    const auto session = opened(record(m_folder, "id64", how));
    const int key = blackboardKey(RobotId{64});
    QVERIFY(SystemVSegments::create(key));
    const int shmid = SystemVSegments::info(key)->shmid;
    const auto result = rerun(session, optionsOf(program));
    QCOMPARE(SystemVSegments::info(key)->shmid, shmid);
    QVERIFY(SystemVSegments::remove(key));
    QVERIFY2(result, result ? "" : result.error().text().c_str());
  }
};

PITCHBOARD_TEST(TestRerunPrograms)

}  // namespace tst_rerun_programs

#include "tst_rerun_programs.moc"
