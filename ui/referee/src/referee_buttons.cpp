// SPDX-License-Identifier: GPL-3.0-or-later
#include "referee_buttons.h"

#include <QAction>

#include <ui/base/theme.h>

namespace pitchboard::ui {

QLabel* makeRefereeHeading(const QString& text, QWidget* owner) {
  auto* label = new QLabel(text, owner);
  label->setFont(themeFont(TypeRole::Body, true));
  label->setContentsMargins(0, scaled(owner, 6), 0, 0);
  return label;
}

QPushButton* makeRefereeButton(QWidget* owner, const QString& text, const QString& tip,
                               const std::function<void()>& pressed, const QKeySequence& key) {
  auto* made = new QPushButton(text, owner);
  made->setObjectName(QStringLiteral("referee ") + text);
  made->setMinimumWidth(scaled(owner, 40));
  made->setToolTip(key.isEmpty()
                       ? tip
                       : tip + QStringLiteral(" (%1)").arg(key.toString(QKeySequence::NativeText)));
  QObject::connect(made, &QPushButton::clicked, owner, [pressed] { pressed(); });
  if (!key.isEmpty()) {
    auto* action = new QAction(text, owner);
    action->setShortcut(key);
    QObject::connect(action, &QAction::triggered, made, [made] { made->click(); });
    owner->addAction(action);
  }
  return made;
}

QString asLabel(std::string_view words) {
  QString text = QString::fromUtf8(words.data(), static_cast<qsizetype>(words.size()));
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

}  // namespace pitchboard::ui
