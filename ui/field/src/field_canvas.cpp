// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_canvas.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include <ui/base/theme.h>

#include "field_pointer.h"

namespace pitchboard::ui {
namespace {

constexpr double minScale = 8.0;  // pixels per metre
constexpr double maxScale = 2000.0;
constexpr double zoomStep = 1.15;     // for one notch of the wheel
constexpr double notch = 120.0;       // eighths of a degree
constexpr double roundField = 1.02;   // air round a field that fits
constexpr double canvasHalf = 120.0;  // metres that can be panned over, each way

}  // namespace

FieldCanvas::FieldCanvas(FieldScene* scene, FieldPointer* pointer, QWidget* parent)
    : QGraphicsView(scene, parent), m_scene(scene), m_pointer(pointer) {
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setTransformationAnchor(QGraphicsView::NoAnchor);
  setResizeAnchor(QGraphicsView::NoAnchor);
  setRenderHint(QPainter::Antialiasing);
  setOptimizationFlag(QGraphicsView::DontSavePainterState);
  // Robots move all over the field: one rectangle round them is painted faster than a region of
  // many, by which everything would have to be clipped.
  setViewportUpdateMode(QGraphicsView::BoundingRectViewportUpdate);
  setSceneRect(-canvasHalf, -canvasHalf, 2 * canvasHalf, 2 * canvasHalf);
  // The background covers everything; filling it first is work for nothing.
  viewport()->setAutoFillBackground(false);
  viewport()->setAttribute(Qt::WA_OpaquePaintEvent);
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(QStringLiteral("Field"));
}

double FieldCanvas::fittingScale() const {
  const sim::FieldSpec& field = m_scene->style().field;
  const double width = (field.length + 2 * field.border) * roundField;
  const double height = (field.width + 2 * field.border) * roundField;
  return std::clamp(std::min(viewport()->width() / width, viewport()->height() / height), minScale,
                    maxScale);
}

void FieldCanvas::setScale(double pixelsPerMetre) {
  const double sign = m_scene->style().flipped ? -1.0 : 1.0;
  setTransform(QTransform::fromScale(sign * pixelsPerMetre, -sign * pixelsPerMetre));
  m_scene->changeStyle([&](FieldStyle& style) { style.pixelsPerMetre = pixelsPerMetre; });
}

void FieldCanvas::fit() {
  m_fitted = true;
  setScale(fittingScale());
  centerOn(0, 0);
}

void FieldCanvas::setFlipped(bool flipped) {
  const QPointF centre = metresAt(QRectF(viewport()->rect()).center());
  m_scene->changeStyle([&](FieldStyle& style) { style.flipped = flipped; });
  setScale(m_scene->style().pixelsPerMetre);
  centerOn(m_fitted ? QPointF() : centre);
}

void FieldCanvas::zoomAt(const QPointF& viewPoint, double factor) {
  const double before = m_scene->style().pixelsPerMetre;
  const double after = std::clamp(before * factor, std::min(minScale, before), maxScale);
  if (after == before) return;
  const QPointF held = metresAt(viewPoint);
  m_fitted = false;
  setScale(after);
  const QPointF middle = QRectF(viewport()->rect()).center();
  const QPointF moved = metresAt(viewPoint) - held;
  centerOn(metresAt(middle) - moved);
}

void FieldCanvas::centreOnMetres(const QPointF& metres) {
  m_fitted = false;
  centerOn(metres);
}

QPointF FieldCanvas::metresAt(const QPointF& viewPoint) const {
  return viewportTransform().inverted().map(viewPoint);
}

QPointF FieldCanvas::viewPointAt(const QPointF& metres) const {
  return viewportTransform().map(metres);
}

void FieldCanvas::drawBackground(QPainter* painter, const QRectF& exposed) {
  const QPixmap& pixmap = m_background.pixmap(m_scene->style(), viewportTransform(),
                                              viewport()->size(), devicePixelRatioF());
  const QTransform before = painter->worldTransform();
  painter->resetTransform();
  const QRectF area =
      before.mapRect(exposed).toAlignedRect().adjusted(-1, -1, 1, 1) & viewport()->rect();
  const double ratio = pixmap.devicePixelRatio();
  painter->drawPixmap(area, pixmap, QRectF(area.topLeft() * ratio, area.size() * ratio));
  painter->setWorldTransform(before);
}

void FieldCanvas::drawForeground(QPainter* painter, const QRectF&) {
  const QTransform before = painter->worldTransform();
  painter->resetTransform();
  paintEmptyState(painter);
  // On a projector there is nowhere else to be.
  if (hasFocus() && viewport()->size() != window()->size()) {
    painter->setRenderHint(QPainter::Antialiasing, false);
    painter->setPen(QPen(theme().accentLine, 1));
    painter->setBrush(Qt::NoBrush);
    painter->drawRect(viewport()->rect().adjusted(0, 0, -1, -1));
    painter->setRenderHint(QPainter::Antialiasing);
  }
  painter->setWorldTransform(before);
}

void FieldCanvas::paintEmptyState(QPainter* painter) const {
  const FramePtr& frame = m_scene->frame();
  const bool empty = frame && frame->robots.empty();
  if (frame && !empty) return;
  QString text = m_emptyText ? m_emptyText() : QString();
  if (text.isEmpty()) {
    text = QStringLiteral("Right-click to add a robot or to place the ball.");
  }
  const bool longer = text.contains(QLatin1Char('\n'));
  const QFont& font = fieldFont(scaled(this, longer ? 12 : 13), !longer);
  painter->setFont(font);
  const QRectF area(viewport()->rect());
  const double side = std::max(30.0, longer ? (area.width() - scaled(this, 460)) / 2 : 30.0);
  constexpr int wrapped = Qt::AlignCenter | Qt::TextWordWrap;
  QRectF box = QFontMetricsF(font)
                   .boundingRect(area.adjusted(side, 0, -side, 0), wrapped, text)
                   .adjusted(-14, -8, 14, 8);
  box.moveCenter({area.center().x(), area.top() + area.height() * 0.36});
  painter->setPen(QPen(theme().innerLine, 1));
  painter->setBrush(theme().window);
  painter->drawRoundedRect(box, 3, 3);
  painter->setPen(theme().text);
  painter->drawText(box.adjusted(14, 8, -14, -8), wrapped, text);
}

// Not all that is seen moves with the scene: the frame round the field, what is said when it is
// empty. Pixels that are shifted instead of painted would leave traces of them behind.
void FieldCanvas::scrollContentsBy(int dx, int dy) {
  QGraphicsView::scrollContentsBy(dx, dy);
  viewport()->update();
}

void FieldCanvas::resizeEvent(QResizeEvent* event) {
  QGraphicsView::resizeEvent(event);
  if (m_fitted) fit();
}

void FieldCanvas::changeEvent(QEvent* event) {
  QGraphicsView::changeEvent(event);
  if (event->type() == QEvent::PaletteChange || event->type() == QEvent::StyleChange) {
    m_background.invalidate();
    viewport()->update();
  }
}

void FieldCanvas::pan(const QPointF& to) {
  const QPointF moved = metresAt(m_panFrom) - metresAt(to);
  m_panFrom = to;
  m_fitted = false;
  centerOn(metresAt(QRectF(viewport()->rect()).center()) + moved);
}

void FieldCanvas::updateCursorShape() {
  if (m_panning) {
    viewport()->setCursor(Qt::ClosedHandCursor);
  } else if (m_panHeld) {
    viewport()->setCursor(Qt::OpenHandCursor);
  } else {
    viewport()->setCursor(m_pointer->shape(m_cursor));
  }
}

void FieldCanvas::mousePressEvent(QMouseEvent* event) {
  m_cursor = metresAt(event->position());
  if (event->button() == Qt::MiddleButton || (event->button() == Qt::LeftButton && m_panHeld)) {
    m_panning = true;
    m_panUsed = true;
    m_panFrom = event->position();
    updateCursorShape();
  } else if (event->button() == Qt::LeftButton) {
    m_pointer->press(m_cursor, event->modifiers());
  }
}

void FieldCanvas::mouseMoveEvent(QMouseEvent* event) {
  m_cursor = metresAt(event->position());
  emit cursorMoved(m_cursor, true);
  if (m_panning) {
    pan(event->position());
  } else {
    m_pointer->move(m_cursor, event->modifiers());
  }
  updateCursorShape();
}

void FieldCanvas::mouseReleaseEvent(QMouseEvent* event) {
  if (m_panning && (event->button() == Qt::MiddleButton || event->button() == Qt::LeftButton)) {
    m_panning = false;
  } else if (event->button() == Qt::LeftButton) {
    m_pointer->release(metresAt(event->position()), event->modifiers());
  }
  updateCursorShape();
}

void FieldCanvas::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) m_pointer->doubleClick(metresAt(event->position()));
}

void FieldCanvas::wheelEvent(QWheelEvent* event) {
  const double notches = event->angleDelta().y() / notch;
  if (notches == 0.0) return;
  event->accept();
  if (m_pointer->turnAt(metresAt(event->position()), notches)) return;
  zoomAt(event->position(), std::pow(zoomStep, notches));
}

void FieldCanvas::contextMenuEvent(QContextMenuEvent* event) {
  const bool byKey = event->reason() == QContextMenuEvent::Keyboard;
  emit menuRequested(event->globalPos(), byKey ? m_cursor : metresAt(QPointF(event->pos())));
}

bool FieldCanvas::viewportEvent(QEvent* event) {
  if (event->type() == QEvent::Leave) emit cursorMoved(m_cursor, false);
  if (event->type() == QEvent::ToolTip && m_hoverText) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const QString text = m_hoverText(metresAt(QPointF(help->pos())));
    if (text.isEmpty()) {
      QToolTip::hideText();
    } else {
      QToolTip::showText(help->globalPos(), text, viewport());
    }
    return true;
  }
  return QGraphicsView::viewportEvent(event);
}

// A view scrolls with keys; this one leaves them to the window.
void FieldCanvas::keyPressEvent(QKeyEvent* event) {
  event->ignore();
}

bool FieldCanvas::setPanHeld(bool held) {
  const bool used = m_panUsed;
  m_panHeld = held;
  m_panUsed = false;
  updateCursorShape();
  return used;
}

void FieldCanvas::focusInEvent(QFocusEvent* event) {
  QGraphicsView::focusInEvent(event);
  viewport()->update();
}

void FieldCanvas::focusOutEvent(QFocusEvent* event) {
  QGraphicsView::focusOutEvent(event);
  viewport()->update();
}

}  // namespace pitchboard::ui
