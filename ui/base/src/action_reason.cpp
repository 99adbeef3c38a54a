// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/action_reason.h>

#include <QAction>
#include <QVariant>

namespace pitchboard::ui {

void enableUnless(QAction& action, const QString& whyNot) {
  constexpr const char* ownToolTip = "ownToolTip";
  const QVariant kept = action.property(ownToolTip);
  if (whyNot.isEmpty() && kept.isValid()) {
    action.setToolTip(kept.toString());
    action.setProperty(ownToolTip, {});
  } else if (!whyNot.isEmpty()) {
    // Without a tooltip of its own, an action returns its text.
    const QString own = action.toolTip();
    if (!kept.isValid()) action.setProperty(ownToolTip, own == action.iconText() ? QString() : own);
    action.setToolTip(whyNot);
  }
  action.setEnabled(whyNot.isEmpty());
}

}  // namespace pitchboard::ui
