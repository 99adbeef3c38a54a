// SPDX-License-Identifier: GPL-3.0-or-later
// Edits and transport of a real match with inline processes.
#include <QAction>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QUndoStack>
#include <QtTest>
#include <atomic>
#include <cmath>
#include <semaphore>

#include <robotlink/models/robot_models.h>
#include <ui/base/undo_history.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/match_memory.h>

#include "../support/real_time_robot.h"
#include "../support/segment_keys.h"

namespace tst_match_controller {

using namespace pitchboard;
using namespace pitchboard::ui;

class TestMatchController : public QObject {
  Q_OBJECT

  static link::Scenario match() { return link::loadScenario("match-3v3").value(); }
  static link::MatchOptions inside() {
    link::MatchOptions options;
    options.cognition = link::Cognition::Inline;
    return options;
  }
  static double xOf(const MatchController& c, int id) {
    if (!c.frame()) return NAN;
    const link::RobotFrame* robot = c.frame()->robot(RobotId{id});
    return robot != nullptr ? robot->pose.position.x : NAN;
  }
  static std::uint64_t tickOf(const MatchController& c) {
    return c.frame() ? c.frame()->snapshot.tick : 0;
  }
  static std::size_t count(const MatchController& c) {
    return c.frame() ? c.frame()->robots.size() : 0;
  }

 private slots:
  void playsPausesAndSteps() {
    MatchController c(inside());
    c.open(match(), true);
    QTRY_VERIFY(c.frame());
    QCOMPARE(c.frame()->snapshot.tick, std::uint64_t(0));
    c.stepOnce();
    QTRY_COMPARE(c.frame()->snapshot.tick, std::uint64_t(1));
    c.setPaused(false);
    QTRY_VERIFY(c.frame()->snapshot.tick > 5);
    c.restart();
    QTRY_VERIFY(c.frame());
    QVERIFY(!c.isPaused());
  }

  void undoWaitsForAChangeThatIsUnderway() {
    MatchController c(inside());
    c.open(match(), true);
    QTRY_VERIFY(c.frame());
    UndoHistory history(nullptr);
    connect(c.edits(), &MatchEdits::sent, &history, &UndoHistory::expect);
    connect(c.edits(), &MatchEdits::answered, &history, &UndoHistory::answer);
    QUndoStack* stack = c.edits()->undoStack();
    history.add(stack, [] { return true; });
    const double second = xOf(c, 2);
    c.edits()->perform({"Move 1", "no", {placementStep(RobotId{1}, {{1.0, 0.0}, 0.0})}});
    QTRY_COMPARE(stack->count(), 1);

    std::binary_semaphore mayGoOn(0);
    const auto slow = [&mayGoOn](Result<void> answer) {
      const auto wait = [&mayGoOn, answer](link::SimulatedMatch&) {
        mayGoOn.acquire();
        return answer;
      };
      return EditStep{wait, [](link::SimulatedMatch&) { return Result<void>(); }};
    };
    const EditStep move = placementStep(RobotId{2}, {{2.0, 0.0}, 0.0});
    c.edits()->perform({"Move 2", "no", {slow({}), move}});
    history.undoAction()->trigger();
    QCOMPARE(stack->index(), 1);
    mayGoOn.release();
    QTRY_COMPARE(stack->count(), 2);
    QCOMPARE(stack->index(), 1);
    QTRY_COMPARE(xOf(c, 2), second);
    QTRY_COMPARE(xOf(c, 1), 1.0);

    // What is refused leaves nothing to undo, and what was done before stays.
    const QSignalSpy refused(&c, &MatchController::errorOccurred);
    const Error no{ErrorCode::Conflict, "no room", ""};
    c.edits()->perform({"Move 2", "no", {slow(tl::unexpected(no)), move}});
    history.undoAction()->trigger();
    mayGoOn.release();
    QTRY_COMPARE(refused.size(), 1);
    QCOMPARE(stack->index(), 1);
    QVERIFY(history.undoAction()->isEnabled());
    history.undoAction()->trigger();
    QCOMPARE(stack->index(), 0);
  }

  /// Two play: what the referee knows nothing of would stand on the field as an obstacle.
  void aThirdTeamIsRefusedWhereThereIsAReferee() {
    MatchController c(inside());
    link::Scenario refereed = match();
    refereed.settings.referee.emplace();
    c.open(refereed, true);
    QTRY_VERIFY(c.frame());
    const std::size_t robots = count(c);
    QSignalSpy refused(&c, &MatchController::errorOccurred);
    c.edits()->addRobot(TeamColor::Black, {{1.0, 1.0}, 0.0});
    QTRY_COMPARE(refused.size(), 1);
    const QString text = refused.takeFirst().at(0).toString();
    QVERIFY2(text.contains(QStringLiteral("between blue and red")), qPrintable(text));
    QTRY_COMPARE(c.edits()->undoStack()->count(), 0);
    c.edits()->setTeam({c.frame()->robots[0].identity.id}, TeamColor::Black);
    QTRY_COMPARE(refused.size(), 1);
    QTRY_COMPARE(c.edits()->undoStack()->count(), 0);
    c.settle();
    QCOMPARE(count(c), robots);
    QVERIFY(c.frame()->robots[0].identity.team != TeamColor::Black);
    // Without a referee anybody may stand there, of the kind that the others are.
    c.open(match(), true);
    QTRY_VERIFY(c.frame());
    c.edits()->addRobot(TeamColor::Black, {{1.0, 1.0}, 0.0});
    QTRY_COMPARE(count(c), robots + 1);
    const auto& added = c.frame()->robots.back().identity;
    QCOMPARE(c.edits()->robot(added.id)->model, match().robots.front().model);
  }

  void movesAreUndoneAndRedone() {
    MatchController c(inside());
    c.open(match(), true);
    QTRY_VERIFY(c.frame());
    const Pose from = c.frame()->robots[0].pose;
    const RobotId id = c.frame()->robots[0].identity.id;
    c.edits()->moveRobots({{id, from, {{1.5, 1.5}, 0.0}}});
    QTRY_COMPARE(xOf(c, id.value), 1.5);
    c.edits()->undoStack()->undo();
    QTRY_VERIFY(std::abs(xOf(c, id.value) - from.position.x) < 1e-9);
    c.edits()->undoStack()->redo();
    QTRY_COMPARE(xOf(c, id.value), 1.5);
  }

  void nudgesInQuickSuccessionAreOneCommandAndADragIsItsOwn() {
    MatchController c(inside());
    c.open(match(), true);
    QTRY_VERIFY(c.frame());
    const Pose from = c.frame()->robots[0].pose;
    const RobotId id = c.frame()->robots[0].identity.id;
    const Pose middle{{1.0, 1.5}, 0.0}, end{{1.5, 1.5}, 0.0};
    c.edits()->nudgeRobots({{id, from, middle}});
    c.edits()->nudgeRobots({{id, middle, end}});
    QTRY_COMPARE(c.edits()->undoStack()->count(), 1);
    c.edits()->moveRobots({{id, end, from}});
    c.edits()->nudgeRobots({{id, from, middle}});
    QTRY_COMPARE(c.edits()->undoStack()->count(), 3);
    c.edits()->undoStack()->undo();
    c.edits()->undoStack()->undo();
    QTRY_COMPARE(xOf(c, id.value), end.position.x);
    c.edits()->undoStack()->undo();
    QTRY_VERIFY(std::abs(xOf(c, id.value) - from.position.x) < 1e-9);
  }

  void addAndRemove() {
    MatchController c(inside());
    c.open(match(), true);
    QTRY_COMPARE(count(c), std::size_t(6));
    c.edits()->addRobot(TeamColor::Blue, {{0, 2.5}, 0});
    QTRY_COMPARE(count(c), std::size_t(7));
    QCOMPARE(c.frame()->robots.back().identity.number, 4);
    c.edits()->removeRobots({RobotId{1}, RobotId{2}});
    QTRY_COMPARE(count(c), std::size_t(5));
    c.edits()->undoStack()->undo();
    QTRY_COMPARE(count(c), std::size_t(7));
    c.edits()->undoStack()->undo();
    QTRY_COMPARE(count(c), std::size_t(6));
  }

  void behavioursNumbersAndModelsAreUndone() {
    MatchController c(inside());
    c.open(match(), true);
    QTRY_VERIFY(c.frame());
    QUndoStack* stack = c.edits()->undoStack();
    const std::string before = c.edits()->robot(RobotId{1})->behaviour;
    c.edits()->setBehaviour({RobotId{1}, RobotId{2}}, QStringLiteral("idle"));
    QTRY_COMPARE(stack->count(), 1);
    QTRY_COMPARE(c.frame()->robots[0].behaviour, std::string("idle"));
    stack->undo();
    QTRY_COMPARE(c.frame()->robots[0].behaviour, before);
    c.edits()->setNumber(RobotId{1}, 9);
    QTRY_COMPARE(c.frame()->robots[0].identity.number, 9);
    stack->undo();
    QTRY_COMPARE(c.frame()->robots[0].identity.number, 1);
    c.edits()->setNumber(RobotId{1}, 2);  // is worn
    QTRY_COMPARE(stack->count(), 1);
    QVERIFY(!stack->canUndo());
    const sim::RobotModel adult = link::loadRobotModel("adult-size").value();
    c.edits()->setModel({RobotId{1}}, adult);
    QTRY_COMPARE(c.frame()->robots[0].radius, adult.radius);
    QCOMPARE(c.currentMoment().robots[0].model.name, std::string("adult-size"));
    stack->undo();
    QTRY_COMPARE(c.frame()->robots[0].radius, 0.0);
  }

  void physicsAndAnotherScenarioAreUndone() {
    MatchController c(inside());
    c.open(match(), true);
    QTRY_VERIFY(c.frame());
    QUndoStack* stack = c.edits()->undoStack();
    const RobotId id = c.frame()->robots[0].identity.id;
    c.edits()->moveRobots({{id, c.frame()->robots[0].pose, {{1.5, 1.5}, 0.0}}});
    QTRY_COMPARE(xOf(c, id.value), 1.5);
    c.edits()->setPhysics(QStringLiteral("published"));
    QTRY_VERIFY(c.frame() && c.frame()->settings->physics == "published");
    c.edits()->replaceMatch(link::loadScenario("one-robot").value(), QStringLiteral("Open it"),
                            QStringLiteral("Opened"), true);
    QTRY_VERIFY(c.frame() && c.frame()->robots.size() == 1);
    QTRY_COMPARE(stack->count(), 3);
    stack->undo();
    QTRY_VERIFY(c.frame() && c.frame()->robots.size() == 6);
    QCOMPARE(c.frame()->settings->physics, std::string("published"));
    stack->undo();
    QTRY_VERIFY(c.frame() && c.frame()->settings->physics == "rigid-body");
    QTRY_VERIFY(std::abs(xOf(c, id.value) - 1.5) < 1e-6);
    stack->undo();
    QTRY_VERIFY(std::abs(xOf(c, id.value) - 1.5) > 0.1);
  }

  void anotherPhysicsKeepsThePast() {
    MatchController c(inside());
    link::Scenario scenario = match();
    scenario.score = {1, 0};
    c.open(scenario, true);
    c.runTo(600);
    QTRY_COMPARE(tickOf(c), std::uint64_t(600));
    const link::MatchFrame before = *c.frame();
    QVERIFY(before.robots[0].statistics.distanceWalked > 0.05);
    QSignalSpy restarts(&c, &MatchController::restarted);
    c.edits()->setPhysics(QStringLiteral("published"));
    QTRY_COMPARE(c.frame()->settings->physics, std::string("published"));
    QCOMPARE(c.frame()->snapshot.tick, before.snapshot.tick);
    QVERIFY(c.frame()->snapshot.score == before.snapshot.score);
    for (std::size_t i = 0; i < before.robots.size(); ++i) {
      const link::RobotFrame& robot = c.frame()->robots[i];
      QVERIFY(distance(robot.pose.position, before.robots[i].pose.position) < 1e-9);
      QVERIFY(robot.statistics == before.robots[i].statistics);
    }
    c.runTo(1200);
    QTRY_COMPARE(tickOf(c), std::uint64_t(1200));
    QCOMPARE(restarts.count(), 0);
    // Memory, and what is true in it, before and after.
    QVERIFY(c.series()->range()->begin < 0.05 && c.series()->range()->end > 19.9);
    QCOMPARE(c.frameAt(1.0)->settings->physics, std::string("rigid-body"));
    QCOMPARE(c.frameAt(15.0)->settings->physics, std::string("published"));
    QCOMPARE(c.frameAt(1.0)->snapshot.tick, std::uint64_t(60));
    const auto archive = c.memory()->archive();
    QCOMPARE(archive->restore(60)->settings.physics, std::string("rigid-body"));
    QCOMPARE(sim::stateHash(archive->restore(1200).value()), c.stateHash());
    // As any edit it is undone, and time goes on.
    c.edits()->undoStack()->undo();
    QTRY_COMPARE(c.frame()->settings->physics, std::string("rigid-body"));
    QCOMPARE(tickOf(c), std::uint64_t(1200));
    c.edits()->undoStack()->redo();
    QTRY_COMPARE(c.frame()->settings->physics, std::string("published"));
    const std::uint64_t hashThen = sim::stateHash(archive->restore(60).value());
    c.memory()->continueFrom(1.0);
    QTRY_COMPARE(c.frame()->settings->physics, std::string("rigid-body"));
    QCOMPARE(c.stateHash(), hashThen);
    QCOMPARE(c.edits()->physics(), std::string("rigid-body"));
  }

  void restartPlaysFromTheBeginning() {
    MatchController c(inside());
    const link::Scenario scenario = match();
    c.open(scenario, true);
    c.runTo(600);
    QTRY_COMPARE(tickOf(c), std::uint64_t(600));
    c.edits()->setPhysics(QStringLiteral("published"));
    c.restart();
    QTRY_VERIFY(c.frame());
    QCOMPARE(tickOf(c), std::uint64_t(0));
    QCOMPARE(c.frame()->settings->physics, std::string("published"));  // as chosen
    QVERIFY(std::abs(xOf(c, 1) - scenario.robots[0].pose.position.x) < 1e-9);
    // Also when the match goes on from a moment that an undo has brought back.
    c.runTo(600);
    QTRY_COMPARE(tickOf(c), std::uint64_t(600));
    const double x = xOf(c, 1);
    QVERIFY(std::abs(x - scenario.robots[0].pose.position.x) > 0.01);
    c.edits()->replaceMatch(link::loadScenario("one-robot").value(), QStringLiteral("Open it"),
                            QStringLiteral("Opened"), true);
    QTRY_COMPARE(count(c), std::size_t(1));
    c.edits()->undoStack()->undo();
    QTRY_VERIFY(std::abs(xOf(c, 1) - x) < 1e-6);
    c.restart();
    QTRY_VERIFY(std::abs(xOf(c, 1) - scenario.robots[0].pose.position.x) < 1e-9);
    QCOMPARE(c.frame()->robots.size(), std::size_t(6));
  }

  void restartKeepsWhatWasSetUp() {
    MatchController c(inside());
    const link::Scenario scenario = match();
    c.open(scenario, true);
    QTRY_VERIFY(c.frame());
    sim::NoiseParameters noise = c.frame()->settings->noise;
    noise.forward *= 2.0;
    QSignalSpy done(c.edits(), &MatchEdits::replaced);
    c.restart();
    QTRY_VERIFY(c.frame());
    QCOMPARE(done.takeFirst().at(0).toString(), QStringLiteral("Match restarted"));
    c.edits()->setNoise(noise);
    c.edits()->setBehaviour({RobotId{1}}, QStringLiteral("idle"));
    c.edits()->setNumber(RobotId{1}, 9);
    c.edits()->removeRobots({RobotId{2}});
    c.edits()->addRobot(TeamColor::Blue, {{1.0, 2.0}, 0.0}, 7);
    c.runTo(60);
    QTRY_COMPARE(tickOf(c), std::uint64_t(60));
    QTRY_VERIFY(c.frame()->settings->noise == noise);
    c.restart();
    QTRY_VERIFY(c.frame() && tickOf(c) == 0);
    QVERIFY(done.takeFirst().at(0).toString().startsWith("Match restarted with what you set up"));
    QVERIFY(c.frame()->settings->noise == noise);
    const link::RobotFrame* first = c.frame()->robot(RobotId{1});
    QVERIFY(first);
    QCOMPARE(first->behaviour, std::string("idle"));
    QCOMPARE(first->identity.number, 9);
    // It begins where the scenario puts it.
    QVERIFY(std::abs(first->pose.position.x - scenario.robots[0].pose.position.x) < 1e-9);
    const auto& robots = c.frame()->robots;
    QCOMPARE(robots.size(), scenario.robots.size());
    QVERIFY(std::ranges::any_of(robots, [](const auto& one) {
      return one.identity.number == 7 && std::abs(one.pose.position.y - 2.0) < 1e-9;
    }));
    // The scenario itself has none of it.
    c.open(scenario, true);
    QTRY_VERIFY(c.frame());
    QVERIFY(c.frame()->settings->noise != noise);
    QCOMPARE(c.frame()->robot(RobotId{1})->identity.number, 1);
  }

  void thePastShowsTheBehavioursOfThen() {
    MatchController c(inside());
    c.open(match(), true);
    c.runTo(60);
    QTRY_COMPARE(tickOf(c), std::uint64_t(60));
    const RobotUid uid = c.frame()->robots[0].uid;
    const std::string before = c.frame()->robots[0].behaviour;
    c.edits()->setBehaviour({RobotId{1}}, QStringLiteral("idle"));
    QTRY_COMPARE(c.frame()->robot(uid)->behaviour, std::string("idle"));
    c.runTo(120);
    QTRY_COMPARE(tickOf(c), std::uint64_t(120));
    QCOMPARE(c.frameAt(0.5)->robot(uid)->behaviour, before);
    QCOMPARE(c.frameAt(1.5)->robot(uid)->behaviour, std::string("idle"));
  }

  void aTeamThatCannotPlayIsNotOffered() {
    MatchController c(inside());
    link::Scenario refereed = match();
    refereed.settings.referee.emplace();
    c.open(refereed, true);
    QTRY_VERIFY(c.frame());
    QVERIFY(c.edits()->whyNoTeam(TeamColor::Blue).isEmpty());
    QVERIFY(!c.edits()->whyNoTeam(TeamColor::Black).isEmpty());
    sim::RobotIdentity wanted = c.edits()->robot(RobotId{1})->identity;
    QVERIFY(!c.edits()->isTaken(wanted));
    wanted.number = 2;
    QVERIFY(c.edits()->isTaken(wanted));
    c.open(match(), true);
    QTRY_VERIFY(c.frame() && !c.frame()->game);
    QVERIFY(c.edits()->whyNoTeam(TeamColor::Black).isEmpty());
  }

  void whileLockedNothingPasses() {
    MatchController c(inside());
    QSignalSpy errors(&c, &MatchController::errorOccurred);
    c.open(match(), true);
    QTRY_VERIFY(c.frame());
    const std::uint64_t hash = c.stateHash();
    const int known = c.edits()->undoStack()->count();
    const auto ordered = std::make_shared<std::atomic<int>>(0);
    const auto change = [&] {
      c.edits()->order([ordered](link::SimulatedMatch&) {
        ++*ordered;
        return link::Changed::No;
      });
      c.edits()->order(MatchOrder{QString(), [ordered](link::SimulatedMatch&) -> Result<void> {
                                    ++*ordered;
                                    return {};
                                  }});
      c.edits()->moveBall({1, 1});
      c.edits()->setPhysics(QStringLiteral("published"));
      c.edits()->setNoise({});
      c.edits()->setRuntime(RobotId{1}, {});
      const auto place = [](link::SimulatedMatch& match) {
        return match.simulation().placeBall({1, 1});
      };
      c.edits()->perform(
          {QStringLiteral("Two"), QStringLiteral("Failed"), {{place, place}, {place, place}}});
      c.edits()->resetScore();
      c.edits()->setClockRunning(false);
      c.edits()->setTeam({RobotId{1}}, TeamColor::Black);
    };
    c.edits()->setLocked(true);
    change();
    c.restart();
    QVERIFY(c.isOpen());
    QCOMPARE(c.stateHash(), hash);
    QCOMPARE(ordered->load(), 0);
    QCOMPARE(c.edits()->undoStack()->count(), known);
    QCOMPARE(errors.count(), 1);
    QCOMPARE(errors[0][0].toString(), MatchEdits::lockedText());
    c.edits()->setLocked(false);
    change();
    QVERIFY(c.stateHash() != hash);
    QCOMPARE(ordered->load(), 2);
    QTRY_COMPARE(c.edits()->undoStack()->count(), known + 7);
  }

  // All steps or none; a refused order is no step of undo.
  void stepsAreCarriedOutTogether() {
    MatchController c(inside());
    QSignalSpy errors(&c, &MatchController::errorOccurred);
    c.open(match(), true);
    QTRY_VERIFY(c.frame());
    QUndoStack* stack = c.edits()->undoStack();
    const std::uint64_t hash = c.stateHash();
    const auto score = [](int goals) {
      return [goals](link::SimulatedMatch& match) -> Result<void> {
        match.simulation().setScore({goals, 0});
        return {};
      };
    };
    const auto refuse = [](link::SimulatedMatch&) -> Result<void> {
      return failure(ErrorCode::Conflict, "not now");
    };
    c.edits()->perform({QStringLiteral("Two"),
                        QStringLiteral("Failed"),
                        {{score(1), score(0)}, {refuse, score(7)}}});
    QTRY_COMPARE(errors.count(), 1);
    QCOMPARE(errors[0][0].toString(), QStringLiteral("Failed: not now"));
    QCOMPARE(c.stateHash(), hash);
    QCOMPARE(stack->count(), 0);
    c.edits()->perform({QStringLiteral("Two"),
                        QStringLiteral("Failed"),
                        {{score(1), score(0)}, {score(2), score(1)}}});
    QTRY_COMPARE(stack->count(), 1);
    QTRY_COMPARE(c.frame()->snapshot.score.left, 2);
    stack->undo();
    QTRY_COMPARE(c.frame()->snapshot.score.left, 0);
    stack->redo();
    QTRY_COMPARE(c.frame()->snapshot.score.left, 2);
  }

  void aNumberThatIsTakenIsRefused() {
    MatchController c(inside());
    QSignalSpy errors(&c, &MatchController::errorOccurred);
    c.open(match(), true);
    QTRY_VERIFY(c.isOpen());
    c.edits()->addRobot(TeamColor::Blue, {{0, 2.5}, 0}, 1);
    QCOMPARE(errors.count(), 1);
    QVERIFY(!c.edits()->undoStack()->canUndo());
  }

  // Also when it was carried out first, when other steps follow it, and when it is done again.
  void whatTheMatchRefusesIsNoStep() {
    MatchController c(inside());
    QSignalSpy errors(&c, &MatchController::errorOccurred);
    c.open(match(), true);
    QTRY_VERIFY(c.frame());
    const QUndoStack* stack = c.edits()->undoStack();
    link::RuntimeChoice own;
    own.decision = "/bin/true";  // robots inside the studio have no other programs
    const link::RuntimeChoice before = c.edits()->robot(RobotId{1})->runtime;
    c.edits()->setRuntime(RobotId{1}, own);
    QTRY_COMPARE(errors.count(), 1);
    QCOMPARE(stack->count(), 0);
    QVERIFY(c.edits()->robot(RobotId{1})->runtime == before);

    const Pose from = c.frame()->robots[0].pose;
    c.edits()->removeRobots({RobotId{2}});
    c.edits()->setRuntime(RobotId{1}, own);
    c.edits()->moveRobots({{RobotId{1}, from, {{1.5, 1.5}, 0.0}}});
    QTRY_COMPARE(errors.count(), 2);
    QTRY_COMPARE(xOf(c, 1), 1.5);
    QTRY_COMPARE(count(c), std::size_t(5));
    c.edits()->undoStack()->undo();
    QTRY_COMPARE(xOf(c, 1), from.position.x);
    // The refused one between them is not a step.
    QTRY_COMPARE(stack->undoText(), QStringLiteral("Remove B2"));
    c.edits()->undoStack()->undo();
    QTRY_COMPARE(count(c), std::size_t(6));
    QVERIFY(!stack->canUndo());

    // Done again when the robot is gone.
    c.edits()->setNumber(RobotId{1}, 7);
    QTRY_COMPARE(c.frame()->robot(RobotId{1})->identity.number, 7);
    c.edits()->undoStack()->undo();
    QTRY_COMPARE(c.frame()->robot(RobotId{1})->identity.number, 1);
    c.post([](link::SimulatedMatch& match) {
      return match.robots().remove(RobotId{1}) ? link::Changed::Yes : link::Changed::No;
    });
    QTRY_COMPARE(count(c), std::size_t(5));
    c.edits()->undoStack()->redo();
    QTRY_COMPARE(errors.count(), 3);
    QVERIFY(!stack->canUndo() && !stack->canRedo());
  }

  // A refusal says why, also in the middle of changes that become one step.
  void movingARobotThatLeftIsRefused() {
    MatchController c(inside());
    QSignalSpy errors(&c, &MatchController::errorOccurred);
    c.open(match(), true);
    QTRY_VERIFY(c.frame());
    const auto moved = [&c](double x) {
      return std::vector<RobotPlacement>{{RobotId{1}, {}, {{x, 1.5}, 0.0}},
                                         {RobotId{2}, {}, {{x, -1.5}, 0.0}}};
    };
    c.edits()->nudgeRobots(moved(1.0));
    QTRY_COMPARE(xOf(c, 1), 1.0);
    c.post([](link::SimulatedMatch& match) {
      return match.robots().remove(RobotId{2}) ? link::Changed::Yes : link::Changed::No;
    });
    c.edits()->nudgeRobots(moved(1.1));
    QTRY_COMPARE(errors.count(), 1);
    const QString why = errors[0][0].toString();
    QVERIFY2(why.startsWith(QStringLiteral("Could not move 2 robots: ")), qPrintable(why));
    c.settle();
    QCOMPARE(xOf(c, 1), 1.0);  // together or not at all
    QTRY_COMPARE(c.edits()->undoStack()->count(), 1);
  }

  // Two changes within a second are one step, which can be undone as often as it is done again.
  void aMergedStepIsUndoneAgain() {
    MatchController c(inside());
    c.open(match(), true);
    QTRY_VERIFY(c.frame());
    const auto forward = [&c] { return c.frame()->settings->noise.forward; };
    const double before = forward();
    sim::NoiseParameters noise = c.frame()->settings->noise;
    for (const double value : {0.31, 0.32}) {
      noise.forward = value;
      c.edits()->setNoise(noise);
    }
    QTRY_COMPARE(forward(), 0.32);
    QTRY_COMPARE(c.edits()->undoStack()->count(), 1);
    for (int i = 0; i < 3; ++i) {
      c.edits()->undoStack()->undo();
      QTRY_COMPARE(forward(), before);
      c.edits()->undoStack()->redo();
      QTRY_COMPARE(forward(), 0.32);
    }
  }

  void invalidNoiseIsRefusedWithAReason() {
    MatchController c(inside());
    QSignalSpy errors(&c, &MatchController::errorOccurred);
    c.open(match(), true);
    sim::NoiseParameters noise;
    noise.forward = NAN;
    c.edits()->setNoise(noise);
    QTRY_COMPARE(errors.count(), 1);
    noise.forward = 0.25;
    c.edits()->setNoise(noise);
    QTRY_COMPARE(c.frame() ? c.frame()->settings->noise.forward : 0.0, 0.25);
  }

  void aScenarioThatCannotBePlayedLeavesNoFrame() {
    MatchController c(inside());
    link::Scenario bad = match();
    bad.settings.physics = "no-such-model";
    c.open(bad);
    QTRY_VERIFY(!c.whyNotOpened().isEmpty());
    QVERIFY(!c.isOpen());
    QVERIFY(!c.frame());
  }

  void withoutSeparateProcessesTheMatchPlaysInside() {
    link::MatchOptions options;
    options.cognition = link::Cognition::Separate;
    options.robotProgram = "/nonexistent/pitchboard-robot";
    options.keyBase = testKeyBase();
    MatchController c(options);
    QSignalSpy errors(&c, &MatchController::errorOccurred);
    c.open(match(), true);
    QTRY_COMPARE(errors.count(), 1);
    const QString reported = errors.first().first().toString();
    QVERIFY2(reported.contains("/nonexistent/pitchboard-robot"), qPrintable(reported));
    QVERIFY2(!reported.contains("other program, then"), qPrintable(reported));
    QCOMPARE(c.cognition(), link::Cognition::Inline);
    QTRY_COMPARE(count(c), std::size_t(6));
  }

  // A program with the computer's clock cannot follow another speed: nothing changes until it is
  // decided what becomes of it.
  void aChangeOfSpeedAsks() {
    using Programs = MatchController::RealTimePrograms;
    const QTemporaryDir folder;
    link::MatchOptions options = inside();
    options.keyBase = testKeyBase();
    options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
    MatchController c(options);
    QSignalSpy asked(&c, &MatchController::askedForSpeed);
    c.open(realTimeRobot(folder), false);
    const auto program = [&c] {
      const auto all =
          c.frame() ? c.frame()->robots[0].processes() : std::span<const link::ProcessStatus>();
      return all.empty() ? link::ProcessStatus{} : all.front();
    };
    QTRY_VERIFY(program().pid != 0);
    const int first = program().pid;
    c.setSpeed(8.0);
    QCOMPARE(asked.count(), 1);
    QCOMPARE(asked[0][0].toStringList(), QStringList{QStringLiteral("B1 decision")});
    QCOMPARE(asked[0][1].toDouble(), 8.0);
    QCOMPARE(c.speed(), 1.0);
    c.setSpeed(1.0);
    QCOMPARE(asked.count(), 1);
    c.answerSpeed(8.0, Programs::LeaveBehind);
    QCOMPARE(c.speed(), 8.0);
    QVERIFY(!c.waitsForTeamPrograms());
    QCOMPARE(program().pid, first);
    c.answerSpeed(4.0, Programs::RestartWithMatchTime);
    QTRY_VERIFY(program().pid != 0 && program().pid != first &&
                program().clock == link::ProcessClock::Match);
    c.setSpeed(2.0);
    QCOMPARE(c.speed(), 2.0);
    QCOMPARE(asked.count(), 1);
  }
};

PITCHBOARD_GUI_TEST(TestMatchController)

}  // namespace tst_match_controller

#include "tst_match_controller.moc"
