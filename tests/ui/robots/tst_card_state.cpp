// SPDX-License-Identifier: GPL-3.0-or-later
// What a card says, from frames; and that its states look different.
#include <QSignalSpy>
#include <QtTest>

#include <robotlink/processes/process_manager.h>
#include <ui/base/theme.h>
#include <ui/robots/card_state.h>
#include <ui/robots/robot_card.h>

namespace tst_card_state {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

link::MatchFrame frameOf(std::uint64_t serial) {
  link::MatchFrame frame;
  frame.serial = serial;
  link::RobotFrame robot;
  robot.identity = {RobotId{4}, TeamColor::Red, 2, true};
  robot.key = link::keyOf(robot.identity);
  robot.name = robot.identity.name();
  robot.action = 8;
  robot.decided = 8;
  robot.battery = telemetry::batteryAt(18.9, telemetry::defaultBattery);
  for (const std::size_t lamp : {1U, 3U, 4U}) robot.lamps[lamp].state = LampState::Working;
  frame.robots.push_back(robot);
  return frame;
}

}  // namespace

class TestCardState : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void showsTheContentsOfTheFrame() {
    CardTracker tracker;
    const auto cards = tracker.update(frameOf(1), 0);
    QCOMPARE(cards.size(), std::size_t(1));
    QCOMPARE(cards[0].name, QStringLiteral("R2"));
    QCOMPARE(cards[0].action, QStringLiteral("walk forward, slow"));
    QCOMPARE(cards[0].tagKind, TagKind::None);
    QCOMPARE(cards[0].lamps[1].state, LampState::Working);
    QCOMPARE(cards[0].lamps[2].state, LampState::Unknown);
  }

  /// Both were "4 Ro…".
  void twoRobotsOfOneNumberLookDifferentWhenCollapsed() {
    link::MatchFrame frame = frameOf(1);
    link::RobotFrame& first = frame.robots[0];
    first.link.emplace().sender.address.value = 0x0a000017;
    first.key = {0, 2, 0};
    first.name = "Robot 2";
    link::RobotFrame second = first;
    second.uid = {2};
    second.key.sender = 1;
    second.name = "Robot 2 (2)";
    second.link->sender.address.value = 0x0a000018;
    frame.robots.push_back(second);
    const auto states = CardTracker().update(frame, 0);
    QCOMPARE(states[0].apart, QStringLiteral(".23"));
    QCOMPARE(states[1].apart, QStringLiteral("(2)"));
    RobotCard card;
    card.resize(240, 40);
    card.setCollapsed(true);
    const auto head = [&card](CardState state) {
      // Whatever else they differ in is not seen on a collapsed card.
      state.id = {};
      state.address.clear();
      card.setState(state);
      return card.grab().toImage();
    };
    CardState alike = states[1];
    alike.apart.clear();
    CardState other = states[0];
    other.apart.clear();
    QCOMPARE(head(alike), head(other));  // their names have no room
    QVERIFY(head(states[0]) != head(states[1]));
    frame.robots[1].identity.number = 3;
    QVERIFY(CardTracker().update(frame, 0)[0].apart.isEmpty());
  }

  /// A past moment is not "paused": the match may go on behind it.
  void thePastHasNoAge() {
    link::MatchFrame frame = frameOf(1);
    frame.paused = true;
    QCOMPARE(CardTracker().update(frame, 0)[0].detail, QStringLiteral("paused · 0.0 m"));
    frame.origin = link::FrameOrigin::Recorded;
    QCOMPARE(CardTracker().update(frame, 0)[0].detail, QStringLiteral("0.0 m"));
  }

  void aProcessThatStopsShowsSinceWhen() {
    CardTracker tracker;
    link::MatchFrame frame = frameOf(1);
    frame.robots[0].lamps[3] = {LampState::NotResponding, 0.0, std::chrono::milliseconds(8900)};
    const auto cards = tracker.update(frame, 0);
    QCOMPARE(cards[0].lamps[3].state, LampState::NotResponding);
    QCOMPARE(cards[0].tag, QStringLiteral("D no reply 8 s"));
    QCOMPARE(cards[0].tagKind, TagKind::Error);
    // Nobody wonders for how long what somebody has stopped is silent.
    link::ProcessStatus decision;
    decision.name = "decision";
    decision.state = link::ProcessState::Stopped;
    frame.robots[0].processList =
        std::make_shared<const std::vector<link::ProcessStatus>>(1, decision);
    const CardState stopped = tracker.update(frame, 100)[0];
    QCOMPARE(stopped.tag, QStringLiteral("D stopped"));
    QCOMPARE(stopped.tagKind, TagKind::Warning);
  }

  void aPenaltyHasTheSameTextEverywhere() {
    link::MatchFrame frame = frameOf(1);
    frame.robots[0].penalty = link::Penalty{PenaltyKind::Incapable, 20};
    QCOMPARE(CardTracker().update(frame, 0)[0].tag, QStringLiteral("pickup 20 s"));
    frame.robots[0].link.emplace();
    QCOMPARE(CardTracker().update(frame, 0)[0].tag, QStringLiteral("pickup 20 s"));
  }

  void aProgramThatKeepsRealTimeIsNamedWithTheReason() {
    CardTracker tracker;
    link::MatchFrame frame = frameOf(1);
    link::ProcessStatus process;
    process.name = "decision";
    process.state = link::ProcessState::Running;
    process.isTeamProgram = true;
    process.clock = link::ProcessClock::RealNotLoaded;
    for (const double speed : {8.0, 1.0, 0.1}) {
      process.speed = speed;
      process.achieved = speed > 1.0 ? 1.0 : 0.0;
      frame.robots[0].processList =
          std::make_shared<const std::vector<link::ProcessStatus>>(1, process);
      const CardState card = tracker.update(frame, 0)[0];
      QCOMPARE(card.tag, QStringLiteral("decision uses real time"));
      QCOMPARE(card.tagTip,
               QStringLiteral("R2 decision uses real time: the clock of the match cannot be "
                              "loaded into it (static or setuid program)"));
      QCOMPARE(card.tagKind, TagKind::Warning);
    }
  }

  // At ×1 it is where the match is; slower than that, it is ahead of it.
  void aProgramThatIsToKeepRealTimeIsNamedAtOtherSpeeds() {
    link::MatchFrame frame = frameOf(1);
    link::ProcessStatus process;
    process.name = "decision";
    process.state = link::ProcessState::Running;
    process.isTeamProgram = true;
    process.clock = link::ProcessClock::Real;
    for (const double speed : {8.0, 1.0, 0.1}) {
      process.speed = speed;
      frame.robots[0].processList =
          std::make_shared<const std::vector<link::ProcessStatus>>(1, process);
      QCOMPARE(CardTracker().update(frame, 0)[0].tag,
               speed == 1.0 ? QString() : QStringLiteral("decision uses real time"));
    }
  }

  void aTeamProgramAndItsCrashesAreNamed() {
    link::MatchFrame frame = frameOf(1);
    link::ProcessStatus process;
    process.id = 7;
    process.name = "decision";
    process.command = {"/usr/bin/python3", "-u", "/home/robot/chase.py", "--key", "100"};
    process.state = link::ProcessState::Running;
    process.isTeamProgram = true;
    process.clock = link::ProcessClock::Match;
    const auto card = [&](CardTracker& tracker) {
      frame.robots[0].processList =
          std::make_shared<const std::vector<link::ProcessStatus>>(1, process);
      frame.robots[0].programs = {process.program()};
      return tracker.update(frame, 0)[0];
    };
    CardTracker tracker;
    QVERIFY2(card(tracker).subtitle.endsWith("chase.py"), qPrintable(card(tracker).subtitle));
    QCOMPARE(card(tracker).tag, QString());
    // It runs again at once, and the card still says what happened.
    process.deaths = 3;
    process.lastDeath = "exit code 1; last output: KeyError: 'ball'";
    QCOMPARE(card(tracker).tag, QStringLiteral("chase.py crashed 3 times"));
    QCOMPARE(card(tracker).tagTip,
             QStringLiteral("R2 decision (chase.py) crashed 3 times, the last time with exit code "
                            "1; last output: KeyError: 'ball'. Click the card to hide this."));
    QCOMPARE(card(tracker).tagKind, TagKind::Error);
    // Until somebody looked.
    tracker.looked(frame.robots[0].uid);
    QCOMPARE(card(tracker).tag, QString());
    process.deaths = 4;
    QCOMPARE(card(tracker).tag, QStringLiteral("chase.py crashed 4 times"));
    // Programs without an interpreter are files themselves.
    process.command = {"../bin/walk", "a.py"};
    QVERIFY(card(tracker).subtitle.endsWith("walk"));
  }

  // Of a recording, which has no processes.
  void aRecordedProgramIsNamedInsteadOfTheBehaviour() {
    link::MatchFrame frame = frameOf(1);
    frame.origin = link::FrameOrigin::Recorded;
    link::RobotFrame& robot = frame.robots[0];
    robot.behaviour = "striker";
    QCOMPARE(subtitleOf(robot), QStringLiteral("Striker"));
    robot.programs = {"chase.py", "walk"};
    QCOMPARE(subtitleOf(robot), QStringLiteral("chase.py, walk"));
  }

  void aProgramThatCannotKeepUpShowsItsMissedCycles() {
    link::MatchFrame frame = frameOf(1);
    link::ProcessStatus process;
    process.name = "decision";
    process.state = link::ProcessState::Running;
    process.isTeamProgram = true;
    process.clock = link::ProcessClock::Match;
    process.speed = 8.0;
    process.achieved = 3.1;
    process.missedCycles = 12;
    frame.robots[0].processList =
        std::make_shared<const std::vector<link::ProcessStatus>>(1, process);
    const CardState card = CardTracker().update(frame, 0)[0];
    QCOMPARE(card.tag, QStringLiteral("decision reaches \u00d73.1"));
    QCOMPARE(card.tagTip,
             QStringLiteral("R2 decision cannot keep up with \u00d78.0 and has missed 12 cycles"));
  }

  void tags_data() {
    QTest::addColumn<int>("voltage");
    QTest::addColumn<bool>("fallen");
    QTest::addColumn<int>("unknown");
    QTest::addColumn<QString>("tag");
    QTest::newRow("full") << 189 << false << 0 << QString();
    QTest::newRow("low") << 151 << false << 0 << QStringLiteral("battery low");
    QTest::newRow("just enough") << 160 << false << 0 << QString();
    QTest::newRow("low comes before fallen") << 151 << true << 0 << QStringLiteral("battery low");
    QTest::newRow("fallen") << 189 << true << 0 << QStringLiteral("fallen");
    QTest::newRow("unknown action") << 189 << false << 42 << QStringLiteral("unknown action");
  }
  void tags() {
    QFETCH(int, voltage);
    QFETCH(bool, fallen);
    QFETCH(int, unknown);
    QFETCH(QString, tag);
    link::MatchFrame frame = frameOf(1);
    frame.robots[0].battery = telemetry::batteryAt(voltage / 10.0, telemetry::defaultBattery);
    frame.robots[0].fallen = fallen;
    if (unknown != 0) {
      frame.robots[0].decided = unknown;
      frame.robots[0].statistics.unknownActions = 1;
      frame.robots[0].statistics.lastUnknownAction = unknown;
    }
    CardTracker tracker;
    QCOMPARE(tracker.update(frame, 0)[0].tag, tag);
  }

  void statesLookDifferent() {
    CardState base = CardTracker().update(frameOf(1), 0)[0];
    CardState silent = base;
    silent.lamps[3] = {LampState::NotResponding, 8};
    CardState low = base;
    low.battery = telemetry::batteryAt(15.1, telemetry::defaultBattery);
    CardState tagged = base;
    tagged.tag = QStringLiteral("fallen");
    tagged.tagKind = TagKind::Warning;
    QList<QImage> seen;
    const auto look = [&seen](const CardState& state, bool selected, bool collapsed) {
      RobotCard card;
      card.setState(state);
      card.setSelected(selected);
      card.setCollapsed(collapsed);
      card.resize(card.sizeHint());
      const QImage image = card.grab().toImage();
      for (const QImage& other : seen) QVERIFY(other != image);
      seen << image;
    };
    for (const CardState& state : {base, silent, low, tagged}) look(state, false, false);
    look(base, true, false);
    look(base, false, true);
    // A collapsed card keeps its alarm.
    look(tagged, false, true);
    tagged.tagKind = TagKind::Error;
    look(tagged, false, true);
  }

  /// However narrow the card: words are cut, not how long it has been.
  void aLongNameLeavesTheVoltsAlone() {
    CardState state = CardTracker().update(frameOf(1), 0)[0];
    state.battery = telemetry::batteryAt(18.9, telemetry::defaultBattery);
    const auto volts = [&state](const QString& name, int width) {
      state.name = name;
      RobotCard card;
      card.setState(state);
      card.resize(width, card.sizeHint().height());
      // From where the volts begin, in the first row.
      const int left = width * 2 / 3;
      return card.grab(QRect(left, 0, width - left, 24)).toImage();
    };
    for (const int width : {190, 240}) {
      QCOMPARE(volts(QStringLiteral("Robot 1"), width), volts(QStringLiteral("B1"), width));
      QCOMPARE(volts(QStringLiteral("Robot 1 of the guests"), width),
               volts(QStringLiteral("B1"), width));
    }
  }
  void aTagFitsInANarrowCard() {
    CardState state = CardTracker().update(frameOf(1), 0)[0];
    state.tagKind = TagKind::Error;
    const auto picture = [&state](const char* tag) {
      state.tag = QString::fromUtf8(tag);
      RobotCard card;
      card.setState(state);
      card.resize(190, card.sizeHint().height());
      return card.grab().toImage();
    };
    // Whole words: another one in the same place is seen.
    QVERIFY(picture("battery low") != picture("battery lot"));
  }
  void theTimeInATagIsSeen() {
    CardState state = CardTracker().update(frameOf(1), 0)[0];
    state.tagKind = TagKind::Error;
    const auto picture = [&state](const char* tag, int width) {
      state.tag = QString::fromUtf8(tag);
      RobotCard card;
      card.setState(state);
      card.resize(width, card.sizeHint().height());
      return card.grab().toImage();
    };
    const int usual = RobotCard().sizeHint().width();
    QVERIFY(picture("communication not responding 4 min 20 s", usual) !=
            picture("communication not responding 4 min 50 s", usual));
    // Where there is no room for all of it, the minutes stay.
    QVERIFY(picture("communication not responding 4 min 20 s", usual * 3 / 4) !=
            picture("communication not responding 5 min 20 s", usual * 3 / 4));
  }

  void clicksSelectAndCollapse() {
    RobotCard card;
    card.setState(CardTracker().update(frameOf(1), 0)[0]);
    card.resize(card.sizeHint());
    QSignalSpy clicked(&card, &RobotCard::clicked);
    QTest::mouseClick(&card, Qt::LeftButton, {}, QPoint(40, 60));
    QCOMPARE(clicked.count(), 1);
    const int tall = card.sizeHint().height();
    QTest::mouseClick(&card, Qt::LeftButton, {}, QPoint(card.width() - 14, 14));
    QVERIFY(card.isCollapsed());
    QVERIFY(card.sizeHint().height() < tall);
    QCOMPARE(clicked.count(), 1);
  }
};

PITCHBOARD_GUI_TEST(TestCardState)

}  // namespace tst_card_state

#include "tst_card_state.moc"
