// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/session/video_export.h>

#include <algorithm>
#include <cmath>

#include <robotlink/session/recorded_frame.h>

#include "film_layout.h"

namespace pitchboard::ui {

struct VideoExport::Reader {
  QString path;
  std::vector<std::string> robots;
  std::optional<telemetry::SessionReader> session;
  std::optional<link::RecordedFrames> frames;
  std::string problem;
  std::atomic<bool> cancelled = false;

  FramePtr frameAt(double time) {
    if (!session) {
      auto opened = telemetry::SessionReader::open(path.toStdString());
      if (!opened) {
        problem = opened.error().text();
        return nullptr;
      }
      const auto chosen = link::RobotChoice::of(*opened, robots);
      if (!chosen) {
        problem = chosen.error().text();
        return nullptr;
      }
      session.emplace(std::move(*opened));
      frames.emplace(link::backdropOf(*session), *chosen);
    }
    return std::make_shared<link::MatchFrame>(frames->frameAt(*session, time));
  }
};

VideoExport::VideoExport(std::unique_ptr<FramePainter> painter, QObject* parent)
    : QObject(parent), m_painter(std::move(painter)) {
  connect(&m_writer, &VideoWriter::wantsPicture, this, &VideoExport::next);
  connect(&m_writer, &VideoWriter::finished, this, [this](const QString& path) {
    m_reader.reset();
    emit finished(path);
  });
  connect(&m_writer, &VideoWriter::failed, this, [this](const QString& sentence) {
    m_reader.reset();
    ++m_job;
    emit failed(sentence);
  });
}

VideoExport::~VideoExport() {
  cancel();
  m_worker.waitForDone();
}

Result<void> VideoExport::start(const QString& session, telemetry::TimeRange range,
                                const std::vector<std::string>& robots, const VideoOptions& options,
                                FilmParts parts) {
  if (!(range.end >= range.begin) || !std::isfinite(range.end - range.begin)) {
    return tl::unexpected(Error{ErrorCode::InvalidArgument, "the range ends before it begins", {}});
  }
  VideoOptions own = options;
  own.source = session;
  if (auto started = m_writer.start(own); !started) return started;
  m_reader = std::make_shared<Reader>();
  m_reader->path = session;
  m_reader->robots = robots;
  m_range = range;
  m_rate = options.framesPerSecond;
  m_pictures = static_cast<qint64>((range.end - range.begin) * m_rate) + 1;
  m_drawn = 0;
  m_reading = false;
  m_moment.reset();
  m_parts = std::move(parts);
  ++m_job;
  read();
  return {};
}

void VideoExport::cancel() {
  ++m_job;
  if (m_reader) m_reader->cancelled = true;
  m_reader.reset();
  m_moment.reset();
  m_writer.cancel();
}

void VideoExport::read() {
  if (m_reading || m_moment || !m_reader) return;
  const qint64 number = m_drawn;
  if (number >= m_pictures) return;
  m_reading = true;
  const double time = m_range.begin + static_cast<double>(number) / m_rate;
  m_worker.start([this, reader = m_reader, time, job = m_job, cameras = m_parts.cameras,
                  rooms = filmLayout(m_writer.size(), m_parts.cameras.size(),
                                     !m_parts.curves.picture.isNull())
                              .cameras] {
    Moment moment{reader->frameAt(time), {}, time};
    for (std::size_t i = 0; moment.frame && i < cameras.size(); ++i) {
      moment.cameras.push_back(
          cameras[i].picture(time, rooms[i].size(), [&reader] { return !reader->cancelled; }));
    }
    m_toUi.post([this, moment = std::move(moment), job, problem = reader->problem] {
      if (job != m_job) return;
      m_reading = false;
      if (!moment.frame) {
        cancel();
        emit failed(
            QStringLiteral("Could not read the session: %1").arg(QString::fromStdString(problem)));
        return;
      }
      m_moment = moment;
      next();
    });
  });
}

void VideoExport::next() {
  if (!m_reader || !m_moment || !m_writer.ready()) return;
  const Moment moment = *std::exchange(m_moment, std::nullopt);
  ++m_drawn;
  // The next moment is read while this one is drawn.
  read();
  draw(moment);
  if (m_drawn >= m_pictures) m_writer.finish();
}

void VideoExport::draw(const Moment& moment) {
  const QSize size = m_writer.size();
  if (m_parts.isEmpty()) {
    m_writer.add(m_painter->paint(moment.frame, size));
  } else {
    const FilmLayout layout =
        filmLayout(size, m_parts.cameras.size(), !m_parts.curves.picture.isNull());
    const QImage field = m_painter->paint(moment.frame, layout.field.size());
    m_writer.add(paintFilm(size, m_parts, field, moment.cameras, *moment.frame, moment.time));
  }
  emit progressed(static_cast<double>(m_drawn) / static_cast<double>(m_pictures));
}

}  // namespace pitchboard::ui
