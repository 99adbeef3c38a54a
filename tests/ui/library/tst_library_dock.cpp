// SPDX-License-Identifier: GPL-3.0-or-later
// The panel Library in the window, with mouse and keys: it lists what `inspect` says of the files,
// searches, sorts and opens them, remembers them between starts, follows the folders, and does not
// block the window with ten thousand sessions.
#include <QClipboard>
#include <QDesktopServices>
#include <QDockWidget>
#include <QHeaderView>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QScrollBar>
#include <QStandardPaths>
#include <QTableView>
#include <ctime>
#include <filesystem>

#include <robotlink/library/session_index.h>
#include <robotlink/scenario/scenario.h>
#include <telemetry/session/session_notes.h>
#include <ui/base/theme.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/session_recording.h>
#include <ui/sources/shown_moment.h>

#include "../../support/program_run.h"
#include "../../support/sanitized.h"
#include "../event_loop_watchdog.h"
#include "../studio_rig.h"
#include "library_model.h"
#include "library_scan.h"

namespace tst_library_dock {

using namespace pitchboard;
using namespace pitchboard::ui;
namespace fs = std::filesystem;

namespace {

struct Panel : studio_rig::Studio {
  QDockWidget* dock = window.findChild<QDockWidget*>(QStringLiteral("library"));

  explicit Panel(const QStringList& folders) {
    settings.setValue(QStringLiteral("library/folders"), folders);
    window.findChild<QAction*>(QStringLiteral("showLibrary"))->trigger();
  }
  template <class Widget>
  Widget* find(const char* name) const {
    auto* found = dock->findChild<Widget*>(QLatin1String(name));
    if (found == nullptr) qFatal("there is no %s", name);
    return found;
  }
  LibraryModel* model() const { return dock->findChild<LibraryModel*>(); }
  LibraryScan* scan() const { return dock->findChild<LibraryScan*>(); }
  QTableView* table() const { return find<QTableView>("library"); }
  QString state() const { return find<QLabel>("libraryState")->text(); }
  void waitUntilRead() const { QTRY_VERIFY(!scan()->isRunning()); }

  QString cell(const QString& file, int column) const {
    const int row = model()->rowOf(file);
    return row < 0 ? QStringLiteral("not listed") : model()->index(row, column).data().toString();
  }
  QStringList shownFiles() const {
    QStringList files;
    for (int row = 0; row < model()->rowCount(); ++row) {
      files << model()->index(row, LibraryRow::File).data().toString();
    }
    return files;
  }
  void search(const QString& words) const {
    auto* box = find<QLineEdit>("librarySearch");
    box->selectAll();
    QTest::keyClicks(box, words);
    if (words.isEmpty()) box->clear();
  }
  void click(const QString& file, Qt::MouseButton button = Qt::LeftButton) const {
    const QModelIndex at = model()->index(model()->rowOf(file), LibraryRow::Teams);
    QVERIFY(at.isValid());
    table()->scrollTo(at);
    QTest::mouseClick(table()->viewport(), button, {}, table()->visualRect(at).center());
  }
  void choose(const char* action) const {
    for (QAction* one : table()->actions()) {
      if (one->objectName() == QLatin1String(action)) return one->trigger();
    }
    qFatal("there is no %s", action);
  }
  bool isReplaying(const QString& file) {
    return window.shown()->source() == window.replay() && window.replay()->path() == file;
  }
};

void hardLink(const QString& from, const QString& to) {
  std::error_code error;
  fs::create_hard_link(from.toStdString(), to.toStdString(), error);
  if (error) qFatal("no link: %s", error.message().c_str());
}

double processSeconds() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) + double(time.tv_nsec) / 1e9;
}

}  // namespace

class TestLibraryDock : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  QString m_small = QStringLiteral(PITCHBOARD_TEST_DATA "/sessions/small.mcap");

  QString path(const QString& name) const { return m_folder.filePath(name); }
  static QString cache() {
    return QStandardPaths::writableLocation(QStandardPaths::CacheLocation) +
           QStringLiteral("/library");
  }
  static std::string index() { return (cache() + QStringLiteral("/index.jsonl")).toStdString(); }
  /// A folder of its own with these recordings of the first test.
  QString folderWith(const QString& name, const QStringList& files) const {
    if (!QDir(m_folder.path()).mkpath(name)) qFatal("no folder");
    for (const QString& file : files) {
      if (!QFile::copy(path(file), path(name + QLatin1Char('/') + file))) qFatal("not copied");
    }
    return path(name);
  }
  /// As many sessions as asked for, in ten folders.
  QString manySessions(const QString& name, int count) const {
    for (int i = 0; i < count; ++i) {
      const QString folder = QStringLiteral("%1/day %2").arg(name).arg(i % 10);
      if (i < 10 && !QDir(m_folder.path()).mkpath(folder)) qFatal("no folder");
      const QString file = path(QStringLiteral("%1/match %2.mcap").arg(folder).arg(i));
      if (!QFile::copy(m_small, file)) qFatal("not copied");
    }
    return path(name);
  }

 private slots:
  void initTestCase() {
    setTheme(*qApp, ThemeChoice::Dark);
    qputenv("XDG_CACHE_HOME", path(QStringLiteral("cache")).toUtf8());
    const auto record = [this](const char* file, const QStringList& how) {
      const ProgramRun run = cli(QStringList{"record", "-o", path(QLatin1String(file))} + how);
      QVERIFY2(run.exitCode == 0, run.err.constData());
    };
    record("match.mcap", {"--scenario", "match-3v3", "--seed", "12", "--duration", "1:50"});
    record("alone.mcap", {"--scenario", "one-robot", "--duration", "4"});
    QVERIFY(telemetry::addSessionNote(path("alone.mcap").toStdString(), 1.0,
                                      "Sleepy keeper, see the gyro"));
    QFile text(path("text.mcap"));
    QVERIFY(text.open(QIODevice::WriteOnly) && text.write("no recording") > 0);
  }
  void init() { QDir(cache()).removeRecursively(); }

  void itListsWhatInspectSays() {
    const QString folder = folderWith("lists", {"match.mcap", "alone.mcap", "text.mcap"});
    QVERIFY(QFile::copy(path("alone.mcap.notes.json"), folder + "/alone.mcap.notes.json"));
    Panel s({folder});
    QTRY_COMPARE(s.model()->rowCount(), 3);
    s.waitUntilRead();
    QCOMPARE(s.state(), QStringLiteral("3 sessions"));
    const ProgramRun run = cli({"inspect", folder, "--json"});
    int compared = 0;
    for (const QByteArray& line : run.out.trimmed().split('\n')) {
      const QJsonObject one = QJsonDocument::fromJson(line).object();
      const QString file = one["file"].toString();
      if (!one["readable"].toBool()) {
        QCOMPARE(s.cell(file, LibraryRow::Notes), one["problem"].toString());
        QCOMPARE(s.cell(file, LibraryRow::Score), QString());
        continue;
      }
      ++compared;
      const QJsonArray score = one["score"].toArray(), teams = one["teams"].toArray();
      QCOMPARE(s.cell(file, LibraryRow::Score),
               QStringLiteral("%1 : %2").arg(score[0].toInt()).arg(score[1].toInt()));
      QCOMPARE(s.cell(file, LibraryRow::Teams),
               teams[0].toString() + QStringLiteral(" – ") + teams[1].toString());
      QCOMPARE(s.cell(file, LibraryRow::Robots), QString::number(one["robots"].toArray().size()));
      QCOMPARE(s.cell(file, LibraryRow::Events), QString::number(one["events"].toInt()));
      QCOMPARE(s.cell(file, LibraryRow::Date),
               QDateTime::fromMSecsSinceEpoch(static_cast<qint64>(one["created"].toDouble() * 1e3))
                   .toString(QStringLiteral("yyyy-MM-dd HH:mm")));
    }
    QCOMPARE(compared, 2);
    QCOMPARE(s.cell(folder + "/match.mcap", LibraryRow::Length), QStringLiteral("01:50"));
    QCOMPARE(s.cell(folder + "/alone.mcap", LibraryRow::Notes),
             QStringLiteral("Sleepy keeper, see the gyro"));
  }

  void wordsSearchEveryColumnAndKeysSort() {
    const QString folder = folderWith("searches", {"match.mcap", "alone.mcap", "text.mcap"});
    QVERIFY(QFile::copy(path("alone.mcap.notes.json"), folder + "/alone.mcap.notes.json"));
    Panel s({folder});
    QTRY_COMPARE(s.model()->rowCount(), 3);
    s.waitUntilRead();
    const auto found = [&s](const char* words) {
      s.search(QString::fromUtf8(words));
      QStringList files = s.shownFiles();
      files.sort();
      return files.join(QLatin1Char(' '));
    };
    QCOMPARE(found("sleepy GYRO"), QStringLiteral("alone.mcap"));
    QCOMPARE(found("r3"), QStringLiteral("match.mcap"));
    QCOMPARE(found("red 01:50"), QStringLiteral("match.mcap"));
    QCOMPARE(found("MCAP"), QStringLiteral("alone.mcap match.mcap text.mcap"));
    QCOMPARE(found("keeper r3"), QString());
    QCOMPARE(s.state(), QStringLiteral("0 of 3 sessions"));
    QCOMPARE(s.find<QLabel>("emptyLibrary")->text(),
             QStringLiteral("No session has all of these words."));
    QVERIFY(s.find<QLabel>("emptyLibrary")->isVisible());
    s.search(QString());
    QCOMPARE(s.model()->rowCount(), 3);

    QHeaderView* header = s.table()->horizontalHeader();
    const auto sortBy = [&](int column) {
      QTest::mouseClick(header->viewport(), Qt::LeftButton, {},
                        {header->sectionViewportPosition(column) + 8, header->height() / 2});
      return s.shownFiles();
    };
    QCOMPARE(sortBy(LibraryRow::File), (QStringList{"alone.mcap", "match.mcap", "text.mcap"}));
    QCOMPARE(sortBy(LibraryRow::File), (QStringList{"text.mcap", "match.mcap", "alone.mcap"}));
    for (const int column : {int(LibraryRow::Length), int(LibraryRow::Robots)}) {
      QCOMPARE(sortBy(column), (QStringList{"text.mcap", "alone.mcap", "match.mcap"}));
    }
  }

  void aClickOrEnterOpensAndTheMenuDoesTheRest() {
    const QString folder = folderWith("opens", {"match.mcap", "alone.mcap"});
    Panel s({folder});
    QTRY_COMPARE(s.model()->rowCount(), 2);
    s.waitUntilRead();
    const QString match = folder + "/match.mcap", alone = folder + "/alone.mcap";
    s.click(match);
    QTRY_VERIFY(s.isReplaying(match));
    s.click(alone, Qt::RightButton);
    QVERIFY(s.isReplaying(match));
    s.choose("compareFromLibrary");
    QTRY_VERIFY(!s.window.compared()->isEmpty());
    s.choose("copyLibraryRow");
    QVERIFY(QApplication::clipboard()->text().contains(alone));
    s.table()->setFocus();
    QTest::keyClick(s.table(), Qt::Key_Return);
    QTRY_VERIFY(s.isReplaying(alone));

    // The folder goes with all of its sessions, and stays away.
    s.choose("removeLibraryFolder");
    QTRY_COMPARE(s.model()->rowCount(), 0);
    QCOMPARE(s.settings.value(QStringLiteral("library/folders")).toStringList(), QStringList());
    QTRY_VERIFY(s.find<QLabel>("emptyLibrary")->text().startsWith(QStringLiteral("Add a folder")));
    QVERIFY(QFile::exists(match));
  }

  void theFolderOfRecordingsIsListedAtFirst() {
    studio_rig::Studio studio;
    studio.window.recording()->setFolder(folderWith("recordings", {"alone.mcap"}));
    studio.window.findChild<QAction*>(QStringLiteral("showLibrary"))->trigger();
    auto* model = studio.window.findChild<LibraryModel*>();
    QTRY_COMPARE(model->rowCount(), 1);
    // What is recorded now comes by itself.
    studio.controller.open(link::loadScenario("match-3v3").value(), true);
    QTRY_VERIFY(studio.controller.frame() != nullptr);
    studio.window.recording()->start();
    QVERIFY(studio.window.recording()->isRecording());
    studio.controller.runTo(120);
    QTRY_COMPARE(studio.window.shown()->newest()->snapshot.tick, std::uint64_t(120));
    const QString file = studio.window.recording()->path();
    studio.window.recording()->stop();
    QTRY_VERIFY(model->rowOf(file) >= 0);
    QTRY_COMPARE(model->index(model->rowOf(file), LibraryRow::Length).data().toString(),
                 QStringLiteral("00:02"));
  }

  void whatIsKnownIsRemembered() {
    const QString folder = folderWith("remembers", {"match.mcap", "alone.mcap"});
    const QString match = folder + "/match.mcap", alone = folder + "/alone.mcap";
    {
      Panel s({folder});
      QTRY_COMPARE(s.model()->rowCount(), 2);
      s.waitUntilRead();
      QCOMPARE(s.scan()->unknown(), std::size_t(2));
    }
    // Said by the index, not by the file.
    auto known = link::readSessionIndex(index());
    QCOMPARE(known.size(), std::size_t(2));
    for (link::IndexedSession& one : known) one.overview.teams = {"Said", "by the index"};
    QVERIFY(link::writeSessionIndex(index(), known));
    {
      Panel s({folder});
      QTRY_COMPARE(s.model()->rowCount(), 2);
      s.waitUntilRead();
      QCOMPARE(s.scan()->unknown(), std::size_t(0));
      QCOMPARE(s.cell(match, LibraryRow::Teams), QStringLiteral("Said – by the index"));
      // A note, another file in its place, and one that is gone.
      QVERIFY(telemetry::addSessionNote(match.toStdString(), 2.0, "new"));
      QVERIFY(QFile::remove(alone));
      QVERIFY(QFile::copy(m_small, folder + "/third.mcap"));
      s.find<QPushButton>("libraryFolders")->menu()->aboutToShow();
      s.find<QPushButton>("libraryFolders")->menu()->actions().at(1)->trigger();
      QTRY_COMPARE(s.cell(match, LibraryRow::Notes), QStringLiteral("new"));
      QCOMPARE(s.cell(match, LibraryRow::Teams), QStringLiteral("blue – red"));
      QCOMPARE(s.cell(alone, LibraryRow::File), QStringLiteral("not listed"));
      QTRY_COMPARE(s.cell(folder + "/third.mcap", LibraryRow::File), QStringLiteral("third.mcap"));
      s.waitUntilRead();
    }
    known = link::readSessionIndex(index());
    QCOMPARE(known.size(), std::size_t(2));
    QCOMPARE(known[0].path, match.toStdString());
  }

  void aDamagedIndexIsMadeAgain_data() {
    QTest::addColumn<int>("at");
    QTest::newRow("heading") << 3;
    QTest::newRow("line") << 90;
    QTest::newRow("cut") << -1;
  }
  void aDamagedIndexIsMadeAgain() {
    QFETCH(int, at);
    const QString folder = folderWith(QStringLiteral("damaged%1").arg(at), {"alone.mcap"});
    QVERIFY(QDir().mkpath(cache()));
    const auto stamp = link::stampOf((folder + "/alone.mcap").toStdString());
    const link::IndexedSession session{(folder + "/alone.mcap").toStdString(), *stamp, {}};
    QVERIFY(link::writeSessionIndex(index(), {&session, 1}));
    QFile file(QString::fromStdString(index()));
    QVERIFY(file.open(QIODevice::ReadWrite));
    if (at < 0) {
      QVERIFY(file.resize(file.size() - 20));
    } else {
      QVERIFY(file.seek(at) && file.write("\"{[\0") > 0);
    }
    file.close();
    Panel s({folder});
    QTRY_COMPARE(s.cell(folder + "/alone.mcap", LibraryRow::Robots), QStringLiteral("1"));
    s.waitUntilRead();
    QCOMPARE(link::readSessionIndex(index()).size(), std::size_t(1));
  }

  void picturesShowTheFieldAndAreKept() {
    const QString folder = folderWith("pictures", {"match.mcap", "text.mcap"});
    const QString match = folder + "/match.mcap";
    const auto pictureOf = [&match](const Panel& s) {
      const int row = s.model()->rowOf(match);
      if (row < 0) return QImage();
      const auto icon =
          s.model()->index(row, LibraryRow::Date).data(Qt::DecorationRole).value<QIcon>();
      return icon.availableSizes().isEmpty() ? QImage()
                                             : icon.pixmap(icon.availableSizes().first()).toImage();
    };
    const auto isGrass = [](const QImage& picture) {
      const QColor corner = picture.pixelColor(picture.width() / 4, picture.height() / 8);
      const QColor grass = theme().grass;
      return std::abs(corner.red() - grass.red()) + std::abs(corner.green() - grass.green()) +
                 std::abs(corner.blue() - grass.blue()) <
             24;
    };
    QString kept;
    {
      Panel s({folder});
      QTRY_VERIFY(pictureOf(s).width() > 100 && isGrass(pictureOf(s)));
      const QStringList names = QDir(cache()).entryList({"*.png"});
      QTRY_COMPARE(QDir(cache()).entryList({"*.png"}).size(), 1);
      kept = cache() + QLatin1Char('/') + QDir(cache()).entryList({"*.png"}).first();
    }
    // The next start shows the one that was kept.
    QImage red(160, 100, QImage::Format_RGB32);
    red.fill(Qt::red);
    QVERIFY(red.save(kept));
    Panel s({folder});
    QTRY_VERIFY(pictureOf(s).width() > 100 && pictureOf(s).pixelColor(80, 50) == QColor(Qt::red));
    // It goes with its session.
    QVERIFY(QFile::remove(match));
    s.window.findChild<LibraryScan*>()->start({folder});
    QTRY_VERIFY(!QFile::exists(kept));
  }

  void readingIsCancelledAndGoesOn() {
    const QString folder = manySessions("cancelled", 1000);
    Panel s({folder});
    auto* cancel = s.find<QPushButton>("cancelLibrary");
    QVERIFY(QTest::qWaitFor([cancel] { return cancel->isVisible(); }));
    QTest::mouseClick(cancel, Qt::LeftButton);
    QVERIFY(!s.scan()->isRunning() && s.state().endsWith(QStringLiteral("cancelled")));
    QVERIFY(!cancel->isVisible());
    s.find<QPushButton>("libraryFolders")->menu()->aboutToShow();
    s.find<QPushButton>("libraryFolders")->menu()->actions().at(1)->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(s.model()->rowCount(), 1000, 60'000);
  }

  /// The first time they are read; then they are there within a second.
  void aThousandSessionsAppearAtOnce() {
    const QString folder = manySessions("thousand", 1000);
    {
      Panel s({folder});
      const tests::EventLoopWatchdog turns;
      QTRY_COMPARE_WITH_TIMEOUT(s.model()->rowCount(), 1000, 120'000);
      s.waitUntilRead();
      if (!PITCHBOARD_SANITIZED) {
        QVERIFY2(turns.longest_ms() < 50.0, qPrintable(QString::number(turns.longest_ms())));
      }
    }
    studio_rig::Studio studio;
    studio.settings.setValue(QStringLiteral("library/folders"), QStringList{folder});
    auto* model = studio.window.findChild<LibraryModel*>();
    const double before = processSeconds();
    studio.window.findChild<QAction*>(QStringLiteral("showLibrary"))->trigger();
    QTRY_COMPARE(model->rowCount(), 1000);
    const double took = processSeconds() - before;
    QCOMPARE(studio.window.findChild<LibraryScan*>()->unknown(), std::size_t(0));
    if (PITCHBOARD_SANITIZED) return;
    QVERIFY2(took < 1.0, qPrintable(QString::number(took)));
  }

  void tenThousandSessionsDoNotBlockTheWindow() {
    constexpr int count = 10'000;
    const QString folder = manySessions("many", 1);
    const QString first = folder + QStringLiteral("/day 0/match 0.mcap");
    const link::SessionOverview overview = link::overviewOf(first.toStdString());
    std::vector<link::IndexedSession> sessions;
    for (int i = 0; i < count; ++i) {
      const QString file = folder + QStringLiteral("/day 0/match %1.mcap").arg(i);
      if (i > 0) hardLink(first, file);
      sessions.push_back({file.toStdString(), *link::stampOf(file.toStdString()), overview});
      sessions.back().overview.events = static_cast<std::uint64_t>((i * 7919) % count);
      if (i % 100 == 42) sessions.back().overview.notes = {"a broken gyroscope"};
    }
    QVERIFY(QDir().mkpath(cache()));
    QVERIFY(link::writeSessionIndex(index(), sessions));
    studio_rig::Studio studio;
    studio.settings.setValue(QStringLiteral("library/folders"), QStringList{folder});
    auto* dock = studio.window.findChild<QDockWidget*>(QStringLiteral("library"));
    auto* model = studio.window.findChild<LibraryModel*>();
    studio.window.findChild<QAction*>(QStringLiteral("showLibrary"))->trigger();
    QVERIFY(QTest::qWaitForWindowExposed(&studio.window));
    QCoreApplication::processEvents();
    const tests::EventLoopWatchdog turns;
    QTRY_COMPARE(model->rowCount(), count);
    QTRY_VERIFY(!studio.window.findChild<LibraryScan*>()->isRunning());
    auto* table = dock->findChild<QTableView*>(QStringLiteral("library"));
    for (int i = 0; i <= 20; ++i) {
      QScrollBar* bar = table->verticalScrollBar();
      bar->setValue(bar->maximum() / 20 * i);
      QTest::qWait(1);
    }
    auto* words = dock->findChild<QLineEdit*>(QStringLiteral("librarySearch"));
    for (const char key : std::string_view("gyroscope")) {
      QTest::keyClick(words, key);
      QTest::qWait(1);
    }
    QCOMPARE(model->rowCount(), count / 100);
    words->clear();
    QTest::qWait(1);
    for (int column = 0; column < LibraryRow::columns; ++column) {
      table->sortByColumn(column, column % 2 ? Qt::AscendingOrder : Qt::DescendingOrder);
      QTest::qWait(1);
    }
    table->sortByColumn(LibraryRow::Events, Qt::DescendingOrder);
    QCOMPARE(model->at(0)->session.overview.events, std::uint64_t(count - 1));
    qInfo("longest turn: %.1f ms of work, %.1f ms by the clock", turns.longest_ms(),
          turns.gap_ms());
    if (PITCHBOARD_SANITIZED) return;
    QVERIFY2(turns.longest_ms() < 50.0, qPrintable(QString::number(turns.longest_ms())));
  }
};

PITCHBOARD_GUI_TEST(TestLibraryDock)

}  // namespace tst_library_dock

#include "tst_library_dock.moc"
