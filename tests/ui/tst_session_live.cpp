// SPDX-License-Identifier: GPL-3.0-or-later
// What is heard live is recorded and saved from memory, through the window; real sockets.
#include <algorithm>

#include <telemetry/session/session_reader.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/replay_controller.h>

#include "live_rig.h"
#include "session_rig.h"

using namespace pitchboard;
using namespace pitchboard::ui;
using live_rig::Robot;
using session_rig::Studio;

class TestSessionLive : public QObject {
  Q_OBJECT

  /// Two robots are heard for a while.
  static bool hear(Studio& s, const link::LiveOptions& options) {
    s.window.live()->setOptions(options);
    s.window.showSource(SourceKind::Live);
    const bool bound = QTest::qWaitFor(
        [&s] {
          const auto ports = s.window.live()->details().network.ports;
          return !ports.empty() && std::all_of(ports.begin(), ports.end(),
                                               [](const auto& port) { return port.bound; });
        },
        10'000);
    return bound && talk(s, options, 10);
  }
  static bool talk(Studio& s, const link::LiveOptions& options, int times) {
    const Robot one(options, 1), two(options, 2);
    LiveController* live = s.window.live();
    for (int i = 0; i < times; ++i) {
      const double before = live->frame() ? live->frame()->snapshot.time : -1.0;
      if (!one.say() || !two.say()) return false;
      const bool heard = QTest::qWaitFor(
          [live, before] {
            return live->frame() && live->frame()->robots.size() == 2 &&
                   live->frame()->snapshot.time > before;
          },
          10'000);
      if (!heard) return false;
    }
    return true;
  }
  static void check(const QString& path) {
    const auto session = telemetry::SessionReader::open(path.toStdString());
    QVERIFY2(session.has_value(), qPrintable(path));
    QVERIFY(session->complete());
    QCOMPARE(session->info().source, std::string("live"));
    QVERIFY(session->range().has_value());
    int rows = 0;
    session->rows(*session->range(), {}, [&rows](telemetry::GroupId, const telemetry::RowView&) {
      ++rows;
      return true;
    });
    QVERIFY(rows >= 10);
  }

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void whatIsHeardIsRecordedAndReplays() {
    Studio s(0);
    const link::LiveOptions options = live_rig::options();
    QVERIFY(hear(s, options));
    QVERIFY(s.window.recording()->isPossible());
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QVERIFY2(s.window.recording()->isRecording(), qPrintable(s.notice()));
    QVERIFY(talk(s, options, 10));
    s.window.timeline()->addBookmark(QStringLiteral("live note"));
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QTRY_COMPARE(saved.size(), 1);
    const QString path = saved.at(0).at(0).toString();
    check(path);
    s.window.openSession(path);
    QTRY_VERIFY(s.window.timeline()->isRecording());
    s.window.timeline()->seek(s.window.timeline()->available()->end);
    QTRY_COMPARE(s.window.replay()->frame()->robots.size(), std::size_t(2));
  }

  void theRecentPastOfLiveIsSaved() {
    Studio s(0);
    QVERIFY(hear(s, live_rig::options()));
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    s.window.recording()->saveLast(60);
    QTRY_VERIFY2(saved.size() == 1, qPrintable(s.notice()));
    check(saved.at(0).at(0).toString());
    s.window.openSession(saved.at(0).at(0).toString());
    QTRY_VERIFY(s.window.timeline()->isRecording());
    s.window.timeline()->seek(s.window.timeline()->available()->end);
    QTRY_COMPARE(s.window.replay()->frame()->robots.size(), std::size_t(2));
  }

  void withoutAnythingHeardNothingIsSaved() {
    Studio s(0);
    s.window.live()->setOptions(live_rig::options());
    s.window.showSource(SourceKind::Live);
    s.window.recording()->saveLast(10);
    QTRY_VERIFY(s.notice().contains(QStringLiteral("nothing in memory")));
  }
};

QTEST_MAIN(TestSessionLive)
#include "tst_session_live.moc"
