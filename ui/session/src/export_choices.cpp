// SPDX-License-Identifier: GPL-3.0-or-later
// What can be chosen in the export dialog: robots, variables, lines, the time of day.
#include <QCheckBox>
#include <QComboBox>
#include <QDesktopServices>
#include <QFileInfo>
#include <QLabel>
#include <QTemporaryDir>
#include <QToolButton>
#include <QUrl>

#include <ui/base/number_box.h>
#include <ui/session/export_dialog.h>

#include "check_list.h"
#include "video_export.h"

namespace pitchboard::ui {
namespace {

std::vector<std::string> textsOf(const QStringList& names) {
  std::vector<std::string> texts;
  for (const QString& name : names) texts.push_back(name.toStdString());
  return texts;
}

}  // namespace

void ExportDialog::makeChoices() {
  m_lines->setObjectName(QStringLiteral("exportLines"));
  m_lines->setRange(0.001, telemetry::Resampling::mostPerSecond);
  m_lines->setDecimals(3);
  m_lines->setValue(telemetry::Resampling{}.rate);
  m_lines->setSuffix(QStringLiteral(" a second"));
  m_between->setObjectName(QStringLiteral("exportBetween"));
  m_between->addItem(QStringLiteral("Hold the last value"), false);
  m_between->addItem(QStringLiteral("Interpolate"), true);
  m_clock->setObjectName(QStringLiteral("exportClock"));
  m_clock->setChecked(m_source.clock.has_value());
  m_when->setObjectName(QStringLiteral("exportWhen"));
  m_when->setForegroundRole(QPalette::PlaceholderText);
  m_open->setText(QStringLiteral("Open"));
  m_open->setObjectName(QStringLiteral("exportOpen"));
  m_show->setText(QStringLiteral("Show in folder"));
  m_show->setObjectName(QStringLiteral("exportShow"));
  for (QToolButton* button : {m_open, m_show}) button->hide();
  connect(m_open, &QToolButton::clicked, this,
          [this] { QDesktopServices::openUrl(QUrl::fromLocalFile(m_written)); });
  connect(m_show, &QToolButton::clicked, this, [this] {
    QDesktopServices::openUrl(QUrl::fromLocalFile(QFileInfo(m_written).absolutePath()));
  });
  for (NumberBox* box : {m_begin, m_end}) {
    connect(box, &NumberBox::valueChanged, this, &ExportDialog::showClock);
  }
  showClock();
}

// People think in the time of day; the boxes are in seconds of the session.
void ExportDialog::showClock() {
  if (!m_source.clock) return;
  const auto text = [this](double seconds) {
    return m_source.clock->addMSecs(qRound64(seconds * 1000.0))
        .toString(QStringLiteral("yyyy-MM-dd HH:mm:ss"));
  };
  m_when->setText(QStringLiteral("%1 to %2").arg(text(m_begin->value()), text(m_end->value())));
}

/// False: it has said what is missing.
bool ExportDialog::takeChoices(telemetry::ExportSelection& selection) {
  const QStringList robots = m_robots->checked(), variables = m_variables->checked();
  if (m_source.groups.empty()) return true;  // nothing to choose from yet: everything
  if (robots.isEmpty() || variables.isEmpty()) {
    fail(robots.isEmpty() ? QStringLiteral("Tick at least one robot.")
                          : QStringLiteral("Tick at least one variable."));
    return false;
  }
  if (!m_robots->isAllChecked()) selection.robots = textsOf(robots);
  if (!m_variables->isAllChecked()) {
    // Those that the ticked robots have.
    QStringList known;
    for (const auto& group : m_source.groups) {
      if (!robots.contains(QString::fromStdString(group.name))) continue;
      for (const auto& column : group.columns) known << QString::fromStdString(column.name);
    }
    for (const QString& name : variables) {
      if (known.contains(name)) selection.variables.push_back(name.toStdString());
    }
    if (selection.variables.empty()) {
      fail(QStringLiteral("The ticked robots have none of the ticked variables."));
      return false;
    }
  }
  selection.clock = m_clock->isChecked();
  selection.resampling = {m_lines->value(), m_between->currentData().toBool()};
  return true;
}

}  // namespace pitchboard::ui
