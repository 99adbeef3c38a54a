// SPDX-License-Identifier: GPL-3.0-or-later
// Every rule that can be switched off, in a situation where it matters: what the referee does with
// it and what without it.
#include <functional>
#include <map>

#include <simcore/world/referee_parameters.h>

#include "../support/referee_game.h"

namespace tst_referee_switches {

using namespace pitchboard;
using sim::CallKind;
using Rules = sim::RefereeRules;

namespace {

/// A match of 2021 to 2024: PLAYING from 60 s on, and the ball is everybody's from 70 s on.
struct Situation {
  std::function<void(Rules&)> rules;  ///< beside the one that is tried; may be empty
  std::function<QString(RefereeGame&)> outcome;
  const char* with;
  const char* without;
  double number = 0.0;  ///< the rule's value, where it is no switch
};

template <class Enum>
QString words(Enum value) {
  const std::string_view text = labelOf(value);
  return text.empty() ? "none"
                      : QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}
QString penaltyOf(const RefereeGame& game, std::size_t team, std::size_t player) {
  return words(game.game().teams[team].players[player].penalty);
}
int secondsLeft(const RefereeGame& game, std::size_t player) {
  return game.game().seconds(game.game().teams[0].players[player].ticksLeft);
}
bool penalise(RefereeGame& game, int robot) {
  return game.call(
      {.kind = CallKind::Penalise, .robot = RobotId{robot}, .penalty = PenaltyKind::Pushing});
}

/// Blue 2 walks on the spot against red 2, which is nearer to the ball, or as far from it.
void pushes(RefereeGame& game, double toBall) {
  game.runTo(80);
  const double radius = sim::robotRadius(game.simulation->state(), 0);
  game.commands[1].actionA = 1;
  while (game.now() < 83.0 && game.game().ballFree() &&
         game.game().teams[0].players[1].penalty == PenaltyKind::None) {
    // Where the one does not give way.
    QVERIFY(game.simulation->placeRobot(RobotId{5}, {{0.5, 1.0}, 0.0}));
    QVERIFY(game.simulation->placeRobot(RobotId{2}, {{0.5 - 2 * radius - 0.005, 1.0}, 0.0}));
    QVERIFY(game.simulation->placeBall({0.5 + toBall, 1.0}));
    game.tick();
  }
  game.commands[1].actionA = 0;
}

void rollsOut(RefereeGame& game, int robot, const Point& from, const Velocity& velocity) {
  game.runTo(80);
  const bool up = velocity.y != 0.0;
  const Point ball{from.x + (up ? 0.0 : game.atTheBall()), from.y + (up ? game.atTheBall() : 0.0)};
  QVERIFY(game.simulation->placeRobot(RobotId{robot}, {from, 0.0}));
  game.touch(ball, velocity);
  game.runTo(82);
}

QString firstPhaseAfterATie(RefereeGame& game) {
  for (int i = 0; i < 400 * 60 && !game.game().over; ++i) {
    game.tick();
    if (game.game().phase == GamePhase::ExtraTime) return "extra time";
    if (game.game().phase == GamePhase::ShootOut) return "shoot-out";
  }
  return "over";
}

void shortHalves(Rules& rules) {
  rules.halfTime = rules.extraHalfTime = 20;
  rules.stillTime = rules.nobodyTime = 0;
}

std::map<std::string, Situation> situations() {
  std::map<std::string, Situation> all;
  all["goals"] = {{},
                  [](RefereeGame& g) {
                    g.runTo(80);
                    (void)g.simulation->placeBall({4.1, 0.6}, {8.0, 0.0});
                    g.runTo(81);
                    return QString::number(g.game().teams[0].score);
                  },
                  "1",
                  "0"};
  all["throw_ins"] = {{},
                      [](RefereeGame& g) {
                        rollsOut(g, 2, {-2.5, 2.0}, {0.0, 3.0});
                        return words(g.game().setPlay());
                      },
                      "throw-in",
                      "none"};
  all["goal_kicks"] = {{},
                       [](RefereeGame& g) {
                         rollsOut(g, 2, {4.0, 2.5}, {3.0, 0.0});
                         return words(g.game().setPlay());
                       },
                       "goal kick",
                       "none"};
  all["corner_kicks"] = {{},
                         [](RefereeGame& g) {
                           rollsOut(g, 4, {4.0, 2.5}, {3.0, 0.0});
                           return words(g.game().setPlay());
                         },
                         "corner kick",
                         "none"};
  all["free_kicks"] = {{},
                       [](RefereeGame& g) {
                         pushes(g, 0.4);
                         return words(g.game().setPlay()) + ", " + penaltyOf(g, 0, 1);
                       },
                       "direct free kick, none",
                       "none, pushing"};
  all["drop_balls"] = {{},
                       [](RefereeGame& g) {
                         g.runTo(95);
                         return words(g.game().state);
                       },
                       "READY",
                       "PLAYING"};
  all["kick_off_positions"] = {{},
                               [](RefereeGame& g) {
                                 g.runTo(56);
                                 (void)g.simulation->placeRobot(RobotId{2}, {{1.5, 1.0}, 0.0});
                                 g.runTo(61);
                                 return penaltyOf(g, 0, 1);
                               },
                               "illegal position",
                               "none"};
  all["exclusive_ball"] = {{},
                           [](RefereeGame& g) {
                             g.runTo(61);  // the kick-off is blue's
                             (void)g.simulation->placeRobot(RobotId{5}, {{g.atTheBall(), 0}, 3.14});
                             g.runTo(61.5);
                             return penaltyOf(g, 1, 1);
                           },
                           "illegal position",
                           "none"};
  all["direct_goals"] = {{},
                         [](RefereeGame& g) {
                           g.runTo(61);
                           (void)g.simulation->placeRobot(RobotId{2}, {{-g.atTheBall(), 0}, 0.0});
                           g.tick();  // takes the kick-off
                           (void)g.simulation->placeBall({4.1, 0.6}, {8.0, 0.0});
                           g.runTo(62);
                           return QString::number(g.game().teams[0].score);
                         },
                         "0",
                         "1"};
  all["double_touch"] = {
      {},
      [](RefereeGame& g) {
        sim::GameStart start;
        start.state = PlayState::Playing;
        start.setPlay = sim::GameStart::Taking{
            .kind = SetPlay::ThrowIn, .team = TeamColor::Blue, .step = Restart::Step::Taking};
        (void)g.simulation->placeBall({0.0, 2.9});
        (void)g.simulation->startGame(start);
        for (const Point& ball : {Point{0.0, 2.7}, Point{0.0, 2.0}}) {
          g.runTo(g.now() + 0.5);
          (void)g.simulation->placeBall(ball);
          (void)g.simulation->placeRobot(RobotId{2}, {{ball.x - g.atTheBall(), ball.y}, 0.0});
          g.runTo(g.now() + 0.1);
          (void)g.simulation->placeRobot(RobotId{2}, {{-2.5, 2.0}, 0.0});
        }
        return words(g.game().setPlay());
      },
      "indirect free kick",
      "none"};
  all["change_sides"] = {shortHalves,
                         [](RefereeGame& g) {
                           g.runTo(82);
                           return QString("half %1, %2")
                               .arg(g.game().half)
                               .arg(g.game().swapped ? "changed" : "as before");
                         },
                         "half 2, changed", "half 2, as before"};
  all["clock_stops_in_set_plays"] = {
      {},
      [](RefereeGame& g) {
        g.runTo(80);
        const int before = g.game().clock;
        (void)g.call({.kind = CallKind::SetPlay, .team = 0, .setPlay = SetPlay::ThrowIn});
        g.runTo(82);
        return QString::number(before - g.game().clock);
      },
      "0",
      "120"};
  all["escalates"] = {[](Rules& rules) { rules.removalMore = 10; },
                      [](RefereeGame& g) {
                        g.runTo(80);
                        (void)(penalise(g, 2) && penalise(g, 3));
                        return QString::number(secondsLeft(g, 2));
                      },
                      "40", "30"};
  all["counts_from_call"] = {{},
                             [](RefereeGame& g) {
                               g.runTo(80);
                               (void)penalise(g, 2);
                               g.runTo(82);
                               return QString::number(secondsLeft(g, 1));
                             },
                             "28",
                             "30"};
  all["counts_always"] = {
      {},
      [](RefereeGame& g) {
        g.runTo(80);
        (void)g.call({.kind = CallKind::SetPlay, .team = 0, .setPlay = SetPlay::ThrowIn});
        (void)penalise(g, 2);
        g.runTo(84);
        return QString::number(secondsLeft(g, 1));
      },
      "26",
      "30"};
  all["pardons_at_play"] = {{},
                            [](RefereeGame& g) {
                              g.runTo(50);
                              (void)penalise(g, 2);
                              g.runTo(61);
                              return penaltyOf(g, 0, 1);
                            },
                            "none",
                            "pushing"};
  all["half_ends_with_ball"] = {shortHalves,
                                [](RefereeGame& g) {
                                  g.runTo(80.3);
                                  return words(g.game().state);
                                },
                                "PLAYING", "FINISHED"};
  all["knockout"] = {shortHalves, firstPhaseAfterATie, "extra time", "over"};
  all["extra_time"] = {[](Rules& rules) {
                         shortHalves(rules);
                         rules.knockout = true;
                       },
                       firstPhaseAfterATie, "extra time", "shoot-out"};
  all["automatic"] = {{},
                      [](RefereeGame& g) {
                        g.runTo(15);
                        return words(g.game().state);
                      },
                      "READY",
                      "INITIAL"};
  // Numbers that 0 switches off.
  all["fallen_time"] = {{},
                        [](RefereeGame& g) {
                          g.runTo(80);
                          while (g.now() < 82) {
                            auto& world = g.simulation->editState();
                            std::get<sim::RigidBodyState>(world.physics).robots[1].posture =
                                sim::Posture::OnFront;
                            g.tick();
                          }
                          return penaltyOf(g, 0, 1);
                        },
                        "pickup or incapable",
                        "none",
                        1.0};
  all["leaving_time"] = {{},
                         [](RefereeGame& g) {
                           g.runTo(80);
                           (void)g.simulation->placeRobot(RobotId{2}, {{-2.5, 3.4}, 0.0});
                           g.runTo(82);
                           return penaltyOf(g, 0, 1);
                         },
                         "leaving the field",
                         "none",
                         1.0};
  all["still_time"] = {[](Rules& rules) { rules.nobodyTime = 0; },
                       [](RefereeGame& g) {
                         g.runTo(75);
                         return words(g.game().state);
                       },
                       "READY", "PLAYING", 10.0};
  all["nobody_time"] = {[](Rules& rules) { rules.stillTime = 0; },
                        [](RefereeGame& g) {
                          g.runTo(75);
                          return words(g.game().state);
                        },
                        "READY", "PLAYING", 10.0};
  all["local_stuck_time"] = {{},
                             [](RefereeGame& g) {
                               g.runTo(71);
                               (void)g.simulation->placeRobot(RobotId{2}, {{-0.4, 0.0}, 0.0});
                               g.runTo(80);
                               return penaltyOf(g, 0, 1);
                             },
                             "local game stuck",
                             "none",
                             5.0};
  all["pushing_time"] = {[](Rules& rules) { rules.freeKicks = false; },
                         [](RefereeGame& g) {
                           pushes(g, 0.4);
                           return penaltyOf(g, 0, 1);
                         },
                         "pushing", "none", 1.0};
  all["motion_in_set"] = {{},
                          [](RefereeGame& g) {
                            g.runTo(57);
                            (void)g.simulation->placeRobot(RobotId{2}, {{-2.5, 1.4}, 0.0});
                            g.runTo(58);
                            return penaltyOf(g, 0, 1);
                          },
                          "motion in SET",
                          "none",
                          0.2};
  all["goal_area_most"] = {{},
                           [](RefereeGame& g) {
                             g.runTo(80);
                             (void)g.simulation->placeRobot(RobotId{2}, {{-4.2, 0.9}, 0.0});
                             g.runTo(82);
                             return penaltyOf(g, 0, 1);
                           },
                           "illegal position",
                           "none",
                           1.0};
  all["ready_still_time"] = {{},
                             [](RefereeGame& g) {
                               g.runTo(15);
                               return words(g.game().state);
                             },
                             "SET",
                             "READY",
                             2.0};
  all["mercy"] = {{},
                  [](RefereeGame& g) {
                    g.runTo(80);
                    (void)g.call({.kind = CallKind::Goal, .team = 0, .value = 1});
                    return words(g.game().state);
                  },
                  "FINISHED",
                  "READY",
                  1.0};
  all["penalty_kick_ready"] = {
      {},
      [](RefereeGame& g) {
        g.runTo(80);
        (void)g.call({.kind = CallKind::SetPlay, .team = 0, .setPlay = SetPlay::PenaltyKick});
        return words(g.game().state);
      },
      "READY",
      "PLAYING",
      30.0};
  return all;
}

}  // namespace

class TestRefereeSwitches : public QObject {
  Q_OBJECT
 private slots:
  void everyRuleSwitchedOff_data() {
    QTest::addColumn<QString>("key");
    for (const auto& one : sim::refereeSwitches) QTest::newRow(one.key) << QString(one.key);
    const auto add = [](const auto& one) {
      if (QString(one.meaning).contains("0 = ")) QTest::newRow(one.key) << QString(one.key);
    };
    for (const auto& one : sim::refereeCounts) add(one);
    for (const auto& one : sim::refereeParameters) add(one);
  }
  void everyRuleSwitchedOff() {
    QFETCH(QString, key);
    static const auto all = situations();
    const auto found = all.find(key.toStdString());
    QVERIFY2(found != all.end(), "no situation for this rule");
    const Situation& situation = found->second;
    for (const bool on : {true, false}) {
      Rules rules = RefereeGame::named("humanoid-2021", true);
      if (situation.rules) situation.rules(rules);
      for (const auto& one : sim::refereeSwitches) {
        if (key == one.key) rules.*one.member = on;
      }
      for (const auto& one : sim::refereeParameters) {
        if (key == one.key) rules.*one.member = on ? situation.number : 0.0;
      }
      for (const auto& one : sim::refereeCounts) {
        if (key == one.key) rules.*one.member = on ? static_cast<int>(situation.number) : 0;
      }
      RefereeGame game(rules);
      QCOMPARE(situation.outcome(game), QString(on ? situation.with : situation.without));
    }
  }

  // In a shoot-out a goalkeeper is missing for longer than others: for the next shot, too.
  void aGoalkeeperThatIsRemovedMissesTheNextShot() {
    Rules rules = RefereeGame::named("humanoid-2021", false);
    rules.placedAfter = 0;
    RefereeGame game(rules);
    for (const PlayState state :
         {PlayState::Ready, PlayState::Set, PlayState::Playing, PlayState::Finished}) {
      QVERIFY(game.state(state));
    }
    QVERIFY(game.call({.kind = CallKind::ShootOut}));
    QVERIFY(game.state(PlayState::Set));
    QVERIFY(game.state(PlayState::Playing));
    const auto keepers = static_cast<std::size_t>(1 - game.game().shooter);
    const RobotId keeper{keepers == 0 ? 1 : 4};
    const auto outside = [&] {
      game.tick();
      return std::abs(game.simulation->robotPose(keeper)->position.y) > 3.0;
    };
    QVERIFY(!outside());
    QVERIFY(
        game.call({.kind = CallKind::Penalise, .robot = keeper, .penalty = PenaltyKind::Pushing}));
    QCOMPARE(game.game().seconds(game.game().teams[keepers].players[0].ticksLeft), 120);
    QVERIFY(outside());
    for (int shot = 0; shot < 2; ++shot) {  // the other side's, then against it again
      QVERIFY(game.state(PlayState::Finished));
      QVERIFY(game.state(PlayState::Set));
      QVERIFY(game.state(PlayState::Playing));
    }
    QCOMPARE(static_cast<std::size_t>(1 - game.game().shooter), keepers);
    QVERIFY(outside());
  }
};

PITCHBOARD_TEST(TestRefereeSwitches)

}  // namespace tst_referee_switches

#include "tst_referee_switches.moc"
