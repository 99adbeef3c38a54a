// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The settings of Live in a dialog with settings of its own.

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>

#include <sys/ipc.h>
#include <sys/shm.h>

#include <ui/live/attach_dialog.h>
#include <ui/live/live_settings_dialog.h>
#include <ui/sources/live_controller.h>

#include "live_rig.h"
#include "profile_editor.h"
#include "teams_page.h"

namespace live_settings_rig {

using namespace pitchboard;
using namespace pitchboard::ui;

struct Dialog {
  QTemporaryDir folder;
  QSettings settings{folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat};
  LiveController live;
  LiveSettingsDialog* dialog = new LiveSettingsDialog(&live, &settings, nullptr);
  Dialog() { dialog->show(); }
  ~Dialog() { delete dialog; }
  template <class T>
  T* box(const char* name) {
    return dialog->findChild<T*>(QLatin1String(name));
  }
  void type(const char* name, const char* text) {
    auto* edit = box<QLineEdit>(name);
    edit->setText(QString::fromUtf8(text));
    emit edit->textEdited(edit->text());
  }
  /// As a person does it: programs may fill the list.
  void choose(const char* name, const char* text) {
    auto* list = box<QComboBox>(name);
    const int at = list->findText(QString::fromUtf8(text));
    QVERIFY(at >= 0);
    list->setCurrentIndex(at);
    emit list->activated(at);
  }
  QString problem() {
    auto* label = box<QLabel>("liveProblem");
    return label->isVisible() ? label->text() : QString();
  }
};

}  // namespace live_settings_rig
