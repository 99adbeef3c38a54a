// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One video of a session: its file, which is opened and decoded on a thread of its own, its
// alignment, and the picture that was asked for last. Of several requests only the newest is
// decoded. Times in seconds of the video. UI thread only; owned by the panel.

#include <QImage>
#include <QObject>
#include <QSize>
#include <QString>
#include <atomic>
#include <memory>
#include <optional>
#include <vector>

#include <telemetry/session/session_videos.h>
#include <telemetry/video/video_file.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>

namespace pitchboard::ui {

/// The image keeps the pixels. Any thread.
QImage imageOf(telemetry::VideoPicture picture);

class VideoCamera : public QObject {
  Q_OBJECT
 public:
  /// Opens the file; opened() or failed() follows.
  VideoCamera(telemetry::SessionVideo kept, QObject* parent);
  ~VideoCamera() override;

  const telemetry::SessionVideo& kept() const { return m_kept; }
  QString name() const;  ///< of the file, without folder
  /// Null until the file is open.
  const telemetry::VideoInfo* info() const { return m_file ? &m_file->info() : nullptr; }
  std::span<const double> times() const;
  QString problem() const { return m_problem; }  ///< why nothing can be shown; or empty
  double opening() const { return m_opening; }   ///< share of the file that has been read

  const telemetry::VideoAlignment& alignment() const { return m_alignment; }
  /// Fails as alignmentOf() does, and then nothing has changed. alignmentChanged() follows.
  Result<void> setAnchors(std::vector<telemetry::VideoAnchor> anchors);
  /// Returns the moments of kept(), all moved so that the video begins at this second of the
  /// session; its drift stays.
  std::vector<telemetry::VideoAnchor> anchorsFrom(double begin) const;
  void setLandmarks(std::vector<telemetry::VideoLandmark> landmarks);

  /// Asks for the picture that is shown at this time, for a view of this size (pixels).
  /// pictureChanged() follows.
  void show(double time, QSize room);
  void showIndex(std::size_t index, QSize room);
  /// Returns the picture that is shown at this time; 0 until the file is open.
  std::size_t indexAt(double time) const { return m_file ? m_file->indexAt(time) : 0; }
  /// Returns the index of the picture that was asked for last.
  std::size_t wanted() const { return m_wanted; }
  /// Returns whether the time that was asked for is in the video.
  bool isCovered() const { return m_isCovered; }
  const QImage& picture() const { return m_picture; }
  /// Returns the index of picture(); empty while there is none.
  std::optional<std::size_t> shown() const { return m_shown; }

 signals:
  void opened();
  void failed();
  void openingChanged();
  void pictureChanged();
  void alignmentChanged();
  void landmarksChanged();

 private:
  void decode();
  void take(std::size_t index, const Result<telemetry::VideoPicture>& result);

  telemetry::SessionVideo m_kept;
  telemetry::VideoAlignment m_alignment;
  std::shared_ptr<telemetry::VideoFile> m_file;  // pictures are the worker's
  QString m_problem;
  double m_opening = 0.0;
  std::size_t m_wanted = 0;
  QSize m_room;         // for which it is wanted
  QSize m_decodedRoom;  // for which the last one was decoded
  bool m_isCovered = true, m_isDecoding = false;
  QImage m_picture;
  std::optional<std::size_t> m_shown;
  std::atomic<bool> m_cancelled = false;
  UiQueue m_toUi;
  Workers m_worker;  // last: waits for its work before the rest goes
};

}  // namespace pitchboard::ui
