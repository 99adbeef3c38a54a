// SPDX-License-Identifier: GPL-3.0-or-later
// What robots' programs draw: the text, the book, and the way from programs in Python and C++
// through a match and through Live to the frames, the memory and the session file.

#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <mutex>

#include <robotlink/match/match_drawings.h>
#include <robotlink/match/match_runner.h>
#include <robotlink/session/drawing_moments.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/match_recorder.h>
#include <robotlink/session/match_sampler.h>
#include <robotlink/session/recorded_frame.h>
#include <telemetry/wire/text_protocol.h>

#include "../support/segment_keys.h"
#include "frame_difference.h"
#include "live_ports.h"

using namespace pitchboard;
using namespace pitchboard::link;
using telemetry::Drawing;
using telemetry::DrawingBook;
using telemetry::DrawingFrame;
using telemetry::DrawingLayer;
using telemetry::DrawingLimits;
using telemetry::DrawingShape;
using telemetry::parseDrawing;
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
    if (drawn.robot != robot) continue;
    for (const auto& layer : drawn.layers) {
      if (layer->name == name) return layer.get();
    }
  }
  return nullptr;
}

std::size_t layersOf(const DrawingBook& book, double time) {
  std::size_t count = 0;
  for (const auto& robot : book.at(time)) count += robot.layers.size();
  return count;
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

  // Every number worked out by hand from docs/DRAWINGS.md.
  void readsWhatTheGuideSays() {
    const auto drawing = parseDrawing(
        "PBD1 3 12\r\n"
        "\n"
        "layer decision/target\n"
        "line 0 0 1.5 -0.5 +2 0\n"
        "colour #11223344\n"
        "width 4.5\n"
        "  arrow 1 2\t3 4  \n"
        "text 1 0.5   I go  there \n"
        "more vision/obstacles robot 0.5\n"
        "color red\n"
        "disc 1 0.5 0.25\n"
        "area 0 0 1 0 1 1\n"
        "layer ball 2 belief\n"
        "point 1e-1 -.5\n"
        "layer gone");
    QVERIFY2(drawing, drawing ? "" : drawing.error().text().c_str());
    QCOMPARE(drawing->robot, 3);
    QCOMPARE(drawing->team.value_or(0), 12);
    QCOMPARE(drawing->layers.size(), std::size_t{4});
    const DrawingLayer& target = drawing->layers[0];
    QCOMPARE(target.name, std::string("decision/target"));
    QVERIFY(target.frame == DrawingFrame::Field && target.life == 1.0 && !target.adds);
    QCOMPARE(target.shapes.size(), std::size_t{3});
    QVERIFY(
        (target.shapes[0] ==
         DrawingShape{ShapeKind::Line, {{0, 0}, {1.5, -0.5}, {2, 0}}, 0.0, std::nullopt, 2.0, {}}));
    QVERIFY((target.shapes[1] ==
             DrawingShape{ShapeKind::Arrow, {{1, 2}, {3, 4}}, 0.0, 0x44112233U, 4.5, {}}));
    QVERIFY((target.shapes[2] ==
             DrawingShape{ShapeKind::Text, {{1, 0.5}}, 0.0, 0x44112233U, 4.5, "I go  there"}));
    const DrawingLayer& seen = drawing->layers[1];
    QVERIFY(seen.frame == DrawingFrame::Robot && seen.life == 0.5 && seen.adds);
    // Colour and width begin anew in each layer.
    QVERIFY(
        (seen.shapes[0] == DrawingShape{ShapeKind::Disc, {{1, 0.5}}, 0.25, 0xffe5484dU, 2.0, {}}));
    QCOMPARE(seen.shapes[1].points.size(), std::size_t{3});
    const DrawingLayer& ball = drawing->layers[2];
    QVERIFY(ball.frame == DrawingFrame::Belief && ball.life == 2.0);
    QVERIFY((ball.shapes[0].points == std::vector<Point>{{0.1, -0.5}}));
    QVERIFY(drawing->layers[3].shapes.empty());
    // And as text again.
    const auto again = parseDrawing(telemetry::drawingText(*drawing));
    QVERIFY2(again, again ? "" : again.error().text().c_str());
    QVERIFY(*again == *drawing);
  }

  void refuses_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<int>("line");
    QTest::addColumn<QString>("says");
    const auto row = [](const char* name, const QString& text, int line, const char* says) {
      QTest::newRow(name) << text << line << QString::fromUtf8(says);
    };
    row("nothing", {}, 0, "PBD1");
    row("another protocol", "RBT1 3", 1, "begins with PBD1");
    row("no number", "PBD1 ", 1, "number");
    row("robot 0", "PBD1 0", 1, "number");
    row("a fraction of a robot", "PBD1 1.5", 1, "number");
    row("a far robot", "PBD1 99999", 1, "number");
    row("no team", "PBD1 1 x", 1, "team");
    row("too much at the head", "PBD1 1 2 3", 1, "team");
    row("a shape without a layer", "PBD1 1\ncircle 0 0 1", 2, "layer NAME");
    row("an unknown word", "PBD1 1\nlayer a\nsquare 0 0 1", 3, "square");
    row("no name", "PBD1 1\nlayer", 2, "name");
    row("a long name", "PBD1 1\nlayer " + QString(49, 'a'), 2, "name");
    row("a control character", "PBD1 1\nlayer a\x01", 2, "name");
    row("an unknown frame", "PBD1 1\nlayer a world", 2, "world");
    row("a life too long", "PBD1 1\nlayer a 11", 2, "seconds");
    row("no life", "PBD1 1\nlayer a 0", 2, "seconds");
    row("nan", "PBD1 1\nlayer a\npoint nan 0", 3, "point needs");
    row("infinity", "PBD1 1\nlayer a\npoint inf 0", 3, "point needs");
    row("too far", "PBD1 1\nlayer a\npoint 1001 0", 3, "1000");
    row("a number too few", "PBD1 1\nlayer a\nline 0 0 1", 3, "line needs");
    row("one point", "PBD1 1\nlayer a\narrow 0 0", 3, "arrow needs");
    row("two corners", "PBD1 1\nlayer a\npolygon 0 0 1 1", 3, "three points");
    row("no radius", "PBD1 1\nlayer a\ncircle 0 0", 3, "radius");
    row("a negative radius", "PBD1 1\nlayer a\ndisc 0 0 -1", 3, "radius");
    row("one too many", "PBD1 1\nlayer a\ncircle 0 0 1 1", 3, "circle needs");
    row("a number with a tail", "PBD1 1\nlayer a\npoint 1m 0", 3, "point needs");
    row("no text", "PBD1 1\nlayer a\ntext 0 0", 3, "text needs");
    row("a long text", "PBD1 1\nlayer a\ntext 0 0 " + QString(121, 'x'), 3, "120");
    row("no colour", "PBD1 1\nlayer a\ncolour blau", 3, "blau");
    row("half a colour", "PBD1 1\nlayer a\ncolour #12345", 3, "#12345");
    row("a thick line", "PBD1 1\nlayer a\nwidth 21", 3, "0.5 to 20");
    QString many = QStringLiteral("PBD1 1");
    for (int i = 0; i <= 32; ++i) many += QStringLiteral("\nlayer l%1").arg(i);
    row("too many layers", many, 34, "32");
    QString shapes = QStringLiteral("PBD1 1\nlayer a");
    for (int i = 0; i <= 1000; ++i) shapes += QStringLiteral("\npoint 0 0");
    row("too many shapes", shapes, 1003, "1000 shapes");
    QString points = QStringLiteral("PBD1 1\nlayer a\nline");
    for (int i = 0; i <= 4000; ++i) points += QStringLiteral(" 1 1");
    row("too many points", points, 3, "4000 points");
  }
  void refuses() {
    QFETCH(QString, text);
    QFETCH(int, line);
    QFETCH(QString, says);
    const auto drawing = parseDrawing(text.toStdString());
    QVERIFY(!drawing);
    QCOMPARE(drawing.error().context, "drawing, line " + std::to_string(line));
    QVERIFY2(QString::fromStdString(drawing.error().message).contains(says),
             drawing.error().message.c_str());
  }

  void aMessageMayHaveADrawingBehindIt() {
    using telemetry::partsOf;
    const auto both = partsOf("1 2 3 OUT\nPBD1 1\nlayer a\n");
    QCOMPARE(both.message, std::string_view("1 2 3 OUT"));
    QCOMPARE(both.drawing, std::string_view("PBD1 1\nlayer a\n"));
    QVERIFY(partsOf("PBD1 1\n").message.empty());
    QCOMPARE(partsOf("1 PBD1 OUT").message, std::string_view("1 PBD1 OUT"));
    QVERIFY(partsOf("1 PBD1 OUT").drawing.empty());
  }

  void aLayerIsReplacedAddedToAndGoes() {
    DrawingBook book;
    QVERIFY(book.take("PBD1 1\nlayer a\npoint 0 0\nlayer b field 3\npoint 1 1", 10.0));
    QVERIFY(book.take("PBD1 2\nlayer a\npoint 5 5", 10.2, 1000));
    QCOMPARE(layersOf(book, 9.9), std::size_t{0});
    QCOMPARE(layersOf(book, 10.0), std::size_t{2});
    QCOMPARE(layersOf(book, 10.5), std::size_t{3});
    QCOMPARE(book.at(10.5).back().robot, 1002);
    QVERIFY(book.take("PBD1 1\nmore a\npoint 2 2", 10.5));
    QCOMPARE(book.at(10.6).front().layers.front()->shapes.size(), std::size_t{2});
    QVERIFY(book.take("PBD1 1\nlayer a\npoint 3 3", 10.7));
    const auto now = book.at(10.8).front().layers.front();
    QCOMPARE(now->shapes.size(), std::size_t{1});
    QVERIFY((now->shapes[0].points == std::vector<Point>{{3, 3}}));
    QCOMPARE(layersOf(book, 11.7), std::size_t{1});  // b has three seconds
    QCOMPARE(layersOf(book, 13.0), std::size_t{0});
    QVERIFY(book.take("PBD1 1\nlayer b", 11.0));
    QCOMPARE(layersOf(book, 11.1), std::size_t{2});
    // A robot that was put back to an earlier moment draws there.
    QVERIFY(book.take("PBD1 1\nlayer c\npoint 0 0", 2.0));
    QCOMPARE(layersOf(book, 2.1), std::size_t{1});
  }

  void pagesMakeTheBookAgain() {
    DrawingBook book, copy;
    QVERIFY(book.take("PBD1 1\nlayer a 5\nline 0 0 0.1 0.3\nlayer b robot 2\ndisc 0 0 1", 1.0));
    QVERIFY(book.take("PBD1 2\nlayer a belief 3\ncolour blue\ntext 0 0 hello", 1.5, 3000));
    for (const DrawingBook::Page& page : book.pages(2.0)) QVERIFY(copy.take(page.text, page.time));
    for (const double time : {2.0, 2.9, 3.1, 4.6, 6.1}) QVERIFY(copy.at(time) == book.at(time));
  }

  void aRobotCannotFillTheMemory() {
    DrawingBook book;
    const auto layer = [](int robot, int number, int points) {
      std::string text =
          "PBD1 " + std::to_string(robot) + "\nlayer l" + std::to_string(number) + " 10\nline";
      for (int i = 0; i < points; ++i) text += " 0 0";
      return text;
    };
    for (int i = 0; i < 5; ++i) QVERIFY(book.take(layer(1, i, 4000), 1.0));
    QVERIFY(!book.take(layer(1, 6, 2), 1.0));
    QVERIFY(QString::fromStdString(book.lastProblem()).contains("20000 points"));
    for (int i = 0; i < 32; ++i) QVERIFY(book.take(layer(2, i, 2), 1.0));
    QVERIFY(!book.take(layer(2, 33, 2), 1.0));
    QCOMPARE(layersOf(book, 1.0), std::size_t{37});
    QVERIFY(!book.take("PBD1 1\nmore l0 10\nline 0 0 1 1", 1.0));
    for (int robot = 3; robot <= 64; ++robot) QVERIFY(book.take(layer(robot, 1, 2), 1.0));
    QVERIFY(!book.take(layer(65, 1, 2), 1.0));
    QCOMPARE(book.refused(), std::uint64_t{4});
    // What is gone makes room.
    QVERIFY(book.take(layer(65, 1, 2), 12.0));
  }

  // Live: bare drawings, drawings behind messages, mistakes; the file and the memory replay what
  // was seen.
  void liveShowsAndReplaysThem() {
    LiveOptions options = freeOptions(2);
    const std::string path = m_folder.filePath("live.mcap").toStdString();
    LiveWatch watch(options);
    QTRY_COMPARE(watch.details().network.ports.size(), std::size_t{3});
    auto recorder = LiveRecorder::create(path, options, watch.began());
    QVERIFY(recorder);
    const auto memory = std::make_shared<LiveMemory>(options.refereePort);
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
    QCOMPARE(screen->last().robots[0].health->errorCount, std::uint64_t{0});
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

  // What docs/DRAWINGS.md shows is what runs here.
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
    QFile guide(PITCHBOARD_SOURCE_DIR "/docs/DRAWINGS.md");
    QFile program(PITCHBOARD_SOURCE_DIR "/tests/end_to_end/" + file);
    QVERIFY(guide.open(QIODevice::ReadOnly) && program.open(QIODevice::ReadOnly));
    const QByteArray text = program.readAll();
    QVERIFY(guide.readAll().contains("```" + language.toUtf8() + "\n" + text + "```\n"));
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
    options.cognition = Cognition::External;
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
      const auto ofFile = recorded.frameAt(*session, time).drawings;
      QVERIFY(ofFile == remembered.at(*memory, time));
      drawn += ofFile.size();
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
  void aProgramThatNobodyStartedDraws() {
    MatchOptions options;
    options.cognition = Cognition::None;
    options.keyBase = m_base;
    auto match = SimulatedMatch::create(oneRobot(), options);
    QVERIFY2(match, match ? "" : match.error().text().c_str());
    QVERIFY(match->number());
    std::vector<HeardDrawing> heard;
    match->takeDrawings(heard);
    QVERIFY(match->drawings() && match->drawings()->problem().empty());
    const std::uint64_t hash = match->simulation().hash();
    QProcess program;
    program.setProcessChannelMode(QProcess::ForwardedChannels);
    program.start(QCoreApplication::applicationDirPath() + "/draw_robot",
                  {"1", "127.0.0.1", QString::number(match->number()->drawingPort())});
    QVERIFY(program.waitForStarted());
    const auto takes = [&] {
      match->takeDrawings(heard);
      return heard.size() >= 2;
    };
    QTRY_VERIFY_WITH_TIMEOUT(takes(), 30'000);
    program.kill();
    QVERIFY(program.waitForFinished());
    const auto drawn = match->drawings()->book().at(0.0);
    QCOMPARE(drawn.size(), std::size_t{1});
    QCOMPARE(drawn[0].layers.size(), std::size_t{2});
    QCOMPARE(match->simulation().hash(), hash);
  }
};

QTEST_GUILESS_MAIN(TestDrawings)
#include "tst_drawings.moc"
