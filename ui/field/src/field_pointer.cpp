// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_pointer.h"

#include <algorithm>
#include <cmath>

#include <base/angles.h>
#include <ui/sources/match_edits.h>

#include "overlay_items.h"

namespace pitchboard::ui {
namespace {

constexpr double dragThreshold_px = 3.0;
constexpr double degreesPerNotch = 5.0;

}  // namespace

FieldPointer::FieldPointer(FieldScene* scene, MatchController* controller, QObject* parent)
    : QObject(parent), m_scene(scene), m_controller(controller) {}

bool FieldPointer::canEdit() const {
  return m_controller && m_scene->frame() && !m_scene->style().readOnly;
}

void FieldPointer::setTool(FieldTool tool) {
  if (tool == m_tool) return;
  cancel();
  m_tool = tool;
  m_scene->ruler()->setVisible(false);
  emit toolChanged(tool);
}

Qt::CursorShape FieldPointer::shape(const QPointF& at) const {
  if (m_tool != FieldTool::Select) return Qt::CrossCursor;
  if (m_drag == Drag::Robots || m_drag == Drag::Ball) return Qt::ClosedHandCursor;
  switch (m_scene->hit(at).kind) {
    case FieldHit::Kind::Handle:
      return Qt::PointingHandCursor;
    case FieldHit::Kind::Robot:
    case FieldHit::Kind::Ball:
      return canEdit() ? Qt::OpenHandCursor : Qt::ArrowCursor;
    case FieldHit::Kind::Nothing:
      break;
  }
  return Qt::ArrowCursor;
}

std::vector<RobotPlacement> FieldPointer::standing(const std::vector<RobotUid>& ids) const {
  std::vector<RobotPlacement> placements;
  for (const RobotUid uid : ids) {
    auto pose = m_scene->pose(uid);
    const link::RobotFrame* robot = pose ? m_scene->frame()->robot(uid) : nullptr;
    if (robot == nullptr) continue;
    // Keys and wheel come faster than frames: none of their steps may be lost.
    if (m_scene->frame() && m_scene->frame()->serial == m_pendingSince) {
      for (const RobotPlacement& moved : m_pending) {
        if (moved.id == robot->slot()) pose = moved.to;
      }
    }
    placements.push_back({robot->slot(), *pose, *pose});
  }
  return placements;
}

void FieldPointer::nudgeTo(const std::vector<RobotPlacement>& placements) {
  if (placements.empty()) return;
  if (m_scene->frame()->serial != m_pendingSince) m_pending.clear();
  m_pendingSince = m_scene->frame()->serial;
  for (const RobotPlacement& placement : placements) {
    std::erase_if(m_pending, [&](const auto& moved) { return moved.id == placement.id; });
    m_pending.push_back(placement);
  }
  m_controller->edits()->nudgeRobots(placements);
}

void FieldPointer::press(const QPointF& at, Qt::KeyboardModifiers modifiers) {
  cancel();
  m_from = m_at = at;
  m_moved = false;
  m_clickedOneOfSeveral = false;
  m_selectedBefore = m_scene->selection();
  if (m_tool == FieldTool::Ruler) {
    m_drag = Drag::Ruler;
    m_scene->ruler()->setLine(at, at);
    m_scene->ruler()->setVisible(true);
    return;
  }
  if (m_tool == FieldTool::Add) {
    if (canEdit()) {
      const double yaw = info(m_team).facesLeft ? std::numbers::pi : 0.0;
      m_controller->edits()->addRobot(m_team, {fromScene(at), yaw});
    }
    return;
  }
  const FieldHit hit = m_scene->hit(at);
  switch (hit.kind) {
    case FieldHit::Kind::Handle:
      beginTurn(hit.robot);
      break;
    case FieldHit::Kind::Robot:
      if (modifiers & Qt::ControlModifier) {
        m_scene->toggle(hit.robot);
      } else if (modifiers & Qt::ShiftModifier) {
        beginRobots(hit.robot);
        beginTurn(hit.robot);
      } else {
        beginRobots(hit.robot);
      }
      break;
    case FieldHit::Kind::Ball:
      m_drag = modifiers & Qt::ShiftModifier ? Drag::Kick : Drag::Ball;
      m_ballFrom = m_scene->ball();
      break;
    case FieldHit::Kind::Nothing:
      m_drag = Drag::Band;
      if (!(modifiers & Qt::ControlModifier)) {
        m_scene->select({});
        m_selectedBefore.clear();
      }
      break;
  }
}

void FieldPointer::beginRobots(RobotUid hit) {
  const auto& selected = m_scene->selection();
  const bool among = std::find(selected.begin(), selected.end(), hit) != selected.end();
  m_clickedOneOfSeveral = among && selected.size() > 1;
  m_pivot = hit;
  if (!among) m_scene->select({hit});
  m_drag = Drag::Robots;
  m_placements = standing(m_scene->selection());
}

void FieldPointer::beginTurn(RobotUid hit) {
  m_drag = Drag::Turn;
  m_pivot = hit;
  m_placements = standing(m_scene->selection());
}

void FieldPointer::move(const QPointF& at, Qt::KeyboardModifiers) {
  m_at = at;
  if (m_drag == Drag::None) return;
  const QPointF offset = at - m_from;
  if (!m_moved) {
    m_moved = std::hypot(offset.x(), offset.y()) >= m_scene->style().metres(dragThreshold_px);
    if (!m_moved) return;
    if (!canEdit() && m_drag != Drag::Band && m_drag != Drag::Ruler) {
      m_drag = Drag::None;
      if (m_controller) m_controller->edits()->allowsChange();  // says why not
      return;
    }
  }
  switch (m_drag) {
    case Drag::Robots:
      dragRobots();
      break;
    case Drag::Turn:
      dragTurn();
      break;
    case Drag::Band: {
      m_scene->rubberBand()->setVisible(true);
      m_scene->rubberBand()->setBand(QRectF(m_from, at));
      std::vector<RobotUid> ids = m_selectedBefore;
      for (const RobotUid id : m_scene->robotsIn(QRectF(m_from, at).normalized())) {
        if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
      }
      m_scene->select(ids);
      break;
    }
    case Drag::Ruler:
      m_scene->ruler()->setLine(m_from, at);
      break;
    case Drag::Kick: {
      const Velocity speed = kick();
      m_scene->ruler()->setArrow(toScene(m_ballFrom), at, std::hypot(speed.x, speed.y));
      m_scene->ruler()->setVisible(canEdit());
      break;
    }
    case Drag::Ball:
    case Drag::None:
      break;
  }
  showHeld();
}

void FieldPointer::dragRobots() {
  const QPointF offset = together(m_placements, m_at - m_from);
  for (RobotPlacement& placement : m_placements) {
    placement.to.position = {placement.from.position.x + offset.x(),
                             placement.from.position.y + offset.y()};
  }
}

QPointF FieldPointer::together(const std::vector<RobotPlacement>& placements,
                               const QPointF& offset) const {
  const sim::FieldSpec& field = m_scene->style().field;
  const auto held = [](double wanted, double at, double most) {
    return std::clamp(wanted, std::min(0.0, -most - at), std::max(0.0, most - at));
  };
  QPointF free = offset;
  for (const RobotPlacement& placement : placements) {
    const link::RobotFrame* robot = m_scene->frame()->robot(placement.id);
    const double radius = robot != nullptr ? m_scene->radius(robot->uid) : 0.0;
    const Point& at = placement.from.position;
    free = {held(free.x(), at.x, field.halfLength() + field.border - radius),
            held(free.y(), at.y, field.halfWidth() + field.border - radius)};
  }
  return free;
}

Velocity FieldPointer::kick() const {
  constexpr double perSecond = 2.0;  // m/s for each metre of the arrow
  constexpr double fastest = 20.0;   // m/s
  const QPointF offset = m_at - toScene(m_ballFrom);
  const double length = std::hypot(offset.x(), offset.y());
  const double scale = length > 0.0 ? std::min(perSecond, fastest / length) : 0.0;
  return {offset.x() * scale, offset.y() * scale};
}

void FieldPointer::dragTurn() {
  const auto pivot = std::find_if(m_placements.begin(), m_placements.end(),
                                  [pivot = m_scene->frame()->slotsOf({m_pivot})](const auto& p) {
                                    return !pivot.empty() && p.id == pivot.front();
                                  });
  if (pivot == m_placements.end()) return;
  const Point& centre = pivot->from.position;
  const double yaw = std::atan2(m_at.y() - centre.y, m_at.x() - centre.x);
  const double turned = wrapToPi(yaw - pivot->from.yaw);
  for (RobotPlacement& placement : m_placements) {
    placement.to.yaw = wrapToPi(placement.from.yaw + turned);
  }
}

void FieldPointer::showHeld() {
  if (!canEdit()) return;
  if (m_drag == Drag::Robots || m_drag == Drag::Turn) m_scene->showHeld(m_placements);
  if (m_drag == Drag::Ball) m_scene->showHeld({}, fromScene(m_at));
}

void FieldPointer::release(const QPointF& at, Qt::KeyboardModifiers modifiers) {
  if (m_drag == Drag::None) return;
  move(at, modifiers);
  if (m_moved && canEdit()) finish();
  m_scene->showHeld({});
  if (m_drag == Drag::Kick) m_scene->ruler()->setVisible(false);
  if (!m_moved && m_drag == Drag::Robots && m_clickedOneOfSeveral) m_scene->select({m_pivot});
  m_scene->rubberBand()->setVisible(false);
  m_drag = Drag::None;
}

void FieldPointer::finish() {
  if (m_drag == Drag::Robots || m_drag == Drag::Turn)
    m_controller->edits()->moveRobots(m_placements);
  if (m_drag == Drag::Ball) m_controller->edits()->moveBall(fromScene(m_at));
  if (m_drag == Drag::Kick) {
    // It may have rolled on while the arrow was drawn; it is kicked where it is.
    m_controller->edits()->moveBall(m_scene->ball(), kick());
  }
}

void FieldPointer::doubleClick(const QPointF& at) {
  const FieldHit hit = m_scene->hit(at);
  if (m_tool != FieldTool::Select) return;
  if (hit.kind == FieldHit::Kind::Ball && canEdit()) emit ballRequested();
  if (hit.kind != FieldHit::Kind::Robot) return;
  m_scene->select({hit.robot});
  if (canEdit()) emit poseRequested(hit.robot);
}

bool FieldPointer::turnAt(const QPointF& at, double notches) {
  const FieldHit hit = m_scene->hit(at);
  if (hit.kind != FieldHit::Kind::Robot || !canEdit()) return false;
  const auto& selected = m_scene->selection();
  // The wheel turns only selected robots, so that zooming over others does not turn them.
  if (std::find(selected.begin(), selected.end(), hit.robot) == selected.end()) return false;
  auto placements = standing(selected);
  for (RobotPlacement& placement : placements) {
    placement.to.yaw = wrapToPi(placement.from.yaw + radiansFromDegrees(notches * degreesPerNotch));
  }
  nudgeTo(placements);
  return true;
}

bool FieldPointer::cancel() {
  if (m_drag == Drag::None) return false;
  m_scene->showHeld({});
  if (m_drag == Drag::Band) m_scene->select(m_selectedBefore);
  m_scene->rubberBand()->setVisible(false);
  m_scene->ruler()->setVisible(false);
  m_drag = Drag::None;
  return true;
}

void FieldPointer::nudge(const QPointF& metres) {
  if (!canEdit()) return;
  auto placements = standing(m_scene->selection());
  const QPointF offset = together(placements, metres);
  for (RobotPlacement& placement : placements) {
    placement.to.position.x += offset.x();
    placement.to.position.y += offset.y();
  }
  nudgeTo(placements);
}

}  // namespace pitchboard::ui
