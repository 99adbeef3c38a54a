// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/field/field_settings.h>

#include <QAction>
#include <QSettings>

#include <ui/field/field_view.h>

#include "field_scene.h"

namespace pitchboard::ui {
namespace {

const QString wedgeKey = QStringLiteral("field/fieldOfViewOfAll");
const QString eopraKey = QStringLiteral("field/eopraGranularity");
const QString publishedKey = QStringLiteral("field/publishedKeys");
const QString hiddenKey = QStringLiteral("field/hiddenDrawings");
const QString selectedKey = QStringLiteral("field/drawingsOfSelected");
constexpr qsizetype maxHidden = 1000;  // whatever a file says

QString layerKey(std::size_t layer) {
  return QStringLiteral("field/layer/") + QLatin1String(fieldLayers[layer].key);
}

// "*/ball model": that layer of all robots; "1.3/": all of robot 3 of the first team; "1.3/path":
// that layer of it.
QString keyText(const RobotKey& robot) {
  return QStringLiteral("%1.%2").arg(robot.team).arg(robot.number);
}

QStringList textsOf(const DrawingChoice& choice) {
  QStringList texts;
  for (const std::string& layer : choice.hiddenLayers) {
    texts << QStringLiteral("*/") + QString::fromStdString(layer);
  }
  for (const RobotKey& robot : choice.hiddenRobots) texts << keyText(robot) + QLatin1Char('/');
  for (const auto& [robot, layer] : choice.hidden) {
    texts << keyText(robot) + QLatin1Char('/') + QString::fromStdString(layer);
  }
  return texts;
}

DrawingChoice choiceFrom(const QStringList& texts) {
  DrawingChoice choice;
  for (const QString& text : texts.mid(0, maxHidden)) {
    const qsizetype slash = text.indexOf(QLatin1Char('/'));
    if (slash < 1) continue;
    const std::string layer = text.mid(slash + 1).toStdString();
    if (text.startsWith(QLatin1Char('*'))) {
      if (!layer.empty()) choice.hiddenLayers.insert(layer);
      continue;
    }
    const QStringList parts = text.left(slash).split(QLatin1Char('.'));
    bool good = false;
    const int last = parts.last().toInt(&good);
    if (!good) continue;
    // Until 0.8 one number stood for team and number.
    const RobotKey robot = parts.size() == 2 ? RobotKey{parts[0].toInt(), last, 0}
                                             : link::keyOfOldId(last, last > 1000);
    if (layer.empty())
      choice.hiddenRobots.insert(robot);
    else
      choice.hidden.insert({robot, layer});
  }
  return choice;
}

void put(QSettings& settings, const QString& key, const QVariant& value, const QVariant& usual) {
  if (value == usual)
    settings.remove(key);
  else if (settings.value(key) != value)
    settings.setValue(key, value);
}

}  // namespace

void restoreFieldLayers(FieldView& field, const QSettings& settings) {
  const std::vector<QAction*> layers = field.actions().layers;
  for (std::size_t i = 0; i < fieldLayerCount; ++i) {
    QAction* layer = layers[i];
    layer->setChecked(settings.value(layerKey(i), layer->isChecked()).toBool());
  }
  const int granularity = settings.value(eopraKey).toInt();
  for (QAction* option : field.actions().options) {
    if (option->objectName() == QStringLiteral("fieldOfViewOfAll")) {
      option->setChecked(settings.value(wedgeKey, option->isChecked()).toBool());
    } else if (option->objectName() == QStringLiteral("eopra%1").arg(granularity)) {
      option->setChecked(true);
    }
  }
  field.actions().publishedKeys->setChecked(settings.value(publishedKey, false).toBool());
  DrawingChoice choice = choiceFrom(settings.value(hiddenKey).toStringList());
  choice.onlySelected = settings.value(selectedKey, false).toBool();
  field.findChild<FieldScene*>()->changeStyle(
      [&choice](FieldStyle& style) { style.drawings = choice; });
}

void saveFieldLayers(const FieldView& field, QSettings& settings) {
  const FieldStyle& now = field.findChild<FieldScene*>()->style();
  const FieldStyle usual;
  for (std::size_t i = 0; i < fieldLayerCount; ++i) {
    put(settings, layerKey(i), now.layers[i], usual.layers[i]);
  }
  put(settings, wedgeKey, now.wedgeForAll, usual.wedgeForAll);
  put(settings, eopraKey, now.eopraGranularity, usual.eopraGranularity);
  put(settings, publishedKey, field.actions().publishedKeys->isChecked(), false);
  put(settings, hiddenKey, textsOf(now.drawings), QStringList());
  put(settings, selectedKey, now.drawings.onlySelected, false);
}

}  // namespace pitchboard::ui
