// SPDX-License-Identifier: GPL-3.0-or-later
// A robot that is this computer, through the window: its blackboard is shown, recorded, looked back
// at and replayed, and what was plotted of it in a simulation goes on in Live and in Replay.
#include <sys/ipc.h>
#include <sys/shm.h>
#include <unistd.h>

#include <QMenuBar>
#include <bit>
#include <cstring>

#include <robotlink/blackboard/system_v.h>
#include <ui/field/field_view.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/replay_controller.h>

#include "../robotlink/frame_difference.h"
#include "../support/menu_entry.h"
#include "../support/robot_keys.h"
#include "chart_pane.h"
#include "live_rig.h"
#include "session_rig.h"

namespace tst_session_attached {

using namespace pitchboard;
using namespace pitchboard::ui;
using session_rig::Studio;

namespace {

/// The memory of the robot's own processes, which write it while the studio reads.
class Segment {
 public:
  explicit Segment(int key) : m_id(shmget(key, 2048, IPC_CREAT | IPC_EXCL | 0600)) {
    if (m_id < 0) qFatal("the key is in use");
    m_words = static_cast<char*>(shmat(m_id, nullptr, 0));
  }
  ~Segment() {
    shmdt(m_words);
    shmctl(m_id, IPC_RMID, nullptr);
  }
  Segment(const Segment&) = delete;
  Segment& operator=(const Segment&) = delete;

  void write(const char* name, double value) const {
    for (const link::Variable& variable : link::VariableCatalog::published().variables()) {
      if (variable.name != name) continue;
      const bool isInt = variable.type == link::VariableType::Int;
      const auto word = isInt ? std::bit_cast<std::uint32_t>(static_cast<std::int32_t>(value))
                              : std::bit_cast<std::uint32_t>(static_cast<float>(value));
      const int at = variable.index + (isInt ? 0 : link::SegmentLayout().floatOffset);
      std::memcpy(m_words + 4 * at, &word, 4);
      return;
    }
    qFatal("no variable %s", name);
  }
  /// A step of its walk.
  void walk(int step) const {
    write("LOCALIZATION_Y", 300 + 10 * step);
    write("LOCALIZATION_THETA", 30 * step % 360);
    write("VISION_PAN_DEG", -5.0 * step);
    write("VISION_BALL_DIST", 80.0 + step);
    write("DECISION_ACTION_A", step % 2 == 0 ? 8 : 0);
    write("VOLTAGE", 165 - 4 * step);
    for (const char* process : {"VISION_WORKING", "LOCALIZATION_WORKING", "DECISION_WORKING",
                                "CONTROL_WORKING", "IMU_WORKING"}) {
      write(process, 1);
    }
    write("LOCALIZATION_X", 500 + 20 * step);  // last: whoever sees it sees all of the step
  }

 private:
  int m_id;
  char* m_words;
};

int freeKey() {
  return 0x5200'0000 + static_cast<int>(getpid() % 100'000) * 64;
}

link::LiveOptions attachedTo(const QStringList& boards) {
  link::LiveOptions options = live_rig::options();
  for (const QString& text : boards) {
    const auto board = link::parseAttachedBoard(text.toStdString());
    if (!board) qFatal("%s", board.error().text().c_str());
    options.boards.push_back(*board);
  }
  return options;
}

QString boardOfB3(int key) {
  return QStringLiteral("%1,robot=3,rate=100,team=blue").arg(key);
}

}  // namespace

class TestSessionAttached : public QObject {
  Q_OBJECT

  /// The frames that were on the screen, one for each step, taken when the step was to be seen.
  static std::vector<FramePtr> walk(Studio& s, const Segment& segment, int from, int to) {
    std::vector<FramePtr> seen;
    LiveController* live = s.window.live();
    for (int step = from; step < to; ++step) {
      segment.walk(step);
      double first = -1.0;
      // A while behind the sample in which it came, so that its row is older than the frame.
      const bool shown = QTest::qWaitFor(
          [&] {
            const FramePtr frame = live->frame();
            if (!frame || frame->robots.size() != 1 || !frame->robots[0].belief ||
                qRound(100 * (frame->robots[0].belief->position.x + 4.5)) != 500 + 20 * step) {
              return false;
            }
            if (first < 0.0) first = frame->snapshot.time;
            return frame->snapshot.time > first + 0.1;
          },
          20'000);
      if (!shown) return {};
      seen.push_back(live->frame());
    }
    return seen;
  }
  /// How long ago, how often and how evenly it was read is not what its program wrote.
  static QString differenceOf(const FramePtr& seen, const FramePtr& again) {
    if (!again || again->robots.size() != seen->robots.size()) return QStringLiteral("no robot");
    link::RobotFrame a = seen->robots[0], b = again->robots[0];
    if (!a.link || !b.link) return QStringLiteral("not heard");
    for (link::RobotFrame* robot : {&a, &b}) {
      telemetry::LinkHealth& health = *robot->link;
      health.age = {};
      health.jitter = {};
      health.rate = {};
      health.messages = {};
      health.bytes = {};
      for (auto& lamp : robot->lamps) lamp.since = {};
    }
    return link::difference(a, b);
  }

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void whatWasOnTheScreenIsSeenAgain() {
    const int key = freeKey();
    const Segment segment(key);
    Studio s(0);
    s.window.live()->setOptions(attachedTo({boardOfB3(key)}));
    s.window.showSource(SourceKind::Live);
    QVERIFY(!walk(s, segment, 0, 1).empty());
    QVERIFY2(s.window.recording()->isPossible(), "without a match and without a message");
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QVERIFY2(s.window.recording()->isRecording(), qPrintable(s.notice()));
    std::vector<FramePtr> seen = walk(s, segment, 1, 9);
    QCOMPARE(seen.size(), std::size_t(8));
    QCOMPARE(seen[0]->robots[0].identity.name(), std::string("B3"));
    QVERIFY(seen[0]->robots[0].battery && seen[0]->robots[0].ball);
    QVERIFY(!(seen[0]->robots[0].pose == seen[7]->robots[0].pose));
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QTRY_COMPARE(saved.size(), 1);

    // Looking back in Live, while its program goes on.
    segment.walk(40);
    ShownMoment* timeline = s.window.shown();
    // The newest one is not the past, and it may have come after the end of the file.
    seen.pop_back();
    for (const FramePtr& frame : seen) {
      timeline->seek(frame->snapshot.time);
      QVERIFY(timeline->isLookingBack());
      const QString found = differenceOf(frame, s.window.live()->frameAt(timeline->time()));
      QVERIFY2(found.isEmpty(), qPrintable(found));
    }
    timeline->goLive();

    const QString path = saved.at(0).at(0).toString();
    s.window.openSession(path);
    QTRY_VERIFY(!timeline->kind().hasPresent);
    for (const FramePtr& frame : seen) {
      timeline->seek(frame->snapshot.time);
      const auto isThere = [&] {
        const FramePtr again = s.window.replay()->frame();
        return again && std::abs(again->snapshot.time - frame->snapshot.time) < 1e-6;
      };
      QTRY_VERIFY2(
          isThere(),
          qPrintable(
              QString("%1 of %2").arg(frame->snapshot.time).arg(seen.back()->snapshot.time)));
      const QString found = differenceOf(frame, s.window.replay()->frame());
      QVERIFY2(found.isEmpty(), qPrintable(found));
    }
  }

  /// A plot and an expression made in a simulation, without a word changed.
  void whatIsPlottedCarriesOver() {
    const int key = freeKey() + 1;
    const Segment segment(key);
    Studio s(120);
    auto* plots = s.window.findChild<PlotsDock*>();
    PaneSpec chart;
    chart.curves << variableCurve(QStringLiteral("B3/VISION_PAN_DEG"));
    CurveSpec expression;
    expression.kind = CurveKind::Expression;
    expression.expression = QStringLiteral("2 * B3.LOCALIZATION_X");
    chart.curves << expression;
    plots->setLayoutSpec({{PageSpec{QStringLiteral("one"), {chart}}}, 0});
    // The lowest of the one, the highest of the other.
    const auto tops = [plots] {
      for (const ChartPane* pane : plots->findChildren<ChartPane*>()) {
        const auto& traces = pane->traces();
        if (traces.size() == 2 && traces[0].any && traces[1].any) {
          return std::pair(traces[0].low, traces[1].high);
        }
      }
      return std::pair(0.0, 0.0);
    };
    QTRY_VERIFY_WITH_TIMEOUT(s.played(120), 20'000);
    QTRY_VERIFY_WITH_TIMEOUT(tops().second != 0.0, 20'000);

    s.window.live()->setOptions(attachedTo({boardOfB3(key)}));
    s.window.showSource(SourceKind::Live);
    QVERIFY(!walk(s, segment, 1, 2).empty());
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QVERIFY(!walk(s, segment, 2, 5).empty());
    const std::pair expected(-20.0, 2.0 * 580);
    QTRY_COMPARE_WITH_TIMEOUT(tops(), expected, 20'000);
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QTRY_COMPARE(saved.size(), 1);

    s.window.openSession(saved.at(0).at(0).toString());
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    s.window.shown()->seek(s.window.shown()->available()->end);
    const auto whole = *s.window.shown()->available();
    plots->time()->setRange({whole.begin, whole.end + 0.1});
    QTRY_COMPARE_WITH_TIMEOUT(tops(), expected, 20'000);
    QCOMPARE(plots->layoutSpec().pages[0].panes[0].curves[1].expression, expression.expression);
  }

  /// Several of them, beside robots that send; and one that is not wanted is forgotten by its menu.
  void severalStandBesideRobotsThatSend() {
    const int key = freeKey() + 2;
    const Segment one(key), two(key + 1);
    Studio s(0);
    const link::LiveOptions options =
        attachedTo({boardOfB3(key), QStringLiteral("%1,robot=4,team=red").arg(key + 1)});
    s.window.live()->setOptions(options);
    s.window.showSource(SourceKind::Live);
    one.walk(1);
    two.walk(2);
    const live_rig::Robot sender(options, 2);
    const auto robotsShown = [&s] {
      QStringList names;
      if (const FramePtr frame = s.window.live()->frame()) {
        for (const auto& robot : frame->robots) {
          names << QString::fromStdString(robot.identity.name());
        }
      }
      names.sort();
      return names.join(QLatin1Char(' '));
    };
    const auto received = [&] {
      return sender.sendMessage() && robotsShown() == QStringLiteral("B2 B3 R4");
    };
    QTRY_VERIFY2(received(), qPrintable(robotsShown()));

    QAction* forget = nullptr;
    const auto isOffered = [&] {
      s.window.field()->select(
          {uidIn(*s.window.live()->frame(), receivedAs(2))});  // not before the field has it, too
      const QAction* robots = menu_entry::downFrom(s.window.menuBar(), {"Robots"});
      forget = robots->menu()->findChild<QAction*>(QStringLiteral("forgetRobot"));
      return forget != nullptr;
    };
    QTRY_VERIFY(isOffered());
    QVERIFY2(forget->text().endsWith(QStringLiteral("2")), qPrintable(forget->text()));
    // A message that was on its way brings it back.
    const auto isForgotten = [&] {
      if (robotsShown() == QStringLiteral("B2 B3 R4") && isOffered()) {
        forget->trigger();
      }
      return robotsShown() == QStringLiteral("B3 R4");
    };
    QTRY_VERIFY2(isForgotten(), qPrintable(robotsShown()));
    QVERIFY(s.window.live()
                ->series()
                ->find("Robot 2", "LOCALIZATION_X")
                .has_value());  // its curves stay
    QTRY_VERIFY(received());
  }
};

PITCHBOARD_GUI_TEST(TestSessionAttached)

}  // namespace tst_session_attached

#include "tst_session_attached.moc"
