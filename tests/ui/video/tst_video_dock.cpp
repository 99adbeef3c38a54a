// SPDX-License-Identifier: GPL-3.0-or-later
// The panel Video in the window, with mouse and keys: numbers painted into clips are read back from
// the screen at moments of a recording and of a match that goes on; alignment, drift and field
// points are compared with values worked out on paper.
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDropEvent>
#include <QLabel>
#include <QMimeData>
#include <QPainter>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QToolButton>
#include <cmath>
#include <random>

#include <robotlink/scenario/scenario.h>
#include <telemetry/session/session_notes.h>
#include <telemetry/session/session_videos.h>
#include <ui/base/number_box.h>
#include <ui/base/theme.h>
#include <ui/base/time_axis.h>
#include <ui/session/export_dialog.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/session_recording.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/scenario_files.h>

#include "../../support/numbered_clip.h"
#include "../../support/program_run.h"
#include "../live_window.h"
#include "../studio_rig.h"
#include "video_camera.h"
#include "video_tracks.h"
#include "video_view.h"

namespace tst_video_dock {

using namespace pitchboard;
using namespace pitchboard::ui;
using Clip = tests::NumberedClip;

namespace {

constexpr int patience_ms = 30'000;
constexpr int clipLength = 150;  // pictures, 25 a second

struct Panel : studio_rig::PanelStudio {
  Panel() : PanelStudio("video") {}
  ShownMoment* shown() { return window.shown(); }
  QList<VideoView*> views() const { return dock->findChildren<VideoView*>(); }
  VideoCamera* camera(int index = 0) const { return views().at(index)->camera(); }
  bool isOpen(int index = 0) const {
    return views().size() > index && camera(index)->info() != nullptr;
  }
  /// The number that can be read on the screen; -1: none.
  int number(int index = 0) const {
    VideoView* view = views().at(index);
    const QImage seen = view->grab().toImage();
    const QRect picture = view->pictureRect().toAlignedRect();
    return Clip::numberIn(picture.width(), picture.height(), [&](int x, int y) {
      return qGray(seen.pixel(std::clamp(picture.left() + x, 0, seen.width() - 1),
                              std::clamp(picture.top() + y, 0, seen.height() - 1)));
    });
  }
  void drop(const QString& file) const {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(file)});
    QWidget* at = dock->widget();
    QDragEnterEvent enter({9, 9}, Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(at, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent dropped(QPointF(9, 9), Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(at, &dropped);
  }
  void press(const char* name) const {
    QTest::mouseClick(find<QAbstractButton>(name), Qt::LeftButton);
  }
};

std::vector<telemetry::SessionVideo> keptOf(const QString& session) {
  return telemetry::readSessionVideos(session.toStdString()).value();
}

}  // namespace

class TestVideoDock : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  QString m_clip;

  QString path(const QString& name) const { return m_folder.filePath(name); }

  /// A session of its own, with the clip from its second 2.
  QString session(const QString& name, std::vector<telemetry::VideoAnchor> anchors = {{2.0, 0.0}}) {
    const QString file = path(name);
    if (!QFile::copy(path("match.mcap"), file)) qFatal("not copied");
    const telemetry::SessionVideo video{m_clip.toStdString(), std::move(anchors), {}};
    if (!telemetry::writeSessionVideos(file.toStdString(), {&video, 1})) qFatal("not written");
    return file;
  }

 private slots:
  void initTestCase() {
    if (!Clip::canBeMade()) QSKIP("ffmpeg is not installed");
    setTheme(*qApp, ThemeChoice::Dark);
    const ProgramRun run = cli({"record", "--scenario", "match-3v3", "--seed", "3", "--speed",
                                "max", "--duration", "12", "-o", path("match.mcap")});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    m_clip = path("clip.mp4");
    QVERIFY(Clip::make(m_clip, clipLength,
                       {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-bf", "3", "-g", "50",
                        "-metadata", "creation_time=2024-07-19T13:05:30Z"}));
  }

  void picturesFollowTheMomentThatIsShown() {
    Panel s;
    QVERIFY(s.find<QLabel>("emptyVideo")->isVisible());
    s.open(session("follows.mcap"));
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
    std::mt19937 random(5);
    for (int seek = 0; seek < 100; ++seek) {
      const int picture = static_cast<int>(random() % clipLength);
      const double within = 0.1 + 0.8 * static_cast<double>(random() % 100) / 100.0;
      s.shown()->seek(2.0 + (picture + within) / 25.0);
      QTRY_COMPARE_WITH_TIMEOUT(s.number(), picture, patience_ms);
    }
    // Before and after it no picture is shown.
    for (const double outside : {1.9, 8.1}) {
      s.shown()->seek(outside);
      QTRY_COMPARE_WITH_TIMEOUT(s.number(), -1, patience_ms);
    }
  }

  void keysStepSinglePictures() {
    Panel s;
    s.open(session("keys.mcap"));
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
    s.shown()->seek(4.01);  // picture 50
    QTRY_COMPARE_WITH_TIMEOUT(s.number(), 50, patience_ms);
    s.window.activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&s.window));
    for (const int expected : {51, 52, 53}) {
      QTest::keyClick(&s.window, Qt::Key_Period);
      QTRY_COMPARE_WITH_TIMEOUT(s.number(), expected, patience_ms);
    }
    for (const int expected : {52, 51, 50, 49}) {
      QTest::keyClick(&s.window, Qt::Key_Comma);
      QTRY_COMPARE_WITH_TIMEOUT(s.number(), expected, patience_ms);
    }
    QVERIFY(std::abs(s.shown()->time() - (2.0 + 49 / 25.0)) < 1e-9);
  }

  void itPlaysAtEverySpeed() {
    Panel s;
    s.open(session("plays.mcap"));
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
    for (const double speed : {0.1, 1.0, 8.0}) {
      s.shown()->seek(2.02);
      s.shown()->setSpeed(speed);
      s.shown()->setPaused(false);
      s.shown()->advance(0.4);
      s.shown()->setPaused(true);
      const double expected = std::floor((s.shown()->time() - 2.0) * 25.0);
      QVERIFY(s.shown()->time() >= 2.02 + 0.4 * speed - 1e-9);
      QTRY_COMPARE_WITH_TIMEOUT(s.number(), static_cast<int>(expected), patience_ms);
    }
  }

  void oneMomentAlignsAndASecondGivesDrift() {
    Panel s;
    const QString file = session("aligned.mcap");
    s.open(file);
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
    s.shown()->seek(3.0);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(), 25, patience_ms);
    s.press("alignVideo");
    auto* slider = s.find<QSlider>("videoPosition");
    QCOMPARE(slider->value(), 25);
    // The video is gone through, the session stands still.
    slider->setValue(50);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(), 50, patience_ms);
    QCOMPARE(s.shown()->time(), 3.0);
    QTest::keyClick(&s.window, Qt::Key_Period);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(), 51, patience_ms);
    slider->setValue(50);
    // 2 s of the video are 3 s of the session: it starts at 1 s.
    s.press("videoSameMoment");
    QCOMPARE(s.camera()->alignment(), (telemetry::VideoAlignment{1.0, 1.0}));
    QCOMPARE(s.find<NumberBox>("videoBegin")->value(), 1.0);
    // 4.8 s of the video are 5.94 s of the session: (5.94 - 3)/(4.8 - 2) = 1.05.
    s.shown()->seek(5.94);
    slider->setValue(120);
    s.press("videoSecondMoment");
    QVERIFY(std::abs(s.camera()->alignment().rate - 1.05) < 1e-9);
    QVERIFY(std::abs(s.camera()->alignment().offset - 0.9) < 1e-9);  // 3 - 1.05·2
    QCOMPARE(s.find<QLabel>("videoDrift")->text(), QStringLiteral("plays at ×1.050"));
    // Shifting keeps the drift.
    s.find<NumberBox>("videoBegin")->setValue(1.4);
    QVERIFY(std::abs(s.camera()->alignment().offset - 1.4) < 1e-9);
    QVERIFY(std::abs(s.camera()->alignment().rate - 1.05) < 1e-9);
    s.press("alignDone");
    // (4.571 - 1.4)/1.05 = 3.02 s: picture 75.
    s.shown()->seek(4.571);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(), 75, patience_ms);
    // The same picture again would be another moment.
    s.press("alignVideo");
    s.find<QSlider>("videoPosition")->setValue(50);
    s.press("videoSecondMoment");
    QVERIFY(s.find<QLabel>("inPlaceText")->text().contains(QStringLiteral("contradict")));
    QVERIFY(std::abs(s.camera()->alignment().rate - 1.05) < 1e-9);
    QTRY_VERIFY_WITH_TIMEOUT(keptOf(file).at(0).anchors.size() == 2, patience_ms);
    QTRY_COMPARE_WITH_TIMEOUT(keptOf(file).at(0), s.camera()->kept(), patience_ms);
  }

  /// The bar of a video is dragged along the time, with the picture of the moment in view.
  void aBarIsDraggedAlongTheTime() {
    Panel s;
    // 4 s of the video are 4.2 s of the session: the drift stays.
    const QString file = session("dragged.mcap", {{2.0, 0.0}, {6.2, 4.0}});
    s.open(file);
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
    auto* tracks = s.find<VideoTracks>("videoTracks");
    QTRY_VERIFY(tracks->isVisible() && tracks->barRect(0).width() > 20);
    s.shown()->seek(6.21);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(), 100, patience_ms);
    const QPoint grip = tracks->barRect(0).center().toPoint();
    const auto moveTo = [tracks](QPoint at) {
      QMouseEvent move(QEvent::MouseMove, at, tracks->mapToGlobal(at), Qt::NoButton, Qt::LeftButton,
                       {});
      QApplication::sendEvent(tracks, &move);
    };
    // To the right: it begins later, and earlier pictures belong to the moment.
    const TimeAxis axis = tracks->axis();
    const int way = qRound(1.0 / axis.secondsPerPixel());
    const double by = way * axis.secondsPerPixel();
    QTest::mousePress(tracks, Qt::LeftButton, {}, grip);
    moveTo(grip + QPoint(way / 2, 0));
    moveTo(grip + QPoint(way, 0));
    QVERIFY(std::abs(s.camera()->alignment().offset - (2.0 + by)) < 1e-6);
    QVERIFY(std::abs(s.camera()->alignment().rate - 1.05) < 1e-9);
    const int expected = static_cast<int>(std::floor((6.21 - 2.0 - by) / 1.05 * 25.0));
    QVERIFY(expected > 60 && expected < 90);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(), expected, patience_ms);
    // How far is said, and the axis stands still meanwhile.
    QCOMPARE(tracks->moveText(), QStringLiteral("+%1 s, starts at %2")
                                     .arg(by, 0, 'f', 2)
                                     .arg(momentText(std::round((2.0 + by) * 100.0) / 100.0, 2)));
    QCOMPARE(tracks->axis(), axis);
    QTest::mouseRelease(tracks, Qt::LeftButton, {}, grip + QPoint(way, 0));
    QVERIFY(tracks->moveText().isEmpty());
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(keptOf(file).at(0).anchors.at(1).session - (6.2 + by)) < 1e-6,
                             patience_ms);
    // It is undone, also in the file.
    auto* undo = s.window.findChild<QAction*>(QStringLiteral("undo"));
    QCOMPARE(undo->text(), QStringLiteral("Undo Move video"));
    undo->trigger();
    QVERIFY(std::abs(s.camera()->alignment().offset - 2.0) < 1e-9);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(), 100, patience_ms);
    QTRY_COMPARE_WITH_TIMEOUT(keptOf(file).at(0).anchors.at(0).session, 2.0, patience_ms);
    s.window.findChild<QAction*>(QStringLiteral("redo"))->trigger();
    QVERIFY(std::abs(s.camera()->alignment().offset - (2.0 + by)) < 1e-6);
    undo->trigger();
    // Escape gives a drag up, and a trembling click is none.
    const QPoint here = tracks->barRect(0).center().toPoint();
    QTest::mousePress(tracks, Qt::LeftButton, {}, here);
    moveTo(here - QPoint(40, 0));
    QVERIFY(s.camera()->alignment().offset < 1.9);
    s.window.findChild<QAction*>(QStringLiteral("escape"))->trigger();
    QVERIFY(std::abs(s.camera()->alignment().offset - 2.0) < 1e-9);
    QTest::mouseRelease(tracks, Qt::LeftButton, {}, here - QPoint(40, 0));
    QTest::mousePress(tracks, Qt::LeftButton, {}, here);
    moveTo(here + QPoint(2, 0));
    QTest::mouseRelease(tracks, Qt::LeftButton, {}, here + QPoint(2, 0));
    QVERIFY(std::abs(s.camera()->alignment().offset - 2.0) < 1e-9);
    QCOMPARE(undo->text(), QStringLiteral("Undo"));
    // Typing a start is one step, however many numbers it takes.
    s.press("alignVideo");
    s.find<NumberBox>("videoBegin")->setValue(2.5);
    s.find<NumberBox>("videoBegin")->setValue(2.75);
    QCOMPARE(undo->text(), QStringLiteral("Undo Align video"));
    undo->trigger();
    QVERIFY(std::abs(s.camera()->alignment().offset - 2.0) < 1e-9);
    QCOMPARE(s.find<NumberBox>("videoBegin")->value(), 2.0);
    // Nothing can be undone in another session.
    s.find<NumberBox>("videoBegin")->setValue(3.0);
    s.open(path("match.mcap"));
    QTRY_VERIFY_WITH_TIMEOUT(s.views().isEmpty(), patience_ms);
    QCOMPARE(undo->text(), QStringLiteral("Undo"));
    QVERIFY(!tracks->isVisible());
  }

  /// Each camera has a bar; a wheel turns seconds into pixels for a fine hand.
  void barsOfSeveralCamerasAndAZoom() {
    const QString file = session("bars.mcap");
    auto videos = keptOf(file);
    videos.push_back({m_clip.toStdString(), {{4.0, 0.0}}, {}});
    QVERIFY(telemetry::writeSessionVideos(file.toStdString(), videos));
    Panel s;
    s.open(file);
    auto* tracks = s.find<VideoTracks>("videoTracks");
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(0) && s.isOpen(1) && tracks->barRect(1).width() > 20,
                             patience_ms);
    QVERIFY(tracks->barRect(1).top() >= tracks->barRect(0).bottom());
    QVERIFY(std::abs(tracks->axis().time(tracks->barRect(1).left()) - 4.0) <=
            2 * tracks->axis().secondsPerPixel());
    const QPointF at = tracks->barRect(1).center();
    const double before = tracks->axis().secondsPerPixel(), anchor = tracks->axis().time(at.x());
    QWheelEvent wheel(at, tracks->mapToGlobal(at), {}, {0, 600}, {}, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(tracks, &wheel);
    QVERIFY(tracks->axis().secondsPerPixel() < before / 2);
    QVERIFY(std::abs(tracks->axis().time(at.x()) - anchor) < 1e-6);
    QTest::mousePress(tracks, Qt::LeftButton, {}, at.toPoint());
    QMouseEvent move(QEvent::MouseMove, at - QPointF(30, 0), tracks->mapToGlobal(at), Qt::NoButton,
                     Qt::LeftButton, {});
    QApplication::sendEvent(tracks, &move);
    QTest::mouseRelease(tracks, Qt::LeftButton, {}, at.toPoint() - QPoint(30, 0));
    QVERIFY(s.camera(1)->alignment().offset < 4.0);
    QCOMPARE(s.camera(0)->alignment().offset, 2.0);
    QTest::mouseDClick(tracks, Qt::LeftButton, {}, QPoint(2, 2));
    QVERIFY(tracks->axis().secondsPerPixel() > before / 2);
  }

  void videosAreFoundWhenTheyMoveWithTheSession() {
    QDir folder(m_folder.path());
    QVERIFY(folder.mkpath("first/cameras"));
    QVERIFY(QFile::copy(m_clip, path("first/cameras/north.mp4")));
    QVERIFY(QFile::copy(path("match.mcap"), path("first/match.mcap")));
    {
      Panel s;
      s.open(path("first/match.mcap"));
      s.shown()->seek(5.0);
      s.shown()->addBookmark(QStringLiteral("a goal"));
      s.drop(path("first/cameras/north.mp4"));
      QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
      // Its clock is of another year, so it begins with the session.
      QCOMPARE(s.camera()->alignment().offset, s.shown()->available()->begin);
      s.press("alignVideo");
      s.find<NumberBox>("videoBegin")->setValue(1.5);
    }
    QVERIFY(folder.rename("first", "second"));
    const QString moved = path("second/match.mcap");
    const auto kept = keptOf(moved);
    QCOMPARE(kept.size(), std::size_t{1});
    QCOMPARE(QString::fromStdString(kept[0].path), path("second/cameras/north.mp4"));
    QCOMPARE(telemetry::readSessionNotes(moved.toStdString()).value(),
             (telemetry::SessionNotes{{5.0, "a goal"}}));
    Panel s;
    s.open(moved);
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
    s.shown()->seek(3.51);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(), 50, patience_ms);
    // A bookmark that comes later keeps the videos.
    s.shown()->addBookmark(QStringLiteral("later"));
    QCOMPARE(keptOf(moved), kept);
  }

  void severalCamerasAndOneThatIsMissing() {
    const QString file = session("several.mcap");
    auto videos = keptOf(file);
    videos.push_back({m_clip.toStdString(), {{4.0, 0.0}}, {}});
    videos.push_back({path("gone.mp4").toStdString(), {}, {}});
    QVERIFY(telemetry::writeSessionVideos(file.toStdString(), videos));
    Panel s;
    s.open(file);
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(0) && s.isOpen(1), patience_ms);
    s.shown()->seek(5.01);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(0), 75, patience_ms);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(1), 25, patience_ms);
    QTRY_VERIFY_WITH_TIMEOUT(
        s.camera(2)->problem().startsWith(QStringLiteral("This video does not exist.")),
        patience_ms);
    // Nothing can be aligned in one that is missing, but it can be removed.
    s.press("alignVideo");
    QTest::mouseClick(s.views().at(2), Qt::LeftButton);
    QVERIFY(!s.find<QToolButton>("alignVideo")->isEnabled());
    QVERIFY(!s.find<QSlider>("videoPosition")->isVisible());
    QTest::keyClick(&s.window, Qt::Key_Period);
    s.press("removeVideo");
    QCOMPARE(s.views().size(), 2);
    QTRY_COMPARE_WITH_TIMEOUT(keptOf(file).size(), std::size_t{2}, patience_ms);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(0), 75, patience_ms);
    // With its alignment it comes back.
    QTest::mouseClick(s.views().at(1), Qt::LeftButton);
    s.press("removeVideo");
    QCOMPARE(s.views().size(), 1);
    s.press("inPlaceButton");
    QCOMPARE(s.views().size(), 2);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(1), 25, patience_ms);
    // Another session has no videos.
    s.open(path("match.mcap"));
    QTRY_VERIFY_WITH_TIMEOUT(s.views().isEmpty(), patience_ms);
    QCOMPARE(keptOf(file).size(), std::size_t{2});
  }

  void aMatchThatGoesOnIsLookedBackAt() {
    Panel s;
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    s.controller.runTo(400);
    QTRY_VERIFY_WITH_TIMEOUT(s.controller.frame() && s.controller.frame()->snapshot.tick >= 400,
                             patience_ms);
    s.drop(m_clip);
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
    const double begin = s.camera()->alignment().offset;
    for (const int picture : {90, 20, 140, 21}) {
      s.shown()->seek(begin + (picture + 0.5) / 25.0);
      QVERIFY(s.shown()->isLookingBack());
      QTRY_COMPARE_WITH_TIMEOUT(s.number(), picture, patience_ms);
    }
  }

  /// Videos of a match stay with what is recorded of it, whichever came first.
  void aRecordedMatchKeepsItsVideos_data() {
    QTest::addColumn<QString>("order");
    for (const char* order : {"video first", "recording first", "the last seconds"}) {
      QTest::newRow(order) << QString(QLatin1String(order));
    }
  }
  void aRecordedMatchKeepsItsVideos() {
    QFETCH(QString, order);
    Panel s;
    SessionRecording* recording = s.window.recording();
    recording->setFolder(path(QStringLiteral("kept ") + order));
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    s.controller.runTo(300);
    QTRY_VERIFY(s.controller.frame() && s.controller.frame()->snapshot.tick == 300);
    if (order == QStringLiteral("recording first")) recording->start();
    s.drop(m_clip);
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
    s.shown()->seek(3.0);
    s.press("alignVideo");
    s.find<QSlider>("videoPosition")->setValue(50);
    s.press("videoSameMoment");
    s.press("alignDone");
    const std::vector<telemetry::VideoAnchor> anchors = s.camera()->kept().anchors;
    QCOMPARE(anchors.size(), std::size_t(1));
    QVERIFY(std::abs(anchors[0].session - 3.0) < 1e-9 && std::abs(anchors[0].video - 2.0) < 1e-9);
    s.shown()->goLive();
    if (order == QStringLiteral("video first")) {
      recording->start();
      // While it goes on, so that a crash costs nothing.
      QCOMPARE(keptOf(recording->path()).size(), std::size_t(1));
    }
    QSignalSpy saved(recording, &SessionRecording::saved);
    s.controller.runTo(420);
    QTRY_VERIFY(s.controller.frame()->snapshot.tick == 420);
    if (order == QStringLiteral("the last seconds")) {
      recording->saveLast(5.0);
    } else {
      recording->stop();
    }
    QTRY_COMPARE_WITH_TIMEOUT(saved.size(), 1, patience_ms);
    const QString file = saved.at(0).at(0).toString();
    QCOMPARE(keptOf(file).size(), std::size_t(1));
    QCOMPARE(keptOf(file)[0].path, m_clip.toStdString());
    QVERIFY(keptOf(file)[0].anchors == anchors);

    // In Replay it is there again, at the same moments.
    s.open(file);
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
    s.shown()->seek(5.5);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(), 112, patience_ms);
  }
  /// Live robots: their past is looked back at with the video, which stays with the recording.
  void liveRobotsAreLookedBackAt() {
    Panel s;
    s.window.recording()->setFolder(path(QStringLiteral("kept live")));
    live_rig::LiveWindow live(s.window);
    QVERIFY(live.isListening());
    for (int i = 0; i < 3; ++i) QVERIFY(live.say());
    s.window.recording()->start();
    for (int i = 0; i < 3; ++i) QVERIFY(live.say());
    const double then = s.window.live()->frame()->snapshot.time;
    const int place = live.place();
    for (int i = 0; i < 3; ++i) QVERIFY(live.say());
    s.drop(m_clip);
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
    // At the present it is the picture of this moment, and none once the video is over.
    const auto isOfNow = [&s] {
      if (!s.camera()->shown()) return false;
      const double time = s.camera()->alignment().videoTime(s.shown()->time());
      return s.camera()->isCovered() ? *s.camera()->shown() == s.camera()->indexAt(time)
                                     : time >= clipLength / 25.0;
    };
    QTRY_VERIFY_WITH_TIMEOUT(!s.shown()->isLookingBack() && isOfNow(), patience_ms);
    // Looking back: picture 50 is the moment of a message.
    s.shown()->seek(then);
    QVERIFY(s.shown()->isLookingBack());
    s.press("alignVideo");
    s.find<QSlider>("videoPosition")->setValue(50);
    s.press("videoSameMoment");
    s.press("alignDone");
    QTRY_COMPARE_WITH_TIMEOUT(s.number(), 50, patience_ms);
    // Robots go on sending; the picture stays.
    QVERIFY(live.say());
    QCOMPARE(s.shown()->time(), then);
    QCOMPARE(s.number(), 50);
    const QString file = s.window.recording()->path();
    const auto isKept = [&file, then] {
      const auto kept = keptOf(file);
      return kept.size() == 1 && kept[0].anchors.size() == 1 &&
             std::abs(kept[0].anchors[0].session - then) < 1e-6 &&
             std::abs(kept[0].anchors[0].video - 2.0) < 1e-6;
    };
    QTRY_VERIFY_WITH_TIMEOUT(isKept(), patience_ms);
    s.shown()->goLive();
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    s.window.recording()->stop();
    QTRY_COMPARE_WITH_TIMEOUT(saved.size(), 1, patience_ms);
    // In Replay the same picture stands beside the same place of the robot.
    s.open(file);
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
    s.shown()->seek(then);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(), 50, patience_ms);
    QTRY_COMPARE_WITH_TIMEOUT(live.placeIn(s.shown()->frame()), place, patience_ms);
  }

  void aRecordingWithoutVideosHasNoFileBesideIt() {
    Panel s;
    s.window.recording()->setFolder(path(QStringLiteral("plain")));
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    QTRY_VERIFY(s.controller.frame() != nullptr);
    s.window.recording()->start();
    s.controller.runTo(60);
    QTRY_VERIFY(s.controller.frame()->snapshot.tick == 60);
    QSignalSpy saved(s.window.recording(), &SessionRecording::saved);
    s.window.recording()->stop();
    QTRY_COMPARE_WITH_TIMEOUT(saved.size(), 1, patience_ms);
    const std::string file = saved.at(0).at(0).toString().toStdString();
    QVERIFY(!QFile::exists(QString::fromStdString(telemetry::sessionNotesPath(file))));
  }

  void fourPointsGiveTheFieldInThePicture() {
    Panel s;
    const QString file = session("points.mcap");
    s.open(file);
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
    s.shown()->seek(4.01);
    QTRY_COMPARE_WITH_TIMEOUT(s.number(), 50, patience_ms);
    s.press("videoPoints");
    VideoView* view = s.views().at(0);
    // A camera behind the bottom line: a trapezium.
    const Point corners[]{{0.3, 0.2}, {0.7, 0.2}, {0.9, 0.8}, {0.1, 0.8}};
    for (const Point& corner : corners) {
      const QRectF rect = view->pictureRect();
      const QPointF at(rect.left() + corner.x * rect.width(),
                       rect.top() + corner.y * rect.height());
      QTest::mouseClick(view, Qt::LeftButton, {}, at.toPoint());
    }
    const auto landmarks = s.camera()->kept().landmarks;
    QCOMPARE(landmarks.size(), std::size_t{4});
    QCOMPARE(landmarks[0].field, (Point{-4.5, 3.0}));  // the published field: 9 m × 6 m
    QCOMPARE(landmarks[2].field, (Point{4.5, -3.0}));
    const double pixel = 1.0 / std::min(view->pictureRect().width(), view->pictureRect().height());
    for (std::size_t i = 0; i < 4; ++i) {
      QVERIFY(std::abs(landmarks[i].picture.x - corners[i].x) <= pixel);
      QVERIFY(std::abs(landmarks[i].picture.y - corners[i].y) <= pixel);
    }
    QTRY_COMPARE_WITH_TIMEOUT(keptOf(file).at(0).landmarks.size(), std::size_t{4}, patience_ms);
    // Another click moves a point, and a hint says so.
    QVERIFY(s.find<QLabel>("fieldPointHint")->text().contains(QStringLiteral("Drag")));
    s.press("pointsDone");
    // Where the diagonals meet, the centre is: at the ratio of the sides (0.4 : 0.8) of the height,
    // 0.2 + 0.6·(0.4/1.2) = 0.4.
    std::vector<telemetry::VideoLandmark> exact = landmarks;
    for (std::size_t i = 0; i < 4; ++i) exact[i].picture = corners[i];
    const auto ground = groundToPicture(exact);
    QVERIFY(ground);
    const QPointF centre = ground->map(QPointF(0, 0));
    QVERIFY(std::abs(centre.x() - 0.5) < 1e-9 && std::abs(centre.y() - 0.4) < 1e-9);
    // Half of the touch line is half of its image, because it is parallel to the picture.
    const QPointF below = ground->map(QPointF(0, -3));
    QVERIFY(std::abs(below.x() - 0.5) < 1e-9 && std::abs(below.y() - 0.8) < 1e-9);
    // The order of the points does not matter.
    std::swap(exact[0], exact[1]);
    std::swap(exact[1], exact[3]);
    const QPointF again = groundToPicture(exact)->map(QPointF(0, 0));
    QVERIFY(std::abs(again.x() - 0.5) < 1e-9 && std::abs(again.y() - 0.4) < 1e-9);
    // Three in one line are no field, and neither are corners that are exchanged.
    exact[2].picture = exact[0].picture;
    QVERIFY(!groundToPicture(exact));
    exact = landmarks;
    std::swap(exact[0].picture, exact[1].picture);
    QVERIFY(!groundToPicture(exact));
  }

  /// A film of a stretch: field on the left, the camera on the right, plots below with a line at
  /// the moment.
  void aStretchIsExportedWithItsCamera() {
    Panel s;
    s.open(session("exported.mcap"));
    QTRY_VERIFY_WITH_TIMEOUT(s.isOpen(), patience_ms);
    s.shown()->setSelection(telemetry::TimeRange{3.0, 4.0});
    s.window.findChild<QAction*>(QStringLiteral("exportSession"))->trigger();
    auto* dialog = s.window.findChild<ExportDialog*>(QStringLiteral("exportDialog"));
    QVERIFY(dialog != nullptr);
    auto* format = dialog->findChild<QComboBox*>(QStringLiteral("exportFormat"));
    format->setCurrentIndex(format->findText(QStringLiteral("(MP4)"), Qt::MatchContains));
    auto* size = dialog->findChild<QComboBox*>(QStringLiteral("exportSize"));
    size->setCurrentIndex(size->findData(QSize(640, 360)));
    dialog->findChild<QSpinBox*>(QStringLiteral("exportRate"))->setValue(25);
    auto* cameras = dialog->findChild<QCheckBox*>(QStringLiteral("exportCameras"));
    QVERIFY(cameras->isVisible());
    cameras->setChecked(true);
    dialog->findChild<QCheckBox*>(QStringLiteral("exportCurves"))->setChecked(true);
    QSignalSpy written(dialog, &ExportDialog::written);
    dialog->exportTo(path("film.mp4"));
    QTRY_COMPARE_WITH_TIMEOUT(written.size(), 1, patience_ms);
    auto film = telemetry::VideoFile::open(path("film.mp4").toStdString());
    QVERIFY2(film, film ? "" : film.error().text().c_str());
    QCOMPARE(film->times().size(), std::size_t{26});
    QCOMPARE(film->info().width, 640);
    QCOMPARE(film->info().height, 360);
    // On the right of 45 %, above the lowest 30 %: 352 × 252, of which the clip fills 352 × 211.
    const QRect camera(288, 20, 352, 211);
    for (std::size_t i = 0; i < 26; ++i) {
      const auto picture = film->picture(i);
      QVERIFY(picture);
      QCOMPARE(Clip::numberIn(camera.width(), camera.height(),
                              [&](int x, int y) {
                                const std::size_t at = static_cast<std::size_t>(
                                    (camera.top() + y) * 640 + camera.left() + x);
                                return qGray(picture->pixels[at]);
                              }),
               25 + static_cast<int>(i));
    }
  }

  /// Robots and ball stand where their frame has them.
  void theFieldIsDrawnIntoThePicture() {
    link::MatchFrame frame;
    frame.snapshot.ball = {0.0, 0.0};
    link::RobotFrame robot;
    robot.pose = {{3.0, 1.5}, 0.0};
    robot.radius = 0.4;
    robot.key.team = link::teamIndex(TeamColor::Red);
    frame.teams = link::teamsByColour();
    frame.robots.push_back(robot);
    QImage image(900, 600, QImage::Format_RGB32);
    image.fill(Qt::black);
    {
      QPainter painter(&image);
      // 100 pixels a metre, +y up.
      paintOverlay(painter, QTransform(100, 0, 0, -100, 450, 300), frame);
    }
    const auto at = [&image](double x, double y) {
      return image.pixelColor(qRound(450 + 100 * x), qRound(300 - 100 * y));
    };
    QCOMPARE(at(0.0, 0.0).rgb(), theme().ball.rgb());
    const QColor red = at(2.8, 1.3);
    QVERIFY(red.red() > red.blue() + 20 && red.red() > red.green() + 20);
    QVERIFY(at(0.0, 2.0) != QColor(Qt::black));  // the centre line
    QCOMPARE(at(2.0, -2.0), QColor(Qt::black));  // nothing
  }
};

PITCHBOARD_GUI_TEST(TestVideoDock)

}  // namespace tst_video_dock

#include "tst_video_dock.moc"
