// SPDX-License-Identifier: GPL-3.0-or-later
// What the advisor learns of the opponents: values worked out on paper, what it watches, matches in
// which it learns, how that outlives a half, a restored moment and the match, and the file.
#include <QtTest>

#include <cmath>
#include <fstream>

#include <base/read_file.h>
#include <robotlink/advisor/reference_processes.h>
#include <robotlink/cognition/keeper_place.h>
#include <robotlink/match/moment.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/models/robot_models.h>
#include <robotlink/rollout/rollouts.h>

#include "../support/match_moment.h"
#include "game_belief.h"
#include "lookahead.h"
#include "opponent_file.h"
#include "opponent_watch.h"

namespace tst_opponents {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

sim::FieldSpec field() {
  return sim::fieldByName("kid-2020").value();
}

std::size_t likeliest(const std::vector<double>& shares) {
  return static_cast<std::size_t>(std::ranges::max_element(shares) - shares.begin());
}

constexpr std::size_t staysLeft = 9, followsBall = 2;  // of keeperModel()

/// Two a side on a small field; red's keeper never leaves the left of its goal, and its
/// striker stands.
Scenario duel(bool learns = true) {
  Scenario scenario =
      loadScenario((std::string(PITCHBOARD_TEST_DATA) + "/teams/duel.json")).value();
  scenario.settings.seed = 11;
  scenario.advisors[TeamColor::Blue].learns = learns;
  for (ScenarioRobot& robot : scenario.robots) {
    if (robot.identity.team != TeamColor::Red) continue;
    if (robot.behaviour != "keeper") {
      robot.behaviour = "idle";
      continue;
    }
    robot.parameters.keeperArc = 0.0;
    robot.parameters.keeperAside = 0.8;
    robot.parameters.keeperOut = robot.parameters.clearWithin = robot.parameters.clearUntil = 0.0;
  }
  return scenario;
}

OpponentModel learnedBy(const SimulatedMatch& match, int robot) {
  const AdvisorVariables v;
  std::array<std::int32_t, OpponentModel::words> words{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = match.blackboard(RobotId{robot})->read(v.learned[i]);
  }
  return OpponentModel::fromWords(words);
}

constexpr int striker = 2;  // its number on the field
constexpr int tickRate = 60;

void play(SimulatedMatch& match, int seconds) {
  for (int i = 0; i < seconds * tickRate; ++i) match.tick();
}

/// A robot that sees everything.
Situation seeing(const Point& ball, const Points& opponents) {
  Situation now;
  now.referee = Referee::Play;
  now.localized = true;
  now.pose = {{-4.0, 0.0}, 0.0};
  now.ball = ball;
  now.seesBall = true;
  now.opponents = opponents;
  return now;
}

}  // namespace

class TestOpponents : public QObject {
  Q_OBJECT
 private slots:
  void evidenceAddsUp() {
    Evidence<aimModels> e;
    e.add({0.0, -1.0, -2.0, -0.0004, -0.5, -100.0, 0.0});
    QCOMPARE(e.behind, (std::array<std::uint16_t, aimModels>{0, 1000, 2000, 0, 500, 12000, 0}));
    // The second is the best now, and the others are behind it.
    e.add({-3.0, 0.0, 0.0, -3.0, -3.0, 0.0, -3.0});
    QCOMPARE(e.behind,
             (std::array<std::uint16_t, aimModels>{2000, 0, 1000, 2000, 2500, 11000, 2000}));
  }

  void sharesFollowFromPriorAndEvidence() {
    OpponentModel model;
    QCOMPARE(model.summary(), 0);
    const auto before = model.aimShares();
    QVERIFY(std::abs(before[3] - 0.5) < 1e-12 && std::abs(before[0] - 0.5 / 6) < 1e-12);
    model.aim.behind[3] = 2303;  // a tenth as likely as the others: 0.05 of 0.55
    QVERIFY(std::abs(model.aimShares()[3] - 0.05 / 0.55) < 1e-4);
    QVERIFY(model.summary() > 0);
  }

  /// The ball is straight before the goal and the keeper 0.8 m to its left: under "aside by a" the
  /// likelihood is 0.8 N(0.8; a, 0.3) + 0.2 / 2.6, 1.1408 for 0.8 and 0.1073 for 0.
  void oneLookAtTheKeeper() {
    QCOMPARE(field().goalWidth, 2.6);
    OpponentModel model;
    learnKeeper(model, field(), {-4.3, 0.8}, {0.0, 0.0});
    QCOMPARE(int(model.keeper.behind[4]), 0);
    QCOMPARE(int(model.keeper.behind[staysLeft]), 0);
    const double expected = 1000.0 * std::log(1.14077 / 0.10731);
    QVERIFY(std::abs(model.keeper.behind[followsBall] - expected) < 2.0);
  }

  void mirroredSidesLearnMirrored() {
    OpponentModel left, right;
    learnKeeper(left, field(), {-4.3, 0.5}, {1.0, 1.5});
    learnKeeper(right, field(), {-4.3, -0.5}, {1.0, -1.5});
    for (std::size_t i = 0; i < 5; ++i) {
      QCOMPARE(left.keeper.behind[i], right.keeper.behind[4 - i]);
      QCOMPARE(left.keeper.behind[5 + i], right.keeper.behind[9 - i]);
    }
    learnAim(left, field(), {2.0, 0.3}, {3.0, 0.5});
    learnAim(right, field(), {2.0, -0.3}, {3.0, -0.5});
    for (std::size_t i = 0; i < aimModels; ++i) {
      QCOMPARE(left.aim.behind[i], right.aim.behind[aimModels - 1 - i]);
    }
    QVERIFY(left.aim.behind[5] < left.aim.behind[1]);
  }

  void fewKicksShowTheSide() {
    OpponentModel model;
    for (int i = 0; i < 5; ++i) learnAim(model, field(), {1.5, 0.0}, {3.0, -0.35});  // y -0.7
    QVERIFY2(likeliest(model.aimShares()) <= 1, "they kick to the right");
    OpponentModel back;
    learnAim(back, field(), {1.5, 0.0}, {0.0, 0.5});  // backwards says nothing
    QVERIFY(back == OpponentModel{});
  }

  /// Then a keeper expects more of another place; nothing else is decided differently.
  void theSurerThatTheyAimElsewhereTheMoreAKeeperMayGain() {
    OpponentModel model;
    QCOMPARE(model.aimsUnusually(), 0.0);
    const LookaheadPlan usual = planFor(Question::Keeper, 36, 5.0, model);
    QCOMPARE(usual.usualGain, LookaheadPlan{}.usualGain);
    QCOMPARE(usual.gainSpread, LookaheadPlan{}.gainSpread);
    model.aim.behind[3] = 2303;  // 0.05 of 0.55 for the usual aim, where the prior is a half
    const double surely = 1.0 - 0.05 / 0.55 / 0.5;
    QVERIFY(std::abs(model.aimsUnusually() - surely) < 1e-4);
    const LookaheadPlan plan = planFor(Question::Keeper, 36, 5.0, model);
    QVERIFY(std::abs(plan.usualGain - (1.0 - surely) * LookaheadPlan{}.usualGain) < 1e-5);
    QVERIFY(plan.gainSpread > 3 * LookaheadPlan{}.gainSpread);
    QCOMPARE(planFor(Question::AtBall, 36, 5.0, model).gainSpread, LookaheadPlan{}.gainSpread);
    OpponentModel straight;
    for (int i = 0; i < 5; ++i) learnAim(straight, field(), {1.5, 0.0}, {3.0, 0.0});
    QCOMPARE(straight.aimsUnusually(), 0.0);
  }

  void walksShowThePace() {
    OpponentModel slow, usual, standing;
    for (int i = 0; i < 20; ++i) {
      learnPace(slow, i % 2 ? 0.28 : 0.34, 0.2);
      learnPace(usual, i % 2 ? 0.5 : 0.65, 0.2);
      learnPace(standing, 0.1, 0.2);
    }
    QVERIFY(likeliest(slow.paceShares()) <= 1);
    const std::size_t found = likeliest(usual.paceShares());
    QVERIFY2(found >= 2 && found <= 3, qPrintable(QString::number(found)));
    QVERIFY(standing == OpponentModel{});
  }

  void allOfItFitsTheVariables() {
    OpponentModel model;
    for (std::size_t i = 0; i < keeperModels; ++i) {
      model.keeper.behind[i] = static_cast<std::uint16_t>(1000 * i);
    }
    for (std::size_t i = 0; i < aimModels; ++i) {
      model.aim.behind[i] = static_cast<std::uint16_t>(77 * i);
      model.pace.behind[i] = static_cast<std::uint16_t>(12000 - i);
    }
    QCOMPARE(OpponentModel::fromWords(model.asWords()), model);
    std::array<std::int32_t, OpponentModel::words> hostile{};
    hostile.fill(-1);
    QCOMPARE(int(OpponentModel::fromWords(hostile).aim.behind[0]), 12000);
  }

  /// A place that stays on the blackboard is one look, and the referee's word counts.
  void looksAreCountedOnce() {
    const ProcessOptions usual;
    OpponentWatch watch;
    OpponentModel learned;
    const Situation now = seeing({0.0, 0.0}, {Point{4.3, -0.8}});  // its left
    for (int i = 0; i < 100; ++i) watch.update(now, 0.1 * i, field(), usual.model, learned);
    const auto once = learned.keeper;
    QCOMPARE(int(once.behind[staysLeft]), 0);
    QVERIFY(int(once.behind[followsBall]) > 2000 && int(once.behind[followsBall]) < 3000);

    OpponentWatch other;
    OpponentModel nothing;
    Situation stopped = now;
    stopped.referee = Referee::Stop;
    other.update(stopped, 0.0, field(), usual.model, nothing);
    QVERIFY(nothing == OpponentModel{});
  }

  void kicksAreWatched_data() {
    QTest::addColumn<bool>("ours");
    QTest::newRow("of an opponent") << false;
    QTest::newRow("with one of ours at the ball") << true;
  }
  void kicksAreWatched() {
    QFETCH(bool, ours);
    const ProcessOptions usual;
    OpponentWatch watch;
    OpponentModel learned;
    double time = 0.0;
    Point ball{-1.5, 0.0};
    const auto see = [&] {
      Situation now = seeing(ball, {Point{-1.2, 0.05}});
      if (ours) now.pose.position = {-1.7, 0.2};
      watch.update(now, time += 0.1, field(), usual.model, learned);
    };
    for (int i = 0; i < 30; ++i) see();
    for (int i = 0; i < 8; ++i) {
      ball = {ball.x - 0.18, ball.y + 0.045};  // to y 0.75: to the right of who attacks -x
      see();
    }
    QCOMPARE(learned == OpponentModel{}, ours);
    if (!ours) QVERIFY(learned.aim.behind[1] < learned.aim.behind[5]);
  }

  /// What a keeper is believed to do is where it is believed to stand.
  void beliefHasWhatWasLearned() {
    ProcessOptions options;
    options.field = field();
    options.model = loadRobotModel("kid-size").value();
    Situation now = seeing({0.0, 0.0}, {});
    now.mates[0] = TeamMate{{-4.0, 0.0}, Intention::Keep, true, {}};
    OpponentModel learned;
    for (int i = 0; i < 10; ++i) learnKeeper(learned, field(), {-4.3, 0.8}, {1.0, -1.0 + 0.2 * i});
    QCOMPARE(likeliest(learned.keeperShares()), staysLeft);
    const auto known = beliefOf(now, {}, 0.0, options, learned).robots[theirKeeper];
    QVERIFY2(known.pose.position.y < -0.6, qPrintable(QString::number(known.pose.position.y)));
    QCOMPARE(known.shares, learned.keeperShares());
    options.advisor.learns = false;
    const auto usual = beliefOf(now, {}, 0.0, options, learned).robots[theirKeeper];
    QCOMPARE(usual.pose.position.y, 0.0);
    QVERIFY(usual.shares.empty());
    QVERIFY(setupFor(options).players[theirKeeper].variants.empty());
  }

  /// A share for each variant, and rollouts without shares as ever.
  void everyRobotPlaysWithTheNumbersOfItsModel() {
    ProcessOptions options;
    options.behaviour = "striker";
    options.parameters.kickDistance = 0.031;
    options.parameters.aimSide = 0.4;  // a peculiarity, which opponents do not share
    const rollout::Setup setup = setupFor(options);
    for (std::size_t i = 0; i < allPlayers; ++i) {
      const bool isOwn = i < theirKeeper;
      const BehaviourParameters& numbers = setup.players[i].behaviour.parameters;
      QCOMPARE(numbers.kickDistance, 0.031);
      QCOMPARE(numbers.aimSide, isOwn ? 0.4 : 0.0);
      for (const BehaviourParameters& variant : setup.players[i].variants) {
        QCOMPARE(variant.kickDistance, 0.031);
      }
      QCOMPARE(setup.players[i].variants.empty(), isOwn);
    }
  }

  void rolloutsTakeShares() {
    ProcessOptions options;
    options.field = field();
    options.model = loadRobotModel("kid-size").value();
    auto rollouts = rollout::Rollouts::create(setupFor(options)).value();
    const Situation now = seeing({2.0, 0.0}, {Point{4.2, 0.0}});
    OpponentMemory seen;
    seen.update(now.opponents, 0.0);
    rollout::Belief belief = beliefOf(now, seen, 0.0, options);
    QVERIFY(!belief.robots[theirKeeper].absent);
    const auto outcome = [&](std::vector<double> shares, double sigma) {
      belief.robots[theirKeeper].shares = std::move(shares);
      belief.robots[theirKeeper].paceSigma = sigma;
      belief.robots[theirKeeper].pace = 1.0;
      std::array<double, rollout::columnCount> row{};
      const std::uint64_t seed = 5;
      return rollouts.play(belief, {&seed, 1}, {}, row) ? row[6] : std::nan("");
    };
    const double usual = outcome({}, 0.0);
    QVERIFY(!std::isnan(usual));
    QCOMPARE(outcome(std::vector<double>(keeperModels, 0.0), 0.0), usual);
    QVERIFY(std::isnan(outcome({1.0}, 0.0)));
    QVERIFY(std::isnan(outcome(std::vector<double>(keeperModels, -1.0), 0.0)));
    QVERIFY(std::isnan(outcome({}, -1.0)));
  }

  void behavioursHavePeculiarities() {
    SimulatedMatch match = SimulatedMatch::create(duel(), {}).value();
    play(match, 50);
    const auto keeper = match.simulation().snapshot().robots[2].pose.position;
    QVERIFY2(keeper.x > 2.4 && keeper.y < -0.35, qPrintable(QString::number(keeper.y)));
  }

  /// In a match that changes sides after a half: it learns that the keeper stays left, its
  /// successor goes on with that, so does a restored moment, and the other team's robots learn
  /// nothing.
  void aMatchShowsIt() {
    Scenario scenario = duel();
    QVERIFY(scenario.settings.referee.has_value());
    scenario.settings.referee->halfTime = 300.0;
    SimulatedMatch match = SimulatedMatch::create(scenario, {}).value();
    play(match, 290);
    const OpponentModel before = learnedBy(match, striker);
    const auto stays = [](const OpponentModel& model) {
      const auto shares = model.keeperShares();
      return shares[staysLeft] + shares[staysLeft - 1];  // by 0.8 or 0.4 m
    };
    QVERIFY2(stays(before) > 0.6, opponentsToJson(before).c_str());
    QCOMPARE(learnedBy(match, 4), OpponentModel{});

    const Moment moment = momentOf(match);
    play(match, 120);  // the half is over
    QVERIFY(match.robots().find(RobotId{striker})->facesLeft);
    const OpponentModel after = learnedBy(match, striker);
    QVERIFY2(stays(after) > 0.6, qPrintable(QString::number(stays(after))));
    const std::uint64_t hash = match.simulation().hash();
    QVERIFY(match.restore(moment));
    QCOMPARE(learnedBy(match, striker), before);
    play(match, 120);
    QCOMPARE(match.simulation().hash(), hash);
    QCOMPARE(learnedBy(match, striker), after);
  }

  void aProcessThatIsStartedAgainGoesOn() {
    SimulatedMatch match = SimulatedMatch::create(duel(), {}).value();
    play(match, 90);
    const OpponentModel before = learnedBy(match, striker);
    QVERIFY(before.pace != Evidence<paceModels>{} || before.aim != Evidence<aimModels>{});
    QVERIFY(match.robots().restartProcess(RobotId{striker}, "advisor"));
    for (int i = 0; i < 12; ++i) match.tick();
    // It may have looked once more; it has not begun again.
    QCOMPARE(learnedBy(match, striker).pace, before.pace);
    QCOMPARE(learnedBy(match, striker).aim, before.aim);
  }

  void learnsNothingIfTurnedOff() {
    SimulatedMatch match = SimulatedMatch::create(duel(false), {}).value();
    play(match, 90);
    QVERIFY(match.blackboard(RobotId{striker})->read(AdvisorVariables().stamp) > 0);
    QCOMPARE(learnedBy(match, striker), OpponentModel{});
  }

  /// A robot of each shirt has a file of its own; the next match begins with it.
  void aFileCarriesItOver() {
    QTemporaryDir folder;
    Scenario scenario = duel();
    scenario.advisors[TeamColor::Blue].memory = folder.filePath("seen.json").toStdString();
    OpponentModel last;
    {
      SimulatedMatch match = SimulatedMatch::create(scenario, {}).value();
      play(match, 100);
      last = learnedBy(match, striker);
    }
    QVERIFY(last != OpponentModel{});
    const std::string path = folder.filePath("seen-2.json").toStdString();
    QCOMPARE(loadOpponents(path).value(), last);
    SimulatedMatch next = SimulatedMatch::create(scenario, {}).value();
    play(next, 1);
    QCOMPARE(learnedBy(next, striker), last);

    // Matches that must not depend on each other read it only.
    MatchOptions readOnly;
    readOnly.process.keepsMemory = false;
    {
      SimulatedMatch match = SimulatedMatch::create(scenario, readOnly).value();
      play(match, 100);
      QVERIFY(learnedBy(match, striker) != last);
    }
    QCOMPARE(loadOpponents(path).value(), last);
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
    QTest::newRow("too few") << "\"pace\":[0,"
                             << "\"pace\":[";
    QTest::newRow("too many") << "\"pace\":[0,"
                              << "\"pace\":[0,0,";
    QTest::newRow("negative") << "\"pace\":[0,"
                              << "\"pace\":[-1,";
    QTest::newRow("fraction") << "\"pace\":[0,"
                              << "\"pace\":[0.5,";
    QTest::newRow("large") << "\"pace\":[0,"
                           << "\"pace\":[65536,";
    QTest::newRow("text") << "\"pace\":[0,"
                          << "\"pace\":[\"0\",";
  }
  void filesAreChecked() {
    QFETCH(QString, from);
    QFETCH(QString, to);
    QString text = QString::fromStdString(opponentsToJson({}));
    QCOMPARE(opponentsFromJson(text.toStdString(), "test").value(), OpponentModel{});
    QVERIFY(text.contains(from));
    text.replace(text.indexOf(from), from.size(), to);
    const auto read = opponentsFromJson(text.toStdString(), "opponents.json");
    QVERIFY(!read);
    QVERIFY(read.error().text().find("opponents.json") != std::string::npos);

    QTemporaryDir folder;
    ProcessOptions options;
    options.field = field();
    options.model = loadRobotModel("kid-size").value();
    options.advisor.memory = folder.filePath("opponents.json").toStdString();
    QVERIFY(findProcess("advisor")->make(options));  // there is none yet
    std::ofstream(options.advisor.memory) << text.toStdString();
    QVERIFY(!findProcess("advisor")->make(options));
    options.advisor.learns = false;
    QVERIFY(findProcess("advisor")->make(options));
  }
};

PITCHBOARD_TEST(TestOpponents)

}  // namespace tst_opponents

#include "tst_opponents.moc"
