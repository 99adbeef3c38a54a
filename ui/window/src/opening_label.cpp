// SPDX-License-Identifier: GPL-3.0-or-later
#include "opening_label.h"

#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>

namespace pitchboard::ui {

OpeningLabel::OpeningLabel(MatchController* controller, QWidget* canvas)
    : FieldSign(canvas, QStringLiteral("openingLabel"), &ThemeColors::innerLine),
      m_controller(controller) {
  for (const auto changed : {&MatchController::scenarioChanged, &MatchController::opened}) {
    connect(controller, changed, this, &OpeningLabel::present);
  }
  connect(controller, &MatchController::frameReceived, this, &OpeningLabel::hide);
}

void OpeningLabel::present() {
  const bool wanted =
      !m_controller->frame() && (m_controller->isOpening() || m_controller->isOpen());
  if (!wanted) {
    hide();
    return;
  }
  setText(
      QStringLiteral("Opening %1…").arg(QString::fromStdString(m_controller->scenario().title)));
  const QRect area = parentWidget()->rect();
  // Wide enough to cover the field's own sentence.
  QRect box(0, 0, qMin(area.width(), scaled(this, 440)), scaled(this, 40));
  box.moveCenter({area.center().x(), area.top() + qRound(area.height() * 0.36)});
  setGeometry(box);
  show();
  raise();
}

}  // namespace pitchboard::ui
