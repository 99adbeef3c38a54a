// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which drawings of the robots' programs are shown: by layer, by robot, by both. Filled whenever it
// is opened, with what is drawn at that moment and what was hidden before. UI thread.

#include <QMenu>

namespace pitchboard::ui {

class FieldScene;

/// `show` is the layer's own switch, and stands at the top.
class DrawingsMenu : public QMenu {
  Q_OBJECT
 public:
  DrawingsMenu(FieldScene* scene, QAction* show, QWidget* parent);

 private:
  void fill();
  void addLayers();
  void addRobots();

  FieldScene* m_scene;
  QAction* m_show;
  QList<QObject*> m_made;  // since it was opened
};

}  // namespace pitchboard::ui
