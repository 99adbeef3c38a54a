// SPDX-License-Identifier: GPL-3.0-or-later
#include "key_guard.h"

#include <QAbstractButton>
#include <QAbstractSpinBox>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMainWindow>
#include <QPlainTextEdit>
#include <QTextEdit>

#include <ui/field/field_keys.h>
#include <ui/field/field_view.h>

#include "help_overlay.h"

namespace pitchboard::ui {
namespace {

bool takesText(const QWidget& widget) {
  if (const auto* line = qobject_cast<const QLineEdit*>(&widget)) return !line->isReadOnly();
  if (const auto* box = qobject_cast<const QAbstractSpinBox*>(&widget)) return !box->isReadOnly();
  if (const auto* box = qobject_cast<const QComboBox*>(&widget)) return box->isEditable();
  if (const auto* text = qobject_cast<const QTextEdit*>(&widget)) return !text->isReadOnly();
  if (const auto* text = qobject_cast<const QPlainTextEdit*>(&widget)) return !text->isReadOnly();
  return false;
}

bool isModifier(int key) {
  return key == Qt::Key_Shift || key == Qt::Key_Control || key == Qt::Key_Alt ||
         key == Qt::Key_Meta || key == Qt::Key_AltGr;
}

Qt::KeyboardModifiers modifiersOf(const QKeyEvent& key) {
  return key.modifiers() & ~Qt::KeyboardModifiers(Qt::KeypadModifier);
}

bool isPlainSpace(const QKeyEvent& key) {
  return key.key() == Qt::Key_Space && modifiersOf(key) == Qt::NoModifier;
}

}  // namespace

KeyGuard::KeyGuard(QMainWindow* window, FieldView* field, QAction* play, HelpOverlay* help)
    : QObject(window), m_window(window), m_field(field), m_play(play), m_help(help) {
  qApp->installEventFilter(this);
}

// Menus, lists of combo boxes and dialogs are windows with keys of their own.
bool KeyGuard::belongsToWindow(const QWidget& widget) const {
  const QWidget* top = widget.window();
  if (top == m_window) return true;
  return top->windowType() == Qt::Tool && top->parentWidget() != nullptr &&
         top->parentWidget()->window() == m_window;
}

bool KeyGuard::eventFilter(QObject* watched, QEvent* event) {
  const QEvent::Type type = event->type();
  if (type == QEvent::WindowDeactivate && watched == m_window && m_spaceDown) {
    m_spaceDown = false;
    m_field->setPanHeld(false);
  }
  if (type != QEvent::ShortcutOverride && type != QEvent::KeyPress && type != QEvent::KeyRelease) {
    return false;
  }
  auto* widget = qobject_cast<QWidget*>(watched);
  if (widget == nullptr || !belongsToWindow(*widget)) return false;
  auto* key = static_cast<QKeyEvent*>(event);
  if (type == QEvent::ShortcutOverride) return overrides(*widget, *key);
  if (!(type == QEvent::KeyPress ? press(*widget, *key) : release(*key))) return false;
  event->accept();
  return true;
}

// Accepted: the key goes to the widget. Ignored: shortcuts come first.
bool KeyGuard::overrides(QWidget& widget, QKeyEvent& key) const {
  if (m_help->isVisible()) {
    key.setAccepted(!isModifier(key.key()));
    return true;
  }
  if (takesText(widget)) {
    const bool isFunction = key.key() >= Qt::Key_F1 && key.key() <= Qt::Key_F35;
    const bool isCommand =
        key.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier);
    if (isFunction || isCommand) return false;  // the widget's own commands, then shortcuts
    key.accept();
    return true;
  }
  const bool isPublished = m_field->actions().publishedKeys->isChecked() &&
                           fieldOrder(key.key(), key.modifiers()).has_value();
  key.setAccepted(isPublished || isPlainSpace(key));
  return true;
}

bool KeyGuard::press(QWidget& widget, QKeyEvent& key) {
  if (m_help->isVisible() && !isModifier(key.key())) {
    m_help->leave();
    return true;
  }
  if (takesText(widget)) return false;
  if (isPlainSpace(key)) {
    if (!key.isAutoRepeat()) {
      m_spaceDown = true;
      m_field->setPanHeld(true);
    }
    return true;
  }
  const bool isEnter = key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter;
  if (isEnter && modifiersOf(key) == Qt::NoModifier && !key.isAutoRepeat()) {
    if (auto* button = qobject_cast<QAbstractButton*>(&widget)) {
      button->click();
      return true;
    }
    if (auto* box = qobject_cast<QComboBox*>(&widget)) {
      box->showPopup();
      return true;
    }
  }
  // Also asked while the mode is off: it tells the right Shift key from the left one.
  const bool on = m_field->actions().publishedKeys->isChecked();
  return (on || key.key() == Qt::Key_Shift) && m_field->takePublishedKey(key);
}

bool KeyGuard::release(const QKeyEvent& key) {
  if (key.key() != Qt::Key_Space || !m_spaceDown) return false;
  if (key.isAutoRepeat()) return true;
  m_spaceDown = false;
  if (!m_field->setPanHeld(false)) m_play->trigger();
  return true;
}

}  // namespace pitchboard::ui
