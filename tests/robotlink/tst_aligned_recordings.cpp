// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings of one match whose clocks have nothing in common are put on one clock by the kick-off.
// How that was done stays with the session, and a recording without the event is named.

#include <QTemporaryDir>
#include <QtTest>

#include <filesystem>

#include <robotlink/import/aligned_recordings.h>
#include <robotlink/import/import_session.h>
#include <telemetry/session/session_export.h>
#include <telemetry/session/session_reader.h>

#include "../support/match_recordings.h"

namespace tst_aligned_recordings {

using namespace pitchboard;
using namespace pitchboard::link;
using match_recordings::StateChange;
using match_recordings::writeRefereeLog;
using match_recordings::writeRobotTable;
using telemetry::SessionReader;

namespace {

constexpr int ready = 1, set = 2, playing = 3;
/// Kick-offs at 20 s and, after a goal, at 70 s. Robots are told of them 15 s later.
const std::vector<StateChange> match{{2.0, ready, 0},  {10.0, set, 0},     {20.0, playing, 0},
                                     {50.0, ready, 1}, {60.125, set, 1},   {70.0, playing, 1},
                                     {80.0, ready, 1}, {85.0, playing, 1}, {90.0, 4, 1}};

TopicMapping mappingOf(const std::string& robot) {
  TopicMapping mapping;
  mapping.referee.emplace();
  mapping.referee->topic = robot;
  mapping.referee->state = "state";
  mapping.referee->leftScore = "goals";
  return mapping;
}

std::vector<double> offsetsOf(const TopicMapping& mapping) {
  std::vector<double> offsets;
  for (const MappedRecording& one : mapping.recordings) offsets.push_back(one.offset);
  return offsets;
}

}  // namespace

class TestAlignedRecordings : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;
  std::string path(const char* name) const { return m_folder.filePath(name).toStdString(); }

  /// The referee's log, and robot 3, whose clock began when it was switched on 500 s before.
  std::vector<std::string> recordings() const {
    writeRefereeLog(path("log.yaml"), match);
    writeRobotTable(path("robot3.csv"), 503.0, 560.0,
                    {{503.0, 0, 0}, {510.0, set, 0}, {535.5, playing, 0}, {550.0, ready, 1}});
    return {path("log.yaml"), path("robot3.csv")};
  }

  TopicMapping aligned(const std::vector<std::string>& files, AlignEvent event,
                       TopicMapping mapping) const {
    if (!nameRecordings(files, mapping)) qFatal("names");
    const auto done = alignRecordings(files, event, mapping);
    if (!done) qFatal("%s", done.error().text().c_str());
    return mapping;
  }
  QString problemOf(const std::vector<std::string>& files, const TopicMapping& mapping) const {
    TopicMapping tried = mapping;
    const Result<void> named = nameRecordings(files, tried);
    if (!named) return QString::fromStdString(named.error().text());
    const TopicMapping before = tried;
    const auto done = alignRecordings(files, AlignEvent::KickOff, tried);
    if (tried != before) return QStringLiteral("the mapping was changed");
    return done ? QString() : QString::fromStdString(done.error().text());
  }

 private slots:
  void theKickOffIsAtTheSameTime() {
    const auto files = recordings();
    const double start = 1'782'900'000.0;  // 2026-07-01, 10:00 UTC
    const TopicMapping byKickOff = aligned(files, AlignEvent::KickOff, mappingOf("robot3"));
    QCOMPARE(offsetsOf(byKickOff), (std::vector<double>{0.0, start + 20.0 - 535.5}));
    QVERIFY(byKickOff.alignedBy == AlignEvent::KickOff);
    // SET came without the delay.
    const TopicMapping bySet = aligned(files, AlignEvent::Set, mappingOf("robot3"));
    QCOMPARE(offsetsOf(bySet), (std::vector<double>{0.0, start + 10.0 - 510.0}));
    QCOMPARE(mappingFromJson(mappingText(bySet), "mapping").value(), bySet);
    // The one that is named first stays where it is, and earlier offsets do not count.
    const TopicMapping again = aligned({files[1], files[0]}, AlignEvent::KickOff, byKickOff);
    QCOMPARE(offsetsOf(again), (std::vector<double>{535.5 - 20.0 - start, 0.0}));
  }

  /// A robot that came after the first goal has only the second kick-off.
  void theSameKickOffIsTaken() {
    writeRefereeLog(path("log.yaml"), match);
    writeRobotTable(path("robot4.csv"), 5.0, 30.0,
                    {{5.0, playing, 0}, {6.0, ready, 1}, {15.0, set, 1}, {25.0, playing, 1}});
    const TopicMapping mapping =
        aligned({path("robot4.csv"), path("log.yaml")}, AlignEvent::KickOff, mappingOf("robot4"));
    QCOMPARE(mapping.recordings[1].offset, 25.0 - 70.0 - 1'782'900'000.0);
  }

  void theImportedSessionKnowsIt() {
    const auto files = recordings();
    ImportOptions options;
    options.mapping = mappingOf("robot3");
    options.align = AlignEvent::KickOff;
    const auto done = importRecordings(files, path("match.mcap"), options);
    QVERIFY2(done, done ? "" : done.error().text().c_str());
    const auto session = SessionReader::open(path("match.mcap")).value();
    // PLAYING in the robot's rows begins 18 s behind the log's first state.
    const auto group = session.groupsNamed("robot3").value();
    const auto& columns = session.groups()[group.front()].info.columns;
    const auto state = static_cast<std::size_t>(
        std::ranges::find(columns, "state", &telemetry::ColumnInfo::name) - columns.begin());
    double began = 0.0;
    session.rows(*session.range(), group, [&](telemetry::GroupId, const telemetry::RowView& row) {
      began = row.time;
      return row.values[state] != playing;
    });
    const double zero =
        std::chrono::duration<double>(session.info().start.time_since_epoch()).count();
    QVERIFY2(std::abs(zero + began - (1'782'900'000.0 + 20.0)) < 1e-3,
             std::to_string(zero + began).c_str());
    const QString text = QString::fromStdString(alignmentText(session.info()).value());
    QCOMPARE(text, QStringLiteral("aligned by kick-off: log.yaml +0.000 s, robot3.csv "
                                  "+1782899484.500 s"));
    QCOMPARE(session.info().more.at("aligned_by"), std::string("kick-off"));
    // A part of it that is exported knows it, too.
    QVERIFY(telemetry::exportFile(session, telemetry::ExportFormat::Mcap, {}, path("part.mcap"), {},
                                  IfExists::Refuse));
    QCOMPARE(alignmentText(SessionReader::open(path("part.mcap"))->info()),
             alignmentText(session.info()));
    // Offsets that were set by hand are told, too, and nothing if there are none.
    options.align.reset();
    options.mapping->recordings = {{"robot3.csv", RecordingClock::Auto, 2.5}};
    QVERIFY(importRecordings(files, path("hand.mcap"), options));
    QCOMPARE(alignmentText(SessionReader::open(path("hand.mcap"))->info()).value(),
             std::string("aligned by hand: robot3.csv +2.500 s"));
    options.mapping->recordings.clear();
    QVERIFY(importRecordings(files, path("times.mcap"), options));
    QVERIFY(!alignmentText(SessionReader::open(path("times.mcap"))->info()));
  }

  void whatCannotBeAlignedIsNamed() {
    const auto files = recordings();
    const auto has = [](const QString& text, std::initializer_list<const char*> parts) {
      return std::ranges::all_of(
          parts, [&](const char* part) { return text.contains(QLatin1String(part)); });
    };
    // Without a mapping a table has no states of the game.
    QString problem = problemOf(files, {});
    QVERIFY2(has(problem, {"robot3.csv", "no state of the game", "referee", "by hand"}),
             qPrintable(problem));
    // PLAYING from the beginning is no kick-off.
    writeRobotTable(path("late.csv"), 5.0, 30.0, {{5.0, playing, 0}});
    problem = problemOf({path("log.yaml"), path("late.csv")}, mappingOf("late"));
    QVERIFY2(has(problem, {"late.csv", "no kick-off", "PLAYING", "by hand"}), qPrintable(problem));
    // Its only kick-off is one that the log has not.
    writeRobotTable(path("other.csv"), 5.0, 30.0, {{5.0, set, 2}, {8.0, playing, 2}});
    problem = problemOf({path("log.yaml"), path("other.csv")}, mappingOf("other"));
    QVERIFY2(has(problem, {"log.yaml", "no kick-off that the others have"}), qPrintable(problem));
    problem = problemOf({files[0]}, {});
    QVERIFY2(has(problem, {"One recording"}), qPrintable(problem));
    std::filesystem::create_directory(path("b"));
    writeRefereeLog(path("b/log.yaml"), match);
    problem = problemOf({files[0], path("b/log.yaml")}, {});
    QVERIFY2(has(problem, {"log.yaml", "Rename"}), qPrintable(problem));
    // An import that fails leaves nothing.
    ImportOptions options;
    options.align = AlignEvent::KickOff;
    QVERIFY(!importRecordings(files, path("none.mcap"), options));
    QVERIFY(!std::filesystem::exists(path("none.mcap")));
  }

  void aSearchIsStopped() {
    const auto files = recordings();
    writeRobotTable(path("long.csv"), 0.0, 200.0, {{0.0, set, 0}, {190.0, playing, 0}});
    TopicMapping mapping = mappingOf("long");
    const std::vector<std::string> both{files[0], path("long.csv")};
    QVERIFY(nameRecordings(both, mapping).has_value());
    const auto stopped = alignRecordings(both, AlignEvent::KickOff, mapping, [] { return false; });
    QVERIFY(!stopped && stopped.error().code == ErrorCode::Conflict);
    QVERIFY(!mapping.alignedBy);
  }
};

PITCHBOARD_TEST(TestAlignedRecordings)

}  // namespace tst_aligned_recordings

#include "tst_aligned_recordings.moc"
