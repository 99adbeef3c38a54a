// SPDX-License-Identifier: GPL-3.0-or-later
#include "looking_back_sign.h"

#include <ui/base/theme.h>
#include <ui/base/time_axis.h>
#include <ui/sources/timeline.h>

namespace pitchboard::ui {

LookingBackSign::LookingBackSign(Timeline* timeline, QWidget* canvas)
    : FieldSign(canvas, QStringLiteral("lookingBack"), &ThemeColors::accentLine),
      m_timeline(timeline) {
  connect(timeline, &Timeline::lookingBackChanged, this, &LookingBackSign::present);
  connect(timeline, &Timeline::moved, this, &LookingBackSign::present);
  connect(timeline, &Timeline::sourceChanged, this, &LookingBackSign::present);
}

void LookingBackSign::present() {
  if (!m_timeline->isLookingBack()) {
    hide();
    return;
  }
  // As the line of this moment says it in the plots.
  const QString time = momentText(m_timeline->shownTime(), 2, m_timeline->clock());
  const QString text = QStringLiteral("Looking back: %1 (Now leads back)").arg(time);
  setText(text);
  QRect box(0, 0, sizeHint().width() + scaled(this, 24), scaled(this, 28));
  // Where the field is alone the scoreboard stands above it.
  box.moveTop(scaled(this, window()->isFullScreen() ? 44 : 8));
  box.moveLeft((parentWidget()->width() - box.width()) / 2);
  setGeometry(box);
  show();
  raise();
}

}  // namespace pitchboard::ui
