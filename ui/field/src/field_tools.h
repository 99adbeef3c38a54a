// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The field's tools, layers and views as actions, and the strip at its left that shows them. UI
// thread only; belongs to the field.

#include <QObject>
#include <vector>

#include <ui/field/field_layers.h>
#include <ui/field/field_view.h>

class QAction;
class QToolBar;
class QWidget;

namespace pitchboard::ui {

class DrawingsMenu;
class FieldCanvas;
class FieldPointer;
class FieldScene;
class NoteBoard;

class FieldTools : public QObject {
  Q_OBJECT
 public:
  FieldTools(FieldScene* scene, FieldPointer* pointer, FieldCanvas* canvas, QWidget* field);

  QToolBar* strip() const { return m_strip; }
  const FieldActions& actions() const { return m_actions; }
  /// Adds the tools that draw notes.
  void addNotes(NoteBoard& board);
  QAction* flip() const { return m_actions.flip; }
  /// The tool that adds robots.
  QAction* adding() const { return m_adding; }

 private:
  void makeLayers();
  void makeLayerOptions(QWidget* field);
  void makeTools();
  void makeViews();
  void makeStrip(QWidget* field);
  void addTeams();
  QAction* addLayersButton();
  void showLayer(FieldLayer layer, bool shown);

  FieldScene* m_scene;
  FieldPointer* m_pointer;
  FieldCanvas* m_canvas;
  QToolBar* m_strip = nullptr;
  FieldActions m_actions{};
  DrawingsMenu* m_drawings = nullptr;
  QAction* m_adding = nullptr;
  QAction* m_afterTools = nullptr;
};

}  // namespace pitchboard::ui
