// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether the desktop is dark: its settings portal says so and tells changes; without one, the
// palette that the application started with decides. UI thread; never waits for the desktop.

#include <QObject>

class QApplication;
class QDBusVariant;

namespace pitchboard::ui {

class DesktopTheme : public QObject {
  Q_OBJECT
 public:
  /// The application's own; made at the first call, which must come before any setPalette().
  static DesktopTheme* of(QApplication& application);
  bool isDark() const { return m_dark; }

 signals:
  void changed(bool dark);

 private slots:
  void settingChanged(const QString& group, const QString& key, const QDBusVariant& value);

 private:
  explicit DesktopTheme(QApplication& application);
  void take(uint colorScheme);
  bool m_dark = false;
};

}  // namespace pitchboard::ui
