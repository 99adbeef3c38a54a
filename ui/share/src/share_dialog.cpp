// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/share/share_dialog.h>

#include <QCheckBox>
#include <QClipboard>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QGuiApplication>
#include <QLabel>
#include <QNetworkInterface>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QTimer>
#include <QVBoxLayout>

#include <ui/base/dialog_size.h>
#include <ui/base/in_place_message.h>
#include <ui/share/network_share.h>

namespace pitchboard::ui {
namespace {

const QString portKey = QStringLiteral("share/port");
const QString everyComputerKey = QStringLiteral("share/everyComputer");

/// The first address of this computer that others can use.
QString ownAddress() {
  for (const QHostAddress& one : QNetworkInterface::allAddresses()) {
    if (one.protocol() == QAbstractSocket::IPv4Protocol && !one.isLoopback()) return one.toString();
  }
  return QStringLiteral("127.0.0.1");
}

QString clientsText(std::size_t clients) {
  if (clients == 0) return QStringLiteral("nobody is connected");
  return clients == 1 ? QStringLiteral("1 program is connected")
                      : QStringLiteral("%1 programs are connected").arg(clients);
}

}  // namespace

QString addressOf(const NetworkShare& share) {
  return QStringLiteral("ws://%1:%2")
      .arg(share.options().everyComputer ? ownAddress() : QStringLiteral("127.0.0.1"))
      .arg(share.port());
}

ShareDialog::ShareDialog(NetworkShare* share, QSettings* settings, QWidget* parent)
    : QDialog(parent), m_share(share), m_settings(settings) {
  constexpr int refreshMilliseconds = 500;
  setObjectName(QStringLiteral("shareDialog"));
  setWindowTitle(QStringLiteral("Share on the network"));
  setAttribute(Qt::WA_DeleteOnClose);
  auto* about = new QLabel(
      QStringLiteral("Foxglove, Lichtblick and other programs that speak Foxglove's protocol see "
                     "what this window shows: rows, events, log and the field. They can play a "
                     "recording, and change nothing else."),
      this);
  about->setWordWrap(true);
  m_port = new QSpinBox(this);
  m_port->setObjectName(QStringLiteral("sharePort"));
  m_port->setRange(1, 65535);
  m_port->setValue(settings->value(portKey, ShareOptions().port).toInt());
  m_everyComputer = new QCheckBox(QStringLiteral("Every computer in the network may look"), this);
  m_everyComputer->setObjectName(QStringLiteral("shareEveryComputer"));
  m_everyComputer->setToolTip(
      QStringLiteral("Without a password. Otherwise only programs on this computer may look"));
  m_everyComputer->setChecked(settings->value(everyComputerKey, false).toBool());
  m_state = new QLabel(this);
  m_state->setObjectName(QStringLiteral("shareState"));
  m_state->setWordWrap(true);
  m_state->setTextInteractionFlags(Qt::TextSelectableByMouse);
  m_problem = new InPlaceMessage(this);
  m_problem->setObjectName(QStringLiteral("shareProblem"));
  m_problem->clear();

  auto* form = new QFormLayout;
  form->addRow(QStringLiteral("Port"), m_port);
  form->addRow(QString(), m_everyComputer);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  m_change = buttons->addButton(QString(), QDialogButtonBox::ActionRole);
  m_change->setObjectName(QStringLiteral("shareChange"));
  m_change->setDefault(true);
  m_copy = buttons->addButton(QStringLiteral("Copy address"), QDialogButtonBox::ActionRole);
  m_copy->setObjectName(QStringLiteral("shareCopy"));
  auto* column = new QVBoxLayout(this);
  column->addWidget(about);
  column->addLayout(form);
  column->addWidget(m_state);
  column->addWidget(m_problem);
  column->addStretch(1);
  column->addWidget(buttons);
  resize(dialogSize(this, 480, 260));

  connect(m_change, &QPushButton::clicked, this, &ShareDialog::change);
  connect(m_copy, &QPushButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(addressOf(*m_share)); });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(share, &NetworkShare::changed, this, &ShareDialog::refresh);
  connect(share, &NetworkShare::failed, this, [this](const QString& sentence) {
    m_problem->showMessage(InPlaceMessage::Tone::Error, sentence);
    refresh();
  });
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, &ShareDialog::refresh);
  timer->start(refreshMilliseconds);
  refresh();
  m_change->setFocus();
}

void ShareDialog::change() {
  m_problem->clear();
  if (m_share->isOn()) {
    m_share->stop();
    return;
  }
  m_settings->setValue(portKey, m_port->value());
  m_settings->setValue(everyComputerKey, m_everyComputer->isChecked());
  m_share->start({m_everyComputer->isChecked(), m_port->value()});
}

void ShareDialog::refresh() {
  const bool on = m_share->isOn();
  const bool isSeen = m_share->port() != 0;
  m_port->setEnabled(!on);
  m_everyComputer->setEnabled(!on);
  m_change->setText(on ? QStringLiteral("Stop sharing") : QStringLiteral("Share"));
  m_copy->setEnabled(isSeen);
  QString state = QStringLiteral("Nothing is shared.");
  if (on && !isSeen) state = QStringLiteral("Shared as soon as a match or recording is open.");
  if (isSeen) {
    const telemetry::FoxgloveServerStatus status = m_share->status();
    state =
        QStringLiteral("Shared at %1: %2.").arg(addressOf(*m_share), clientsText(status.clients));
    if (status.dropped > 0) {
      state +=
          QStringLiteral(" They read too slowly: %1 messages were left out.").arg(status.dropped);
    }
  }
  m_state->setText(state);
}

void showShareDialog(NetworkShare* share, QSettings* settings, QWidget* window) {
  auto* dialog = window->findChild<ShareDialog*>();
  if (dialog == nullptr) dialog = new ShareDialog(share, settings, window);
  dialog->show();
  dialog->raise();
  dialog->activateWindow();
}

}  // namespace pitchboard::ui
