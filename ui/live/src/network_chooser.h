// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where Live listens: every network interface of this computer, or one, chosen by name and address.
// Another address may be typed. The list is made again whenever it opens, since networks come and
// go; an address that is not there at the moment stays chosen, and says so. UI thread only.

#include <QComboBox>
#include <functional>

namespace pitchboard::ui {

struct NetworkAddress {
  QString interface;  ///< "eth0"
  QString address;    ///< IPv4, "192.168.0.12"
};
/// Of the interfaces that are up.
QList<NetworkAddress> networkAddresses();

class NetworkChooser : public QComboBox {
  Q_OBJECT
 public:
  using Addresses = std::function<QList<NetworkAddress>()>;
  explicit NetworkChooser(QWidget* parent, Addresses addresses = networkAddresses);

  void setAddress(const QString& address);
  /// What is chosen, or what was typed as it is.
  QString address() const;

  void showPopup() override;

 private:
  void offer(const QString& chosen);

  Addresses m_addresses;
};

}  // namespace pitchboard::ui
