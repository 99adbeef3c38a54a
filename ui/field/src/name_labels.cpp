// SPDX-License-Identifier: GPL-3.0-or-later
#include "name_labels.h"

#include <QFontMetricsF>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <ui/base/quick_painting.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {

constexpr double covered = 0.55;  // of the radius: where the number stands
constexpr double gap_px = 3.0;
constexpr std::array<double, 4> steps_px{0.0, 12.0, 26.0, 44.0};
constexpr std::size_t tagSteps = 2;  // no line leads to a tag
constexpr int below = 1;             // of the directions
constexpr double nose = 0.7;         // of the radius: how far it reaches beyond the disc
constexpr int namePixels = 10;
const double diagonal = std::sqrt(0.5);

const std::array<QPointF, 8> directions{QPointF(0, -1),
                                        QPointF(0, 1),
                                        QPointF(1, 0),
                                        QPointF(-1, 0),
                                        QPointF(diagonal, -diagonal),
                                        QPointF(-diagonal, -diagonal),
                                        QPointF(diagonal, diagonal),
                                        QPointF(-diagonal, diagonal)};

bool needsName(const NamedRobot& robot, std::span<const NamedRobot> all) {
  if (robot.radius < readable_px) return true;
  return std::ranges::any_of(all, [&robot](const NamedRobot& other) {
    return other.id != robot.id &&
           distance(other.at, robot.at) < other.radius + covered * robot.radius;
  });
}

QRectF boxOf(const QPointF& centre, const QSizeF& size) {
  return {centre.x() - size.width() / 2, centre.y() - size.height() / 2, size.width(),
          size.height()};
}

/// How much of a box lies on discs and on other names, in pixels of length.
double overlap(const QRectF& box, std::span<const NamedRobot> robots,
               const std::vector<QRectF>& taken) {
  double sum = 0.0;
  for (const NamedRobot& robot : robots) {
    const QPointF nearest(std::clamp(robot.at.x(), box.left(), box.right()),
                          std::clamp(robot.at.y(), box.top(), box.bottom()));
    sum += std::max(0.0, robot.radius - distance(nearest, robot.at));
  }
  for (const QRectF& other : taken) {
    const QRectF both = box & other;
    if (!both.isEmpty()) sum += both.width() + both.height();
  }
  return sum;
}

/// Looks for boxes beside robots, one after the other.
struct Search {
  std::span<const NamedRobot> robots;
  QRectF area;  ///< null: everywhere
  std::vector<QRectF> taken;
  std::size_t steps;

  /// The box that covers least, and its direction and step; `first` is tried before all others.
  std::pair<QRectF, int> place(const NamedRobot& robot, const QSizeF& size, double gap, int first) {
    const int count = static_cast<int>(directions.size() * steps);
    int best = first;
    double least = std::numeric_limits<double>::infinity();
    QRectF bestBox;
    for (int i = -1; i < count && least > 0.0; ++i) {
      const int choice = i < 0 ? first : i;
      const QPointF& direction = directions[static_cast<std::size_t>(choice) % directions.size()];
      const double step = steps_px[static_cast<std::size_t>(choice) / directions.size()];
      const double away = robot.radius + gap + step + std::abs(direction.x()) * size.width() / 2 +
                          std::abs(direction.y()) * size.height() / 2;
      const QRectF box = boxOf(robot.at + direction * away, size);
      const QRectF seen = area.isNull() ? box : box & area;
      const double over =
          overlap(box, robots, taken) + box.width() - seen.width() + box.height() - seen.height();
      if (over >= least) continue;
      least = over;
      best = choice;
      bestBox = box;
    }
    taken.push_back(bestBox);
    return {bestBox, best};
  }
};

/// The robot `first` and those beside it, or beside one of those, of which the same is said.
std::vector<const NamedRobot*> sharing(std::span<const NamedRobot> robots,
                                       const NamedRobot& first) {
  std::vector<const NamedRobot*> group{&first};
  if (first.tagText.isEmpty()) return group;
  for (std::size_t i = 0; i < group.size(); ++i) {
    for (const NamedRobot& robot : robots) {
      const QPointF apart = robot.at - group[i]->at;
      const bool isBeside = std::abs(apart.x()) < first.tag.width() &&
                            std::abs(apart.y()) < first.tag.height() + 2 * first.radius;
      if (robot.tagText == first.tagText && isBeside &&
          std::ranges::find(group, &robot) == group.end()) {
        group.push_back(&robot);
      }
    }
  }
  return group;
}

const QFont& nameFont() {
  return fieldFont(namePixels, true);
}

}  // namespace

std::vector<PlacedName> placeTags(std::span<const NamedRobot> robots, const QRectF& area,
                                  DirectionsBefore& before) {
  std::vector<PlacedName> placed;
  Search search{robots, area, {}, tagSteps};
  DirectionsBefore kept;
  std::vector<RobotUid> done;
  for (const NamedRobot& robot : robots) {
    if (robot.tag.isEmpty() || std::ranges::find(done, robot.id) != done.end()) continue;
    NamedRobot middle = robot;
    middle.at = QPointF();
    const std::vector<const NamedRobot*> group = sharing(robots, robot);
    for (const NamedRobot* one : group) {
      middle.at += one->at / static_cast<double>(group.size());
      done.push_back(one->id);
    }
    const auto known = before.find(robot.id);
    const int first = known == before.end() ? below : known->second;
    const auto [box, direction] =
        search.place(middle, robot.tag, nose * robot.radius + gap_px, first);
    kept[robot.id] = direction;
    placed.push_back({robot.id, box.center(), false});
  }
  before = std::move(kept);
  return placed;
}

std::vector<PlacedName> placeNames(std::span<const NamedRobot> robots, const QRectF& area,
                                   DirectionsBefore& before, std::vector<QRectF> taken) {
  std::vector<PlacedName> placed;
  Search search{robots, area, std::move(taken), steps_px.size()};
  DirectionsBefore kept;
  for (const NamedRobot& robot : robots) {
    if (robot.name.isEmpty() || !needsName(robot, robots)) continue;
    const auto known = before.find(robot.id);
    const auto [box, direction] =
        search.place(robot, robot.name, gap_px, known == before.end() ? 0 : known->second);
    kept[robot.id] = direction;
    placed.push_back(
        {robot.id, box.center(), static_cast<std::size_t>(direction) >= directions.size()});
  }
  before = std::move(kept);
  return placed;
}

std::vector<PlacedName> placeNamesBelow(std::span<const NamedRobot> robots,
                                        DirectionsBefore& before) {
  std::vector<PlacedName> placed;
  Search search{{}, {}, {}, tagSteps};
  DirectionsBefore kept;
  for (const NamedRobot& robot : robots) {
    const auto known = before.find(robot.id);
    const auto [box, direction] =
        search.place(robot, robot.name, gap_px, known == before.end() ? below : known->second);
    kept[robot.id] = direction;
    placed.push_back({robot.id, box.center(), false});
  }
  before = std::move(kept);
  return placed;
}

void NameLabelsItem::setRobots(std::vector<Robot> robots) {
  m_robots = std::move(robots);
  place();
}

void NameLabelsItem::place() {
  const double scale = m_style->pixelsPerMetre;
  const double side = m_style->flipped ? -1.0 : 1.0;
  const QFontMetricsF metrics(nameFont());
  std::vector<NamedRobot> named;
  named.reserve(m_robots.size());
  for (const Robot& robot : m_robots) {
    const QSizeF name(textLineWidth(nameFont(), robot.name) + 2, metrics.ascent());
    named.push_back({robot.id,
                     {side * robot.at.x() * scale, -side * robot.at.y() * scale},
                     robot.radius * scale,
                     robot.name.isEmpty() ? QSizeF() : name,
                     robot.tag.isEmpty() ? QSizeF() : plateSize(robot.tag),
                     robot.tag});
  }
  const QRectF field = m_style->playingArea();
  const QRectF area = QRectF(side * field.left() * scale, -side * field.top() * scale,
                             side * field.width() * scale, -side * field.height() * scale)
                          .normalized();
  m_tags.clear();
  std::vector<QRectF> taken;
  for (const PlacedName& tag : placeTags(named, area, m_tagsBefore)) {
    const auto robot = std::ranges::find(named, tag.id, &NamedRobot::id);
    m_tags[tag.id] = tag.centre - robot->at;
    taken.push_back(boxOf(tag.centre, robot->tag));
  }
  std::vector<Label> labels;
  for (const PlacedName& name : placeNames(named, area, m_before, std::move(taken))) {
    const auto robot = std::ranges::find(m_robots, name.id, &Robot::id);
    const auto screen = std::ranges::find(named, name.id, &NamedRobot::id);
    labels.push_back(
        {robot->at, screen->radius, name.centre - screen->at, name.apart, robot->name});
  }
  QRectF bounds;
  for (const Label& label : labels) {
    const double reach =
        m_style->metres(std::hypot(label.offset.x(), label.offset.y()) +
                        textLineWidth(nameFont(), label.name) / 2 + metrics.height() / 2 + 6.0);
    bounds |= QRectF(label.robot.x() - reach, label.robot.y() - reach, 2 * reach, 2 * reach);
  }
  if (labels.empty() && m_labels.empty()) return;
  prepareGeometryChange();
  m_labels = std::move(labels);
  m_bounds = bounds;
  update();
}

void NameLabelsItem::paint(QPainter* painter, const QStyleOptionGraphicsItem*, QWidget*) {
  const QColor line = theme().fieldLines,
               shade = theme().fieldBorder.darker(isDarkTheme() ? 160 : 200);
  for (const Label& label : m_labels) {
    const ScreenPainting screen(painter, label.robot);
    const double away = std::hypot(label.offset.x(), label.offset.y());
    if (label.apart && away > label.radius) {
      painter->setPen(QPen(line, 1.0));
      painter->drawLine(label.offset * (label.radius / away), label.offset * 0.9);
    }
    drawHaloText(painter, label.offset, label.name, nameFont(), line, shade);
  }
}

}  // namespace pitchboard::ui
