// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field: draws the newest frame and turns mouse and keys into commands of the MatchController.
// UI thread only. The scene is in metres, +y up.

#include <QWidget>
#include <vector>

#include <base/ids.h>
#include <ui/match_controller.h>

class QAction;

namespace pitchboard::ui {

/// What can be shown or hidden on the field, in the order of the layers menu.
enum class FieldLayer {
  FieldOfView, Belief, Ghost, PerceivedBall, Trails, Numbers, Grid, Eopra, StarVars
};

class FieldView : public QWidget {
  Q_OBJECT
 public:
  explicit FieldView(MatchController* controller, QWidget* parent = nullptr);
  ~FieldView() override;

  std::vector<RobotId> selection() const;
  void select(const std::vector<RobotId>& ids);
  /// One checkable action per layer, for menus; also on the tool strip.
  std::vector<QAction*> layerActions() const;
  /// Select, ruler, add, flip, fit, help overlay...: for the View and Robots menus.
  std::vector<QAction*> viewActions() const;
  void fitField();
  void setFlipped(bool flipped);
  bool isFlipped() const;
  /// The field as a picture without window, for files and documents.
  QImage picture(QSize size) const;

 signals:
  void selectionChanged(const std::vector<pitchboard::RobotId>& ids);
  /// Cursor in metres on the field; not valid when the cursor left it.
  void cursorMoved(QPointF metres, bool valid);
  void saveScenarioRequested();
  void loadMatchRequested();       ///< F2
  void resetRequested();           ///< F3
  void clearRequested();           ///< F4
  void robotActivated(pitchboard::RobotId id);

 private:
  struct Private;
  std::unique_ptr<Private> d;
};

}  // namespace pitchboard::ui
