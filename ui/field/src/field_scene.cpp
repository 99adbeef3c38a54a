// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/sources/pose_difference.h>

#include "advice_items.h"
#include "ball_item.h"
#include "belief_item.h"
#include "compared_item.h"
#include "debug_overlay_items.h"
#include "drawing_items.h"
#include "live_items.h"
#include "name_labels.h"
#include "overlay_items.h"
#include "robot_item.h"
#include "sector_items.h"
#include "trail_item.h"
#include "trail_rows.h"
#include "view_wedge_item.h"

namespace pitchboard::ui {
namespace {

// From the ground up.
enum Height {
  heatHeight,
  wedgeHeight,
  sectorHeight,
  trailHeight,
  particleHeight,
  beliefHeight,
  pathHeight,
  ballHeight,
  robotHeight,
  drawingHeight,
  adviceHeight,
  nameHeight,
  toolHeight
};

constexpr double hitMargin_px = 3.0;

QString signedValue(double value) {
  return (value < 0.0 ? QString() : QStringLiteral("+")) + fieldNumber(value, 2);
}

/// The chosen one last and opaque. Kicks start at the ball where the robot sees it.
std::vector<DrawnAction> drawnCandidates(const link::RobotFrame& robot,
                                         const link::MatchFrame& frame) {
  std::vector<DrawnAction> drawn;
  const QPointF body = toScene(robot.pose.position);
  const QPointF ball = robot.ball        ? toScene(robot.ball->place)
                       : frame.ballKnown ? toScene(frame.snapshot.ball)
                                         : body;
  for (const link::AdviceCandidate& one : robot.advice->candidates) {
    // What the behaviour would do has no place of its own, and neither has leaving the ball.
    const bool hasPlace =
        one.kind != link::AdviceKind::None && one.kind != link::AdviceKind::LeaveBall;
    if (!hasPlace && !one.isChosen) continue;
    DrawnAction& action = drawn.emplace_back();
    action.from = link::isForBall(one.kind) ? ball : body;
    if (hasPlace) action.to = toScene(one.place);
    action.text = signedValue(one.value);
    if (one.isChosen) {
      action.text = QString::fromUtf8(link::adviceText(one.kind).data(),
                                      qsizetype(link::adviceText(one.kind).size())) +
                    QStringLiteral("  ") + action.text;
    }
    action.color = theme().team(robot.identity.team);
    action.width = one.isChosen ? 4.0 : 2.0;
    action.opacity = one.isChosen ? 1.0 : 0.45;
  }
  std::stable_partition(drawn.begin(), drawn.end(),
                        [](const DrawnAction& one) { return one.opacity < 1.0; });
  return drawn;
}

/// Stands out from the grass of both themes, and is no team's.
QColor explorationColor() {
  return {255, 214, 64};
}

}  // namespace

struct FieldScene::Robot {
  Robot(FieldScene* scene, RobotKey id)
      : body(&scene->m_style, id),
        belief(&scene->m_style),
        trail(&scene->m_style),
        wedge(&scene->m_style),
        other(&scene->m_style),
        particles(&scene->m_style),
        path(&scene->m_style),
        heat(&scene->m_style),
        candidates(&scene->m_style) {
    const std::pair<QGraphicsItem*, Height> items[] = {
        {&body, robotHeight},  {&belief, beliefHeight}, {&trail, trailHeight},
        {&wedge, wedgeHeight}, {&other, beliefHeight},  {&particles, particleHeight},
        {&path, pathHeight},   {&heat, heatHeight},     {&candidates, adviceHeight}};
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
  HeatItem heat;
  ActionArrowsItem candidates;
};

FieldScene::FieldScene(QObject* parent)
    : QGraphicsScene(parent),
      m_ball(new BallItem(&m_style)),
      m_teamBalls(new TeamBallsItem(&m_style)),
      m_drawings(std::make_unique<DrawingItems>(this, &m_style, drawingHeight)),
      m_compared(new ComparedItem(&m_style)),
      m_heat(new HeatItem(&m_style)),
      m_actions(new ActionArrowsItem(&m_style)),
      m_eopra(new SectorItem(&m_style, SectorItem::Kind::Eopra)),
      m_starVars(new SectorItem(&m_style, SectorItem::Kind::StarVars)),
      m_names(new NameLabelsItem(&m_style)),
      m_ruler(new RulerItem(&m_style)),
      m_band(new RubberBandItem(&m_style)) {
  // Everything moves all the time: an index would cost more than it saves.
  setItemIndexMethod(QGraphicsScene::NoIndex);
  const std::pair<QGraphicsItem*, Height> items[] = {
      {m_ball, ballHeight},       {m_teamBalls, ballHeight}, {m_compared, beliefHeight},
      {m_heat, heatHeight},       {m_actions, adviceHeight}, {m_eopra, sectorHeight},
      {m_starVars, sectorHeight}, {m_names, nameHeight},     {m_ruler, toolHeight},
      {m_band, toolHeight}};
  for (const auto& [item, height] : items) {
    item->setZValue(height);
    item->setVisible(false);
    addItem(item);
  }
}

FieldScene::~FieldScene() = default;

void FieldScene::styleChanged() {
  for (QGraphicsItem* item : items()) {
    if (auto* shown = dynamic_cast<FieldItem*>(item)) shown->styleChanges();
  }
  if (m_frame) showFrame(m_frame);
  showForecastItems();
  update();
}

void FieldScene::showFrame(const FramePtr& frame) {
  m_frame = frame;
  m_ball->setVisible(frame && frame->ballKnown);
  m_teamBalls->setBalls(frame ? frame->teamBalls : std::vector<link::TeamBall>());
  m_drawings->show(frame.get(), m_selection);
  if (!frame) {
    m_robots.clear();
    setSelection({});
    showSelected();
    return;
  }
  setField(frame->settings->field);
  matchRobots();
  m_ball->setBall(frame->snapshot.ball);
  for (const link::RobotFrame& robot : frame->robots) showRobot(robot);
  showNames();
  showDebugOverlay();
  showSelected();
}

void FieldScene::setField(const sim::FieldSpec& field) {
  if (m_style.field == field) return;
  m_style.field = field;
  update();
}

void FieldScene::showNames() {
  std::vector<NameLabelsItem::Robot> named;
  std::vector<QPointF> places;
  const bool shown = m_style.shows(FieldLayer::Numbers);
  m_names->setVisible(shown);
  for (const auto& [id, robot] : m_robots) {
    if (!robot->body.isVisible()) continue;
    const RobotLook& look = robot->body.look();
    places.push_back(toScene(look.pose.position));
    named.push_back({id, toScene(look.pose.position), m_style.drawRadius(look.radius),
                     shown ? look.name : QString(), look.tag});
  }
  m_names->setRobots(std::move(named));
  for (const auto& [id, robot] : m_robots) {
    const auto place = m_names->tags().find(id);
    robot->body.setTagPosition(place == m_names->tags().end() ? std::nullopt
                                                              : std::optional(place->second));
  }
  m_teamBalls->setRobots(std::move(places), m_style.robotDrawRadius());
}

// Of the selected robots, or of all while none is selected: six clouds at once hide each other.
void FieldScene::showDebugOverlay() {
  if (!m_frame) return;
  for (auto& [id, robot] : m_robots) {
    const bool chosen = m_selection.empty() ||
                        std::find(m_selection.begin(), m_selection.end(), id) != m_selection.end();
    const link::RobotFrame* now = m_frame->robot(id);
    const bool any = chosen && now != nullptr && now->cognitionDebug;
    const TeamColor team = robot->body.look().team;
    robot->particles.setVisible(any && m_style.shows(FieldLayer::Particles));
    robot->path.setVisible(any && m_style.shows(FieldLayer::PlannedPath));
    if (robot->particles.isVisible()) robot->particles.setCloud(now->cognitionDebug->cloud, team);
    if (robot->path.isVisible()) robot->path.setPath(now->cognitionDebug->path, team);
    const bool advised = chosen && now != nullptr && now->advice && now->advice->isThinking;
    const bool heat = advised && now->advice->heat && m_style.shows(FieldLayer::AdvisorHeat);
    const bool candidates = advised && m_style.shows(FieldLayer::AdvisorCandidates);
    robot->heat.setVisible(heat);
    robot->candidates.setVisible(candidates);
    if (heat) robot->heat.setHeat(now->advice->heat, theme().team(team));
    if (candidates) robot->candidates.setActions(drawnCandidates(*now, *m_frame));
  }
}

void FieldScene::matchRobots() {
  std::set<RobotKey> present;
  for (const link::RobotFrame& robot : m_frame->robots) {
    const RobotKey id = robot.key;
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

void FieldScene::rename(const std::vector<Renaming>& renamings) {
  pitchboard::rename(m_robots, renamings);
  for (const auto& [key, robot] : m_robots) robot->body.setKey(key);
  pitchboard::rename(m_hiddenTrails, renamings);
  for (RobotKey& key : m_selection) key = pitchboard::renamed(key, renamings);
  emit selectionChangedTo(m_selection);
  if (!m_followed) return;
  m_followed = pitchboard::renamed(*m_followed, renamings);
  emit followedChanged(m_followed);
}

void FieldScene::showRobot(const link::RobotFrame& now) {
  const RobotKey id = now.key;
  Robot& robot = *m_robots.at(id);
  RobotLook look;
  look.pose = now.pose;
  look.team = now.identity.team;
  look.number = now.identity.number;
  look.name = robotName(now);
  look.radius = now.radius;
  look.fallen = now.fallen;
  look.selected = std::find(m_selection.begin(), m_selection.end(), id) != m_selection.end();
  look.followed = m_followed == id;
  if (now.fallen) look.tag = QStringLiteral("fallen");
  if (now.timedOut()) {
    look.tag = QStringLiteral("timeout %1").arg(durationText(telemetry::secondsOf(now.link->age)));
    look.opacity = 0.45;
  } else if (now.penalty) {
    look.tag = QStringLiteral("penalised");
  }
  robot.body.setLook(look);
  robot.body.setVisible(now.poseKnown());

  showTrail(robot, now);
  // Where a robot that is received looks, it does not say.
  robot.wedge.setVisible(!now.link && m_style.shows(FieldLayer::FieldOfView) &&
                         (look.selected || m_style.wedgeForAll));
  robot.wedge.setCamera(now.fieldOfView, now.visionRange);
  robot.wedge.setHead(now.pose.position, now.headYaw);
  robot.belief.setVisible(now.boardKey || now.belief);
  robot.belief.setLook(beliefOf(now, m_style.field));
  showOtherPose(robot, now);
}

// Rows know the trail of any moment. What frames have shown is the trail only while they go on.
void FieldScene::showTrail(Robot& robot, const link::RobotFrame& now) {
  const bool shown = now.poseKnown() && m_style.shows(FieldLayer::Trails) && isTrailShown(now.key);
  robot.trail.setVisible(shown);
  const double time = m_frame->snapshot.time, passed = time - robot.trail.now();
  constexpr double longestGap = 1.0;  // s; less than a step of the fastest replay
  const bool recorded = m_frame->origin == link::FrameOrigin::Recorded;
  const bool goesOn = passed >= 0.0 && passed <= longestGap;
  if (recorded || !goesOn) {
    const auto rows = shown && m_rows ? m_rows() : nullptr;
    const auto places = rows ? trailOf(*rows, now, m_frame->settings->field, time)
                             : std::vector<TrailItem::Place>();
    if (!places.empty()) {
      robot.trail.set(places);
    } else if (!goesOn && recorded) {
      robot.trail.clear();
    }
  }
  robot.trail.append(now.pose.position, time);
}

void FieldScene::showOther(const FramePtr& frame) {
  m_other = frame;
  if (m_frame) showFrame(m_frame);
}

void FieldScene::showCompared(const FramePtr& frame) {
  m_compared->setFrame(frame);
}

void FieldScene::showForecast(const ForecastPtr& forecast) {
  m_forecast = forecast;
  showForecastItems();
}

void FieldScene::showForecastItems() {
  const bool shown = m_forecast && m_style.shows(FieldLayer::Exploration);
  m_heat->setVisible(shown && m_forecast->heat);
  m_heat->setHeat(m_forecast ? m_forecast->heat : nullptr, explorationColor());
  std::vector<DrawnAction> actions;
  if (shown && m_forecast->best) {
    const ForecastAction& best = *m_forecast->best;
    DrawnAction& drawn = actions.emplace_back();
    drawn.from = toScene(best.from);
    if (best.to) drawn.to = toScene(*best.to);
    drawn.text = best.text;
    drawn.color = theme().accentLine;
    drawn.dashed = !best.isClear;
  }
  m_actions->setVisible(!actions.empty());
  m_actions->setActions(std::move(actions));
}

void FieldScene::showOtherPose(Robot& robot, const link::RobotFrame& now) {
  const auto difference = m_other ? poseDifference(*m_other, now) : std::nullopt;
  robot.other.setVisible(now.poseKnown() && difference.has_value());
  if (!difference) return;
  robot.other.setOther(
      {difference->other, now.pose.position, now.identity.team, differenceText(*difference)});
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

void FieldScene::select(const std::vector<RobotKey>& ids) {
  std::vector<RobotKey> present;
  for (const RobotKey id : ids) {
    if (m_robots.contains(id)) present.push_back(id);
  }
  setSelection(std::move(present));
}

void FieldScene::selectAll() {
  std::vector<RobotKey> all;
  for (const auto& [id, robot] : m_robots) all.push_back(id);
  setSelection(std::move(all));
}

void FieldScene::toggle(RobotKey id) {
  std::vector<RobotKey> ids = m_selection;
  if (const auto found = std::find(ids.begin(), ids.end(), id); found != ids.end()) {
    ids.erase(found);
  } else {
    ids.push_back(id);
  }
  select(ids);
}

void FieldScene::setSelection(std::vector<RobotKey> ids) {
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
  showDebugOverlay();
  if (m_style.drawings.onlySelected) m_drawings->show(m_frame.get(), m_selection);
  showSelected();
  emit selectionChangedTo(m_selection);
}

FieldHit FieldScene::hit(const QPointF& metres) const {
  const double margin = m_style.metres(hitMargin_px);
  if (!m_style.readOnly) {
    for (const RobotKey id : m_selection) {
      const RobotLook& look = m_robots.at(id)->body.look();
      const QPointF handle = RobotItem::handlePosition(m_style, look.pose, look.radius);
      if (distance(handle, metres) <= RobotItem::handleRadius(m_style) + margin) {
        return {FieldHit::Kind::Handle, id};
      }
    }
  }
  FieldHit nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [id, robot] : m_robots) {
    const double away = distance(toScene(robot->body.look().pose.position), metres);
    const double reach = m_style.drawRadius(robot->body.look().radius) + margin;
    if (away > reach || away > least || !robot->body.isVisible()) continue;
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

std::vector<RobotKey> FieldScene::robotsIn(const QRectF& metres) const {
  std::vector<RobotKey> inside;
  for (const auto& [id, robot] : m_robots) {
    const RobotItem& body = robot->body;
    if (body.isVisible() && metres.contains(toScene(body.look().pose.position))) {
      inside.push_back(id);
    }
  }
  return inside;
}

std::optional<Pose> FieldScene::pose(RobotKey id) const {
  const auto found = m_robots.find(id);
  if (found == m_robots.end()) return {};
  return found->second->body.look().pose;
}

double FieldScene::radius(RobotKey id) const {
  const auto found = m_robots.find(id);
  const double own = found == m_robots.end() ? 0.0 : found->second->body.look().radius;
  return own > 0.0 ? own : m_style.field.robotRadius;
}

Point FieldScene::ball() const {
  return m_frame ? m_frame->snapshot.ball : Point{};
}

void FieldScene::setTrailShown(RobotKey id, bool shown) {
  if (shown) {
    m_hiddenTrails.erase(id);
  } else {
    m_hiddenTrails.insert(id);
  }
  if (m_frame) showFrame(m_frame);
}

void FieldScene::setFollowed(std::optional<RobotKey> id) {
  const bool there = !id || m_robots.contains(*id);
  if (!there) id.reset();
  if (id == m_followed && there) return;
  m_followed = id;
  if (m_frame) showFrame(m_frame);
  emit followedChanged(id);
}

}  // namespace pitchboard::ui
