// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/sources/note_layer.h>

#include <QContextMenuEvent>
#include <QMenu>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include <ui/base/theme.h>
#include <ui/sources/note_board.h>
#include <ui/sources/note_painting.h>
#include <ui/sources/shown_moment.h>

#include "note_editor.h"

namespace pitchboard::ui {

using telemetry::DrawnNote;
using telemetry::NotePlace;
using telemetry::NoteShape;

namespace {

constexpr double gripReach = 8.0, shortestDrag = 6.0;  // px of the mock
constexpr double otherMoment = 0.6;                    // strength

QPointF pixelOf(const Point& point, const QTransform& toPixels) {
  return toPixels.map(QPointF(point.x, point.y));
}

Point pointAt(const QPointF& pixel, const QTransform& toPixels) {
  const QPointF at = toPixels.inverted().map(pixel);
  return {at.x(), at.y()};
}

double distanceOf(const QPointF& a, const QPointF& b) {
  return std::hypot(a.x() - b.x(), a.y() - b.y());
}

}  // namespace

NoteLayer::NoteLayer(NoteBoard* board, NoteGround ground, QWidget* surface, QWidget* parent)
    : QWidget(parent), m_board(board), m_ground(std::move(ground)), m_surface(surface) {
  setObjectName(QStringLiteral("noteLayer"));
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setFocusPolicy(Qt::NoFocus);
  surface->installEventFilter(this);
  connect(board, &NoteBoard::changed, this, &NoteLayer::refresh);
  connect(board, &NoteBoard::toolChanged, this, [this] {
    if (m_held && m_held->id == 0) m_held.reset();
    if (m_board->tool())
      m_surface->setCursor(Qt::CrossCursor);
    else
      m_surface->unsetCursor();
    refresh();
  });
  connect(board, &NoteBoard::cancelled, this, [this] {
    m_held.reset();
    refresh();
  });
  connect(board->shown(), &ShownMoment::moved, this, &NoteLayer::refresh);
  fit();
  refresh();
}

void NoteLayer::fit() {
  setGeometry(m_surface == parentWidget() ? m_surface->rect() : m_surface->geometry());
  raise();
}

/// Nothing is painted over a surface without notes.
void NoteLayer::refresh() {
  const bool any = m_held || !shownNotes().empty();
  setVisible(any);
  if (any) update();
}

std::vector<NoteLayer::Shown> NoteLayer::shownNotes() const {
  std::vector<Shown> all;
  const double time = m_board->shown()->time();
  for (const NoteBoard::Entry& one : m_board->entries()) {
    const bool isNow = one.note.isShownAt(time);
    // In a plot every moment has its place.
    if (one.note.place != m_ground.place || (!isNow && m_ground.place != NotePlace::Plot)) continue;
    if (m_held && one.id == m_held->id) continue;
    const auto toPixels = m_ground.toPixels(one.note.on);
    if (toPixels) all.push_back({one.id, one.note, *toPixels, isNow});
  }
  return all;
}

std::optional<NoteLayer::Shown> NoteLayer::shown(quint64 id) const {
  for (Shown& one : shownNotes()) {
    if (one.id == id) return std::move(one);
  }
  return {};
}

quint64 NoteLayer::noteAt(const QPointF& pixel) const {
  if (!m_ground.area().contains(pixel)) return 0;
  quint64 found = 0;
  for (const Shown& one : shownNotes()) {
    if (outlineOf(one.note, one.toPixels).contains(pixel)) found = one.id;
  }
  return found;
}

NoteLayer::Grip NoteLayer::gripAt(const Shown& one, const QPointF& at) const {
  if (one.note.shape == NoteShape::Text) return Grip::Whole;
  const double reach = scaled(this, gripReach);
  if (distanceOf(pixelOf(one.note.to, one.toPixels), at) <= reach) return Grip::To;
  const bool isArrow = one.note.shape == NoteShape::Arrow;
  if (isArrow && distanceOf(pixelOf(one.note.from, one.toPixels), at) <= reach) return Grip::From;
  return Grip::Whole;
}

QPoint NoteLayer::globalOf(const QPointF& pixel) const {
  return m_surface->mapToGlobal(pixel.toPoint() + QPoint(scaled(this, 12), scaled(this, 12)));
}

bool NoteLayer::eventFilter(QObject* watched, QEvent* event) {
  if (watched != m_surface) return false;
  const auto* mouse = static_cast<QMouseEvent*>(event);
  switch (event->type()) {
    case QEvent::Resize:
    case QEvent::Move:
    case QEvent::Show:
      fit();
      refresh();
      return false;
    case QEvent::MouseButtonPress:
      return mouse->button() == Qt::LeftButton && press(mouse->position());
    case QEvent::MouseMove:
      return move(mouse->position(), mouse->buttons() & Qt::LeftButton);
    case QEvent::MouseButtonRelease:
      return mouse->button() == Qt::LeftButton && release();
    case QEvent::MouseButtonDblClick: {
      const quint64 id = m_board->tool() ? 0 : noteAt(mouse->position());
      if (mouse->button() != Qt::LeftButton || id == 0) return false;
      m_held.reset();
      m_board->setHeld(false);
      edit(id, mouse->globalPosition().toPoint());
      return true;
    }
    case QEvent::ContextMenu: {
      const auto* menu = static_cast<QContextMenuEvent*>(event);
      const quint64 id = noteAt(menu->pos());
      if (id == 0) return false;
      openMenu(id, menu->globalPos());
      return true;
    }
    case QEvent::Leave:
      if (std::exchange(m_hovered, 0) != 0) update();
      return false;
    default:
      return false;
  }
}

bool NoteLayer::press(const QPointF& at) {
  if (m_board->tool()) {
    begin(at);
    return true;
  }
  const auto one = shown(noteAt(at));
  if (!one) return false;
  m_grip = gripAt(*one, at);
  m_from = at;
  m_before = one->note;
  m_held = one;
  m_board->setHeld(true);
  return true;
}

void NoteLayer::begin(const QPointF& at) {
  const auto owner = m_ground.area().contains(at) ? m_ground.owner(at) : std::nullopt;
  const auto toPixels = owner ? m_ground.toPixels(owner->on) : std::nullopt;
  if (!toPixels || !toPixels->isInvertible()) return;
  DrawnNote note;
  note.time = m_board->shown()->time();
  note.duration = m_board->duration();
  note.shape = *m_board->tool();
  note.place = m_ground.place;
  note.on = owner->on;
  note.unit = owner->unit;
  note.from = note.to = pointAt(at, *toPixels);
  m_from = at;
  m_held = Shown{0, note, *toPixels};
  m_grip = Grip::To;
  m_board->setHeld(true);
}

bool NoteLayer::move(const QPointF& at, bool isHeld) {
  if (!m_held || !isHeld) {
    if (m_board->tool()) {
      m_surface->setCursor(Qt::CrossCursor);
      return true;
    }
    return showHover(at);
  }
  DrawnNote& note = m_held->note;
  // The surface may move below it, such as a plot that follows the newest moment.
  m_held->toPixels = m_ground.toPixels(note.on).value_or(m_held->toPixels);
  const QTransform& toPixels = m_held->toPixels;
  if (m_grip == Grip::Whole) {
    const QPointF off = at - m_from;
    note.from = pointAt(pixelOf(m_before.from, toPixels) + off, toPixels);
    note.to = pointAt(pixelOf(m_before.to, toPixels) + off, toPixels);
  } else {
    (m_grip == Grip::From ? note.from : note.to) = pointAt(at, toPixels);
    if (note.shape == NoteShape::Text) note.from = note.to;
  }
  refresh();
  return true;
}

/// Whether the pointer is over a note, of which it shows the ends.
bool NoteLayer::showHover(const QPointF& at) {
  const quint64 id = isHidden() ? 0 : noteAt(at);
  if (std::exchange(m_hovered, id) != id) {
    m_surface->unsetCursor();
    update();
  }
  if (id == 0) return false;
  const auto one = shown(id);
  m_surface->setCursor(one && gripAt(*one, at) != Grip::Whole ? Qt::PointingHandCursor
                                                              : Qt::OpenHandCursor);
  return true;
}

bool NoteLayer::release() {
  if (!m_held) return m_board->tool().has_value();
  Shown held = *std::exchange(m_held, std::nullopt);
  m_board->setHeld(false);
  DrawnNote& note = held.note;
  // In a plot the moment is where it was drawn: the tip of an arrow, else its place.
  if (note.place == NotePlace::Plot) {
    note.time = note.shape == NoteShape::Arrow ? note.to.x : note.from.x;
  }
  if (held.id != 0) {
    const double moved = std::max(
        distanceOf(pixelOf(note.from, held.toPixels), pixelOf(m_before.from, held.toPixels)),
        distanceOf(pixelOf(note.to, held.toPixels), pixelOf(m_before.to, held.toPixels)));
    constexpr double trembling = 3.0;  // px
    if (moved >= trembling)
      m_board->change(held.id, note);
    else if (note.place == NotePlace::Plot)
      m_board->shown()->seek(m_before.time);  // as a click beside it would
    refresh();
    return true;
  }
  const QPoint global = globalOf(pixelOf(note.from, held.toPixels));
  if (note.shape == NoteShape::Text) {
    m_board->setTool({});
    editNote(window(), global, note, [board = m_board](const DrawnNote& made) { board->add(made); },
             {});
  } else if (distanceOf(pixelOf(note.from, held.toPixels), pixelOf(note.to, held.toPixels)) >=
             scaled(this, shortestDrag)) {
    m_board->setTool({});
    m_board->add(note);
  }
  refresh();
  return true;
}

void NoteLayer::edit(quint64 id, const QPoint& global) {
  const auto note = m_board->find(id);
  if (!note) return;
  editNote(
      window(), global, *note,
      [board = m_board, id](const DrawnNote& changed) { board->change(id, changed); },
      [board = m_board, id] { board->remove({id}); });
}

void NoteLayer::openMenu(quint64 id, const QPoint& global) {
  auto* menu = new QMenu(m_surface);
  menu->setObjectName(QStringLiteral("noteMenu"));
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->addAction(QStringLiteral("Change note…"), this, [this, id, global] { edit(id, global); });
  menu->addAction(themedIcon(QStringLiteral("edit-delete")), QStringLiteral("Delete note"), this,
                  [board = m_board, id] { board->remove({id}); });
  menu->popup(global);
}

void NoteLayer::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setClipRect(m_ground.area());
  std::vector<Shown> all = shownNotes();
  if (m_held) all.push_back(*m_held);
  for (const Shown& one : all) {
    paintNote(painter, one.note, one.toPixels, one.isNow ? 1.0 : otherMoment);
    const bool isHeld = m_held && one.id == m_held->id;
    if ((one.id != m_hovered && !isHeld) || one.note.shape == NoteShape::Text) continue;
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(Qt::black, 1.0));
    painter.setBrush(Qt::white);
    const double radius = scaled(this, 4);
    painter.drawEllipse(pixelOf(one.note.to, one.toPixels), radius, radius);
    if (one.note.shape == NoteShape::Arrow) {
      painter.drawEllipse(pixelOf(one.note.from, one.toPixels), radius, radius);
    }
  }
}

}  // namespace pitchboard::ui
