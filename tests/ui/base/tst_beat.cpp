// SPDX-License-Identifier: GPL-3.0-or-later
#include <QEvent>
#include <QHBoxLayout>
#include <QtTest>
#include <memory>

#include <ui/base/beat.h>

namespace tst_beat {

using namespace pitchboard::ui;
using namespace std::chrono_literals;

namespace {

/// Counts what a window is asked to do.
struct Counter : QObject {
  explicit Counter(QEvent::Type counted) : type(counted) {}
  bool eventFilter(QObject* /*watched*/, QEvent* event) override {
    if (event->type() == type) ++count;
    return false;
  }
  QEvent::Type type;
  int count = 0;
};

constexpr auto never = std::chrono::hours(1);

}  // namespace

class TestBeat : public QObject {
  Q_OBJECT

 private slots:
  void allRequestsShareOneBeatAndOneRepaint() {
    Beat beat;
    QWidget window;
    auto* row = new QHBoxLayout(&window);
    QWidget* panels[] = {new QWidget(&window), new QWidget(&window), new QWidget(&window)};
    std::vector<std::unique_ptr<Beat::Part>> parts;
    for (QWidget* panel : panels) {
      row->addWidget(panel);
      parts.push_back(beat.add(panel, {}, [panel] { panel->update(); }));
    }
    window.resize(300, 100);
    window.show();
    QVERIFY(QTest::qWaitForWindowExposed(&window));
    QCoreApplication::processEvents();
    Counter repaints(QEvent::UpdateRequest);
    window.installEventFilter(&repaints);
    const quint64 before = beat.beats();
    for (auto& part : parts) {
      part->want();
      part->want();
    }
    QTRY_VERIFY(beat.isIdle() && repaints.count > 0);
    QCOMPARE(beat.beats(), before + 1);
    QCOMPARE(repaints.count, 1);
  }

  void noTimerRunsWithoutRequests() {
    Beat beat;
    int calls = 0;
    const auto part = beat.addSource([&calls] { ++calls; });
    QVERIFY(beat.isIdle());
    part->want();
    QVERIFY(!beat.isIdle());
    QTRY_COMPARE(calls, 1);
    QVERIFY(beat.isIdle());
    part->want();
    part->settle();
    QTRY_VERIFY(beat.isIdle());
    QCOMPARE(calls, 1);
  }

  void whatIsHiddenWaitsUntilItIsShown() {
    Beat beat;
    QWidget panel;
    int calls = 0;
    const auto part = beat.add(&panel, {}, [&calls] { ++calls; });
    part->want();
    QVERIFY(beat.isIdle());
    QCoreApplication::processEvents();
    QCOMPARE(calls, 0);
    panel.show();
    QTRY_COMPARE(calls, 1);
    QVERIFY(beat.isIdle());
  }

  void partsKeepTheirDistance() {
    Beat beat;
    int often = 0, seldom = 0;
    const auto source = beat.addSource([&often] { ++often; });
    const auto part = beat.add(nullptr, never, [&seldom] { ++seldom; });
    for (int i = 1; i <= 3; ++i) {
      source->want();
      part->want();
      QTRY_COMPARE(often, i);
    }
    QCOMPARE(seldom, 1);
    QVERIFY(!beat.isIdle());
  }

  // Also by one that stands before it.
  void newsAreShownInTheSameBeat() {
    Beat beat;
    std::vector<quint64> shown;
    const auto before = beat.add(nullptr, {}, [&] { shown.push_back(beat.beats()); });
    std::unique_ptr<Beat::Part> behind;
    const auto source = beat.addSource([&] {
      before->want();
      behind->want();
    });
    behind = beat.add(nullptr, {}, [&] { shown.push_back(beat.beats()); });
    source->want();
    QTRY_COMPARE(shown.size(), std::size_t{2});
    QCOMPARE(shown[0], shown[1]);
    QVERIFY(beat.isIdle());
  }

  void withoutRequestsItIsCalledSlowly() {
    Beat beat;
    int calls = 0;
    const auto part = beat.add(
        nullptr, {}, [&calls] { ++calls; }, 1ms);
    QTRY_VERIFY(calls >= 2);
  }

  void aPartMayGoDuringItsCall() {
    Beat beat;
    int calls = 0;
    std::unique_ptr<Beat::Part> gone, other;
    gone = beat.add(nullptr, {}, [&] { gone.reset(); });
    other = beat.add(nullptr, {}, [&calls] { ++calls; });
    gone->want();
    other->want();
    QTRY_COMPARE(calls, 1);
    QVERIFY(!gone);
    other->want();
    QTRY_COMPARE(calls, 2);
  }
};

PITCHBOARD_GUI_TEST(TestBeat)

}  // namespace tst_beat

#include "tst_beat.moc"
