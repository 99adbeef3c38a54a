// SPDX-License-Identifier: GPL-3.0-or-later
#include <ui/window/scenario_files.h>

#include <QFileInfo>
#include <map>

#include <base/file_target.h>
#include <ui/base/file_dialog.h>
#include <ui/field/field_view.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_edits.h>

#include "scenario_chooser.h"

namespace pitchboard::ui {

ScenarioFiles::ScenarioFiles(MatchController* controller, FieldView* field,
                             ScenarioChooser* chooser, QWidget* window)
    : QObject(window),
      m_controller(controller),
      m_field(field),
      m_chooser(chooser),
      m_window(window) {}

void ScenarioFiles::open(const QString& nameOrPath) {
  read(nameOrPath, [this](const link::Scenario& scenario) {
    const QString title =
        QString::fromStdString(scenario.title.empty() ? scenario.name : scenario.title);
    m_controller->edits()->replaceMatch(scenario, QStringLiteral("Open “%1”").arg(title),
                                        QStringLiteral("Opened “%1”").arg(title),
                                        m_controller->isPaused());
  });
}

void ScenarioFiles::load(const QString& nameOrPath) {
  if (m_controller->edits()->allowsChange()) open(nameOrPath);
}

void ScenarioFiles::read(const QString& nameOrPath,
                         const std::function<void(const link::Scenario&)>& play) {
  const auto scenario = link::loadScenario(nameOrPath.toStdString());
  if (!scenario) {
    constexpr int most = 3;
    const QStringList errors =
        QString::fromStdString(scenario.error().text()).split(QLatin1Char('\n'));
    QString text = QStringLiteral("Could not open the scenario: %1")
                       .arg(errors.mid(0, most).join(QLatin1Char('\n')));
    if (errors.size() > most) {
      text += QStringLiteral("\nAnd %1 more.").arg(errors.size() - most);
    }
    emit failed(text);
    return;
  }
  play(*scenario);
  showCurrent(nameOrPath);
}

void ScenarioFiles::showCurrent(const QString& nameOrPath) {
  const QFileInfo file(nameOrPath);
  m_chooser->showCurrent(file.exists() ? file.absoluteFilePath() : nameOrPath,
                         QString::fromStdString(m_controller->scenario().title));
}

void ScenarioFiles::save(const QString& path) {
  save(path, m_controller->currentMoment());
}

void ScenarioFiles::save(const QString& path, link::Scenario moment) {
  moment.name = QFileInfo(path).completeBaseName().toStdString();
  moment.title = moment.name;
  const auto written =
      writeFile(path.toStdString(), link::scenarioToJson(moment), IfExists::Replace);
  if (!written) {
    emit failed(QStringLiteral("Could not save the scenario. %1")
                    .arg(QString::fromStdString(written.error().text())));
  }
}

QByteArray ScenarioFiles::picture(const QString& suffix) const {
  return m_field->pictureFile(m_field->size() * m_window->devicePixelRatioF(), suffix);
}

void ScenarioFiles::exportPicture(const QString& path) {
  writePicture(path, picture(QFileInfo(path).suffix()));
}

void ScenarioFiles::writePicture(const QString& path, const QByteArray& bytes) {
  if (bytes.isEmpty()) {
    emit failed(
        QStringLiteral("Cannot write a picture to %1. Choose a name that ends in .png or .svg.")
            .arg(path));
    return;
  }
  const auto written =
      writeFile(path.toStdString(), {bytes.constData(), static_cast<std::size_t>(bytes.size())},
                IfExists::Replace);
  if (!written) {
    emit failed(QStringLiteral("Could not write the picture. %1")
                    .arg(QString::fromStdString(written.error().text())));
  }
}

void ScenarioFiles::askAndOpen() {
  const QString path = askToOpen(m_window, QStringLiteral("Open scenario"),
                                 QStringLiteral("Scenarios (*.json);;All files (*)"));
  if (!path.isEmpty()) open(path);
}

// The match goes on behind the dialogs: what is saved is taken before.
void ScenarioFiles::askAndSave() {
  const link::Scenario moment = m_controller->currentMoment();
  QString path = askToSave(m_window, QStringLiteral("Save this moment as a scenario"),
                           QStringLiteral("moment.json"), QStringLiteral("Scenarios (*.json)"));
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += QStringLiteral(".json");
  save(path, moment);
}

void ScenarioFiles::askAndExportPicture() {
  const QString png = QStringLiteral("png"), svg = QStringLiteral("svg");
  const std::map<QString, QByteArray> pictures{{png, picture(png)}, {svg, picture(svg)}};
  QString path = askToSave(m_window, QStringLiteral("Export a picture of the field"),
                           QStringLiteral("field.png"), QStringLiteral("Pictures (*.png *.svg)"));
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += QStringLiteral(".png");
  const auto taken = pictures.find(QFileInfo(path).suffix().toLower());
  writePicture(path, taken == pictures.end() ? QByteArray() : taken->second);
}

}  // namespace pitchboard::ui
