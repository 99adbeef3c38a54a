// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/base/in_place_message.h>

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

#include <ui/base/theme.h>

namespace pitchboard::ui {

QString shortListOf(const QStringList& sentences) {
  constexpr qsizetype most = 3;
  QStringList lines = sentences.mid(0, most);
  if (sentences.size() > most) {
    lines << QStringLiteral("%1 more like these").arg(sentences.size() - most);
  }
  return lines.join(QLatin1Char('\n'));
}

InPlaceMessage::InPlaceMessage(QWidget* parent)
    : QFrame(parent), m_text(new QLabel(this)), m_button(new QPushButton(this)) {
  setObjectName(QStringLiteral("inPlaceMessage"));
  m_text->setObjectName(QStringLiteral("inPlaceText"));
  m_text->setWordWrap(true);
  m_text->setTextFormat(Qt::PlainText);
  m_text->setTextInteractionFlags(Qt::TextSelectableByMouse);
  m_text->setFont(themeFont(TypeRole::Secondary));
  m_button->setObjectName(QStringLiteral("inPlaceButton"));
  auto* close = new QToolButton(this);
  close->setIcon(themedIcon(QStringLiteral("window-close")));
  close->setIconSize({scaled(this, 12), scaled(this, 12)});
  close->setToolTip(QStringLiteral("Close"));
  close->setAutoRaise(true);
  connect(close, &QToolButton::clicked, this, &InPlaceMessage::clear);
  connect(m_button, &QPushButton::clicked, this, [this] {
    const auto action = m_action;
    clear();
    if (action) action();
  });
  auto* row = new QHBoxLayout(this);
  const int gap = scaled(this, 4);
  row->setContentsMargins(2 * gap, gap, gap, gap);
  row->setSpacing(gap);
  row->addWidget(m_text, 1);
  row->addWidget(m_button);
  row->addWidget(close, 0, Qt::AlignTop);
  hide();
}

void InPlaceMessage::showMessage(Tone tone, const QString& sentence, const QString& button,
                                 std::function<void()> action) {
  m_tone = tone;
  m_action = std::move(action);
  m_text->setText(sentence);
  m_button->setText(button);
  m_button->setVisible(!button.isEmpty());
  colour();
  show();
}

void InPlaceMessage::clear() {
  m_action = {};
  m_text->clear();
  hide();
}

QString InPlaceMessage::text() const {
  return m_text->text();
}

void InPlaceMessage::changeEvent(QEvent* event) {
  QFrame::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && isVisible()) colour();
}

void InPlaceMessage::colour() {
  const ThemeColors& c = theme();
  const QColor ground = m_tone == Tone::Error     ? c.errorGround
                        : m_tone == Tone::Warning ? c.warningGround
                                                  : c.selectedRow;
  const QColor text = m_tone == Tone::Error     ? c.errorText
                      : m_tone == Tone::Warning ? c.warningText
                                                : c.text;
  const QString sheet = QStringLiteral(
                            "#inPlaceMessage { background: %1; }"
                            "#inPlaceText { color: %2; }")
                            .arg(ground.name(), text.name());
  if (sheet != styleSheet()) setStyleSheet(sheet);
}

}  // namespace pitchboard::ui
