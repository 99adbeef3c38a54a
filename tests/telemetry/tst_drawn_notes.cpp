// SPDX-License-Identifier: GPL-3.0-or-later
// Drawn notes in the file beside a recording: they read back, also through versions that do not
// know them; damaged files and entries are told and never destroyed; clips, repaired files and
// lists have them.

#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QtTest>
#include <thread>

#include <telemetry/session/drawn_notes.h>
#include <telemetry/session/session_export.h>
#include <telemetry/session/session_notes.h>
#include <telemetry/session/session_repair.h>
#include <telemetry/session/session_videos.h>

#include "session_rig.h"

namespace tst_drawn_notes {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace pitchboard::telemetry::rig;

namespace {

std::vector<DrawnNote> threeNotes() {
  return {{0.2,
           3.0,
           NoteShape::Text,
           NotePlace::Field,
           "",
           "",
           {-1.5, 0.25},
           {-1.5, 0.25},
           "why \"here\"?\nä"},
          {1.0,
           0.5,
           NoteShape::Arrow,
           NotePlace::Plot,
           "B1/BELIEF_ERROR",
           "cm",
           {0.5, 40.0},
           {1.0, 62.5},
           ""},
          {1.25,
           10.0,
           NoteShape::Circle,
           NotePlace::Video,
           "north.mp4",
           "",
           {0.5, 0.5},
           {0.625, 0.5},
           "offside"}};
}

}  // namespace

class TestDrawnNotes : public QObject {
  Q_OBJECT
  NewSessions m_sessions;

  std::string recorded() {
    const std::string path = m_sessions.newPath();
    auto writer = SessionWriter::create(path, sessionInfo(), {});
    record(**writer, 120);
    if (!(*writer)->finish()) qFatal("not written");
    return path;
  }
  static QString fileOf(const std::string& session) {
    return QString::fromStdString(sessionNotesPath(session));
  }
  static QByteArray bytesOf(const std::string& session) {
    QFile file(fileOf(session));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  }
  static void put(const std::string& session, const QByteArray& bytes) {
    QFile file(fileOf(session));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
  }

 private slots:
  void theyReadBack() {
    const std::string path = m_sessions.newPath();
    QVERIFY(readDrawnNotes(path)->notes.empty());
    // Without notes there is no file.
    QVERIFY(writeDrawnNotes(path, {}));
    QVERIFY(!QFile::exists(fileOf(path)));
    auto notes = threeNotes();
    std::ranges::reverse(notes);
    QVERIFY(writeDrawnNotes(path, notes));
    QVERIFY(readDrawnNotes(path)->notes == threeNotes());
    QCOMPARE(readDrawnNotes(path)->unreadable, std::size_t{0});
    QVERIFY(writeDrawnNotes(path, {}));
    QVERIFY(!bytesOf(path).contains("drawn"));
  }

  void oneFileHasBookmarksVideosAndNotes() {
    const std::string path = m_sessions.newPath();
    // A file of 0.27, with a member that nobody knows.
    put(path, R"({"version": 1, "bookmarks": [{"time": 2.5, "note": "goal"}], "own": {"x": 1}})");
    QVERIFY(readDrawnNotes(path)->notes.empty());
    QVERIFY(writeDrawnNotes(path, threeNotes()));
    // What 0.27 does when it keeps a bookmark or a video: it changes its member only.
    QVERIFY(addSessionNote(path, 3.0, "later"));
    const SessionVideo video{"/videos/north.mp4", {{1.0, 0.0}}, {}};
    QVERIFY(writeSessionVideos(path, {&video, 1}));
    QVERIFY(readDrawnNotes(path)->notes == threeNotes());
    QVERIFY((readSessionNotes(path).value() == SessionNotes{{2.5, "goal"}, {3.0, "later"}}));
    QCOMPARE(readSessionVideos(path)->size(), std::size_t{1});
    QVERIFY(bytesOf(path).contains("\"own\""));
  }

  void whatIsDamagedStaysInTheFile() {
    const std::string path = recorded();
    put(path, R"({"bookmarks": [], "drawn": [
      {"time": 1, "shape": "arrow", "place": "field", "from": [0, 0], "to": [1, 1]},
      {"time": 1, "shape": "spiral", "place": "field", "from": [0, 0]},
      {"time": "soon", "shape": "text", "place": "field", "from": [0, 0]},
      {"time": 1, "shape": "text", "place": "field", "from": [0]},
      {"time": 1, "shape": "text", "place": "field", "from": [1e300, 0]},
      {"time": 1, "duration": -5, "shape": "text", "place": "plot", "from": [2, 3], "text": 7},
      null, 5, []]})");
    const auto read = readDrawnNotes(path);
    QCOMPARE(read->notes.size(), std::size_t{2});
    QCOMPARE(read->unreadable, std::size_t{7});
    QCOMPARE(read->notes[0].duration, DrawnNote::usualDuration);
    QCOMPARE(read->notes[1].duration, DrawnNote::shortestDuration);
    QVERIFY(read->notes[1].to == read->notes[1].from && read->notes[1].text.empty());
    const auto session = SessionReader::open(path);
    QCOMPARE(session->notes().size(), std::size_t{1});
    QVERIFY(
        session->notes()[0].starts_with("Drawn notes that cannot be read are not shown: 7 in "));
    QVERIFY(writeDrawnNotes(path, threeNotes()));
    QVERIFY(readDrawnNotes(path)->notes == threeNotes());
    QCOMPARE(readDrawnNotes(path)->unreadable, std::size_t{7});
    QVERIFY(bytesOf(path).contains("spiral"));
  }

  void hostileFilesAreRefusedAndKept() {
    const std::string path = recorded();
    QByteArray many = R"({"bookmarks": [], "drawn": [)";
    for (std::size_t i = 0; i < DrawnNotes::most; ++i) many += "0,";
    const struct {
      QByteArray bytes;
      const char* message;
    } files[] = {{R"({"bookmarks": [], "drawn": {}})", "are not a list"},
                 {many + "0]}", "10001 drawn notes"},
                 {"{\"bookmarks\": oops", "no bookmarks that can be read"},
                 {"[" + QByteArray(100'000, '['), "no bookmarks that can be read"},
                 {QByteArray(9 << 20, ' '), "The file with the notes"}};
    for (const auto& file : files) {
      put(path, file.bytes);
      const auto read = readDrawnNotes(path);
      QVERIFY2(!read && read.error().text().find(file.message) != std::string::npos,
               read ? "it was read" : read.error().text().c_str());
      QVERIFY(!SessionReader::open(path)->notes().empty());
      if (file.bytes.startsWith("{\"bookmarks\": []")) continue;
      QVERIFY(!writeDrawnNotes(path, threeNotes()));
      QCOMPARE(bytesOf(path), file.bytes);
    }
    const std::vector<DrawnNote> tooMany(DrawnNotes::most + 1);
    QCOMPARE(writeDrawnNotes(m_sessions.newPath(), tooMany).error().code,
             ErrorCode::InvalidArgument);
    // Half a letter is never left.
    DrawnNote longest = threeNotes()[0];
    longest.text = std::string(DrawnNote::maxText - 1, 'x') + "ä";
    const std::string other = m_sessions.newPath();
    QVERIFY(writeDrawnNotes(other, {&longest, 1}));
    QCOMPARE(readDrawnNotes(other)->notes[0].text, std::string(DrawnNote::maxText - 1, 'x'));
  }

  /// Threads of one program do not take each other's part away.
  void severalWriteAtOnce() {
    const std::string path = m_sessions.newPath();
    constexpr int times = 30;
    std::thread bookmarks([&path] {
      for (int i = 0; i < times; ++i) (void)addSessionNote(path, i, "x");
    });
    for (int i = 0; i < times; ++i) QVERIFY(writeDrawnNotes(path, threeNotes()));
    bookmarks.join();
    QCOMPARE(readSessionNotes(path)->size(), std::size_t{times});
    QVERIFY(readDrawnNotes(path)->notes == threeNotes());
  }

  void eventsClipsAndRepairedFilesHaveThem() {
    const std::string path = recorded();
    QVERIFY(addSessionNote(path, 1.1, "goal"));
    QVERIFY(writeDrawnNotes(path, threeNotes()));
    const auto notesIn = [](const std::string& file) {
      std::vector<std::string> found;
      for (const SessionEvent& event : SessionReader::open(file)->events()) {
        if (event.kind == "note" || event.kind == "bookmark") found.push_back(event.text);
      }
      return found;
    };
    using Texts = std::vector<std::string>;
    const Texts all{"why \"here\"?\nä", "arrow on B1/BELIEF_ERROR", "goal", "offside"};
    QVERIFY(notesIn(path) == all);
    // Shown from 1 to 1.5 and from 1.25 on: of a clip from 1.4, both.
    ExportSelection selection;
    selection.range = {1.4, 2.0};
    const std::string clip = m_sessions.newPath();
    QVERIFY(exportFile(*SessionReader::open(path), ExportFormat::Mcap, selection, clip));
    const auto expected = threeNotes();
    QVERIFY((readDrawnNotes(clip)->notes == std::vector{expected[0], expected[1], expected[2]}));
    selection.range = {3.5, 4.0};
    const std::string later = m_sessions.newPath();
    QVERIFY(exportFile(*SessionReader::open(path), ExportFormat::Mcap, selection, later));
    QVERIFY((readDrawnNotes(later)->notes == std::vector{expected[2]}));
    // Without messages there are no notes.
    selection.messages = false;
    const std::string rows = m_sessions.newPath();
    QVERIFY(exportFile(*SessionReader::open(path), ExportFormat::Mcap, selection, rows));
    QVERIFY(readDrawnNotes(rows)->notes.empty());
    const std::string repaired = m_sessions.newPath();
    QVERIFY(repairSession(path, repaired));
    QVERIFY(notesIn(repaired) == all);
    QVERIFY(readDrawnNotes(repaired)->notes == expected);
    QByteArray lines;
    QVERIFY(exportText(*SessionReader::open(path), ExportFormat::JsonLines, {},
                       [&lines](std::string_view part) {
                         lines.append(part.data(), static_cast<qsizetype>(part.size()));
                         return true;
                       }));
    QCOMPARE(lines.count("\"kind\":\"note\""), 3);
  }

  void listsAreWritten() {
    const QByteArray csv = QByteArray::fromStdString(drawnNotesCsv(threeNotes()));
    QCOMPARE(csv, QByteArray("time,duration,shape,place,on,unit,x,y,to_x,to_y,text\n"
                             "0.2,3,text,field,,,-1.5,0.25,-1.5,0.25,\"why \"\"here\"\"?\nä\"\n"
                             "1,0.5,arrow,plot,B1/BELIEF_ERROR,cm,0.5,40,1,62.5,\n"
                             "1.25,10,circle,video,north.mp4,,0.5,0.5,0.625,0.5,offside\n"));
    const auto json =
        QJsonDocument::fromJson(QByteArray::fromStdString(drawnNotesJson(threeNotes()))).array();
    QCOMPARE(json.size(), 3);
    QCOMPARE(json[1].toObject()["on"].toString(), QStringLiteral("B1/BELIEF_ERROR"));
    QCOMPARE(json[2].toObject()["to"].toArray()[0].toDouble(), 0.625);
  }
};

PITCHBOARD_TEST(TestDrawnNotes)

}  // namespace tst_drawn_notes

#include "tst_drawn_notes.moc"
