// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A change of the plots that can be undone: what they were before and after. UI thread only.

#include <QElapsedTimer>
#include <QUndoCommand>
#include <functional>

#include <ui/plots/plot_layout.h>

namespace pitchboard::ui {

class LayoutCommand : public QUndoCommand {
 public:
  /// `put` shows a layout. The change has happened already: the first redo() does nothing.
  LayoutCommand(PlotLayout before, PlotLayout after, std::function<void(const PlotLayout&)> put);
  void undo() override;
  void redo() override;
  int id() const override { return 1; }
  /// Changes of look and limits within a second are one; what adds or removes is one for itself.
  bool mergeWith(const QUndoCommand* next) override;

 private:
  PlotLayout m_before, m_after;
  std::function<void(const PlotLayout&)> m_put;
  QElapsedTimer m_age;
  bool m_done = true;
};

}  // namespace pitchboard::ui
