// SPDX-License-Identifier: GPL-3.0-or-later
// How long notices stay, by a clock that the test sets.
#include <QPushButton>
#include <QtTest>

#include <ui/base/in_place_message.h>
#include <ui/base/notice_bar.h>

namespace tst_notice_bar {

using namespace pitchboard::ui;

namespace {

constexpr qint64 second = 1000;

struct Bar : NoticeBar {
  qint64 now = 0;
  Bar() {
    setClock([this] { return now; });
  }
  /// Whether a notice is shown at this time.
  bool isThere(qint64 at) {
    now = at;
    removeOver();
    return isVisible();
  }
};

const NoticeTopic saved{QStringLiteral("saved"), NoticeTone::Success};

}  // namespace

class TestNoticeBar : public QObject {
  Q_OBJECT
 private slots:
  // Reading a sentence and choosing takes longer than reading it.
  void aSuccessWithButtonsStaysHalfAMinute() {
    Bar bar;
    bar.show(saved, QStringLiteral("Saved."));
    QVERIFY(bar.isThere(8 * second - 1));
    QVERIFY(!bar.isThere(8 * second));
    bar.now = 100 * second;
    bar.show(saved, QStringLiteral("Saved: a.mcap"), {{QStringLiteral("Open in Replay"), {}}});
    QVERIFY(bar.isThere(130 * second - 1));
    QVERIFY(!bar.isThere(130 * second));
  }

  void theNextNoticeHasAllItsTime() {
    Bar bar;
    bar.show(saved, QStringLiteral("Saved."), {{QStringLiteral("Close"), {}}});
    bar.now = 29 * second;
    bar.show({QStringLiteral("match"), NoticeTone::Success}, QStringLiteral("Match restarted."),
             {{QStringLiteral("Undo"), {}}});
    QVERIFY(bar.isThere(59 * second - 1));
    QCOMPARE(bar.text(), QStringLiteral("Match restarted."));
    // The one behind it has been seen for 29 s only; it comes back and leaves by itself, too.
    QVERIFY(bar.isThere(59 * second));
    QCOMPARE(bar.text(), QStringLiteral("Saved."));
    QVERIFY(bar.isThere(89 * second - 1));
    QVERIFY(!bar.isThere(89 * second));
  }

  void troubleStaysUntilItIsClosed() {
    Bar bar;
    bar.show({QStringLiteral("disk")}, QStringLiteral("The disk is full."),
             {{QStringLiteral("Close"), {}}});
    QVERIFY(bar.isThere(3600 * second));
    QTest::mouseClick(bar.findChild<QPushButton*>(), Qt::LeftButton);
    QVERIFY(!bar.isVisible());
  }

  // The clock of a computer that slept goes on while the timer of the bar stood still, and the
  // other way round.
  void theTimerAsksTheClock() {
    Bar bar;
    bar.show(saved, QStringLiteral("Saved."));
    auto* timer = bar.findChild<QTimer*>();
    QCOMPARE(timer->interval(), 8000);
    bar.now = 5 * second;
    bar.removeOver();
    QVERIFY(bar.isVisible() && timer->isActive());
    QCOMPARE(timer->interval(), 3000);
  }

  void aListOfProblemsIsShort() {
    const QString a = QStringLiteral("a"), b = QStringLiteral("b"), c = QStringLiteral("c");
    QCOMPARE(shortListOf({}), QString());
    QCOMPARE(shortListOf({a, b, c}), QStringLiteral("a\nb\nc"));
    QCOMPARE(shortListOf({a, b, c, a, b}), QStringLiteral("a\nb\nc\n2 more like these"));
  }
};

PITCHBOARD_GUI_TEST(TestNoticeBar)

}  // namespace tst_notice_bar

#include "tst_notice_bar.moc"
