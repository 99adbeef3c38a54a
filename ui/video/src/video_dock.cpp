// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/video/video_dock.h>

#include <QAction>
#include <QDragEnterEvent>
#include <QFile>
#include <QLabel>
#include <QMimeData>
#include <QPointer>
#include <QTimer>
#include <QToolButton>
#include <QUndoStack>
#include <QUrl>
#include <QVBoxLayout>
#include <filesystem>
#include <map>

#include <telemetry/session/session_notes.h>
#include <ui/base/file_dialog.h>
#include <ui/base/in_place_message.h>
#include <ui/base/table_style.h>
#include <ui/sources/note_board.h>
#include <ui/sources/note_layer.h>
#include <ui/sources/note_painting.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/session_recording.h>
#include <ui/sources/shown_moment.h>

#include "align_bar.h"
#include "camera_grid.h"
#include "points_bar.h"
#include "video_tracks.h"
#include "video_view.h"

namespace pitchboard::ui {
namespace {

constexpr int saveAfterMilliseconds = 400;

struct Camera {
  std::unique_ptr<VideoCamera> video;
  VideoView* view = nullptr;
};

/// Where the videos of a source are kept: beside a recording, or in memory.
struct VideoHome {
  const FrameSource* source = nullptr;
  std::string session;  ///< empty: memory
  bool operator==(const VideoHome&) const = default;
};

/// A video was aligned otherwise. Nothing can be undone of one that was removed.
class AlignVideo : public QUndoCommand {
 public:
  using Anchors = std::vector<telemetry::VideoAnchor>;
  enum class Step { Single, OneOfMany };

  AlignVideo(const QString& text, VideoCamera* camera, Anchors before, Anchors after, Step step)
      : QUndoCommand(text),
        m_camera(camera),
        m_before(std::move(before)),
        m_after(std::move(after)),
        m_step(step) {}
  void redo() override { set(m_after); }
  void undo() override { set(m_before); }
  int id() const override { return m_step == Step::OneOfMany ? 1 : -1; }
  bool mergeWith(const QUndoCommand* next) override {
    const auto* other = static_cast<const AlignVideo*>(next);
    if (other->m_camera != m_camera) return false;
    m_after = other->m_after;
    return true;
  }

 private:
  void set(const Anchors& anchors) {
    if (m_camera.isNull() || !m_camera->setAnchors(anchors)) setObsolete(true);
  }
  QPointer<VideoCamera> m_camera;
  Anchors m_before, m_after;
  Step m_step;
};

QStringList draggedVideos(const QMimeData* data) {
  QStringList paths;
  for (const QUrl& url : data->urls()) {
    const QString path = url.toLocalFile();
    if (!path.isEmpty() && !path.endsWith(QLatin1String(".mcap"))) paths << path;
  }
  return paths;
}

/// With a decoder of its own: the panel goes on meanwhile.
FilmCamera filmCamera(const telemetry::SessionVideo& kept, bool hasOverlay,
                      std::vector<telemetry::DrawnNote> notes) {
  FilmCamera camera;
  const auto alignment = telemetry::alignmentOf(kept.anchors).value_or(telemetry::VideoAlignment{});
  const auto file = std::make_shared<std::optional<Result<telemetry::VideoFile>>>();
  camera.picture = [path = kept.path, alignment, file](double time, QSize within,
                                                       const std::function<bool()>& goesOn) {
    const auto progress = [&goesOn](double) { return goesOn(); };
    if (!*file) file->emplace(telemetry::VideoFile::open(path, progress));
    if (!**file) return QImage();
    telemetry::VideoFile& video = ***file;
    const double own = alignment.videoTime(time);
    if (own < 0.0 || own >= video.info().duration) return QImage();
    auto picture = video.picture(video.indexAt(own), within.width(), within.height(), progress);
    return picture ? imageOf(std::move(*picture)) : QImage();
  };
  const auto ground = hasOverlay ? groundToPicture(kept.landmarks) : std::nullopt;
  camera.overlay = [ground, notes = std::move(notes),
                    name = std::filesystem::path(kept.path).filename().string()](
                       QPainter& painter, const QRectF& rect, const link::MatchFrame& frame) {
    if (ground) paintOverlay(painter, *ground, rect, frame);
    paintVideoNotes(painter, notes, name, rect, frame.snapshot.time);
  };
  return camera;
}

class VideoDock : public QWidget {
 public:
  VideoDock(const VideoDockParts& parts, QWidget* parent)
      : QWidget(parent),
        m_parts(parts),
        m_message(new InPlaceMessage(this)),
        m_grid(new CameraGrid(this)),
        m_tracks(new VideoTracks(parts.shown, this)),
        m_empty(makeEmptyLabel(this, QStringLiteral("emptyVideo"))),
        m_alignBar(new AlignBar(parts.shown, this)),
        m_pointsBar(new PointsBar(this)) {
    setAcceptDrops(true);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addLayout(makeTools());
    column->addWidget(m_message);
    column->addWidget(m_grid, 1);
    column->addWidget(m_tracks);
    column->addWidget(m_empty, 1);
    column->addWidget(m_alignBar);
    column->addWidget(m_pointsBar);
    m_message->clear();
    m_empty->setText(QStringLiteral(
        "Add videos of this match, or drop them here, to see them at the moment that is shown. "
        "They play, stop and step with the session."));
    m_save.setSingleShot(true);
    m_save.setInterval(saveAfterMilliseconds);
    follow();
    load();
  }
  ~VideoDock() override { saveNow(); }

  QUndoStack* undoStack() { return &m_undo; }
  bool cancel() { return m_tracks->cancel(); }
  std::vector<FilmCamera> film() const {
    std::vector<FilmCamera> all;
    for (const Camera& camera : m_cameras) {
      if (camera.video->info() != nullptr) {
        all.push_back(filmCamera(camera.video->kept(), m_lines->isChecked(),
                                 m_parts.notes != nullptr ? m_parts.notes->notes()
                                                          : std::vector<telemetry::DrawnNote>()));
      }
    }
    return all;
  }

 protected:
  void showEvent(QShowEvent* event) override {
    QWidget::showEvent(event);
    refresh();
  }
  void dragEnterEvent(QDragEnterEvent* event) override {
    if (!draggedVideos(event->mimeData()).isEmpty()) event->acceptProposedAction();
  }
  void dropEvent(QDropEvent* event) override {
    event->acceptProposedAction();
    for (const QString& path : draggedVideos(event->mimeData())) addFile(path);
  }
  QSize sizeHint() const override { return {scaled(this, 640), scaled(this, 300)}; }

 private:
  QHBoxLayout* makeTools() {
    auto* row = new QHBoxLayout;
    const int gap = scaled(this, 4);
    row->setContentsMargins(gap, gap, gap, gap);
    row->setSpacing(gap);
    const auto button = [&](const char* name, const char* text, const char* tip) {
      auto* made = new QToolButton(this);
      made->setObjectName(QLatin1String(name));
      made->setText(QString::fromUtf8(text));
      made->setToolTip(QString::fromUtf8(tip));
      row->addWidget(made);
      return made;
    };
    auto* add = button("addVideo", "Add video…", "Adds a video of this match");
    connect(add, &QToolButton::clicked, this, [this] { askAndAdd(); });
    m_align = button("alignVideo", "Align",
                     "Goes through the video while the session stands still, to say which picture "
                     "is which moment");
    m_lines = button("videoField", "Field lines",
                     "Draws the field, its robots and the ball into the picture");
    m_points = button("videoPoints", "Points…", "Says where four points of the field are seen");
    m_remove =
        button("removeVideo", "Remove", "Removes the video from the session. The file stays");
    if (m_parts.notes != nullptr) {
      for (QAction* tool : m_parts.notes->tools()) {
        QToolButton* draw = button("drawOnVideo", "", "");
        draw->setDefaultAction(tool);
        draw->setToolButtonStyle(Qt::ToolButtonIconOnly);
      }
    }
    row->addStretch(1);
    for (QToolButton* toggle : {m_align, m_lines, m_points}) toggle->setCheckable(true);
    connect(m_align, &QToolButton::toggled, this, [this] {
      if (m_align->isChecked()) m_points->setChecked(false);
      showBars();
    });
    connect(m_points, &QToolButton::toggled, this, [this] {
      if (m_points->isChecked()) {
        m_align->setChecked(false);
        m_lines->setChecked(true);
      }
      showBars();
    });
    connect(m_lines, &QToolButton::toggled, this, [this](bool on) {
      if (on && current() != nullptr && current()->video->kept().landmarks.empty()) {
        m_points->setChecked(true);
      }
      showBars();
    });
    connect(m_remove, &QToolButton::clicked, this, [this] { removeCurrent(); });
    const auto step = [this](const char* name, const char* text, int pictures) {
      auto* action = new QAction(QString::fromUtf8(text), this);
      action->setObjectName(QLatin1String(name));
      connect(action, &QAction::triggered, this, [this, pictures] { stepPictures(pictures); });
      addAction(action);
    };
    step("previousPicture", "Previous picture of the video", -1);
    step("nextPicture", "Next picture of the video", 1);
    return row;
  }

  void follow() {
    const ShownMoment* shown = m_parts.shown;
    connect(shown, &ShownMoment::sourceChanged, this, &VideoDock::load);
    connect(m_parts.replay, &ReplayController::opened, this, &VideoDock::load);
    connect(shown, &ShownMoment::moved, this, &VideoDock::refresh);
    connect(shown, &FrameSource::frameReceived, this, &VideoDock::refresh);
    connect(m_alignBar, &AlignBar::indexChanged, this, &VideoDock::refresh);
    connect(m_alignBar, &AlignBar::aligned, this, [this](const AlignVideo::Anchors& anchors) {
      alignCurrent(anchors, AlignVideo::Step::Single);
    });
    connect(m_alignBar, &AlignBar::shifted, this, [this](const AlignVideo::Anchors& anchors) {
      alignCurrent(anchors, AlignVideo::Step::OneOfMany);
    });
    connect(m_tracks, &VideoTracks::pressed, this, &VideoDock::chooseCamera);
    connect(m_tracks, &VideoTracks::dragged, this,
            [this](VideoCamera* camera, const AlignVideo::Anchors& before) {
              m_message->clear();  // that it is not aligned yet
              m_undo.push(new AlignVideo(QStringLiteral("Move video"), camera, before,
                                         camera->kept().anchors, AlignVideo::Step::Single));
            });
    connect(m_alignBar, &AlignBar::done, this, [this] { m_align->setChecked(false); });
    connect(m_pointsBar, &PointsBar::done, this, [this] { m_points->setChecked(false); });
    connect(m_pointsBar, &PointsBar::nextChanged, this, &VideoDock::showPlacing);
    connect(&m_save, &QTimer::timeout, this, &VideoDock::saveNow);
    connect(m_parts.recording, &SessionRecording::changed, this, &VideoDock::keepWithRecording);
    connect(m_parts.recording, &SessionRecording::saved, this, &VideoDock::keepWith);
  }

  Camera* current() { return m_current < m_cameras.size() ? &m_cameras[m_current] : nullptr; }
  sim::FieldSpec field() const {
    const FramePtr frame = m_parts.shown->frame();
    return frame ? frame->settings->field : sim::FieldSpec();
  }

  VideoHome home() const {
    VideoHome home{m_parts.shown->source(), {}};
    if (home.source == m_parts.replay) home.session = m_parts.replay->recording().toStdString();
    return home;
  }

  std::vector<telemetry::SessionVideo> videos() const {
    std::vector<telemetry::SessionVideo> all;
    for (const Camera& camera : m_cameras) all.push_back(camera.video->kept());
    return all;
  }

  /// The videos of what is shown now.
  void load() {
    if (m_home == home()) return;
    saveNow();
    m_align->setChecked(false);
    m_points->setChecked(false);
    m_message->clear();
    m_undo.clear();
    while (!m_cameras.empty()) removeCamera(m_cameras.size() - 1);
    m_home = home();
    std::vector<telemetry::SessionVideo> kept = m_inMemory[m_home.source];
    if (!m_home.session.empty()) {
      auto read = telemetry::readSessionVideos(m_home.session);
      if (!read) complain("Could not read the videos of this session", read.error());
      kept = read ? std::move(*read) : std::vector<telemetry::SessionVideo>();
    }
    for (telemetry::SessionVideo& video : kept) addCamera(std::move(video));
    m_current = 0;
    m_lines->setChecked(std::ranges::any_of(
        m_cameras, [](const Camera& one) { return !one.video->kept().landmarks.empty(); }));
    showBars();
  }

  void saveNow() {
    if (!m_isChanged) return;
    m_save.stop();
    m_isChanged = false;
    if (m_home.session.empty()) {
      m_inMemory[m_home.source] = videos();
      keepWithRecording();
      return;
    }
    const auto kept = telemetry::writeSessionVideos(m_home.session, videos());
    if (!kept) complain("The alignment will be lost", kept.error());
  }

  /// A match or live robots are recorded: what is in memory goes with the recording, too.
  void keepWith(const QString& recording, const FrameSource* source) {
    if (m_home == VideoHome{source, {}}) m_inMemory[source] = videos();
    const std::vector<telemetry::SessionVideo>& known = m_inMemory[source];
    const std::string path = recording.toStdString();
    const bool hasFile = QFile::exists(QString::fromStdString(telemetry::sessionNotesPath(path)));
    if (known.empty() && !hasFile) return;
    const auto kept = telemetry::writeSessionVideos(path, known);
    if (!kept) complain("The videos are not kept with the recording", kept.error());
  }

  void keepWithRecording() {
    if (const FrameSource* source = m_parts.recording->source()) {
      keepWith(m_parts.recording->path(), source);
    }
  }

  void saveSoon() {
    m_isChanged = true;
    m_save.start();
  }

  void complain(const char* what, const Error& error) {
    m_message->showMessage(InPlaceMessage::Tone::Error,
                           QStringLiteral("%1: %2").arg(QString::fromUtf8(what),
                                                        QString::fromStdString(error.text())));
  }

  void askAndAdd() {
    const QString path =
        askToOpen(this, QStringLiteral("Add video"),
                  QStringLiteral("Videos (*.mp4 *.mov *.mkv *.webm *.avi *.ts *.mts *.m4v *.mpg "
                                 "*.MP4 *.MOV *.MTS *.AVI);;All files (*)"));
    if (!path.isEmpty()) addFile(path);
  }

  void addFile(const QString& path) {
    addCamera({path.toStdString(), {}, {}});
    choose(m_cameras.size() - 1);
    saveSoon();
  }

  void addCamera(telemetry::SessionVideo kept) {
    Camera camera;
    camera.video = std::make_unique<VideoCamera>(std::move(kept), nullptr);
    camera.view = new VideoView(camera.video.get(), m_grid);
    VideoCamera* video = camera.video.get();
    connect(video, &VideoCamera::opened, this, [this, video] {
      if (video->kept().anchors.empty()) alignFirst(*video);
      refresh();
      showBars();
    });
    connect(video, &VideoCamera::alignmentChanged, this, [this] {
      saveSoon();
      refresh();
    });
    connect(video, &VideoCamera::landmarksChanged, this, &VideoDock::saveSoon);
    connect(camera.view, &VideoView::resized, this, &VideoDock::refresh);
    connect(camera.view, &VideoView::pressed, this, [this, video] { chooseCamera(video); });
    connect(camera.view, &VideoView::placed, m_pointsBar, &PointsBar::place);
    if (m_parts.notes != nullptr) addNotes(camera.view);
    m_cameras.push_back(std::move(camera));
    m_grid->add(m_cameras.back().view);
  }

  /// Nothing is drawn on a picture that is not of the moment that is shown.
  void addNotes(VideoView* view) {
    VideoCamera* video = view->camera();
    const std::string name = video->name().toStdString();
    const auto isOfMoment = [this, view, video] {
      return video->isCovered() && !video->picture().isNull() && !view->isPlacing() &&
             !(m_align->isChecked() && current() != nullptr && current()->view == view);
    };
    auto* layer = new NoteLayer(
        m_parts.notes,
        {telemetry::NotePlace::Video,
         [name](const QPointF&) {
           return NoteGround::Owner{name, {}};
         },
         [view, name, isOfMoment](const std::string& on) -> std::optional<QTransform> {
           if (on != name || !isOfMoment()) return {};
           return fromShares(view->pictureRect());
         },
         [view] { return view->pictureRect(); }},
        view, view);
    connect(video, &VideoCamera::pictureChanged, layer, &NoteLayer::refresh);
    connect(m_align, &QToolButton::toggled, layer, &NoteLayer::refresh);
  }

  /// A new video begins where its clock says, or with the session.
  void alignFirst(VideoCamera& video) {
    const auto range = m_parts.shown->available();
    const auto byClock = AlignBar::beginByClock(video, *m_parts.shown);
    bool isOfThisTime = false;
    if (byClock && range) {
      const double until = *byClock + video.info()->duration;
      isOfThisTime = *byClock < range->end && until > range->begin;
    }
    const double begin = isOfThisTime ? *byClock : range ? range->begin : 0.0;
    if (!video.setAnchors({{begin, 0.0}})) return;
    m_message->showMessage(
        InPlaceMessage::Tone::Note,
        isOfThisTime
            ? QStringLiteral("%1 is aligned by the clock of the camera, which may be "
                             "wrong by seconds.")
                  .arg(video.name())
            : QStringLiteral("%1 begins with the session until you align it.").arg(video.name()),
        QStringLiteral("Align"), [this] {
          m_message->clear();
          m_align->setChecked(true);
        });
  }

  void removeCamera(std::size_t index) {
    // They show and use the camera.
    m_alignBar->start(nullptr);
    m_pointsBar->start(nullptr, {});
    m_tracks->setCameras({});
    m_grid->remove(m_cameras[index].view);
    delete m_cameras[index].view;
    m_cameras.erase(m_cameras.begin() + static_cast<std::ptrdiff_t>(index));
  }

  void removeCurrent() {
    if (current() == nullptr) return;
    m_align->setChecked(false);
    m_points->setChecked(false);
    const QString name = current()->video->name();
    const telemetry::SessionVideo kept = current()->video->kept();
    removeCamera(m_current);
    choose(m_current > 0 ? m_current - 1 : 0);
    saveSoon();
    m_message->showMessage(InPlaceMessage::Tone::Note,
                           QStringLiteral("%1 was removed from the session.").arg(name),
                           QStringLiteral("Undo"), [this, kept] {
                             m_message->clear();
                             addCamera(kept);
                             choose(m_cameras.size() - 1);
                             saveSoon();
                           });
  }

  void choose(std::size_t index) {
    if (std::exchange(m_current, index) == index && m_shownBars == index) return;
    showBars();
  }

  void chooseCamera(const VideoCamera* camera) {
    for (std::size_t i = 0; i < m_cameras.size(); ++i) {
      if (m_cameras[i].video.get() == camera) choose(i);
    }
  }

  void alignCurrent(const AlignVideo::Anchors& anchors, AlignVideo::Step step) {
    VideoCamera* camera = current()->video.get();
    if (const auto alignment = telemetry::alignmentOf(anchors); !alignment) {
      m_message->showMessage(InPlaceMessage::Tone::Error,
                             QString::fromStdString(alignment.error().message));
      return;
    }
    m_undo.push(new AlignVideo(QStringLiteral("Align video"), camera, camera->kept().anchors,
                               anchors, step));
  }

  /// Buttons and bars are those of the current camera.
  void showBars() {
    Camera* camera = current();
    m_shownBars = m_current;
    const bool isOpen = camera != nullptr && camera->video->info() != nullptr;
    for (QToolButton* one : {m_align, m_lines, m_points}) one->setEnabled(isOpen);
    m_remove->setEnabled(camera != nullptr);
    m_grid->setVisible(camera != nullptr);
    std::vector<VideoCamera*> open;
    for (const Camera& one : m_cameras) {
      if (one.video->info() != nullptr) open.push_back(one.video.get());
    }
    m_tracks->setCameras(std::move(open));
    m_empty->setVisible(camera == nullptr);
    const bool aligns = isOpen && m_align->isChecked(), places = isOpen && m_points->isChecked();
    m_alignBar->start(aligns ? camera->video.get() : nullptr);
    m_alignBar->setVisible(aligns);
    m_pointsBar->start(places ? camera->video.get() : nullptr, field());
    m_pointsBar->setVisible(places);
    for (std::size_t i = 0; i < m_cameras.size(); ++i) {
      m_cameras[i].view->setCurrent(i == m_current, m_cameras.size() > 1);
      m_cameras[i].view->setOverlay(m_lines->isChecked());
    }
    showPlacing();
    refresh();
  }

  void showPlacing() {
    for (std::size_t i = 0; i < m_cameras.size(); ++i) {
      const bool places = i == m_current && m_pointsBar->isVisibleTo(this);
      m_cameras[i].view->setPlacing(places, places ? m_pointsBar->next() : std::nullopt);
    }
  }

  /// Asks every camera for the picture of the moment that is shown.
  void refresh() {
    if (!isVisible()) return;
    const double time = m_parts.shown->time();
    for (std::size_t i = 0; i < m_cameras.size(); ++i) {
      Camera& camera = m_cameras[i];
      camera.view->setFrame(m_parts.shown->frame());
      const bool isFree = i == m_current && m_align->isChecked();
      if (isFree && m_alignBar->index() < camera.video->times().size()) {
        camera.video->show(camera.video->times()[m_alignBar->index()], camera.view->room());
      } else {
        camera.video->show(camera.video->alignment().videoTime(time), camera.view->room());
      }
    }
  }

  void stepPictures(int pictures) {
    Camera* camera = current();
    if (!isVisible() || camera == nullptr || camera->video->times().empty()) return;
    if (m_align->isChecked()) return m_alignBar->step(pictures);
    const VideoCamera& video = *camera->video;
    const auto last = static_cast<std::ptrdiff_t>(video.times().size()) - 1;
    const auto from = video.indexAt(video.alignment().videoTime(m_parts.shown->time()));
    const auto to =
        std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(from) + pictures, 0, last);
    m_parts.shown->setPaused(true);
    m_parts.shown->seek(video.alignment().sessionTime(video.times()[static_cast<std::size_t>(to)]));
  }

  VideoDockParts m_parts;
  InPlaceMessage* m_message;
  CameraGrid* m_grid;
  VideoTracks* m_tracks;
  QLabel* m_empty;
  AlignBar* m_alignBar;
  PointsBar* m_pointsBar;
  QToolButton *m_align = nullptr, *m_lines = nullptr, *m_points = nullptr, *m_remove = nullptr;
  std::vector<Camera> m_cameras;
  std::size_t m_current = 0;
  std::optional<std::size_t> m_shownBars;  // of this camera
  VideoHome m_home;
  bool m_isChanged = false;
  QTimer m_save;
  QUndoStack m_undo;  // of alignments
  std::map<const FrameSource*, std::vector<telemetry::SessionVideo>> m_inMemory;
};

}  // namespace

QWidget* makeVideoDock(const VideoDockParts& parts, QWidget* parent) {
  return new VideoDock(parts, parent);
}

QUndoStack* videoUndoStack(QWidget* videoDock) {
  return static_cast<VideoDock*>(videoDock)->undoStack();
}

bool cancelVideoDrag(QWidget* videoDock) {
  return static_cast<VideoDock*>(videoDock)->cancel();
}

std::vector<FilmCamera> filmCameras(const QWidget* videoDock) {
  return static_cast<const VideoDock*>(videoDock)->film();
}

}  // namespace pitchboard::ui
