// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawings_menu.h"

#include <algorithm>
#include <set>
#include <string>

#include <robotlink/frame/match_frame.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>

#include "field_scene.h"

namespace pitchboard::ui {
namespace {

QString nameOf(const link::MatchFrame* frame, const RobotKey& robot) {
  const link::RobotFrame* known = frame ? frame->robot(robot) : nullptr;
  return QString::fromStdString(
      known ? known->name : link::robotName(robot, frame ? frame->teams : link::Teams()));
}

/// What is drawn now, and what cannot be seen because it was switched off.
std::map<RobotKey, std::set<std::string>> drawnLayers(const FieldScene& scene) {
  std::map<RobotKey, std::set<std::string>> all;
  const DrawingChoice& choice = scene.style().drawings;
  for (const RobotKey& robot : choice.hiddenRobots) all[robot];
  for (const auto& [robot, layer] : choice.hidden) all[robot].insert(layer);
  if (!scene.frame()) return all;
  for (const telemetry::RobotDrawings& robot : scene.frame()->drawings) {
    for (const auto& layer : robot.layers) all[robot.robot].insert(layer->name);
  }
  return all;
}

template <class Set, class Value>
void setMember(Set& set, const Value& value, bool in) {
  if (in) {
    set.insert(value);
  } else {
    set.erase(value);
  }
}

}  // namespace

DrawingsMenu::DrawingsMenu(FieldScene* scene, QAction* show, QWidget* parent)
    : QMenu(QStringLiteral("Drawings"), parent), m_scene(scene), m_show(show) {
  setIcon(themedIcon(QStringLiteral("draw-freehand")));
  addAction(show);
  connect(this, &QMenu::aboutToShow, this, &DrawingsMenu::fill);
}

void DrawingsMenu::fill() {
  qDeleteAll(std::exchange(m_made, {}));  // with their entries in this menu
  for (QAction* action : actions()) {
    if (action != m_show) delete action;
  }
  QAction* selected = addAction(QStringLiteral("Selected robots only"));
  selected->setCheckable(true);
  selected->setChecked(m_scene->style().drawings.onlySelected);
  connect(selected, &QAction::toggled, this, [this](bool on) {
    m_scene->changeStyle([on](FieldStyle& style) { style.drawings.onlySelected = on; });
  });
  addLayers();
  addRobots();
  const link::MatchFrame* frame = m_scene->frame().get();
  const bool none = drawnLayers(*m_scene).empty();
  addSeparator();
  if (none) {
    addAction(QStringLiteral("No program is sending drawings (see docs/drawings.md)"))
        ->setEnabled(false);
  }
  if (frame != nullptr && !frame->drawingProblem.empty()) {
    addAction(QStringLiteral("Not drawn: %1").arg(QString::fromStdString(frame->drawingProblem)))
        ->setEnabled(false);
  }
}

void DrawingsMenu::addLayers() {
  std::set<std::string> names = m_scene->style().drawings.hiddenLayers;
  for (const auto& [robot, layers] : drawnLayers(*m_scene)) {
    names.insert(layers.begin(), layers.end());
  }
  if (names.empty()) return;
  addSection(QStringLiteral("Layers of all robots"));
  for (const std::string& name : names) {
    QAction* action = addAction(QString::fromStdString(name));
    action->setCheckable(true);
    action->setChecked(!m_scene->style().drawings.hiddenLayers.contains(name));
    connect(action, &QAction::toggled, this, [this, name](bool on) {
      m_scene->changeStyle(
          [&](FieldStyle& style) { setMember(style.drawings.hiddenLayers, name, !on); });
    });
  }
}

void DrawingsMenu::addRobots() {
  const auto robots = drawnLayers(*m_scene);
  if (robots.empty()) return;
  addSection(QStringLiteral("Robots"));
  for (const auto& [robot, layers] : robots) {
    QMenu* menu = addMenu(nameOf(m_scene->frame().get(), robot));
    m_made.push_back(menu);
    QAction* all = menu->addAction(QStringLiteral("Drawings of this robot"));
    all->setCheckable(true);
    all->setChecked(!m_scene->style().drawings.hiddenRobots.contains(robot));
    connect(all, &QAction::toggled, this, [this, key = robot](bool on) {
      m_scene->changeStyle(
          [&](FieldStyle& style) { setMember(style.drawings.hiddenRobots, key, !on); });
    });
    menu->addSeparator();
    for (const std::string& name : layers) {
      QAction* action = menu->addAction(QString::fromStdString(name));
      action->setCheckable(true);
      const std::pair key(robot, name);
      action->setChecked(!m_scene->style().drawings.hidden.contains(key));
      connect(action, &QAction::toggled, this, [this, key](bool on) {
        m_scene->changeStyle(
            [&](FieldStyle& style) { setMember(style.drawings.hidden, key, !on); });
      });
    }
  }
}

}  // namespace pitchboard::ui
