// SPDX-License-Identifier: GPL-3.0-or-later
// Whole matches, from kick-off to the final whistle, played with pauses, single steps, every speed
// and looks back: the robots believe what they believe in a match that is played in one go.
#include <QtTest>
#include <map>
#include <numeric>

#include <robotlink/match/match_runner.h>
#include <robotlink/session/match_sampler.h>
#include <robotlink/session/moment_reader.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/state_archive.h>

#include "../support/measured_match.h"
#include "../support/segment_keys.h"

namespace tst_paced_match {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace std::chrono_literals;

namespace {

constexpr std::uint64_t tickRate = 60;
constexpr std::uint64_t foundThemselves = 20 * tickRate;  // no belief is good at the very start

enum class Size {
  Small,  ///< one against one: separate processes take long on a busy computer
  Large   ///< two against two
};

/// The default scenario in short halves, with the published robot and surface: what is wanted of
/// beliefs holds for this very match.
Scenario wholeMatch(const char* noise, Size size) {
  Scenario scenario = loadScenario("match").value();
  scenario.settings.noise = noisePreset(noise).value();
  scenario.settings.seed = 11;
  scenario.settings.field.surface = {};
  for (ScenarioRobot& robot : scenario.robots) robot.model = {};
  sim::RefereeRules& rules = *scenario.settings.referee;
  const bool small = size == Size::Small;
  rules.halfTime = small ? 15 : 40;
  rules.beforeMatch = rules.beforeHalf = 3;
  rules.readyTime = small ? 20 : 25;
  std::erase_if(scenario.robots, [small](const ScenarioRobot& robot) {
    return robot.identity.number > 2 || (small && robot.identity.number == 1);
  });
  return scenario;
}

MatchOptions optionsFor(Cognition cognition, RobotsPace pace = RobotsPace::LockStep) {
  MatchOptions options;
  options.cognition = cognition;
  options.pace = pace;
  options.process.particles = 200;
  if (cognition == Cognition::Separate) {
    options.keyBase = testKeyBase();
    options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
  }
  return options;
}

/// Hashes, places and errors of belief by tick; what is played twice counts as it was last.
class Witness : public TickObserver {
 public:
  void ticked(const SimulatedMatch& match, std::chrono::nanoseconds) override {
    const std::uint64_t tick = match.simulation().state().tick;
    end = tick;
    if (tick % 6 != 0) return;
    hashes[tick] = match.simulation().hash();
    match.simulation().snapshot(m_now);
    places[tick] = m_now.robots.front().pose.position;
    if (tick % tickRate != 0 || tick < foundThemselves) return;
    std::vector<double>& all = errors[tick];
    all.clear();
    for (const auto& robot : m_now.robots) all.push_back(poseError(match, robot, nullptr));
  }

  std::vector<double> errorsIn(std::uint64_t first, std::uint64_t last) const {
    std::vector<double> all;
    for (auto at = errors.lower_bound(first); at != errors.upper_bound(last); ++at) {
      all.insert(all.end(), at->second.begin(), at->second.end());
    }
    return all;
  }
  std::vector<double> allErrors() const { return errorsIn(0, end); }

  std::uint64_t end = 0;
  std::map<std::uint64_t, std::uint64_t> hashes;
  std::map<std::uint64_t, Point> places;
  std::map<std::uint64_t, std::vector<double>> errors;  // m

 private:
  sim::Snapshot m_now;
};

struct Errors {
  explicit Errors(const std::vector<double>& all)
      : mean(std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size())),
        p95(quantile(all, 0.95)) {}
  double mean, p95;  // m
};

/// A match with everything that remembers it, as in the studio.
struct Played {
  Played(const Scenario& scenario, const MatchOptions& options)
      : archive(std::make_shared<StateArchive>()), witness(std::make_shared<Witness>()) {
    const auto sampler = std::make_shared<MatchSampler>(
        std::shared_ptr<telemetry::RowSink>(std::shared_ptr<void>(), &rows));
    auto started = MatchRunner::start(scenario, options, true, VariableCatalog::published(),
                                      {archive, sampler, witness});
    if (!started) qFatal("%s", started.error().text().c_str());
    runner = std::move(*started);
  }
  std::uint64_t tick() const {
    std::uint64_t now = 0;
    runner->read([&now](const SimulatedMatch& match) { now = match.simulation().state().tick; });
    return now;
  }
  void playTo(std::uint64_t tick) {
    runner->runTo(tick);
    if (!runner->waitUntilStill(300s)) qFatal("the match does not get to tick %llu", tick + 0ULL);
  }
  /// At least `ticks` of the match at this speed, then a pause.
  void play(double speed, std::uint64_t ticks) {
    const std::uint64_t until = tick() + ticks;
    runner->setSpeed(speed);
    runner->setPaused(false);
    const bool reached = QTest::qWaitFor(
        [&] { return tick() >= until || runner->latest()->finishedBy == "full_time"; }, 300'000);
    runner->setPaused(true);
    if (!reached || !runner->waitUntilStill(60s)) qFatal("the match does not go on");
  }
  bool over() const { return runner->latest()->finishedBy == "full_time"; }
  /// Gives the tick from which it goes on.
  std::uint64_t goBack(std::uint64_t ticks) {
    const std::uint64_t to = tick() - ticks;
    const auto moment = momentFromMemory(*archive, rows, to, VariableCatalog::published());
    if (!moment) qFatal("%s", moment.error().text().c_str());
    Result<void> entered;
    runner->execute([&](SimulatedMatch& match) {
      entered = match.restore(*moment);
      return Changed::Yes;
    });
    if (!entered) qFatal("%s", entered.error().text().c_str());
    return to;
  }
  void toTheFinalWhistle() {
    runner->setSpeed(MatchRunner::unlimitedSpeed);
    runner->setPaused(false);
    if (!runner->waitUntilStill(600s)) qFatal("the match does not end");
  }

  telemetry::SeriesStore rows;
  std::shared_ptr<StateArchive> archive;
  std::shared_ptr<Witness> witness;
  std::unique_ptr<MatchRunner> runner;
};

}  // namespace

class TestPacedMatch : public QObject {
  Q_OBJECT
  const int m_base = testKeyBase();
  std::map<std::pair<Size, QString>, std::unique_ptr<Played>> m_inOneGo;  // by noise

  /// Inside this program, which is what separate processes at x1 play (tst_separate_match).
  const Witness& inOneGo(Size size, const QString& noise) {
    auto& played = m_inOneGo[{size, noise}];
    if (!played) {
      played = std::make_unique<Played>(wholeMatch(qPrintable(noise), size),
                                        optionsFor(Cognition::Inline));
      played->toTheFinalWhistle();
      played->runner.reset();  // with its thread, before the witness is read
    }
    return *played->witness;
  }

  /// Pauses, steps, all speeds and a look back, every twenty seconds of the match.
  static void playWithEverything(Played& match, std::uint64_t ticksInRealTime) {
    RecordedFrames past;
    while (!match.over()) {
      match.playTo(match.tick() + 20 * tickRate);
      if (match.over()) break;
      match.runner->stepOnce();
      match.runner->stepOnce();
      QVERIFY(match.runner->waitUntilStill(60s));
      match.play(0.1, 2);
      match.play(1.0, ticksInRealTime);
      match.play(5.0, 60);
      const std::uint64_t before = match.tick();
      match.runner->setSpeed(20.0);
      match.runner->setPaused(false);
      // What is shown of the past is what was, and the match does not mind.
      const std::uint64_t seen = before / 12 * 6;
      const MatchFrame frame = past.frameAt(match.rows, static_cast<double>(seen) / tickRate);
      match.play(20.0, 240);
      QCOMPARE(frame.snapshot.tick, seen);
      QVERIFY(frame.robots.front().pose.position == match.witness->places.at(seen));
    }
  }

 private slots:
  void cleanup() {
    for (int n = 1; n <= 6; ++n) removeSegment(m_base + 100 * n);
  }

  void everyPaceIsTheSameMatch_data() {
    QTest::addColumn<int>("cognition");
    QTest::newRow("inside") << static_cast<int>(Cognition::Inline);
    QTest::newRow("separate processes") << static_cast<int>(Cognition::Separate);
  }
  void everyPaceIsTheSameMatch() {
    QFETCH(int, cognition);
    const Witness& wanted = inOneGo(Size::Small, "realistic");
    Played match(wholeMatch("realistic", Size::Small),
                 optionsFor(static_cast<Cognition>(cognition)));
    playWithEverything(match, 8);
    QVERIFY(match.over());
    match.runner.reset();
    QCOMPARE(match.witness->end, wanted.end);
    QVERIFY(wanted.end > 80 * tickRate);
    QVERIFY2(match.witness->hashes == wanted.hashes, differs(*match.witness, wanted).constData());
    QVERIFY(match.witness->errors == wanted.errors);
    const Errors errors(wanted.allErrors());
    qInfo("%.0f s, belief error %.1f cm, 95 of 100 below %.1f cm",
          static_cast<double>(wanted.end) / tickRate, 100 * errors.mean, 100 * errors.p95);
  }

  // At x1 the processes run freely, as on the field: not the same match, but beliefs as good.
  void beliefsAreAsGoodWhenProcessesRunFreely() {
    Played match(wholeMatch("realistic", Size::Small),
                 optionsFor(Cognition::Separate, RobotsPace::Free));
    playWithEverything(match, 75);
    QVERIFY(match.over());
    match.runner.reset();
    compare(match.witness->allErrors(), inOneGo(Size::Small, "realistic").allErrors());
  }

  // Played on from an earlier moment, inside: the robots know what they knew then, across the
  // half-time and whatever the referee says.
  void aMatchThatGoesOnFromAnEarlierMomentIsTheSame_data() {
    QTest::addColumn<QString>("noise");
    QTest::newRow("none") << "none";
    QTest::newRow("realistic") << "realistic";
  }
  void aMatchThatGoesOnFromAnEarlierMomentIsTheSame() {
    QFETCH(QString, noise);
    const Witness& wanted = inOneGo(Size::Large, noise);
    Played match(wholeMatch(qPrintable(noise), Size::Large), optionsFor(Cognition::Inline));
    for (const std::uint64_t seconds : {40U, 60U, 80U, 100U}) {
      match.playTo(seconds * tickRate + 7);
      match.goBack(15 * tickRate);
    }
    match.toTheFinalWhistle();
    QVERIFY(match.over());
    match.runner.reset();
    QCOMPARE(match.witness->end, wanted.end);
    QVERIFY2(match.witness->hashes == wanted.hashes, differs(*match.witness, wanted).constData());
    QVERIFY(match.witness->errors == wanted.errors);
  }

  // Separate processes begin again with the belief on their blackboards: as good as that of a match
  // in one go, from the first second on.
  void beliefsOfSeparateProcessesAreAsGoodAtOnce() {
    const Witness& oneGo = inOneGo(Size::Small, "realistic");
    Played match(wholeMatch("realistic", Size::Small), optionsFor(Cognition::Separate));
    std::vector<double> played, wanted;
    for (const std::uint64_t seconds : {35U, 50U, 65U}) {
      match.playTo(seconds * tickRate);
      const std::uint64_t from = match.goBack(12 * tickRate), until = from + 8 * tickRate;
      match.playTo(until);
      for (const double error : match.witness->errorsIn(from + 1, until)) played.push_back(error);
      for (const double error : oneGo.errorsIn(from + 1, until)) wanted.push_back(error);
    }
    QVERIFY(played.size() >= 3 * 2 * 7);
    compare(played, wanted);
  }

  void cleanupTestCase() { m_inOneGo.clear(); }

 private:
  static QByteArray differs(const Witness& played, const Witness& wanted) {
    const auto at = std::mismatch(played.hashes.begin(), played.hashes.end(), wanted.hashes.begin(),
                                  wanted.hashes.end());
    return "another state from tick " +
           QByteArray::number(at.second == wanted.hashes.end() ? 0ULL : at.second->first + 0ULL);
  }
  static void compare(const std::vector<double>& played, const std::vector<double>& oneGo) {
    const Errors errors(played), wanted(oneGo);
    qInfo("belief error %.1f cm (in one go %.1f), 95 of 100 below %.1f cm (%.1f)",
          100 * errors.mean, 100 * wanted.mean, 100 * errors.p95, 100 * wanted.p95);
    QVERIFY(errors.mean < 1.5 * wanted.mean + 0.05);
    QVERIFY(errors.p95 < 1.5 * wanted.p95 + 0.10);
  }
};

PITCHBOARD_TEST(TestPacedMatch)

}  // namespace tst_paced_match

#include "tst_paced_match.moc"
