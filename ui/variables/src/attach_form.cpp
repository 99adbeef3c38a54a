// SPDX-License-Identifier: GPL-3.0-or-later
#include "attach_form.h"

#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <limits>

#include <robotlink/live/attached_robots.h>
#include <ui/base/number_box.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {

AttachForm::AttachForm(QWidget* parent)
    : QFrame(parent), m_key(new QSpinBox(this)), m_rate(new NumberBox(this)) {
  setObjectName(QStringLiteral("attachForm"));
  m_key->setObjectName(QStringLiteral("attachKey"));
  m_key->setRange(1, std::numeric_limits<int>::max());
  m_key->setValue(100);
  m_key->setAccessibleName(QStringLiteral("Key of the blackboard"));
  m_rate->setObjectName(QStringLiteral("attachRate"));
  m_rate->setRange(link::AttachedBoard::slowest, link::AttachedBoard::fastest);
  m_rate->setDecimals(1);
  m_rate->setValue(60);
  m_rate->setSuffix(QStringLiteral(" /s"));
  m_rate->setAccessibleName(QStringLiteral("Samples a second"));
  for (QAbstractSpinBox* box :
       {static_cast<QAbstractSpinBox*>(m_key), static_cast<QAbstractSpinBox*>(m_rate)}) {
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    box->setAlignment(Qt::AlignRight);
    box->setMaximumWidth(scaled(this, 84));
  }
  auto* about = new QLabel(
      QStringLiteral("Look at another blackboard of this computer. It is only read; what "
                     "changes twice between two samples is not seen."),
      this);
  about->setWordWrap(true);
  about->setFont(themeFont(TypeRole::Secondary));
  about->setForegroundRole(QPalette::PlaceholderText);
  auto* attach = new QPushButton(QStringLiteral("Attach"), this);
  attach->setObjectName(QStringLiteral("attachButton"));
  auto* cancel = new QPushButton(QStringLiteral("Cancel"), this);
  connect(attach, &QPushButton::clicked, this, &AttachForm::request);
  connect(cancel, &QPushButton::clicked, this, &QWidget::hide);
  auto* grid = new QGridLayout(this);
  const int gap = scaled(this, 4);
  grid->setContentsMargins(2 * gap, gap, 2 * gap, gap);
  grid->setSpacing(gap);
  grid->addWidget(about, 0, 0, 1, 5);
  grid->addWidget(new QLabel(QStringLiteral("Key"), this), 1, 0);
  grid->addWidget(m_key, 1, 1);
  grid->addWidget(m_rate, 1, 2);
  grid->addWidget(attach, 1, 3);
  grid->addWidget(cancel, 1, 4);
  grid->setColumnStretch(1, 1);
  hide();
}

void AttachForm::open() {
  show();
  m_key->setFocus();
  m_key->selectAll();
}

void AttachForm::request() {
  m_key->interpretText();
  m_rate->interpretText();
  emit attachRequested(m_key->value(), m_rate->value());
}

void AttachForm::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape)
    hide();
  else if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)
    request();
  else
    QFrame::keyPressEvent(event);
}

}  // namespace pitchboard::ui
