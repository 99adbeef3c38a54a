// SPDX-License-Identifier: GPL-3.0-or-later
// Blackboards of this computer as robots: an independent process (python3, ctypes) makes and writes
// the segment.
#include <sys/ipc.h>
#include <sys/shm.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <atomic>
#include <functional>
#include <optional>
#include <thread>

#include <robotlink/blackboard/system_v.h>
#include <robotlink/frame/join_boards.h>
#include <robotlink/live/attached_robots.h>
#include <robotlink/session/recorded_frame.h>
#include <telemetry/series/series_store.h>

namespace tst_attached_robots {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

/// Makes a segment of key and size, writes words (index value ...; with a point: floats), says
/// "ready", and removes the segment at the end of its input.
const char* const writer = R"(
import ctypes, struct, sys
libc = ctypes.CDLL(None, use_errno=True)
libc.shmat.restype = ctypes.c_void_p
libc.shmat.argtypes = [ctypes.c_int, ctypes.c_void_p, ctypes.c_int]
key, size = int(sys.argv[1]), int(sys.argv[2])
segment = libc.shmget(key, size, 0o1000 | 0o644)
assert segment >= 0
address = libc.shmat(segment, None, 0)
for pair in sys.argv[3:]:
    word, value = pair.split('=')
    raw = struct.pack('<f', float(value)) if '.' in value else struct.pack('<i', int(value))
    ctypes.memmove(address + 4 * int(word), raw, 4)
print('ready', flush=True)
sys.stdin.read()
libc.shmctl(segment, 0, None)
)";

struct Peer {
  Peer(int key, int bytes, const QStringList& words) {
    process.start("/usr/bin/python3",
                  QStringList{"-c", writer, QString::number(key), QString::number(bytes)} + words);
    isReady = process.waitForReadyRead(30000);
  }
  ~Peer() { end(); }
  void end() {
    process.closeWriteChannel();
    process.waitForFinished(30000);
  }
  QProcess process;
  bool isReady = false;
};

int freeKey(int offset) {
  return 0x5000'0000 + (static_cast<int>(getpid()) % 100000) * 64 + offset;
}

/// As another user of this computer; only root can. The system call is for one thread, the C
/// library's function for all of them.
void asUser(unsigned user, const std::function<void()>& work) {
  std::jthread([&] {
    if (syscall(SYS_setresuid, -1, user, -1) == 0) work();
  }).join();
}

}  // namespace

class TestAttachedRobots : public QObject {
  Q_OBJECT
 private slots:
  void aRobotOfItsOwnMap() {
    QTemporaryDir folder;
    const QString map = folder.filePath("map.json");
    QFile file(map);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(R"({"segment": {"bytes": 4096, "float_offset_words": 600},
      "int": {"LOCALIZATION_X": 10, "LOCALIZATION_Y": 11, "LOCALIZATION_THETA": 12, "VOLTAGE": 590,
              "VISION_WORKING": 20},
      "float": {"VISION_BALL_DIST": 400}})");
    file.close();
    const int key = freeKey(1);
    Peer peer(key, 4096, {"10=600", "11=350", "12=90", "590=160", "20=1", "1000=80.0"});
    QVERIFY2(peer.isReady, peer.process.readAllStandardError().constData());

    const auto board = parseAttachedBoard(
        QStringLiteral("%1,catalog=%2,robot=4,rate=200,team=red").arg(key).arg(map).toStdString());
    QVERIFY2(board, board ? "" : board.error().text().c_str());
    std::atomic<int> calls = 0;
    AttachedRobots robots([&calls] { return 0.25 * ++calls; });
    robots.set({*board});
    MatchFrame frame;
    const auto hasRobot = [&] {
      frame.robots.clear();
      joinBoards(frame, robots.robots(frame.settings->field));
      return frame.robots.size() == 1;
    };
    QTRY_VERIFY(hasRobot());
    const RobotFrame& robot = frame.robots[0];
    QCOMPARE(robot.identity.name(), std::string("R4"));
    QCOMPARE(robot.boardKey.value_or(-1), key);
    QVERIFY(robot.battery && std::abs(robot.battery->volts - 16.0) < 1e-9);
    QVERIFY(robot.lamps[1].state == telemetry::HeartbeatState::Working);
    QVERIFY(robot.poseKnown() && !robot.timedOut());
    // The corner of a field of 9 by 6 m: 1.5 m to the right of its centre, 0.5 m below.
    QCOMPARE(robot.pose.position.x, 1.5);
    QCOMPARE(robot.pose.position.y, -0.5);

    auto store = std::make_shared<telemetry::SeriesStore>();
    BoardRowKeeper keeper(store);
    const auto take = [&] {
      robots.drainRows([&](const auto& group, auto rows) { keeper.take(group, rows); });
      return store->groups() == 1;
    };
    QTRY_VERIFY(take());
    const auto& columns = store->view(0)->info().columns;
    QCOMPARE(columns.size(), std::size_t(6));
    QCOMPARE(columns[5].name, std::string("VISION_BALL_DIST"));

    // It disappears, and is said; it comes again.
    peer.end();
    QTRY_VERIFY(robots.status().at(0).problem.find("was removed") != std::string::npos);
    QVERIFY(hasRobot());
    QVERIFY(frame.robots[0].timedOut());
    Peer again(key, 4096, {"10=100"});
    QVERIFY(again.isReady);
    QTRY_VERIFY(robots.status().at(0).attached);
    QTRY_VERIFY(hasRobot() && frame.robots[0].pose.position.x == -3.5);
  }

  /// Looking back and Replay show it as it was seen.
  void itsRowsMakeTheSameRobotAgain() {
    const int key = freeKey(4);
    const auto& extended = VariableCatalog::extended();
    const QTemporaryDir folder;
    const QString map = folder.filePath(QStringLiteral("map.json"));
    QFile file(map);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(extended.toJson()));
    file.close();
    const auto word = [&extended](const char* name) {
      for (const Variable& variable : extended.variables()) {
        const int offset = variable.type == VariableType::Int ? 0 : SegmentLayout().floatOffset;
        if (variable.name == name) return QString::number(variable.index + offset);
      }
      return QString();
    };
    Peer peer(key, 2048,
              {word("LOCALIZATION_X") + "=600", word("LOCALIZATION_Y") + "=350",
               word("LOCALIZATION_THETA") + "=90", word("VOLTAGE") + "=150",
               word("VISION_WORKING") + "=1", word("DECISION_ACTION_A") + "=8",
               word("VISION_BALL_DIST") + "=80.0", word("VISION_PAN_DEG") + "=10.0"});
    QVERIFY2(peer.isReady, peer.process.readAllStandardError().constData());
    const auto board =
        parseAttachedBoard(QStringLiteral("%1,catalog=%2,robot=7,rate=100,team=yellow")
                               .arg(key)
                               .arg(map)
                               .toStdString());
    QVERIFY(board);
    std::atomic<int> calls = 0;
    AttachedRobots robots([&calls] { return 0.01 * ++calls; });
    robots.set({*board});
    auto store = std::make_shared<telemetry::SeriesStore>();
    BoardRowKeeper keeper(store);
    const auto take = [&] {
      robots.drainRows([&](const auto& group, auto rows) { keeper.take(group, rows); });
      return store->groups() == 1 && store->view(0)->rows() > 10;
    };
    QTRY_VERIFY(take());
    MatchFrame seen;
    joinBoards(seen, robots.robots(seen.settings->field));
    QCOMPARE(seen.robots.size(), std::size_t(1));
    QCOMPARE(store->view(0)->info().name, std::string("Y7"));

    RecordedFrames recorded(*seen.settings);
    const double last = store->view(0)->range()->end;
    MatchFrame again;
    joinBoards(again, recorded.boardsAt(*store, last));
    QCOMPARE(again.robots.size(), std::size_t(1));
    const RobotFrame &then = seen.robots[0], &now = again.robots[0];
    QVERIFY(now.key == then.key);
    QCOMPARE(now.identity.name(), then.identity.name());
    QCOMPARE(now.action, then.action);
    QVERIFY(now.pose == then.pose);
    QVERIFY(now.belief && !now.timedOut());
    QVERIFY(now.battery == then.battery);
    QVERIFY(then.ball.has_value() && now.ball == then.ball);
    QVERIFY(now.decided == then.decided);
    QCOMPARE(now.link->rate, then.link->rate);
    for (std::size_t i = 0; i < telemetry::processCount; ++i) {
      QVERIFY(now.lamps[i].state == then.lamps[i].state);
    }
    // Ten seconds later nothing has come any more.
    const auto later = recorded.boardsAt(*store, last + 10.0);
    QCOMPARE(later.size(), std::size_t(1));
    QVERIFY(later[0].link->timedOut);
  }

  void itIsNeverWritten() {
    const int key = freeKey(2);
    Peer peer(key, 2048, {"5=7"});
    QVERIFY(peer.isReady);
    const auto view = SegmentView::attach(key);
    QVERIFY(view);
    QCOMPARE(view->word(5), 7U);
    QCOMPARE(view->word(512), 0U);
    QVERIFY(view->isThere());
    const auto wrong = SegmentView::attach(key, 4096);
    QVERIFY(!wrong);
    QVERIFY(wrong.error().text().find("has 2048 bytes, not 4096") != std::string::npos);
  }

  /// The mode of the segment says who may read it; nobody here is root.
  void aSegmentOfAnotherUserIsReadWherePermitted() {
    if (geteuid() != 0) QSKIP("only root can be two other users");
    constexpr unsigned owner = 65'534, reader = 65'533;
    const auto attached = [](int key, int mode) {
      int segment = -1;
      asUser(owner, [&] {
        segment = shmget(key, 2048, IPC_CREAT | IPC_EXCL | mode);
        void* const address = shmat(segment, nullptr, 0);
        static_cast<std::uint32_t*>(address)[5] = 7;
        shmdt(address);
      });
      std::optional<Result<std::uint32_t>> seen;
      asUser(reader, [&] {
        const auto view = SegmentView::attach(key);
        if (view)
          seen.emplace(view->word(5));
        else
          seen.emplace(tl::unexpected(view.error()));
      });
      shmctl(segment, IPC_RMID, nullptr);
      return seen;
    };
    for (const int mode : {0644, 0666}) {
      const auto permitted = attached(freeKey(5), mode);
      QVERIFY(permitted.has_value());
      QVERIFY(permitted->has_value());
      QCOMPARE(permitted->value(), 7U);
    }
    const auto refused = attached(freeKey(5), 0600);
    QVERIFY(refused.has_value() && !refused->has_value());
    const std::string sentence = refused->error().text();
    QVERIFY2(sentence.find("belongs to user 65534 and may not be read") != std::string::npos &&
                 sentence.find("0644") != std::string::npos,
             sentence.c_str());
  }

  void aSegmentThatIsNotThereYet() {
    const int key = freeKey(3);
    const auto board = parseAttachedBoard(std::to_string(key) + ",robot=2");
    QVERIFY(board);
    AttachedRobots robots([] { return 0.0; });
    robots.set({*board});
    QTRY_VERIFY(!robots.status().at(0).problem.empty());
    Peer peer(key, 2048, {});
    QTRY_VERIFY(robots.status().at(0).attached);
    robots.set({});
    QVERIFY(robots.status().empty());
  }

  void mistakesAreNamed() {
    for (const char* text : {"", "abc", "100,size=5", "100,rate=0", "100,colour=red",
                             "100,team=pink", "-1", "100,robot=0", "100,catalog="}) {
      const auto board = parseAttachedBoard(text);
      QVERIFY2(!board, text);
      QVERIFY(board.error().text().starts_with("--attach"));
    }
    QVERIFY(!parseAttachedBoard("100,catalog=/nonexistent/map.json"));
    const auto board = parseAttachedBoard("300,size=4096");
    QVERIFY(board);
    QCOMPARE(board->number(), 3);
    QVERIFY(!validate(std::vector{*board, *board}));
  }
};

PITCHBOARD_TEST(TestAttachedRobots)

}  // namespace tst_attached_robots

#include "tst_attached_robots.moc"
