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
  const double at = m_timeline->shownTime();
  const auto clock = m_timeline->clock();
  const QString time = clock ? momentText(at, 0, clock) : longMomentText(at);
  const QString text = QStringLiteral("Looking back: %1 (Now leads back)").arg(time);
  if (text == this->text() && isVisible()) return;
  setText(text);
  QRect box(0, 0, sizeHint().width() + scaled(this, 24), scaled(this, 28));
  box.moveTop(scaled(this, 8));
  box.moveLeft((parentWidget()->width() - box.width()) / 2);
  setGeometry(box);
  show();
  raise();
}

}  // namespace pitchboard::ui
