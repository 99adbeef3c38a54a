// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A video of the field from part of a session file: moments are rebuilt on a thread of their own,
// are drawn as the field shows them, and go to ffmpeg. UI thread; nothing waits.

#include <QObject>
#include <atomic>
#include <memory>

#include <telemetry/series/series_store.h>
#include <ui/base/ui_queue.h>
#include <ui/base/workers.h>
#include <ui/field/field_style.h>

#include "video_writer.h"

namespace pitchboard::ui {

class FieldScene;

class VideoExport : public QObject {
  Q_OBJECT
 public:
  /// `style`: side and layers.
  VideoExport(const FieldStyle& style, QObject* parent);
  ~VideoExport() override;  ///< as cancel()

  /// One second of the session is one second of the video. Errors as VideoWriter::start(), and
  /// InvalidArgument for a range that ends before it begins; later ones come by failed().
  Result<void> start(const QString& session, telemetry::TimeRange range,
                     const VideoOptions& options);
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

  std::unique_ptr<FieldScene> m_scene;
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
