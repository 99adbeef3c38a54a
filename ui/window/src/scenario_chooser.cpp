// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenario_chooser.h"

#include <QAbstractItemView>
#include <QFileInfo>
#include <QSettings>
#include <QStylePainter>
#include <algorithm>

#include <robotlink/scenario/scenario.h>
#include <ui/base/theme.h>

namespace pitchboard::ui {
namespace {
const QString recentKey = QStringLiteral("scenarios/recent");
constexpr qsizetype maxRecent = 8;
}  // namespace

ScenarioChooser::ScenarioChooser(QSettings* settings, QWidget* parent)
    : QComboBox(parent), m_settings(settings) {
  setObjectName(QStringLiteral("scenarioChooser"));
  setToolTip(QStringLiteral("Scenario"));
  setSizeAdjustPolicy(QComboBox::AdjustToContents);
  setAccessibleName(QStringLiteral("Scenario"));
  setMaxVisibleItems(30);
  connect(this, &QComboBox::activated, this, [this](int index) {
    const QString picked = itemData(index).toString();
    if (picked == m_current) return;
    // Until it is really open, the old one is what is played.
    setCurrentIndex(findData(m_current));
    if (picked.isEmpty())
      emit openRequested();
    else
      emit chosen(picked);
  });
  fill();
}

void ScenarioChooser::showCurrent(const QString& nameOrPath, const QString& title) {
  m_current = nameOrPath;
  m_title = title;
  const auto builtIn = link::builtInScenarios();
  const bool isFile = std::none_of(builtIn.begin(), builtIn.end(), [&](const auto& known) {
    return nameOrPath == QString::fromStdString(known.name);
  });
  if (isFile && QFileInfo::exists(nameOrPath)) {
    QStringList recent = m_settings->value(recentKey).toStringList();
    recent.removeAll(nameOrPath);
    recent.prepend(nameOrPath);
    m_settings->setValue(recentKey, recent.mid(0, maxRecent));
  }
  fill();
}

// A title that is too long ends in dots, not in half a letter.
void ScenarioChooser::paintEvent(QPaintEvent*) {
  QStylePainter painter(this);
  QStyleOptionComboBox option;
  initStyleOption(&option);
  painter.drawComplexControl(QStyle::CC_ComboBox, option);
  const QRect room =
      style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, this);
  option.currentText =
      fontMetrics().elidedText(option.currentText, Qt::ElideRight, room.width() - scaled(this, 4));
  painter.drawControl(QStyle::CE_ComboBoxLabel, option);
}

QStringList ScenarioChooser::recentFiles() const {
  QStringList files = m_settings->value(recentKey).toStringList();
  files.removeIf([](const QString& file) { return !QFileInfo::exists(file); });
  return files;
}

void ScenarioChooser::fill() {
  clear();
  for (const link::ScenarioName& known : link::builtInScenarios()) {
    addItem(QString::fromStdString(known.title), QString::fromStdString(known.name));
  }
  bool separated = false;
  for (const QString& file : recentFiles()) {
    if (!separated) insertSeparator(count());
    separated = true;
    addItem(QFileInfo(file).completeBaseName(), file);
    setItemData(count() - 1, file, Qt::ToolTipRole);
  }
  if (!m_current.isEmpty() && findData(m_current) < 0) addItem(m_title, m_current);
  insertSeparator(count());
  addItem(QStringLiteral("Open…"), QString());
  view()->setMinimumWidth(view()->sizeHintForColumn(0) + scaled(this, 24));
  setCurrentIndex(findData(m_current));
}

}  // namespace pitchboard::ui
