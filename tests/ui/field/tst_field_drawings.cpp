// SPDX-License-Identifier: GPL-3.0-or-later
// Drawings of robots on the field.

#include <QAction>
#include <QMenu>
#include <QTest>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <robotlink/frame/drawing_origin.h>
#include <robotlink/frame/match_frame.h>
#include <telemetry/drawings/drawing_store.h>
#include <ui/base/theme.h>
#include <ui/field/field_view.h>

#include "../support/robot_keys.h"
#include "drawings_menu.h"
#include "hover_text.h"
#include "made_frames.h"

namespace tst_field_drawings {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace made_frames;

class TestFieldDrawings : public QObject {
  Q_OBJECT

  std::unique_ptr<FieldView> m_view;

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void init() {
    m_view = fieldOnScreen();
    QVERIFY(m_view->isVisible());
  }

  void cleanup() { m_view.reset(); }

  void aGhostCarriesItsNumber() {
    const auto ghost = [this](int number) {
      auto frame = frameOf(1);
      frame->robots[0].identity.number = number;
      believe(*frame, frame->robots[0], {{1.0, 0.0}, 0.0});
      m_view->showFrame(frame);
      return m_view->picture({1040, 740}).copy(620 - 12, 370 - 12, 24, 24);
    };
    const QImage four = ghost(4);
    QVERIFY(ghost(1) != four);
    QCOMPARE(ghost(4), four);
  }

  void drawingsAreShownByRobotAndLayer() {
    auto frame = frameOf(2);
    telemetry::DrawingStore store;
    QVERIFY(
        store.take("PBD1 1\nlayer plan\nline -4 -2 4 -2\nlayer seen robot\ncolour red\n"
                   "disc 1 0 0.3",
                   0.0));
    QVERIFY(store.take("PBD1 2\nlayer plan\nline -4 -2.5 4 -2.5", 0.0));
    const QSize size(1040, 740);
    m_view->showFrame(frame);
    const QImage without = m_view->picture(size);
    frame = std::make_shared<link::MatchFrame>(*frame);
    frame->drawings = store.at(0.0);
    link::keyDrawings(*frame);
    m_view->showFrame(frame);
    const QImage all = m_view->picture(size);
    QVERIFY(all != without);
    // 100 pixels are a metre: the line of robot 1, and the disc 1 m in front of it.
    const auto changed = [&](const QImage& image, double x, double y) {
      const QPoint p(520 + static_cast<int>(100 * x), 370 - static_cast<int>(100 * y));
      return image.pixel(p) != without.pixel(p);
    };
    const Pose& one = frame->robots[0].pose;
    const auto disc = [&](const QImage& image) {
      return changed(image, one.position.x + std::cos(one.yaw), one.position.y + std::sin(one.yaw));
    };
    QVERIFY(changed(all, 3.0, -2.0) && changed(all, 3.0, -2.5) && disc(all));

    auto* menu = m_view->findChild<DrawingsMenu*>();
    QVERIFY(menu);
    const auto toggle = [&](const QStringList& path) {
      emit menu->aboutToShow();
      QMenu* inside = menu;
      for (const QString& text : path) {
        const auto actions = inside->actions();
        const auto found = std::ranges::find_if(
            actions, [&](const QAction* action) { return action->text() == text; });
        if (found == actions.end()) return false;
        if ((*found)->menu() == nullptr) {
          (*found)->toggle();
        } else {
          inside = (*found)->menu();
        }
      }
      return true;
    };
    QVERIFY(toggle({"plan"}));  // of both
    QImage now = m_view->picture(size);
    QVERIFY(!changed(now, 3.0, -2.0) && !changed(now, 3.0, -2.5) && disc(now));
    QVERIFY(toggle({"plan"}));
    QVERIFY(toggle({"B1", "plan"}));
    now = m_view->picture(size);
    QVERIFY(!changed(now, 3.0, -2.0) && changed(now, 3.0, -2.5) && disc(now));
    QVERIFY(toggle({"B1", "Drawings of this robot"}));
    now = m_view->picture(size);
    QVERIFY(changed(now, 3.0, -2.5) && !disc(now));
    QVERIFY(toggle({"B1", "Drawings of this robot"}) && toggle({"B1", "plan"}));
    QCOMPARE(m_view->picture(size), all);
    QVERIFY(toggle({"Selected robots only"}));
    QCOMPARE(m_view->picture(size), without);
    m_view->select({inSlot(2)});
    now = m_view->picture(size);
    QVERIFY(changed(now, 3.0, -2.5) && !changed(now, 3.0, -2.0));
    m_view->select({});
    QVERIFY(toggle({"Selected robots only"}));
    m_view->actions().layers[std::size_t(FieldLayer::Drawings)]->setChecked(false);
    QCOMPARE(m_view->picture(size), without);
    m_view->actions().layers[std::size_t(FieldLayer::Drawings)]->setChecked(true);
    // A layer that counts from its robot goes with it.
    auto moved = std::make_shared<link::MatchFrame>(*frame);
    moved->robots[0].pose.position = {3.0, -3.0};
    moved->robots[0].pose.yaw = std::numbers::pi;
    m_view->showFrame(moved);
    QVERIFY(changed(m_view->picture(size), 2.0, -3.0));
    // What was not drawn is said in the menu.
    moved->drawingProblem = "drawing, line 2: no";
    emit menu->aboutToShow();
    QVERIFY(std::ranges::any_of(menu->actions(), [](const QAction* action) {
      return action->text().contains(QStringLiteral("line 2: no"));
    }));
  }
};

PITCHBOARD_GUI_TEST(TestFieldDrawings)

}  // namespace tst_field_drawings

#include "tst_field_drawings.moc"
