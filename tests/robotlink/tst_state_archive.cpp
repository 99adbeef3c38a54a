// SPDX-License-Identifier: GPL-3.0-or-later
#include <QFile>
#include <QtEndian>
#include <QtTest>
#include <bit>

#include <map>
#include <random>
#include <utility>

#include <robotlink/session/state_archive.h>
#include <robotlink/session/state_codec.h>
#include <simcore/world/state_values.h>

namespace tst_state_archive {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace std::chrono_literals;

namespace {

/// Hash of the state that the match went on from, by tick.
class HashLog : public TickObserver {
 public:
  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds) override { note(match); }
  void worldChanged(const SimulatedMatch& match) override { note(match); }
  std::map<std::uint64_t, std::uint64_t> hashes;

 private:
  void note(const SimulatedMatch& match) {
    const auto& simulation = match.simulation();
    hashes.erase(hashes.lower_bound(simulation.state().tick), hashes.end());
    hashes[simulation.state().tick] = simulation.hash();
  }
};

Scenario scenarioOf(const QString& name, const QString& physics) {
  Scenario scenario = loadScenario(name.toStdString()).value();
  scenario.settings.physics = physics.toStdString();
  scenario.settings.noise = noisePreset("realistic").value();
  scenario.settings.rigidBody.falls = true;
  scenario.stop = {};
  return scenario;
}

SimulatedMatch played(const Scenario& scenario, int ticks) {
  auto match = SimulatedMatch::create(scenario, {}).value();
  for (int i = 0; i < ticks; ++i) match.tick();
  return match;
}

/// What is saved, as one number: the types of its values in their order.
class Shape {
 public:
  template <class T>
  void value(T& /*value*/) {
    add(std::is_same_v<T, std::string>     ? 's'
        : std::is_same_v<T, double>        ? 'd'
        : std::is_same_v<T, bool>          ? 'b'
        : std::is_same_v<T, int>           ? 'i'
        : std::is_same_v<T, std::uint32_t> ? 'u'
        : std::is_same_v<T, std::uint64_t> ? 'l'
                                           : 'e');
  }
  void label(double& number, std::uint64_t /*form*/) { value(number); }
  template <class T>
  void count(std::vector<T>& list) {
    add('[');
    list.resize(1);
  }
  template <class T>
  void sameCount(std::vector<T>& list, std::size_t size) {
    add('=');
    list.resize(size);
  }
  template <class T>
  bool present(std::optional<T>& value) {
    add('?');
    value.emplace();
    return true;
  }
  template <class Physics>
  void alternative(Physics& physics) {
    add('|');
    physics = {};  // visited with the others: shapesOfPhysics()
  }
  quint64 hash() const { return m_hash; }

 private:
  void add(char c) { m_hash = (m_hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL; }
  quint64 m_hash = 0xcbf29ce484222325ULL;
};

template <class... States>
QStringList shapesOfPhysics(const std::variant<States...>& /*physics*/) {
  QStringList shapes;
  const auto add = [&shapes]<class State>(State state) {
    Shape shape;
    sim::state_values::physics(state, shape);
    shapes << QStringLiteral("physics %1: %2").arg(shapes.size()).arg(shape.hash(), 0, 16);
  };
  (add(States{}), ...);
  return shapes;
}

Result<sim::WorldState> decode(std::string_view bytes) {
  return decodeState(bytes);
}

/// 1500 ticks later, without anybody's orders.
sim::WorldState playedOn(const sim::WorldState& state) {
  auto simulation = sim::Simulation::create({}).value();
  if (!simulation.restore(state)) qFatal("a state that was read is refused");
  const std::vector<sim::RobotCommand> commands(state.robots.size());
  std::vector<sim::Percepts> percepts(state.robots.size());
  for (int tick = 0; tick < 1500; ++tick) simulation.step(commands, percepts);
  return simulation.state();
}

/// A double as it is saved: a count, and that many leading bytes of its IEEE form.
QByteArray savedNumber(double value) {
  QByteArray bytes(8, '\0');
  qToBigEndian(std::bit_cast<quint64>(value), bytes.data());
  while (bytes.endsWith('\0')) bytes.chop(1);
  return bytes.prepend(static_cast<char>(bytes.size()));
}

/// What is saved, but for its form's number: later versions save the game otherwise.
quint64 hashWithoutGame(sim::WorldState state) {
  state.settings.referee.reset();
  state.game.reset();
  // Earlier versions saved no battery limits of robots, which now have the usual ones.
  const QByteArray limits = savedNumber(19.15) + savedNumber(16.0) + savedNumber(14.65);
  // Nor marks and arcs of the field.
  state.settings.field.markDiameter = 0.123456789;
  state.settings.field.cornerArcRadius = 0.987654321;
  const QByteArray marks = savedNumber(0.123456789) + savedNumber(0.987654321);
  QByteArray bytes = QByteArray::fromStdString(encodeState(state).substr(5));
  bytes.replace(limits, QByteArray());
  bytes.replace(marks, QByteArray());
  quint64 hash = 0xcbf29ce484222325ULL;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  }
  return hash;
}

}  // namespace

class TestStateArchive : public QObject {
  Q_OBJECT

  void physicsRows() {
    QTest::addColumn<QString>("physics");
    QTest::newRow("rigid-body") << "rigid-body";
    QTest::newRow("published") << "published";
  }

 private slots:
  void aStateComesBackAsItWas_data() { physicsRows(); }
  void aStateComesBackAsItWas() {
    QFETCH(QString, physics);
    for (const int ticks : {0, 1, 500, 3000}) {
      const SimulatedMatch match = played(scenarioOf("match-3v3", physics), ticks);
      const sim::WorldState& state = match.simulation().state();
      std::string bytes = encodeState(state);
      // One kind of robot (once for all six), the referee, and what delayed vision still needs.
      QVERIFY2(bytes.size() < 2500, qPrintable(QString::number(bytes.size())));
      bytes += "next";
      std::string_view rest = bytes;
      const auto back = decodeState(rest);
      QVERIFY2(back, back ? "" : back.error().text().c_str());
      QVERIFY(*back == state);
      QCOMPARE(sim::stateHash(*back), match.simulation().hash());
      QCOMPARE(rest, std::string_view("next"));
    }
  }

  void everyValueIsSaved() {
    // One byte of the state changed anywhere gives other bytes: nothing that the hash sees is left
    // out, and what both would leave out, == would tell.
    SimulatedMatch match = played(scenarioOf("match-3v3", "rigid-body"), 100);
    sim::WorldState state = match.simulation().state();
    const std::string before = encodeState(state);
    auto& robot = std::get<sim::RigidBodyState>(state.physics).robots[3];
    robot.imuDrift = std::nextafter(robot.imuDrift, 1.0);
    QVERIFY(encodeState(state) != before);
    robot.posture = sim::Posture::OnBack;
    state.statistics[2].lastUnknownAction = -7;
    state.settings.seed = ~std::uint64_t{0};
    state.score = {-3, 200};
    QVERIFY(decode(encodeState(state)).value() == state);
  }

  void damagedBytesAreRefused_data() { physicsRows(); }
  void damagedBytesAreRefused() {
    QFETCH(QString, physics);
    const SimulatedMatch match = played(scenarioOf("match-3v3", physics), 300);
    const std::string bytes = encodeState(match.simulation().state());
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const auto cut = decode(std::string_view(bytes).substr(0, size));
      QVERIFY(!cut);
      QVERIFY(!cut.error().message.empty());
    }
    std::mt19937 random(7);
    for (int i = 0; i < 3000; ++i) {
      std::string hostile = bytes;
      for (int flips = 0; flips < 3; ++flips) {
        hostile[random() % hostile.size()] = static_cast<char>(random());
      }
      const auto state = decode(hostile);
      if (!state) {
        QVERIFY(!state.error().message.empty());
        continue;
      }
      // What is let through can be played.
      auto simulation = sim::Simulation::create({}).value();
      QVERIFY(simulation.restore(*state));
      const std::vector<sim::RobotCommand> commands(state->robots.size());
      std::vector<sim::Percepts> percepts(state->robots.size());
      for (int tick = 0; tick < 3; ++tick) simulation.step(commands, percepts);
    }
  }

  void anotherFormHasAnotherNumber() {
    sim::WorldState state;
    Shape shape;
    sim::visitValues(state, shape);
    const QStringList saved = QStringList{QStringLiteral("form %1").arg(int(encodeState({})[4])),
                                          QStringLiteral("state: %1").arg(shape.hash(), 0, 16)} +
                              shapesOfPhysics(state.physics);
    // When this fails, what is saved has changed, and states of before would be read wrongly: give
    // the form its next number (`version` in state_codec.cpp, with a word on what is new), and
    // write down here what it is now. A further physics, behind the others, changes none of these.
    const QStringList known{"form 8", "state: 7020ade590fb75a", "physics 0: e2f2cfe159e75697",
                            "physics 1: ee63afaaa2368095"};
    QCOMPARE(saved.mid(0, known.size()).join("; "), known.join("; "));
  }

  // Form 7 (0.15 to 0.21) had no marks and arcs of the field.
  void aStateOfForm7KeepsTheMarksOfBefore() {
    sim::WorldState state = playedOn(sim::Simulation::create({}).value().state());
    state.settings.field.markDiameter = 0.123456789;
    state.settings.field.cornerArcRadius = 0.987654321;
    const auto now = decode(encodeState(state));
    QVERIFY2(now, now ? "" : now.error().text().c_str());
    QCOMPARE(now->settings.field.cornerArcRadius, 0.987654321);
    QByteArray bytes = QByteArray::fromStdString(encodeState(state));
    QCOMPARE(int(bytes[4]), 8);
    bytes[4] = 7;
    bytes.replace(savedNumber(0.123456789) + savedNumber(0.987654321), QByteArray());
    const auto before = decode(bytes.toStdString());
    QVERIFY2(before, before ? "" : before.error().text().c_str());
    QCOMPARE(before->settings.field.markDiameter, 0.0);
    QCOMPARE(before->settings.field.cornerArcRadius, 0.0);
    // The marks are shown only: the match is the same.
    QCOMPARE(sim::stateHash(*before), sim::stateHash(*now));
  }

  // Written by version 0.9, form 4: a match of match-4v4 that a corner kick is prepared in.
  void aStateOfVersion09GoesOnAsItDid() {
    QFile file(QString(PITCHBOARD_TEST_DATA) + "/states/refereed_0.9.state");
    QVERIFY(file.open(QIODevice::ReadOnly));
    auto state = decode(file.readAll().toStdString());
    QVERIFY2(state, state ? "" : state.error().text().c_str());
    QCOMPARE(state->tick, quint64{3780});
    QCOMPARE(state->settings.referee->mercy, 7);
    QCOMPARE(state->settings.referee->packetSize, 688);
    QCOMPARE(state->game->setPlay(), SetPlay::CornerKick);
    QCOMPARE(state->game->setPlayTeam(), 1);
    QCOMPARE(state->game->countdown.ticks, 600);
    QCOMPARE(state->game->clockUse, ClockUse::Began);
    QCOMPARE(state->game->teams[1].score, 1);
    QCOMPARE(state->game->teams[1].slotOf(4), 4);
    const sim::WorldState after = playedOn(*state);
    QVERIFY(after.game->ballFree());
    QCOMPARE(after.game->clock, 33180);
    QCOMPARE(hashWithoutGame(after), 0xaa0387c95653844cULL);  // what 0.9 came to
  }

  // Written by version 0.11, form 5: a match of match-4v4 in play.
  void aStateOfVersion011GoesOnAsItDid() {
    QFile file(QString(PITCHBOARD_TEST_DATA) + "/states/refereed_0.11.state");
    QVERIFY(file.open(QIODevice::ReadOnly));
    auto state = decode(file.readAll().toStdString());
    QVERIFY2(state, state ? "" : state.error().text().c_str());
    QCOMPARE(state->tick, quint64{24060});
    QCOMPARE(state->game->clock, 17950);
    QCOMPARE(state->game->clockUse, ClockUse::Began);
    // What that version did not know is as it was played there.
    QCOMPARE(state->settings.referee->readyStillTime, 0.0);
    QVERIFY(!state->settings.referee->doubleTouch && !state->refereeMemory.obeyed);
    QVERIFY(encodeState(decode(encodeState(*state)).value()) == encodeState(*state));
    const sim::WorldState after = playedOn(*state);
    QVERIFY(after.game->ballFree());
    QCOMPARE(after.game->clock, 16450);
    QCOMPARE(hashWithoutGame(after), 0x22575d2bdef6eac0ULL);  // what 0.11 came to
  }

  void aLaterFormIsNamed() {
    std::string bytes =
        encodeState(played(scenarioOf("one-robot", "published"), 1).simulation().state());
    bytes[4] = 9;
    QCOMPARE(decode(bytes).error().code, ErrorCode::Unsupported);
    QVERIFY(decode(bytes).error().message.find("later version") != std::string::npos);
    bytes[0] = 'X';
    QCOMPARE(decode(bytes).error().code, ErrorCode::ParseError);
  }

  void everyMomentCanBeEnteredAgain_data() { physicsRows(); }
  void everyMomentCanBeEnteredAgain() {
    QFETCH(QString, physics);
    auto archive = std::make_shared<StateArchive>();
    auto log = std::make_shared<HashLog>();
    auto runner = MatchRunner::start(scenarioOf("match-3v3", physics), {}, true,
                                     VariableCatalog::published(), {archive, log})
                      .value();
    const auto play = [&](std::uint64_t tick) {
      runner->runTo(tick);
      return runner->waitUntilStill(60s);
    };
    QVERIFY(play(200));
    runner->execute([](SimulatedMatch& m) {
      (void)m.simulation().placeBall({0.5, -1}, {1, 0.3});
      return Changed::Yes;
    });
    QVERIFY(play(333));
    runner->execute([](SimulatedMatch& m) {
      (void)m.robots().add(
          {{RobotId{9}, TeamColor::Blue, 7, false}, {{-2, 2}, 1.0}, "striker", {}});
      (void)m.robots().remove(RobotId{2});
      (void)m.simulation().placeRobot(RobotId{1}, {{1, 1}, 3.0});
      return Changed::Yes;
    });
    QVERIFY(play(900));
    // Changed while it plays: nothing is shown between the change and the next tick.
    runner->setSpeed(MatchRunner::unlimitedSpeed);
    runner->setPaused(false);
    const auto nowTick = [&runner] {
      std::uint64_t tick = 0;
      runner->read([&tick](const SimulatedMatch& m) { tick = m.simulation().state().tick; });
      return tick;
    };
    for (int i = 0; i < 20; ++i) {
      runner->execute([i](SimulatedMatch& m) {
        if (i % 3 == 0) (void)m.simulation().placeBall({0.1 * i, 0.2}, {0, -1});
        if (i % 3 == 1) m.simulation().setScore({i, 1});
        if (i == 10) m.blackboard(RobotId{9})->write(m.variables().decisionActionA, 1);
        if (i == 11) (void)m.robots().setBehaviour(RobotId{9}, std::string(noBehaviour));
        return Changed::Yes;
      });
      const std::uint64_t changed = nowTick();
      QTRY_VERIFY(nowTick() > changed);
    }
    runner->setPaused(true);
    QVERIFY(runner->waitUntilStill(10s));

    const auto range = archive->range();
    QVERIFY(range);
    QCOMPARE(range->first, std::uint64_t{0});
    QCOMPARE(range->last, log->hashes.rbegin()->first);
    QVERIFY(range->last > 1000);
    std::mt19937 random(1);
    std::vector<std::uint64_t> ticks{0, 199, 200, 201, 333, 334, range->last};
    for (int i = 0; i < 150; ++i) ticks.push_back(random() % (range->last + 1));
    for (const std::uint64_t tick : ticks) {
      const auto state = archive->restore(tick);
      QVERIFY2(state, state ? "" : state.error().text().c_str());
      QVERIFY2(sim::stateHash(*state) == log->hashes.at(tick), qPrintable(QString::number(tick)));
    }
    QCOMPARE(archive->restore(range->last + 1).error().code, ErrorCode::NotFound);
  }

  void aMatchPutBackForgetsWhatCameAfter() {
    auto archive = std::make_shared<StateArchive>();
    auto log = std::make_shared<HashLog>();
    auto runner = MatchRunner::start(scenarioOf("match-3v3", "rigid-body"), {}, true,
                                     VariableCatalog::published(), {archive, log})
                      .value();
    runner->runTo(700);
    QVERIFY(runner->waitUntilStill(60s));
    const auto moment = archive->restore(250).value();
    bool restored = false;
    runner->execute([&](SimulatedMatch& m) {
      restored = m.simulation().restore(moment).has_value();
      return Changed::Yes;
    });
    QVERIFY(restored);
    QTRY_COMPARE(archive->range()->last, std::uint64_t{250});
    runner->execute([](SimulatedMatch& m) {
      (void)m.simulation().placeBall({1, 1});
      return Changed::Yes;
    });
    runner->runTo(400);
    QVERIFY(runner->waitUntilStill(60s));
    QCOMPARE(archive->range()->last, std::uint64_t{400});
    for (const std::uint64_t tick : {0U, 249U, 250U, 251U, 399U, 400U}) {
      QCOMPARE(sim::stateHash(archive->restore(tick).value()), log->hashes.at(tick));
    }
  }

  void memoryHasABudget() {
    ArchiveOptions options;
    options.memoryBudget = 20'000;
    options.robotsBudget = 0;
    StateArchive archive(options);
    auto match = SimulatedMatch::create(scenarioOf("match-3v3", "rigid-body"), {}).value();
    archive.ticked(match, {});
    for (int i = 0; i < 6000; ++i) {
      match.tick();
      archive.ticked(match, {});
      QVERIFY(archive.memoryBytes() < 25'000);
    }
    QVERIFY(archive.range()->first > 4800);
    QCOMPARE(archive.restore(10).error().code, ErrorCode::NotFound);
    QCOMPARE(sim::stateHash(archive.restore(6000).value()), match.simulation().hash());
  }

  void segmentsSurviveAFile() {
    StateArchive archive;
    HashLog log;
    auto match = SimulatedMatch::create(scenarioOf("match-3v3", "rigid-body"), {}).value();
    archive.ticked(match, {});
    log.ticked(match, {});
    for (int i = 0; i < 330; ++i) {
      match.tick();
      archive.ticked(match, {});
      log.ticked(match, {});
    }
    QCOMPARE(archive.segments(70, 200).size(), std::size_t{3});
    const auto all = archive.segments(0, 330);
    QCOMPARE(all.size(), std::size_t{6});
    std::mt19937 random(3);
    for (const auto& segment : all) {
      const std::string bytes = segment->encode();
      const auto back = StateSegment::decode(bytes);
      QVERIFY2(back, back ? "" : back.error().text().c_str());
      QCOMPARE(back->firstTick(), segment->firstTick());
      QCOMPARE(back->lastTick(), segment->lastTick());
      for (const std::uint64_t tick : {back->firstTick(), back->lastTick()}) {
        QCOMPARE(sim::stateHash(back->at(tick).value()), log.hashes.at(tick));
      }
      for (int i = 0; i < 300; ++i) {
        std::string hostile = bytes.substr(0, 1 + random() % bytes.size());
        for (int n = 0; n < 2; ++n)
          hostile[random() % hostile.size()] = static_cast<char>(random());
        const auto segment2 = StateSegment::decode(hostile);
        if (segment2 && segment2->lastTick() - segment2->firstTick() < 1000) {
          const auto state = segment2->at(segment2->lastTick());
          QVERIFY(state || !state.error().message.empty());
        }
      }
    }
  }
};

PITCHBOARD_TEST(TestStateArchive)

}  // namespace tst_state_archive

#include "tst_state_archive.moc"
