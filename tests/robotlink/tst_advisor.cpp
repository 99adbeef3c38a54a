// SPDX-License-Identifier: GPL-3.0-or-later
// The advisor: what it learns of the opponents, with values worked out on paper, where its keeper
// stands, how what it learned outlives a restored moment and the match, and its file.
#include <QtTest>

#include <cmath>
#include <fstream>
#include <limits>

#include <robotlink/cognition/process_registry.h>
#include <robotlink/match/moment.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/models/robot_models.h>
#include <simcore/world/published_frame.h>

#include "../support/match_moment.h"
#include "soccer/aim_habit.h"
#include "soccer/soccer_board.h"

namespace tst_advisor {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

sim::FieldSpec field() {
  return sim::fieldByName("kid-2020").value();
}

constexpr int keeper = 1;  // of the advised team, its number on the field
constexpr int tickRate = 60;

/// Two a side on a small field; red's striker always aims at the right half of the goal.
Scenario duel() {
  Scenario scenario =
      loadScenario((std::string(PITCHBOARD_TEST_DATA) + "/teams/duel.json")).value();
  scenario.settings.seed = 11;
  scenario.advisors[TeamColor::Blue];
  for (ScenarioRobot& robot : scenario.robots) {
    if (robot.identity.team == TeamColor::Red) robot.parameters.aimSide = -0.5;
    if (robot.identity.team == TeamColor::Blue && robot.behaviour != "keeper") {
      robot.behaviour = "idle";  // so that there are many shots
    }
  }
  return scenario;
}

AimHabit learnedBy(const SimulatedMatch& match, int robot = keeper) {
  const AdvisorVariables v;
  std::array<std::int32_t, AimHabit::words> words{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = match.blackboard(RobotId{robot})->read(v.evidence[i]);
  }
  return AimHabit::fromWords(words);
}

void play(SimulatedMatch& match, int seconds) {
  for (int i = 0; i < seconds * tickRate; ++i) match.tick();
}

ProcessOptions kidSize() {
  ProcessOptions options;
  options.field = field();
  options.model = loadRobotModel("kid-size").value();
  options.behaviour = "keeper";
  options.facesLeft = false;
  return options;
}

/// The blackboard of a keeper that knows where it is and sees the ball.
struct Keeper {
  Keeper() {
    const RobotVariables v;
    board.write(v.comReferee, 2);
    board.write(v.localizationBelief, 10.0F);
    put(v.localizationX, v.localizationY, {-4.0, 0.0});
  }
  void put(IntVar x, IntVar y, const Point& place) {
    const auto cm = sim::published_frame::localizationFromStudio(field(), {place, 0.0});
    board.write(x, static_cast<int>(std::lround(cm.x)));
    board.write(y, static_cast<int>(std::lround(cm.y)));
  }
  void see(const Point& ball) {
    const RobotVariables v;
    const Point here{-4.0, 0.0};
    board.write(v.visionLost, 0);
    board.write(v.visionBallDist, static_cast<float>(100.0 * distance(here, ball)));
    board.write(v.visionPanDeg, static_cast<float>(57.29578 * direction(here, ball)));
  }
  Blackboard board = Blackboard::onHeap();
};

}  // namespace

class TestAdvisor : public QObject {
  Q_OBJECT
 private slots:
  void evidenceAddsUp() {
    AimHabit e;
    e.add({0.0, -1.0, -2.0, -0.0004, -0.5, -100.0, 0.0});
    QCOMPARE(e.behind, (std::array<std::uint16_t, 7>{0, 1000, 2000, 0, 500, 12000, 0}));
    // The second is the best now, and the others are behind it.
    e.add({-3.0, 0.0, 0.0, -3.0, -3.0, 0.0, -3.0});
    QCOMPARE(e.behind, (std::array<std::uint16_t, 7>{2000, 0, 1000, 2000, 2500, 11000, 2000}));
  }

  void sharesFollowFromPriorAndEvidence() {
    AimHabit habit;
    const auto before = habit.shares();
    QVERIFY(std::abs(before[3] - 0.5) < 1e-12 && std::abs(before[0] - 0.5 / 6) < 1e-12);
    QVERIFY(std::abs(habit.meanAim()) < 1e-12);
    habit.behind[3] = 2303;  // a tenth as likely as the others: 0.05 of 0.55
    QVERIFY(std::abs(habit.shares()[3] - 0.05 / 0.55) < 1e-4);
    habit.behind = {12000, 0, 12000, 12000, 12000, 12000, 12000};  // all but surely at -0.5
    QVERIFY(std::abs(habit.meanAim() + 0.5) < 1e-3);
    // Half of the way to the middle of that half of the goal, whose posts are 2.6 m apart; their
    // right is the keeper's left.
    const double half = 1.3 - field().goalPostRadius - field().ballRadius;
    QVERIFY(std::abs(keeperShift(habit, field()) - 0.25 * half) < 1e-3);
    QCOMPARE(keeperShift({}, field()), 0.0);
  }

  void mirroredSidesLearnMirrored() {
    AimHabit left, right;
    left.addKick(field(), {2.0, 0.3}, {3.0, 0.5});
    right.addKick(field(), {2.0, -0.3}, {3.0, -0.5});
    for (std::size_t i = 0; i < left.behind.size(); ++i) {
      QCOMPARE(left.behind[i], right.behind[left.behind.size() - 1 - i]);
    }
    QVERIFY(left.behind[5] < left.behind[1]);
  }

  void fewKicksShowTheSide() {
    AimHabit habit, back;
    for (int i = 0; i < 5; ++i) habit.addKick(field(), {1.5, 0.0}, {3.0, -0.35});  // to y -0.7
    QVERIFY2(habit.meanAim() < -0.3, "they kick to the right");
    back.addKick(field(), {1.5, 0.0}, {0.0, 0.5});  // backwards says nothing
    QVERIFY(back == AimHabit{});
  }

  void allOfItFitsTheVariables() {
    AimHabit habit;
    for (std::size_t i = 0; i < habit.behind.size(); ++i) {
      habit.behind[i] = static_cast<std::uint16_t>(12000 - 77 * i);
    }
    QVERIFY(AimHabit::fromWords(habit.asWords()) == habit);
    std::array<std::int32_t, AimHabit::words> hostile{};
    hostile.fill(-1);
    QCOMPARE(int(AimHabit::fromWords(hostile).behind[0]), 12000);
  }

  /// A ball that rolls past on its left, from the opponents' right, and not one that it kicked
  /// itself.
  void kicksAreWatched_data() {
    QTest::addColumn<double>("from");
    QTest::addColumn<bool>("learns");
    QTest::newRow("of an opponent") << -1.5 << true;
    QTest::newRow("of its own") << -3.6 << false;
  }
  void kicksAreWatched() {
    QFETCH(double, from);
    QFETCH(bool, learns);
    Keeper seen;
    const auto advisor = findProcess("advisor")->make(kidSize()).value();
    double time = 0.0;
    Point ball{from, 0.0};
    const auto step = [&] {
      seen.see(ball);
      advisor->step(seen.board, {time += 0.1});
    };
    for (int i = 0; i < 30; ++i) step();
    const double towards = learns ? -0.18 : 0.18;
    for (int i = 0; i < 8; ++i) {
      ball = {ball.x + towards, ball.y + 0.045};  // to y 0.75 on the goal line
      step();
    }
    const AdvisorVariables v;
    const float aside = seen.board.read(v.aside), aim = seen.board.read(v.aim);
    QVERIFY2(learns ? aside > 3.0F && aside < 60.0F : std::abs(aside) < 0.001F,
             qPrintable(QString::number(static_cast<double>(aside))));
    QCOMPARE(aim < -0.05F, learns);
  }

  /// It stands farther to the side where the ball will come, and takes no number for more.
  void aKeeperListensToIt_data() {
    QTest::addColumn<float>("aside");
    QTest::addColumn<int>("moved");  // cm
    const float nan = std::numeric_limits<float>::quiet_NaN();
    QTest::newRow("left") << 30.0F << 30;
    QTest::newRow("right") << -20.0F << -20;
    QTest::newRow("too far") << 1e9F << 60;
    QTest::newRow("no number") << nan << 0;
  }
  void aKeeperListensToIt() {
    QFETCH(float, aside);
    QFETCH(int, moved);
    const auto placeWith = [](float value) {
      Keeper seen;
      seen.board.write(AdvisorVariables().aside, value);
      seen.see({0.0, 0.0});
      const auto decision = findProcess("decision")->make(kidSize()).value();
      for (int i = 0; i < 5; ++i) decision->step(seen.board, {0.1 * i});
      return seen.board.read(*VariableCatalog::published().intVar("DECISION_POSITION_B"));
    };
    // The published y points down.
    QVERIFY(std::abs(placeWith(0.0F) - placeWith(aside) - moved) <= 1);
  }

  void behavioursHavePeculiarities() {
    Scenario scenario = duel();
    scenario.advisors.clear();
    for (ScenarioRobot& robot : scenario.robots) {
      if (robot.identity.team != TeamColor::Red) continue;
      if (robot.behaviour != "keeper") robot.behaviour = "idle";
      robot.parameters.keeperArc = 0.0;
      robot.parameters.keeperAside = 0.8;
      robot.parameters.keeperOut = robot.parameters.clearWithin = robot.parameters.clearUntil = 0.0;
    }
    SimulatedMatch match = SimulatedMatch::create(scenario, {}).value();
    play(match, 50);
    const auto place = match.simulation().snapshot().robots[2].pose.position;
    QVERIFY2(place.x > 2.4 && place.y < -0.35, qPrintable(QString::number(place.y)));
  }

  /// It learns that the striker aims at the right, so does a match that continues from a restored
  /// moment, and robots without an advisor learn nothing.
  void aMatchShowsIt() {
    SimulatedMatch match = SimulatedMatch::create(duel(), {}).value();
    play(match, 240);
    const AimHabit before = learnedBy(match);
    QVERIFY2(before.meanAim() < -0.1, habitToJson(before).c_str());
    QCOMPARE(learnedBy(match, 2), AimHabit{});  // no keeper
    QCOMPARE(learnedBy(match, 3), AimHabit{});  // of the other team
    const Moment moment = momentOf(match);
    play(match, 60);
    const AimHabit after = learnedBy(match);
    const std::uint64_t hash = match.simulation().hash();
    QVERIFY(match.restore(moment));
    QCOMPARE(learnedBy(match), before);
    play(match, 60);
    QCOMPARE(match.simulation().hash(), hash);
    QCOMPARE(learnedBy(match), after);
  }

  void aProcessThatIsStartedAgainContinues() {
    SimulatedMatch match = SimulatedMatch::create(duel(), {}).value();
    play(match, 120);
    const AimHabit before = learnedBy(match);
    QVERIFY(before != AimHabit{});
    QVERIFY(match.robots().restartProcess(RobotId{keeper}, "advisor"));
    for (int i = 0; i < 12; ++i) match.tick();
    QCOMPARE(learnedBy(match), before);
  }

  /// While a match is played, and back again; then its keeper stands where it always stood.
  void teamsGetAndLoseTheirAdvisor() {
    Scenario scenario = duel();
    scenario.advisors.clear();
    SimulatedMatch match = SimulatedMatch::create(scenario, {}).value();
    play(match, 120);
    QCOMPARE(learnedBy(match), AimHabit{});
    QVERIFY(match.robots().setAdvisor(TeamColor::Blue, AdvisorOptions{}));
    play(match, 240);
    const FloatVar aside = AdvisorVariables().aside;
    QVERIFY(match.blackboard(RobotId{keeper})->read(aside) != 0.0F);
    QVERIFY(match.toScenario().advisors.contains(TeamColor::Blue));
    QVERIFY(match.robots().setAdvisor(TeamColor::Blue, {}));
    QCOMPARE(match.blackboard(RobotId{keeper})->read(aside), 0.0F);
    QVERIFY(match.toScenario().advisors.empty());
  }

  /// A robot of each shirt has a file of its own; the next match begins with it.
  void aFileCarriesItOver() {
    QTemporaryDir folder;
    Scenario scenario = duel();
    scenario.advisors[TeamColor::Blue].memory = folder.filePath("seen.json").toStdString();
    AimHabit last;
    {
      SimulatedMatch match = SimulatedMatch::create(scenario, {}).value();
      play(match, 120);
      last = learnedBy(match);
    }
    QVERIFY(last != AimHabit{});
    const std::string path = folder.filePath("seen-1.json").toStdString();
    QCOMPARE(loadHabit(path).value(), last);
    SimulatedMatch next = SimulatedMatch::create(scenario, {}).value();
    play(next, 1);
    QCOMPARE(learnedBy(next), last);

    // Matches that must not depend on each other read it only.
    MatchOptions readOnly;
    readOnly.process.keepsMemory = false;
    {
      SimulatedMatch match = SimulatedMatch::create(scenario, readOnly).value();
      play(match, 120);
      QVERIFY(learnedBy(match) != last);
    }
    QCOMPARE(loadHabit(path).value(), last);
  }

  void filesAreChecked_data() {
    QTest::addColumn<QString>("from");
    QTest::addColumn<QString>("to");
    QTest::newRow("no JSON") << "{"
                             << "";
    QTest::newRow("later version") << "\"version\":1"
                                   << "\"version\":2";
    QTest::newRow("another key") << "\"aim\""
                                 << "\"aims\"";
    const auto row = [](const char* name, const char* to) {
      QTest::newRow(name) << "\"aim\":[0," << QStringLiteral("\"aim\":[%1").arg(to);
    };
    row("too few", "");
    row("too many", "0,0,");
    row("negative", "-1,");
    row("fraction", "0.5,");
    row("large", "65536,");
    row("text", "\"0\",");
  }
  void filesAreChecked() {
    QFETCH(QString, from);
    QFETCH(QString, to);
    QString text = QString::fromStdString(habitToJson({}));
    QCOMPARE(habitFromJson(text.toStdString(), "test").value(), AimHabit{});
    QVERIFY(text.contains(from));
    text.replace(text.indexOf(from), from.size(), to);
    const auto read = habitFromJson(text.toStdString(), "opponents.json");
    QVERIFY(!read);
    QVERIFY(read.error().text().find("opponents.json") != std::string::npos);

    QTemporaryDir folder;
    ProcessOptions options = kidSize();
    options.advisor.memory = folder.filePath("opponents.json").toStdString();
    QVERIFY(findProcess("advisor")->make(options));  // there is none yet
    std::ofstream(options.advisor.memory) << text.toStdString();
    QVERIFY(!findProcess("advisor")->make(options));
  }

  /// A file of version 0.22 has more than the aim.
  void olderFilesAreRead() {
    const auto read = loadHabit(PITCHBOARD_TEST_DATA "/teams/aims-right-1.json");
    QVERIFY2(read.has_value(), read ? "" : read.error().text().c_str());
    QVERIFY(read->meanAim() < -0.3);
  }

  void scenariosSetTheAdvisor() {
    const auto read = [](const char* teams) {
      return scenarioFromJson(QString(R"({"version": 1, "teams": %1})").arg(teams).toStdString(),
                              "test");
    };
    // The first as in a session of version 0.22.
    const auto scenario = read(
        R"([{"colour": "blue", "advisor": {"rollouts": 40, "horizon": 5, "memory": "seen.json"}},
            {"colour": "red", "advisor": true}])");
    QVERIFY(scenario);
    QCOMPARE(scenario->advisors.at(TeamColor::Blue).memory, std::string("seen.json"));
    QVERIFY(scenario->advisors.at(TeamColor::Red) == AdvisorOptions{});
    QVERIFY(scenarioFromJson(scenarioToJson(*scenario), "again").value() == *scenario);
    QVERIFY(read(R"([{"colour": "blue", "advisor": false}])")->advisors.empty());
    QVERIFY(!read(R"([{"colour": "blue", "advisor": 3}])"));
    QVERIFY(!read(R"([{"colour": "blue", "advisor": {"share": 0.5}}])"));
  }
};

PITCHBOARD_TEST(TestAdvisor)

}  // namespace tst_advisor

#include "tst_advisor.moc"
