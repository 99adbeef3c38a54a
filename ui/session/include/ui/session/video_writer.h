// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Writes a video from pictures: they are piped as raw pixels into ffmpeg, a program of its own that
// is looked for when a video is wanted. The file gets its name only when it is whole: cancelling,
// or an error, leaves nothing behind. UI thread; nothing waits: give a picture whenever ready() is
// true.

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
  QString path;                   ///< ends in .mp4 or .webm, which chooses the format
  QSize size{1280, 720};          ///< pixels; odd sizes lose a row or a column
  double framesPerSecond = 30.0;  ///< of the video, 1 to 240
  bool overwrite = false;         ///< an existing file is replaced, once the new one is whole
  QString program = QStringLiteral("ffmpeg");
  QString source = {};  ///< the file that is read meanwhile; it is never overwritten
};

class VideoWriter : public QObject {
  Q_OBJECT

 public:
  static constexpr int smallest = 16, largest = 8192;  ///< pixels of a side

  explicit VideoWriter(QObject* parent = nullptr);
  ~VideoWriter() override;  ///< as cancel()

  /// Error InvalidArgument (name, size, rate), Conflict (the file exists or is the source, or a
  /// video is being written), NotFound (there is no ffmpeg) or SystemError (it cannot be started,
  /// the folder cannot be written), in a sentence for the screen.
  Result<void> start(const VideoOptions& options);
  bool isWriting() const { return m_process.state() != QProcess::NotRunning; }
  /// A picture is welcome now: little waits to be encoded.
  bool ready() const;
  /// Copies it; one of another size is scaled. Pictures that come while nothing is written are
  /// ignored.
  void add(const QImage& picture);
  /// That was the last picture; finished() or failed() follows.
  void finish();
  /// Ends at once and removes what was written. No signal follows.
  void cancel();

  qint64 pictures() const { return m_pictures; }  ///< added so far
  QSize size() const { return m_size; }           ///< of the video

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
  bool m_active = false;  // a video is being made; false again when it is told how that ended
};

}  // namespace pitchboard::ui
