// SPDX-License-Identifier: GPL-3.0-or-later
#include "network_chooser.h"

#include <QHostAddress>
#include <QNetworkInterface>

namespace pitchboard::ui {
namespace {
const QString every = QStringLiteral("0.0.0.0");
}

QList<NetworkAddress> networkAddresses() {
  QList<NetworkAddress> all;
  for (const QNetworkInterface& interface : QNetworkInterface::allInterfaces()) {
    if (!interface.flags().testFlag(QNetworkInterface::IsUp)) continue;
    for (const QNetworkAddressEntry& entry : interface.addressEntries()) {
      if (entry.ip().protocol() != QAbstractSocket::IPv4Protocol) continue;
      all << NetworkAddress{interface.humanReadableName(), entry.ip().toString()};
    }
  }
  return all;
}

NetworkChooser::NetworkChooser(QWidget* parent, Addresses addresses)
    : QComboBox(parent), m_addresses(std::move(addresses)) {
  setEditable(true);
  setInsertPolicy(NoInsert);
  setCompleter(nullptr);  // what is typed counts as it is
  offer(every);
}

void NetworkChooser::offer(const QString& chosen) {
  clear();
  addItem(QStringLiteral("every interface"), every);
  for (const NetworkAddress& one : m_addresses()) {
    addItem(QStringLiteral("%1 — %2").arg(one.interface, one.address), one.address);
  }
  int index = findData(chosen);
  if (index < 0 && !QHostAddress(chosen).isNull()) {
    index = count();
    addItem(QStringLiteral("%1 (not on this computer now)").arg(chosen), chosen);
  }
  setCurrentIndex(index);
  if (index < 0) setEditText(chosen);
}

void NetworkChooser::setAddress(const QString& address) {
  offer(address);
}

QString NetworkChooser::address() const {
  const QString text = currentText().trimmed();
  const int index = findText(text);
  return index >= 0 ? itemData(index).toString() : text;
}

void NetworkChooser::showPopup() {
  offer(address());
  QComboBox::showPopup();
}

}  // namespace pitchboard::ui
