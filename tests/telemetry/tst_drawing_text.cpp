// SPDX-License-Identifier: GPL-3.0-or-later
// What robots' programs draw: the text and the store.

#include <QtTest>

#include <telemetry/drawings/drawing_store.h>
#include <telemetry/formats/text_protocol.h>

namespace tst_drawing_text {

using namespace pitchboard;
using telemetry::DrawingFrame;
using telemetry::DrawingLayer;
using telemetry::DrawingShape;
using telemetry::DrawingStore;
using telemetry::parseDrawing;
using telemetry::ShapeKind;

namespace {

std::size_t layersOf(const DrawingStore& store, double time) {
  std::size_t count = 0;
  for (const auto& robot : store.at(time)) count += robot.layers.size();
  return count;
}

}  // namespace

class TestDrawingText : public QObject {
  Q_OBJECT
 private slots:
  // Every number worked out by hand from docs/drawings.md.
  void readsTheExamplesOfTheGuide() {
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
    // Colour and width begin again in each layer.
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
    QTest::addColumn<QString>("hasText");
    const auto row = [](const char* name, const QString& text, int line, const char* hasText) {
      QTest::newRow(name) << text << line << QString::fromUtf8(hasText);
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
    QFETCH(QString, hasText);
    const auto drawing = parseDrawing(text.toStdString());
    QVERIFY(!drawing);
    QCOMPARE(drawing.error().context, "drawing, line " + std::to_string(line));
    QVERIFY2(QString::fromStdString(drawing.error().message).contains(hasText),
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
    DrawingStore store;
    QVERIFY(store.take("PBD1 1\nlayer a\npoint 0 0\nlayer b field 3\npoint 1 1", 10.0));
    QVERIFY(store.take("PBD1 2\nlayer a\npoint 5 5", 10.2, 2));
    QCOMPARE(layersOf(store, 9.9), std::size_t{0});
    QCOMPARE(layersOf(store, 10.0), std::size_t{2});
    QCOMPARE(layersOf(store, 10.5), std::size_t{3});
    QVERIFY((store.at(10.5).back().robot == RobotKey{2, 2}));
    QVERIFY(store.take("PBD1 1\nmore a\npoint 2 2", 10.5));
    QCOMPARE(store.at(10.6).front().layers.front()->shapes.size(), std::size_t{2});
    QVERIFY(store.take("PBD1 1\nlayer a\npoint 3 3", 10.7));
    const auto now = store.at(10.8).front().layers.front();
    QCOMPARE(now->shapes.size(), std::size_t{1});
    QVERIFY((now->shapes[0].points == std::vector<Point>{{3, 3}}));
    QCOMPARE(layersOf(store, 11.7), std::size_t{1});  // b has three seconds
    QCOMPARE(layersOf(store, 13.0), std::size_t{0});
    QVERIFY(store.take("PBD1 1\nlayer b", 11.0));
    QCOMPARE(layersOf(store, 11.1), std::size_t{2});
    // A robot that was put back to an earlier moment draws there.
    QVERIFY(store.take("PBD1 1\nlayer c\npoint 0 0", 2.0));
    QCOMPARE(layersOf(store, 2.1), std::size_t{1});
  }

  void pagesRestoreTheStore() {
    DrawingStore store, copy;
    QVERIFY(store.take("PBD1 1\nlayer a 5\nline 0 0 0.1 0.3\nlayer b robot 2\ndisc 0 0 1", 1.0));
    QVERIFY(store.take("PBD1 2\nlayer a belief 3\ncolour blue\ntext 0 0 hello", 1.5, 3));
    for (const DrawingStore::Page& page : store.pages(2.0))
      QVERIFY(copy.take(page.text, page.time, page.team));
    for (const double time : {2.0, 2.9, 3.1, 4.6, 6.1}) QVERIFY(copy.at(time) == store.at(time));
  }

  void aRobotCannotFillTheMemory() {
    DrawingStore store;
    const auto layer = [](int robot, int number, int points) {
      std::string text =
          "PBD1 " + std::to_string(robot) + "\nlayer l" + std::to_string(number) + " 10\nline";
      for (int i = 0; i < points; ++i) text += " 0 0";
      return text;
    };
    for (int i = 0; i < 5; ++i) QVERIFY(store.take(layer(1, i, 4000), 1.0));
    QVERIFY(!store.take(layer(1, 6, 2), 1.0));
    QVERIFY(QString::fromStdString(store.lastProblem()).contains("20000 points"));
    for (int i = 0; i < 32; ++i) QVERIFY(store.take(layer(2, i, 2), 1.0));
    QVERIFY(!store.take(layer(2, 33, 2), 1.0));
    QCOMPARE(layersOf(store, 1.0), std::size_t{37});
    QVERIFY(!store.take("PBD1 1\nmore l0 10\nline 0 0 1 1", 1.0));
    for (int robot = 3; robot <= 64; ++robot) QVERIFY(store.take(layer(robot, 1, 2), 1.0));
    QVERIFY(!store.take(layer(65, 1, 2), 1.0));
    QCOMPARE(store.refused(), std::uint64_t{4});
    // What is gone makes room.
    QVERIFY(store.take(layer(65, 1, 2), 12.0));
  }
};

PITCHBOARD_TEST(TestDrawingText)

}  // namespace tst_drawing_text

#include "tst_drawing_text.moc"
