// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/session/video_writer.h>

#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>

#include <array>

namespace pitchboard::ui {
namespace {

constexpr qint64 maxWaiting = qint64{64} << 20;  // bytes in the pipe's buffer
constexpr qsizetype maxOutput = 16384;           // bytes of ffmpeg's complaints that are kept

struct Format {
  QLatin1String suffix;
  const char* name;  // for people
  QStringList arguments;
};

const std::array<Format, 2>& formats() {
  static const std::array<Format, 2> all{{
      {QLatin1String("mp4"),
       "MP4",
       {"-c:v", "libx264", "-preset", "veryfast", "-crf", "20", "-pix_fmt", "yuv420p", "-movflags",
        "+faststart", "-f", "mp4"}},
      {QLatin1String("webm"),
       "WebM",
       {"-c:v", "libvpx-vp9", "-crf", "32", "-b:v", "0", "-deadline", "realtime", "-cpu-used", "6",
        "-row-mt", "1", "-pix_fmt", "yuv420p", "-f", "webm"}},
  }};
  return all;
}

const Format* formatOf(const QString& path) {
  const QString suffix = QFileInfo(path).suffix().toLower();
  for (const Format& format : formats()) {
    if (suffix == format.suffix) return &format;
  }
  return nullptr;
}

/// What ffmpeg says, as a sentence.
QString sentenceOf(const QByteArray& output, const QString& path) {
  const QString text = QString::fromLocal8Bit(output);
  if (text.contains(QLatin1String("No space left"))) {
    return QStringLiteral(
        "Could not finish the video: the disk is full. Free some space or choose another folder.");
  }
  if (text.contains(QLatin1String("File too large"))) {
    return QStringLiteral(
        "Could not finish the video: the file has reached the size limit. Choose a "
        "shorter range or a lower rate.");
  }
  if (text.contains(QLatin1String("Unknown encoder")) ||
      text.contains(QLatin1String("Unrecognized option"))) {
    const Format* format = formatOf(path);
    return QStringLiteral(
               "This ffmpeg cannot write %1 videos. Choose the other format, or install a "
               "complete ffmpeg.")
        .arg(format ? QLatin1String(format->name) : QLatin1String("such"));
  }
  const QStringList lines = text.split('\n', Qt::SkipEmptyParts);
  const QString last =
      lines.isEmpty() ? QStringLiteral("it gave no reason") : lines.last().trimmed();
  return QStringLiteral("Could not write the video: ffmpeg ended with an error (%1).").arg(last);
}

tl::unexpected<Error> failure(ErrorCode code, const QString& sentence) {
  return pitchboard::failure(code, sentence.toStdString());
}

}  // namespace

VideoWriter::VideoWriter(QObject* parent) : QObject(parent) {
  connect(&m_process, &QProcess::bytesWritten, this, [this] {
    if (m_active && !m_ending && ready()) emit wantsPicture();
  });
  connect(&m_process, &QProcess::readyReadStandardError, this, [this] {
    m_output += m_process.readAllStandardError();
    if (m_output.size() > maxOutput) m_output = m_output.right(maxOutput);
  });
  connect(&m_process, &QProcess::finished, this, &VideoWriter::onFinished);
  connect(&m_process, &QProcess::errorOccurred, this, &VideoWriter::onError);
}

VideoWriter::~VideoWriter() {
  m_process.disconnect(this);
  cancel();
}

Result<void> VideoWriter::start(const VideoOptions& options) {
  if (m_active)
    return failure(ErrorCode::Conflict, QStringLiteral("A video is already being written."));
  const Format* format = formatOf(options.path);
  if (!format) {
    return failure(ErrorCode::InvalidArgument,
                   QStringLiteral("The name of a video must end in .mp4 or .webm."));
  }
  const QSize size(options.size.width() & ~1, options.size.height() & ~1);
  if (size.width() < smallest || size.height() < smallest || size.width() > largest ||
      size.height() > largest) {
    return failure(ErrorCode::InvalidArgument,
                   QStringLiteral("A video must be %1 to %2 pixels wide and high.")
                       .arg(smallest)
                       .arg(largest));
  }
  if (!(options.framesPerSecond >= 1.0 && options.framesPerSecond <= 240.0)) {
    return failure(ErrorCode::InvalidArgument,
                   QStringLiteral("A video must have 1 to 240 frames per second."));
  }
  auto target = FileTarget::at(options.path.toStdString(),
                               options.overwrite ? IfExists::Replace : IfExists::Refuse,
                               options.source.toStdString());
  if (!target) return tl::unexpected(target.error());
  const QString program = QStandardPaths::findExecutable(options.program);
  if (program.isEmpty()) {
    return failure(
        ErrorCode::NotFound,
        QStringLiteral("Videos are made by ffmpeg, which is not installed here. Install the "
                       "package ffmpeg and try again."));
  }
  m_options = options;
  m_size = size;
  {
    // Here the reason is known; ffmpeg would only say "Invalid argument".
    auto part = target->open();
    if (!part) return tl::unexpected(part.error());
  }
  m_target = std::move(*target);
  m_output.clear();
  m_pictures = 0;
  m_ending = false;
  m_active = true;
  // Without -xerror ffmpeg ends well when there was no room for the end of the file.
  QStringList arguments{"-hide_banner",
                        "-loglevel",
                        "error",
                        "-xerror",
                        "-y",
                        "-f",
                        "rawvideo",
                        "-pix_fmt",
                        "bgr0",
                        "-s",
                        QStringLiteral("%1x%2").arg(size.width()).arg(size.height()),
                        "-r",
                        QString::number(options.framesPerSecond, 'g', 12),
                        "-i",
                        "pipe:0",
                        "-an"};
  arguments += format->arguments;
  arguments += QStringLiteral("file:") + QString::fromStdString(m_target->partPath());
  m_process.setStandardOutputFile(QProcess::nullDevice());
  m_process.start(program, arguments);
  return {};
}

bool VideoWriter::ready() const {
  return m_active && !m_ending && m_process.bytesToWrite() < maxWaiting;
}

void VideoWriter::add(const QImage& picture) {
  if (!m_active || m_ending || picture.isNull()) return;
  QImage frame = picture.size() == m_size
                     ? picture
                     : picture.scaled(m_size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
  frame = frame.convertToFormat(QImage::Format_RGB32);
  const qint64 line = qint64{4} * m_size.width();
  for (int y = 0; y < m_size.height(); ++y) {
    m_process.write(reinterpret_cast<const char*>(frame.constScanLine(y)), line);
  }
  ++m_pictures;
}

void VideoWriter::finish() {
  if (!m_active || m_ending) return;
  m_ending = true;
  if (m_pictures == 0) {
    fail(QStringLiteral("There is nothing to show in this range. Choose another range."));
    return;
  }
  m_process.closeWriteChannel();
}

void VideoWriter::cancel() {
  if (!m_active) return;
  m_active = false;
  m_process.kill();
  m_process.waitForFinished(3000);
  m_target.reset();
}

void VideoWriter::fail(const QString& sentence) {
  cancel();
  emit failed(sentence);
}

void VideoWriter::onError(QProcess::ProcessError error) {
  if (!m_active) return;
  // The others end the process: finished() follows, with what it said.
  if (error == QProcess::FailedToStart) {
    fail(QStringLiteral("Could not start ffmpeg: %1.").arg(m_process.errorString()));
  }
}

void VideoWriter::onFinished(int exitCode, QProcess::ExitStatus status) {
  if (!m_active) return;
  m_output += m_process.readAllStandardError();
  if (status == QProcess::CrashExit) {
    fail(QStringLiteral("Could not finish the video: ffmpeg was terminated."));
    return;
  }
  if (exitCode != 0 || !m_ending) {
    fail(sentenceOf(m_output, m_options.path));
    return;
  }
  if (const auto named = m_target->commit(); !named) {
    fail(QStringLiteral("Could not rename the finished video: %1")
             .arg(QString::fromStdString(named.error().text())));
    return;
  }
  m_target.reset();
  m_active = false;
  emit finished(m_options.path);
}

}  // namespace pitchboard::ui
