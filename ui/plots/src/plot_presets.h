// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Layouts of plots under names, in the user's settings; as files they can be handed on. UI thread
// only.

#include <QStringList>

#include <ui/plots/plot_layout.h>

class QSettings;

namespace pitchboard::ui {

class PlotPresets {
 public:
  /// Without settings there are none and nothing is kept.
  explicit PlotPresets(QSettings* settings) : m_settings(settings) {}

  QStringList names() const;
  /// Replaces one of this name.
  void save(const QString& name, const PlotLayout& layout);
  Result<PlotLayout> load(const QString& name) const;
  void remove(const QString& name);

  static Result<void> writeFile(const QString& path, const PlotLayout& layout);
  static Result<PlotLayout> readFile(const QString& path);

 private:
  QJsonObject all() const;
  QSettings* m_settings;
};

}  // namespace pitchboard::ui
