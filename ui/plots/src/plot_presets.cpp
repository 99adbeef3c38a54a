// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_presets.h"

#include <QJsonDocument>
#include <QSettings>

#include <base/file_target.h>
#include <base/read_file.h>

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
    return failure(ErrorCode::NotFound, "There is no layout with this name.", name.toStdString());
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
  return pitchboard::writeFile(
      path.toStdString(), QJsonDocument(toJson(layout)).toJson().toStdString(), IfExists::Replace);
}

Result<PlotLayout> PlotPresets::readFile(const QString& path) {
  const auto text = pitchboard::readFile(path.toStdString(), largestFile, "The layout");
  if (!text) return tl::unexpected(text.error());
  return layoutFromText(*text, path.toStdString());
}

}  // namespace pitchboard::ui
