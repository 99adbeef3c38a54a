// SPDX-License-Identifier: GPL-3.0-or-later
// What the field shows: nothing stays behind of what has moved, names can be read, beliefs and
// drawings are seen, the mouse gets an answer. With real events, and by comparing pictures.

#include <QAction>
#include <QGraphicsScene>
#include <QGraphicsView>
#include <QHelpEvent>
#include <QPainter>
#include <QTest>
#include <QToolTip>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <map>

#include <robotlink/frame/match_frame.h>
#include <telemetry/drawings/drawing_store.h>
#include <ui/base/theme.h>
#include <ui/field/field_view.h>

#include "../support/robot_keys.h"
#include "drawings_menu.h"
#include "field_background.h"
#include "field_picture.h"
#include "hover_text.h"
#include "live_items.h"
#include "made_frames.h"
#include "name_labels.h"
#include "robot_item.h"

namespace tst_field_look {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace made_frames;

namespace {}  // namespace

class TestFieldLook : public QObject {
  Q_OBJECT

  std::unique_ptr<FieldView> m_view;
  QGraphicsView* m_canvas = nullptr;

  QPoint at(const Point& p) const {
    return m_canvas->viewportTransform().map(QPointF(p.x, p.y)).toPoint();
  }
  void move(const QPoint& to, Qt::MouseButtons held) {
    QMouseEvent event(QEvent::MouseMove, QPointF(to),
                      m_canvas->viewport()->mapToGlobal(QPointF(to)), Qt::NoButton, held, {});
    QCoreApplication::sendEvent(m_canvas->viewport(), &event);
  }
  void wheel(const QPoint& point, int delta) {
    QWheelEvent event(QPointF(point), m_canvas->viewport()->mapToGlobal(QPointF(point)), {},
                      QPoint(0, delta), Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
    QCoreApplication::sendEvent(m_canvas->viewport(), &event);
  }
  /// What stands on the screen, painted piece by piece.
  QImage onScreen() {
    for (int i = 0; i < 4; ++i) QCoreApplication::processEvents();
    return m_view->screen()
        ->grabWindow(m_view->winId())
        .toImage()
        .convertToFormat(QImage::Format_RGB32);
  }
  /// The first pixel that a full repaint changes; empty: none.
  QString leftBehind() {
    const QImage shown = onScreen();
    m_canvas->viewport()->repaint();
    const QImage fresh = onScreen();
    if (shown.isNull() || shown.size() != fresh.size()) return QStringLiteral("no picture");
    constexpr int slack = 3;  // of smooth edges
    for (int y = 0; y < shown.height(); ++y) {
      for (int x = 0; x < shown.width(); ++x) {
        const QRgb a = shown.pixel(x, y), b = fresh.pixel(x, y);
        if (std::abs(qRed(a) - qRed(b)) > slack || std::abs(qGreen(a) - qGreen(b)) > slack ||
            std::abs(qBlue(a) - qBlue(b)) > slack) {
          return QStringLiteral("%1, %2: %3 instead of %4")
              .arg(x)
              .arg(y)
              .arg(QColor(a).name(), QColor(b).name());
        }
      }
    }
    return {};
  }

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void init() {
    m_view = fieldOnScreen();
    QVERIFY(m_view->isVisible());
    m_canvas = m_view->findChild<QGraphicsView*>();
  }

  void cleanup() { m_view.reset(); }

  // Panned, followed, zoomed, with words, rings, names, drawings and the focus frame: after every
  // step the screen is what a full repaint shows.
  void nothingStaysBehind_data() {
    QTest::addColumn<int>("zoom");
    QTest::newRow("fitted") << 0;
    QTest::newRow("far") << -8;
    QTest::newRow("near") << 12;
  }
  void nothingStaysBehind() {
    QFETCH(int, zoom);
    auto frame = frameOf(8);
    frame->ballKnown = true;
    frame->robots[1].fallen = true;
    frame->robots[2].link.emplace();
    frame->robots[2].link->timedOut = true;
    frame->robots[2].link->age = std::chrono::seconds(12345);
    frame->robots[3].penalty = link::Penalty{PenaltyKind::Pushing, 20};
    believe(*frame, frame->robots[4], {{2.5, 2.0}, 1.0});
    frame->teamBalls = {{TeamColor::Blue, {1.0, -1.0}, 0.2, 2, 3},
                        {TeamColor::Red, {-2.0, 1.0}, 0.4, 4, 4}};
    telemetry::DrawingStore store;
    QVERIFY(
        store.take("PBD1 1\nlayer a robot\narrow 0 0 1 0.5\ntext 0.5 0.5 a rather long text\n"
                   "width 12\npolygon 0 0 0.5 0.5 1 -0.5\nlayer b\ndisc -2 -2 0.7",
                   0.0));
    frame->drawings = store.at(0.0);
    for (QAction* layer : m_view->actions().layers) layer->setChecked(true);
    m_view->showFrame(frame);
    m_view->select({inSlot(1), inSlot(2)});
    const QPoint middle = m_canvas->viewport()->rect().center();
    for (int i = 0; i < std::abs(zoom); ++i) wheel(middle, zoom > 0 ? 120 : -120);
    QCOMPARE(leftBehind(), QString());

    QTest::mousePress(m_canvas->viewport(), Qt::MiddleButton, {}, middle);
    for (const QPoint step : {QPoint(13, 5), QPoint(40, -30), QPoint(-60, 90), QPoint(7, 7)}) {
      move(middle + step, Qt::MiddleButton);
      const QString left = leftBehind();
      QVERIFY2(left.isEmpty(), qPrintable(QStringLiteral("panned: ") + left));
    }
    QTest::mouseRelease(m_canvas->viewport(), Qt::MiddleButton, {}, middle);

    for (const bool follow : {false, true}) {
      m_view->follow(follow ? std::optional(inSlot(2)) : std::nullopt);
      for (int step = 0; step < 5; ++step) {
        auto next = std::make_shared<link::MatchFrame>(*frame);
        next->serial += 1;
        next->snapshot.time += 0.1;
        for (link::RobotFrame& robot : next->robots) {
          robot.pose.position.x += 0.13;
          robot.pose.position.y -= 0.08;
          robot.pose.yaw += 0.3;
        }
        next->snapshot.ball.x += 0.3;
        next->teamBalls[0].position.y += 0.2;
        frame = next;
        m_view->showFrame(frame);
        const QString left = leftBehind();
        QVERIFY2(left.isEmpty(), qPrintable(QStringLiteral("followed: ") + left));
      }
    }
    for (const auto& ids : {std::vector<RobotUid>{}, {inSlot(3)}, {inSlot(4), inSlot(8)}}) {
      m_view->select(ids);
      const QString left = leftBehind();
      QVERIFY2(left.isEmpty(), qPrintable(QStringLiteral("selected: ") + left));
    }
    auto empty = std::make_shared<link::MatchFrame>(*frame);
    empty->robots.resize(3);
    empty->teamBalls.clear();
    empty->drawings.clear();
    m_view->showFrame(empty);
    QCOMPARE(leftBehind(), QString());
  }

  void namesOfACrowdAreAllRead_data() {
    QTest::addColumn<int>("robots");
    QTest::addColumn<double>("apart");
    QTest::addColumn<double>("radius");
    QTest::newRow("a heap") << 11 << 9.0 << 10.0;
    QTest::newRow("a row") << 22 << 6.0 << 5.0;
    QTest::newRow("two on one place") << 2 << 0.0 << 12.0;
    QTest::newRow("small ones") << 6 << 40.0 << 4.0;
  }
  /// Of several sessions at the same place: the first below, the second above, and so on.
  void comparedNamesDoNotLieOnEachOther() {
    const QSizeF size(30.0, 9.0);
    std::vector<NamedRobot> robots;
    for (int i = 0; i < 6; ++i) robots.push_back({inSlot(i + 1), {100.0, 100.0}, 12.0, size});
    DirectionsBefore before;
    const auto boxes = [&] {
      std::vector<QRectF> all;
      for (const PlacedName& name : placeNamesBelow(robots, before)) {
        QRectF box(QPointF(), size);
        box.moveCenter(name.centre);
        all.push_back(box);
      }
      return all;
    };
    const std::vector<QRectF> placed = boxes();
    QCOMPARE(placed.size(), robots.size());
    QVERIFY(placed[0].top() > 112.0 && placed[0].top() < 120.0);
    QVERIFY(placed[1].bottom() < 88.0 && placed[1].bottom() > 80.0);
    for (std::size_t a = 0; a < placed.size(); ++a) {
      for (std::size_t b = a + 1; b < placed.size(); ++b) QVERIFY(!placed[a].intersects(placed[b]));
    }
    // While one robot goes past the others no name jumps: each moves with its robot.
    robots.resize(2);
    for (double x = 60.0; x <= 140.0; x += 4.0) {
      robots[1].at.setX(x);
      const std::vector<QRectF> now = boxes();
      QCOMPARE(now[0], placed[0]);
      QCOMPARE(now[1].translated(100.0 - x, 0.0), placed[1]);
    }
    // One that is alone has its name below it.
    before.clear();
    robots[1].at = {300.0, 100.0};
    QVERIFY(boxes()[1].top() > 112.0);
  }

  void namesOfACrowdAreAllRead() {
    QFETCH(int, robots);
    QFETCH(double, apart);
    QFETCH(double, radius);
    std::vector<NamedRobot> crowd;
    for (int i = 0; i < robots; ++i) {
      crowd.push_back({inSlot(i + 1), {apart * i, 3.0 * (i % 3)}, radius, {18.0, 9.0}});
    }
    std::map<RobotUid, int> before;
    const auto placed = placeNames(crowd, {}, before);
    QCOMPARE(placed.size(), crowd.size());
    const auto box = [](const PlacedName& name) {
      return QRectF(name.centre.x() - 9.0, name.centre.y() - 4.5, 18.0, 9.0);
    };
    for (std::size_t a = 0; a < placed.size(); ++a) {
      for (std::size_t b = a + 1; b < placed.size(); ++b) {
        QVERIFY(!box(placed[a]).intersects(box(placed[b])));
      }
      for (const NamedRobot& robot : crowd) {
        const QRectF name = box(placed[a]);
        const double x = std::clamp(robot.at.x(), name.left(), name.right());
        const double y = std::clamp(robot.at.y(), name.top(), name.bottom());
        QVERIFY(std::hypot(x - robot.at.x(), y - robot.at.y()) >= radius - 0.01);
      }
    }
    // They do not jump about when everybody has moved a little.
    for (NamedRobot& robot : crowd) robot.at += QPointF(0.2, 0.1);
    const auto again = placeNames(crowd, {}, before);
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const QPointF way = again[i].centre - placed[i].centre;
      QVERIFY(std::hypot(way.x(), way.y()) < 1.0);
    }
  }

  void labelsOfACrowdHideNoRobot() {
    std::vector<NamedRobot> crowd;
    for (const QPointF at : {QPointF(0, 0), QPointF(30, 2), QPointF(62, 0), QPointF(30, 32)}) {
      crowd.push_back({inSlot(static_cast<int>(crowd.size()) + 1), at, 9.0, {}, {80.0, 14.0}});
    }
    const QRectF area(-200, -200, 460, 246);
    std::map<RobotUid, int> before;
    const auto placed = placeTags(crowd, area, before);
    QCOMPARE(placed.size(), crowd.size());
    std::vector<QRectF> boxes;
    for (const PlacedName& word : placed) {
      const QRectF box(word.centre - QPointF(40, 7), QSizeF(80, 14));
      QVERIFY(area.contains(box));
      for (const QRectF& other : boxes) QVERIFY(!box.intersects(other));
      for (const NamedRobot& robot : crowd) {
        const QRectF disc(robot.at - QPointF(9, 9), QSizeF(18, 18));
        QVERIFY(!box.intersects(disc));
      }
      boxes.push_back(box);
    }
    // Names keep off them.
    std::map<RobotUid, int> none;
    const std::vector<NamedRobot> two{{inSlot(1), {0, 0}, 4.0, {18.0, 9.0}}};
    const QRectF taken(-40, -20, 80, 14);
    const QPointF name = placeNames(two, {}, none, {taken})[0].centre;
    QVERIFY(!taken.intersects(QRectF(name - QPointF(9, 4.5), QSizeF(18, 9))));
  }

  void robotsSideBySideShareALabel() {
    // Four who are penalised stand at the touch line, and another one far from them.
    std::vector<NamedRobot> all;
    for (const double x : {0.0, 36.0, 72.0, 108.0, 400.0}) {
      const int number = static_cast<int>(all.size()) + 1;
      all.push_back({inSlot(number), {x, 0}, 12.0, {}, {70.0, 15.0}, "penalised"});
    }
    const QRectF area(-100, -300, 700, 340);
    std::map<RobotUid, int> before;
    const auto placed = placeTags(all, area, before);
    QCOMPARE(placed.size(), std::size_t{2});
    QCOMPARE(placed[0].id, inSlot(1));
    QCOMPARE(placed[0].centre.x(), 54.0);
    QCOMPARE(placed[1].id, inSlot(5));
    const QRectF box(placed[0].centre - QPointF(35, 7.5), QSizeF(70, 15));
    QVERIFY(area.contains(box));
    for (const NamedRobot& robot : all) {
      QVERIFY(!box.intersects(QRectF(robot.at - QPointF(12, 12), QSizeF(24, 24))));
    }
    // What differs is said of each.
    for (std::size_t i = 0; i < all.size(); ++i) all[i].tagText = QString("timeout %1 s").arg(i);
    before.clear();
    QCOMPARE(placeTags(all, area, before).size(), all.size());
  }

  void namesAtTheEdgeAreWhole() {
    // Small robots in the corners and at the middle of every edge of what is shown.
    const QRectF area(-200, -150, 400, 300);
    std::vector<NamedRobot> edge;
    for (const double x : {area.left(), 0.0, area.right()}) {
      for (const double y : {area.top(), 0.0, area.bottom()}) {
        edge.push_back({inSlot(static_cast<int>(edge.size()) + 1), {x, y}, 4.0, {18.0, 9.0}});
      }
    }
    std::map<RobotUid, int> before;
    const auto placed = placeNames(edge, area, before);
    QCOMPARE(placed.size(), edge.size());
    for (const PlacedName& name : placed) {
      QVERIFY(area.contains(QRectF(name.centre - QPointF(9, 4.5), QSizeF(18, 9))));
    }
  }

  void numbersOfTheGridAreWhole() {
    FieldStyle style;
    const QRectF area(0, 0, 640, 480);
    // Every place of the grid's lines relative to the edges, as if it was dragged along.
    for (const double shift : {0.0, 1.0, 3.0, 7.0, 12.0, 25.0, 60.0}) {
      const QTransform view(150, 0, 0, -150, 320 + shift, 240 + shift);
      const auto labels = gridLabels(style, view, area);
      QVERIFY(labels.size() > 8);
      for (const GridLabel& label : labels) {
        QVERIFY2(area.contains(label.box), qPrintable(label.text));
      }
    }
    // All of the field: the numbers of both touch lines and of both goal lines.
    const QTransform whole(50, 0, 0, -50, 320, 240);
    QStringList texts;
    for (const GridLabel& label : gridLabels(style, whole, area)) texts << label.text;
    for (const char* text : {"4", "−4", "0", "3", "−3"}) QVERIFY(texts.contains(text));
  }

  void aNumberThatCanBeReadNeedsNoName() {
    std::map<RobotUid, int> before;
    const std::vector<NamedRobot> robots{{inSlot(1), {0, 0}, 10.0, {18.0, 9.0}},
                                         {inSlot(2), {21, 0}, 10.0, {18.0, 9.0}}};
    QVERIFY(placeNames(robots, {}, before).empty());
  }

  void anUnsureBeliefCoversLess() {
    // The colour of the ground a little beside the robot, for growing uncertainty.
    double before = 1e9;
    for (const float sigma : {40.0F, 80.0F, 200.0F, 400.0F}) {
      auto frame = frameOf(1);
      frame->robots[0].pose.position = {0.0, 1.0};
      believe(*frame, frame->robots[0], frame->robots[0].pose);
      for (QAction* layer : m_view->actions().layers) layer->setChecked(false);
      m_view->showFrame(frame);
      const QSize size(1040, 740);
      const QImage without = m_view->picture(size);
      frame = std::make_shared<link::MatchFrame>(*frame);
      frame->robots[0].sigma = static_cast<double>(sigma) / 100.0;
      m_view->actions().layers[std::size_t(FieldLayer::Belief)]->setChecked(true);
      m_view->showFrame(frame);
      const QImage with = m_view->picture(size);
      const QPoint beside(520 + 24, 370 - 100 + 12);
      const QColor a(without.pixel(beside)), b(with.pixel(beside));
      const double covers = std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) +
                            std::abs(a.blue() - b.blue());
      QVERIFY2(covers < before, qPrintable(QStringLiteral("%1 at %2").arg(covers).arg(sigma)));
      before = covers;
    }
    QVERIFY(before <= 12.0);
  }

  /// Pictures and videos have no window round them that shows the scoreboard.
  void picturesTellThePartOfTheGame() {
    link::MatchFrame frame;
    frame.origin = link::FrameOrigin::Live;
    Game& game = frame.game.emplace();
    game.teams[0].number = 12;
    game.teams[1].number = 7;
    game.teams[0].colour = TeamColor::Blue;
    game.teams[1].colour = TeamColor::Red;
    game.teams[0].score = 10;
    game.state = PlayState::Playing;
    game.half = 2;
    game.phase = GamePhase::ExtraTime;
    game.clock = static_cast<int>((3600 + 12 * 60 + 5) * game.tickRate);
    game.restart.kind = SetPlay::DirectFreeKick;
    game.restart.step = Restart::Step::Placing;
    game.restart.team = 0;
    const QFontMetricsF metrics(themeFont(TypeRole::Secondary, true));
    const QString text = pictureCaption(frame, metrics, 2000);
    for (const char* part : {"BLUE  10 : 0  RED", "72:05", "ET 2", "PLAYING", "direct free kick"}) {
      QVERIFY2(text.contains(QLatin1String(part)), qPrintable(text));
    }
    game.phase = GamePhase::ShootOut;
    QVERIFY(pictureCaption(frame, metrics, 2000).contains(QStringLiteral("PEN")));
    // With less room the state is shorter, and what is left fits.
    const double room = 0.8 * metrics.horizontalAdvance(text);
    const QString shorter = pictureCaption(frame, metrics, room);
    QVERIFY2(metrics.horizontalAdvance(shorter) <= room, qPrintable(shorter));
    QVERIFY2(shorter.contains(QStringLiteral("10 : 0")) && shorter != text, qPrintable(shorter));
  }

  void aHeatMapIsDrawnUntilItIsTakenAway() {
    auto frame = frameOf(1);
    for (QAction* layer : m_view->actions().layers) layer->setChecked(false);
    m_view->showFrame(frame);
    const QSize size(1040, 740);
    const QImage without = m_view->picture(size);
    auto heat = std::make_shared<BallHeat>(BallHeat{36, 24, std::vector<float>(864)});
    heat->cells[12 * 36 + 27] = 0.5F;  // x 2.25 to 2.5 m, y 0 to 0.25 m
    m_view->showHeat(heat);
    QCOMPARE(m_view->picture(size), without);  // its layer is off
    m_view->actions().layers[std::size_t(FieldLayer::Exploration)]->setChecked(true);
    const QImage now = m_view->picture(size);
    const QColor warm(now.pixel(520 + 237, 370 - 12)), grass(without.pixel(520 + 237, 370 - 12));
    QVERIFY(warm.red() > grass.red() + 60 && warm.green() > grass.green() + 30);
    QCOMPARE(leftBehind(), QString());
    m_view->showHeat(nullptr);
    QCOMPARE(m_view->picture(size), without);
  }

  void aFarGhostIsJoinedToItsRobot() {
    const auto lineAt = [this](double away) {
      auto frame = frameOf(1);
      frame->robots[0].pose = {{0.0, 2.0}, 0.0};
      believe(*frame, frame->robots[0], {{0.0, 2.0 - away}, 0.0});
      for (QAction* layer : m_view->actions().layers) layer->setChecked(false);
      m_view->actions().layers[std::size_t(FieldLayer::Ghost)]->setChecked(true);
      m_view->showFrame(frame);
      const QImage ghost = m_view->picture(QSize(1040, 740));
      m_view->actions().layers[std::size_t(FieldLayer::Ghost)]->setChecked(false);
      const QImage none = m_view->picture(QSize(1040, 740));
      const int y = 370 - static_cast<int>(100 * (2.0 - away / 2));
      return ghost.copy(515, y, 10, 1) != none.copy(515, y, 10, 1);
    };
    QVERIFY(lineAt(1.5));
    QVERIFY(lineAt(0.55));
    QVERIFY(!lineAt(0.47));
  }

  void theMouseIsAnswered() {
    auto frame = frameOf(2);
    frame->robots[0].pose = {{0.0, 0.0}, 0.0};
    believe(*frame, frame->robots[0], {{0.3, 0.4}, 0.5});
    frame->robots[0].ownName = "Lea";
    auto path = std::make_shared<link::PlannedPath>();
    path->points = {{0.0, 0.0}, {1.25, -0.5}};
    frame->robots[0].cognitionDebug = link::CognitionDebug{RobotId{1}, nullptr, path, 0.0, 0.0};
    m_view->showFrame(frame);
    const QString text = hoverText(*frame, inSlot(1));
    for (const char* part : {"B1 Lea · Striker", "Action: stop", "Target: x 1.25 m",
                             "Belief: 50 cm and 29° off, σ 30 cm"}) {
      QVERIFY2(text.contains(QString::fromUtf8(part)), qPrintable(text));
    }
    const QPoint place = at({0.0, 0.0});
    QHelpEvent help(QEvent::ToolTip, place, m_canvas->viewport()->mapToGlobal(place));
    QCoreApplication::sendEvent(m_canvas->viewport(), &help);
    QCOMPARE(QToolTip::text(), text);
    const QPoint ground = at({0.0, -3.0});
    QHelpEvent beside(QEvent::ToolTip, ground, m_canvas->viewport()->mapToGlobal(ground));
    QCoreApplication::sendEvent(m_canvas->viewport(), &beside);
    QTRY_VERIFY(!QToolTip::isVisible());
    QVERIFY(hoverText(*frame, inSlot(17)).isEmpty());
  }

  // By the formula of the Web Content Accessibility Guidelines, 4.5 for small text: the lightest
  // and the most frequent colour of the words' plate, as painted on the grass.
  void tagsAreReadOnGrass_data() {
    QTest::addColumn<ThemeChoice>("choice");
    QTest::addColumn<bool>("ofTheBall");
    QTest::newRow("timeout, dark") << ThemeChoice::Dark << false;
    QTest::newRow("timeout, light") << ThemeChoice::Light << false;
    QTest::newRow("n of n agree, dark") << ThemeChoice::Dark << true;
    QTest::newRow("n of n agree, light") << ThemeChoice::Light << true;
  }
  void tagsAreReadOnGrass() {
    QFETCH(ThemeChoice, choice);
    QFETCH(bool, ofTheBall);
    setTheme(*qApp, choice);
    const auto restore = qScopeGuard([] { setTheme(*qApp, ThemeChoice::Dark); });
    constexpr double scale = 60.0;  // px per metre
    FieldStyle style;
    style.pixelsPerMetre = scale;
    QGraphicsScene scene;
    QPointF centre;
    QSizeF plate;
    if (ofTheBall) {
      auto* ball = new TeamBallsItem(&style);
      link::TeamBall agreed;
      agreed.agree = 3;
      agreed.see = 4;
      agreed.spread = 0.2;
      ball->setBalls({agreed});
      scene.addItem(ball);
      plate = plateSize(QStringLiteral("3 of 4 agree"));
      centre = {0, -(std::max(0.2, style.ballDrawRadius() + style.metres(5.0)) * scale) - 12};
    } else {
      RobotLook look;
      look.tag = QStringLiteral("timeout 37 s");
      look.opacity = 0.45;
      auto* robot = new RobotItem(&style, inSlot(1));
      robot->setLook(look);
      centre = {0, 40};
      robot->setTagPosition(centre);
      scene.addItem(robot);
      plate = plateSize(look.tag);
    }
    QImage image(300, 200, QImage::Format_RGB32);
    image.fill(theme().grass);
    QPainter painter(&image);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.translate(150, 100);
    painter.scale(scale, -scale);
    const QRectF source(-150 / scale, -100 / scale, 300 / scale, 200 / scale);
    scene.render(&painter, source, source, Qt::IgnoreAspectRatio);
    painter.end();
    std::map<QRgb, int> counted;
    const QRect box =
        QRectF(QPointF(150, 100) + centre - QPointF(plate.width(), plate.height()) / 2, plate)
            .toAlignedRect()
            .adjusted(1, 3, -1, -3);
    for (int y = box.top(); y <= box.bottom(); ++y) {
      for (int x = box.left(); x <= box.right(); ++x) ++counted[image.pixel(x, y)];
    }
    const auto luminance = [](QRgb rgb) {
      const auto linear = [](int eighth) {
        const double c = eighth / 255.0;
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
      };
      return 0.2126 * linear(qRed(rgb)) + 0.7152 * linear(qGreen(rgb)) +
             0.0722 * linear(qBlue(rgb));
    };
    const auto ground =
        std::ranges::max_element(counted, {}, [](const auto& c) { return c.second; });
    const auto ink =
        std::ranges::max_element(counted, {}, [&](const auto& c) { return luminance(c.first); });
    QVERIFY(QColor(ground->first) != theme().grass);
    const double contrast = (luminance(ink->first) + 0.05) / (luminance(ground->first) + 0.05);
    QVERIFY2(contrast >= 4.5,
             qPrintable(QStringLiteral("%1: %2 on %3")
                            .arg(contrast)
                            .arg(QColor(ink->first).name(), QColor(ground->first).name())));
  }
};

PITCHBOARD_GUI_TEST(TestFieldLook)

}  // namespace tst_field_look

#include "tst_field_look.moc"
