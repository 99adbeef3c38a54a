// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>
#include <cmath>
#include <set>

#include <base/angles.h>
#include <simcore/world/action.h>
#include <simcore/world/published_frame.h>

namespace tst_published_frame {

using namespace pitchboard;
using namespace pitchboard::sim;
namespace frame = pitchboard::sim::published_frame;

class TestPublishedFrame : public QObject {
  Q_OBJECT
 private slots:
  void placesWorkedOutByHand_data() {
    // Window cm and degrees, y down (system.md section 4), beside the studio's metres, y up.
    QTest::addColumn<double>("windowX");
    QTest::addColumn<double>("windowY");
    QTest::addColumn<double>("windowDegrees");
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::addColumn<double>("degrees");
    QTest::newRow("centre") << 520.0 << 370.0 << 0.0 << 0.0 << 0.0 << 0.0;
    QTest::newRow("top-left corner") << 70.0 << 70.0 << 90.0 << -4.5 << 3.0 << 90.0;
    QTest::newRow("bottom-right corner") << 970.0 << 670.0 << 270.0 << 4.5 << -3.0 << -90.0;
    QTest::newRow("magenta 1 of the match") << 720.0 << 170.0 << 180.0 << 2.0 << 2.0 << 180.0;
    QTest::newRow("left post") << 70.0 << 280.0 << 359.0 << -4.5 << 0.9 << -1.0;
  }
  void placesWorkedOutByHand() {
    QFETCH(double, windowX);
    QFETCH(double, windowY);
    QFETCH(double, windowDegrees);
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, degrees);
    const FieldSpec field;
    const Pose studio = frame::studioFromWindow(field, {windowX, windowY, windowDegrees});
    QVERIFY(std::abs(studio.position.x - x) < 1e-12);
    QVERIFY(std::abs(studio.position.y - y) < 1e-12);
    QVERIFY(std::abs(degreesFromRadians(studio.yaw) - degrees) < 1e-12);
    const auto window = frame::windowFromStudio(field, studio);
    QVERIFY(std::abs(window.x - windowX) < 1e-10);
    QVERIFY(std::abs(window.y - windowY) < 1e-10);
    QVERIFY(std::abs(window.degrees - windowDegrees) < 1e-10);

    const auto localization = frame::localizationFromStudio(field, studio);
    QVERIFY(std::abs(localization.x - (windowX - 70)) < 1e-10);
    QVERIFY(std::abs(localization.y - (windowY - 70)) < 1e-10);
    const Pose back = frame::studioFromLocalization(field, localization);
    QVERIFY(std::abs(back.position.x - x) < 1e-12 && std::abs(back.position.y - y) < 1e-12);
  }

  void speedsOfThePublishedTable_data() {
    // system.md section 3, turned into m/s and degrees per second at 60 frames/s by hand.
    QTest::addColumn<int>("code");
    QTest::addColumn<double>("forward");
    QTest::addColumn<double>("left");
    QTest::addColumn<double>("turn");
    QTest::newRow("walk forward, fast") << 1 << 0.18 << 0.0 << 0.0;
    QTest::newRow("turn left") << 2 << 0.0 << 0.0 << 18.0;
    QTest::newRow("turn right") << 3 << 0.0 << 0.0 << -18.0;
    QTest::newRow("walk left") << 6 << 0.0 << 0.12 << 0.0;
    QTest::newRow("walk right") << 7 << 0.0 << -0.12 << 0.0;
    QTest::newRow("walk forward, slow") << 8 << 0.09 << 0.0 << 0.0;
    QTest::newRow("around the ball, left") << 9 << 0.0 << 0.09 << -18.0;
    QTest::newRow("around the ball, right") << 14 << 0.0 << -0.09 << 18.0;
    QTest::newRow("walk backward, fast") << 17 << -0.18 << 0.0 << 0.0;
    QTest::newRow("walk backward, slow") << 18 << -0.09 << 0.0 << 0.0;
  }
  void speedsOfThePublishedTable() {
    QFETCH(int, code);
    QFETCH(double, forward);
    QFETCH(double, left);
    QFETCH(double, turn);
    const Action* action = findAction(code);
    QVERIFY(action != nullptr);
    QVERIFY(action->kind == ActionKind::Walk);
    QCOMPARE(QString::fromStdString(std::string(action->label)), QString(QTest::currentDataTag()));
    QVERIFY(std::abs(frame::mpsFromCmPerFrame(action->front) - forward) < 1e-12);
    QVERIFY(std::abs(frame::mpsFromCmPerFrame(action->drift) - left) < 1e-12);
    QVERIFY(std::abs(action->turn * frame::framesPerSecond - turn) < 1e-9);
  }

  void codesOutsideTheTableAreUnknown() {
    for (const int code : {-1, 23, 99, std::numeric_limits<int>::max()}) {
      QVERIFY(findAction(code) == nullptr);
      QCOMPARE(pitchboard::actionLabel(code), "action " + std::to_string(code));
    }
    std::set<std::string_view> label;
    for (int code = 0; code < 23; ++code) {
      QVERIFY(label.insert(findAction(code)->label).second);
      QCOMPARE(pitchboard::actionLabel(code), std::string(findAction(code)->label));
    }
    QCOMPARE(pitchboard::actionLabels().size(), label.size());
  }
};

PITCHBOARD_TEST(TestPublishedFrame)

}  // namespace tst_published_frame

#include "tst_published_frame.moc"
