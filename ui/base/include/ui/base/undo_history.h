// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Undo and redo across several stacks: the newest command is undone first, wherever the focus is.
// UI thread only.

#include <QHash>
#include <QObject>
#include <QPointer>
#include <QUndoStack>
#include <functional>
#include <memory>
#include <vector>

class QAction;

namespace pitchboard::ui {

class UndoHistory : public QObject {
 public:
  explicit UndoHistory(QObject* parent);
  /// Adds a stack. `usable` tells whether its commands can be undone and redone now; call refresh()
  /// when that changes.
  void add(QUndoStack* stack, std::function<bool()> usable);
  void refresh();
  /// A change has been sent off, and becomes a command once it is carried out: undo waits for it.
  void expect();
  /// It was carried out, and its command is on the stack, or it was refused.
  void answer(bool done);
  /// "Undo Remove B1"; disabled if there is nothing to undo.
  QAction* undoAction() const { return m_undo; }
  QAction* redoAction() const { return m_redo; }

 private:
  struct Part {
    QPointer<QUndoStack> stack;
    std::function<bool()> usable;
    QHash<const QUndoCommand*, quint64> pushed;  // when each command came
  };
  void note(Part& part);
  /// The stack whose next command to undo is the newest, to redo the oldest; null: there is none.
  QUndoStack* next(bool undo) const;

  std::vector<std::unique_ptr<Part>> m_parts;
  QAction* m_undo;
  QAction* m_redo;
  quint64 m_count = 0;
  int m_expected = 0;         // changes without an answer
  bool m_undoesNext = false;  // when there are none any more
};

}  // namespace pitchboard::ui
