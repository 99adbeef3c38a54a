// SPDX-License-Identifier: GPL-3.0-or-later
// The referee in Live: packets from a socket to scoreboard, cards and events.

#include <QComboBox>
#include <QSignalSpy>
#include <QtTest>

#include <ui/base/notice_bar.h>
#include <ui/base/referee_text.h>
#include <ui/base/scoreboard_state.h>
#include <ui/field/field_view.h>
#include <ui/robots/robot_card.h>
#include <ui/robots/robots_dock.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>

#include "live_rig.h"
#include "live_studio.h"
#include "plot_pane.h"
#include "scoreboard.h"

namespace tst_live_referee {

using namespace pitchboard;
using namespace pitchboard::ui;
using live_rig::Robot;
using live_studio::Studio;

class TestLiveReferee : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

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
    QTRY_VERIFY(live.frame() && live.frame()->game);
    const ScoreboardState shown = scoreboardOf(*live.frame());
    QCOMPARE(shown.left, state.teams[0].score);
    QCOMPARE(shown.right, state.teams[1].score);
    QVERIFY2(shown.state.startsWith(labelText(telemetry::playStateOf(state.state))),
             qPrintable(shown.state));
    QVERIFY(!referee.received());
  }

  void teamsHaveTheirNamesOnTheScoreboard() {
    link::MatchFrame frame;
    frame.origin = link::FrameOrigin::Live;
    Game& game = frame.game.emplace();
    game.teams[0].number = 12;
    game.teams[1].number = 7;
    game.teams[1].colour = TeamColor::Red;
    frame.teams = {{}, {12, "RoboFEI", TeamColor::Blue, true}};
    const ScoreboardState state = scoreboardOf(frame);
    QCOMPARE(state.leftName, QStringLiteral("ROBOFEI"));
    QCOMPARE(state.rightName, QStringLiteral("RED"));
  }

  void teamsHaveTheirNamesInTheWindow() {
    Studio s;
    s.change([](link::LiveOptions& o) {
      telemetry::TeamSetup& ours = o.team.teams.emplace_back();
      ours.name = "RoboFEI";
      ours.number = 1;
      ours.firstPort = o.portBase + 1;
      ours.lastPort = o.portBase + 16;
    });
    s.goLive();
    const Robot robot(s.options, 3);
    const TestSocket referee;
    QVERIFY(robot.sendMessage());
    QVERIFY(referee.send(static_cast<std::uint16_t>(s.options.refereePort),
                         live_rig::packet(QStringLiteral("v12hl688_READY.bin"))));
    QTRY_COMPARE(s.scoreboard()->state().leftName, QStringLiteral("ROBOFEI"));
    QTRY_VERIFY(s.label("statusWorld").startsWith(QStringLiteral("ROBOFEI – BLUE, Referee")));
    QTRY_COMPARE(s.cards().size(), qsizetype(1));
    QCOMPARE(s.cards()[0]->state().teamName, QStringLiteral("RoboFEI"));
  }

  void penaltiesOfOurTeamAreMarked() {
    const std::string bytes = live_rig::packet(QStringLiteral("v12hl640_2017.3_PENALISED.bin"));
    const Game game = telemetry::gameOf(
        std::get<telemetry::RefereeState>(telemetry::decodeReferee(bytes).value()));
    int team = 0, player = 0;
    for (const GameTeam& side : game.teams) {
      for (std::size_t i = 0; i < side.players.size(); ++i) {
        const PenaltyKind penalty = side.players[i].penalty;
        const bool isPenalised = penalty != PenaltyKind::None && penalty != PenaltyKind::Substitute;
        if (!isPenalised || side.shirts[i] == 0 || player != 0) continue;
        team = side.number;
        player = side.shirts[i];
      }
    }
    QVERIFY(player > 0);
    Studio s;
    s.goLive();
    const Robot robot(s.options, player);
    const TestSocket referee;
    QVERIFY(referee.send(static_cast<std::uint16_t>(s.options.refereePort), bytes));
    QVERIFY(robot.sendMessage());
    QTRY_VERIFY(s.robots() == 1 && s.live()->frame()->game);
    QVERIFY(!s.robot().penalty);
    s.live()->setOurTeam(team);
    QTRY_VERIFY(s.robot().penalty);
    QTRY_VERIFY(!s.cards().isEmpty() && s.cards()[0]->state().tagKind == TagKind::Warning);
    auto* chooser = s.window.findChild<QComboBox*>(QStringLiteral("ourTeam"));
    QTRY_COMPARE(chooser->currentData().toInt(), team);
  }

  // A second sender of a penalised number is no second penalty.
  void everyPenaltyIsShownOnce() {
    link::MatchFrame frame;
    frame.origin = link::FrameOrigin::Live;
    frame.game.emplace();
    for (const int sender : {0, 1}) {
      link::RobotFrame robot;
      robot.identity.team = TeamColor::Blue;
      robot.identity.number = 3;
      robot.key = {1, 3, sender};
      robot.name = "B3";
      robot.penalty = link::Penalty{PenaltyKind::PickUp, 20};
      frame.robots.push_back(robot);
    }
    QCOMPARE(scoreboardOf(frame).penalties, QStringLiteral("Penalties: B3 20"));
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
    QTRY_VERIFY(live.frame() && live.frame()->game);
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

  void withoutARefereeThePastHasNoScoreEither() {
    Studio s;
    s.goLive();
    const Robot robot(s.options, 3);
    QVERIFY(robot.sendMessage());
    QTRY_COMPARE(s.robots(), std::size_t(1));
    ShownMoment* timeline = s.window.shown();
    // Until a newer moment is shown, the last row's is now and not the past.
    QTRY_VERIFY(timeline->available() && timeline->available()->end < timeline->now());
    timeline->seek(timeline->available()->end);
    const auto* shown = s.window.findChild<ShownMoment*>();
    QTRY_VERIFY(shown->frame() && shown->frame()->origin == link::FrameOrigin::Recorded);
    const ScoreboardState past = scoreboardOf(*shown->frame());
    QCOMPARE(past.state, QStringLiteral("NO REFEREE"));
    QVERIFY(past.leftName.isEmpty());
  }
};

PITCHBOARD_GUI_TEST(TestLiveReferee)

}  // namespace tst_live_referee

#include "tst_live_referee.moc"
