// SPDX-License-Identifier: GPL-3.0-or-later
// What robots' programs draw: the way from programs in Python and C++
// through a match and through Live to the frames, the memory and the session file.

#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>

#include <mutex>

#include <robotlink/frame/drawing_origin.h>
#include <robotlink/match/match_drawings.h>
#include <robotlink/match/match_runner.h>
#include <robotlink/session/drawing_moments.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/match_sampler.h>
#include <robotlink/session/recorded_frame.h>
#include <telemetry/formats/text_protocol.h>

#include "../support/segment_keys.h"
#include "frame_difference.h"
#include "live_ports.h"

namespace tst_drawings {

using namespace pitchboard;
using namespace pitchboard::link;
using telemetry::DrawingLayer;
using telemetry::DrawingStore;
using telemetry::ShapeKind;

namespace {

/// The frames that Live made.
class Screen : public LiveObserver {
 public:
  void frameMade(const MatchFrame& frame) override {
    const std::lock_guard lock(m_mutex);
    m_frames.push_back(frame);
  }
  std::vector<MatchFrame> frames() const {
    const std::lock_guard lock(m_mutex);
    return m_frames;
  }
  MatchFrame last() const {
    const std::lock_guard lock(m_mutex);
    return m_frames.empty() ? MatchFrame{} : m_frames.back();
  }

 private:
  mutable std::mutex m_mutex;
  std::vector<MatchFrame> m_frames;
};

const DrawingLayer* layerOf(const MatchFrame& frame, int robot, const std::string& name) {
  for (const auto& drawn : frame.drawings) {
    if (drawn.robot.number != robot) continue;
    for (const auto& layer : drawn.layers) {
      if (layer->name == name) return layer.get();
    }
  }
  return nullptr;
}

}  // namespace

class TestDrawings : public QObject {
  Q_OBJECT

  const int m_base = testKeyBase();
  QTemporaryDir m_folder;

  static Scenario oneRobot() {
    Scenario scenario;
    ScenarioRobot robot;
    robot.identity.id = {1};
    robot.pose = {{-1.0, 0.5}, 0.0};
    robot.behaviour = noBehaviour;
    scenario.robots = {robot};
    return scenario;
  }

 private slots:
  void cleanup() { removeSegment(m_base + 100); }

  // Live: bare drawings, drawings behind messages, mistakes; the file and the memory replay what
  // was seen.
  void liveShowsAndReplaysThem() {
    LiveOptions options = freeOptions(2);
    const std::string path = m_folder.filePath("live.mcap").toStdString();
    LiveWatch watch(options);
    QTRY_COMPARE(watch.details().network.ports.size(), std::size_t{3});
    auto recorder = LiveRecorder::create(path, options, watch.began());
    QVERIFY(recorder);
    const auto memory = std::make_shared<LiveMemory>();
    const auto screen = std::make_shared<Screen>();
    watch.observe(*recorder);
    watch.observe(memory);
    watch.observe(screen);
    TestSocket robot;
    const auto port = [&](int number) {
      return static_cast<std::uint16_t>(options.portBase + number);
    };
    // Nothing but a drawing: no robot, no error.
    QVERIFY(robot.send(port(2), "PBD1 2\nlayer plan field 10\nline 0 0 1 1"));
    QTRY_VERIFY(layerOf(screen->last(), 2, "plan"));
    QVERIFY(screen->last().robots.empty());
    QCOMPARE(watch.details().team.datagrams, std::uint64_t{0});
    telemetry::TextMessage message;
    message.x = 300;
    message.y = 200;
    QVERIFY(robot.send(
        port(1), telemetry::encode(message) + "\nPBD1 1\nlayer ball robot 2\ncircle 0.4 0.1 0.1"));
    QTRY_VERIFY(layerOf(screen->last(), 1, "ball"));
    QCOMPARE(screen->last().robots.size(), std::size_t{1});
    QVERIFY(screen->last().robots[0].poseKnown());
    QCOMPARE(screen->last().robots[0].link->errorCount, std::uint64_t{0});
    QTRY_VERIFY(!layerOf(screen->last(), 1, "ball"));  // two seconds
    QVERIFY(layerOf(screen->last(), 2, "plan"));
    QVERIFY(screen->last().drawingProblem.empty());
    QVERIFY(robot.send(port(1), "PBD1 1\nlayer ball\ncircle 1"));
    QTRY_VERIFY(!screen->last().drawingProblem.empty());
    // A book in the middle of it all, and the last layer is still there.
    watch.setOptions(options);
    QVERIFY(robot.send(port(1), "PBD1 1\nlayer ball belief 5\npoint 0 0"));
    QTRY_VERIFY(layerOf(screen->last(), 1, "ball"));
    watch.stopObserving(screen);
    watch.stopObserving(*recorder);
    watch.stopObserving(memory);
    QVERIFY((*recorder)->finish());

    const auto session = telemetry::SessionReader::open(path);
    QVERIFY(session);
    RecordedFrames ofFile(backdropOf(*session));
    LiveMoments ofMemory;
    std::size_t drawn = 0;
    const auto frames = screen->frames();
    // Datagrams that came while a frame was made may be in the next one only.
    const auto settled = [&](std::size_t i) {
      return i + 1 < frames.size() && frames[i].drawings == frames[i + 1].drawings && i > 0 &&
             frames[i].drawings == frames[i - 1].drawings;
    };
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (!settled(i)) continue;
      const double time = frames[i].snapshot.time;
      QVERIFY(ofFile.frameAt(*session, time).drawings == frames[i].drawings);
      QVERIFY(ofMemory.frameAt(*memory, time)->drawings == frames[i].drawings);
      drawn += frames[i].drawings.size();
    }
    QVERIFY(drawn > 0);
    // Any moment by itself, not only one after the other.
    const double end = frames.back().snapshot.time;
    QVERIFY(RecordedFrames(backdropOf(*session)).frameAt(*session, end).drawings ==
            frames.back().drawings);
  }

  // What docs/drawings.md shows is what runs here.
  void theGuideShowsThesePrograms_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("language");
    QTest::newRow("Python") << "draw_robot.py"
                            << "python";
    QTest::newRow("C++") << "draw_robot.cpp"
                         << "cpp";
  }
  void theGuideShowsThesePrograms() {
    QFETCH(QString, file);
    QFETCH(QString, language);
    QFile guide(PITCHBOARD_SOURCE_DIR "/docs/drawings.md");
    QFile program(PITCHBOARD_SOURCE_DIR "/tests/end_to_end/" + file);
    QVERIFY(guide.open(QIODevice::ReadOnly) && program.open(QIODevice::ReadOnly));
    const QByteArray text = program.readAll();
    QVERIFY(
        guide.readAll().contains("```" + (language + " " + file).toUtf8() + "\n" + text + "```\n"));
  }

  // A program that the match starts finds the way by its environment.
  void aProgramOfTheMatchDraws() {
    const QString profile = m_folder.filePath("draws.json");
    QFile file(profile);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(R"({"version": 1, "name": "draws", "processes": [{"name": "decision",
      "command": ["python3", "draw_robot.py", "${robot}"], "directory": ")" PITCHBOARD_SOURCE_DIR
               R"(/tests/end_to_end"}]})");
    file.close();
    Scenario scenario = oneRobot();
    scenario.robots[0].runtime.profile = profile.toStdString();
    MatchOptions options;
    options.cognition = Cognition::Separate;
    options.keyBase = m_base;
    options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
    const std::string path = m_folder.filePath("match.mcap").toStdString();
    const auto memory = std::make_shared<DrawingMemory>();
    const auto sampler = std::make_shared<MatchSampler>();
    auto recorder =
        MatchRecorder::create(path, scenario, VariableCatalog::published(), sampler, {});
    QVERIFY(recorder);
    auto runner = MatchRunner::start(scenario, options, false, VariableCatalog::published(),
                                     {sampler, memory, *recorder});
    QVERIFY2(runner, runner ? "" : runner.error().text().c_str());
    (*runner)->setSpeed(1.0);
    const auto drawnIn = [&] { return layerOf(*(*runner)->latest(), 1, "decision/target"); };
    QTRY_VERIFY_WITH_TIMEOUT((*runner)->latest() && drawnIn(), 30'000);
    QVERIFY((*runner)->latest()->drawingProblem.empty());
    const auto frame = (*runner)->latest();
    const DrawingLayer* target = layerOf(*frame, 1, "decision/target");
    QVERIFY(target);
    QVERIFY(target->shapes[0].kind == ShapeKind::Arrow);
    const Point tip = target->shapes[0].points.back();
    QVERIFY(std::abs(std::hypot(tip.x, tip.y) - 2.0) < 0.02);
    std::vector<std::shared_ptr<const MatchFrame>> seen;
    const auto watched = [&] {
      const auto newest = (*runner)->latest();
      if (seen.empty() || newest->snapshot.time > seen.back()->snapshot.time) {
        seen.push_back(newest);
      }
      return seen.size() >= 12 && newest->snapshot.time > frame->snapshot.time + 1.0;
    };
    QTRY_VERIFY_WITH_TIMEOUT(watched(), 60'000);
    (*runner)->setPaused(true);
    QVERIFY((*runner)->waitUntilStill(std::chrono::seconds(30)));
    (*runner)->stopObserving(*recorder);
    QVERIFY((*recorder)->finish());

    // The file and the memory agree with each other at every moment, and with what was seen.
    const auto session = telemetry::SessionReader::open(path);
    QVERIFY2(session, session ? "" : session.error().text().c_str());
    RecordedFrames recorded(backdropOf(*session));
    DrawingMoments remembered;
    std::size_t drawn = 0;
    // Between two ticks: a file keeps whole nanoseconds.
    for (double time = frame->snapshot.time - 0.495; time < frame->snapshot.time + 1.0;
         time += 1.0 / 60.0) {
      const MatchFrame ofFile = recorded.frameAt(*session, time);
      MatchFrame ofMemory = ofFile;
      ofMemory.drawings = remembered.at(*memory, time);
      keyDrawings(ofMemory);
      QVERIFY(ofFile.drawings == ofMemory.drawings);
      drawn += ofFile.drawings.size();
    }
    QVERIFY(drawn > 30);
    // What came behind a frame within its tick is not in it: that is seldom.
    const auto asSeen = std::ranges::count_if(seen, [&](const auto& one) {
      return recorded.frameAt(*session, one->snapshot.time).drawings == one->drawings;
    });
    QVERIFY2(asSeen * 4 >= static_cast<std::ptrdiff_t>(seen.size()) * 3,
             qPrintable(QStringLiteral("%1 of %2").arg(asSeen).arg(seen.size())));
  }

  // A program of any language that knows the port; nothing of it reaches the state.
  void aProgramStartedByHandDraws() {
    MatchOptions options;
    options.cognition = Cognition::None;
    options.keyBase = m_base;
    auto match = SimulatedMatch::create(oneRobot(), options);
    QVERIFY2(match, match ? "" : match.error().text().c_str());
    QVERIFY(match->robots().claim());
    std::vector<ReceivedDrawing> received;
    match->takeDrawings(received);
    QVERIFY(match->drawings() && match->drawings()->problem().empty());
    const std::uint64_t hash = match->simulation().hash();
    QProcess program;
    program.setProcessChannelMode(QProcess::ForwardedChannels);
    program.start(
        QCoreApplication::applicationDirPath() + "/draw_robot",
        {"1", "127.0.0.1", QString::number(match->robots().claim()->number().drawingPort())});
    QVERIFY(program.waitForStarted());
    const auto takes = [&] {
      match->takeDrawings(received);
      return received.size() >= 2;
    };
    QTRY_VERIFY_WITH_TIMEOUT(takes(), 30'000);
    program.kill();
    QVERIFY(program.waitForFinished());
    const auto drawn = match->drawings()->store().at(0.0);
    QCOMPARE(drawn.size(), std::size_t{1});
    QCOMPARE(drawn[0].layers.size(), std::size_t{2});
    QCOMPARE(match->simulation().hash(), hash);
  }
};

PITCHBOARD_TEST(TestDrawings)

}  // namespace tst_drawings

#include "tst_drawings.moc"
