// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_scene.h"

#include <algorithm>
#include <cmath>

#include <base/angles.h>
#include <simcore/world/published_frame.h>
#include <ui/sources/pose_difference.h>

#include "ball_item.h"
#include "belief_item.h"
#include "compared_item.h"
#include "live_items.h"
#include "overlay_items.h"
#include "robot_item.h"
#include "sector_items.h"
#include "thought_items.h"
#include "trail_item.h"
#include "view_wedge_item.h"

namespace pitchboard::ui {
namespace {

// From the ground up.
enum Height {
  wedgeHeight,
  sectorHeight,
  trailHeight,
  particleHeight,
  beliefHeight,
  pathHeight,
  ballHeight,
  robotHeight,
  toolHeight
};

constexpr double hitMargin_px = 3.0;

double distance(const QPointF& a, const QPointF& b) {
  return std::hypot(a.x() - b.x(), a.y() - b.y());
}

/// What a robot that is heard believes: its body is drawn there, so there is no ghost.
BeliefLook beliefOf(const sim::RobotSnapshot& robot, const link::RobotBoardView& board,
                    const link::RobotHealth& health, const sim::FieldSpec& field) {
  BeliefLook look;
  look.team = robot.identity.team;
  look.believed = robot.pose;
  look.ghost = false;
  const double sigma = sim::published_frame::metresFromCm(static_cast<double>(board.belief));
  look.sigma = std::isfinite(sigma) ? std::clamp(sigma, 0.0, field.length) : field.length;
  look.origin = robot.pose.position;
  if (!health.timedOut) look.ball = health.ball;
  look.opacity = health.timedOut ? 0.45 : 1.0;
  return look;
}

/// What the robot believes and perceives, from its blackboard.
BeliefLook beliefOf(const sim::RobotSnapshot& robot, const link::RobotBoardView& board,
                    const sim::FieldSpec& field) {
  BeliefLook look;
  look.team = robot.identity.team;
  Pose origin = robot.pose;
  if (board.localizationWorking) {
    origin = sim::published_frame::studioFromLocalization(
        field, {static_cast<double>(board.localizationX), static_cast<double>(board.localizationY),
                static_cast<double>(board.localizationTheta)});
    look.believed = origin;
    const double sigma = sim::published_frame::metresFromCm(static_cast<double>(board.belief));
    look.sigma = std::isfinite(sigma) ? std::clamp(sigma, 0.0, field.length) : field.length;
  }
  look.origin = origin.position;
  const double range = sim::published_frame::metresFromCm(static_cast<double>(board.ballDistCm));
  const double bearing = radiansFromDegrees(static_cast<double>(board.panDeg));
  if (board.visionWorking && !board.visionLost && range > 0.0 && range < 2 * field.length &&
      std::isfinite(bearing)) {
    look.ball = Point{origin.position.x + range * std::cos(origin.yaw + bearing),
                      origin.position.y + range * std::sin(origin.yaw + bearing)};
  }
  return look;
}

}  // namespace

struct FieldScene::Robot {
  Robot(FieldScene* scene, RobotId id)
      : body(&scene->m_style, id),
        belief(&scene->m_style),
        trail(&scene->m_style),
        wedge(&scene->m_style),
        other(&scene->m_style),
        particles(&scene->m_style),
        path(&scene->m_style) {
    const std::pair<QGraphicsItem*, Height> items[] = {
        {&body, robotHeight},  {&belief, beliefHeight}, {&trail, trailHeight},
        {&wedge, wedgeHeight}, {&other, beliefHeight},  {&particles, particleHeight},
        {&path, pathHeight}};
    for (const auto& [item, height] : items) {
      item->setZValue(height);
      scene->addItem(item);
    }
  }

  RobotItem body;
  BeliefItem belief;
  TrailItem trail;
  ViewWedgeItem wedge;
  OtherPoseItem other;
  ParticlesItem particles;
  PlannedPathItem path;
};

FieldScene::FieldScene(QObject* parent)
    : QGraphicsScene(parent),
      m_ball(new BallItem(&m_style)),
      m_teamBall(new TeamBallItem(&m_style)),
      m_compared(new ComparedItem(&m_style)),
      m_eopra(new SectorItem(&m_style, SectorItem::Kind::Eopra)),
      m_starVars(new SectorItem(&m_style, SectorItem::Kind::StarVars)),
      m_ruler(new RulerItem(&m_style)),
      m_band(new RubberBandItem(&m_style)) {
  // Everything moves all the time: an index would cost more than it saves.
  setItemIndexMethod(QGraphicsScene::NoIndex);
  const std::pair<QGraphicsItem*, Height> items[] = {
      {m_ball, ballHeight},    {m_teamBall, ballHeight},   {m_compared, beliefHeight},
      {m_eopra, sectorHeight}, {m_starVars, sectorHeight}, {m_ruler, toolHeight},
      {m_band, toolHeight}};
  for (const auto& [item, height] : items) {
    item->setZValue(height);
    item->setVisible(false);
    addItem(item);
  }
}

FieldScene::~FieldScene() = default;

void FieldScene::styleChanged() {
  for (auto& [id, robot] : m_robots) {
    robot->body.styleChanges();
    robot->belief.styleChanges();
    robot->trail.styleChanges();
    robot->wedge.styleChanges();
    robot->other.styleChanges();
    robot->particles.styleChanges();
    robot->path.styleChanges();
  }
  m_teamBall->styleChanges();
  m_compared->styleChanges();
  m_ball->styleChanges();
  m_eopra->styleChanges();
  m_starVars->styleChanges();
  m_ruler->styleChanges();
  if (m_frame) showFrame(m_frame);
  update();
}

void FieldScene::showFrame(const FramePtr& frame) {
  m_frame = frame;
  m_ball->setVisible(frame && frame->ballKnown);
  m_teamBall->setBall(frame ? frame->teamBall : std::nullopt);
  if (!frame) {
    m_robots.clear();
    setSelection({});
    showSelected();
    return;
  }
  if (!(m_style.field == frame->field)) {
    m_style.field = frame->field;
    update();
  }
  const sim::Snapshot& snapshot = frame->snapshot;
  matchRobots(snapshot);
  m_ball->setBall(snapshot.ball);
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    const bool known =
        i < frame->boards.size() && frame->boards[i].id == snapshot.robots[i].identity.id;
    const bool heard =
        i < frame->health.size() && frame->health[i].id == snapshot.robots[i].identity.id;
    showRobot(*m_robots.at(snapshot.robots[i].identity.id), snapshot.robots[i],
              known ? &frame->boards[i] : nullptr, heard ? &frame->health[i] : nullptr,
              snapshot.time);
  }
  showThoughts();
  showSelected();
}

// Of the selected robots, or of all while none is selected: six clouds at once hide each other.
void FieldScene::showThoughts() {
  if (!m_frame) return;
  for (auto& [id, robot] : m_robots) {
    const bool chosen = m_selection.empty() ||
                        std::find(m_selection.begin(), m_selection.end(), id) != m_selection.end();
    const auto told = std::find_if(m_frame->thoughts.begin(), m_frame->thoughts.end(),
                                   [&](const auto& one) { return one.robot == id; });
    const bool any = chosen && told != m_frame->thoughts.end();
    const TeamColor team = robot->body.look().team;
    robot->particles.setVisible(any && m_style.shows(FieldLayer::Particles));
    robot->path.setVisible(any && m_style.shows(FieldLayer::PlannedPath));
    if (robot->particles.isVisible()) robot->particles.setCloud(told->cloud, team);
    if (robot->path.isVisible()) robot->path.setPath(told->path, team);
  }
}

void FieldScene::matchRobots(const sim::Snapshot& snapshot) {
  std::set<RobotId> present;
  for (const sim::RobotSnapshot& robot : snapshot.robots) {
    const RobotId id = robot.identity.id;
    present.insert(id);
    if (!m_robots.contains(id)) m_robots.emplace(id, std::make_unique<Robot>(this, id));
  }
  if (std::erase_if(m_robots, [&](const auto& entry) { return !present.contains(entry.first); })) {
    select(m_selection);
    if (m_followed && !present.contains(*m_followed)) {
      m_followed.reset();
      emit followedChanged(m_followed);
    }
  }
}

void FieldScene::showRobot(Robot& robot, const sim::RobotSnapshot& snapshot,
                           const link::RobotBoardView* board, const link::RobotHealth* health,
                           double time) {
  const RobotId id = snapshot.identity.id;
  RobotLook look;
  look.pose = snapshot.pose;
  look.team = snapshot.identity.team;
  look.number = snapshot.identity.number;
  look.fallen = snapshot.fallen;
  look.selected = std::find(m_selection.begin(), m_selection.end(), id) != m_selection.end();
  look.followed = m_followed == id;
  if (snapshot.fallen) look.word = QStringLiteral("fallen");
  const bool poseKnown = health == nullptr || health->poseKnown;
  if (health != nullptr && health->timedOut) {
    look.word = tr("timeout %1 s").arg(static_cast<int>(health->age));
    look.opacity = 0.45;
  } else if (health != nullptr && health->penalty) {
    look.word = tr("penalised");
  }
  robot.body.setLook(look);
  robot.body.setVisible(poseKnown);

  robot.trail.append(snapshot.pose.position, time);
  robot.trail.setVisible(poseKnown && m_style.shows(FieldLayer::Trails) && isTrailShown(id));
  // Where a robot that is heard looks, it does not say.
  robot.wedge.setVisible(health == nullptr && m_style.shows(FieldLayer::FieldOfView) &&
                         (look.selected || m_style.wedgeForAll));
  robot.wedge.setHead(snapshot.pose.position, snapshot.headYaw);
  robot.belief.setVisible(board != nullptr && poseKnown);
  if (board != nullptr) {
    robot.belief.setLook(health != nullptr ? beliefOf(snapshot, *board, *health, m_style.field)
                                           : beliefOf(snapshot, *board, m_style.field));
  }
  showOtherPose(robot, snapshot, poseKnown);
}

void FieldScene::showOther(const FramePtr& frame) {
  m_other = frame;
  if (m_frame) showFrame(m_frame);
}

void FieldScene::showCompared(const FramePtr& frame) {
  m_compared->setFrame(frame);
}

void FieldScene::showOtherPose(Robot& robot, const sim::RobotSnapshot& snapshot, bool poseKnown) {
  const auto difference =
      m_other ? poseDifference(*m_other, snapshot.identity.id, snapshot.pose) : std::nullopt;
  robot.other.setVisible(poseKnown && difference.has_value());
  if (!difference) return;
  robot.other.setOther({difference->other, snapshot.pose.position, snapshot.identity.team,
                        differenceText(*difference)});
}

void FieldScene::showSelected() {
  const auto chosen = m_selection.empty() ? m_robots.end() : m_robots.find(m_selection.front());
  const bool any = chosen != m_robots.end();
  m_eopra->setVisible(any && m_style.shows(FieldLayer::Eopra));
  m_starVars->setVisible(any && m_style.shows(FieldLayer::StarVars));
  if (!any) return;
  m_eopra->setPose(chosen->second->body.look().pose);
  m_starVars->setPose(chosen->second->body.look().pose);
}

void FieldScene::select(const std::vector<RobotId>& ids) {
  std::vector<RobotId> present;
  for (const RobotId id : ids) {
    if (m_robots.contains(id)) present.push_back(id);
  }
  setSelection(std::move(present));
}

void FieldScene::selectAll() {
  std::vector<RobotId> all;
  for (const auto& [id, robot] : m_robots) all.push_back(id);
  setSelection(std::move(all));
}

void FieldScene::toggle(RobotId id) {
  std::vector<RobotId> ids = m_selection;
  if (const auto found = std::find(ids.begin(), ids.end(), id); found != ids.end()) {
    ids.erase(found);
  } else {
    ids.push_back(id);
  }
  select(ids);
}

void FieldScene::setSelection(std::vector<RobotId> ids) {
  if (ids == m_selection) return;
  m_selection = std::move(ids);
  for (auto& [id, robot] : m_robots) {
    RobotLook look = robot->body.look();
    look.selected = std::find(m_selection.begin(), m_selection.end(), id) != m_selection.end();
    robot->body.setLook(look);
    robot->wedge.setVisible(m_style.shows(FieldLayer::FieldOfView) && m_frame &&
                            m_frame->truthKnown && (look.selected || m_style.wedgeForAll));
    robot->wedge.styleChanges();
  }
  showThoughts();
  showSelected();
  emit selectionChangedTo(m_selection);
}

FieldHit FieldScene::hit(const QPointF& metres) const {
  const double margin = m_style.metres(hitMargin_px);
  if (!m_style.readOnly) {
    for (const RobotId id : m_selection) {
      const QPointF handle = RobotItem::handlePosition(m_style, m_robots.at(id)->body.look().pose);
      if (distance(handle, metres) <= RobotItem::handleRadius(m_style) + margin) {
        return {FieldHit::Kind::Handle, id};
      }
    }
  }
  const double robotReach = m_style.robotDrawRadius() + margin;
  FieldHit nearest;
  double least = robotReach;
  for (const auto& [id, robot] : m_robots) {
    const double away = distance(toScene(robot->body.look().pose.position), metres);
    if (away > least || !robot->body.isVisible()) continue;
    least = away;
    nearest = {FieldHit::Kind::Robot, id};
  }
  const bool onBall =
      m_frame && m_frame->ballKnown &&
      distance(toScene(m_frame->snapshot.ball), metres) <= m_style.ballDrawRadius() + margin;
  // A ball at a robot's foot is smaller and must still be reached.
  if (onBall && (nearest.kind == FieldHit::Kind::Nothing ||
                 distance(toScene(m_frame->snapshot.ball), metres) < least)) {
    return {FieldHit::Kind::Ball, {}};
  }
  return nearest;
}

std::vector<RobotId> FieldScene::robotsIn(const QRectF& metres) const {
  std::vector<RobotId> inside;
  for (const auto& [id, robot] : m_robots) {
    const RobotItem& body = robot->body;
    if (body.isVisible() && metres.contains(toScene(body.look().pose.position))) {
      inside.push_back(id);
    }
  }
  return inside;
}

std::optional<Pose> FieldScene::pose(RobotId id) const {
  const auto found = m_robots.find(id);
  if (found == m_robots.end()) return {};
  return found->second->body.look().pose;
}

Point FieldScene::ball() const {
  return m_frame ? m_frame->snapshot.ball : Point{};
}

void FieldScene::setTrailShown(RobotId id, bool shown) {
  if (shown) {
    m_hiddenTrails.erase(id);
  } else {
    m_hiddenTrails.insert(id);
  }
  if (m_frame) showFrame(m_frame);
}

void FieldScene::setFollowed(std::optional<RobotId> id) {
  const bool there = !id || m_robots.contains(*id);
  if (!there) id.reset();
  if (id == m_followed && there) return;
  m_followed = id;
  if (m_frame) showFrame(m_frame);
  emit followedChanged(id);
}

}  // namespace pitchboard::ui
