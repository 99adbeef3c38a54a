// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/undo_history.h>

#include <QAction>
#include <utility>

#include <ui/base/action_reason.h>

namespace pitchboard::ui {

UndoHistory::UndoHistory(QObject* parent)
    : QObject(parent), m_undo(new QAction(this)), m_redo(new QAction(this)) {
  connect(m_undo, &QAction::triggered, this, [this] {
    if (m_expected > 0)
      m_undoesNext = true;
    else if (QUndoStack* stack = next(true))
      stack->undo();
  });
  connect(m_redo, &QAction::triggered, this, [this] {
    if (QUndoStack* stack = next(false)) stack->redo();
  });
  refresh();
}

void UndoHistory::add(QUndoStack* stack, std::function<bool()> usable) {
  m_parts.push_back(std::make_unique<Part>(Part{stack, std::move(usable), {}}));
  Part& part = *m_parts.back();
  connect(stack, &QUndoStack::indexChanged, this, [this, &part] { note(part); });
  note(part);
}

// A stack tells of a push as of an undo: commands that were not there before are new.
void UndoHistory::note(Part& part) {
  QHash<const QUndoCommand*, quint64> now;
  for (int i = 0; i < part.stack->count(); ++i) {
    const QUndoCommand* command = part.stack->command(i);
    const auto known = part.pushed.constFind(command);
    now.insert(command, known != part.pushed.cend() ? *known : ++m_count);
  }
  part.pushed = std::move(now);
  refresh();
}

void UndoHistory::expect() {
  ++m_expected;
  refresh();
}

void UndoHistory::answer(bool done) {
  --m_expected;
  if (!done) m_undoesNext = false;
  if (m_expected == 0 && std::exchange(m_undoesNext, false)) m_undo->trigger();
  refresh();
}

QUndoStack* UndoHistory::next(bool undo) const {
  QUndoStack* found = nullptr;
  quint64 best = 0;
  for (const auto& part : m_parts) {
    QUndoStack* stack = part->stack;
    if (stack == nullptr || !part->usable()) continue;
    const QUndoCommand* command = stack->command(stack->index() - (undo ? 1 : 0));
    if (command == nullptr) continue;
    const quint64 pushed = part->pushed.value(command);
    if (found != nullptr && (undo ? pushed < best : pushed > best)) continue;
    found = stack;
    best = pushed;
  }
  return found;
}

void UndoHistory::refresh() {
  const QUndoStack* undo = next(true);
  const QUndoStack* redo = next(false);
  m_undo->setText(undo != nullptr ? QStringLiteral("Undo %1").arg(undo->undoText())
                                  : QStringLiteral("Undo"));
  m_redo->setText(redo != nullptr ? QStringLiteral("Redo %1").arg(redo->redoText())
                                  : QStringLiteral("Redo"));
  enableUnless(*m_undo,
               undo || m_expected > 0 ? QString() : QStringLiteral("Nothing to undo here"));
  enableUnless(*m_redo, redo ? QString() : QStringLiteral("Nothing to redo here"));
}

}  // namespace pitchboard::ui
