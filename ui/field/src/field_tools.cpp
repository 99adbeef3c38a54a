// SPDX-License-Identifier: GPL-3.0-or-later
#include "field_tools.h"

#include <QAction>
#include <QActionGroup>
#include <QMenu>
#include <QToolBar>
#include <QToolButton>
#include <array>

#include <ui/base/robot_words.h>
#include <ui/base/theme.h>

#include "drawings_menu.h"
#include "field_canvas.h"
#include "field_pointer.h"
#include "help_overlay.h"

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
                       HelpOverlay* help, QWidget* field)
    : QObject(field), m_scene(scene), m_pointer(pointer), m_canvas(canvas), m_help(help) {
  makeLayers();
  makeLayerOptions(field);
  makeTools();
  makeViews();
  makeStrip(field);
}

std::vector<QAction*> FieldTools::viewActions() const {
  std::vector<QAction*> actions = m_tools;
  for (QAction* action : {m_flip, m_fit, m_keys}) actions.push_back(action);
  return actions;
}

void FieldTools::makeLayers() {
  for (const FieldLayerInfo& layer : fieldLayers) {
    auto* action = new QAction(QString::fromUtf8(layer.name), this);
    action->setCheckable(true);
    action->setChecked(m_scene->style().shows(layer.layer));
    if (*layer.shortcut) {
      action->setText(action->text() + QLatin1Char('\t') + QLatin1String(layer.shortcut));
    }
    connect(action, &QAction::toggled, this,
            [this, which = layer.layer](bool on) { showLayer(which, on); });
    m_layers.push_back(action);
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
    m_tools.push_back(action);
  }
}

void FieldTools::makeViews() {
  m_flip = new QAction(themedIcon(QStringLiteral("object-flip-horizontal")),
                       QStringLiteral("Flip sides"), this);
  m_flip->setCheckable(true);
  m_flip->setToolTip(QStringLiteral("See the field from the other side (Space)"));
  connect(m_flip, &QAction::toggled, this, [this](bool on) { m_canvas->setFlipped(on); });
  m_fit = new QAction(themedIcon(QStringLiteral("zoom-fit-best")),
                      QStringLiteral("Fit the field\tHome"), this);
  m_fit->setToolTip(QStringLiteral("Fit the field (Home)"));
  connect(m_fit, &QAction::triggered, this, [this] { m_canvas->fit(); });
  m_keys = new QAction(themedIcon(QStringLiteral("help-contextual")),
                       QStringLiteral("Keys of the field\tF1"), this);
  m_keys->setToolTip(QStringLiteral("All keys of the field (F1)"));
  connect(m_keys, &QAction::triggered, this, [this] { m_help->toggle(); });
}

void FieldTools::makeLayerOptions(QWidget* field) {
  auto* all = new QAction(QStringLiteral("Field of view of all robots"), this);
  all->setObjectName(QStringLiteral("fieldOfViewOfAll"));
  all->setCheckable(true);
  all->setChecked(m_scene->style().wedgeForAll);
  connect(all, &QAction::toggled, this, [this](bool on) {
    m_scene->changeStyle([on](FieldStyle& style) { style.wedgeForAll = on; });
  });
  m_layerOptions.push_back(all);
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
    m_layerOptions.push_back(action);
  }
  m_drawings =
      new DrawingsMenu(m_scene, m_layers[static_cast<std::size_t>(FieldLayer::Drawings)], field);
  m_drawings->menuAction()->setText(QStringLiteral("Drawings of robots' programs"));
  m_layerOptions.push_back(m_drawings->menuAction());
}

void FieldTools::makeStrip(QWidget* field) {
  m_strip = new QToolBar(field);
  m_strip->setObjectName(QStringLiteral("fieldTools"));
  m_strip->setOrientation(Qt::Vertical);
  const int icon = scaled(field, 18);
  m_strip->setIconSize(QSize(icon, icon));
  m_strip->setFixedWidth(scaled(field, 36));
  for (QAction* tool : m_tools) m_strip->addAction(tool);
  addTeams();
  m_strip->addSeparator();
  addLayersButton();
  for (QAction* action : {m_flip, m_fit, m_keys}) m_strip->addAction(action);
}

void FieldTools::addTeams() {
  auto* button = qobject_cast<QToolButton*>(m_strip->widgetForAction(m_tools.back()));
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

void FieldTools::addLayersButton() {
  auto* layersButton = new QToolButton;
  layersButton->setIcon(themedIcon(QStringLiteral("layer-visible-on")));
  layersButton->setToolTip(QStringLiteral("Layers: what the field shows"));
  layersButton->setAccessibleName(QStringLiteral("Layers"));
  layersButton->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(layersButton);
  for (QAction* layer : m_layers) menu->addAction(layer);
  menu->addSeparator();
  for (QAction* option : m_layerOptions) menu->addAction(option);
  layersButton->setMenu(menu);
  m_strip->addWidget(layersButton);
}

void FieldTools::showLayer(FieldLayer layer, bool shown) {
  m_scene->changeStyle(
      [&](FieldStyle& style) { style.layers[static_cast<std::size_t>(layer)] = shown; });
  m_canvas->viewport()->update();
}

}  // namespace pitchboard::ui
