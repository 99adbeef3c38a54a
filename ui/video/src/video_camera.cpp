// SPDX-License-Identifier: GPL-3.0-or-later
#include "video_camera.h"

#include <QFileInfo>
#include <utility>

namespace pitchboard::ui {

QImage imageOf(telemetry::VideoPicture picture) {
  auto* pixels = new std::vector<std::uint32_t>(std::move(picture.pixels));
  return QImage(
      reinterpret_cast<const uchar*>(pixels->data()), picture.width, picture.height,
      picture.width * static_cast<int>(sizeof(std::uint32_t)), QImage::Format_RGB32,
      [](void* all) { delete static_cast<std::vector<std::uint32_t>*>(all); }, pixels);
}

VideoCamera::VideoCamera(telemetry::SessionVideo kept, QObject* parent)
    : QObject(parent), m_kept(std::move(kept)) {
  if (const auto alignment = telemetry::alignmentOf(m_kept.anchors)) m_alignment = *alignment;
  m_worker.start([this, path = m_kept.path] {
    int shownPercent = 0;
    const auto progress = [&](double part) {
      const int percent = static_cast<int>(part * 100.0);
      if (std::exchange(shownPercent, percent) != percent) {
        m_toUi.post([this, part] {
          m_opening = part;
          emit openingChanged();
        });
      }
      return !m_cancelled;
    };
    auto opened =
        std::make_shared<Result<telemetry::VideoFile>>(telemetry::VideoFile::open(path, progress));
    m_toUi.post([this, opened] {
      if (*opened) {
        m_file = std::make_shared<telemetry::VideoFile>(std::move(**opened));
        emit this->opened();
        return;
      }
      m_problem = QString::fromStdString(opened->error().message);
      emit failed();
    });
  });
}

VideoCamera::~VideoCamera() {
  m_cancelled = true;
  m_worker.waitForDone();
}

QString VideoCamera::name() const {
  return QFileInfo(QString::fromStdString(m_kept.path)).fileName();
}

std::span<const double> VideoCamera::times() const {
  return m_file ? m_file->times() : std::span<const double>();
}

Result<void> VideoCamera::setAnchors(std::vector<telemetry::VideoAnchor> anchors) {
  const auto alignment = telemetry::alignmentOf(anchors);
  if (!alignment) return tl::unexpected(alignment.error());
  m_kept.anchors = std::move(anchors);
  m_alignment = *alignment;
  emit alignmentChanged();
  return {};
}

std::vector<telemetry::VideoAnchor> VideoCamera::anchorsFrom(double begin) const {
  auto anchors = m_kept.anchors;
  if (anchors.empty()) anchors.emplace_back();
  const double by = begin - m_alignment.offset;
  for (telemetry::VideoAnchor& anchor : anchors) anchor.session += by;
  return anchors;
}

void VideoCamera::setLandmarks(std::vector<telemetry::VideoLandmark> landmarks) {
  m_kept.landmarks = std::move(landmarks);
  emit landmarksChanged();
}

void VideoCamera::show(double time, QSize room) {
  if (!m_file) return;
  const bool isCovered = time >= 0.0 && time < m_file->info().duration;
  if (std::exchange(m_isCovered, isCovered) != isCovered) emit pictureChanged();
  showIndex(m_file->indexAt(time), room);
}

void VideoCamera::showIndex(std::size_t index, QSize room) {
  if (!m_file || room.isEmpty()) return;
  m_wanted = std::min(index, m_file->times().size() - 1);
  m_room = room;
  decode();
}

void VideoCamera::decode() {
  if (m_isDecoding || (m_shown == m_wanted && m_decodedRoom == m_room)) return;
  m_isDecoding = true;
  m_decodedRoom = m_room;
  m_worker.start([this, file = m_file, index = m_wanted, room = m_room] {
    auto result = std::make_shared<Result<telemetry::VideoPicture>>(
        file->picture(index, room.width(), room.height(), [this](double) { return !m_cancelled; }));
    m_toUi.post([this, index, result] { take(index, *result); });
  });
}

void VideoCamera::take(std::size_t index, const Result<telemetry::VideoPicture>& result) {
  m_isDecoding = false;
  // Also of one that the file has lost, so that it is not asked for again.
  m_shown = index;
  if (result) {
    m_problem.clear();
    m_picture = imageOf(*result);
  } else {
    m_problem = QString::fromStdString(result.error().message);
  }
  emit pictureChanged();
  decode();
}

}  // namespace pitchboard::ui
