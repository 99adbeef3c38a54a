// SPDX-License-Identifier: GPL-3.0-or-later
#include "follow_dialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <robotlink/match/followed_recording.h>
#include <ui/base/number_box.h>
#include <ui/base/theme.h>

#include "check_list.h"

namespace pitchboard::ui {

FollowDialog::FollowDialog(const QStringList& names, const QStringList& ticked, QWidget* parent,
                           const std::function<void(const QStringList& who, double reach)>& start)
    : QDialog(parent) {
  setWindowTitle(QStringLiteral("Simulate from here, others follow"));
  setObjectName(QStringLiteral("followDialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  auto* explanation = new QLabel(
      QStringLiteral(
          "What you tick moves as recorded, the other robots play. The ball is free once "
          "a robot that plays touches it."),
      this);
  explanation->setWordWrap(true);
  explanation->setFixedWidth(scaled(this, 350));
  m_who = new CheckList(names, QStringLiteral("Filter"), this);
  m_who->setChecked(ticked);
  m_reach = new NumberBox(this);
  m_reach->setObjectName(QStringLiteral("followReach"));
  m_reach->setRange(0.0, 20.0);
  m_reach->setSingleStep(0.1);
  m_reach->setSuffix(QStringLiteral(" m"));
  m_reach->setValue(link::FollowedRecording::defaultReach);
  m_reach->setToolTip(
      QStringLiteral("Followers start to play when a robot that plays, and is elsewhere than "
                     "recorded, is this near the ball or one of them"));
  auto* form = new QFormLayout;
  form->addRow(QStringLiteral("Let go &within:"), m_reach);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  QPushButton* simulate =
      buttons->addButton(QStringLiteral("Simulate"), QDialogButtonBox::AcceptRole);
  simulate->setDefault(true);
  auto* column = new QVBoxLayout(this);
  column->setSizeConstraint(QLayout::SetFixedSize);
  column->addWidget(explanation);
  column->addWidget(m_who);
  column->addLayout(form);
  column->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(buttons, &QDialogButtonBox::accepted, this, [this, start] {
    start(m_who->checked(), m_reach->value());
    accept();
  });
}

}  // namespace pitchboard::ui
