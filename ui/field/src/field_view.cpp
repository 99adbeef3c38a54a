// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/field/field_view.h>

#include <QAction>
#include <QActionGroup>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QMenu>
#include <QToolBar>
#include <QToolButton>
#include <algorithm>
#include <array>
#include <numbers>

#include <ui/base/robot_words.h>
#include <ui/base/theme.h>
#include <ui/field/field_picture.h>
#include <ui/field/field_scene.h>

#include "field_canvas.h"
#include "field_keys.h"
#include "field_menu.h"
#include "field_pointer.h"
#include "help_overlay.h"
#include "pose_editor.h"

namespace pitchboard::ui {
namespace {

struct LayerText {
  const char* text;
  const char* key;  // shown only; the field handles its keys itself
};
constexpr std::array<LayerText, fieldLayerCount> layerTexts{{{"Field of view", "F6"},
                                                             {"Belief", ""},
                                                             {"Ghost at the believed pose", ""},
                                                             {"Perceived ball", ""},
                                                             {"Trails", ""},
                                                             {"Numbers", ""},
                                                             {"Coordinate grid", ""},
                                                             {"Landmarks", "F9"},
                                                             {"EOPRA sectors", "F7"},
                                                             {"StarVars sectors", "F8"},
                                                             {"Particles of localization", ""},
                                                             {"Planned path", ""}}};

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

constexpr double nudge_m = 0.01;
constexpr double coarseNudge_m = 0.10;

// X11 names of the right Shift key: its scan code on PC keyboards and its keysym.
constexpr quint32 rightShiftScanCode = 62;
constexpr quint32 rightShiftKeysym = 0xffe2;

}  // namespace

struct FieldView::Private : FieldKeyTarget {
  Private(FieldView* view, MatchController* matchController)
      : q(view),
        controller(matchController),
        scene(new FieldScene(view)),
        pointer(new FieldPointer(scene, matchController, view)),
        canvas(new FieldCanvas(scene, pointer, view)),
        help(new HelpOverlay(canvas)) {}

  void makeActions();
  void makeLayerOptions();
  void makeToolStrip();
  void showLayer(int layer, bool shown);
  void openPoseEditor(RobotId id);
  void openBallEditor();
  void openEditor(PoseEdit edit);
  void openMenu(QPoint globalPosition, QPointF metres);
  bool handleKey(QKeyEvent* event);
  /// Nothing can be moved in a match that is only watched.
  MatchController* editor() const { return scene->style().readOnly ? nullptr : controller; }
  void setReadOnly(bool readOnly);
  void addAtCursor(TeamColor color);

  // FieldKeyTarget
  void addRobotAtCursor(int color) override {
    addAtCursor(teamColors[static_cast<std::size_t>(color)].color);
  }
  void addRobotByShift() override {
    addAtCursor(rightShift ? TeamColor::Orange : TeamColor::Yellow);
  }
  void placeBallAtCursor() override {
    if (editor()) controller->moveBall(scene->ball(), fromScene(canvas->cursor()));
  }
  void selectRobot(int number) override { scene->select({RobotId{number}}); }
  void selectAll() override { scene->selectAll(); }
  void moveSelectedToCursor() override;
  void removeSelected() override {
    if (editor()) controller->removeRobots(scene->selection());
  }
  void commandSelected(int action, int actionB) override {
    if (!editor()) return;
    for (const RobotId id : scene->selection()) {
      controller->commandAction(id, action, actionB < 0 ? std::nullopt : std::optional(actionB));
    }
  }
  void searchSelected(bool on) override {
    if (!editor()) return;
    for (const RobotId id : scene->selection()) controller->commandSearch(id, on);
  }
  void nudgeSelected(int right, int up, bool coarse) override {
    const double step = (coarse ? coarseNudge_m : nudge_m) * (scene->style().flipped ? -1 : 1);
    pointer->nudge({right * step, up * step});
  }
  void toggleLayer(int layer) override { layers[static_cast<std::size_t>(layer)]->toggle(); }
  void escape() override {
    if (pointer->cancel()) return;
    if (pointer->tool() != FieldTool::Select) {
      pointer->setTool(FieldTool::Select);
    } else {
      scene->select({});
    }
  }
  void fit() override { canvas->fit(); }
  void toggleHelp() override { help->toggle(); }
  void togglePause() override {
    if (editor() && controller->frame()) controller->setPaused(!controller->frame()->paused);
  }
  void loadMatch() override {
    if (!scene->style().readOnly) emit q->loadMatchRequested();
  }
  void reset() override {
    if (!scene->style().readOnly) emit q->resetRequested();
  }
  void clear() override {
    if (!scene->style().readOnly) emit q->clearRequested();
  }

  FieldView* q;
  MatchController* controller;
  FieldScene* scene;
  FieldPointer* pointer;
  FieldCanvas* canvas;
  HelpOverlay* help;
  QToolBar* strip = nullptr;
  std::vector<QAction*> layers;
  std::vector<QAction*> layerOptions;
  std::vector<QAction*> tools;
  QAction* flip = nullptr;
  QAction* fitAction = nullptr;
  QAction* keys = nullptr;
  bool rightShift = false;
};

void FieldView::Private::makeActions() {
  for (int i = 0; i < fieldLayerCount; ++i) {
    const LayerText& text = layerTexts[static_cast<std::size_t>(i)];
    auto* action = new QAction(tr(text.text), q);
    action->setCheckable(true);
    action->setChecked(scene->style().layers[static_cast<std::size_t>(i)]);
    if (*text.key) action->setText(action->text() + QLatin1Char('\t') + QLatin1String(text.key));
    connect(action, &QAction::toggled, q, [this, i](bool on) { showLayer(i, on); });
    layers.push_back(action);
  }
  makeLayerOptions();
  auto* group = new QActionGroup(q);
  for (const ToolText& text : toolTexts) {
    auto* action = new QAction(themedIcon(QLatin1String(text.icon)), tr(text.text), group);
    action->setCheckable(true);
    action->setChecked(text.tool == pointer->tool());
    action->setToolTip(tr(text.tip));
    connect(action, &QAction::triggered, q, [this, tool = text.tool] { pointer->setTool(tool); });
    connect(pointer, &FieldPointer::toolChanged, action,
            [action, tool = text.tool](FieldTool chosen) { action->setChecked(chosen == tool); });
    tools.push_back(action);
  }
  flip = new QAction(themedIcon(QStringLiteral("object-flip-horizontal")), tr("Flip sides"), q);
  flip->setCheckable(true);
  flip->setToolTip(tr("See the field from the other side (Space)"));
  connect(flip, &QAction::toggled, q, [this](bool on) { canvas->setFlipped(on); });
  fitAction =
      new QAction(themedIcon(QStringLiteral("zoom-fit-best")), tr("Fit the field\tHome"), q);
  fitAction->setToolTip(tr("Fit the field (Home)"));
  connect(fitAction, &QAction::triggered, q, [this] { canvas->fit(); });
  keys = new QAction(themedIcon(QStringLiteral("help-contextual")), tr("Keys of the field\tF1"), q);
  keys->setToolTip(tr("All keys of the field (F1)"));
  connect(keys, &QAction::triggered, q, [this] { help->toggle(); });
}

void FieldView::Private::makeLayerOptions() {
  auto* all = new QAction(tr("Field of view of all robots"), q);
  all->setCheckable(true);
  all->setChecked(scene->style().wedgeForAll);
  connect(all, &QAction::toggled, q, [this](bool on) {
    scene->changeStyle([on](FieldStyle& style) { style.wedgeForAll = on; });
  });
  layerOptions.push_back(all);
  auto* group = new QActionGroup(q);
  for (const int granularity : {4, 6}) {
    auto* action = new QAction(tr("EOPRA granularity %1").arg(granularity), group);
    action->setCheckable(true);
    action->setChecked(scene->style().eopraGranularity == granularity);
    connect(action, &QAction::toggled, q, [this, granularity](bool on) {
      if (!on) return;
      scene->changeStyle(
          [granularity](FieldStyle& style) { style.eopraGranularity = granularity; });
    });
    layerOptions.push_back(action);
  }
}

void FieldView::Private::makeToolStrip() {
  strip = new QToolBar(q);
  strip->setObjectName(QStringLiteral("fieldTools"));
  strip->setOrientation(Qt::Vertical);
  const int icon = scaled(q, 18);
  strip->setIconSize(QSize(icon, icon));
  strip->setFixedWidth(scaled(q, 36));
  for (QAction* tool : tools) strip->addAction(tool);
  if (auto* button = qobject_cast<QToolButton*>(strip->widgetForAction(tools.back()))) {
    auto* teams = new QMenu(button);
    auto* group = new QActionGroup(teams);
    for (const TeamColorInfo& team : teamColors) {
      QString name =
          QString::fromLatin1(team.name.data(), static_cast<qsizetype>(team.name.size()));
      name[0] = name[0].toUpper();
      auto* action = teams->addAction(name, q, [this, color = team.color] {
        pointer->setTeam(color);
        pointer->setTool(FieldTool::Add);
      });
      action->setCheckable(true);
      action->setChecked(team.color == TeamColor::Blue);
      group->addAction(action);
    }
    button->setMenu(teams);
    button->setPopupMode(QToolButton::DelayedPopup);
  }
  strip->addSeparator();
  auto* layersButton = new QToolButton;
  layersButton->setIcon(themedIcon(QStringLiteral("layer-visible-on")));
  layersButton->setToolTip(tr("Layers: what the field shows"));
  layersButton->setAccessibleName(tr("Layers"));
  layersButton->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(layersButton);
  for (QAction* layer : layers) menu->addAction(layer);
  menu->addSeparator();
  for (QAction* option : layerOptions) menu->addAction(option);
  layersButton->setMenu(menu);
  strip->addWidget(layersButton);
  for (QAction* action : {flip, fitAction, keys}) strip->addAction(action);
}

void FieldView::Private::showLayer(int layer, bool shown) {
  scene->changeStyle(
      [&](FieldStyle& style) { style.layers[static_cast<std::size_t>(layer)] = shown; });
  canvas->viewport()->update();
}

void FieldView::Private::setReadOnly(bool readOnly) {
  if (scene->style().readOnly == readOnly) return;
  pointer->cancel();
  if (readOnly && pointer->tool() == FieldTool::Add) pointer->setTool(FieldTool::Select);
  scene->changeStyle([readOnly](FieldStyle& style) { style.readOnly = readOnly; });
  tools.back()->setEnabled(!readOnly);  // the one that adds robots
}

void FieldView::Private::addAtCursor(TeamColor color) {
  if (!editor()) return;
  controller->addRobot(
      color, {fromScene(canvas->cursor()), info(color).facesLeft ? std::numbers::pi : 0.0});
}

void FieldView::Private::moveSelectedToCursor() {
  if (!editor() || scene->selection().empty()) return;
  const auto first = scene->pose(scene->selection().front());
  const Point cursor = fromScene(canvas->cursor());
  // Several robots keep their formation round the first one.
  pointer->nudge({cursor.x - first->position.x, cursor.y - first->position.y});
}

void FieldView::Private::openPoseEditor(RobotId id) {
  const auto pose = scene->pose(id);
  if (!pose || !editor()) return;
  const link::RobotFrame* robot = scene->frame()->robot(id);
  const QString name = robot != nullptr ? robotName(robot->identity) : QString();
  openEditor({tr("Pose of %1").arg(name), *pose, true,
              [this, id, from = *pose](const Pose& to) {
                controller->previewRobots({{id, from, to}});
              },
              [this, id, from = *pose](const Pose& to) {
                controller->moveRobots({{id, from, to}});
              }});
}

void FieldView::Private::openBallEditor() {
  if (!editor() || !scene->frame()) return;
  const Point ball = scene->ball();
  openEditor({tr("Position of the ball"),
              {ball, 0.0},
              false,
              [this](const Pose& to) { controller->previewBall(to.position); },
              [this, ball](const Pose& to) { controller->moveBall(ball, to.position); }});
}

void FieldView::Private::openEditor(PoseEdit edit) {
  const QPointF beside = canvas->viewPointAt(toScene(edit.from.position)) + QPointF(24, 24);
  auto* editor = new PoseEditor(std::move(edit), scene->style().field, canvas);
  editor->adjustSize();
  editor->move(canvas->viewport()->mapToGlobal(beside.toPoint()));
  editor->show();
}

void FieldView::Private::openMenu(QPoint globalPosition, QPointF metres) {
  auto* menu = new QMenu(q);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  fillFieldMenu(menu, scene, controller, metres,
                {[this](RobotId id) { openPoseEditor(id); }, [this] { openBallEditor(); },
                 [this] { emit q->saveScenarioRequested(); }});
  if (menu->isEmpty()) {
    delete menu;
    return;
  }
  menu->popup(globalPosition);
}

bool FieldView::Private::handleKey(QKeyEvent* event) {
  if (event->key() == Qt::Key_Shift) {
    rightShift = event->nativeScanCode() == rightShiftScanCode ||
                 event->nativeVirtualKey() == rightShiftKeysym;
    return false;
  }
  const FieldKey* key = findFieldKey(event->key(), event->modifiers());
  if (!key) return false;
  key->act(*this);
  return true;
}

FieldView::FieldView(MatchController* controller, QWidget* parent)
    : FieldView(controller, controller, parent) {}

FieldView::FieldView(FrameSource* source, MatchController* controller, QWidget* parent)
    : QWidget(parent), d(std::make_unique<Private>(this, controller)) {
  d->makeActions();
  d->makeToolStrip();
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(d->strip);
  layout->addWidget(d->canvas, 1);
  setFocusProxy(d->canvas);
  d->canvas->setKeyHandler([this](QKeyEvent* event) { return d->handleKey(event); });
  connect(d->canvas, &FieldCanvas::cursorMoved, this, &FieldView::cursorMoved);
  connect(d->canvas, &FieldCanvas::menuRequested, this,
          [this](QPoint at, QPointF metres) { d->openMenu(at, metres); });
  connect(d->canvas, &FieldCanvas::spaceTapped, this, [this] { d->flip->toggle(); });
  connect(d->scene, &FieldScene::selectionChangedTo, this, &FieldView::selectionChanged);
  connect(d->pointer, &FieldPointer::poseRequested, this,
          [this](RobotId id) { d->openPoseEditor(id); });
  if (!source) return;
  connect(source, &FrameSource::frameReceived, this, [this, source](const FramePtr& frame) {
    // The past cannot be moved by hand.
    const bool past = frame && frame->origin == link::FrameOrigin::Recorded;
    d->setReadOnly(past || source->kind() != SourceKind::Simulate);
    showFrame(frame);
  });
  const auto begin = [this, source] {
    d->setReadOnly(source->kind() != SourceKind::Simulate);
    showFrame(source->frame());
  };
  connect(source, &FrameSource::restarted, this, begin);
  d->setReadOnly(source->kind() != SourceKind::Simulate);
  d->canvas->setEmptyText([source] {
    return source->kind() == SourceKind::Simulate ? QString() : source->emptyText();
  });
}

FieldView::~FieldView() {
  // The canvas asks the scene and the pointer until it is gone.
  delete d->canvas;
}

void FieldView::showFrame(const FramePtr& frame) {
  const bool otherField = frame && !(d->scene->style().field == frame->field);
  const bool wasEmpty = !d->scene->frame() || d->scene->frame()->robots.empty();
  d->scene->showFrame(frame);
  d->pointer->hold();
  if (otherField) d->canvas->fit();
  if (wasEmpty || !frame || frame->robots.empty()) d->canvas->viewport()->update();
  if (const auto id = d->scene->followed()) {
    if (const auto pose = d->scene->pose(*id)) d->canvas->centreOnMetres(toScene(pose->position));
  }
}

void FieldView::showOther(const FramePtr& frame) {
  d->scene->showOther(frame);
}
void FieldView::showCompared(const FramePtr& frame) {
  d->scene->showCompared(frame);
}

std::vector<RobotId> FieldView::selection() const {
  return d->scene->selection();
}
void FieldView::select(const std::vector<RobotId>& ids) {
  d->scene->select(ids);
}
void FieldView::follow(std::optional<RobotId> id) {
  d->scene->setFollowed(id);
}
std::optional<RobotId> FieldView::followed() const {
  return d->scene->followed();
}
std::vector<QAction*> FieldView::layerActions() const {
  return d->layers;
}

std::vector<QAction*> FieldView::layerOptionActions() const {
  return d->layerOptions;
}

std::vector<QAction*> FieldView::viewActions() const {
  std::vector<QAction*> actions = d->tools;
  for (QAction* action : {d->flip, d->fitAction, d->keys}) actions.push_back(action);
  return actions;
}

void FieldView::fitField() {
  d->canvas->fit();
}
void FieldView::setFlipped(bool flipped) {
  d->flip->setChecked(flipped);
}
bool FieldView::isFlipped() const {
  return d->flip->isChecked();
}

QImage FieldView::picture(QSize size) const {
  return paintPicture(*d->scene, size);
}
QByteArray FieldView::svgPicture(QSize size) const {
  return ui::svgPicture(*d->scene, size);
}
const FieldStyle& FieldView::style() const {
  return d->scene->style();
}

}  // namespace pitchboard::ui
