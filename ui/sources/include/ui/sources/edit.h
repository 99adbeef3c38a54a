// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A change by hand that can be undone, of the match or of the plots: the one kind of undo command.
// UI thread only.

#include <QElapsedTimer>
#include <QString>
#include <QUndoCommand>
#include <functional>
#include <utility>

namespace pitchboard::ui {

struct Edit {
  QString text;  ///< what the undo menu calls it
  std::function<void()> redo, undo;
  /// An edit with the same key within a second continues the one before it, and both are undone
  /// together. Empty: it stands alone.
  QString mergeKey = {};
  bool done = false;  ///< it has happened already: it is not done when it is pushed
};

class EditCommand : public QUndoCommand {
 public:
  explicit EditCommand(Edit edit) : QUndoCommand(edit.text), m_edit(std::move(edit)) {
    m_age.start();
  }
  void redo() override {
    if (!std::exchange(m_edit.done, false)) m_edit.redo();
  }
  void undo() override { m_edit.undo(); }
  int id() const override { return m_edit.mergeKey.isEmpty() ? -1 : 1; }
  bool mergeWith(const QUndoCommand* other) override {
    constexpr qint64 mergeMilliseconds = 1000;
    const Edit& later = static_cast<const EditCommand&>(*other).m_edit;
    if (later.mergeKey != m_edit.mergeKey || m_age.elapsed() > mergeMilliseconds) return false;
    m_edit.redo = later.redo;
    m_age.restart();
    return true;
  }

 private:
  Edit m_edit;
  QElapsedTimer m_age;
};

}  // namespace pitchboard::ui
