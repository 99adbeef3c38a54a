// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes a video from pictures, which are piped as raw pixels into the program ffmpeg. The file
// gets its name only when it is complete; cancelling or an error leaves nothing behind. UI thread
// only; never blocks: add a picture whenever ready() is true.

#include <QImage>
#include <QObject>
#include <QProcess>
#include <QSize>
#include <QString>

#include <optional>

#include <base/file_target.h>
#include <base/result.h>

namespace pitchboard::ui {

struct VideoOptions {
  QString path;                   ///< must end in .mp4 or .webm, which selects the format
  QSize size{1280, 720};          ///< pixels; rounded down to even numbers
  double framesPerSecond = 30.0;  ///< 1 to 240
  bool overwrite = false;         ///< replace an existing file once the new one is complete
  QString program = QStringLiteral("ffmpeg");
  QString source = {};  ///< the file that is being read; it is never overwritten
};

class VideoWriter : public QObject {
  Q_OBJECT

 public:
  static constexpr int smallest = 16, largest = 8192;  ///< width and height in pixels

  explicit VideoWriter(QObject* parent = nullptr);
  ~VideoWriter() override;  ///< same as cancel()

  /// Errors, with a message for the screen: InvalidArgument (name, size, rate), Conflict (the file
  /// exists or is the source, or a video is being written), NotFound (ffmpeg is not installed),
  /// SystemError (ffmpeg cannot be started, or the folder is not writable).
  Result<void> start(const VideoOptions& options);
  bool isWriting() const { return m_process.state() != QProcess::NotRunning; }
  /// Returns whether a picture can be added now because few are waiting to be encoded.
  bool ready() const;
  /// Adds a copy of the picture, scaled if it has another size. Ignored if no video is being
  /// written.
  void add(const QImage& picture);
  /// Call it after the last picture; finished() or failed() follows.
  void finish();
  /// Stops immediately and removes what was written. No signal follows.
  void cancel();

  qint64 pictures() const { return m_pictures; }  ///< added so far
  QSize size() const { return m_size; }

 signals:
  /// ready() has become true.
  void wantsPicture();
  void finished(const QString& path);
  /// `sentence`: what went wrong and what to do.
  void failed(const QString& sentence);

 private:
  void onFinished(int exitCode, QProcess::ExitStatus status);
  void onError(QProcess::ProcessError error);
  void fail(const QString& sentence);

  VideoOptions m_options;
  std::optional<FileTarget> m_target;  // while a video is being made
  QSize m_size;
  QProcess m_process;
  QByteArray m_output;  // of ffmpeg, for errors
  qint64 m_pictures = 0;
  bool m_ending = false;  // finish() was called
  bool m_active = false;  // a video is being made; false again once the result is reported
};

}  // namespace pitchboard::ui
