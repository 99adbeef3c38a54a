// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A change by the user that can be undone, in the match or in the plots. All undo commands are of
// this kind, and they are pushed after the change has been made: what was refused never gets onto
// the stack. UI thread only.

#include <QElapsedTimer>
#include <QString>
#include <QUndoCommand>
#include <functional>
#include <memory>
#include <utility>

namespace pitchboard::ui {

struct Edit {
  QString text;  ///< name in the undo menu
  std::function<void()> redo, undo;
  /// Edits with the same key within a second become one undo step. Empty: never merged.
  QString mergeKey = {};
  /// Becomes true if it was undone and cannot be done again; null: cannot happen.
  std::shared_ptr<const bool> refused = {};
};

class EditCommand : public QUndoCommand {
 public:
  explicit EditCommand(Edit edit) : QUndoCommand(edit.text), m_edit(std::move(edit)) {
    m_age.start();
  }
  void redo() override {
    if (!std::exchange(m_isNew, false)) m_edit.redo();
  }
  /// The stack deletes a refused command instead of keeping it to be done again.
  void undo() override {
    if (isRefused())
      setObsolete(true);
    else
      m_edit.undo();
  }
  bool isRefused() const { return m_edit.refused && *m_edit.refused; }
  const QString& mergeKey() const { return m_edit.mergeKey; }
  int id() const override { return m_edit.mergeKey.isEmpty() ? -1 : 1; }
  bool mergeWith(const QUndoCommand* other) override {
    constexpr qint64 mergeMilliseconds = 1000;
    const Edit& later = static_cast<const EditCommand&>(*other).m_edit;
    if (later.mergeKey != m_edit.mergeKey || m_age.elapsed() > mergeMilliseconds) return false;
    m_edit.redo = later.redo;
    m_edit.refused = later.refused;
    m_age.restart();
    return true;
  }

 private:
  Edit m_edit;
  bool m_isNew = true;  // the stack calls redo() for what it is given
  QElapsedTimer m_age;
};

}  // namespace pitchboard::ui
