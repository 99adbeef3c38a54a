// SPDX-License-Identifier: GPL-3.0-or-later
// What is received live is recorded and saved from memory, through the window; real sockets. The
// computer's clock is one that can be set: the function that reads it is replaced in the whole
// program, Qt included.
#include <sys/syscall.h>
#include <unistd.h>
#include <QComboBox>
#include <QLabel>
#include <QListWidget>
#include <algorithm>
#include <atomic>
#include <ctime>
#include <set>

#include <telemetry/pb2/pb2.h>
#include <telemetry/session/session_reader.h>
#include <ui/session/export_dialog.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/event_list.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/replay_controller.h>

#include "../support/program_run.h"
#include "../support/session_values.h"
#include "live_rig.h"
#include "session_rig.h"

using namespace pitchboard;
using namespace pitchboard::ui;
using live_rig::Robot;
using session_rig::Studio;

namespace {

std::atomic<std::int64_t> clockSetBy = 0;  // s

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const long failed = syscall(SYS_clock_gettime, clock, time);
  if (failed == 0 && clock == CLOCK_REALTIME) time->tv_sec += clockSetBy;
  return static_cast<int>(failed);
}

class TestSessionLive : public QObject {
  Q_OBJECT

  /// Two robots are received for a while.
  static bool receive(Studio& s, const link::LiveOptions& options) {
    s.window.live()->setOptions(options);
    s.window.showSource(SourceKind::Live);
    const bool bound = QTest::qWaitFor(
        [&s] {
          const auto ports = s.window.live()->details().network.ports;
          return !ports.empty() && std::all_of(ports.begin(), ports.end(),
                                               [](const auto& port) { return port.bound; });
        },
        30'000);
    return bound && talk(s, options, 10);
  }
  static bool talk(Studio& s, const link::LiveOptions& options, int times) {
    const Robot one(options, 1), two(options, 2);
    LiveController* live = s.window.live();
    for (int i = 0; i < times; ++i) {
      const double before = live->frame() ? live->frame()->snapshot.time : -1.0;
      if (!one.sendMessage() || !two.sendMessage()) return false;
      const bool received = QTest::qWaitFor(
          [live, before] {
            return live->frame() && live->frame()->robots.size() == 2 &&
                   live->frame()->snapshot.time > before;
          },
          30'000);
      if (!received) return false;
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

  /// Where robot 1 says that it is; -1: it is not there.
  static int placeIn(const FramePtr& frame) {
    if (!frame) return -1;
    for (const link::RobotFrame& robot : frame->robots) {
      if (robot.identity.number == 1 && robot.belief) {
        return qRound(100 * (robot.belief->position.x + 4.5));
      }
    }
    return -1;
  }
  /// Robot 1 says that it is there, and is seen there.
  static bool stand(Studio& s, const link::LiveOptions& options, int place) {
    const Robot robot(options, 1);
    telemetry::TextMessage reported = live_rig::message(1);
    reported.x = place;
    LiveController* live = s.window.live();
    return robot.sendMessage(reported) &&
           QTest::qWaitFor([&] { return placeIn(live->frame()) == place; }, 30'000);
  }
  /// The file that has been written since `work` began.
  static QString record(Studio& s, const std::function<bool()>& work) {
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    const bool good = s.window.recording()->isRecording() && work();
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    if (!QTest::qWaitFor([&saved] { return saved.size() == 1; }, 20'000) || !good) return {};
    return saved.at(0).at(0).toString();
  }
  /// Times at which a file has robot 1 at these places; nan: never.
  static std::vector<double> timesIn(const QString& path, const std::vector<int>& places) {
    std::vector<double> times(places.size(), std::nan(""));
    const auto session = telemetry::SessionReader::open(path.toStdString());
    if (!session) return times;
    const auto& groups = session->groups();
    session->rows({-1e9, 1e9}, {}, [&](telemetry::GroupId id, const telemetry::RowView& row) {
      const telemetry::GroupInfo& info = groups[id].info;
      if (info.name != "Robot 1" || !factsOf(info).linkOf.empty()) return true;
      const auto place = static_cast<int>(valueOf(info, row, columnOf(info, "LOCALIZATION_X")));
      const auto found = std::ranges::find(places, place);
      if (found != places.end()) {
        times[static_cast<std::size_t>(found - places.begin())] = row.time;
      }
      return true;
    });
    return times;
  }
  /// The same in memory.
  static std::vector<double> timesIn(const telemetry::SeriesStore& store,
                                     const std::vector<int>& places) {
    std::vector<double> times(places.size(), std::nan(""));
    for (telemetry::GroupId id = 0; id < store.groups(); ++id) {
      const auto view = store.view(id);
      const telemetry::GroupInfo& info = view->info();
      if (info.name != "Robot 1" || !factsOf(info).linkOf.empty()) continue;
      std::vector<telemetry::Sample> samples;
      view->samples(static_cast<std::uint32_t>(columnOf(info, "LOCALIZATION_X")), {-1e9, 1e9},
                    samples);
      for (const telemetry::Sample& sample : samples) {
        const auto found = std::ranges::find(places, static_cast<int>(sample.value));
        if (found != places.end()) {
          times[static_cast<std::size_t>(found - places.begin())] = sample.time;
        }
      }
    }
    return times;
  }

 private slots:
  void cleanup() { clockSetBy = 0; }
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void receivedMessagesAreRecordedAndReplayed() {
    Studio s(0);
    const link::LiveOptions options = live_rig::options();
    QVERIFY(receive(s, options));
    QVERIFY(s.window.recording()->isPossible());
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QVERIFY2(s.window.recording()->isRecording(), qPrintable(s.notice()));
    QVERIFY(talk(s, options, 10));
    s.window.shown()->addBookmark(QStringLiteral("live note"));
    QTest::mouseClick(s.record(), Qt::LeftButton, {}, {8, 8});
    QTRY_COMPARE(saved.size(), 1);
    const QString path = saved.at(0).at(0).toString();
    check(path);
    s.window.openSession(path);
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    s.window.shown()->seek(s.window.shown()->available()->end);
    QTRY_COMPARE(s.window.replay()->frame()->robots.size(), std::size_t(2));
  }

  void theRecentPastOfLiveIsSaved() {
    Studio s(0);
    QVERIFY(receive(s, live_rig::options()));
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    s.window.recording()->saveLast(60);
    QTRY_VERIFY2(saved.size() == 1, qPrintable(s.notice()));
    check(saved.at(0).at(0).toString());
    s.window.openSession(saved.at(0).at(0).toString());
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    s.window.shown()->seek(s.window.shown()->available()->end);
    QTRY_COMPARE(s.window.replay()->frame()->robots.size(), std::size_t(2));
  }

  /// The computer's clock is set an hour on and an hour back while robots play.
  void aClockThatIsSetLeavesEverythingInAgreement() {
    constexpr double tenMinutes = 600.0;  // an hour off is beyond it, a slow computer is not
    Studio s(0);
    const link::LiveOptions options = live_rig::options();
    QVERIFY(receive(s, options));
    LiveController* live = s.window.live();
    ShownMoment* timeline = s.window.shown();
    const std::vector<int> steps{0, 3600, 0, -3600, 0}, places{410, 420, 430, 440, 450};
    const auto clockEvents = [&] {
      std::vector<double> times;
      for (const link::MatchEvent& event : timeline->events()->events()) {
        if (event.kind == link::MatchEventKind::ClockSet) times.push_back(event.time);
      }
      return times;
    };
    const QDateTime truly = QDateTime::currentDateTime();
    const QString path = record(s, [&] {
      for (std::size_t i = 0; i < steps.size(); ++i) {
        clockSetBy = steps[i];
        const bool noticed = QTest::qWaitFor([&] { return clockEvents().size() == i; }, 20'000);
        if (!noticed || !stand(s, options, places[i])) return false;
      }
      return true;
    });
    QVERIFY(!path.isEmpty());
    // Curves: in order, and no row an hour off.
    const std::vector<double> times = timesIn(*live->series(), places);
    QVERIFY(std::ranges::is_sorted(times));
    QVERIFY(times.front() >= 0.0 && times.back() < tenMinutes);
    // Log: each step between the messages around it.
    const std::vector<double> noted = clockEvents();
    QCOMPARE(noted.size(), steps.size() - 1);
    for (std::size_t i = 0; i < noted.size(); ++i) {
      QVERIFY(times[i] <= noted[i] && noted[i] <= times[i + 1]);
    }
    // Timeline: as long as the robots were received, at the time of day when it began.
    QVERIFY(timeline->available() && timeline->available()->begin <= times.front());
    QVERIFY(timeline->available()->end >= times.back() && timeline->available()->end < tenMinutes);
    QVERIFY(timeline->clock().has_value());
    const QDateTime began = *timeline->clock();
    QVERIFY(static_cast<double>(std::abs(began.secsTo(truly))) < tenMinutes);
    // Field: at the time of each row the robot stands where the row says.
    for (std::size_t i = 0; i < places.size(); ++i) {
      QCOMPARE(placeIn(live->frameAt(times[i])), places[i]);
    }
    // File: the same rows, steps and time of day, and the same again on the field.
    const auto session = telemetry::SessionReader::open(path.toStdString());
    QVERIFY(session.has_value());
    const std::vector<double> kept = timesIn(path, places);
    for (std::size_t i = 0; i < places.size(); ++i) {
      QVERIFY2(std::abs(kept[i] - times[i]) < 1e-6,
               qPrintable(QStringLiteral("%1 %2").arg(kept[i]).arg(times[i])));
    }
    std::vector<double> written;
    for (const telemetry::SessionEvent& event : session->events()) {
      if (event.kind == "clock-set") written.push_back(event.time);
    }
    QCOMPARE(written.size(), noted.size());
    for (std::size_t i = 0; i < noted.size(); ++i) QVERIFY(std::abs(written[i] - noted[i]) < 1e-6);
    s.window.openSession(path);
    QTRY_VERIFY(!timeline->kind().hasPresent);
    QVERIFY(timeline->clock() && std::abs(timeline->clock()->msecsTo(began)) <= 1);
    for (std::size_t i = 0; i < places.size(); ++i) {
      timeline->seek(times[i]);
      QTRY_COMPARE(placeIn(s.window.replay()->frame()), places[i]);
    }
  }

  /// Each watch has a second 0 of its own: their beginnings stand at one moment.
  void twoLiveSessionsOverlapByElapsedTime() {
    constexpr int place = 444;
    Studio first(0);
    const link::LiveOptions options = live_rig::options();
    QVERIFY(receive(first, options));
    const QString path = record(first, [&] {
      return talk(first, options, 5) && stand(first, options, place) && talk(first, options, 1);
    });
    QVERIFY(!path.isEmpty());
    const auto session = telemetry::SessionReader::open(path.toStdString());
    QVERIFY(session && session->range());
    const double stoodAfter = timesIn(path, {place})[0] - session->range()->begin;
    QVERIFY(stoodAfter > 0.0);

    Studio second(0);
    const link::LiveOptions others = live_rig::options();
    QVERIFY(receive(second, others));
    ShownMoment* timeline = second.window.shown();
    const auto elapsed = [&] { return timeline->available()->end - timeline->available()->begin; };
    for (int i = 0; i < 200 && elapsed() <= stoodAfter; ++i) QVERIFY(talk(second, others, 1));
    QVERIFY(elapsed() > stoodAfter);
    ComparedSessions* all = second.window.compared();
    FramePtr ghost;
    connect(all, &ComparedSessions::momentReached, this,
            [&ghost](int, const FramePtr& frame) { ghost = frame; });
    all->open({path});
    QTRY_COMPARE(all->all().size(), 1U);
    ComparedSession* compared = all->all().front();
    QVERIFY(compared->isAlignedByTime());
    const double begin = timeline->available()->begin;
    QVERIFY(std::abs(compared->offset() - (begin - session->range()->begin)) < 1e-9);
    constexpr double rounding = 1e-6;
    timeline->seek(begin + stoodAfter + rounding);
    QTRY_COMPARE(placeIn(ghost), place);
    all->removeAll();
    disconnect(all, nullptr, this, nullptr);
  }

  /// "Robot 1" is ticked in the studio, and quoted at a terminal.
  void namesWithSpacesAreExported() {
    Studio s(0);
    const link::LiveOptions options = live_rig::options();
    QVERIFY(receive(s, options));
    const QString path = record(s, [&] { return talk(s, options, 10); });
    QVERIFY(!path.isEmpty());
    s.window.openSession(path);
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    s.action("exportSession")->trigger();
    auto* dialog = s.window.findChild<ExportDialog*>(QStringLiteral("exportDialog"));
    QVERIFY(dialog != nullptr);
    auto* format = dialog->findChild<QComboBox*>(QStringLiteral("exportFormat"));
    for (int i = 0; i < format->count(); ++i) {
      if (format->itemText(i).contains(QStringLiteral("fixed rate"))) format->setCurrentIndex(i);
    }
    const auto lists = dialog->findChildren<QListWidget*>();
    QCOMPARE(lists.size(), 2);
    const auto tick = [](QListWidget* list, const QString& name) {
      int found = 0;
      for (int i = 0; i < list->count(); ++i) {
        const bool on = list->item(i)->text() == name;
        list->item(i)->setCheckState(on ? Qt::Checked : Qt::Unchecked);
        found += on ? 1 : 0;
      }
      return found;
    };
    // At once, whether or not the rows have been read.
    QCOMPARE(tick(lists[0], QStringLiteral("Robot 2")), 1);
    QCOMPARE(tick(lists[1], QStringLiteral("LOCALIZATION_X")), 1);
    QSignalSpy written(dialog, &ExportDialog::written);
    const QString to = s.folder.filePath(QStringLiteral("one robot.csv"));
    dialog->exportTo(to);
    QTRY_VERIFY_WITH_TIMEOUT(written.size() == 1, 20'000);
    QFile file(to);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray place = QByteArray::number(live_rig::message(2).x);
    const auto check = [&place](const QList<QByteArray>& lines) {
      QCOMPARE(lines[0].split(',').last(), QByteArray("Robot 2.LOCALIZATION_X"));
      QVERIFY(lines.size() > 1);
      QCOMPARE(lines.last().split(',').last(), place);
    };
    check(file.readAll().trimmed().split('\n'));
    const ProgramRun run =
        runProgram("pitchboard-cli", {QStringLiteral("export"), path, QStringLiteral("--to"),
                                      QStringLiteral("csv-even"), QStringLiteral("--robots"),
                                      QStringLiteral("Robot 2"), QStringLiteral("--variables"),
                                      QStringLiteral("LOCALIZATION_X")});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    check(run.out.trimmed().split('\n'));
  }

  /// From a robot's datagrams over a recording, its replay and each export: the same numbers.
  void variablesThatARobotSendsAreExported() {
    Studio s(0);
    link::LiveOptions options = live_rig::options();
    live_rig::receiveVariables(options);
    s.window.live()->setOptions(options);
    s.window.showSource(SourceKind::Live);
    live_rig::Agent agent(options, 1);
    // What is written as text on the way has to come back to the last bit.
    const auto yawAt = [](int i) { return 0.1F * static_cast<float>(i) - 1.7F; };
    int last = 0;
    const auto send = [&](int until) {
      for (; last < until; ++last) {
        const std::string fields =
            "VOLTAGE=" + std::to_string(last) + " TEAM_STATE=" + std::to_string(-3 * last) +
            " IMU_EULER_Z=" + std::string(telemetry::Pb2Number(yawAt(last)).text());
        if (!agent.send(fields)) return false;
        const bool come = QTest::qWaitFor([&] {
          const auto sent = s.window.live()->details().sent;
          return !sent.empty() && sent[0].link.messages == static_cast<std::uint64_t>(last + 1);
        });
        if (!come) return false;
      }
      return true;
    };
    QTRY_VERIFY(s.window.live()->frame());
    // Rows begin with the robot's first two seconds over.
    QTRY_VERIFY_WITH_TIMEOUT(
        send(last + 1) && s.window.live()->series()->find("Robot 1", "TEAM_STATE"), 30'000);
    const int first = last;
    const QString path = record(s, [&] { return send(first + 40); });
    QVERIFY(!path.isEmpty());

    const auto compare = [&](const QList<QByteArray>& line) {
      const int i = line[0].toInt();
      QCOMPARE(line[1].toInt(), -3 * i);
      QCOMPARE(line[2].toFloat(), yawAt(i));
    };
    const auto check = [&](const QList<QList<QByteArray>>& rows) {
      std::set<int> seen;
      for (const auto& row : rows) {
        compare(row);
        seen.insert(row[0].toInt());
      }
      for (int i = first; i < first + 40; ++i) QVERIFY2(seen.contains(i), QByteArray::number(i));
    };
    // Replay.
    s.window.openSession(path);
    QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    const auto replayed = [&] {
      QList<QList<QByteArray>> rows;
      const auto store = s.window.replay()->series();
      const auto group = store ? store->findGroup("Robot 1") : std::nullopt;
      if (!group) return rows;
      const auto view = store->view(*group);
      std::vector<std::vector<telemetry::Sample>> columns;
      for (const char* name : {"VOLTAGE", "TEAM_STATE", "IMU_EULER_Z"}) {
        view->samples(store->find("Robot 1", name)->column, {-1e9, 1e9}, columns.emplace_back());
      }
      for (std::size_t i = 0; i < columns[0].size(); ++i) {
        rows.append({QByteArray::number(columns[0][i].value),
                     QByteArray::number(columns[1].at(i).value),
                     QByteArray::number(columns[2].at(i).value, 'g', 17)});
      }
      return rows;
    };
    QTRY_VERIFY2(replayed().size() >= 40, QByteArray::number(replayed().size()));
    check(replayed());
    // Exports, also of a recording that was exported itself.
    const auto exported = [](const QString& file, const QStringList& more) {
      return runProgram("pitchboard-cli",
                        QStringList{"export", file, "--robots", "Robot 1"} + more);
    };
    const QString copy = s.folder.filePath(QStringLiteral("copy.mcap"));
    const ProgramRun copied = exported(path, {"--to", "mcap", "-o", copy});
    QVERIFY2(copied.exitCode == 0, copied.err.constData());
    for (const QString& file : {path, copy}) {
      const ProgramRun table =
          exported(file, {"--to", "csv-wide", "--variables", "VOLTAGE,TEAM_STATE,IMU_EULER_Z"});
      QVERIFY2(table.exitCode == 0, table.err.constData());
      QList<QByteArray> lines = table.out.trimmed().split('\n');
      const QList<QByteArray> head = lines.takeFirst().split(',');
      QList<QList<QByteArray>> rows;
      for (const QByteArray& line : lines) {
        const QList<QByteArray> cells = line.split(',');
        QList<QByteArray> row;
        for (const char* name : {"VOLTAGE", "TEAM_STATE", "IMU_EULER_Z"}) {
          row.append(cells.at(head.indexOf(QByteArray("Robot 1.") + name)));
        }
        rows.append(row);
      }
      check(rows);
    }
    QFile page(s.folder.filePath(QStringLiteral("report.html")));
    const ProgramRun report = exported(path, {"--to", "report", "-o", page.fileName()});
    QVERIFY2(report.exitCode == 0, report.err.constData());
    QVERIFY(page.open(QIODevice::ReadOnly) && page.readAll().contains("Robot 1"));
  }

  void withoutReceivedMessagesNothingIsSaved() {
    Studio s(0);
    s.window.live()->setOptions(live_rig::options());
    s.window.showSource(SourceKind::Live);
    s.window.recording()->saveLast(10);
    QTRY_VERIFY(s.notice().contains(QStringLiteral("nothing in memory")));
  }
};

QTEST_MAIN(TestSessionLive)
#include "tst_session_live.moc"
