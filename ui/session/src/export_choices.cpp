// SPDX-License-Identifier: GPL-3.0-or-later
// What can be chosen in the export dialog: robots, variables, lines, the time of day.
#include <QCheckBox>
#include <QComboBox>
#include <QDateTimeEdit>
#include <QDesktopServices>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QTemporaryDir>
#include <QToolButton>
#include <QUrl>

#include <ui/base/number_box.h>
#include <ui/session/export_dialog.h>

#include <ui/session/video_export.h>
#include "check_list.h"
#include "moment_box.h"

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
  auto* times = new QHBoxLayout(m_when);
  times->setContentsMargins(0, 0, 0, 0);
  times->addWidget(m_beginClock, 1);
  times->addWidget(new QLabel(QStringLiteral("to"), m_when));
  times->addWidget(m_endClock, 1);
  m_beginClock->setObjectName(QStringLiteral("exportBeginClock"));
  m_endClock->setObjectName(QStringLiteral("exportEndClock"));
  const std::pair<QDateTimeEdit*, MomentBox*> pairs[] = {{m_beginClock, m_begin},
                                                         {m_endClock, m_end}};
  for (const auto& [clock, box] : pairs) {
    clock->setDisplayFormat(QStringLiteral("yyyy-MM-dd HH:mm:ss"));
    connect(clock, &QDateTimeEdit::dateTimeChanged, this,
            [this, seconds = box](const QDateTime& time) {
              // A change of the seconds comes back here rounded.
              if (!m_source.clock || m_showingClock) return;
              seconds->setValue(static_cast<double>(m_source.clock->msecsTo(time)) / 1000.0);
            });
  }
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
  for (MomentBox* box : {m_begin, m_end}) {
    connect(box, &MomentBox::valueChanged, this, &ExportDialog::showClock);
  }
  showClock();
}

// People think in the time of day; a session counts seconds. Either can be typed.
void ExportDialog::showClock() {
  if (!m_source.clock) return;
  m_showingClock = true;
  m_beginClock->setDateTime(m_source.clock->addMSecs(qRound64(m_begin->value() * 1000.0)));
  m_endClock->setDateTime(m_source.clock->addMSecs(qRound64(m_end->value() * 1000.0)));
  m_showingClock = false;
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
