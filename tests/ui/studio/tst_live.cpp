// SPDX-License-Identifier: GPL-3.0-or-later
// Live as a person sees it: real datagrams on 127.0.0.1, the real window.

#include <QComboBox>
#include <QElapsedTimer>
#include <QFile>
#include <QFileDialog>
#include <QtTest>
#include <optional>

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
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>

#include "../support/robot_keys.h"
#include "live_rig.h"
#include "live_studio.h"
#include "plot_page.h"
#include "plot_pane.h"
#include "scoreboard.h"

namespace tst_live {

using namespace pitchboard;
using namespace pitchboard::ui;
using live_rig::Robot;
using live_studio::Studio;

class TestLive : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void aFrameShowsTheMessageOfARobot() {
    Studio s;
    s.goLive();
    const Robot robot(s.options, 3);
    const telemetry::TextMessage reported = live_rig::message(3);
    QVERIFY(robot.sendMessage(reported));
    QTRY_COMPARE(s.robots(), std::size_t(1));
    const FramePtr frame = s.live()->frame();
    QCOMPARE(frame->origin, link::FrameOrigin::Live);
    QVERIFY(!frame->truthKnown && !frame->ballKnown);
    const link::RobotFrame& shown = frame->robots[0];
    QCOMPARE(shown.key, receivedAs(3));
    const Pose believed = sim::published_frame::studioFromLocalization(
        s.options.field, {double(reported.x), double(reported.y), double(reported.theta)});
    QCOMPARE(shown.pose.position.x, believed.position.x);
    QCOMPARE(shown.pose.position.y, believed.position.y);
    QCOMPARE(shown.pose.yaw, believed.yaw);
    const link::RobotFrame& robotNow = frame->robots[0];
    QCOMPARE(robotNow.sigma, std::optional(0.2));
    QVERIFY(robotNow.belief && robotNow.ball && robotNow.battery);
    QVERIFY(qAbs(robotNow.battery->volts - 16.5) < 1e-9);
    QVERIFY(qAbs(distance(robotNow.ball->place, believed.position) - 1.0) < 1e-6);
    QCOMPARE(robotNow.decided, std::optional(8));
    QTRY_COMPARE(s.cards().size(), qsizetype(1));
    QCOMPARE(s.cards()[0]->state().action, QStringLiteral("walk forward, slow"));
  }

  // What the default profile says is named otherwise than on a blackboard.
  void theFirstPlotsShowReceivedRobots() {
    Studio s;
    s.goLive();
    const Robot robot(s.options, 3);
    telemetry::TextMessage reported = live_rig::message(3);
    reported.ballDist = 123.0F;
    QVERIFY(robot.sendMessage(reported));
    const auto panes = s.window.findChild<PlotsDock*>()->currentPage()->panes();
    QCOMPARE(panes.size(), 2);
    QTRY_COMPARE(s.robots(), std::size_t(1));
    const auto value = [](const PlotPane* pane) -> std::optional<double> {
      return pane->curves().empty() ? std::nullopt : pane->curves()[0].valueAt(std::nullopt);
    };
    QTRY_COMPARE(value(panes[0]), std::optional(123.0));
    QCOMPARE(panes[0]->curves()[0].name(), QStringLiteral("VISION_BALL_DIST Robot 3"));
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
    QTRY_VERIFY(s.label("noRobots").contains(QStringLiteral("Waiting for robots…")));
    QTRY_VERIFY(s.label("statusPace").contains(QStringLiteral("UDP 0.0/s, 0 lost, 0 bad")));
    s.window.showSource(SourceKind::Simulate);
    QTRY_VERIFY(chooser->isVisible() && !team->isVisible());
    QVERIFY(s.live()->isListening());
  }

  void everyDatagramIsPainted() {
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
            qRound(100 * (frame->robots[0].pose.position.x + 4.5)) == wanted) {
          paintedAt = clock.nsecsElapsed();
        }
        return false;
      }
    } painted;
    painted.live = s.live();
    s.canvas()->viewport()->installEventFilter(&painted);
    const Robot robot(s.options, 1);
    QVERIFY(robot.sendMessage());
    QTRY_COMPARE(s.robots(), std::size_t(1));
    std::vector<double> milliseconds;
    for (int i = 0; i < 31; ++i) {
      telemetry::TextMessage m = live_rig::message(1);
      m.x = 300 + i;
      painted.wanted = m.x;
      painted.paintedAt = -1;
      painted.clock.start();
      QVERIFY(robot.sendMessage(m));
      while (painted.paintedAt < 0 && painted.clock.elapsed() < 2000) {
        QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
      }
      QVERIFY(painted.paintedAt >= 0);
      milliseconds.push_back(double(painted.paintedAt) / 1e6);
    }
    std::sort(milliseconds.begin(), milliseconds.end());
    qInfo("datagram to paint: median %.1f ms, longest %.1f ms", milliseconds[15],
          milliseconds.back());
  }

  // What arrives now does not stop because somebody looks at what arrived before.
  void ratesGoOnWhileThePastIsShown() {
    Studio s;
    s.goLive();
    const Robot robot(s.options, 1);
    const auto rate = [&s] {
      return s.label("statusPace").section(QLatin1Char(' '), 1).section(QLatin1Char('/'), 0, 0);
    };
    const auto isRead = [&] { return robot.sendMessage() && rate().toDouble() > 1.0; };
    QTRY_VERIFY2(isRead(), qPrintable(s.label("statusPace")));
    ShownMoment* timeline = s.window.shown();
    timeline->seek(timeline->available()->begin);
    QVERIFY(timeline->isLookingBack());
    const std::uint64_t before = s.health().messages;
    const auto goesOn = [&] { return robot.sendMessage() && s.health().messages > before + 40; };
    QTRY_VERIFY(goesOn());
    QVERIFY2(isRead(), qPrintable(s.label("statusPace")));
    QVERIFY(timeline->isLookingBack());
  }

  void nothingCanBeMovedInLive() {
    Studio s;
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    QTRY_VERIFY(s.controller.frame());
    const FramePtr before = s.controller.frame();
    s.goLive();
    const Robot robot(s.options, 1);
    QVERIFY(robot.sendMessage());
    QTRY_COMPARE(s.robots(), std::size_t(1));
    const Point at = s.live()->frame()->robots[0].pose.position;
    QTRY_COMPARE(s.cards().size(), qsizetype(1));
    auto* canvas = s.canvas();
    const QPoint here = canvas->mapFromScene(QPointF(at.x, at.y));
    canvas->setFocus();
    QTest::mouseClick(canvas->viewport(), Qt::LeftButton, {}, here);
    QCOMPARE(s.window.field()->selection(), std::vector{uidIn(*s.live()->frame(), receivedAs(1))});
    QTest::mousePress(canvas->viewport(), Qt::LeftButton, {}, here);
    QTest::mouseMove(canvas->viewport(), here + QPoint(60, 40));
    QTest::mouseRelease(canvas->viewport(), Qt::LeftButton, {}, here + QPoint(60, 40));
    QTest::mouseDClick(canvas->viewport(), Qt::LeftButton, {}, here);
    s.window.field()->actions().publishedKeys->setChecked(true);
    for (const int key : {Qt::Key_A, Qt::Key_B, Qt::Key_Delete, Qt::Key_Insert, Qt::Key_F,
                          Qt::Key_L, Qt::Key_Y, Qt::Key_F3, Qt::Key_F4, Qt::Key_F5}) {
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
    // It may have been published again, with all that stood in it.
    const FramePtr after = s.controller.frame();
    QCOMPARE(after->snapshot.tick, before->snapshot.tick);
    QCOMPARE(after->snapshot.ball, before->snapshot.ball);
    QCOMPARE(after->robots.size(), before->robots.size());
    for (std::size_t i = 0; i < after->robots.size(); ++i) {
      QCOMPARE(after->robots[i].pose, before->robots[i].pose);
    }
    QVERIFY(s.controller.edits()->undoStack() != nullptr);
    QTest::keyClick(canvas, Qt::Key_F, Qt::ControlModifier);
    QVERIFY(s.window.field()->actions().flip->isChecked());
  }

  void aTakenPortIsNamedAndTheOthersWork() {
    Studio s;
    std::optional<TestSocket> stubborn;
    stubborn.emplace(INADDR_LOOPBACK, s.options.portBase + 5);
    QVERIFY(stubborn->good());
    s.window.showSource(SourceKind::Live);
    QTRY_COMPARE(s.bound(), std::size_t(16));
    QTRY_VERIFY(s.window.notices()->text().contains(QString::number(s.options.portBase + 5)));
    QTRY_VERIFY(s.label("statusProcesses").contains(QStringLiteral("Cannot receive on")));
    const Robot robot(s.options, 6);
    QVERIFY(robot.sendMessage());
    QTRY_COMPARE(s.robots(), std::size_t(1));
    stubborn.reset();
    QTRY_COMPARE_WITH_TIMEOUT(s.bound(), std::size_t(17), 30'000);
    QTRY_VERIFY2(s.window.notices()->text().isEmpty(), qPrintable(s.window.notices()->text()));
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
    QVERIFY(robot.sendMessage());
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
      QVERIFY(robot.sendMessage(line.mid(tab + 1).toStdString()));
      ++sent;
    }
    QVERIFY(sent > 50);
    QTRY_COMPARE(s.robots() == 1 ? s.health().messages : 0, sent);
    QCOMPARE(s.health().errorCount, std::uint64_t(0));
    QVERIFY(!robot.received());
  }

  void aCatalogIsOfferedForUnknownNames() {
    Studio s;
    s.change(live_rig::receiveVariables);
    s.goLive();
    auto* button = s.window.findChild<QToolButton*>(QStringLiteral("importCatalog"));
    live_rig::Agent agent(s.options, 3);
    const auto sent = [&s] { return s.live()->details().sent; };
    QTRY_VERIFY(agent.send("VOLTAGE=150") && sent().size() == 1);
    emit s.live()->optionsChanged();  // the bar looks again
    QVERIFY(!button->isVisible());
    QTRY_VERIFY(agent.send("VOLTAGE=150 KICK_POWER=3") && button->isVisible());
    QVERIFY2(button->toolTip().contains(QStringLiteral("KICK_POWER")),
             qPrintable(button->toolTip()));

    const auto write = [&s](const char* name, const QByteArray& text) {
      QFile file(s.folder.filePath(QLatin1String(name)));
      return file.open(QIODevice::WriteOnly) && file.write(text) == text.size() ? file.fileName()
                                                                                : QString();
    };
    const auto choose = [&](const QString& file) {
      QTest::mouseClick(button, Qt::LeftButton);
      auto* ask = s.window.findChild<QFileDialog*>(QStringLiteral("importCatalogDialog"));
      QVERIFY(ask != nullptr && ask->isVisible());
      ask->selectFile(file);
      static_cast<QDialog*>(ask)->accept();
      QTRY_VERIFY(!s.window.findChild<QFileDialog*>(QStringLiteral("importCatalogDialog")));
    };
    choose(write("bad.json", "{"));
    QTRY_VERIFY(s.window.notices()->text().contains(QStringLiteral("bad.json")));
    QVERIFY(s.live()->options().catalogs.empty() && button->isVisible());
    const QString file =
        write("board.json", R"({"int": {"VOLTAGE": 0}, "float": {"KICK_POWER": 0}})");
    choose(file);
    QTRY_VERIFY(agent.send("VOLTAGE=150 KICK_POWER=3") && !button->isVisible());
    QCOMPARE(sent()[0].catalog, std::string("board.json"));
    QVERIFY(sent()[0].unknown.empty());
    QCOMPARE(s.settings.value(QStringLiteral("live/catalogs")).toStringList(), QStringList{file});
    // It knows what the number alone does not tell.
    s.live()->clear();
    const auto isFloat = [&] {
      const auto store = s.live()->series();
      const auto id = store->find("Robot 3", "KICK_POWER");
      return id && store->view(id->group)->info().columns[id->column].type ==
                       telemetry::ColumnType::Float32;
    };
    QTRY_VERIFY(agent.send("VOLTAGE=150 KICK_POWER=3") && isFloat());
  }

  void simulatedAndReceivedStandSideBySide() {
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
    QVERIFY(Robot(s.options, 1).sendMessage(m));
    const auto error = [&]() -> QString {
      for (RobotCard* card : s.cards()) {
        if (card->state().id != inSlot(1)) continue;
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

PITCHBOARD_GUI_TEST(TestLive)

}  // namespace tst_live

#include "tst_live.moc"
