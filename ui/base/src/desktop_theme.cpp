// SPDX-License-Identifier: GPL-3.0-or-later
#include "desktop_theme.h"

#include <QApplication>
#include <QDBusConnection>
#include <QDBusMessage>
#include <QDBusPendingCallWatcher>
#include <QDBusPendingReply>
#include <QDBusVariant>
#include <QPalette>

namespace pitchboard::ui {
namespace {
const QString service = QStringLiteral("org.freedesktop.portal.Desktop");
const QString path = QStringLiteral("/org/freedesktop/portal/desktop");
const QString interface = QStringLiteral("org.freedesktop.portal.Settings");
const QString appearance = QStringLiteral("org.freedesktop.appearance");
const QString colorScheme = QStringLiteral("color-scheme");

// Read() wraps its answer in one more variant than the change signal does.
QVariant unwrapped(QVariant value) {
  while (value.canConvert<QDBusVariant>()) value = value.value<QDBusVariant>().variant();
  return value;
}
}  // namespace

DesktopTheme* DesktopTheme::of(QApplication& application) {
  auto* found = application.findChild<DesktopTheme*>(QString(), Qt::FindDirectChildrenOnly);
  return found != nullptr ? found : new DesktopTheme(application);
}

DesktopTheme::DesktopTheme(QApplication& application) : QObject(&application) {
  m_dark = QApplication::palette().color(QPalette::Window).lightness() < 128;
  if (qEnvironmentVariableIsEmpty("DBUS_SESSION_BUS_ADDRESS")) return;
  QDBusConnection bus = QDBusConnection::sessionBus();
  if (!bus.isConnected()) return;
  bus.connect(service, path, interface, QStringLiteral("SettingChanged"), this,
              SLOT(settingChanged(QString, QString, QDBusVariant)));
  QDBusMessage question =
      QDBusMessage::createMethodCall(service, path, interface, QStringLiteral("Read"));
  question << appearance << colorScheme;
  auto* watcher = new QDBusPendingCallWatcher(bus.asyncCall(question), this);
  connect(watcher, &QDBusPendingCallWatcher::finished, this, [this](QDBusPendingCallWatcher* done) {
    done->deleteLater();
    const QDBusPendingReply<QDBusVariant> reply = *done;
    if (reply.isValid()) take(unwrapped(reply.value().variant()).toUInt());
  });
}

void DesktopTheme::settingChanged(const QString& group, const QString& key,
                                  const QDBusVariant& value) {
  if (group == appearance && key == colorScheme) take(unwrapped(value.variant()).toUInt());
}

void DesktopTheme::take(uint scheme) {
  if (scheme == 0) return;  // the desktop has no preference
  const bool dark = scheme == 1;
  if (dark == m_dark) return;
  m_dark = dark;
  emit changed(dark);
}

}  // namespace pitchboard::ui
