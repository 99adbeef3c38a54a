// SPDX-License-Identifier: GPL-3.0-or-later
#include "video_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

#include <ui/base/field_ground.h>
#include <ui/base/theme.h>
#include <ui/base/time_axis.h>

#include "video_camera.h"

namespace pitchboard::ui {

VideoView::VideoView(VideoCamera* camera, QWidget* parent) : QWidget(parent), m_camera(camera) {
  setObjectName(QStringLiteral("videoView"));
  setAccessibleName(QStringLiteral("Video ") + camera->name());
  setMinimumSize(scaled(this, 120), scaled(this, 70));
  setMouseTracking(true);
  for (const auto signal : {&VideoCamera::opened, &VideoCamera::failed,
                            &VideoCamera::openingChanged, &VideoCamera::pictureChanged,
                            &VideoCamera::alignmentChanged, &VideoCamera::landmarksChanged}) {
    connect(camera, signal, this, qOverload<>(&QWidget::update));
  }
}

QSize VideoView::sizeHint() const {
  return {scaled(this, 320), scaled(this, 180)};
}

QSize VideoView::room() const {
  return (QSizeF(size()) * devicePixelRatioF()).toSize();
}

QRectF VideoView::pictureRect() const {
  const telemetry::VideoInfo* info = m_camera->info();
  if (info == nullptr) return {};
  const QSizeF fitted =
      QSizeF(info->width, info->height).scaled(QSizeF(size()), Qt::KeepAspectRatio);
  return {QPointF((width() - fitted.width()) / 2, (height() - fitted.height()) / 2), fitted};
}

void VideoView::setFrame(FramePtr frame) {
  m_frame = std::move(frame);
  if (m_overlay) update();
}

void VideoView::setOverlay(bool on) {
  m_overlay = on;
  update();
}

void VideoView::setCurrent(bool on, bool isOneOfSeveral) {
  m_current = on;
  m_several = isOneOfSeveral;
  update();
}

void VideoView::setPlacing(bool on, std::optional<Point> next) {
  m_placing = on;
  m_next = next;
  setCursor(next ? Qt::CrossCursor : Qt::ArrowCursor);
  update();
}

Point VideoView::inPicture(const QPointF& pixel) const {
  const QRectF rect = pictureRect();
  return {std::clamp((pixel.x() - rect.left()) / rect.width(), 0.0, 1.0),
          std::clamp((pixel.y() - rect.top()) / rect.height(), 0.0, 1.0)};
}

QPointF VideoView::onScreen(const Point& picture) const {
  const QRectF rect = pictureRect();
  return {rect.left() + picture.x * rect.width(), rect.top() + picture.y * rect.height()};
}

std::optional<std::size_t> VideoView::landmarkAt(const QPointF& pixel) const {
  const auto& landmarks = m_camera->kept().landmarks;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const QPointF off = onScreen(landmarks[i].picture) - pixel;
    if (std::hypot(off.x(), off.y()) < scaled(this, 9)) return i;
  }
  return {};
}

void VideoView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  emit resized();
}

void VideoView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  emit pressed();
  if (!m_placing || m_camera->info() == nullptr) return;
  m_dragged = landmarkAt(event->position());
  if (!m_dragged && m_next && pictureRect().contains(event->position())) {
    emit placed(inPicture(event->position()));
  }
}

void VideoView::mouseMoveEvent(QMouseEvent* event) {
  if (!m_placing) return;
  if (!m_dragged) {
    const bool isPoint = landmarkAt(event->position()).has_value();
    setCursor(isPoint ? Qt::OpenHandCursor : m_next ? Qt::CrossCursor : Qt::ArrowCursor);
    const bool onTheLeft = event->position().x() > width() / 2.0;
    if (std::exchange(m_mapOnTheLeft, onTheLeft) != onTheLeft) update();
    return;
  }
  auto landmarks = m_camera->kept().landmarks;
  landmarks[*m_dragged].picture = inPicture(event->position());
  m_camera->setLandmarks(std::move(landmarks));
}

void VideoView::mouseReleaseEvent(QMouseEvent* /*event*/) {
  m_dragged.reset();
}

void VideoView::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.fillRect(rect(), Qt::black);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  const QString problem = remark();
  if (problem.isEmpty() && !m_camera->picture().isNull()) {
    painter.drawImage(pictureRect(), m_camera->picture());
    if (m_overlay) paintField(painter);
    if (m_placing) {
      paintPoints(painter);
      if (m_next) paintMap(painter);
    }
  } else {
    painter.setPen(QColor(0xc8, 0xcc, 0xd0));
    const int margin = scaled(this, 12);
    painter.drawText(rect().adjusted(margin, margin, -margin, -margin),
                     static_cast<int>(Qt::AlignCenter) | Qt::TextWordWrap, problem);
  }
  paintCaption(painter);
  if (m_current && m_several) {
    painter.setPen(QPen(theme().accentLine, 2.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(QRectF(rect()).adjusted(1, 1, -1, -1));
  }
}

/// Why there is no picture of the moment that is shown.
QString VideoView::remark() const {
  if (!m_camera->problem().isEmpty()) return m_camera->problem();
  const telemetry::VideoInfo* info = m_camera->info();
  if (info == nullptr) {
    return QStringLiteral("Reading the video… %1 %").arg(qRound(m_camera->opening() * 100));
  }
  if (m_camera->isCovered()) return {};
  const telemetry::VideoAlignment& alignment = m_camera->alignment();
  return QStringLiteral("This camera recorded from %1 to %2.")
      .arg(momentText(alignment.sessionTime(0.0), 1),
           momentText(alignment.sessionTime(info->duration), 1));
}

void VideoView::paintField(QPainter& painter) {
  if (!m_frame) return;
  const auto ground = groundToPicture(m_camera->kept().landmarks);
  const QRectF rect = pictureRect();
  if (!ground) {
    if (m_placing || !m_current) return;
    painter.setFont(themeFont(TypeRole::Secondary));
    painter.setPen(Qt::white);
    painter.drawText(rect.adjusted(8, 8, -8, -8), QStringLiteral("Place four points (Points…)"));
    return;
  }
  paintOverlay(painter, *ground, rect, *m_frame);
}

void VideoView::paintPoints(QPainter& painter) {
  painter.setRenderHint(QPainter::Antialiasing);
  for (const telemetry::VideoLandmark& mark : m_camera->kept().landmarks) {
    const QPointF at = onScreen(mark.picture);
    const double radius = scaled(this, 6);
    for (const QPen& pen : {QPen(QColor(0, 0, 0, 200), 4.0), QPen(theme().accentLine, 2.0)}) {
      painter.setPen(pen);
      painter.setBrush(Qt::NoBrush);
      painter.drawEllipse(at, radius, radius);
      painter.drawPoint(at);
    }
  }
}

/// Which point of the field is meant.
void VideoView::paintMap(QPainter& painter) {
  const sim::FieldSpec field = m_frame ? m_frame->settings->field : sim::FieldSpec();
  const double across = field.length + 2 * field.border, high = field.width + 2 * field.border;
  const double scale = std::min(scaled(this, 130), width() / 3) / across;
  const double margin = scaled(this, 6);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const double middle = margin + across * scale / 2;
  painter.translate(m_mapOnTheLeft ? middle : width() - middle, margin + high * scale / 2);
  painter.scale(scale, -scale);
  painter.setClipRect(QRectF(-across / 2, -high / 2, across, high));
  paintGround(painter, field, std::max(field.lineWidth, 1.2 / scale));
  painter.setPen(QPen(Qt::white, 1.5 / scale));
  painter.setBrush(theme().accentFill);
  const double radius = scaled(this, 5) / scale;
  painter.drawEllipse(QPointF(m_next->x, m_next->y), radius, radius);
  painter.restore();
}

void VideoView::paintCaption(QPainter& painter) {
  QString right;
  const auto times = m_camera->times();
  if (m_camera->isCovered() && m_camera->shown() && *m_camera->shown() < times.size()) {
    right = QStringLiteral("%1 · picture %2")
                .arg(momentText(times[*m_camera->shown()], 3))
                .arg(*m_camera->shown() + 1);
  }
  painter.setFont(themeFont(TypeRole::Secondary));
  const QFontMetricsF metrics(painter.font());
  const double gap = scaled(this, 6);
  const double high = metrics.height() + gap / 2;
  const QRectF strip(0, height() - high, width(), high);
  painter.fillRect(strip, QColor(0, 0, 0, 150));
  painter.setPen(Qt::white);
  const QRectF inner = strip.adjusted(gap, 0, -gap, 0);
  painter.drawText(inner, Qt::AlignRight | Qt::AlignVCenter, right);
  const double left = inner.width() - metrics.horizontalAdvance(right) - gap;
  painter.drawText(inner, Qt::AlignLeft | Qt::AlignVCenter,
                   metrics.elidedText(m_camera->name(), Qt::ElideMiddle, std::max(left, 0.0)));
}

}  // namespace pitchboard::ui
