// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field: draws the newest frame and turns the mouse into commands of the MatchController. Keys
// are the window's, which calls what they mean here.
// UI thread only. The scene is in metres, +y up.

#include <QImage>
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include <base/robot_key.h>
#include <ui/field/field_layers.h>
#include <ui/sources/field_pictures.h>
#include <ui/sources/forecast.h>
#include <ui/sources/match_controller.h>

class QAction;
class QKeyEvent;
class QMenu;

namespace pitchboard::ui {

/// For menus; also on the tool strip.
struct FieldActions {
  std::vector<QAction*> layers;   ///< checkable, one per FieldLayer, in that order
  std::vector<QAction*> options;  ///< how layers look: field of view of all, granularity of EOPRA
  std::vector<QAction*> tools;    ///< select, ruler, add
  /// Published keys (checkable, remembered), show keys (for the window to answer), fit, flip sides
  QAction *publishedKeys, *showKeys, *fit, *flip;
};

class FieldView : public QWidget, public FieldPictures {
  Q_OBJECT
 public:
  /// Shows the source's frames; what is done by hand goes to the controller. Without a source
  /// showFrame() feeds it; without a controller nothing can be moved.
  FieldView(FrameSource* source, MatchController* controller, QWidget* parent = nullptr);
  explicit FieldView(MatchController* controller, QWidget* parent = nullptr);
  ~FieldView() override;

  void showFrame(const FramePtr& frame);
  /// Another source's view of the same robots, drawn beside them with the difference; null: none.
  void showOther(const FramePtr& frame);
  /// A moment of another session, drawn over this one; null: none.
  void showCompared(const FramePtr& frame);
  /// What may follow a moment, drawn in the layer Exploration; null: nothing.
  void showForecast(const ForecastPtr& forecast);

  std::vector<RobotKey> selection() const;
  void select(const std::vector<RobotKey>& ids);
  /// Keeps this robot in the middle of the view; nothing ends it.
  void follow(std::optional<RobotKey> id);
  std::optional<RobotKey> followed() const;
  const FieldActions& actions() const;
  /// What can be done with the selected robots, with all of them and the ball, for the menu bar.
  void fillRobotsMenu(QMenu* menu);
  /// The robot of a simulated match in this slot, else one with this number; nobody: none.
  void selectNumber(int number);
  /// Moves the selected robots: to the right and up as the field is seen, metres.
  void nudge(QPointF metres);
  /// Ends a drag, or a tool other than Select; says whether there was one.
  bool cancel();
  /// While held, a drag with the left button pans. At the end: says whether it was used for that.
  bool setPanHeld(bool held);
  /// Does what this key press means in the published simulator (field_keys.h); false: nothing.
  bool takePublishedKey(const QKeyEvent& event);
  /// Opens the editor for the pose of this robot.
  void editPose(RobotKey id);
  void setFlipped(bool flipped);
  bool isFlipped() const;
  QSize pictureSize(QSize within) const override;
  QImage picture(QSize size) const override;
  QByteArray svgPicture(QSize size) const override;
  std::unique_ptr<FramePainter> framePainter() const override;

 signals:
  void selectionChanged(const std::vector<pitchboard::RobotKey>& ids);
  void followedChanged(std::optional<pitchboard::RobotKey> id);
  /// Cursor in metres on the field; not valid when the cursor left it.
  void cursorMoved(QPointF metres, bool valid);
  void blackboardRequested(pitchboard::RobotKey id);
  void saveScenarioRequested();
  void loadMatchRequested();  ///< F2 of the published keys
  void resetRequested();      ///< F3
  void clearRequested();      ///< F4

 private:
  struct Private;
  std::unique_ptr<Private> d;
};

}  // namespace pitchboard::ui
