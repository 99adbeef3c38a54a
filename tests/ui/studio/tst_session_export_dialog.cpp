// SPDX-License-Identifier: GPL-3.0-or-later
// Export through its dialog: from a session, and from memory; and what every writer of the studio
// leaves when the disk is full.
#include <QComboBox>
#include <QDateTimeEdit>
#include <QDesktopServices>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLayout>
#include <QLineEdit>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QStandardPaths>
#include <QSvgRenderer>
#include <QToolButton>
#include <array>
#include <cmath>

#include <telemetry/monitor/team_setup.h>
#include <telemetry/session/session_reader.h>
#include <ui/field/field_view.h>
#include <ui/plots/plots_dock.h>
#include <ui/session/export_dialog.h>
#include <ui/sources/replay_controller.h>

#include "../support/small_disk.h"
#include "export_rig.h"
#include "moment_box.h"
#include "plot_export.h"
#include "plot_page.h"
#include "plot_presets.h"
#include "profile_editor.h"

namespace tst_session_export_dialog {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace session_rig;

/// What the desktop was asked to open.
class UrlCatcher : public QObject {
  Q_OBJECT
 public:
  QList<QUrl> urls;
 public slots:
  void take(const QUrl& url) { urls << url; }
};

class TestSessionExportDialog : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  // By the dialog and by the menu: where a robot was, and not where it went from there.
  void aPictureIsOfTheMomentShown() {
    Studio s(600);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    const FramePtr now = s.controller.frame(), past = s.controller.frameAt(2.0);
    QVERIFY(past && past->robots.size() == now->robots.size());
    const auto moved = [&](std::size_t i) {
      const Point a = past->robots[i].pose.position, b = now->robots[i].pose.position;
      return std::hypot(a.x - b.x, a.y - b.y);
    };
    // Nobody has taken its place since.
    const auto isFree = [&](const Point& place) {
      return std::ranges::all_of(now->robots, [&](const link::RobotFrame& other) {
        const Point& at = other.pose.position;
        return std::hypot(at.x - place.x, at.y - place.y) > 0.6;
      });
    };
    std::size_t robot = 0;
    for (std::size_t i = 1; i < now->robots.size(); ++i) {
      if (moved(i) > moved(robot) && isFree(past->robots[i].pose.position)) robot = i;
    }
    QVERIFY2(moved(robot) > 0.8, "nobody has walked");
    const QColor team = theme().team(now->robots[robot].identity.team);
    const auto isAt = [&](const QImage& image, const Point& p) {
      const auto& field = now->settings->field;
      const double scale = std::min(image.width() / (field.length + 2 * field.border),
                                    image.height() / (field.width + 2 * field.border));
      const QPoint at(qRound(image.width() / 2.0 + p.x * scale),
                      qRound(image.height() / 2.0 - p.y * scale));
      int found = 0;  // around the number, which is drawn over it
      for (int y = -6; y <= 6; ++y) {
        for (int x = -6; x <= 6; ++x) found += image.pixelColor(at + QPoint(x, y)) == team;
      }
      return found > 40;
    };
    ExportDialog* dialog = openExport(s);
    QVERIFY(dialog != nullptr);
    choose(dialog, QStringLiteral("(PNG)"));
    const auto pictures = [&](const char* name) {
      const QString path = s.folder.filePath(QLatin1String(name));
      dialog->exportTo(path + QStringLiteral("-dialog.png"));
      s.window.files()->exportPicture(path + QStringLiteral("-menu.png"));
      return std::array{QImage(path + QStringLiteral("-dialog.png")),
                        QImage(path + QStringLiteral("-menu.png"))};
    };
    const Point was = past->robots[robot].pose.position, is = now->robots[robot].pose.position;
    for (const QImage& image : pictures("now")) {
      QVERIFY(!image.isNull());
      QVERIFY(isAt(image, is) && !isAt(image, was));
    }
    s.window.shown()->seek(2.0);
    for (const QImage& image : pictures("past")) {
      QVERIFY(!image.isNull());
      QVERIFY(isAt(image, was) && !isAt(image, is));
    }
    s.window.shown()->goLive();
    for (const QImage& image : pictures("again")) QVERIFY(isAt(image, is) && !isAt(image, was));
  }

  // The lists of robots and variables say how many of all are chosen, those that the filter hides
  // included.
  void theListsCountWhatIsChosen() {
    Studio s(60);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(60), 20'000);
    ExportDialog* dialog = openExport(s);
    QVERIFY(dialog != nullptr);
    choose(dialog, QStringLiteral("row per time"));
    const auto counts = dialog->findChildren<QLabel*>(QStringLiteral("ticked"));
    QCOMPARE(counts.size(), qsizetype(2));
    for (const QLabel* count : counts) {
      QWidget* list = count->parentWidget();
      const int all = list->findChild<QListWidget*>()->count();
      QVERIFY(all >= 7);
      const auto shows = [&](int chosen) {
        return count->text() == QStringLiteral("%1 of %2").arg(chosen).arg(all);
      };
      const auto press = [list](const char* text) {
        for (auto* button : list->findChildren<QToolButton*>()) {
          if (button->text() == QLatin1String(text)) button->click();
        }
      };
      press("All");
      QVERIFY2(shows(all), qPrintable(count->text()));
      list->findChild<QListWidget*>()->item(0)->setCheckState(Qt::Unchecked);
      QVERIFY2(shows(all - 1), qPrintable(count->text()));
      press("None");
      QVERIFY2(shows(0), qPrintable(count->text()));
      auto* filter = list->findChild<QLineEdit*>();
      QTest::keyClicks(filter, list->findChild<QListWidget*>()->item(1)->text());
      press("All");
      QVERIFY2(!shows(0) && !shows(all), qPrintable(count->text()));
      filter->clear();
      press("All");
      QVERIFY2(shows(all), qPrintable(count->text()));
    }
  }

  void everyForm_data() {
    QTest::addColumn<QString>("form");
    QTest::addColumn<QString>("suffix");
    QTest::addColumn<bool>("fromMemory");
    for (const bool memory : {false, true}) {
      const QByteArray of = memory ? " of memory" : " of a file";
      QTest::newRow("csv" + of) << QStringLiteral("row per time") << QStringLiteral(".csv")
                                << memory;
      QTest::newRow("mcap" + of) << QStringLiteral("MCAP") << QStringLiteral(".mcap") << memory;
      QTest::newRow("report" + of) << QStringLiteral("Report") << QStringLiteral(".html") << memory;
      QTest::newRow("svg" + of) << QStringLiteral("(SVG)") << QStringLiteral(".svg") << memory;
      QTest::newRow("png" + of) << QStringLiteral("(PNG)") << QStringLiteral(".png") << memory;
      QTest::newRow("video" + of) << QStringLiteral("(MP4)") << QStringLiteral(".mp4") << memory;
    }
  }
  void everyForm() {
    QFETCH(QString, form);
    QFETCH(QString, suffix);
    QFETCH(bool, fromMemory);
    const bool video = suffix == QStringLiteral(".mp4");
    if (video && QStandardPaths::findExecutable(QStringLiteral("ffmpeg")).isEmpty()) {
      QSKIP("ffmpeg is not installed");
    }
    // From 5.01667 s to 7.33333 s: moments that milliseconds would leave out.
    Studio s(301);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(301), 20'000);
    if (!fromMemory) {
      const QString session = s.recorded(139);
      QVERIFY(!session.isEmpty());
      s.window.openSession(session);
      QTRY_VERIFY(!s.window.shown()->kind().hasPresent);
    }
    ExportDialog* dialog = openExport(s);
    QVERIFY(dialog != nullptr);
    choose(dialog, form);
    QCOMPARE(dialog->suffix(), suffix);
    small(dialog);
    const QString path = s.folder.filePath(QStringLiteral("out") + suffix);
    QVERIFY2(exported(dialog, path).written == 1, qPrintable(message(dialog)));
    const QByteArray bytes = contents(path);
    QVERIFY(!bytes.isEmpty());
    if (suffix == QStringLiteral(".csv")) {
      QVERIFY2(bytes.left(2000).contains("B1."), bytes.left(200).constData());
      const QList<QByteArray> rows = bytes.trimmed().split('\n');
      QVERIFY(rows.size() > 140);
      QVERIFY2(rows.at(1).startsWith(fromMemory ? "0," : "5.01666"),
               rows.at(1).left(20).constData());
      QVERIFY2(rows.last().startsWith(fromMemory ? "5.01666" : "7.33333"),
               rows.last().left(20).constData());
    } else if (suffix == QStringLiteral(".mcap")) {
      const auto session = telemetry::SessionReader::open(path.toStdString());
      QVERIFY(session && session->complete() && session->range());
    } else if (suffix == QStringLiteral(".html")) {
      QVERIFY(bytes.contains("data:image/png;base64"));
    } else if (suffix == QStringLiteral(".svg")) {
      QSvgRenderer renderer(bytes);
      QVERIFY(renderer.isValid());
      QCOMPARE(renderer.viewBox(), QRect(0, 0, 506, 360));
      // Shapes, not a picture in a picture.
      QVERIFY(!bytes.contains("<image"));
    } else if (suffix == QStringLiteral(".png")) {
      QCOMPARE(QImage::fromData(bytes).size(), QSize(506, 360));
    } else {
      QCOMPARE(bytes.mid(4, 4), QByteArray("ftyp"));
    }
    // The same name again replaces it, and a link to what is replayed does not.
    overwrite(path, "old");
    QVERIFY2(exported(dialog, path).written == 1, qPrintable(message(dialog)));
    QVERIFY(contents(path).size() > 3);
    if (!fromMemory) {
      const QString session = s.window.replay()->path();
      const QByteArray precious = contents(session);
      const QString link = s.folder.filePath(QStringLiteral("link") + suffix);
      QVERIFY(QFile::link(session, link));
      QSignalSpy failed(dialog, &ExportDialog::failed);
      dialog->exportTo(link);
      QTRY_COMPARE_WITH_TIMEOUT(failed.size(), 1, 20'000);
      QVERIFY2(message(dialog).contains(QStringLiteral("being read")), qPrintable(message(dialog)));
      QVERIFY(contents(session) == precious);
    }
    QVERIFY(parts(s.folder.path()).isEmpty());
  }

  /// Whatever is written over an old file: when the disk is full the old one is still there.
  void aFullDiskKeepsTheOldFile() {
    Studio s(300);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(300), 20'000);
    auto* plots = s.window.findChild<PlotsDock*>();
    plots->plotVariables({QStringLiteral("B1/TRUE_X")});
    ScenarioFiles scenarios(&s.controller, s.window.field(), nullptr, &s.window);
    telemetry::Profile profile = telemetry::publishedProfile();
    profile.name = "mine";
    ProfileEditor editor(profile, {}, nullptr);
    telemetry::TeamSetup team;
    team.name = "Team";
    team.number = 12;
    team.senders = {"10.0.0.0/8", "192.168.0.0/16"};  // longer than the small disk

    struct Writer {
      const char* name;
      std::function<bool(const QString&)> write;  ///< true: it is written
    };
    const auto reported = [&scenarios](void (ScenarioFiles::*work)(const QString&)) {
      return [&scenarios, work](const QString& path) {
        QSignalSpy failed(&scenarios, &ScenarioFiles::failed);
        (scenarios.*work)(path);
        return failed.isEmpty();
      };
    };
    std::vector<Writer> writers{
        {"scenario.json", reported(&ScenarioFiles::save)},
        {"field.png", reported(&ScenarioFiles::exportPicture)},
        {"field.svg", reported(&ScenarioFiles::exportPicture)},
        {"layout.json",
         [&](const QString& path) {
           return PlotPresets::writeFile(path, plots->layoutSpec()).has_value();
         }},
        {"plots.png",
         [&](const QString& path) {
           return savePlotPicture(plotPng(*plots->currentPage()), path).has_value();
         }},
        {"plots.svg",
         [&](const QString& path) {
           return savePlotPicture(plotSvg(*plots->currentPage()), path).has_value();
         }},
        {"plots.csv",
         [&](const QString& path) {
           return savePlotCsv(plots->currentPage()->panes(), {0.0, 5.0}, path).has_value();
         }},
        {"profile.json", [&](const QString& path) { return editor.saveTo(path); }},
        {"team.json",
         [&](const QString& path) {
           return telemetry::saveTeamSetup(team, path.toStdString()).has_value();
         }},
    };
    const QDir folder(s.folder.filePath(QStringLiteral("written")));
    QVERIFY(folder.mkpath(QStringLiteral(".")));
    QStringList names;
    for (const Writer& writer : writers) {
      const QString path = folder.filePath(QLatin1String(writer.name));
      names << QLatin1String(writer.name);
      overwrite(path, "old");
      {
        const SmallDisk disk(64);
        QVERIFY2(!writer.write(path), writer.name);
      }
      QVERIFY2(contents(path) == "old", writer.name);
      // It was the disk: with room it is replaced.
      QVERIFY2(writer.write(path), writer.name);
      QVERIFY2(contents(path).size() > 64, writer.name);
    }
    names.sort();
    QCOMPARE(folder.entryList(QDir::Files | QDir::Hidden, QDir::Name), names);
  }

  void aVideoIsCancelledWithTheButton() {
    if (QStandardPaths::findExecutable(QStringLiteral("ffmpeg")).isEmpty()) {
      QSKIP("ffmpeg is not installed");
    }
    Studio s(600);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(600), 20'000);
    ExportDialog* dialog = openExport(s);
    choose(dialog, QStringLiteral("(WebM)"));
    QSignalSpy failed(dialog, &ExportDialog::failed);
    const QString path = s.folder.filePath(QStringLiteral("out.webm"));
    dialog->exportTo(path);
    QVERIFY(dialog->isWriting());
    auto* bar = dialog->findChild<QProgressBar*>(QStringLiteral("exportProgress"));
    QTRY_VERIFY_WITH_TIMEOUT(bar->value() > 0, 20'000);
    QTest::mouseClick(dialog->findChild<QPushButton*>(QStringLiteral("exportButton")),
                      Qt::LeftButton);
    QCOMPARE(failed.size(), 1);
    QVERIFY(!dialog->isWriting());
    QVERIFY2(message(dialog).contains(QStringLiteral("cancelled")), qPrintable(message(dialog)));
    QVERIFY(!QFile::exists(path));
    QVERIFY(parts(s.folder.path()).isEmpty());
  }

  void withoutFfmpegTheDialogNamesThePackage() {
    Studio s(60);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(60), 20'000);
    ExportDialog* dialog = openExport(s);
    choose(dialog, QStringLiteral("(MP4)"));
    const QByteArray path = qgetenv("PATH");
    const auto again = qScopeGuard([&path] { qputenv("PATH", path); });
    qputenv("PATH", s.folder.path().toUtf8());
    QSignalSpy failed(dialog, &ExportDialog::failed);
    dialog->exportTo(s.folder.filePath(QStringLiteral("out.mp4")));
    QTRY_COMPARE_WITH_TIMEOUT(failed.size(), 1, 20'000);
    QVERIFY2(message(dialog).contains(QStringLiteral("Install the package ffmpeg")),
             qPrintable(message(dialog)));
  }

  void aRangeTheWrongWayRoundIsReported() {
    Studio s(60);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(60), 20'000);
    ExportDialog* dialog = openExport(s);
    dialog->findChild<QDoubleSpinBox*>(QStringLiteral("exportBegin"))->setValue(5);
    dialog->findChild<QDoubleSpinBox*>(QStringLiteral("exportEnd"))->setValue(1);
    QSignalSpy failed(dialog, &ExportDialog::failed);
    dialog->exportTo(s.folder.filePath(QStringLiteral("out.csv")));
    QCOMPARE(failed.size(), 1);
    QVERIFY(message(dialog).contains(QStringLiteral("ends before it begins")));
  }

  void momentsAreRead_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<std::optional<double>>("seconds");
    const auto row = [](const char* text, std::optional<double> seconds) {
      QTest::newRow(*text == 0 ? "nothing" : text) << QString::fromUtf8(text) << seconds;
    };
    row("02:23.683", 143.683);
    row("1:02:03.5", 3723.5);
    row("\u221200:05.25", -5.25);
    row("143.683 s", 143.683);
    row("62,5", 62.5);
    for (const char* wrong : {"", "2:", ":30", "a", "1:2:3:4", "1:-5", "nan", "1e9", "1:75"})
      row(wrong, {});
  }
  void momentsAreRead() {
    QFETCH(QString, text);
    QTEST(momentFromText(text), "seconds");
  }

  void theRangeIsTypedAsSecondsOrAsTimesOfDay() {
    ExportSource source;
    source.clock = QDateTime(QDate(2026, 7, 4), QTime(15, 0, 0, 250));
    ExportDialog dialog(source, {10.0, 70.5}, nullptr, nullptr);
    auto* begin = dialog.findChild<QDoubleSpinBox*>(QStringLiteral("exportBegin"));
    auto* end = dialog.findChild<QDoubleSpinBox*>(QStringLiteral("exportEnd"));
    auto* from = dialog.findChild<QDateTimeEdit*>(QStringLiteral("exportBeginClock"));
    auto* to = dialog.findChild<QDateTimeEdit*>(QStringLiteral("exportEndClock"));
    QCOMPARE(from->text(), QStringLiteral("2026-07-04 15:00:10"));
    QCOMPARE(to->text(), QStringLiteral("2026-07-04 15:01:10"));
    // To look at a time does not change it.
    QCOMPARE(begin->value(), 10.0);
    QCOMPARE(end->value(), 70.5);
    end->setValue(3600.0);
    QCOMPARE(to->text(), QStringLiteral("2026-07-04 16:00:00"));
    from->setDateTime(QDateTime(QDate(2026, 7, 4), QTime(15, 30)));
    QCOMPARE(begin->value(), 1799.75);
    QCOMPARE(end->value(), 3600.0);
    // Seconds are written as the timeline writes them, and typed in both ways.
    end->setValue(143.683);
    QCOMPARE(end->text(), QStringLiteral("02:23.683"));
    for (const auto& [typed, seconds] : {std::pair("1:05,5", 65.5), {"90", 90.0}, {"a", 90.0}}) {
      end->selectAll();
      QTest::keyClicks(end, QLatin1String(typed));
      QTest::keyClick(end, Qt::Key_Tab);
      QCOMPARE(end->value(), seconds);
    }
    // Without a time of day there is nothing to type it into.
    ExportDialog without({}, {0.0, 1.0}, nullptr, nullptr);
    without.show();
    QVERIFY(!without.findChild<QDateTimeEdit*>(QStringLiteral("exportBeginClock"))->isVisible());
  }

  // For every format the dialog is as high as what it asks for.
  void nothingIsEmpty() {
    Studio s(60);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(60), 20'000);
    ExportDialog* dialog = openExport(s);
    QVERIFY(dialog != nullptr);
    dialog->show();
    auto* format = dialog->findChild<QComboBox*>(QStringLiteral("exportFormat"));
    int lowest = 10'000, highest = 0;
    for (int i = 0; i < format->count(); ++i) {
      format->setCurrentIndex(i);
      const int wanted = dialog->layout()->sizeHint().height();
      QTRY_VERIFY2(std::abs(dialog->height() - wanted) < scaled(dialog, 24),
                   qPrintable(QStringLiteral("%1: %2 instead of %3")
                                  .arg(format->currentText())
                                  .arg(dialog->height())
                                  .arg(wanted)));
      lowest = std::min(lowest, dialog->height());
      highest = std::max(highest, dialog->height());
    }
    QVERIFY(lowest < highest);
    QVERIFY2(highest < scaled(dialog, 520), qPrintable(QString::number(highest)));
  }

  void robotsAndVariablesAreTicked() {
    Studio s(300);
    QTRY_VERIFY_WITH_TIMEOUT(s.played(300), 20'000);
    ExportDialog* dialog = openExport(s);
    QVERIFY(dialog != nullptr);
    choose(dialog, QStringLiteral("fixed rate"));
    const auto lists = dialog->findChildren<QListWidget*>();
    QCOMPARE(lists.size(), 2);
    const auto tick = [](QListWidget* list, const QStringList& names) {
      for (int i = 0; i < list->count(); ++i) {
        const bool on = names.contains(list->item(i)->text());
        list->item(i)->setCheckState(on ? Qt::Checked : Qt::Unchecked);
      }
    };
    QSignalSpy failed(dialog, &ExportDialog::failed), written(dialog, &ExportDialog::written);
    const QString path = s.folder.filePath(QStringLiteral("some.csv"));
    tick(lists[0], {});
    dialog->exportTo(path);
    QCOMPARE(failed.size(), 1);
    tick(lists[0], {QStringLiteral("B2"), QStringLiteral("match")});
    tick(lists[1], {QStringLiteral("TRUE_X"), QStringLiteral("BALL_X")});
    auto* open = dialog->findChild<QToolButton*>(QStringLiteral("exportOpen"));
    auto* folder = dialog->findChild<QToolButton*>(QStringLiteral("exportShow"));
    QVERIFY(!open->isVisibleTo(dialog) && !folder->isVisibleTo(dialog));
    dialog->exportTo(path);
    QTRY_VERIFY2_WITH_TIMEOUT(written.size() == 1, qPrintable(message(dialog)), 60'000);
    const QList<QByteArray> lines = contents(path).split('\n');
    QCOMPARE(lines[0], QByteArray("time,match.BALL_X,B2.TRUE_X"));
    // Ten lines a second of about five seconds.
    QVERIFY2(lines.size() > 40 && lines.size() < 70, qPrintable(QString::number(lines.size())));
    for (const QByteArray& line : lines.mid(1, 40)) QCOMPARE(line.count(','), 2);
    QVERIFY(open->isVisibleTo(dialog) && folder->isVisibleTo(dialog));
    // They show this file and its folder with whatever opens them here.
    UrlCatcher caught;
    QDesktopServices::setUrlHandler(QStringLiteral("file"), &caught, "take");
    open->click();
    folder->click();
    QDesktopServices::unsetUrlHandler(QStringLiteral("file"));
    QCOMPARE(caught.urls.size(), 2);
    QCOMPARE(caught.urls[0].toLocalFile(), path);
    QCOMPARE(caught.urls[1].toLocalFile(), QFileInfo(path).absolutePath());
  }
};

PITCHBOARD_GUI_TEST(TestSessionExportDialog)

}  // namespace tst_session_export_dialog

#include "tst_session_export_dialog.moc"
