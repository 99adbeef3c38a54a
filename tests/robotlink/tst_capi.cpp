// SPDX-License-Identifier: GPL-3.0-or-later
// Worlds for learning programs: as C++, through the C interface, and by a program in C.
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QtTest>

#include <pitchboard_session.h>
#include <pitchboard_sim.h>
#include <robotlink/capi/worlds.h>
#include <telemetry/session/session_writer.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <thread>

#include "../support/group_facts.h"
#include "../support/program_run.h"

namespace tst_capi {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

Worlds make(const Scenario& scenario, const WorldsOptions& options = {}) {
  auto worlds = Worlds::create(scenario, options);
  if (!worlds) qFatal("%s", worlds.error().text().c_str());
  return std::move(*worlds);
}

/// A robot that is ours to steer, with every noise, a scripted write at once and one later.
Scenario steered() {
  Scenario scenario = loadScenario("one-robot").value();
  scenario.settings.noise = noisePreset("realistic").value();
  scenario.robots[0].behaviour = noBehaviour;
  scenario.writes = {{RobotId{1}, "DECISION_ACTION_A", 1, 0.0},
                     {RobotId{1}, "DECISION_ACTION_A", 2, 1.0}};
  return scenario;
}

std::vector<std::uint64_t> hashes(const Worlds& worlds) {
  std::vector<std::uint64_t> out(worlds.count());
  if (!worlds.readHashes(out)) qFatal("no hashes");
  return out;
}

std::size_t columnOf(WorldArray array, std::string_view name) {
  const auto all = columnsOf(array);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].name == name) return i;
  }
  qFatal("no such column");
  return 0;
}

/// Five rows, a second apart, in which B1 does not see the ball at odd times; and a bookmark.
void writeSession(const std::string& path) {
  telemetry::SessionInfo about;
  about.program = "test";
  about.title = "five rows";
  about.seed = 7;
  auto writer = telemetry::SessionWriter::create(path, about).value();
  telemetry::GroupInfo robot{
      "B1",
      {{"LOST", telemetry::ColumnType::Int32, "", "Vision", telemetry::ColumnKind::Flag, {}},
       {"DIST",
        telemetry::ColumnType::Float32,
        "cm",
        "Vision",
        telemetry::ColumnKind::Number,
        {},
        0.0,
        {{"LOST", 1.0}}},
       {"X", telemetry::ColumnType::Float64, "m", "Truth", telemetry::ColumnKind::Number, {}}},
      telemetry::facts({{"robot", "1"}})};
  robot.robot->formerNames = {"R1"};
  const telemetry::GroupId id = writer->addGroup(robot);
  for (int t = 0; t < 5; ++t) {
    const std::uint32_t words[] = {static_cast<std::uint32_t>(t % 2),
                                   std::bit_cast<std::uint32_t>(10.5F * static_cast<float>(t))};
    const double x = 0.1 * t;
    writer->append(id, {static_cast<double>(t), words, {&x, 1}});
  }
  writer->append(telemetry::SessionEvent{3.0, "bookmark", "", "here"});
  if (!writer->finish()) qFatal("not written");
}

template <class Value>
std::vector<Value> spanOf(const pb_data* data, std::size_t index, pb_type type) {
  pb_span span{};
  span.size = sizeof span;
  if (pb_data_span(data, index, &span) != PB_OK) qFatal("%s", pb_last_error());
  if (span.type != type) qFatal("another type");
  const auto* first = static_cast<const Value*>(span.values);
  return {first, first + span.count};
}

std::vector<double> values(const Worlds& worlds, WorldArray array) {
  std::vector<double> out(worlds.sizeOf(array));
  if (!worlds.read(array, out)) qFatal("not read");
  return out;
}

double first(const Worlds& worlds, WorldArray array, std::string_view column) {
  return values(worlds, array)[columnOf(array, column)];
}

/// The same actions whenever it is called.
void playByRule(Worlds& worlds, int steps) {
  for (int i = 0; i < steps; ++i) {
    std::vector<std::int32_t> actions(worlds.count() * worlds.robots());
    for (std::size_t k = 0; k < actions.size(); ++k) {
      actions[k] = static_cast<std::int32_t>((static_cast<std::size_t>(i) / 20 + k) % 9);
    }
    if (!worlds.writeActions(actions) || !worlds.step(3)) qFatal("not played");
  }
}

}  // namespace

class TestCapi : public QObject {
  Q_OBJECT

 private slots:
  void aProgramInCGetsTheHashOfTheCommandLine_data() {
    QTest::addColumn<QString>("scenario");
    QTest::addColumn<QString>("seconds");
    QTest::newRow("one robot with localization") << "one-robot"
                                                 << "20";
    QTest::newRow("two teams") << "match-3v3"
                               << "10";
    QTest::newRow("with a referee") << "match"
                                    << "15";
    QTest::newRow("published physics") << "published-match-3v3"
                                       << "10";
  }
  void aProgramInCGetsTheHashOfTheCommandLine() {
    QFETCH(QString, scenario);
    QFETCH(QString, seconds);
    const ProgramRun cli = runProgram(
        "pitchboard-cli",
        {"simulate", "--json", "--scenario", scenario, "--seed", "11", "--duration", seconds});
    QCOMPARE(cli.exitCode, 0);
    const ProgramRun c = runProgram("../tests/capi_user", {scenario, "11", seconds});
    QVERIFY2(c.exitCode == 0, c.err.constData());
    const auto hash = QJsonDocument::fromJson(cli.out).object()["state_hash"].toString();
    QVERIFY(hash.startsWith("0x"));
    QCOMPARE(QString::fromLatin1(c.out).trimmed(), hash);
  }

  void worldsHaveSeedsOfTheirOwn() {
    const Scenario scenario = loadScenario("match-3v3").value();
    WorldsOptions options;
    options.count = 3;
    options.seed = 40;
    Worlds worlds = make(scenario, options);
    QVERIFY(worlds.step(200).has_value());
    for (std::uint64_t i = 0; i < 3; ++i) {
      Scenario alone = scenario;
      alone.settings.seed = 40 + i;
      auto match = SimulatedMatch::create(alone, {}).value();
      for (int tick = 0; tick < 200; ++tick) match.tick();
      QCOMPARE(hashes(worlds)[i], match.simulation().hash());
    }
    // One world again, as another one was.
    QVERIFY(worlds.reset(0, 42).has_value());
    const auto before = hashes(worlds);
    QVERIFY(before[0] != before[2]);
    Worlds other = make(scenario, options);
    QVERIFY(other.reset(Worlds::all, 42).has_value() && other.step(200).has_value());
    QVERIFY(worlds.reset(Worlds::all, 42).has_value() && worlds.step(200).has_value());
    QCOMPARE(hashes(worlds), hashes(other));
    QCOMPARE(hashes(worlds)[0], before[2]);
  }

  void threadsDoNotChangeAnything() {
    WorldsOptions options;
    options.count = 23;
    Worlds one = make(steered(), options);
    options.threads = 3;
    Worlds three = make(steered(), options);
    for (int i = 0; i < 30; ++i) {
      playByRule(one, 5);
      playByRule(three, 5);
    }
    QCOMPARE(hashes(three), hashes(one));
    QCOMPARE(values(three, WorldArray::Robots), values(one, WorldArray::Robots));
  }

  void callsFromManyThreadsWaitForOneAnother() {
    pb_options options;
    QCOMPARE(pb_options_init(&options, sizeof options), PB_OK);
    options.worlds = 4;
    options.threads = 2;
    pb_worlds* worlds = nullptr;
    QCOMPARE(pb_create(&options, &worlds), PB_OK);
    std::vector<std::thread> threads;
    for (int i = 0; i < 3; ++i) {
      threads.emplace_back([worlds] {
        std::vector<double> game(4 * pb_column_count(PB_GAME));
        for (int k = 0; k < 50; ++k) {
          (void)pb_step(worlds, 1);
          (void)pb_read(worlds, PB_GAME, game.data(), game.size());
          (void)pb_step(nullptr, 1);
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    std::vector<double> game(4 * pb_column_count(PB_GAME));
    QCOMPARE(pb_read(worlds, PB_GAME, game.data(), game.size()), PB_OK);
    QCOMPARE(game[0], 150.0);
    QCOMPARE(pb_destroy(worlds), PB_OK);
  }

  void everyColumnKeepsItsPlaceAndItsName() {
    QFile file(QStringLiteral(PITCHBOARD_TEST_DATA "/world_columns.txt"));
    QVERIFY(file.open(QIODevice::ReadOnly | QIODevice::Text));
    const QByteArrayList arrays{"percepts",      "robots",      "game",    "commands",
                                "belief_robots", "belief_game", "outcomes"};
    std::vector<QByteArrayList> recorded(7);
    for (const QByteArray& line : file.readAll().split('\n')) {
      if (line.isEmpty() || line.startsWith('#')) continue;
      const QByteArrayList parts = line.split(' ');
      QCOMPARE(parts.size(), 3);
      const qsizetype array = arrays.indexOf(parts[0]);
      QVERIFY2(array >= 0, line.constData());
      auto& names = recorded[static_cast<std::size_t>(array)];
      QCOMPARE(parts[1].toInt(), static_cast<int>(names.size()));
      names.append(parts[2]);
    }
    for (int array = 0; array < 7; ++array) {
      QByteArrayList names;
      for (std::size_t i = 0; i < pb_column_count(array); ++i) {
        const QByteArray name = pb_column_name(array, i), words = pb_column_words(array, i);
        QVERIFY2(!name.isEmpty() && !words.isEmpty(),
                 qPrintable(QStringLiteral("%1 %2").arg(array).arg(i)));
        QVERIFY2(!names.contains(name), name.constData());
        names.append(name);
      }
      QCOMPARE(names, recorded[static_cast<std::size_t>(array)]);
    }
    QCOMPARE(pb_column_count(7), std::size_t{0});
    QCOMPARE(pb_api_version(), 4);
  }

  void aNewBeginningIsLikeANewMatch() {
    WorldsOptions options;
    options.seed = 5;
    Worlds fresh = make(steered(), options);
    Worlds again = make(steered(), options);
    playByRule(again, 100);
    QVERIFY(again.placeBall(0, {1, 1}, {2, 0}).has_value());
    playByRule(again, 50);
    QVERIFY(again.reset(0, 5).has_value());
    QCOMPARE(hashes(again), hashes(fresh));
    std::vector<std::uint32_t> boards(512), boardsAgain(512);
    QVERIFY(fresh.readBoards(boards).has_value() && again.readBoards(boardsAgain).has_value());
    QCOMPARE(boardsAgain, boards);
    // What the caller writes before the first tick is not overwritten by the scenario's beginning,
    // and what it writes later comes.
    const std::vector<std::int32_t> stop{0};
    for (Worlds* worlds : {&fresh, &again}) {
      QVERIFY(worlds->writeActions(stop).has_value() && worlds->step(30).has_value());
      QCOMPARE(first(*worlds, WorldArray::Robots, "walked_m"), 0.0);
      QVERIFY(worlds->step(60).has_value());
      QCOMPARE(first(*worlds, WorldArray::Robots, "action"), 2.0);
    }
    QCOMPARE(hashes(again), hashes(fresh));
  }

  void whatFollowsASnapshotFollowsAgain() {
    WorldsOptions options;
    options.count = 2;
    Worlds worlds = make(steered(), options);
    playByRule(worlds, 40);
    const WorldSnapshot snapshot = worlds.snapshot(1).value();
    playByRule(worlds, 70);
    const auto after = hashes(worlds);
    QVERIFY(worlds.restore(1, snapshot).has_value());
    QVERIFY(hashes(worlds)[1] != after[1]);
    QVERIFY(
        std::isnan(values(worlds, WorldArray::Percepts)[columnsOf(WorldArray::Percepts).size()]));
    playByRule(worlds, 70);
    QCOMPARE(hashes(worlds)[1], after[1]);
    // Into another world: it goes on as that one, with its seed.
    QVERIFY(worlds.restore(Worlds::all, snapshot).has_value());
    QCOMPARE(hashes(worlds)[0], hashes(worlds)[1]);
    Worlds others = make(loadScenario("match-3v3").value());
    const auto refused = others.restore(0, snapshot);
    QVERIFY(!refused && refused.error().message.find("another scenario") != std::string::npos);
  }

  /// Many worlds in one call: from one snapshot with a seed for each, placed, and some reset.
  void manyWorldsAtOnce() {
    WorldsOptions options;
    options.count = 4;
    Worlds worlds = make(steered(), options);
    playByRule(worlds, 40);
    const WorldSnapshot snapshot = worlds.snapshot(0).value();
    const std::vector<int> which{1, 3, 2};
    const std::vector<std::uint64_t> seeds{7, 8, 7};
    QVERIFY(worlds.restore(which, seeds, snapshot).has_value());
    const std::vector<std::int32_t> walk(4, 1);
    QVERIFY(worlds.writeActions(walk).has_value() && worlds.step(60).has_value());
    const auto after = hashes(worlds);
    QCOMPARE(after[1], after[2]);
    QVERIFY(after[1] != after[3] && after[1] != after[0]);

    const std::vector<Pose> poses{{{1, 1}, 0.5}, {{2, -1}, 1.5}, {{0, 2}, -1}};
    QVERIFY(worlds.placeRobots(which, RobotId{1}, poses).has_value());
    const std::vector<Point> places{{0.5, 0}, {-0.5, 0}, {0, 1}};
    const std::vector<Velocity> still(3);
    QVERIFY(worlds.placeBalls(which, places, still).has_value());
    const std::size_t row = columnsOf(WorldArray::Robots).size();
    const auto robots = values(worlds, WorldArray::Robots);
    const std::size_t x = columnOf(WorldArray::Robots, "x");
    QCOMPARE(robots[row + x], 1.0);
    QCOMPARE(robots[2 * row + x], 0.0);
    QCOMPARE(robots[3 * row + x], 2.0);
    const std::size_t gameRow = columnsOf(WorldArray::Game).size();
    const std::size_t ball = columnOf(WorldArray::Game, "ball_x");
    QCOMPARE(values(worlds, WorldArray::Game)[3 * gameRow + ball], -0.5);

    const std::vector<int> some{0, 2};
    const std::vector<std::uint64_t> again{5, 6};
    const auto before = hashes(worlds);
    QVERIFY(worlds.reset(some, again).has_value());
    Worlds fresh = make(steered(), options);
    QVERIFY(fresh.reset(0, 5).has_value() && fresh.reset(2, 6).has_value());
    QCOMPARE(hashes(worlds)[0], hashes(fresh)[0]);
    QCOMPARE(hashes(worlds)[2], hashes(fresh)[2]);
    QCOMPARE(hashes(worlds)[3], before[3]);

    // Nothing changes when a world is not there, or a value is missing.
    const auto now = hashes(worlds);
    const std::vector<int> wrong{0, 4}, everyone{Worlds::all, 1};
    QVERIFY(!worlds.reset(wrong, again) && !worlds.reset(everyone, again));
    QVERIFY(!worlds.restore(which, again, snapshot) && !worlds.placeBalls(some, places, still));
    QCOMPARE(hashes(worlds), now);
  }

  /// As a program without C++ has them: the scenario's beginning, changed, and what becomes of it.
  void rolloutsOfAScenario() {
    pb_rollout_options options;
    QCOMPARE(pb_rollout_options_init(&options, sizeof options), PB_OK);
    options.scenario = "match-3v3";
    options.noise = "realistic";
    pb_rollouts* rollouts = nullptr;
    QCOMPARE(pb_rollouts_create(&options, &rollouts), PB_OK);
    std::int32_t count = 0;
    QCOMPARE(pb_rollouts_robots(rollouts, &count), PB_OK);
    QCOMPARE(count, 6);
    const std::size_t row = pb_column_count(PB_BELIEF_ROBOTS);
    std::vector<double> robots(6 * row), game(pb_column_count(PB_BELIEF_GAME));
    QCOMPARE(
        pb_rollouts_beginning(rollouts, robots.data(), robots.size(), game.data(), game.size()),
        PB_OK);
    QCOMPARE(robots[0], -2.0);
    QCOMPARE(QByteArray(pb_column_name(PB_BELIEF_GAME, 0)), QByteArray("ball_x"));
    game[0] = 4.2;
    game[4] = 3.0;  // m/s towards the right goal
    pb_play_options play;
    QCOMPARE(pb_play_options_init(&play, sizeof play), PB_OK);
    const std::vector<std::uint64_t> seeds{1, 2, 3};
    const std::size_t columns = pb_column_count(PB_OUTCOMES);
    std::vector<double> outcomes(3 * columns), again(3 * columns);
    const auto played = [&](std::vector<double>& out) {
      return pb_rollouts_play(rollouts, &play, robots.data(), robots.size(), game.data(),
                              game.size(), seeds.data(), seeds.size(), out.data(), out.size());
    };
    QCOMPARE(played(outcomes), PB_OK);
    QCOMPARE(QByteArray(pb_column_name(PB_OUTCOMES, 3)), QByteArray("goals_left"));
    for (std::size_t i = 0; i < 3; ++i) {
      QCOMPARE(outcomes[i * columns], static_cast<double>(seeds[i]));
      QCOMPARE(outcomes[i * columns + 3], 1.0);
    }
    // NaN is what the scenario begins with.
    std::ranges::fill(robots, std::nan(""));
    QCOMPARE(played(again), PB_OK);
    QCOMPARE(again, outcomes);

    game[10] = 9.0;  // a state that there is not
    QCOMPARE(played(again), PB_INVALID_ARGUMENT);
    QVERIFY(QByteArray(pb_last_error()).contains("state"));
    game[10] = 3.0;
    again.pop_back();
    QCOMPARE(played(again), PB_INVALID_ARGUMENT);
    robots.pop_back();
    QCOMPARE(played(outcomes), PB_INVALID_ARGUMENT);
    QCOMPARE(pb_rollouts_destroy(rollouts), PB_OK);
    QCOMPARE(pb_rollouts_destroy(rollouts), PB_STALE_HANDLE);
    QCOMPARE(pb_rollouts_robots(rollouts, &count), PB_STALE_HANDLE);
    options.tick_rate = 17.0;
    QCOMPARE(pb_rollouts_create(&options, &rollouts), PB_INVALID_ARGUMENT);
    QVERIFY(rollouts == nullptr);
    options.size = 3;
    QCOMPARE(pb_rollouts_create(&options, &rollouts), PB_INVALID_ARGUMENT);
  }

  void theTruthIsTheScenarios() {
    Worlds worlds = make(loadScenario("one-robot").value());
    QCOMPARE(first(worlds, WorldArray::Robots, "x"), -1.5);
    QCOMPARE(first(worlds, WorldArray::Robots, "yaw"), 0.0);
    QVERIFY(std::isnan(first(worlds, WorldArray::Percepts, "imu_yaw")));
    QVERIFY(std::isnan(first(worlds, WorldArray::Game, "play_state")));
    QVERIFY(worlds.setBehaviour(RobotId{1}, std::string(noBehaviour)).has_value());
    QVERIFY(worlds.reset(0, 1).has_value());
    const std::vector<std::int32_t> walk{1};
    QVERIFY(worlds.writeActions(walk).has_value() && worlds.step(60).has_value());
    const double x = first(worlds, WorldArray::Robots, "x");
    QVERIFY(std::abs(x + 1.5 - first(worlds, WorldArray::Robots, "walked_m")) < 1e-9);
    QVERIFY(x > -1.5);
    // The ball lies straight ahead, at the centre; vision tells the distance from the body, in cm.
    QCOMPARE(first(worlds, WorldArray::Percepts, "ball_lost"), 0.0);
    const double distance_cm = first(worlds, WorldArray::Percepts, "ball_distance_cm");
    QVERIFY(std::abs(distance_cm + 100.0 * x) < 1e-9);
    QCOMPARE(first(worlds, WorldArray::Percepts, "ball_angle_deg"), 0.0);
    const std::vector<Variable> distance{worldVariable("VISION_BALL_DIST").value()};
    std::vector<double> reported(1);
    QVERIFY(worlds.readVariables(distance, reported).has_value());
    QCOMPARE(reported[0], static_cast<double>(static_cast<float>(distance_cm)));
    std::vector<std::uint32_t> board(512);
    QVERIFY(worlds.readBoards(board).has_value());
    const auto word = static_cast<std::size_t>(Blackboard::floatOffset + distance[0].index);
    QCOMPARE(std::bit_cast<float>(board[word]), static_cast<float>(reported[0]));
  }

  void aWorldThatIsOverStandsStill() {
    Scenario scenario = steered();
    scenario.stop.goal = true;
    WorldsOptions options;
    options.count = 2;
    Worlds worlds = make(scenario, options);
    QVERIFY(worlds.placeBall(1, {4.0, 0.0}, {6.0, 0.0}).has_value());
    QVERIFY(worlds.step(300).has_value());
    const auto game = values(worlds, WorldArray::Game);
    const std::size_t row = columnsOf(WorldArray::Game).size();
    QCOMPARE(game[0], 300.0);
    QVERIFY(game[row] < 300.0);
    QCOMPARE(game[columnOf(WorldArray::Game, "finished")], 0.0);
    QCOMPARE(game[row + columnOf(WorldArray::Game, "finished")], 1.0);
    QCOMPARE(game[row + columnOf(WorldArray::Game, "score_left")] +
                 game[row + columnOf(WorldArray::Game, "score_right")],
             1.0);
    QCOMPARE(worlds.finishedBy(1), std::string_view("goal"));
    const WorldSnapshot over = worlds.snapshot(1).value();
    QVERIFY(worlds.reset(1, 9).has_value() && worlds.step(1).has_value());
    QCOMPARE(worlds.finishedBy(1), std::string_view());
    QVERIFY(worlds.restore(1, over).has_value() && worlds.step(5).has_value());
    QCOMPARE(worlds.finishedBy(1), std::string_view("goal"));
    QCOMPARE(values(worlds, WorldArray::Game)[row], game[row]);
  }

  void commandsReachTheRobot() {
    Worlds worlds = make(steered());
    std::vector<std::int32_t> commands(commandColumns().size(), Worlds::keep);
    QVERIFY(worlds.writeCommands(commands).has_value());
    const std::vector<Variable> action{worldVariable("DECISION_ACTION_A").value(),
                                       worldVariable("DECISION_SEARCH_ON").value()};
    std::vector<double> reported(2);
    QVERIFY(worlds.readVariables(action, reported).has_value());
    QCOMPARE(reported, (std::vector<double>{1, 1}));
    commands[0] = 7;
    commands[2] = 0;
    QVERIFY(worlds.writeCommands(commands).has_value() &&
            worlds.readVariables(action, reported).has_value());
    QCOMPARE(reported, (std::vector<double>{7, 0}));
    reported = {std::nan(""), 1};
    QVERIFY(worlds.writeVariables(action, reported).has_value() &&
            worlds.readVariables(action, reported).has_value());
    QCOMPARE(reported, (std::vector<double>{7, 1}));
    reported = {1.5, 1};
    QVERIFY(!worlds.writeVariables(action, reported));
  }

  void aSessionIsReadThroughTheCInterface() {
    const QTemporaryDir folder;
    const std::string path = folder.filePath("five.mcap").toStdString();
    writeSession(path);
    pb_session* session = nullptr;
    QCOMPARE(pb_session_open((path + "x").c_str(), &session), PB_NOT_FOUND);
    QVERIFY(QByteArray(pb_last_error()).contains("five.mcapx"));
    QCOMPARE(pb_session_open(nullptr, &session), PB_INVALID_ARGUMENT);
    QCOMPARE(pb_session_open(path.c_str(), &session), PB_OK);

    pb_data* data = nullptr;
    QCOMPARE(pb_session_describe(session, &data), PB_OK);
    const auto text = spanOf<char>(data, 0, PB_CHARS);
    const auto about = QJsonDocument::fromJson({text.data(), qsizetype(text.size())}).object();
    QCOMPARE(about["title"].toString(), "five rows");
    QCOMPARE(about["seed"].toInt(), 7);
    QCOMPARE(about["until"].toDouble(), 4.0);
    const auto group = about["groups"][0].toObject();
    QCOMPARE(group["name"].toString(), "B1");
    QCOMPARE(group["rows"].toInt(), 5);
    QCOMPARE(group["columns"][1]["unit"].toString(), "cm");
    QCOMPARE(group["columns"][1]["type"].toInt(), int(PB_FLOAT32));
    QCOMPARE(pb_data_free(data), PB_OK);
    QCOMPARE(pb_data_free(data), PB_STALE_HANDLE);

    std::int32_t index = -1;
    QCOMPARE(pb_session_group(session, "R1", &index), PB_OK);  // before a correction
    QCOMPARE(index, 0);
    QCOMPARE(pb_session_group(session, "R2", &index), PB_NOT_FOUND);
    QVERIFY(QByteArray(pb_last_error()).contains("B1"));

    const std::int32_t columns[] = {2, 1, 0};
    QCOMPARE(pb_session_rows(session, 0, columns, 3, 1.0, 3.0, PB_UNKNOWN_NAN, &data), PB_OK);
    QCOMPARE(spanOf<double>(data, 0, PB_FLOAT64), (std::vector<double>{1, 2, 3}));
    QCOMPARE(spanOf<double>(data, 1, PB_FLOAT64), (std::vector<double>{0.1, 0.1 * 2, 0.1 * 3}));
    const auto distances = spanOf<float>(data, 2, PB_FLOAT32);
    QVERIFY(std::isnan(distances[0]) && distances[1] == 21.0F && std::isnan(distances[2]));
    QCOMPARE(spanOf<std::int32_t>(data, 3, PB_INT32), (std::vector<std::int32_t>{1, 0, 1}));
    pb_span span{};
    QCOMPARE(pb_data_span(data, 0, &span), PB_INVALID_ARGUMENT);
    span.size = sizeof span;
    QCOMPARE(pb_data_span(data, 4, &span), PB_NOT_FOUND);
    pb_data_free(data);
    constexpr double always = std::numeric_limits<double>::infinity();
    QCOMPARE(pb_session_rows(session, 0, columns, 2, -always, always, PB_UNKNOWN_OLD, &data),
             PB_OK);
    QCOMPARE(spanOf<float>(data, 2, PB_FLOAT32), (std::vector<float>{0, 10.5F, 21, 31.5F, 42}));
    pb_data_free(data);

    QCOMPARE(pb_session_frame(session, 3.5, &data), PB_OK);
    const auto frame = spanOf<double>(data, 0, PB_FLOAT64);
    QCOMPARE(frame.size(), std::size_t{4});
    QVERIFY(frame[0] == 3.0 && frame[1] == 1.0 && std::isnan(frame[2]) && frame[3] == 0.1 * 3);
    pb_data_free(data);
    QCOMPARE(pb_session_events(session, 0.0, 2.9, &data), PB_OK);
    QCOMPARE(spanOf<char>(data, 0, PB_CHARS), (std::vector<char>{'[', ']'}));
    pb_data_free(data);
    QCOMPARE(pb_session_events(session, 0.0, 3.0, &data), PB_OK);
    QVERIFY(spanOf<char>(data, 0, PB_CHARS).size() > 20);

    // What was read stays; everything else is refused with a sentence.
    pb_data* none = nullptr;
    const std::int32_t wrong[] = {3};
    QCOMPARE(pb_session_rows(session, 1, columns, 3, 0, 1, 0, &none), PB_NOT_FOUND);
    QCOMPARE(pb_session_rows(session, 0, wrong, 1, 0, 1, 0, &none), PB_NOT_FOUND);
    QCOMPARE(pb_session_rows(session, 0, nullptr, 1, 0, 1, 0, &none), PB_INVALID_ARGUMENT);
    QCOMPARE(pb_session_rows(session, 0, columns, 3, 1, 0, 0, &none), PB_INVALID_ARGUMENT);
    QCOMPARE(pb_session_rows(session, 0, columns, 3, 0, 1, 2, &none), PB_INVALID_ARGUMENT);
    QCOMPARE(pb_session_frame(session, std::nan(""), &none), PB_INVALID_ARGUMENT);
    QCOMPARE(pb_session_close(session), PB_OK);
    QCOMPARE(pb_session_close(session), PB_STALE_HANDLE);
    QCOMPARE(pb_session_frame(session, 1.0, &none), PB_STALE_HANDLE);
    QVERIFY(none == nullptr);
    QVERIFY(spanOf<char>(data, 0, PB_CHARS).size() > 20);
    pb_data_free(data);
    QCOMPARE(pb_data_free(nullptr), PB_OK);
    QCOMPARE(pb_session_close(nullptr), PB_OK);
  }

  void programsOfATeamAreRefused() {
    Scenario scenario = steered();
    scenario.robots[0].runtime.decision = "/bin/true";
    const auto refused = Worlds::create(scenario, {});
    QVERIFY(!refused);
    QCOMPARE(refused.error().code, ErrorCode::Unsupported);
  }
};

}  // namespace tst_capi

QTEST_GUILESS_MAIN(tst_capi::TestCapi)

#include "tst_capi.moc"
