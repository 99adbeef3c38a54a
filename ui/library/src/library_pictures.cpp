// SPDX-License-Identifier: GPL-3.0-or-later
#include "library_pictures.h"

#include <QDir>
#include <QFile>
#include <algorithm>

#include <base/file_target.h>
#include <robotlink/session/recorded_frame.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

// Pixels. Robots have a least size when they are painted, so that they can still be seen.
constexpr int paintedWidth = 260, keptWidth = 160;
constexpr int maxPixmaps = 1000;        // in memory, 64 kB each
constexpr std::size_t maxWaiting = 60;  // as many as a large window shows

/// The moment of the picture; null if the session cannot be read.
FramePtr tellingFrame(const link::IndexedSession& of) {
  const auto session = telemetry::SessionReader::open(of.path);
  if (!session || !session->range()) return nullptr;
  link::RecordedFrames frames(link::backdropOf(*session));
  return std::make_shared<link::MatchFrame>(frames.frameAt(*session, of.overview.telling));
}

/// The playing field and a part of the border: what is written there cannot be read so small.
QRect cropOf(const sim::FieldSpec& field, QSize size) {
  const double scale = std::min(size.width() / (field.length + 2 * field.border),
                                size.height() / (field.width + 2 * field.border));
  const double margin = 0.3 * field.border;
  const QSizeF part((field.length + 2 * margin) * scale, (field.width + 2 * margin) * scale);
  return QRectF(QPointF((size.width() - part.width()) / 2, (size.height() - part.height()) / 2),
                part)
      .toRect();
}

}  // namespace

LibraryPictures::LibraryPictures(QString folder, const FieldPictures* pictures, QObject* parent)
    : QObject(parent), m_folder(std::move(folder)), m_pictures(pictures), m_cache(maxPixmaps) {}

LibraryPictures::~LibraryPictures() {
  m_worker.waitForDone();
}

QPixmap LibraryPictures::pictureOf(const LibraryRowPtr& row) {
  if (!row->session.overview.isReadable) return {};
  const QString name = pictureName(row->session, isDarkTheme());
  if (const QPixmap* known = m_cache.object(name)) return *known;
  if (m_requested.contains(name)) return {};
  m_requested.insert(name);
  m_wanted.push_back({row, name});
  if (m_wanted.size() > maxWaiting) {
    m_requested.remove(m_wanted.front().name);
    m_wanted.pop_front();
  }
  next();
  return {};
}

void LibraryPictures::changeTheme() {
  m_painter.reset();
}

void LibraryPictures::next() {
  if (m_isWorking || m_wanted.empty()) return;
  const Request request = m_wanted.back();
  m_wanted.pop_back();
  m_isWorking = true;
  m_worker.start([this, request, file = m_folder + QLatin1Char('/') + request.name] {
    QImage kept;
    const FramePtr frame = kept.load(file) ? nullptr : tellingFrame(request.row->session);
    m_ui.post([this, request, kept, frame] {
      if (frame) {
        paint(request, frame);
      } else {
        show(request, kept);
      }
      m_isWorking = false;
      next();
    });
  });
}

void LibraryPictures::paint(const Request& request, const FramePtr& frame) {
  if (!m_painter) m_painter = m_pictures->framePainter();
  const sim::FieldSpec& field = frame->settings->field;
  const double shape = (field.width + 2 * field.border) / (field.length + 2 * field.border);
  const QSize size(paintedWidth, std::clamp(static_cast<int>(paintedWidth * shape), 2, 2000));
  const QImage picture = m_painter->paint(frame, size)
                             .copy(cropOf(field, size))
                             .scaledToWidth(keptWidth, Qt::SmoothTransformation);
  show(request, picture);
  m_worker.start([folder = m_folder, name = request.name, picture] {
    const QByteArray bytes = pictureBytes(picture);
    if (bytes.isEmpty() || !QDir().mkpath(folder)) return;
    // One that could not be kept is made again.
    (void)writeFile((folder + QLatin1Char('/') + name).toStdString(),
                    {bytes.constData(), static_cast<std::size_t>(bytes.size())}, IfExists::Replace);
  });
}

void LibraryPictures::show(const Request& request, const QImage& picture) {
  m_requested.remove(request.name);
  m_cache.insert(request.name, new QPixmap(QPixmap::fromImage(picture)));
  emit came(request.row);
}

}  // namespace pitchboard::ui
