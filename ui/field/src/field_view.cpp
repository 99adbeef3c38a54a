// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/field/field_view.h>

#include <QAction>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QMenu>
#include <QToolBar>
#include <algorithm>
#include <numbers>

#include <ui/base/action_reason.h>
#include <ui/base/robot_text.h>
#include <ui/base/theme.h>
#include <ui/field/field_keys.h>
#include <ui/sources/match_edits.h>
#include <ui/sources/note_board.h>
#include <ui/sources/note_layer.h>
#include "field_picture.h"
#include "field_scene.h"

#include "field_canvas.h"
#include "field_menu.h"
#include "field_pointer.h"
#include "field_tools.h"
#include "hover_text.h"
#include "pose_editor.h"

namespace pitchboard::ui {
namespace {

// X11 names of the right Shift key: its scan code on PC keyboards and its keysym.
constexpr quint32 rightShiftScanCode = 62;
constexpr quint32 rightShiftKeysym = 0xffe2;

}  // namespace

struct FieldView::Private {
  Private(FieldView* view, MatchController* matchController)
      : q(view),
        controller(matchController),
        scene(new FieldScene(view)),
        pointer(new FieldPointer(scene, matchController, view)),
        canvas(new FieldCanvas(scene, pointer, view)),
        tools(new FieldTools(scene, pointer, canvas, view)) {}

  void openPoseEditor(RobotUid id);
  void openBallEditor();
  void openEditor(PoseEdit edit);
  void openMenu(QPoint globalPosition, QPointF metres);
  FieldMenuActions menuActions();
  /// Null in a match that is only watched; says why while the past is shown.
  MatchController* editor() const {
    if (!scene->style().readOnly) return controller;
    if (controller) controller->edits()->allowsChange();
    return nullptr;
  }
  /// `whyNot`: why nothing can be changed; empty: it can.
  void setReadOnly(const QString& whyNot);
  void addAtCursor(TeamColor color);
  void moveSelectedToCursor();
  void carryOut(const FieldOrder& order);

  FieldView* q;
  MatchController* controller;
  FieldScene* scene;
  FieldPointer* pointer;
  FieldCanvas* canvas;
  FieldTools* tools;
  NoteBoard* board = nullptr;
  std::vector<telemetry::DrawnNote> drawnNotes;  // of pictures
  bool rightShift = false;
};

void FieldView::Private::setReadOnly(const QString& whyNot) {
  enableUnless(*tools->adding(), whyNot);
  const bool readOnly = !whyNot.isEmpty();
  if (scene->style().readOnly == readOnly) return;
  pointer->cancel();
  if (readOnly && pointer->tool() == FieldTool::Add) pointer->setTool(FieldTool::Select);
  scene->changeStyle([readOnly](FieldStyle& style) { style.readOnly = readOnly; });
}

void FieldView::Private::addAtCursor(TeamColor color) {
  controller->edits()->addRobot(
      color, {fromScene(canvas->cursor()), info(color).facesLeft ? std::numbers::pi : 0.0});
}

void FieldView::Private::moveSelectedToCursor() {
  const auto first = scene->pose(scene->selection().front());
  const Point cursor = fromScene(canvas->cursor());
  // Several robots keep their formation round the first one.
  pointer->nudge({cursor.x - first->position.x, cursor.y - first->position.y});
}

void FieldView::Private::carryOut(const FieldOrder& order) {
  const std::vector<RobotId> selected = scene->selectedSlots();
  using enum FieldAction;
  const bool forSelected =
      order.action == MoveHere || order.action == Act || order.action == Search;
  if (forSelected && scene->selection().empty()) return;
  if (order.action >= AddRobot && !editor()) return;
  MatchEdits* edits = controller ? controller->edits() : nullptr;
  switch (order.action) {
    case Select:
      return q->selectNumber(order.value);
    case AddRobot:
      return addAtCursor(teamColors[static_cast<std::size_t>(order.value)].color);
    case AddRobotByShift:
      return addAtCursor(rightShift ? TeamColor::Orange : TeamColor::Yellow);
    case PlaceBall:
      return edits->moveBall(fromScene(canvas->cursor()));
    case MoveHere:
      return moveSelectedToCursor();
    case Act:
      for (const RobotId id : selected) {
        edits->commandAction(id, order.value,
                             order.other < 0 ? std::nullopt : std::optional(order.other));
      }
      return;
    case Search:
      for (const RobotId id : selected) edits->commandSearch(id, order.value != 0);
      return;
    case LoadMatch:
      return emit q->loadMatchRequested();
    case Reset:
      return emit q->resetRequested();
    case Clear:
      return emit q->clearRequested();
  }
}

void FieldView::Private::openPoseEditor(RobotUid id) {
  const auto pose = scene->pose(id);
  if (!pose || !editor()) return;
  const link::RobotFrame* robot = scene->frame()->robot(id);
  if (robot == nullptr) return;
  openEditor({QStringLiteral("Pose of %1").arg(robotName(*robot)), *pose, false, 0.0,
              [this, slot = robot->slot(), from = *pose](const std::optional<Pose>& to) {
                scene->showHeld(to ? std::vector{RobotPlacement{slot, from, *to}}
                                   : std::vector<RobotPlacement>());
              },
              [this, slot = robot->slot(), from = *pose](const Pose& to, double) {
                controller->edits()->moveRobots({{slot, from, to}});
              }});
}

void FieldView::Private::openBallEditor() {
  if (!editor() || !scene->frame()) return;
  const Point ball = scene->ball();
  const Velocity& v = scene->frame()->snapshot.ballVelocity;
  openEditor({QStringLiteral("Ball position and speed"),
              {ball, std::atan2(v.y, v.x)},
              true,
              std::hypot(v.x, v.y),
              [this](const std::optional<Pose>& to) {
                scene->showHeld({}, to ? std::optional(to->position) : std::nullopt);
              },
              [this](const Pose& to, double speed) {
                controller->edits()->moveBall(to.position,
                                              {speed * std::cos(to.yaw), speed * std::sin(to.yaw)});
              }});
}

void FieldView::Private::openEditor(PoseEdit edit) {
  const QPointF beside = canvas->viewPointAt(toScene(edit.from.position)) + QPointF(24, 24);
  auto* editor = new PoseEditor(std::move(edit), scene->style().field, canvas);
  editor->adjustSize();
  editor->move(canvas->viewport()->mapToGlobal(beside.toPoint()));
  editor->show();
}

FieldMenuActions FieldView::Private::menuActions() {
  return {[this](RobotUid id) { openPoseEditor(id); },
          [this](RobotUid id) { emit q->blackboardRequested(id); }, [this] { openBallEditor(); },
          [this] { emit q->saveScenarioRequested(); }};
}

void FieldView::Private::openMenu(QPoint globalPosition, QPointF metres) {
  auto* menu = new QMenu(q);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  fillFieldMenu(menu, scene, controller, metres, menuActions());
  if (board != nullptr) {
    menu->addSeparator();
    addNoteTools(menu, *board);
  }
  if (menu->isEmpty()) {
    delete menu;
    return;
  }
  menu->popup(globalPosition);
}

FieldView::FieldView(MatchController* controller, QWidget* parent)
    : FieldView(controller, controller, parent) {}

FieldView::FieldView(FrameSource* source, MatchController* controller, QWidget* parent)
    : QWidget(parent), d(std::make_unique<Private>(this, controller)) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(d->tools->strip());
  layout->addWidget(d->canvas, 1);
  setFocusProxy(d->canvas);
  d->canvas->setHoverText([this](const QPointF& metres) {
    const FieldHit hit = d->scene->hit(metres);
    if (hit.kind == FieldHit::Kind::Ball) return ballHoverText(*d->scene->frame());
    const bool isRobot = hit.kind == FieldHit::Kind::Robot || hit.kind == FieldHit::Kind::Handle;
    return isRobot ? hoverText(*d->scene->frame(), hit.robot) : QString();
  });
  connect(d->canvas, &FieldCanvas::cursorMoved, this, &FieldView::cursorMoved);
  connect(d->canvas, &FieldCanvas::menuRequested, this,
          [this](QPoint at, QPointF metres) { d->openMenu(at, metres); });
  connect(d->scene, &FieldScene::selectionChangedTo, this, &FieldView::selectionChanged);
  connect(d->scene, &FieldScene::followedChanged, this, &FieldView::followedChanged);
  connect(d->pointer, &FieldPointer::ballRequested, this, [this] { d->openBallEditor(); });
  connect(d->pointer, &FieldPointer::poseRequested, this,
          [this](RobotUid id) { d->openPoseEditor(id); });
  if (!source) return;
  d->scene->setRows([source] { return source->series(); });
  connect(source, &FrameSource::rowsCame, d->scene, &FieldScene::rowsCame);
  const auto whyNot = [source](const FramePtr& frame) {
    if (!source->kind().canBeEdited) return QStringLiteral("Only in Simulate");
    // The past cannot be moved by hand.
    return frame && frame->origin == link::FrameOrigin::Recorded ? MatchEdits::lockedText()
                                                                 : QString();
  };
  connect(source, &FrameSource::frameReceived, this, [this, whyNot](const FramePtr& frame) {
    d->setReadOnly(whyNot(frame));
    showFrame(frame);
  });
  const auto begin = [this, source, whyNot] {
    d->setReadOnly(whyNot({}));
    showFrame(source->frame());
  };
  connect(source, &FrameSource::restarted, this, begin);
  if (controller != nullptr) {
    // Before the first frame, so that the field of another league never appears.
    connect(controller, &MatchController::scenarioChanged, this, [this, source, controller] {
      if (source->frame() || !source->kind().canBeEdited) return;
      d->scene->setField(controller->scenario().settings.field);
      d->canvas->fit();
    });
  }
  d->setReadOnly(whyNot({}));
  d->canvas->setEmptyText([source] {
    const bool open = source->kind().canBeEdited && source->frame();
    return open ? QString() : source->emptyText();
  });
}

FieldView::~FieldView() {
  // The canvas asks the scene and the pointer until it is gone.
  delete d->canvas;
}

void FieldView::showFrame(const FramePtr& frame) {
  const bool otherField = frame && !(d->scene->style().field == frame->settings->field);
  const bool wasEmpty = !d->scene->frame() || d->scene->frame()->robots.empty();
  d->scene->showFrame(frame);
  if (otherField) d->canvas->fit();
  if (wasEmpty || !frame || frame->robots.empty()) d->canvas->viewport()->update();
  if (const auto id = d->scene->followed()) {
    if (const auto pose = d->scene->pose(*id)) d->canvas->centreOnMetres(toScene(pose->position));
  }
}

void FieldView::showOther(const FramePtr& frame) {
  d->scene->showOther(frame);
}
void FieldView::showCompared(int number, const FramePtr& frame) {
  d->scene->showCompared(number, frame);
}
void FieldView::showHeat(const BallHeatPtr& heat) {
  d->scene->showHeat(heat);
}

void FieldView::showNotes(NoteBoard* board) {
  d->board = board;
  QWidget* viewport = d->canvas->viewport();
  new NoteLayer(board,
                {telemetry::NotePlace::Field, [](const QPointF&) { return NoteGround::Owner(); },
                 [canvas = d->canvas](const std::string&) { return canvas->viewportTransform(); },
                 [viewport] { return QRectF(viewport->rect()); }},
                viewport, d->canvas);
  d->tools->addNotes(*board);
  connect(board, &NoteBoard::changed, this, [this, board] { d->drawnNotes = board->notes(); });
}

void FieldView::setDrawnNotes(std::vector<telemetry::DrawnNote> notes) {
  d->drawnNotes = std::move(notes);
}

std::vector<RobotUid> FieldView::selection() const {
  return d->scene->selection();
}
void FieldView::select(const std::vector<RobotUid>& ids) {
  d->scene->select(ids);
}
void FieldView::follow(std::optional<RobotUid> id) {
  d->scene->setFollowed(id);
}
std::optional<RobotUid> FieldView::followed() const {
  return d->scene->followed();
}
bool FieldView::hasRobotIn(const QRect& part) const {
  const int edge = qRound(d->scene->style().robotDrawRadius() * d->scene->style().pixelsPerMetre);
  const QRect reach = part.adjusted(-edge, -edge, edge, edge);
  return !d->scene->robotsIn(d->canvas->mapToScene(reach).boundingRect()).empty();
}
const FieldActions& FieldView::actions() const {
  return d->tools->actions();
}

void FieldView::fillRobotsMenu(QMenu* menu) {
  const QPointF centre = d->canvas->metresAt(QRectF(d->canvas->viewport()->rect()).center());
  ui::fillRobotsMenu(menu, d->scene, d->controller, centre, d->menuActions());
}

void FieldView::editPose(RobotUid id) {
  d->openPoseEditor(id);
}

// The robot of a simulated match with this blackboard, else one with this number.
void FieldView::selectNumber(int number) {
  if (!d->scene->frame()) return;
  for (const link::RobotFrame& robot : d->scene->frame()->robots) {
    const int its = robot.slot().value != 0 ? robot.slot().value : robot.key.number;
    if (its == number) return d->scene->select({robot.uid});
  }
  d->scene->select({});
}

void FieldView::nudge(QPointF metres) {
  if (d->scene->selection().empty() || d->editor() == nullptr) return;
  d->pointer->nudge(d->scene->style().flipped ? -metres : metres);
}

bool FieldView::cancel() {
  if (d->pointer->cancel()) return true;
  if (d->pointer->tool() == FieldTool::Select) return false;
  d->pointer->setTool(FieldTool::Select);
  return true;
}

bool FieldView::setPanHeld(bool held) {
  return d->canvas->setPanHeld(held);
}

bool FieldView::takePublishedKey(const QKeyEvent& event) {
  if (event.key() == Qt::Key_Shift) {
    d->rightShift = event.nativeScanCode() == rightShiftScanCode ||
                    event.nativeVirtualKey() == rightShiftKeysym;
    return false;
  }
  const auto order = fieldOrder(event.key(), event.modifiers());
  if (order) d->carryOut(*order);
  return order.has_value();
}

void FieldView::setFlipped(bool flipped) {
  d->tools->flip()->setChecked(flipped);
}

QSize FieldView::pictureSize(QSize within) const {
  return ui::pictureSize(d->scene->style().field, within);
}
QImage FieldView::picture(QSize size) const {
  return paintPicture(*d->scene, size, d->drawnNotes);
}
QByteArray FieldView::svgPicture(QSize size) const {
  return ui::svgPicture(*d->scene, size, d->drawnNotes);
}
std::unique_ptr<FramePainter> FieldView::framePainter() const {
  return std::make_unique<FilmPainter>(d->scene->style(), d->drawnNotes);
}

}  // namespace pitchboard::ui
