// SPDX-License-Identifier: GPL-3.0-or-later
// Team setups: the team, the colour and the name of a received robot.
#include <QTemporaryDir>
#include <QtTest>

#include <robotlink/live/live_pipeline.h>
#include <robotlink/live/live_state.h>
#include <robotlink/live/live_teams.h>
#include <telemetry/series/series_store.h>

#include "../support/group_facts.h"

namespace tst_live_teams {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace pitchboard::telemetry;

namespace {

const WallTime start{std::chrono::seconds(1'700'000'000)};

DatagramView from(const char* address, std::uint16_t port, std::string_view payload) {
  return {start, {*parseAddress(address), 4000}, port, false, payload};
}

TeamSetup setupOf(const char* json) {
  const auto setup = parseTeamSetup(json, "setup.json");
  if (!setup) qFatal("%s", setup.error().text().c_str());
  return *setup;
}

constexpr std::string_view words = "3 450 300 90 12.5 80.0 -10.0 1 1 1 1 1 0 1.5 124 OUT";
constexpr std::string_view lua = R"({["id"]=3,["pose"]={["x"]=1.5,["y"]=-0.5,["a"]=0}})";

LiveOptions twoTeams() {
  LiveOptions options;
  options.team.teams = {
      setupOf(R"({"name": "Ours", "number": 12, "colour": "blue", "robots": {"3": "Ana"}})"),
      setupOf(R"({"number": 7, "colour": "red", "ports": [12000, 12005], "profile": "upenn"})")};
  return options;
}

}  // namespace

class TestLiveTeams : public QObject {
  Q_OBJECT
 private slots:
  /// 12.4 V are low for a battery of five cells, but not for the three cells of a DARwIn-OP.
  void theRobotModelOfASetupDecidesWhenABatteryIsLow() {
    LiveOptions options = twoTeams();
    options.team.teams.pop_back();
    const auto lowWith = [&options](const std::string& model) {
      options.team.teams[0].model = model;
      if (!validate(options)) qFatal("a model is unknown");
      LivePipeline pipeline(options, start);
      pipeline.take(from("10.0.0.3", 1243, words));
      const MatchFrame frame = pipeline.advance(start, nullptr);
      return frame.robots.at(0).battery->low;
    };
    QVERIFY(lowWith(""));
    QVERIFY(!lowWith("darwin-op"));
    QVERIFY(lowWith("kid-size"));
    // The model is kept in files and recordings.
    options.team.teams[0].model = "darwin-op";
    QCOMPARE(setupOf(teamSetupText(options.team.teams[0]).c_str()).model, std::string("darwin-op"));
    const auto again = LiveState::read(LiveState(options).text(options, 0.0, start), start);
    QVERIFY(again);
    QCOMPARE(again->options.team.teams.at(0).model, std::string("darwin-op"));

    options.team.teams[0].model = "darwin";
    const auto refused = validate(options);
    QVERIFY(!refused);
    QVERIFY2(refused.error().text().starts_with("Ours, model: there is no"),
             refused.error().text().c_str());
  }

  void twoTeamsAreDistinguished() {
    const LiveOptions options = twoTeams();
    TeamMonitor monitor(options.profile, monitorOptions(options));
    QCOMPARE(monitor.take(from("10.0.0.3", 1243, words)), TeamMonitor::Verdict::Used);
    QCOMPARE(monitor.take(from("10.0.1.3", 12003, lua)), TeamMonitor::Verdict::Used);
    QCOMPARE(monitor.take(from("10.0.1.3", 12003, "nonsense")), TeamMonitor::Verdict::Refused);
    const TeamStatus team = monitor.status(start);
    QCOMPARE(team.robots.size(), std::size_t(2));
    QVERIFY(!team.robots[0].conflict);
    QCOMPARE(team.robots[0].key, (RobotKey{1, 3, 0}));
    QCOMPARE(team.robots[1].key, (RobotKey{2, 3, 0}));
    QCOMPARE(team.robots[1].value(FieldMeaning::X), std::optional(600.0));
    const Teams teams = teamsOf(options, {});
    QCOMPARE(drawnColour(options, team.robots[0].key, teams), TeamColor::Blue);
    QCOMPARE(drawnColour(options, team.robots[1].key, teams), TeamColor::Red);
    QCOMPARE(teams.at(2).number, 7);
    QCOMPARE(ownNameOf(options, team.robots[0].key), std::string("Ana"));
    QCOMPARE(options.team.teams[1].title(), std::string("Team 7"));
  }

  void aRobotKeepsItsUidUnderAnotherKey() {
    LiveOptions options;
    LivePipeline pipeline(options, start);
    pipeline.take(from("10.0.0.3", 1243, words));
    const MatchFrame before = pipeline.advance(start);
    QCOMPARE(before.robots.at(0).key, (RobotKey{0, 3, 0}));
    options.team.teams = {setupOf(R"({"number": 12, "colour": "blue"})")};
    pipeline.setOptions(options, start);
    pipeline.take(from("10.0.0.3", 1243, words));
    const MatchFrame now = pipeline.advance(start);
    QCOMPARE(now.robots.at(0).key, (RobotKey{1, 3, 0}));
    QVERIFY(now.robots[0].uid != RobotUid{});
    QCOMPARE(now.robots[0].uid, before.robots[0].uid);
  }

  /// The same curve has the same name as in a simulation.
  void curvesHaveTheNamesOfASimulation() {
    const LiveOptions options = twoTeams();
    TeamMonitor monitor(options.profile, monitorOptions(options));
    auto store = std::make_shared<SeriesStore>();
    LiveRows rows(store, rowsOptions(options, teamsOf(options, {}), start));
    const std::string ball = R"({["id"]=3,["ball"]={["x"]=0.6,["y"]=0}})";
    QCOMPARE(monitor.take(from("10.0.1.3", 12003, ball)), TeamMonitor::Verdict::Used);
    rows.take(from("10.0.1.3", 12003, ball), monitor.decoded(), monitor.decoder(), monitor.used());
    bool found = false;
    for (std::size_t i = 0; i < store->groups(); ++i) {
      const auto view = store->view(static_cast<GroupId>(i));
      if (!view || view->info().name != "R3") continue;
      for (const ColumnInfo& column : view->info().columns) {
        if (column.name != "VISION_BALL_DIST") continue;
        found = true;
        QCOMPARE(column.unit, std::string("cm"));
      }
      QCOMPARE(attributesOf(view->info()).at("team"), std::string("red"));
      QCOMPARE(attributesOf(view->info()).at("number"), std::string("3"));
    }
    QVERIFY(found);
  }

  void ourTeamIsChosenByNumberOrColour() {
    LiveOptions options;
    for (const char* wrong : {"", "green", "-1", "65536", "12a"}) {
      QVERIFY2(!chooseOurTeam(options, wrong), wrong);
    }
    QVERIFY(chooseOurTeam(options, "12"));
    QCOMPARE(options.ourTeam, 12);
    QCOMPARE(robotName({0, 3, 0}, teamsOf(options, {})), std::string("Robot 3"));
    QVERIFY(chooseOurTeam(options, "red"));
    QCOMPARE(options.ourTeam, 0);
    QCOMPARE(robotName({0, 3, 0}, teamsOf(options, {})), std::string("R3"));
    // Once a referee is received, the number is that of the team with this colour.
    RefereeState state;
    state.teams[0].number = 12;
    state.teams[0].colour = 0;
    state.teams[1].number = 7;
    state.teams[1].colour = 1;
    QCOMPARE(ourNumber(options, telemetry::gameOf(state)), 7);
    QCOMPARE(teamsOf(options, telemetry::gameOf(state))[0].number, 7);
    const auto again = LiveState::read(LiveState(options).text(options, 0.0, start), start);
    QVERIFY(again && again->options.ourColour == TeamColor::Red);
  }

  void ourTeamIsListedFirst() {
    LiveOptions options = twoTeams();
    const auto order = [&options] {
      const Teams teams = teamsOf(options, {});
      std::vector<RobotKey> robots{{2, 3, 0}, {1, 10, 0}, {1, 2, 1}, {1, 2, 0}};
      std::ranges::sort(robots, {}, [&](const RobotKey& robot) { return orderOf(robot, teams); });
      return robots;
    };
    const std::vector<RobotKey> first{{1, 2, 0}, {1, 2, 1}, {1, 10, 0}, {2, 3, 0}};
    const std::vector<RobotKey> second{{2, 3, 0}, {1, 2, 0}, {1, 2, 1}, {1, 10, 0}};
    QVERIFY(order() == first);
    QVERIFY(chooseOurTeam(options, "7"));
    QVERIFY(order() == second);
    QVERIFY(chooseOurTeam(options, "blue"));
    QVERIFY(order() == first);
  }

  /// Its variables have the name of the robot.
  void messagesOfARobotWithABlackboardStandBesideIt() {
    const LiveOptions options = twoTeams();
    auto store = std::make_shared<SeriesStore>();
    const auto uids = std::make_shared<RobotUids>();
    const RobotUid uid = uids->ofMessages({1, 3, 0}, from("10.0.0.3", 1243, words).sender.address);
    LiveRows rows(store, rowsOptions(options, teamsOf(options, {}), start, {{uid, "B3"}}), uids);
    TeamMonitor monitor(options.profile, monitorOptions(options));
    QCOMPARE(monitor.take(from("10.0.0.3", 1243, words)), TeamMonitor::Verdict::Used);
    rows.take(from("10.0.0.3", 1243, words), monitor.decoded(), monitor.decoder(), monitor.used());
    QVERIFY(store->findGroup("B3 telemetry") && store->findGroup("B3 link"));
    QVERIFY(!store->findGroup("B3"));
    rows.setOptions(rowsOptions(options, teamsOf(options, {}), start));
    QVERIFY(store->findGroup("B3") && !store->findGroup("B3 telemetry"));
  }

  void attachedBlackboardsAreReadBack() {
    AttachedBoard board;
    board.key = 300;
    AttachedBoard other = board;
    other.key = 7000;
    other.robot = 3;
    QCOMPARE(boardNames({board, other}), (std::vector<std::string>{"B3", "B3 key 7000"}));
    for (const AttachedBoard& one : {board, other}) {
      const auto again = parseAttachedBoard(attachedBoardText(one));
      QVERIFY(again && *again == one);
    }
  }

  /// Groups go on with their rows.
  void otherNamesRenameInPlace() {
    LiveOptions options = twoTeams();
    TeamMonitor monitor(options.profile, monitorOptions(options));
    auto store = std::make_shared<SeriesStore>();
    LiveRows rows(store, rowsOptions(options, teamsOf(options, {}), start));
    const auto send = [&](double time) {
      DatagramView datagram = from("10.0.0.3", 1243, words);
      datagram.time += std::chrono::duration_cast<Duration>(std::chrono::duration<double>(time));
      QCOMPARE(monitor.take(datagram), TeamMonitor::Verdict::Used);
      rows.take(datagram, monitor.decoded(), monitor.decoder(), monitor.used());
    };
    send(1.0);
    options.team.teams[0].colour = "yellow";
    rows.setOptions(rowsOptions(options, teamsOf(options, {}), start));
    send(2.0);
    options.team.teams[0].colour = "blue";
    rows.setOptions(rowsOptions(options, teamsOf(options, {}), start));
    send(3.0);
    const auto count = [&store](const char* name) {
      const auto group = store->findGroup(name);
      return group ? store->view(*group)->rows() : std::size_t(0);
    };
    QCOMPARE(count("B3"), std::size_t(3));
    QCOMPARE(count("Y3"), std::size_t(0));
  }

  void aSetupAppliedInMidMatchRenamesInPlace() {
    LiveOptions options;
    LiveState state(options);
    TeamMonitor& monitor = state.monitor;
    auto store = std::make_shared<SeriesStore>();
    LiveRows rows(store, rowsOptions(options, teamsOf(options, {}), start), state.uids);
    const auto send = [&](int second, const char* address) {
      DatagramView datagram = from(address, 1243, words);
      datagram.time += std::chrono::seconds(second);
      QCOMPARE(state.takeRobot(datagram, second), TeamMonitor::Verdict::Used);
      rows.setOptions(rowsOptions(options, teamsOf(options, {}), start));
      rows.take(datagram, monitor.decoded(), monitor.decoder(), monitor.used());
    };
    const auto apply = [&](std::vector<TeamSetup> teams) {
      options.team.teams = std::move(teams);
      state.setTeams(monitorOptions(options));
      rows.setOptions(rowsOptions(options, teamsOf(options, {}), start));
    };
    const auto theOnlyOne = [&](int second) {
      const auto robots = monitor.status(start + std::chrono::seconds(second)).robots;
      return robots.size() == 1 ? robots[0].key : RobotKey{};
    };
    send(1, "10.0.0.3");
    QVERIFY(state.drawings.take("PBD1 3\nlayer plan 5\npoint 0 0", 1.0));
    const auto group = store->findGroup("Robot 3");
    QVERIFY(group);
    const TeamSetup ours = setupOf(R"({"colour": "blue", "senders": ["10.0.0.0/24"]})");
    const TeamSetup visitors = setupOf(R"({"colour": "red", "senders": ["10.0.1.0/24"]})");
    apply({ours, visitors});
    send(2, "10.0.0.3");
    QCOMPARE(theOnlyOne(2), (RobotKey{1, 3, 0}));
    QCOMPARE(state.drawings.at(2.0).at(0).robot, (RobotKey{1, 3, 0}));
    QCOMPARE(store->findGroup("B3"), group);
    QVERIFY(!store->findGroup("Robot 3"));
    QCOMPARE(store->view(*group)->rows(), std::size_t(2));
    QVERIFY(store->findGroup("B3 link") && !store->findGroup("Robot 3 link"));
    // A setup that moves takes its robots along, and one that is taken away leaves them.
    apply({visitors, ours});
    QCOMPARE(theOnlyOne(2), (RobotKey{2, 3, 0}));
    send(3, "10.0.0.3");
    QCOMPARE(theOnlyOne(3), (RobotKey{2, 3, 0}));
    apply({});
    send(4, "10.0.0.3");
    QCOMPARE(theOnlyOne(4), (RobotKey{0, 3, 0}));
    QCOMPARE(store->findGroup("Robot 3"), group);
    QCOMPARE(store->view(*group)->rows(), std::size_t(4));
  }

  /// Names are of the teams; the colour that a robot is drawn in says nothing of its team.
  void theRefereeSetsTheColours() {
    LiveOptions options;
    RefereeState packet;
    packet.teams[0].number = 12;
    packet.teams[0].colour = 1;  // red
    packet.teams[1].number = 7;
    packet.teams[1].colour = 0;  // blue
    const auto nameOf = [&](const RobotKey& robot, const std::optional<Game>& game) {
      return robotName(robot, teamsOf(options, game));
    };
    QCOMPARE(nameOf({0, 3, 0}, {}), std::string("Robot 3"));
    QCOMPARE(nameOf({0, 3, 0}, telemetry::gameOf(packet)), std::string("Robot 3"));
    options.ourTeam = 12;
    QCOMPARE(nameOf({0, 3, 0}, {}), std::string("Robot 3"));
    QCOMPARE(nameOf({0, 3, 0}, telemetry::gameOf(packet)), std::string("R3"));
    options.team.teams = {setupOf(R"({"number": 12})"),
                          setupOf(R"({"name": "Guests", "number": 7})")};
    QCOMPARE(nameOf({1, 3, 0}, {}), std::string("Robot 3"));
    QCOMPARE(nameOf({2, 3, 0}, {}), std::string("Guests 3"));
    QCOMPARE(nameOf({1, 3, 0}, telemetry::gameOf(packet)), std::string("R3"));
    QCOMPARE(nameOf({2, 3, 1}, telemetry::gameOf(packet)), std::string("B3 (2)"));

    TeamMonitor monitor(options.profile, monitorOptions(options));
    auto store = std::make_shared<SeriesStore>();
    LiveRows rows(store, rowsOptions(options, teamsOf(options, {}), start));
    QCOMPARE(monitor.take(from("10.0.0.3", 1243, words)), TeamMonitor::Verdict::Used);
    rows.take(from("10.0.0.3", 1243, words), monitor.decoded(), monitor.decoder(), monitor.used());
    const auto group = store->findGroup("Robot 3");
    QVERIFY(group && store->find("Robot 3", "VISION_BALL_DIST"));
    QVERIFY(!factsOf(store->view(*group)->info()).team);
    rows.setOptions(rowsOptions(options, teamsOf(options, telemetry::gameOf(packet)), start));
    QCOMPARE(store->findGroup("R3"), group);
    QCOMPARE(attributesOf(store->view(*group)->info()).at("team"), std::string("red"));
  }

  void snapshotsKeepTheSetups() {
    const LiveOptions options = twoTeams();
    const LiveState state(options);
    const auto read = LiveState::read(state.text(options, 1.0, start), start);
    QVERIFY2(read, read ? "" : read.error().text().c_str());
    QVERIFY(read->options.team.teams == options.team.teams);
  }

  /// Every team writes in its own way; who spoke last makes no difference.
  void snapshotsKeepEachTeamsFormat() {
    const LiveOptions options = twoTeams();
    for (const bool oursLast : {false, true}) {
      LiveState state(options);
      if (!oursLast) state.monitor.take(from("10.0.0.3", 1243, words));
      state.monitor.take(from("10.0.1.3", 12003, lua));
      if (oursLast) state.monitor.take(from("10.0.0.3", 1243, words));
      const std::string text = state.text(options, 1.0, start);
      const auto read = LiveState::read(text, start);
      QVERIFY2(read, read ? "" : read.error().text().c_str());
      QCOMPARE(read->state.text(read->options, 1.0, start), text);
      const TeamStatus team = read->state.monitor.status(start);
      QCOMPARE(team.robots.size(), std::size_t(2));
      QCOMPARE(team.robots[0].value(FieldMeaning::X), std::optional(450.0));
      QCOMPARE(team.robots[1].value(FieldMeaning::X), std::optional(600.0));
      QCOMPARE(team.robots[1].decoder->profile().name, std::string("UPenn"));
    }
  }

  void oneTeamKeepsItsNumbers() {
    LiveOptions options;
    options.team.teams = {setupOf(R"({"senders": ["10.0.0.0/24"]})")};
    TeamMonitor monitor(options.profile, monitorOptions(options));
    QCOMPARE(monitor.take(from("10.0.0.3", 1243, words)), TeamMonitor::Verdict::Used);
    QCOMPARE(monitor.take(from("10.9.0.3", 1243, words)), TeamMonitor::Verdict::SenderRefused);
    QCOMPARE(monitor.status(start).robots.at(0).key, (RobotKey{1, 3, 0}));
    QCOMPARE(monitor.status(start).refusedByFilter, std::uint64_t(1));
  }

  void messagesNameTheirTeamOnOnePort() {
    LiveOptions options;
    options.team.teams = {setupOf(R"({"number": 24, "ports": 12100, "profile": "spl"})"),
                          setupOf(R"({"number": 25, "ports": 12100, "profile": "spl"})")};
    TeamMonitor monitor(options.profile, monitorOptions(options));
    QByteArray message =
        QByteArray::fromHex("53504c20070319000080bb440000fac3db0fc93f0000003f000016440000c8c20000");
    const auto view = [&] {
      return from("10.0.0.3", 12100,
                  {message.constData(), static_cast<std::size_t>(message.size())});
    };
    QCOMPARE(monitor.take(view()), TeamMonitor::Verdict::Used);
    QCOMPARE(monitor.decoded().place, 2);
    message[6] = 99;
    QCOMPARE(monitor.take(view()), TeamMonitor::Verdict::SenderRefused);
  }

  void setupsReadBackAndNameMistakes() {
    for (const TeamSetup& setup : twoTeams().team.teams) {
      const auto again = parseTeamSetup(teamSetupText(setup), "again");
      QVERIFY(again);
      QVERIFY(*again == setup);
    }
    const std::pair<const char*, const char*> mistakes[] = {
        {"{\n\"colour\": \"pink\"}", "s.json:2: colour: there is no colour of a team \"pink\""},
        {R"({"ports": [5, 4]})", "s.json:1: ports: must be one port"},
        {R"({"ports": 70000})", "ports"},
        {R"({"senders": ["home"]})", "s.json:1: senders"},
        {R"({"robots": {"zero": "A"}})", "robots.zero: a robot number"},
        {R"({"profile": "mitecon"})", "did you mean \"mitecom\""},
        {R"({"teams": 1})", "teams"}};
    for (const auto& [json, expected] : mistakes) {
      const auto setup = parseTeamSetup(json, "s.json");
      QVERIFY2(!setup, json);
      const std::string text = setup.error().text();
      QVERIFY2(text.find(expected) != std::string::npos && text.starts_with("s.json"),
               text.c_str());
    }
  }

  void aProfileLiesBesideItsSetup() {
    QTemporaryDir folder;
    const auto write = [&folder](const char* name, const std::string& text) {
      QFile file(folder.filePath(name));
      QVERIFY(file.open(QIODevice::WriteOnly));
      file.write(text.data(), static_cast<qint64>(text.size()));
    };
    Profile profile = publishedProfile();
    profile.name = "own";
    write("own.json", profileText(profile));
    write("team.json", R"({"profile": "own.json"})");
    const auto setup = loadTeamSetup(folder.filePath("team.json").toStdString());
    QVERIFY2(setup, setup ? "" : setup.error().text().c_str());
    QCOMPARE(setup->profile.name, std::string("own"));
    QCOMPARE(setup->profileName, folder.filePath("own.json").toStdString());
    // Saved beside the profile, the folder may be moved; elsewhere the whole path is needed.
    const auto textOf = [](const QString& path) {
      QFile file(path);
      return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    };
    QVERIFY(saveTeamSetup(*setup, folder.filePath("again.json").toStdString()));
    QVERIFY(textOf(folder.filePath("again.json")).contains("\"own.json\""));
    QTemporaryDir elsewhere;
    QVERIFY(saveTeamSetup(*setup, elsewhere.filePath("far.json").toStdString()));
    for (const QString& path : {folder.filePath("again.json"), elsewhere.filePath("far.json")}) {
      const auto again = loadTeamSetup(path.toStdString());
      QVERIFY2(again && *again == *setup, qPrintable(path));
    }
    QVERIFY(!saveTeamSetup(*setup, "/nonexistent/folder/team.json"));
  }

  void atMostSixteenTeams() {
    std::vector<TeamSetup> teams(16);
    QVERIFY(teamPorts(teams, 1240, 16, 3838));
    teams.emplace_back();
    const auto ports = teamPorts(teams, 1240, 16, 3838);
    QVERIFY(!ports && ports.error().text().find("At most 16 teams") != std::string::npos);
  }
};

PITCHBOARD_TEST(TestLiveTeams)

}  // namespace tst_live_teams

#include "tst_live_teams.moc"
