// SPDX-License-Identifier: GPL-3.0-or-later
// Notes in the window, drawn with the mouse on the field, on a plot and on a video: at the moment
// that is shown, where the mouse was, for as long as they say; moved, changed, deleted, undone;
// listed, exported, and kept beside the recording in Replay and while a match is recorded.
#include <QAction>
#include <QContextMenuEvent>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QFileDialog>
#include <QGraphicsView>
#include <QLineEdit>
#include <QMenu>
#include <QPainter>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableView>
#include <QTimer>
#include <cmath>

#include <robotlink/scenario/scenario.h>
#include <telemetry/session/session_notes.h>
#include <telemetry/session/session_reader.h>
#include <telemetry/session/session_videos.h>
#include <ui/base/number_box.h>
#include <ui/base/theme.h>
#include <ui/base/undo_history.h>
#include <ui/field/field_view.h>
#include <ui/plots/plots_dock.h>
#include <ui/sources/linked_time.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/note_board.h>
#include <ui/sources/note_layer.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/session_recording.h>
#include <ui/sources/shown_moment.h>
#include <ui/video/video_dock.h>

#include "../../support/numbered_clip.h"
#include "../../support/program_run.h"
#include "../live_window.h"
#include "../studio_rig.h"
#include "chart_pane.h"
#include "notes_model.h"
#include "plot_page.h"
#include "video_camera.h"
#include "video_view.h"

namespace tst_notes {

using namespace pitchboard;
using namespace pitchboard::ui;
using telemetry::DrawnNote;
using telemetry::NotePlace;
using telemetry::NoteShape;
using Clip = tests::NumberedClip;

namespace {

constexpr int patience_ms = 30'000;

void drag(QWidget* at, QPoint from, QPoint to) {
  QTest::mousePress(at, Qt::LeftButton, {}, from);
  for (int i = 1; i <= 4; ++i) {
    const QPoint here = from + (to - from) * i / 4;
    QMouseEvent move(QEvent::MouseMove, here, at->mapToGlobal(here), Qt::NoButton, Qt::LeftButton,
                     {});
    QApplication::sendEvent(at, &move);
  }
  QTest::mouseRelease(at, Qt::LeftButton, {}, to);
}

/// The colour of notes, with some room for smooth edges and for compression.
bool isNoteColor(const QColor& color) {
  return color.red() > 200 && color.green() > 160 && color.blue() < 130;
}

bool hasNoteColor(const QImage& image, const QRect& part) {
  for (int y = std::max(part.top(), 0); y <= std::min(part.bottom(), image.height() - 1); ++y) {
    for (int x = std::max(part.left(), 0); x <= std::min(part.right(), image.width() - 1); ++x) {
      if (isNoteColor(image.pixelColor(x, y))) return true;
    }
  }
  return false;
}

QRect around(const QPointF& at, int reach = 3) {
  return {at.toPoint() - QPoint(reach, reach), QSize(2 * reach + 1, 2 * reach + 1)};
}

struct NotesStudio : studio_rig::Studio {
  NoteBoard* board = window.findChild<NoteBoard*>();
  FieldView* field = window.findChild<FieldView*>();
  QGraphicsView* canvas = field->findChild<QGraphicsView*>();

  NotesStudio() { window.activateWindow(); }

  ShownMoment* shown() { return window.shown(); }
  void replay(const QString& session) {
    window.openSession(session);
    QTRY_VERIFY_WITH_TIMEOUT(
        shown()->source() == window.replay() && window.replay()->path() == session, patience_ms);
  }
  void playTo(std::uint64_t tick) {
    controller.runTo(tick);
    QTRY_VERIFY_WITH_TIMEOUT(
        shown()->newest() != nullptr && shown()->newest()->snapshot.tick == tick, patience_ms);
  }
  void choose(const char* tool) { action(tool)->trigger(); }
  QAction* action(const char* name) const {
    auto* found = window.findChild<QAction*>(QLatin1String(name));
    if (found == nullptr) qFatal("there is no %s", name);
    return found;
  }
  QPoint pixel(double x, double y) const { return canvas->mapFromScene(QPointF(x, y)); }
  void drawOnField(const char* tool, Point from, Point to) {
    choose(tool);
    drag(canvas->viewport(), pixel(from.x, from.y), pixel(to.x, to.y));
  }
  DrawnNote only() const {
    if (board->entries().size() != 1) qFatal("%zu notes", board->entries().size());
    return board->entries()[0].note;
  }
  /// Metres from a point to another one, in pixels.
  bool isAt(const Point& a, const Point& b) const {
    const QPoint off = pixel(a.x, a.y) - pixel(b.x, b.y);
    return std::abs(off.x()) <= 1 && std::abs(off.y()) <= 1;
  }
  bool isSeenAt(Point place) const {
    const QImage picture = canvas->grab().toImage();
    return hasNoteColor(picture, around(pixel(place.x, place.y)));
  }
  QDialog* editor() const { return window.findChild<QDialog*>(QStringLiteral("noteEditor")); }
  /// Types into the editor that is open, and accepts.
  void write(const QString& text, std::optional<double> duration = {}) {
    QTRY_VERIFY(editor() != nullptr && editor()->isVisible());
    QDialog* dialog = editor();
    auto* line = dialog->findChild<QLineEdit*>(QStringLiteral("noteText"));
    line->selectAll();
    QTest::keyClicks(line, text);
    if (duration) {
      dialog->findChild<NumberBox*>(QStringLiteral("noteDuration"))->setValue(*duration);
    }
    QTest::mouseClick(dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok),
                      Qt::LeftButton);
    QTRY_VERIFY(editor() == nullptr);
  }
};

std::vector<DrawnNote> keptOf(const QString& session) {
  return telemetry::readDrawnNotes(session.toStdString()).value().notes;
}

}  // namespace

class TestNotes : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

  QString path(const QString& name) const { return m_folder.filePath(name); }
  QString session(const QString& name) const {
    if (!QFile::copy(path("match.mcap"), path(name))) qFatal("not copied");
    return path(name);
  }

 private slots:
  void initTestCase() {
    setTheme(*qApp, ThemeChoice::Dark);
    const ProgramRun run = cli({"record", "--scenario", "match-3v3", "--seed", "3", "--speed",
                                "max", "--duration", "12", "-o", path("match.mcap")});
    QVERIFY2(run.exitCode == 0, run.err.constData());
  }

  void anArrowOnTheFieldIsShownForItsTime() {
    NotesStudio s;
    const QString file = session("arrow.mcap");
    s.replay(file);
    s.shown()->seek(5.0);
    const Point tail{-3.0, 2.4}, tip{-1.0, 2.4}, middle{-2.0, 2.4};
    QVERIFY(!s.isSeenAt(middle));
    s.drawOnField("noteArrow", tail, tip);
    const DrawnNote drawn = s.only();
    QCOMPARE(drawn.shape, NoteShape::Arrow);
    QCOMPARE(drawn.place, NotePlace::Field);
    QCOMPARE(drawn.time, 5.0);
    QCOMPARE(drawn.duration, 3.0);
    QVERIFY(s.isAt(drawn.from, tail) && s.isAt(drawn.to, tip));
    // One press draws one note.
    QVERIFY(!s.board->tool());
    QVERIFY(s.isSeenAt(middle));
    for (const double outside : {4.9, 8.1}) {
      s.shown()->seek(outside);
      QVERIFY(!s.isSeenAt(middle));
    }
    s.shown()->seek(7.9);
    QVERIFY(s.isSeenAt(middle));
    // It is an event of the timeline, to which N leads.
    s.shown()->seek(4.99);
    s.shown()->setFilter({});
    const auto row = s.shown()->events()->next(4.995);
    QVERIFY(row);
    QCOMPARE(s.shown()->events()->at(*row).kind, link::MatchEventKind::Note);
    QCOMPARE(QString::fromStdString(sentenceOf(s.shown()->events()->at(*row))),
             QStringLiteral("note: arrow on the field"));
    QTRY_VERIFY_WITH_TIMEOUT(keptOf(file) == std::vector{drawn}, patience_ms);
    // Whoever opens the file again sees it.
    NotesStudio again;
    again.replay(file);
    again.shown()->seek(6.0);
    QCOMPARE(again.board->entries().size(), std::size_t{1});
    QVERIFY(again.isSeenAt(middle));
    QVERIFY(again.shown()->events()->next(4.995).has_value());
  }

  void itIsMovedChangedDeletedAndUndone() {
    NotesStudio s;
    const QString file = session("moved.mcap");
    s.replay(file);
    s.shown()->seek(5.0);
    s.drawOnField("noteArrow", {-3.0, 2.4}, {-1.0, 2.4});
    // By its middle all of it is moved, by an end only that.
    QWidget* viewport = s.canvas->viewport();
    drag(viewport, s.pixel(-2.0, 2.4), s.pixel(-2.0, -2.0));
    QVERIFY(s.isAt(s.only().from, {-3.0, -2.0}) && s.isAt(s.only().to, {-1.0, -2.0}));
    drag(viewport, s.pixel(-1.0, -2.0), s.pixel(1.0, -1.0));
    QVERIFY(s.isAt(s.only().from, {-3.0, -2.0}) && s.isAt(s.only().to, {1.0, -1.0}));
    const DrawnNote moved = s.only();
    // A double click changes what it says.
    QTest::mouseDClick(viewport, Qt::LeftButton, {}, s.pixel(-1.0, -1.5));
    s.write(QStringLiteral("B1 is open"), 1.5);
    QCOMPARE(QString::fromStdString(s.only().text), QStringLiteral("B1 is open"));
    QCOMPARE(s.only().duration, 1.5);
    QVERIFY(s.only().from == moved.from && s.only().to == moved.to);
    s.shown()->seek(6.6);
    QVERIFY(!s.isSeenAt({-1.0, -1.5}));
    s.shown()->seek(5.5);
    // Escape gives a drag up.
    const DrawnNote before = s.only();
    QTest::mousePress(viewport, Qt::LeftButton, {}, s.pixel(-1.0, -1.5));
    QMouseEvent away(QEvent::MouseMove, s.pixel(2.0, 1.0), viewport->mapToGlobal(s.pixel(2.0, 1.0)),
                     Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(viewport, &away);
    s.action("escape")->trigger();
    QTest::mouseRelease(viewport, Qt::LeftButton, {}, s.pixel(2.0, 1.0));
    QVERIFY(s.only() == before);
    // Deleted by its menu, and everything is undone.
    const QPoint at = s.pixel(-1.0, -1.5);
    QContextMenuEvent menu(QContextMenuEvent::Mouse, at, viewport->mapToGlobal(at));
    QApplication::sendEvent(viewport, &menu);
    auto* shown = s.window.findChild<QMenu*>(QStringLiteral("noteMenu"));
    QVERIFY(shown != nullptr);
    shown->actions().last()->trigger();
    shown->close();
    QVERIFY(s.board->entries().empty());
    QVERIFY(!s.isSeenAt({-1.0, -1.5}));
    QAction* undo = s.action("undo");
    QCOMPARE(undo->text(), QStringLiteral("Undo Delete arrow"));
    undo->trigger();
    QVERIFY(s.only() == before);
    undo->trigger();
    QVERIFY(s.only() == moved);
    undo->trigger();
    undo->trigger();
    QVERIFY(s.isAt(s.only().from, {-3.0, 2.4}) && s.isAt(s.only().to, {-1.0, 2.4}));
    undo->trigger();
    QVERIFY(s.board->entries().empty());
    for (int i = 0; i < 4; ++i) s.action("redo")->trigger();
    QVERIFY(s.only() == before);
    QTRY_VERIFY_WITH_TIMEOUT(keptOf(file) == std::vector{before}, patience_ms);
    QCOMPARE(s.shown()->events()->rowCount() > 0, true);
  }

  void textsAndCircles() {
    NotesStudio s;
    s.replay(session("texts.mcap"));
    s.shown()->seek(2.0);
    // A text belongs where the click was; without a text there is none.
    s.choose("noteText");
    QTest::mouseClick(s.canvas->viewport(), Qt::LeftButton, {}, s.pixel(2.0, 2.4));
    QTRY_VERIFY(s.editor() != nullptr);
    QVERIFY(!s.editor()->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok)->isEnabled());
    QTest::keyClick(s.editor(), Qt::Key_Escape);
    QTRY_VERIFY(s.editor() == nullptr);
    QVERIFY(s.board->entries().empty());
    s.choose("noteText");
    QTest::mouseClick(s.canvas->viewport(), Qt::LeftButton, {}, s.pixel(2.0, 2.4));
    s.write(QStringLiteral("look here"));
    QVERIFY(s.isAt(s.only().from, {2.0, 2.4}));
    QVERIFY(hasNoteColor(s.canvas->grab().toImage(), around(s.pixel(2.0, 2.4), 20)));
    // A circle has its centre where the drag began.
    s.drawOnField("noteCircle", {-2.0, -1.5}, {-1.0, -1.5});
    const DrawnNote circle = s.board->entries().at(1).note;
    QCOMPARE(circle.shape, NoteShape::Circle);
    QVERIFY(s.isSeenAt({-2.0, -0.5}) && s.isSeenAt({-3.0, -1.5}));
    QVERIFY(!s.isSeenAt({-2.0, -1.5}));
    // What it surrounds can still be clicked: a press in its middle is none of it.
    QVERIFY(s.canvas->findChild<NoteLayer*>()->noteAt(s.pixel(-2.0, -1.5)) == 0);
    // A click without a drag draws nothing, Escape gives the tool up.
    s.choose("noteArrow");
    QTest::mouseClick(s.canvas->viewport(), Qt::LeftButton, {}, s.pixel(0.0, -2.5));
    QCOMPARE(s.board->entries().size(), std::size_t{2});
    QVERIFY(s.board->tool().has_value());
    s.action("escape")->trigger();
    QVERIFY(!s.board->tool());
    QVERIFY(s.board->cancel() == false);
    // The other side of the field is the same place.
    s.field->setFlipped(true);
    QVERIFY(s.isSeenAt({-2.0, -0.5}));
  }

  void aNoteOnAPlotBelongsToItsVariable() {
    NotesStudio s;
    const QString file = session("plot.mcap");
    s.replay(file);
    s.shown()->seek(5.0);
    auto* plots = s.window.findChild<PlotsDock*>();
    auto* plotsDock = s.window.findChild<QDockWidget*>(QStringLiteral("plots"));
    plotsDock->show();
    plotsDock->raise();
    plots->currentPage()->removeAll();
    plots->plotVariables({QStringLiteral("B1/VISION_BALL_DIST")});
    plots->time()->setRange({0.0, 12.0});
    QTRY_VERIFY_WITH_TIMEOUT(!plots->currentPage()->panes().isEmpty() &&
                                 !plots->currentPage()->panes()[0]->curves()[0].isWaiting(),
                             patience_ms);
    auto* pane = qobject_cast<ChartPane*>(plots->currentPage()->panes()[0]);
    QVERIFY(pane != nullptr && pane->surface()->height() > 40);
    PlotPage* page = plots->currentPage();
    page->refresh();
    const auto pixel = [pane](double time, double share) {
      const ValueScale scale = pane->valueScale();
      return QPoint(qRound(pane->timeAxis().pixel(time)),
                    qRound(scale.bottom + share * (scale.top - scale.bottom)));
    };
    s.choose("noteArrow");
    const QPoint tail = pixel(4.0, 0.3), tip = pixel(7.0, 0.8);
    drag(pane->surface(), tail, tip);
    const DrawnNote note = s.only();
    QCOMPARE(note.place, NotePlace::Plot);
    QCOMPARE(QString::fromStdString(note.on), QStringLiteral("B1/VISION_BALL_DIST"));
    QCOMPARE(QString::fromStdString(note.unit), QStringLiteral("cm"));
    const double perPixel = pane->timeAxis().secondsPerPixel();
    QVERIFY(std::abs(note.from.x - 4.0) <= perPixel && std::abs(note.to.x - 7.0) <= perPixel);
    const double valuePerPixel =
        std::abs(pane->valueScale().toValue(1) - pane->valueScale().toValue(0));
    QVERIFY(std::abs(note.to.y - pane->valueScale().toValue(tip.y())) <= valuePerPixel);
    // Its moment is where it points; the drag neither moved the plot nor the moment.
    QCOMPARE(note.time, note.to.x);
    QCOMPARE(s.shown()->time(), 5.0);
    QCOMPARE(plots->time()->range(), (telemetry::TimeRange{0.0, 12.0}));
    auto* layer = pane->findChild<NoteLayer*>();
    const auto middle = [&pixel, &note, pane] {
      const double value = (note.from.y + note.to.y) / 2;
      return QPointF(pixel((note.from.x + note.to.x) / 2, 0.0).x(), pane->valueScale().toY(value));
    };
    QTRY_VERIFY(layer->noteAt(middle()) != 0);
    // It stays at its times and values when the plot is zoomed.
    const QPointF before = middle();
    plots->time()->setRange({3.0, 9.0});
    QTRY_VERIFY_WITH_TIMEOUT(pane->timeAxis().shown.begin == 3.0, patience_ms);
    page->refresh();
    QVERIFY(std::abs(middle().x() - before.x()) > 20);
    QTRY_VERIFY(layer->noteAt(middle()) != 0);
    QVERIFY(hasNoteColor(pane->surface()->parentWidget()->grab().toImage(), around(middle())) ||
            layer->isVisible());
    // A drag moves it, and its moment.
    const QPoint grip = middle().toPoint();
    drag(pane->surface(), grip, grip + QPoint(40, 0));
    const double moved = 40 * pane->timeAxis().secondsPerPixel();
    QVERIFY(std::abs(s.only().to.x - note.to.x - moved) <= 2 * pane->timeAxis().secondsPerPixel());
    QCOMPARE(s.only().time, s.only().to.x);
    // Another variable has none of it.
    page->removeAll();
    plots->plotVariables({QStringLiteral("B2/VISION_BALL_DIST")});
    QTRY_VERIFY_WITH_TIMEOUT(!page->panes().isEmpty() && !page->panes()[0]->curves()[0].isWaiting(),
                             patience_ms);
    page->refresh();
    QVERIFY(page->panes()[0]->findChild<NoteLayer*>()->isHidden());
    QTRY_VERIFY_WITH_TIMEOUT(keptOf(file) == std::vector{s.only()}, patience_ms);
  }

  void aNoteOnAVideoBelongsToItsFile() {
    if (!Clip::canBeMade()) QSKIP("ffmpeg is not installed");
    const QString clip = path("north.mp4"), file = session("video.mcap");
    QVERIFY(Clip::make(clip, 150, {"-c:v", "libx264", "-pix_fmt", "yuv420p"}));
    const telemetry::SessionVideo video{clip.toStdString(), {{2.0, 0.0}}, {}};
    QVERIFY(telemetry::writeSessionVideos(file.toStdString(), {&video, 1}));
    NotesStudio s;
    auto* dock = s.window.findChild<QDockWidget*>(QStringLiteral("video"));
    dock->show();
    dock->raise();
    s.replay(file);
    QTRY_VERIFY_WITH_TIMEOUT(dock->findChild<VideoView*>() != nullptr &&
                                 dock->findChild<VideoView*>()->camera()->info() != nullptr,
                             patience_ms);
    auto* view = dock->findChild<VideoView*>();
    s.shown()->seek(4.0);
    QTRY_VERIFY_WITH_TIMEOUT(view->camera()->shown() == 50, patience_ms);
    const QRectF rect = view->pictureRect();
    const auto pixel = [&rect](double x, double y) {
      return QPoint(qRound(rect.left() + x * rect.width()), qRound(rect.top() + y * rect.height()));
    };
    s.choose("noteCircle");
    drag(view, pixel(0.5, 0.5), pixel(0.6, 0.5));
    const DrawnNote note = s.only();
    QCOMPARE(note.place, NotePlace::Video);
    QCOMPARE(QString::fromStdString(note.on), QStringLiteral("north.mp4"));
    QCOMPARE(note.time, 4.0);
    QVERIFY(std::abs(note.from.x - 0.5) < 0.01 && std::abs(note.to.x - 0.6) < 0.01);
    const auto isSeen = [&] {
      return hasNoteColor(view->grab().toImage(), around(pixel(0.6, 0.5), 4));
    };
    QVERIFY(isSeen());
    s.shown()->seek(7.5);
    QTRY_VERIFY_WITH_TIMEOUT(!isSeen(), patience_ms);
    // A press beside the picture draws nothing.
    s.choose("noteArrow");
    if (rect.left() > 8) {
      drag(view, QPoint(3, view->height() / 2), QPoint(7, view->height() / 2 + 30));
      QCOMPARE(s.board->entries().size(), std::size_t{1});
    }
    s.action("escape")->trigger();
    // A film has it in its time, and no other camera has it.
    const auto cameras = filmCameras(dock->widget());
    QCOMPARE(cameras.size(), std::size_t{1});
    for (const double time : {3.0, 5.0, 8.0}) {
      QImage image(400, 240, QImage::Format_RGB32);
      image.fill(Qt::black);
      QPainter painter(&image);
      link::MatchFrame frame;
      frame.snapshot.time = time;
      cameras[0].overlay(painter, QRectF(image.rect()), frame);
      painter.end();
      QCOMPARE(hasNoteColor(image, around({0.6 * 400, 0.5 * 240})), time == 5.0);
    }
    // Both the video and the note are kept.
    QTRY_COMPARE_WITH_TIMEOUT(keptOf(file).size(), std::size_t{1}, patience_ms);
    QCOMPARE(telemetry::readSessionVideos(file.toStdString())->size(), std::size_t{1});
  }

  void picturesAndFilmsHaveTheNotesOfTheField() {
    NotesStudio s;
    const QString file = session("pictures.mcap");
    s.replay(file);
    s.shown()->seek(5.0);
    s.drawOnField("noteArrow", {-4.0, -2.5}, {4.0, -2.5});
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(s.shown()->frame()->snapshot.time - 5.0) < 0.05, patience_ms);
    const QSize size = s.field->pictureSize({900, 900});
    const auto has = [](const QImage& image) {
      // 7/10 of the length of the field to the right of its left edge, near its lower edge.
      return hasNoteColor(image, QRect(image.width() / 3, image.height() * 3 / 4, image.width() / 4,
                                       image.height() / 4));
    };
    QVERIFY(has(s.field->picture(size)));
    QVERIFY(s.field->svgPicture(size).contains("#ffd640"));
    const auto painter = s.field->framePainter();
    const FramePtr frame = s.shown()->frame();
    QVERIFY(has(painter->paint(frame, size)));
    auto later = std::make_shared<link::MatchFrame>(*frame);
    later->snapshot.time = 9.0;
    QVERIFY(!has(painter->paint(later, size)));
    s.board->flush();
    // So have those of the command line.
    for (const auto& [from, expected] : {std::pair("6", true), {"9", false}}) {
      const QString picture = path(QStringLiteral("at%1.png").arg(QLatin1String(from)));
      const ProgramRun run = cli({"export", file, "--from", from, "-o", picture});
      QVERIFY2(run.exitCode == 0, run.err.constData());
      QCOMPARE(has(QImage(picture)), expected);
    }
    // A report and the list of events name it.
    const ProgramRun events = cli({"inspect", file, "--events"});
    QVERIFY2(events.out.contains("arrow on the field"), events.out.constData());
    const ProgramRun report = cli({"export", file, "-o", path("report.html")});
    QVERIFY2(report.exitCode == 0, report.err.constData());
    QVERIFY(contents(path("report.html")).contains("arrow on the field"));
  }

  void thePanelListsThem() {
    NotesStudio s;
    const QString file = session("listed.mcap");
    QVERIFY(telemetry::addSessionNote(file.toStdString(), 3.0, "goal"));
    s.replay(file);
    auto* dock = s.window.findChild<QDockWidget*>(QStringLiteral("notes"));
    dock->show();
    dock->raise();
    s.shown()->seek(5.0);
    s.drawOnField("noteArrow", {-3.0, 2.4}, {-1.0, 2.4});
    s.shown()->seek(2.0);
    s.drawOnField("noteCircle", {2.0, -2.0}, {2.5, -2.0});
    auto* table = dock->findChild<QTableView*>(QStringLiteral("notesTable"));
    QTRY_COMPARE(table->model()->rowCount(), 3);
    const auto text = [table](int row, int column) {
      return table->model()->index(row, column).data().toString();
    };
    QCOMPARE(text(0, NotesModel::What), QStringLiteral("Circle on the field"));
    QCOMPARE(text(1, NotesModel::What), QStringLiteral("Bookmark"));
    QCOMPARE(text(1, NotesModel::Text), QStringLiteral("goal"));
    QCOMPARE(text(2, NotesModel::Duration), QStringLiteral("3.0 s"));
    // A click leads there.
    const QModelIndex last = table->model()->index(2, NotesModel::What);
    QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, table->visualRect(last).center());
    QCOMPARE(s.shown()->time(), 5.0);
    // Text and duration are changed in the list.
    QVERIFY(table->model()->setData(last.siblingAtColumn(NotesModel::Text), "B2 alone"));
    QVERIFY(table->model()->setData(last.siblingAtColumn(NotesModel::Duration), "1,5"));
    QVERIFY(table->model()->setData(table->model()->index(1, NotesModel::Text), "a goal"));
    QTRY_COMPARE(text(1, NotesModel::Text), QStringLiteral("a goal"));
    QTRY_COMPARE(text(2, NotesModel::Text), QStringLiteral("B2 alone"));
    QTRY_COMPARE(text(2, NotesModel::Duration), QStringLiteral("1.5 s"));
    QTRY_COMPARE_WITH_TIMEOUT(keptOf(file).size(), std::size_t{2}, patience_ms);
    QTRY_COMPARE_WITH_TIMEOUT(keptOf(file)[1].text, std::string("B2 alone"), patience_ms);
    QCOMPARE(telemetry::readSessionNotes(file.toStdString())->at(3.0), std::string("a goal"));
    // What the filter lets through is saved.
    auto* filter = dock->findChild<QLineEdit*>(QStringLiteral("notesFilter"));
    filter->setText(QStringLiteral("arrow"));
    QCOMPARE(table->model()->rowCount(), 1);
    for (const char* name : {"notes.csv", "notes.json"}) {
      QTimer answer;
      connect(&answer, &QTimer::timeout, this, [this, name, &answer] {
        auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
        if (dialog == nullptr) return;
        answer.stop();
        dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))
            ->setText(path(QLatin1String(name)));
        QTest::mouseClick(dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Save),
                          Qt::LeftButton);
      });
      answer.start(10);
      QTest::mouseClick(dock->findChild<QPushButton*>(QStringLiteral("saveNotes")), Qt::LeftButton);
      QTRY_VERIFY(contents(path(QLatin1String(name))).contains("B2 alone"));
      QVERIFY(!contents(path(QLatin1String(name))).contains("circle"));
    }
    filter->clear();
    // Deleted from the list, it comes back by undo. Bookmarks stay.
    table->selectAll();
    QTest::keyClick(table, Qt::Key_Delete);
    QTRY_COMPARE(table->model()->rowCount(), 1);
    s.action("undo")->trigger();
    QTRY_COMPARE(table->model()->rowCount(), 3);
  }

  void aMatchKeepsThemWithItsRecordings() {
    NotesStudio s;
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    s.playTo(60);
    s.drawOnField("noteArrow", {-3.0, 2.4}, {-1.0, 2.4});
    const double first = s.only().time;
    QCOMPARE(first, s.shown()->now());
    auto* recording = s.window.findChild<SessionRecording*>();
    const QString file = path("recorded.mcap");
    // What was drawn before belongs to it, and what is drawn while it goes on.
    recording->startInto(file);
    QTRY_VERIFY_WITH_TIMEOUT(keptOf(file).size() == 1, patience_ms);
    s.playTo(240);
    s.drawOnField("noteCircle", {2.0, -2.0}, {2.5, -2.0});
    QTRY_VERIFY_WITH_TIMEOUT(keptOf(file).size() == 2, patience_ms);
    // Drawn while looking back.
    s.shown()->seek(2.0);
    QVERIFY(s.shown()->isLookingBack());
    s.drawOnField("noteArrow", {-3.0, -2.4}, {-1.0, -2.4});
    QTRY_VERIFY_WITH_TIMEOUT(keptOf(file).size() == 3, patience_ms);
    QCOMPARE(keptOf(file)[1].time, 2.0);
    s.shown()->goLive();
    recording->stop();
    recording->end();
    QVERIFY(telemetry::SessionReader::open(file.toStdString())->notes().empty());
    // The recent past has those of its time.
    const QString recent = path("recent.mcap");
    const SessionMaker make = recording->recentPast(1.5);
    const auto made = make(recent);
    QVERIFY2(made, made ? "" : made.error().text().c_str());
    // 240 ticks are 4 s: of the last 1.5 s are the circle and the arrow at 2 s, which is shown
    // until 5 s, and the one at 1 s, which is shown until 4 s.
    QCOMPARE(keptOf(recent).size(), std::size_t{3});
    // A match that goes on from earlier has not what came later.
    s.controller.memory()->continueFrom(1.5);
    QTRY_VERIFY_WITH_TIMEOUT(s.shown()->now() < 1.6, patience_ms);
    QTRY_COMPARE_WITH_TIMEOUT(s.board->entries().size(), std::size_t{1}, patience_ms);
    QCOMPARE(s.only().time, first);
    // Another match has none; the one before comes back with its own.
    s.controller.edits()->replaceMatch(link::loadScenario("one-robot").value(),
                                       QStringLiteral("Load"), QStringLiteral("Loaded"), true);
    QTRY_VERIFY_WITH_TIMEOUT(s.board->entries().empty(), patience_ms);
    s.action("undo")->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(s.board->entries().size(), std::size_t{1}, patience_ms);
    QCOMPARE(keptOf(file).size(), std::size_t{3});
  }

  /// Live: drawn at the present and while looking back, with recordings of it.
  void liveRobotsKeepThemWithTheirRecordings() {
    NotesStudio s;
    live_rig::LiveWindow live(s.window);
    QVERIFY(live.isListening());
    for (int i = 0; i < 5; ++i) QVERIFY(live.say());
    s.drawOnField("noteArrow", {-3.0, 2.4}, {-1.0, 2.4});
    QVERIFY(!s.shown()->isLookingBack());
    const DrawnNote atPresent = s.only();
    QVERIFY(s.shown()->available()->begin <= atPresent.time && atPresent.time <= s.shown()->now());
    QVERIFY(s.isSeenAt({-2.0, 2.4}));
    auto* recording = s.window.recording();
    const QString file = path("live.mcap");
    recording->startInto(file);
    QTRY_VERIFY_WITH_TIMEOUT(keptOf(file) == std::vector{atPresent}, patience_ms);
    for (int i = 0; i < 5; ++i) QVERIFY(live.say());
    // The moment of a message, to which one looks back.
    const double then = s.window.live()->frame()->snapshot.time;
    const int place = live.place();
    for (int i = 0; i < 5; ++i) QVERIFY(live.say());
    s.shown()->seek(then);
    QVERIFY(s.shown()->isLookingBack());
    QCOMPARE(live.placeIn(s.shown()->frame()), place);
    s.drawOnField("noteCircle", {2.0, -2.0}, {2.5, -2.0});
    QCOMPARE(s.board->entries().size(), std::size_t{2});
    const DrawnNote past = s.board->entries()[1].note;
    QCOMPARE(past.time, then);
    QVERIFY(s.isSeenAt({2.5, -2.0}));
    QTRY_VERIFY_WITH_TIMEOUT(keptOf(file) == (std::vector{atPresent, past}), patience_ms);
    // What comes meanwhile changes neither the moment nor its notes.
    QVERIFY(live.say());
    QVERIFY(s.shown()->isLookingBack() && s.isSeenAt({2.5, -2.0}));
    // Both are events of Live, and what is undone is undone in the file.
    s.shown()->seek(s.shown()->available()->begin);
    QVERIFY(!s.isSeenAt({2.5, -2.0}));
    const auto row = s.shown()->events()->next(atPresent.time - 1e-6);
    QVERIFY(row);
    QCOMPARE(s.shown()->events()->at(*row).kind, link::MatchEventKind::Note);
    s.action("undo")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(keptOf(file) == std::vector{atPresent}, patience_ms);
    s.action("redo")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(keptOf(file).size() == 2, patience_ms);
    // The recent past has them, too.
    const QString recent = path("live recent.mcap");
    const auto made = recording->recentPast(3600.0)(recent);
    QVERIFY2(made, made ? "" : made.error().text().c_str());
    QVERIFY(keptOf(recent) == (std::vector{atPresent, past}));
    // Another source has none of them, and Live keeps them meanwhile.
    s.window.showSource(SourceKind::Simulate);
    QVERIFY(s.board->entries().empty());
    s.window.showSource(SourceKind::Live);
    QCOMPARE(s.board->entries().size(), std::size_t{2});
    // Live that begins anew has none; the recording that goes on keeps its own.
    s.window.live()->clear();
    QTRY_VERIFY_WITH_TIMEOUT(s.board->entries().empty(), patience_ms);
    QVERIFY(live.say());
    s.drawOnField("noteArrow", {-3.0, -2.4}, {-1.0, -2.4});
    QTRY_VERIFY_WITH_TIMEOUT(keptOf(file).size() == 3, patience_ms);
    QSignalSpy saved(recording, &SessionRecording::saved);
    recording->stop();
    QTRY_COMPARE_WITH_TIMEOUT(saved.size(), 1, patience_ms);
    // In Replay they stand at the moments at which they were drawn.
    s.replay(file);
    QCOMPARE(s.board->entries().size(), std::size_t{3});
    s.shown()->seek(then);
    QTRY_COMPARE_WITH_TIMEOUT(live.placeIn(s.shown()->frame()), place, patience_ms);
    QVERIFY(s.isSeenAt({2.5, -2.0}));
  }

  /// A file that cannot be written is told; one that is damaged stays as it is.
  void whatCannotBeKeptIsTold() {
    NotesStudio s;
    const QString file = session("damaged.mcap");
    const QString notes = file + QStringLiteral(".notes.json");
    QFile damaged(notes);
    QVERIFY(damaged.open(QIODevice::WriteOnly) && damaged.write("{\"bookmarks\": oops") > 0);
    damaged.close();
    s.replay(file);
    QSignalSpy told(s.board, &NoteBoard::notKept);
    s.shown()->seek(5.0);
    s.drawOnField("noteArrow", {-3.0, 2.4}, {-1.0, 2.4});
    QTRY_COMPARE_WITH_TIMEOUT(told.count(), 1, patience_ms);
    QVERIFY2(told[0][0].toString().contains(QStringLiteral("no bookmarks that can be read")),
             qPrintable(told[0][0].toString()));
    QCOMPARE(contents(notes), QByteArray("{\"bookmarks\": oops"));
  }

  void tenThousandAreListed() {
    const QString file = session("many.mcap");
    std::vector<DrawnNote> all;
    for (std::size_t i = 0; i < telemetry::DrawnNotes::most; ++i) {
      DrawnNote note;
      note.time = 12.0 * static_cast<double>(i) / telemetry::DrawnNotes::most;
      note.duration = 0.1;
      note.shape = NoteShape::Arrow;
      note.to = {1.0, 1.0};
      all.push_back(note);
    }
    QVERIFY(telemetry::writeDrawnNotes(file.toStdString(), all));
    NotesStudio s;
    auto* dock = s.window.findChild<QDockWidget*>(QStringLiteral("notes"));
    dock->show();
    dock->raise();
    s.replay(file);
    auto* table = dock->findChild<QTableView*>(QStringLiteral("notesTable"));
    QTRY_COMPARE_WITH_TIMEOUT(table->model()->rowCount(), static_cast<int>(all.size()),
                              patience_ms);
    QSignalSpy told(s.board, &NoteBoard::notKept);
    s.shown()->seek(5.0);
    s.drawOnField("noteArrow", {-3.0, 2.4}, {-1.0, 2.4});
    QCOMPARE(told.count(), 1);
    QCOMPARE(s.board->entries().size(), all.size());
    s.board->remove({s.board->entries()[0].id});
    s.drawOnField("noteArrow", {-3.0, 2.4}, {-1.0, 2.4});
    QCOMPARE(told.count(), 1);
    QCOMPARE(s.board->entries().size(), all.size());
  }
};

PITCHBOARD_GUI_TEST(TestNotes)

}  // namespace tst_notes

#include "tst_notes.moc"
