// SPDX-License-Identifier: GPL-3.0-or-later
// Live as a person sees it: real datagrams on 127.0.0.1, the real window.
#include <QComboBox>
#include <QDockWidget>
#include <QElapsedTimer>
#include <QGraphicsView>
#include <QLabel>
#include <QSettings>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QToolBar>
#include <QToolButton>
#include <QUndoStack>
#include <QtTest>

#include <simcore/world/published_frame.h>
#include <ui/base/notice_bar.h>
#include <ui/base/scoreboard_state.h>
#include <ui/field/field_view.h>
#include <ui/plots/plots_dock.h>
#include <ui/robots/robot_card.h>
#include <ui/robots/robots_dock.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/window/main_window.h>

#include "live_rig.h"
#include "plot_page.h"
#include "plot_pane.h"
#include "scoreboard.h"

using namespace pitchboard;
using namespace pitchboard::ui;
using live_rig::Robot;

class TestLive : public QObject {
  Q_OBJECT

  struct Studio {
    QTemporaryDir folder;
    QSettings settings{folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat};
    MatchController controller;
    MainWindow window;
    link::LiveOptions options = live_rig::options();

    Studio() : controller(inside()), window(&controller, &settings) {
      window.resize(1280, 800);
      window.show();
      live()->setOptions(options);
    }
    static link::MatchOptions inside() {
      link::MatchOptions made;
      made.cognition = link::Cognition::Inline;
      return made;
    }
    LiveController* live() { return window.live(); }
    void change(const std::function<void(link::LiveOptions&)>& edit) {
      edit(options);
      live()->setOptions(options);
    }
    /// Through the button, as a person does.
    void goLive() {
      for (auto* button : window.findChildren<QToolButton*>(QStringLiteral("mode"))) {
        if (button->text() == QStringLiteral("Live")) QTest::mouseClick(button, Qt::LeftButton);
      }
      QTRY_VERIFY(live()->frame());
      QTRY_COMPARE(bound(), std::size_t(17));
    }
    std::size_t bound() {
      std::size_t count = 0;
      for (const auto& port : live()->details().network.ports) count += port.bound ? 1 : 0;
      return count;
    }
    std::size_t robots() { return live()->frame()->robots.size(); }
    const link::RobotHealth& health(std::size_t i = 0) {
      return *live()->frame()->robots.at(i).health;
    }
    QList<RobotCard*> cards() { return window.findChild<RobotsDock*>()->cards(); }
    QGraphicsView* canvas() { return window.field()->findChild<QGraphicsView*>(); }
    Scoreboard* scoreboard() { return window.findChild<Scoreboard*>(QStringLiteral("scoreboard")); }
    QString label(const char* name) {
      return window.findChild<QLabel*>(QLatin1String(name))->text();
    }
  };

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void aFrameShowsWhatARobotSays() {
    Studio s;
    s.goLive();
    const Robot robot(s.options, 3);
    const telemetry::TextMessage said = live_rig::message(3);
    QVERIFY(robot.say(said));
    QTRY_COMPARE(s.robots(), std::size_t(1));
    const FramePtr frame = s.live()->frame();
    QCOMPARE(frame->origin, link::FrameOrigin::Live);
    QVERIFY(!frame->truthKnown && !frame->ballKnown);
    const sim::RobotSnapshot& shown = frame->robots[0];
    QCOMPARE(shown.identity.id, RobotId{3});
    const Pose believed = sim::published_frame::studioFromLocalization(
        s.options.field, {double(said.x), double(said.y), double(said.theta)});
    QCOMPARE(shown.pose.position.x, believed.position.x);
    QCOMPARE(shown.pose.position.y, believed.position.y);
    QCOMPARE(shown.pose.yaw, believed.yaw);
    QCOMPARE(frame->robots[0].board->belief, 20.0F);
    const link::RobotHealth& health = *frame->robots[0].health;
    QVERIFY(health.poseKnown && health.ball && health.battery);
    QVERIFY(qAbs(health.battery->volts - 16.5) < 1e-9);
    QVERIFY(qAbs(std::hypot(health.ball->x - believed.position.x,
                            health.ball->y - believed.position.y) -
                 1.0) < 1e-6);
    QCOMPARE(health.action, std::optional(8));
    QTRY_COMPARE(s.cards().size(), qsizetype(1));
    QCOMPARE(s.cards()[0]->state().action, QStringLiteral("walk forward, slow"));
  }

  // What the default profile says is named otherwise than on a blackboard.
  void theFirstPlotsShowWhatIsHeard() {
    Studio s;
    s.goLive();
    const Robot robot(s.options, 3);
    telemetry::TextMessage said = live_rig::message(3);
    said.ballDist = 123.0F;
    QVERIFY(robot.say(said));
    const auto panes = s.window.findChild<PlotsDock*>()->currentPage()->panes();
    QCOMPARE(panes.size(), 2);
    QTRY_COMPARE(s.robots(), std::size_t(1));
    const auto value = [](const PlotPane* pane) -> std::optional<double> {
      return pane->curves().empty() ? std::nullopt : pane->curves()[0].valueAt(std::nullopt);
    };
    QTRY_COMPARE(value(panes[0]), std::optional(123.0));
    QCOMPARE(panes[0]->curves()[0].name(), QStringLiteral("BALL_DIST Robot 3"));
    QTRY_COMPARE(value(panes[1]), std::optional(8.0));
    QCOMPARE(panes[1]->curves()[0].codeText(8), QStringLiteral("walk forward, slow"));
  }

  void theWindowFollowsTheMode() {
    Studio s;
    auto* chooser = s.window.findChild<QComboBox*>(QStringLiteral("scenarioChooser"));
    auto* team = s.window.findChild<QComboBox*>(QStringLiteral("ourTeam"));
    QVERIFY(chooser->isVisible() && !team->isVisible());
    s.goLive();
    QVERIFY(!chooser->isVisible() && team->isVisible());
    QTRY_COMPARE(s.scoreboard()->state().state, QStringLiteral("NO REFEREE"));
    QTRY_VERIFY(s.label("noRobots").contains(QStringLiteral("Nothing heard yet")));
    QTRY_VERIFY(s.label("statusPace").contains(QStringLiteral("UDP 0/s, 0 lost, 0 bad")));
    s.window.showSource(SourceKind::Simulate);
    QTRY_VERIFY(chooser->isVisible() && !team->isVisible());
    QVERIFY(s.live()->isListening());
  }

  /// Issue: a frame arrives on screen within 50 ms of its datagram.
  void aDatagramIsPaintedWithin50Milliseconds() {
    Studio s;
    s.goLive();
    QVERIFY(QTest::qWaitForWindowExposed(&s.window));
    struct PaintClock : QObject {
      LiveController* live = nullptr;
      int wanted = -1;
      qint64 paintedAt = -1;
      QElapsedTimer clock;
      bool eventFilter(QObject*, QEvent* event) override {
        const FramePtr frame = live->frame();
        if (event->type() == QEvent::Paint && paintedAt < 0 && frame && !frame->robots.empty() &&
            frame->robots[0].board->localizationX == wanted) {
          paintedAt = clock.nsecsElapsed();
        }
        return false;
      }
    } painted;
    painted.live = s.live();
    s.canvas()->viewport()->installEventFilter(&painted);
    const Robot robot(s.options, 1);
    QVERIFY(robot.say());
    QTRY_COMPARE(s.robots(), std::size_t(1));
    std::vector<double> milliseconds;
    for (int i = 0; i < 31; ++i) {
      telemetry::TextMessage m = live_rig::message(1);
      m.x = 300 + i;
      painted.wanted = m.x;
      painted.paintedAt = -1;
      painted.clock.start();
      QVERIFY(robot.say(m));
      while (painted.paintedAt < 0 && painted.clock.elapsed() < 2000) {
        QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
      }
      QVERIFY(painted.paintedAt >= 0);
      milliseconds.push_back(double(painted.paintedAt) / 1e6);
    }
    std::sort(milliseconds.begin(), milliseconds.end());
    qInfo("datagram to paint: median %.1f ms, longest %.1f ms", milliseconds[15],
          milliseconds.back());
    // The longest belongs to whatever else this computer does; half of them must be quick.
    QVERIFY2(milliseconds[15] < 50.0, qPrintable(QString::number(milliseconds[15])));
  }

  void nothingCanBeMovedInLive() {
    Studio s;
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    QTRY_VERIFY(s.controller.frame());
    const FramePtr before = s.controller.frame();
    s.goLive();
    const Robot robot(s.options, 1);
    QVERIFY(robot.say());
    QTRY_COMPARE(s.robots(), std::size_t(1));
    const Point at = s.live()->frame()->robots[0].pose.position;
    QTRY_COMPARE(s.cards().size(), qsizetype(1));
    auto* canvas = s.canvas();
    const QPoint here = canvas->mapFromScene(QPointF(at.x, at.y));
    canvas->setFocus();
    QTest::mouseClick(canvas->viewport(), Qt::LeftButton, {}, here);
    QCOMPARE(s.window.field()->selection(), std::vector<RobotId>{RobotId{1}});
    QTest::mousePress(canvas->viewport(), Qt::LeftButton, {}, here);
    QTest::mouseMove(canvas->viewport(), here + QPoint(60, 40));
    QTest::mouseRelease(canvas->viewport(), Qt::LeftButton, {}, here + QPoint(60, 40));
    QTest::mouseDClick(canvas->viewport(), Qt::LeftButton, {}, here);
    for (const int key : {Qt::Key_A, Qt::Key_B, Qt::Key_Delete, Qt::Key_Insert, Qt::Key_Left,
                          Qt::Key_F, Qt::Key_L, Qt::Key_Y, Qt::Key_F3, Qt::Key_F4, Qt::Key_F5}) {
      QTest::keyClick(canvas, Qt::Key(key));
    }
    for (QAction* action : s.window.findChildren<QAction*>()) {
      const QString text = action->text().remove(QLatin1Char('&'));
      if (text.startsWith(QStringLiteral("Delete selected")) ||
          text.startsWith(QStringLiteral("Undo")) || text == QStringLiteral("Restart") ||
          text.startsWith(QStringLiteral("Reset score"))) {
        QVERIFY2(!action->isEnabled(), qPrintable(text));
      }
    }
    QCOMPARE(s.live()->frame()->robots[0].pose.position, at);
    QVERIFY(s.controller.isPaused());
    s.window.showSource(SourceKind::Simulate);
    // It may have been published anew, with all that stood in it.
    const FramePtr after = s.controller.frame();
    QCOMPARE(after->snapshot.tick, before->snapshot.tick);
    QCOMPARE(after->snapshot.ball, before->snapshot.ball);
    QCOMPARE(after->robots.size(), before->robots.size());
    for (std::size_t i = 0; i < after->robots.size(); ++i) {
      QCOMPARE(after->robots[i].pose, before->robots[i].pose);
    }
    QVERIFY(s.controller.edits()->undoStack() != nullptr);
    QTest::keyClick(canvas, Qt::Key_Space);
    QVERIFY(s.window.field()->isFlipped());
  }

  void aRobotTimesOutAndComesBack() {
    Studio s;
    s.change([](link::LiveOptions& o) { o.team.timeout = std::chrono::milliseconds(300); });
    s.goLive();
    const Robot robot(s.options, 2);
    QVERIFY(robot.say());
    QTRY_COMPARE(s.cards().size(), qsizetype(1));
    QTRY_VERIFY(s.cards()[0]->state().tag.startsWith(QStringLiteral("TIMEOUT")));
    QVERIFY(s.cards()[0]->state().timedOut);
    QVERIFY(s.cards()[0]->state().action.startsWith(QStringLiteral("last: ")));
    QTRY_VERIFY(s.label("statusProcesses").contains(QStringLiteral("has not been heard")));
    QVERIFY(robot.say());
    QTRY_VERIFY(!s.health().timedOut);
    QTRY_VERIFY(!s.cards()[0]->state().timedOut);
    QCOMPARE(s.health().recoveries, std::uint64_t(1));
  }

  void theSameNumberFromTwoSendersIsFlagged() {
    Studio s;
    s.goLive();
    const Robot one(s.options, 4), two(s.options, 4);
    // Two programs take turns; the order is what matters.
    const std::uint64_t before = s.live()->details().network.datagrams();
    const auto heard = [&] { return s.live()->details().network.datagrams() - before; };
    for (std::uint64_t i = 0; i < 3; ++i) {
      QVERIFY(one.say());
      QTRY_COMPARE(heard(), 2 * i + 1);
      telemetry::TextMessage other = live_rig::message(4);
      other.x += 100 + static_cast<int>(i);
      QVERIFY(two.say(other));
      QTRY_COMPARE(heard(), 2 * i + 2);
    }
    QTRY_COMPARE(s.robots(), std::size_t(2));
    QVERIFY(s.health(0).conflict && s.health(1).conflict);
    QVERIFY(s.live()->frame()->robots[0].id() != s.live()->frame()->robots[1].id());
    QTRY_COMPARE(s.cards().size(), qsizetype(2));
    QCOMPARE(s.cards()[0]->state().tag, QStringLiteral("number sent twice"));
  }

  void lowBatteryAndSilentProcess() {
    Studio s;
    s.goLive();
    const Robot robot(s.options, 1);
    telemetry::TextMessage m = live_rig::message(1);
    m.voltage = 135;
    QVERIFY(robot.say(m));
    QTRY_COMPARE(s.cards().size(), qsizetype(1));
    QTRY_COMPARE(s.cards()[0]->state().tag, QStringLiteral("battery low"));
    for (int i = 0; i < 8; ++i) {
      m.decision = 0;
      m.x += 1;
      QVERIFY(robot.say(m));
    }
    QTRY_VERIFY(s.cards()[0]->state().tag.startsWith(QStringLiteral("D silent")));
  }

  void theRefereesPacketsFillTheScoreboard_data() {
    QTest::addColumn<QString>("file");
    const QDir folder(QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/data/gamecontroller"));
    for (const QString& file :
         folder.entryList({QStringLiteral("*_PENALISED*.bin"), QStringLiteral("*_PLAYING*.bin"),
                           QStringLiteral("*_SET*.bin")})) {
      if (!file.contains(QStringLiteral("truedata"))) QTest::newRow(qPrintable(file)) << file;
    }
  }
  void theRefereesPacketsFillTheScoreboard() {
    QFETCH(QString, file);
    const std::string bytes = live_rig::packet(file);
    const auto packet = telemetry::decodeReferee(bytes);
    QVERIFY(packet);
    const auto state = std::get<telemetry::RefereeState>(*packet);
    const link::LiveOptions options = live_rig::options();
    LiveController live;
    live.setOptions(options);
    live.start();
    QTRY_VERIFY(!live.details().network.ports.empty());
    const TestSocket referee;
    QVERIFY(referee.send(static_cast<std::uint16_t>(options.refereePort), bytes));
    QTRY_VERIFY(live.frame() && live.frame()->referee);
    const ScoreboardState shown = scoreboardOf(*live.frame());
    QCOMPARE(shown.left, state.teams[0].score);
    QCOMPARE(shown.right, state.teams[1].score);
    QVERIFY2(shown.state.startsWith(QString::fromUtf8(telemetry::stateName(state.state).data())),
             qPrintable(shown.state));
    QVERIFY(!referee.heard());
  }

  void penaltiesOfOurTeamAreMarked() {
    const std::string bytes = live_rig::packet(QStringLiteral("v12hl640_2017.3_PENALISED.bin"));
    const auto state = std::get<telemetry::RefereeState>(telemetry::decodeReferee(bytes).value());
    int team = 0, player = 0;
    for (const auto& side : state.teams) {
      for (const auto& slot : side.players()) {
        if (slot.penalty == 0 || telemetry::isSubstitute(state, slot) || player != 0) continue;
        team = side.number;
        player = slot.number;
      }
    }
    QVERIFY(player > 0);
    Studio s;
    s.goLive();
    const Robot robot(s.options, player);
    const TestSocket referee;
    QVERIFY(referee.send(static_cast<std::uint16_t>(s.options.refereePort), bytes));
    QVERIFY(robot.say());
    QTRY_VERIFY(s.robots() == 1 && s.live()->frame()->referee);
    QVERIFY(!s.health().penalty);
    s.live()->setOurTeam(team);
    QTRY_VERIFY(s.health().penalty);
    QTRY_VERIFY(!s.cards().isEmpty() && s.cards()[0]->state().tagKind == TagKind::Warning);
    auto* chooser = s.window.findChild<QComboBox*>(QStringLiteral("ourTeam"));
    QTRY_COMPARE(chooser->currentData().toInt(), team);
  }

  void aGoalIsAnEvent() {
    const link::LiveOptions options = live_rig::options();
    LiveController live;
    live.setOptions(options);
    QSignalSpy events(&live, &FrameSource::eventsReceived);
    live.start();
    QTRY_VERIFY(!live.details().network.ports.empty());
    const TestSocket referee;
    const auto send = [&](const char* file) {
      return referee.send(static_cast<std::uint16_t>(options.refereePort),
                          live_rig::packet(QLatin1String(file)));
    };
    QVERIFY(send("v12hl688_INITIAL.bin"));
    QTRY_VERIFY(live.frame() && live.frame()->referee);
    QVERIFY(send("v12hl688_PLAYING_1-0.bin"));
    const auto goal = [&events]() -> std::optional<link::MatchEvent> {
      for (const auto& call : events) {
        for (const auto& event : call[0].value<std::vector<link::MatchEvent>>()) {
          if (event.kind == link::MatchEventKind::Goal) return event;
        }
      }
      return {};
    };
    QTRY_VERIFY(goal());
    QVERIFY(goal()->side && goal()->team != 0);
    QCOMPARE(goal()->score, (sim::Score{1, 0}));
  }

  void aTakenPortIsNamedAndTheOthersWork() {
    Studio s;
    const int stubborn = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in name{};
    name.sin_family = AF_INET;
    name.sin_port = htons(static_cast<std::uint16_t>(s.options.portBase + 5));
    name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    QCOMPARE(bind(stubborn, reinterpret_cast<sockaddr*>(&name), sizeof name), 0);
    s.window.showSource(SourceKind::Live);
    QTRY_COMPARE(s.bound(), std::size_t(16));
    QTRY_VERIFY(s.window.notices()->text().contains(QString::number(s.options.portBase + 5)));
    QTRY_VERIFY(s.label("statusProcesses").contains(QStringLiteral("Not received")));
    const Robot robot(s.options, 6);
    QVERIFY(robot.say());
    QTRY_COMPARE(s.robots(), std::size_t(1));
    close(stubborn);
    QTRY_COMPARE_WITH_TIMEOUT(s.bound(), std::size_t(17), 8000);
  }

  void aFloodOfNonsenseIsCounted() {
    Studio s;
    s.change([](link::LiveOptions& o) {
      o.robots = 64;
      o.refereePort = o.portBase + 66;
    });
    s.window.showSource(SourceKind::Live);
    QTRY_COMPARE(s.bound(), std::size_t(65));
    const TestSocket sender;
    const auto port = [&](int robot) {
      return static_cast<std::uint16_t>(s.options.portBase + robot);
    };
    const std::string binary("\x00\xff\x01\x80OUT", 8);
    for (int i = 0; i < 50; ++i) {
      sender.send(port(1), "1 nan inf -inf nan 1e400 x 1 1 1 1 1 8 nan 189 OUT");
      sender.send(port(2), binary);
      sender.send(port(3), "");
      sender.send(port(4), std::string(60000, '7'));
      sender.send(port(5), "5 1 2");
      sender.send(port(6),
                  "6 999999999999999999999 -999999999 2147483647 1e38 1e38 1e38 1 1 1 1 1 "
                  "2147483647 1 99999 OUT");
      sender.send(static_cast<std::uint16_t>(s.options.refereePort), "RGme nonsense");
    }
    for (int robot = 1; robot <= 70; ++robot) {
      sender.send(port(1 + robot % 64), telemetry::encode(live_rig::message(robot)));
    }
    QTRY_COMPARE(s.live()->details().team.refusedRobots, std::uint64_t(6));
    const link::LiveDetails details = s.live()->details();
    QVERIFY(details.team.errors.count(telemetry::TextError::Binary) >= 50);
    QVERIFY(details.team.errors.count(telemetry::TextError::NotFinite) >= 50);
    QVERIFY(details.team.errors.count(telemetry::TextError::MissingFields) >= 50);
    QCOMPARE(details.unknownReferee, std::uint64_t(50));
    QCOMPARE(details.network.queueDrops, std::uint64_t(0));
    QTRY_COMPARE(s.robots(), std::size_t(64));
    // Drawn without harm, numbers beyond all bounds included.
    QTRY_COMPARE(s.cards().size(), qsizetype(64));
    QVERIFY(!s.window.grab().isNull());
    for (const sim::RobotSnapshot& robot : s.live()->frame()->robots) {
      QVERIFY(std::isfinite(robot.pose.position.x) && std::abs(robot.pose.position.x) < 200);
      QVERIFY(std::isfinite(robot.pose.yaw));
    }
  }

  void otherSendersAreRefused() {
    Studio s;
    s.change([](link::LiveOptions& o) { QVERIFY(o.team.senders.add("10.1.2.3")); });
    s.goLive();
    const Robot robot(s.options, 1);
    QVERIFY(robot.say());
    QTRY_COMPARE(s.live()->details().team.refusedByFilter, std::uint64_t(1));
    QCOMPARE(s.robots(), std::size_t(0));
  }

  void aRecordedMatchIsReplayedThroughSockets() {
    QFile file(
        QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/data/telemetry_capture_1_robot_60s.txt"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    Studio s;
    s.goLive();
    const Robot robot(s.options, 1);
    std::uint64_t sent = 0;
    while (!file.atEnd()) {
      const QByteArray line = file.readLine().trimmed();
      const qsizetype tab = line.lastIndexOf('\t');
      if (tab < 0) continue;
      QVERIFY(robot.say(line.mid(tab + 1).toStdString()));
      ++sent;
    }
    QVERIFY(sent > 50);
    QTRY_COMPARE(s.robots() == 1 ? s.health().messages : 0, sent);
    QCOMPARE(s.health().errorCount, std::uint64_t(0));
    QVERIFY(!robot.heard());
  }

  void robotsAgreeOnTheBall() {
    Studio s;
    s.goLive();
    const auto says = [&](int number, int x, double distance) {
      telemetry::TextMessage m = live_rig::message(number);
      m.x = x;
      m.y = 300;
      m.theta = 0;
      m.ballAngle = 0;
      m.ballDist = static_cast<float>(distance);
      return Robot(s.options, number).say(m);
    };
    QVERIFY(says(1, 300, 150) && says(2, 200, 270) && says(3, 100, 20));
    QTRY_COMPARE(s.robots(), std::size_t(3));
    QTRY_VERIFY(s.live()->frame()->teamBall);
    const link::TeamBall ball = *s.live()->frame()->teamBall;
    QCOMPARE(ball.agree, 2);
    QCOMPARE(ball.see, 3);
    QVERIFY(qAbs(ball.position.x - 0.10) < 1e-6);
    QVERIFY(qAbs(ball.spread - 0.10) < 1e-6);
  }

  void cardsFloatReorderAndHide() {
    Studio s;
    s.goLive();
    for (int n = 1; n <= 3; ++n) QVERIFY(Robot(s.options, n).say());
    QTRY_COMPARE(s.cards().size(), qsizetype(3));
    auto* dock = s.window.findChild<RobotsDock*>();
    // Drag the first below the last.
    RobotCard* first = s.cards()[0];
    const QPoint below =
        first->mapFromGlobal(s.cards()[2]->mapToGlobal(QPoint(60, s.cards()[2]->height() - 2)));
    QTest::mousePress(first, Qt::LeftButton, {}, QPoint(60, 40));
    QTest::mouseMove(first, QPoint(60, 60));
    QTest::mouseMove(first, below);
    QTest::mouseRelease(first, Qt::LeftButton, {}, below);
    QCOMPARE(s.cards()[2], first);
    dock->floatCard(RobotId{1});
    QCOMPARE(s.cards().size(), qsizetype(2));
    QVERIFY(dock->floating(RobotId{1})->isFloating());
    QVERIFY(first->isVisible());
    dock->floating(RobotId{1})->close();
    QCOMPARE(s.cards().size(), qsizetype(3));
    QVERIFY(first->isVisible());
    CardParts parts = dock->parts();
    const int tall = first->sizeHint().height();
    parts.processes = parts.battery = false;
    dock->setParts(parts);
    QVERIFY(first->sizeHint().height() < tall);
    parts.values << QStringLiteral("BALL_DIST") << QStringLiteral("X");
    dock->setParts(parts);
    QVERIFY(!first->grab().isNull());
    QCOMPARE(s.settings.value(QStringLiteral("cards/values")).toStringList().size(), qsizetype(2));
    QVERIFY(s.settings.value(QStringLiteral("cards/hidden"))
                .toStringList()
                .contains(QStringLiteral("battery")));
  }

  void simulatedAndHeardStandSideBySide() {
    Studio s;
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    QTRY_VERIFY(s.controller.frame());
    s.window.overlayLive(true);
    QVERIFY(s.live()->isListening());
    QTRY_COMPARE(s.bound(), std::size_t(17));
    const sim::RobotSnapshot truth = s.controller.frame()->robots[0];
    const auto cm = sim::published_frame::localizationFromStudio(s.options.field, truth.pose);
    telemetry::TextMessage m = live_rig::message(1);
    m.x = int(std::lround(cm.x)) + 30;
    m.y = int(std::lround(cm.y)) + 40;
    m.theta = int(std::lround(cm.degrees)) + 10;
    QVERIFY(Robot(s.options, 1).say(m));
    const auto error = [&]() -> QString {
      for (RobotCard* card : s.cards()) {
        if (card->state().id != RobotId{1}) continue;
        for (const CardValue& value : card->state().values) {
          if (value.name == QStringLiteral("BELIEF_ERROR")) return value.text;
        }
      }
      return {};
    };
    QTRY_VERIFY(qAbs(error().toDouble() - 50.0) < 2.0);
    QTRY_VERIFY(s.cards()[0]->state().detail.contains(QStringLiteral("50 cm 10°")));
    s.window.overlayLive(false);
    QTRY_VERIFY(error().isEmpty());
  }
};

QTEST_MAIN(TestLive)
#include "tst_live.moc"
