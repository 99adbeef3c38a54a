// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field's tools, layers and views as actions, and the strip at its left that shows them. UI
// thread only; belongs to the field.

#include <QObject>
#include <vector>

#include <ui/field/field_layers.h>

class QAction;
class QToolBar;
class QWidget;

namespace pitchboard::ui {

class DrawingsMenu;
class FieldCanvas;
class FieldPointer;
class FieldScene;
class HelpOverlay;

class FieldTools : public QObject {
  Q_OBJECT
 public:
  FieldTools(FieldScene* scene, FieldPointer* pointer, FieldCanvas* canvas, HelpOverlay* help,
             QWidget* field);

  QToolBar* strip() const { return m_strip; }
  /// One checkable action per FieldLayer, in its order.
  const std::vector<QAction*>& layers() const { return m_layers; }
  /// How layers look.
  const std::vector<QAction*>& layerOptions() const { return m_layerOptions; }
  /// Tools, flip, fit, keys.
  std::vector<QAction*> viewActions() const;
  QAction* flip() const { return m_flip; }
  /// The tool that adds robots.
  QAction* adding() const { return m_tools.back(); }

 private:
  void makeLayers();
  void makeLayerOptions(QWidget* field);
  void makeTools();
  void makeViews();
  void makeStrip(QWidget* field);
  void addTeams();
  void addLayersButton();
  void showLayer(FieldLayer layer, bool shown);

  FieldScene* m_scene;
  FieldPointer* m_pointer;
  FieldCanvas* m_canvas;
  HelpOverlay* m_help;
  QToolBar* m_strip = nullptr;
  std::vector<QAction*> m_layers;
  std::vector<QAction*> m_layerOptions;
  DrawingsMenu* m_drawings = nullptr;
  std::vector<QAction*> m_tools;
  QAction* m_flip = nullptr;
  QAction* m_fit = nullptr;
  QAction* m_keys = nullptr;
};

}  // namespace pitchboard::ui
