// SPDX-License-Identifier: GPL-3.0-or-later
// A match that goes on from an earlier moment, with reference processes inside: they know what they
// knew then. Where that is not kept any more they begin with the belief on their blackboards.
#include <QtTest>

#include <map>

#include <robotlink/match/match_player.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/match_sampler.h>
#include <robotlink/session/moment_reader.h>
#include <robotlink/session/state_archive.h>

#include "../support/measured_match.h"

namespace tst_going_on {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

constexpr std::uint64_t second = 60;

Scenario scenarioOf(std::uint64_t seed) {
  Scenario scenario = soccerMatch("realistic", seed).value();
  scenario.stop = {};
  return scenario;
}

using Board = std::array<std::uint32_t, Blackboard::words>;

Board wordsOf(const SimulatedMatch& match, RobotId id) {
  Board words{};
  match.blackboard(id)->copyWords(words);
  return words;
}

/// Everything that could be told apart, by tick; what is played twice counts as it was first.
class Witness : public TickObserver {
 public:
  struct Seen {
    std::uint64_t hash = 0;
    std::map<RobotId, Board> boards;
    std::map<RobotId, double> errors;  // m
  };
  static Seen look(const SimulatedMatch& match) {
    Seen now;
    now.hash = match.simulation().hash();
    for (const sim::RobotSnapshot& robot : match.simulation().snapshot().robots) {
      const RobotId id = robot.identity.id;
      now.boards[id] = wordsOf(match, id);
      now.errors[id] = poseError(match, robot, nullptr);
    }
    return now;
  }
  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds) override {
    seen.try_emplace(match.simulation().state().tick, look(match));
  }
  std::map<std::uint64_t, Seen> seen;
};

/// A match with everything that remembers it, as in the studio.
struct Played {
  explicit Played(const Scenario& scenario, const ArchiveOptions& kept = {})
      : archive(std::make_shared<StateArchive>(kept)),
        witness(std::make_shared<Witness>()),
        player(SimulatedMatch::create(scenario, options()).value()) {
    player.observe(archive);
    player.observe(std::make_shared<MatchSampler>(
        std::shared_ptr<telemetry::RowSink>(std::shared_ptr<void>(), &rows)));
    player.observe(witness);
    player.worldChanged();
  }
  static MatchOptions options() {
    MatchOptions options;
    options.process.particles = 1000;
    return options;
  }
  SimulatedMatch& match() { return player.match(); }
  void playTo(std::uint64_t tick) {
    while (match().simulation().state().tick < tick) player.tick();
  }
  void change(const std::function<Result<void>(SimulatedMatch&)>& what) {
    const auto done = what(match());
    if (!done) qFatal("%s", done.error().text().c_str());
    player.worldChanged();
  }
  Moment momentAt(std::uint64_t tick) {
    auto moment = momentFromMemory(*archive, rows, tick, VariableCatalog::published());
    if (!moment) qFatal("%s", moment.error().text().c_str());
    return std::move(*moment);
  }
  void goBackTo(std::uint64_t tick) {
    change([this, tick](SimulatedMatch& it) { return it.restore(momentAt(tick)); });
  }
  /// The first tick up to `tick` at which the match is not what it was the first time; 0: it is.
  std::uint64_t differsUntil(std::uint64_t tick) {
    while (match().simulation().state().tick < tick) {
      player.tick();
      const std::uint64_t now = match().simulation().state().tick;
      const Witness::Seen again = Witness::look(match());
      const Witness::Seen& before = witness->seen.at(now);
      if (again.hash != before.hash || again.boards != before.boards) return now;
    }
    return 0;
  }
  double meanError(std::uint64_t from, std::uint64_t to) const {
    double sum = 0.0;
    int count = 0;
    for (auto at = witness->seen.lower_bound(from); at != witness->seen.lower_bound(to); ++at) {
      for (const auto& [robot, error] : at->second.errors) {
        sum += error;
        ++count;
      }
    }
    return sum / count;
  }

  telemetry::SeriesStore rows;
  std::shared_ptr<StateArchive> archive;
  std::shared_ptr<Witness> witness;
  MatchPlayer player;
};

}  // namespace

class TestGoingOn : public QObject {
  Q_OBJECT

 private slots:
  void aMatchGoesOnAsItDid_data() {
    QTest::addColumn<int>("seed");
    for (const int seed : {1, 7}) QTest::addRow("seed %d", seed) << seed;
  }
  void aMatchGoesOnAsItDid() {
    QFETCH(int, seed);
    Played match(scenarioOf(static_cast<std::uint64_t>(seed)));
    match.playTo(45 * second);
    // Where something was kept, and at ticks between; farther back each time, and once again.
    for (const std::uint64_t tick : {2640U, 2641U, 1799U, 1200U, 613U, 1U, 0U, 613U}) {
      match.goBackTo(tick);
      QCOMPARE(match.match().simulation().state().tick, tick);
      if (tick > 0) QCOMPARE(match.match().simulation().hash(), match.witness->seen.at(tick).hash);
      QCOMPARE(match.differsUntil(std::min<std::uint64_t>(tick + 12 * second, 45 * second)),
               std::uint64_t{0});
    }
  }

  // What was done by hand is in the states, and robots that come and go are remembered again.
  void changesByHandArePartOfThePast() {
    Played match(scenarioOf(3));
    match.playTo(14 * second);
    match.change([](SimulatedMatch& it) {
      return it.simulation().placeRobot(RobotId{1}, {{-1.0, 1.0}, 0.5});
    });
    match.playTo(16 * second);
    match.change([](SimulatedMatch& it) { return it.simulation().placeBall({0.5, 0.5}); });
    match.playTo(18 * second);
    match.change(
        [](SimulatedMatch& it) { return it.robots().setBehaviour(RobotId{2}, "striker"); });
    match.change([](SimulatedMatch& it) { return it.robots().remove(RobotId{3}); });
    match.playTo(22 * second);
    ScenarioRobot come;
    come.identity = {RobotId{9}, TeamColor::Blue, 9, false};
    come.pose = {{-2.0, -2.0}, 0.0};
    come.behaviour = "supporter";
    match.change([&](SimulatedMatch& it) { return it.robots().add(come); });
    match.playTo(36 * second);
    for (const std::uint64_t seconds : {35U, 26U, 21U, 17U, 15U, 11U}) {
      const std::uint64_t tick = seconds * second + 5;
      match.goBackTo(tick);
      QCOMPARE(match.match().robots().find(RobotId{2})->behaviour,
               std::string(seconds >= 18 ? "striker" : "keeper"));
      QCOMPARE(match.match().simulation().hash(), match.witness->seen.at(tick).hash);
      // Until the next change, which is not made again.
      const std::uint64_t until = seconds >= 22   ? 36
                                  : seconds >= 18 ? 22
                                  : seconds >= 16 ? 18
                                  : seconds >= 14 ? 16
                                                  : 14;
      QCOMPARE(match.differsUntil(until * second), std::uint64_t{0});
    }
  }

  void whatRobotsRememberHasABudget() {
    ArchiveOptions little;
    little.robotsBudget = 400'000;
    Played match(scenarioOf(1), little), plenty(scenarioOf(1));
    for (std::uint64_t tick = 0; tick < 120 * second; tick += 10 * second) {
      match.playTo(tick);
      plenty.playTo(tick);
      QVERIFY(match.archive->past(tick));
      QVERIFY(match.archive->memoryBytes() < 400'000 + 50'000 + tick * 100);
    }
    QVERIFY(!match.archive->past(5 * second) && plenty.archive->past(5 * second));
    // The first look is the largest: nobody knows where it is.
    const auto at = plenty.archive->past(100 * second)->memory;
    qInfo("%zu robots remember %zu bytes", at->robots.size(), at->bytes);
    QVERIFY(at->bytes < 30'000 * at->robots.size());
  }

  // A ball rolls on a surface that "rigid_body" of version 0.8 described; 0.8 went on to this hash.
  void sessionsOfVersion08GoOnAsTheyDid() {
    const auto session = telemetry::SessionReader::open(PITCHBOARD_SOURCE_DIR
                                                        "/tests/data/sessions/rolling_0.8.mcap");
    QVERIFY2(session, session ? "" : session.error().text().c_str());
    const auto moment = momentFromSession(*session, 0.2, VariableCatalog::published());
    QVERIFY2(moment, moment ? "" : moment.error().text().c_str());
    QVERIFY(moment->state.settings.field.surface == (sim::Surface{0.2, 0.97}));
    auto match = SimulatedMatch::create(loadScenario("empty").value(), {}).value();
    const auto put = match.restore(*moment);
    QVERIFY2(put, put ? "" : put.error().text().c_str());
    while (match.simulation().state().tick < 312) match.tick();
    QCOMPARE(match.simulation().hash(), std::uint64_t{0x5ac57837bce433e4});
  }

  // A robot begins where it believed to be, as sure as it was.
  void beliefsAreTakenFromTheBlackboardsWhereNothingElseIsKept_data() {
    QTest::addColumn<bool>("session");
    QTest::newRow("memory without what the processes remember") << false;
    QTest::newRow("a session") << true;
  }
  void beliefsAreTakenFromTheBlackboardsWhereNothingElseIsKept() {
    QFETCH(bool, session);
    const QTemporaryDir folder;
    const std::string path = folder.filePath("match.mcap").toStdString();
    ArchiveOptions nothing;
    nothing.robotsBudget = 0;
    double before = 0.0, after = 0.0;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      Played match(scenarioOf(seed), nothing);
      const std::string file = path + std::to_string(seed);
      if (session) {
        const auto rowsToo = std::make_shared<MatchSampler>();
        const auto recorder = MatchRecorder::create(file, scenarioOf(seed),
                                                    VariableCatalog::published(), rowsToo, {});
        if (!recorder) qFatal("%s", recorder.error().text().c_str());
        match.player.observe(rowsToo);
        match.player.observe(*recorder);
        match.player.worldChanged();
        match.playTo(60 * second);
        match.player.stopObserving(*recorder);
        QVERIFY((*recorder)->finish());
      } else {
        match.playTo(60 * second);
      }
      Moment moment = match.momentAt(50 * second);
      QVERIFY(!moment.past);
      if (session) {
        const auto reader = telemetry::SessionReader::open(file).value();
        moment = momentFromSession(reader, 50.0, VariableCatalog::published()).value();
      }
      before += match.meanError(50 * second, 60 * second);
      // A match that knows nothing of it, as the command line makes one.
      Played later(scenarioOf(seed));
      later.change([&](SimulatedMatch& it) { return it.restore(moment); });
      later.playTo(60 * second);
      after += later.meanError(50 * second, 60 * second);
    }
    qInfo("belief error %.1f cm, in one go %.1f cm", 100 * after / 3, 100 * before / 3);
    QVERIFY(after / 3 < 1.25 * before / 3 + 0.03);
  }
};

PITCHBOARD_TEST(TestGoingOn)

}  // namespace tst_going_on

#include "tst_going_on.moc"
