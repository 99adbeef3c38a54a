// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/wheel_guard.h>

#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QScrollBar>
#include <QTabBar>

namespace pitchboard::ui {
namespace {

/// What a turn of the wheel would change.
bool isChangedByWheel(const QObject* object) {
  return qobject_cast<const QComboBox*>(object) != nullptr ||
         qobject_cast<const QAbstractSpinBox*>(object) != nullptr ||
         qobject_cast<const QTabBar*>(object) != nullptr ||
         (qobject_cast<const QAbstractSlider*>(object) != nullptr &&
          qobject_cast<const QScrollBar*>(object) == nullptr);
}

class WheelGuard : public QObject {
 public:
  using QObject::QObject;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::Polish && isChangedByWheel(watched)) {
      auto* control = static_cast<QWidget*>(watched);
      if (control->focusPolicy() == Qt::WheelFocus) control->setFocusPolicy(Qt::StrongFocus);
    }
    if (event->type() != QEvent::Wheel || !isChangedByWheel(watched)) return false;
    const auto* control = static_cast<QWidget*>(watched);
    const QWidget* focus = QApplication::focusWidget();
    if (focus != nullptr && (focus == control || control->isAncestorOf(focus))) return false;
    event->ignore();  // it goes on to the parent
    return true;
  }
};

}  // namespace

void guardWheel(QApplication& application) {
  const QString name = QStringLiteral("wheelGuard");
  if (application.findChild<QObject*>(name, Qt::FindDirectChildrenOnly) != nullptr) return;
  auto* guard = new WheelGuard(&application);
  guard->setObjectName(name);
  application.installEventFilter(guard);
}

}  // namespace pitchboard::ui
