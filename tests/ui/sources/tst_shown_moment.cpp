// SPDX-License-Identifier: GPL-3.0-or-later
// The moment that is shown, of every kind of source that what a source states allows.
#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include <ui/sources/linked_time.h>
#include <ui/sources/shown_moment.h>

namespace tst_shown_moment {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

/// Says whatever its row says, and holds the moments from 0 to 10 s.
class Source : public FrameSource {
 public:
  explicit Source(const SourceKind& kind) : m_kind(kind) {}
  const SourceKind& kind() const override { return m_kind; }
  FramePtr frame() const override { return m_frame; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override { return nullptr; }
  QString emptyText() const override { return {}; }
  std::optional<telemetry::TimeRange> available() const override { return held; }
  FramePtr frameAt(double time) const override { return m_kind.hasPresent ? at(time) : nullptr; }
  double standsAt() const override { return m_frame->snapshot.time; }
  void standAt(double time) override { goTo(time); }
  void goTo(double time) {
    m_frame = at(time);
    emit frameReceived(m_frame);
  }

  std::optional<telemetry::TimeRange> held = telemetry::TimeRange{0.0, 10.0};

 private:
  static FramePtr at(double time) {
    auto frame = std::make_shared<link::MatchFrame>();
    frame->snapshot.time = time;
    return frame;
  }
  SourceKind m_kind;
  FramePtr m_frame = at(10.0);
};

SourceKind recording() {
  return {.name = "A tape", .hasPresent = false};
}

double seen(const ShownMoment& shown) {
  return shown.frame()->snapshot.time;
}

}  // namespace

class TestShownMoment : public QObject {
  Q_OBJECT
 private slots:
  // A fourth kind of source needs nothing but its row.
  void aSourceIsShownAsItStates_data() {
    QTest::addColumn<bool>("hasPresent");
    QTest::addColumn<bool>("hasPast");
    for (const bool hasPresent : {true, false}) {
      for (const bool hasPast : {true, false}) {
        QTest::addRow("present %d past %d", hasPresent, hasPast) << hasPresent << hasPast;
      }
    }
  }
  void aSourceIsShownAsItStates() {
    QFETCH(bool, hasPresent);
    QFETCH(bool, hasPast);
    Source source({.name = "Fourth", .hasPresent = hasPresent, .hasPast = hasPast});
    ShownMoment shown(&source);
    QCOMPARE(shown.chosenTime().has_value(), !hasPresent);
    QCOMPARE(shown.time(), 10.0);
    shown.seek(4.0);
    const bool isThere = hasPast || !hasPresent;
    QCOMPARE(seen(shown), isThere ? 4.0 : 10.0);
    QCOMPARE(shown.time(), isThere ? 4.0 : 10.0);
    QCOMPARE(shown.isLookingBack(), hasPresent && hasPast);
    shown.goLive();
    QCOMPARE(seen(shown), hasPresent ? 10.0 : 4.0);
    QVERIFY(!shown.isLookingBack());
  }

  void aRecordingPlaysAtItsSpeedAndPausesAtItsEnd() {
    Source source(recording());
    source.held.reset();
    ShownMoment shown(&source);
    shown.setPaused(false);
    QVERIFY(shown.isPaused());  // there is nothing
    source.held = telemetry::TimeRange{0.0, 10.0};
    shown.seek(2.0);
    shown.setSpeed(4);
    shown.setPaused(false);
    shown.advance(0.5);
    QCOMPARE(seen(shown), 4.0);
    shown.advance(100);
    QCOMPARE(seen(shown), 10.0);
    QVERIFY(shown.isPaused());
    // From the very end it begins again.
    shown.setPaused(false);
    QCOMPARE(seen(shown), 0.0);
    shown.setSpeed(1000);
    QCOMPARE(shown.speed(), 16.0);
    shown.setSpeed(0.0001);
    QCOMPARE(shown.speed(), 0.1);
    shown.setSpeed(double(NAN));
    QCOMPARE(shown.speed(), 0.1);
  }

  void aRangeIsRepeated() {
    Source source(recording());
    ShownMoment shown(&source);
    shown.setSelection({{5, 7}});
    shown.setLooping(true);
    QCOMPARE(seen(shown), 5.0);
    shown.seek(6);
    shown.setPaused(false);
    shown.advance(1.25);
    QCOMPARE(seen(shown), 5.25);
    shown.advance(0.5);
    QCOMPARE(seen(shown), 5.75);
    shown.setSelection({{5, 5}});
    QVERIFY(!shown.isLooping() && !shown.selection());
  }

  void stepsGoFromTickToTick() {
    Source source(recording());
    ShownMoment shown(&source);
    shown.seek(1.003);
    shown.setPaused(false);
    shown.step(1);
    QVERIFY(shown.isPaused());
    QCOMPARE(seen(shown), 61.0 / 60);
    shown.step(-2);
    QCOMPARE(seen(shown), 59.0 / 60);
    shown.seek(0);
    shown.step(-1);
    QCOMPARE(seen(shown), 0.0);
  }

  // A recording stands where it was left; what goes on is followed again.
  void eachSourceHasItsMoment() {
    Source match({.name = "Match"}), tape(recording());
    ShownMoment shown(&match);
    QSignalSpy chosen(&shown, &ShownMoment::sourceChosen);
    shown.add(&tape);
    shown.seek(3.0);
    QVERIFY(shown.isLookingBack());
    shown.choose(&tape);
    QCOMPARE(chosen.size(), 1);
    QCOMPARE(shown.time(), 10.0);
    shown.seek(7.0);
    shown.setPaused(false);
    shown.choose(&match);
    QVERIFY(shown.isPaused() && !shown.chosenTime());
    shown.choose(&tape);
    QCOMPARE(shown.time(), 7.0);
    QCOMPARE(shown.find(match.kind()), static_cast<FrameSource*>(&match));
  }

  void whatHasLeftMemoryIsNotShown() {
    Source source({.name = "Match"});
    ShownMoment shown(&source);
    shown.seek(2.0);
    QSignalSpy moved(&shown, &ShownMoment::moved);
    source.held = telemetry::TimeRange{5.0, 15.0};
    source.goTo(15.0);
    QCOMPARE(seen(shown), 5.0);
    QCOMPARE(moved.size(), 1);
    // While it stands still, news of the source are no news of the moment.
    source.goTo(15.1);
    QCOMPARE(moved.size(), 1);
    QCOMPARE(shown.now(), 15.1);
  }

  // Without anybody who draws it.
  void theAxisFollowsTheMoment() {
    Source source({.name = "Match"});
    ShownMoment shown(&source);
    LinkedTime time(&shown);
    time.setWindow(2.0);
    for (const double moment : {1.0, 9.0, 4.0}) {
      shown.seek(moment);
      QCOMPARE(time.playhead(), std::optional(moment));
      QVERIFY(time.range().begin <= moment && time.range().end >= moment);
    }
    shown.goLive();
    QVERIFY(!time.playhead());  // there are no rows
  }
};

PITCHBOARD_GUI_TEST(TestShownMoment)

}  // namespace tst_shown_moment

#include "tst_shown_moment.moc"
