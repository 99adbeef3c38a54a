// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes a video of part of a session file: moments are rebuilt on a thread of their own, painted,
// and passed to ffmpeg. UI thread only; never blocks.

#include <QObject>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <telemetry/series/series_store.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>
#include <ui/sources/field_pictures.h>
#include <ui/sources/film_parts.h>

#include <ui/session/video_writer.h>

namespace pitchboard::ui {

class VideoExport : public QObject {
  Q_OBJECT
 public:
  VideoExport(std::unique_ptr<FramePainter> painter, QObject* parent);
  ~VideoExport() override;  ///< same as cancel()

  /// Starts a video in which a second is a second of the session. Fails as VideoWriter::start(),
  /// and with InvalidArgument if the range ends before it begins; later errors come with failed().
  /// `robots` are the names of the robots to paint; empty: all. `parts` are shown beside the field.
  Result<void> start(const QString& session, telemetry::TimeRange range,
                     const std::vector<std::string>& robots, const VideoOptions& options,
                     FilmParts parts = {});
  /// Stops immediately and leaves no file. No signal follows.
  void cancel();

 signals:
  void progressed(double part);
  void finished(const QString& path);
  void failed(const QString& sentence);

 private:
  struct Reader;
  struct Moment {
    FramePtr frame;
    std::vector<QImage> cameras;  // of m_parts
    double time = 0.0;            // s
  };
  void next();
  void read();
  void draw(const Moment& moment);

  std::unique_ptr<FramePainter> m_painter;
  VideoWriter m_writer;
  std::shared_ptr<Reader> m_reader;  // of the reading thread, while a video is made
  telemetry::TimeRange m_range;
  double m_rate = 30.0;
  qint64 m_pictures = 0, m_drawn = 0;
  bool m_reading = false;
  FilmParts m_parts;
  std::optional<Moment> m_moment;  // read and not drawn yet
  std::uint64_t m_job = 0;
  UiQueue m_toUi;
  Workers m_worker;
};

}  // namespace pitchboard::ui
