// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field: draws the newest frame and turns mouse input into edits of the match. Keys are handled
// by the window, which calls the functions below. UI thread only. The scene is in metres, +y up.

#include <QImage>
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include <base/robot_key.h>
#include <telemetry/session/drawn_notes.h>
#include <ui/field/field_layers.h>
#include <ui/sources/ball_heat.h>
#include <ui/sources/field_pictures.h>
#include <ui/sources/match_controller.h>

class QAction;
class QKeyEvent;
class QMenu;

namespace pitchboard::ui {

/// Actions for the menus and the tool strip.
struct FieldActions {
  std::vector<QAction*> layers;   ///< checkable, one for each FieldLayer, in that order
  std::vector<QAction*> options;  ///< options of layers, such as the granularity of EOPRA
  std::vector<QAction*> tools;    ///< select, ruler, add
  /// `publishedKeys` is checkable and kept in the settings; the window connects `showKeys`.
  QAction *publishedKeys, *showKeys, *fit, *flip;
};

class NoteBoard;

class FieldView : public QWidget, public FieldPictures {
  Q_OBJECT
 public:
  /// Shows the source's frames and passes edits to the controller. Without a source, call
  /// showFrame(); without a controller, nothing can be edited.
  FieldView(FrameSource* source, MatchController* controller, QWidget* parent = nullptr);
  explicit FieldView(MatchController* controller, QWidget* parent = nullptr);
  ~FieldView() override;

  void showFrame(const FramePtr& frame);
  /// Draws the same robots as another source sees them, with the difference; null: none.
  void showOther(const FramePtr& frame);
  /// Draws a moment of another session on top; null: none. `number`: of the session
  /// (session_mark.h), 0 for an abandoned future.
  void showCompared(int number, const FramePtr& frame);
  /// What may follow a moment, drawn in the layer Exploration; null: nothing.
  void showHeat(const BallHeatPtr& heat);

  /// Shows the notes of the board, lets the mouse draw and change them, and offers its tools. Once.
  void showNotes(NoteBoard* board);
  /// Notes for pictures and videos, of a field without a board.
  void setDrawnNotes(std::vector<telemetry::DrawnNote> notes);

  std::vector<RobotUid> selection() const;
  void select(const std::vector<RobotUid>& ids);
  /// Keeps this robot in the middle of the view; empty: stops following.
  void follow(std::optional<RobotUid> id);
  std::optional<RobotUid> followed() const;
  const FieldActions& actions() const;
  /// Fills the menu bar's menu about the selected robots, all robots and the ball.
  void fillRobotsMenu(QMenu* menu);
  /// Selects the robot with this id in a simulated match, otherwise one with this number.
  void selectNumber(int number);
  /// Moves the selected robots by metres, right and up on the screen.
  void nudge(QPointF metres);
  /// Cancels a drag, or returns to the Select tool. Returns whether it did either.
  bool cancel();
  /// While held, dragging with the left button pans. On release, returns whether the view was
  /// panned.
  bool setPanHeld(bool held);
  /// Carries out a key of the published simulator (field_keys.h). Returns false if it is none.
  bool takePublishedKey(const QKeyEvent& event);
  /// Opens the editor for the robot's pose.
  void editPose(RobotUid id);
  /// Whether a robot is drawn in this part of the canvas (pixels), or at its edge.
  bool hasRobotIn(const QRect& part) const;
  void setFlipped(bool flipped);
  QSize pictureSize(QSize within) const override;
  QImage picture(QSize size) const override;
  QByteArray svgPicture(QSize size) const override;
  std::unique_ptr<FramePainter> framePainter() const override;

 signals:
  void selectionChanged(const std::vector<pitchboard::RobotUid>& ids);
  void followedChanged(std::optional<pitchboard::RobotUid> id);
  /// Position of the cursor on the field in metres; not valid once the cursor has left the field.
  void cursorMoved(QPointF metres, bool valid);
  void blackboardRequested(pitchboard::RobotUid id);
  void saveScenarioRequested();
  void loadMatchRequested();  ///< F2 of the published keys
  void resetRequested();      ///< F3
  void clearRequested();      ///< F4

 private:
  struct Private;
  std::unique_ptr<Private> d;
};

}  // namespace pitchboard::ui
