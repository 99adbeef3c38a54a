// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A video from part of a session file: moments are rebuilt on a thread of their own, painted, and
// go to ffmpeg. UI thread; nothing waits.

#include <QObject>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include <telemetry/series/series_store.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>
#include <ui/sources/field_pictures.h>

#include <ui/session/video_writer.h>

namespace pitchboard::ui {

class VideoExport : public QObject {
  Q_OBJECT
 public:
  VideoExport(std::unique_ptr<FramePainter> painter, QObject* parent);
  ~VideoExport() override;  ///< as cancel()

  /// One second of the session is one second of the video. Errors as VideoWriter::start(), and
  /// InvalidArgument for a range that ends before it begins; later ones come by failed().
  /// `robots`: names of those that are painted; empty: all.
  Result<void> start(const QString& session, telemetry::TimeRange range,
                     const std::vector<std::string>& robots, const VideoOptions& options);
  /// Ends at once and leaves no file. No signal follows.
  void cancel();

 signals:
  void progressed(double part);
  void finished(const QString& path);
  void failed(const QString& sentence);

 private:
  struct Reader;
  void next();
  void read();
  void draw(const FramePtr& frame);

  std::unique_ptr<FramePainter> m_painter;
  VideoWriter m_writer;
  std::shared_ptr<Reader> m_reader;  // of the reading thread, while a video is made
  telemetry::TimeRange m_range;
  double m_rate = 30.0;
  qint64 m_pictures = 0, m_drawn = 0;
  bool m_reading = false;
  FramePtr m_frame;  // read and not drawn yet
  std::uint64_t m_job = 0;
  UiQueue m_toUi;
  Workers m_worker;
};

}  // namespace pitchboard::ui
