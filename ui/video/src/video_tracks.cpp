// SPDX-License-Identifier: GPL-3.0-or-later
#include "video_tracks.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

#include <ui/base/quick_painting.h>
#include <ui/base/theme.h>
#include <ui/sources/shown_moment.h>

namespace pitchboard::ui {
namespace {

constexpr int rowHeight = 16, margin = 4;        // px of the mock
constexpr double narrowestBar = 6.0;             // px of the mock, for a hand
constexpr double narrowest = 0.5, widest = 1e6;  // s that the axis shows

}  // namespace

VideoTracks::VideoTracks(ShownMoment* shown, QWidget* parent) : QWidget(parent), m_shown(shown) {
  setObjectName(QStringLiteral("videoTracks"));
  setAccessibleName(QStringLiteral("Videos along the time of the session"));
  setToolTip(
      QStringLiteral("Drag the bar of a video to align it with the session. The wheel zooms, "
                     "a double click shows everything"));
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  connect(shown, &ShownMoment::moved, this, &VideoTracks::refresh);
  connect(shown, &ShownMoment::newestChanged, this, &VideoTracks::refresh);
  hide();
}

void VideoTracks::setCameras(std::vector<VideoCamera*> cameras) {
  if (cameras == m_cameras) return;
  m_drag.reset();
  for (VideoCamera* camera : m_cameras) camera->disconnect(this);
  m_cameras = std::move(cameras);
  for (VideoCamera* camera : m_cameras) {
    connect(camera, &VideoCamera::alignmentChanged, this, &VideoTracks::refresh);
  }
  m_showsAll = true;
  setVisible(!m_cameras.empty());
  updateGeometry();
  refresh();
}

QSize VideoTracks::sizeHint() const {
  return {scaled(this, 320),
          scaled(this, rowHeight) * static_cast<int>(m_cameras.size()) + 2 * scaled(this, margin)};
}

QSize VideoTracks::minimumSizeHint() const {
  return {scaled(this, 120), sizeHint().height()};
}

/// The axis stands still below a bar that is dragged.
void VideoTracks::refresh() {
  const double side = scaled(this, 2 * margin);
  m_axis.left = side;
  m_axis.width = std::max(width() - 2 * side, 1.0);
  if (m_showsAll && !m_drag) {
    const auto session = m_shown->available();
    telemetry::TimeRange all = session.value_or(telemetry::TimeRange{0.0, narrowest});
    for (const VideoCamera* camera : m_cameras) {
      const telemetry::VideoAlignment& alignment = camera->alignment();
      all.begin = std::min(all.begin, alignment.sessionTime(0.0));
      all.end = std::max(all.end, alignment.sessionTime(camera->info()->duration));
    }
    // Room to drag to, on both sides.
    const double room = std::max(0.05 * (all.end - all.begin), narrowest / 2);
    m_axis.shown = {all.begin - room, all.end + room};
  }
  update();
}

QRectF VideoTracks::rowRect(std::size_t row) const {
  const int high = scaled(this, rowHeight);
  return QRectF(m_axis.left, scaled(this, margin) + static_cast<int>(row) * high, m_axis.width,
                high);
}

QRectF VideoTracks::barOf(std::size_t row, const telemetry::VideoAlignment& alignment) const {
  const QRectF place = rowRect(row).adjusted(0, 1, 0, -1);
  const double from = m_axis.pixel(alignment.sessionTime(0.0));
  const double until = m_axis.pixel(alignment.sessionTime(m_cameras[row]->info()->duration));
  QRectF bar(from, place.top(), std::max(until - from, double(scaled(this, narrowestBar))),
             place.height());
  return bar.intersected(place.adjusted(-1, 0, 1, 0));
}

QRectF VideoTracks::barRect(std::size_t row) const {
  return row < m_cameras.size() ? barOf(row, m_cameras[row]->alignment()) : QRectF();
}

std::optional<std::size_t> VideoTracks::barAt(const QPointF& at) const {
  for (std::size_t row = 0; row < m_cameras.size(); ++row) {
    if (barRect(row).contains(at)) return row;
  }
  return {};
}

QString VideoTracks::moveText() const {
  if (!m_drag || !m_drag->hasMoved) return {};
  const double begin = m_cameras[m_drag->row]->alignment().offset;
  const double by = begin - m_drag->alignment.offset;
  constexpr double hundredths = 100.0;  // a moment is cut off, a way is rounded
  return QStringLiteral("%1%2 s, starts at %3")
      .arg(by < 0.0 ? QChar(0x2212) : QLatin1Char('+'))
      .arg(std::abs(by), 0, 'f', 2)
      .arg(momentText(std::round(begin * hundredths) / hundredths, 2));
}

bool VideoTracks::cancel() {
  if (!m_drag) return false;
  const Drag given = *std::exchange(m_drag, std::nullopt);
  if (given.hasMoved) (void)m_cameras[given.row]->setAnchors(given.before);
  refresh();
  return true;
}

void VideoTracks::resizeEvent(QResizeEvent* /*event*/) {
  refresh();
}

void VideoTracks::mousePressEvent(QMouseEvent* event) {
  const auto row = event->button() == Qt::LeftButton ? barAt(event->position()) : std::nullopt;
  if (!row) return;
  VideoCamera* camera = m_cameras[*row];
  emit pressed(camera);
  m_drag = Drag{*row, event->position().x(), camera->kept().anchors, camera->alignment(), false};
}

void VideoTracks::mouseMoveEvent(QMouseEvent* event) {
  if (!m_drag) {
    setCursor(barAt(event->position()) ? Qt::SizeHorCursor : Qt::ArrowCursor);
    return;
  }
  const double by = event->position().x() - m_drag->pressedAt;
  constexpr double still = 3.0;  // px; a trembling hand is not a drag
  if (!m_drag->hasMoved && std::abs(by) < still) return;
  m_drag->hasMoved = true;
  VideoCamera* camera = m_cameras[m_drag->row];
  // Moments that are moved by the same time do not contradict each other.
  (void)camera->setAnchors(
      camera->anchorsFrom(m_drag->alignment.offset + by * m_axis.secondsPerPixel()));
}

void VideoTracks::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !m_drag) return;
  const Drag done = *std::exchange(m_drag, std::nullopt);
  if (done.hasMoved) emit dragged(m_cameras[done.row], done.before);
  refresh();
}

void VideoTracks::mouseDoubleClickEvent(QMouseEvent* /*event*/) {
  m_showsAll = true;
  refresh();
}

void VideoTracks::wheelEvent(QWheelEvent* event) {
  event->accept();
  if (m_drag) return;
  constexpr double perNotch = 1.2;
  const double factor = std::pow(perNotch, -event->angleDelta().y() / 120.0);
  const double anchor = m_axis.time(event->position().x());
  const double span = (m_axis.shown.end - m_axis.shown.begin) * factor;
  if (span < narrowest || span > widest) return;
  m_showsAll = false;
  m_axis.shown = {anchor - (anchor - m_axis.shown.begin) * factor,
                  anchor + (m_axis.shown.end - anchor) * factor};
  update();
}

void VideoTracks::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF ground = rowRect(0).united(rowRect(m_cameras.empty() ? 0 : m_cameras.size() - 1));
  // What the session has.
  if (const auto session = m_shown->available()) {
    const double from = std::clamp(m_axis.pixel(session->begin), ground.left(), ground.right());
    const double until = std::clamp(m_axis.pixel(session->end), ground.left(), ground.right());
    drawRoundBox(painter, QRectF(from, ground.top(), until - from, ground.height()), 2,
                 theme().view, theme().innerLine);
  }
  for (std::size_t row = 0; row < m_cameras.size(); ++row) paintBar(painter, row);
  const double moment = m_axis.pixel(m_shown->time());
  if (moment < ground.left() || moment > ground.right()) return;
  painter.setPen(QPen(theme().accentLine, 2.0));
  painter.drawLine(QPointF(moment, 0), QPointF(moment, height()));
}

void VideoTracks::paintBar(QPainter& painter, std::size_t row) const {
  const QRectF place = rowRect(row), bar = barRect(row);
  const bool isDragged = m_drag && m_drag->row == row && m_drag->hasMoved;
  if (isDragged) {
    // Where it was.
    painter.setPen(QPen(theme().secondaryText, 1.0, Qt::DashLine));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(barOf(row, m_drag->alignment).adjusted(0.5, 0.5, -0.5, -0.5), 2, 2);
  }
  QColor ground = theme().accentFill;
  ground.setAlphaF(isDarkTheme() ? 0.65F : 0.35F);  // as the plots' window in the timeline
  if (!bar.isEmpty()) drawRoundBox(painter, bar, 2, ground, theme().accentLine);
  painter.setFont(themeFont(TypeRole::Small));
  painter.setPen(theme().text);
  const QString text = isDragged ? moveText() : m_cameras[row]->name();
  const double pad = scaled(this, 5), wide = textLineWidth(painter.font(), text) + 2 * pad;
  QRectF room = bar;
  // Beside a bar that is too short for it, where there is room.
  if (wide > bar.width()) {
    const bool isRight = place.right() - bar.right() >= bar.left() - place.left();
    room = isRight ? QRectF(bar.right(), bar.top(), place.right() - bar.right(), bar.height())
                   : QRectF(place.left(), bar.top(), bar.left() - place.left(), bar.height());
    drawTextLine(painter, room.adjusted(pad, 0, -pad, 0),
                 (isRight ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter, text,
                 Qt::ElideMiddle);
    return;
  }
  drawTextLine(painter, room.adjusted(pad, 0, -pad, 0), Qt::AlignLeft | Qt::AlignVCenter, text,
               Qt::ElideMiddle);
}

}  // namespace pitchboard::ui
