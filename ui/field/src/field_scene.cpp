// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_scene.h"
#include "heat_item.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <robotlink/frame/robot_frame.h>
#include <simcore/world/field.h>
#include <simcore/world/published_frame.h>
#include <telemetry/series/series_store.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/sources/pose_difference.h>

#include "belief_item.h"
#include "compared_item.h"
#include "debug_overlay_items.h"
#include "drawing_items.h"
#include "field_item.h"
#include "field_stamps.h"
#include "live_items.h"
#include "name_labels.h"
#include "overlay_items.h"
#include "robot_item.h"
#include "sector_items.h"
#include "trail_item.h"
#include "view_wedge_item.h"

namespace pitchboard::ui {
namespace {

constexpr double perSecond = 10.0;
constexpr double rounding = 1e-6;  // s; files keep whole nanoseconds

/// Returns where a robot truly was, or believed to be where nobody knows the truth, ten times a
/// second, up to `time` (s). Empty while the rows are being read, and for robots of Live whose
/// profile gives their position a name of its own.
std::vector<TrailItem::Place> trailOf(const telemetry::SeriesStore& rows,
                                      const link::RobotFrame& robot, const sim::FieldSpec& field,
                                      double time) {
  auto x = rows.find(robot.name, "TRUE_X"), y = rows.find(robot.name, "TRUE_Y");
  const bool believed = !x || !y;
  if (believed) {
    x = rows.find(robot.name, "LOCALIZATION_X");
    y = rows.find(robot.name, "LOCALIZATION_Y");
  }
  if (!x || !y || x->group != y->group) return {};
  const auto view = rows.view(x->group);
  const auto known = view ? view->range() : std::nullopt;
  if (!known) return {};
  // Steps are counted from second 0: a trail that grows keeps its places.
  const double from = std::floor((time - TrailItem::seconds) * perSecond) / perSecond;
  const telemetry::TimeRange range{std::max(from, known->begin),
                                   std::min(time + rounding, known->end)};
  if (range.end < range.begin || !view->hasEveryRow(range)) return {};
  std::vector<telemetry::Sample> xs, ys;
  view->samples(x->column, range, xs);
  view->samples(y->column, range, ys);
  std::vector<TrailItem::Place> places;
  double last = -1.0;
  for (std::size_t i = 0; i < std::min(xs.size(), ys.size()); ++i) {
    const double step = std::floor((xs[i].time + rounding) * perSecond);
    if (std::exchange(last, step) != step) {
      const Point at{xs[i].value, ys[i].value};
      if (!std::isfinite(at.x) || !std::isfinite(at.y)) continue;
      const Pose pose = believed
                            ? sim::published_frame::studioFromLocalization(field, {at.x, at.y, 0.0})
                            : Pose{at, 0.0};
      places.push_back({pose.position, xs[i].time});
    }
  }
  return places;
}

}  // namespace

/// The ball where it really is.
class BallItem : public FieldItem {
 public:
  using FieldItem::FieldItem;

  void setBall(const Point& position) { setPos(toScene(position)); }
  void setSelected(bool selected);

  QRectF boundingRect() const override;
  void paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) override;

 private:
  bool m_selected = false;
};

void BallItem::setSelected(bool selected) {
  if (selected == m_selected) return;
  prepareGeometryChange();
  m_selected = selected;
  update();
}

QRectF BallItem::boundingRect() const {
  const double reach = m_style->ballDrawRadius() + m_style->metres(m_selected ? 8.0 : 2.0);
  return {-reach, -reach, 2 * reach, 2 * reach};
}

void BallItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  const ScreenPainting screen(painter, QPointF(0, 0));
  const double radius = std::max(m_style->field.ballRadius * screen.pixelsPerMetre(), 3.0);
  if (m_selected && m_style->ornaments) {
    painter->setPen(QPen(theme().accentLine, 2.0));
    painter->setBrush(Qt::NoBrush);
    painter->drawEllipse(QPointF(0, 0), radius + 5, radius + 5);
  }
  const QColor outline = isDarkTheme() ? QColor(16, 20, 24) : QColor(90, 45, 10);
  const QColor ball = theme().ball;
  drawStamp(painter, {}, {Stamp::Kind::Ball, stampSize(radius), ball.rgba(), outline.rgba(), {}},
            {radius + 2, radius + 2}, [&](QPainter& p) {
              p.setPen(QPen(outline, std::clamp(radius * 0.12, 1.0, 2.0)));
              p.setBrush(ball);
              p.drawEllipse(QPointF(0, 0), radius, radius);
            });
}

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
  nameHeight,
  toolHeight
};

constexpr double hitMargin_px = 3.0;
constexpr double heldOpacity = 0.6;

/// Stands out from the grass of both themes, and is no team's.
QColor explorationColor() {
  return {255, 214, 64};
}

}  // namespace

struct FieldScene::Robot {
  Robot(FieldScene* scene, RobotUid id)
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
      m_heldBall(new BallItem(&m_style)),
      m_teamBalls(new TeamBallsItem(&m_style)),
      m_drawings(std::make_unique<DrawingItems>(this, &m_style, drawingHeight)),
      m_heat(new HeatItem(&m_style)),
      m_eopra(new SectorItem(&m_style, SectorItem::Kind::Eopra)),
      m_starVars(new SectorItem(&m_style, SectorItem::Kind::StarVars)),
      m_names(new NameLabelsItem(&m_style)),
      m_ruler(new RulerItem(&m_style)),
      m_band(new RubberBandItem(&m_style)) {
  // Everything moves all the time: an index would cost more than it saves.
  setItemIndexMethod(QGraphicsScene::NoIndex);
  const std::pair<QGraphicsItem*, Height> items[] = {
      {m_ball, ballHeight},  {m_heldBall, toolHeight}, {m_teamBalls, ballHeight},
      {m_heat, heatHeight},  {m_eopra, sectorHeight},  {m_starVars, sectorHeight},
      {m_names, nameHeight}, {m_ruler, toolHeight},    {m_band, toolHeight}};
  for (const auto& [item, height] : items) {
    item->setZValue(height);
    item->setVisible(false);
    addItem(item);
  }
  m_heldBall->setOpacity(heldOpacity);
}

FieldScene::~FieldScene() = default;

void FieldScene::styleChanged() {
  for (QGraphicsItem* item : items()) {
    if (auto* shown = dynamic_cast<FieldItem*>(item)) shown->styleChanges();
  }
  if (m_frame) showFrame(m_frame);
  showHeat(m_heat->heat());
  showComparedNames();
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
  showWedges();
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

// Of the selected robots, or of all. Together they are as bright as one: five would be a white
// spot.
void FieldScene::showWedges() {
  int shown = 0;
  for (auto& [id, robot] : m_robots) {
    const link::RobotFrame* now = m_frame ? m_frame->robot(id) : nullptr;
    const bool selected =
        std::find(m_selection.begin(), m_selection.end(), id) != m_selection.end();
    // Where a robot that is received looks, it does not say.
    robot->wedge.setVisible(now && !now->link && m_style.shows(FieldLayer::FieldOfView) &&
                            (selected || m_style.wedgeForAll));
    shown += robot->wedge.isVisible();
  }
  for (auto& [id, robot] : m_robots) robot->wedge.setShare(1.0 / std::max(1, shown));
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
  }
}

void FieldScene::matchRobots() {
  std::set<RobotUid> present;
  for (const link::RobotFrame& robot : m_frame->robots) {
    const RobotUid id = robot.uid;
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

void FieldScene::showRobot(const link::RobotFrame& now) {
  const RobotUid id = now.uid;
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
    look.tag =
        now.penalty->isSubstitute() ? QStringLiteral("substitute") : QStringLiteral("penalised");
  }
  robot.body.setLook(look);
  robot.body.setVisible(now.poseKnown());

  showTrail(robot, now);
  robot.wedge.setCamera(now.fieldOfView, now.visionRange);
  robot.wedge.setHead(now.pose.position, now.headYaw);
  robot.belief.setVisible(now.boardKey || now.belief);
  robot.belief.setLook(beliefOf(now, m_style.field));
  showOtherPose(robot, now);
}

// Rows know the trail of any moment. What frames have shown is the trail only while they go on.
void FieldScene::showTrail(Robot& robot, const link::RobotFrame& now) {
  const bool shown = now.poseKnown() && m_style.shows(FieldLayer::Trails) && isTrailShown(now.uid);
  robot.trail.setVisible(shown);
  const double time = m_frame->snapshot.time, passed = time - robot.trail.now();
  constexpr double maxGap = 1.0;  // s; less than a step of the fastest replay
  const bool recorded = m_frame->origin == link::FrameOrigin::Recorded;
  const bool goesOn = passed >= 0.0 && passed <= maxGap;
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

void FieldScene::showCompared(int number, const FramePtr& frame) {
  auto known = m_compared.find(number);
  if (!frame) {
    if (known == m_compared.end()) return;
    delete known->second;
    m_compared.erase(known);
    showComparedNamesSoon();
    return;
  }
  if (known == m_compared.end()) {
    known = m_compared.emplace(number, new ComparedItem(&m_style, number)).first;
    known->second->setZValue(beliefHeight);
    addItem(known->second);
  }
  known->second->setFrame(frame);
  showComparedNamesSoon();
}

// Once for all sessions whose moments come together, and before they are painted.
void FieldScene::showComparedNamesSoon() {
  if (std::exchange(m_comparedMoved, true)) return;
  QMetaObject::invokeMethod(this, &FieldScene::showComparedNames, Qt::QueuedConnection);
}

// Robots of several sessions often stand at the same place.
void FieldScene::showComparedNames() {
  m_comparedMoved = false;
  std::vector<NamedRobot> robots;
  for (const auto& [number, item] : m_compared) item->addNamed(robots);
  std::map<RobotUid, QPointF> centres;
  for (const PlacedName& name : placeNamesBelow(robots, m_comparedNames)) {
    centres[name.id] = name.centre;
  }
  for (const auto& [number, item] : m_compared) item->placeNames(centres);
}

void FieldScene::showHeld(const std::vector<RobotPlacement>& robots, std::optional<Point> ball) {
  m_held.clear();
  for (const RobotPlacement& placement : robots) {
    const link::RobotFrame* robot = m_frame ? m_frame->robot(placement.id) : nullptr;
    if (robot == nullptr) continue;
    RobotLook look = m_robots.at(robot->uid)->body.look();
    look.pose = placement.to;
    look.opacity = heldOpacity;
    look.followed = false;
    auto& held = m_held.emplace_back(std::make_unique<RobotItem>(&m_style, robot->uid));
    held->setZValue(toolHeight);
    held->setLook(look);
    addItem(held.get());
  }
  m_heldBall->setVisible(ball.has_value());
  if (ball) m_heldBall->setBall(*ball);
}

void FieldScene::showHeat(const BallHeatPtr& heat) {
  m_heat->setHeat(heat, explorationColor());
  m_heat->setVisible(heat && m_style.shows(FieldLayer::Exploration));
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

void FieldScene::select(const std::vector<RobotUid>& ids) {
  std::vector<RobotUid> present;
  for (const RobotUid id : ids) {
    if (m_robots.contains(id)) present.push_back(id);
  }
  setSelection(std::move(present));
}

void FieldScene::selectAll() {
  std::vector<RobotUid> all;
  for (const auto& [id, robot] : m_robots) all.push_back(id);
  setSelection(std::move(all));
}

void FieldScene::toggle(RobotUid id) {
  std::vector<RobotUid> ids = m_selection;
  if (const auto found = std::find(ids.begin(), ids.end(), id); found != ids.end()) {
    ids.erase(found);
  } else {
    ids.push_back(id);
  }
  select(ids);
}

void FieldScene::setSelection(std::vector<RobotUid> ids) {
  if (ids == m_selection) return;
  m_selection = std::move(ids);
  for (auto& [id, robot] : m_robots) {
    RobotLook look = robot->body.look();
    look.selected = std::find(m_selection.begin(), m_selection.end(), id) != m_selection.end();
    robot->body.setLook(look);
  }
  showWedges();
  for (auto& [id, robot] : m_robots) robot->wedge.styleChanges();
  showDebugOverlay();
  if (m_style.drawings.onlySelected) m_drawings->show(m_frame.get(), m_selection);
  showSelected();
  emit selectionChangedTo(m_selection);
}

FieldHit FieldScene::hit(const QPointF& metres) const {
  const double margin = m_style.metres(hitMargin_px);
  if (!m_style.readOnly) {
    for (const RobotUid id : m_selection) {
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

std::vector<RobotUid> FieldScene::robotsIn(const QRectF& metres) const {
  std::vector<RobotUid> inside;
  for (const auto& [id, robot] : m_robots) {
    const RobotItem& body = robot->body;
    if (body.isVisible() && metres.contains(toScene(body.look().pose.position))) {
      inside.push_back(id);
    }
  }
  return inside;
}

std::optional<Pose> FieldScene::pose(RobotUid id) const {
  const auto found = m_robots.find(id);
  if (found == m_robots.end()) return {};
  return found->second->body.look().pose;
}

double FieldScene::radius(RobotUid id) const {
  const auto found = m_robots.find(id);
  const double own = found == m_robots.end() ? 0.0 : found->second->body.look().radius;
  return own > 0.0 ? own : m_style.field.robotRadius;
}

Point FieldScene::ball() const {
  return m_frame ? m_frame->snapshot.ball : Point{};
}

void FieldScene::setTrailShown(RobotUid id, bool shown) {
  if (shown) {
    m_hiddenTrails.erase(id);
  } else {
    m_hiddenTrails.insert(id);
  }
  if (m_frame) showFrame(m_frame);
}

void FieldScene::setFollowed(std::optional<RobotUid> id) {
  const bool there = !id || m_robots.contains(*id);
  if (!there) id.reset();
  if (id == m_followed && there) return;
  m_followed = id;
  if (m_frame) showFrame(m_frame);
  emit followedChanged(id);
}

}  // namespace pitchboard::ui
