// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_presets.h"

#include <QJsonDocument>
#include <QSaveFile>
#include <QSettings>

#include <base/read_file.h>
#include <ui/base/save_file.h>

namespace pitchboard::ui {
namespace {
const QString presetsKey = QStringLiteral("plots/presets");
constexpr std::size_t largestFile = 4 << 20;  // bytes; a layout has some kilobytes
}  // namespace

QJsonObject PlotPresets::all() const {
  if (m_settings == nullptr) return {};
  return QJsonDocument::fromJson(m_settings->value(presetsKey).toByteArray()).object();
}

QStringList PlotPresets::names() const {
  return all().keys();
}

void PlotPresets::save(const QString& name, const PlotLayout& layout) {
  if (m_settings == nullptr) return;
  QJsonObject presets = all();
  presets[name] = toJson(layout);
  m_settings->setValue(presetsKey, QJsonDocument(presets).toJson(QJsonDocument::Compact));
}

Result<PlotLayout> PlotPresets::load(const QString& name) const {
  const QJsonObject presets = all();
  if (!presets.contains(name)) {
    return failure(ErrorCode::NotFound, "There is no layout of this name.", name.toStdString());
  }
  const QByteArray text = QJsonDocument(presets[name].toObject()).toJson();
  return layoutFromText({text.data(), std::size_t(text.size())}, name.toStdString());
}

void PlotPresets::remove(const QString& name) {
  if (m_settings == nullptr) return;
  QJsonObject presets = all();
  presets.remove(name);
  m_settings->setValue(presetsKey, QJsonDocument(presets).toJson(QJsonDocument::Compact));
}

Result<void> PlotPresets::writeFile(const QString& path, const PlotLayout& layout) {
  QSaveFile file(path);
  const QByteArray bytes = QJsonDocument(toJson(layout)).toJson();
  if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size() || !commitWhole(file)) {
    return failure(ErrorCode::SystemError,
                   "The layout could not be written: " + file.errorString().toStdString() + ".",
                   path.toStdString());
  }
  return {};
}

Result<PlotLayout> PlotPresets::readFile(const QString& path) {
  const auto text = pitchboard::readFile(path.toStdString(), largestFile, "The layout");
  if (!text) return tl::unexpected(text.error());
  return layoutFromText(*text, path.toStdString());
}

}  // namespace pitchboard::ui
