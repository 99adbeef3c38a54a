// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_tools.h"

#include <QAction>
#include <QActionGroup>
#include <QMenu>
#include <QToolBar>
#include <QToolButton>
#include <array>

#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/sources/note_board.h>

#include "drawings_menu.h"
#include "field_canvas.h"
#include "field_pointer.h"

namespace pitchboard::ui {
namespace {

struct ToolText {
  FieldTool tool;
  const char* icon;
  const char* text;
  const char* tip;
};
constexpr std::array<ToolText, 3> toolTexts{{
    {FieldTool::Select, "edit-select", "Select and move", "Select, drag and turn robots"},
    {FieldTool::Ruler, "measure", "Ruler", "Measure distance and direction by dragging"},
    {FieldTool::Add, "list-add", "Add robots", "Click to add a robot; hold for its team"},
}};

}  // namespace

FieldTools::FieldTools(FieldScene* scene, FieldPointer* pointer, FieldCanvas* canvas,
                       QWidget* field)
    : QObject(field), m_scene(scene), m_pointer(pointer), m_canvas(canvas) {
  makeLayers();
  makeLayerOptions(field);
  makeTools();
  makeViews();
  makeStrip(field);
}

void FieldTools::makeLayers() {
  for (const FieldLayerInfo& layer : fieldLayers) {
    auto* action = new QAction(QString::fromUtf8(layer.name), this);
    action->setCheckable(true);
    action->setChecked(m_scene->style().shows(layer.layer));
    action->setObjectName(QStringLiteral("layer.") + QLatin1String(layer.key));
    connect(action, &QAction::toggled, this,
            [this, which = layer.layer](bool on) { showLayer(which, on); });
    m_actions.layers.push_back(action);
  }
}

void FieldTools::makeTools() {
  auto* group = new QActionGroup(this);
  for (const ToolText& text : toolTexts) {
    auto* action =
        new QAction(themedIcon(QLatin1String(text.icon)), QString::fromUtf8(text.text), group);
    action->setCheckable(true);
    action->setChecked(text.tool == m_pointer->tool());
    action->setToolTip(QString::fromUtf8(text.tip));
    connect(action, &QAction::triggered, this,
            [this, tool = text.tool] { m_pointer->setTool(tool); });
    connect(m_pointer, &FieldPointer::toolChanged, action,
            [action, tool = text.tool](FieldTool chosen) { action->setChecked(chosen == tool); });
    m_actions.tools.push_back(action);
  }
  m_adding = m_actions.tools.back();
}

void FieldTools::makeViews() {
  const auto make = [this](const char* id, const char* icon, const char* text, const char* tip) {
    auto* action = new QAction(themedIcon(QLatin1String(icon)), QString::fromUtf8(text), this);
    action->setObjectName(QLatin1String(id));
    action->setToolTip(QString::fromUtf8(tip));
    return action;
  };
  m_actions.flip = make("flipSides", "object-flip-horizontal", "Flip sides",
                        "View the field from the other side");
  m_actions.flip->setCheckable(true);
  connect(m_actions.flip, &QAction::toggled, this, [this](bool on) { m_canvas->setFlipped(on); });
  m_actions.fit = make("fitField", "zoom-fit-best", "Fit field", "Show the whole field");
  connect(m_actions.fit, &QAction::triggered, this, [this] { m_canvas->fit(); });
  m_actions.publishedKeys = make("publishedKeys", "input-keyboard", "Published keys",
                                 "Letter keys command robots as in the published simulator, even "
                                 "when another panel has the focus");
  m_actions.publishedKeys->setCheckable(true);
  m_actions.showKeys = make("showKeys", "help-contextual", "Show keys", "Show all keys");
}

void FieldTools::makeLayerOptions(QWidget* field) {
  auto* all = new QAction(QStringLiteral("Field of view of all robots"), this);
  all->setObjectName(QStringLiteral("fieldOfViewOfAll"));
  all->setCheckable(true);
  all->setChecked(m_scene->style().wedgeForAll);
  connect(all, &QAction::toggled, this, [this](bool on) {
    m_scene->changeStyle([on](FieldStyle& style) { style.wedgeForAll = on; });
  });
  m_actions.options.push_back(all);
  auto* group = new QActionGroup(this);
  for (const int granularity : {4, 6}) {
    auto* action = new QAction(QStringLiteral("EOPRA granularity %1").arg(granularity), group);
    action->setObjectName(QStringLiteral("eopra%1").arg(granularity));
    action->setCheckable(true);
    action->setChecked(m_scene->style().eopraGranularity == granularity);
    connect(action, &QAction::toggled, this, [this, granularity](bool on) {
      if (!on) return;
      m_scene->changeStyle(
          [granularity](FieldStyle& style) { style.eopraGranularity = granularity; });
    });
    m_actions.options.push_back(action);
  }
  m_drawings = new DrawingsMenu(
      m_scene, m_actions.layers[static_cast<std::size_t>(FieldLayer::Drawings)], field);
  m_drawings->menuAction()->setText(QStringLiteral("Drawings from the robots' programs"));
  m_actions.options.push_back(m_drawings->menuAction());
}

void FieldTools::makeStrip(QWidget* field) {
  m_strip = new QToolBar(field);
  m_strip->setObjectName(QStringLiteral("fieldTools"));
  m_strip->setOrientation(Qt::Vertical);
  const int icon = scaled(field, 18);
  m_strip->setIconSize(QSize(icon, icon));
  m_strip->setFixedWidth(scaled(field, 36));
  for (QAction* action : m_actions.tools) m_strip->addAction(action);
  addTeams();
  m_strip->addSeparator();
  m_afterTools = addLayersButton();
  m_strip->addActions({m_actions.flip, m_actions.fit, m_actions.publishedKeys, m_actions.showKeys});
}

void FieldTools::addNotes(NoteBoard& board) {
  for (QAction* tool : board.tools()) m_strip->insertAction(m_afterTools, tool);
  m_strip->insertSeparator(m_afterTools);
  for (QAction* tool : m_actions.tools) {
    connect(tool, &QAction::triggered, &board, [&board] { board.setTool({}); });
  }
}

void FieldTools::addTeams() {
  auto* button = qobject_cast<QToolButton*>(m_strip->widgetForAction(m_adding));
  if (button == nullptr) return;
  auto* teams = new QMenu(button);
  auto* group = new QActionGroup(teams);
  for (const TeamColorInfo& team : teamColors) {
    auto* action = teams->addAction(capitalised(team.name), this, [this, color = team.color] {
      m_pointer->setTeam(color);
      m_pointer->setTool(FieldTool::Add);
    });
    action->setCheckable(true);
    action->setChecked(team.color == TeamColor::Blue);
    group->addAction(action);
  }
  button->setMenu(teams);
  button->setPopupMode(QToolButton::DelayedPopup);
}

QAction* FieldTools::addLayersButton() {
  auto* layersButton = new QToolButton;
  layersButton->setIcon(themedIcon(QStringLiteral("layer-visible-on")));
  layersButton->setToolTip(QStringLiteral("Choose what the field shows"));
  layersButton->setAccessibleName(QStringLiteral("Layers"));
  layersButton->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(layersButton);
  for (QAction* layer : m_actions.layers) menu->addAction(layer);
  menu->addSeparator();
  for (QAction* option : m_actions.options) menu->addAction(option);
  layersButton->setMenu(menu);
  return m_strip->addWidget(layersButton);
}

void FieldTools::showLayer(FieldLayer layer, bool shown) {
  m_scene->changeStyle(
      [&](FieldStyle& style) { style.layers[static_cast<std::size_t>(layer)] = shown; });
  m_canvas->viewport()->update();
}

}  // namespace pitchboard::ui
