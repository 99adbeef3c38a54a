// SPDX-License-Identifier: GPL-3.0-or-later
#include "catalog_choice.h"

#include <QFileInfo>
#include <QSettings>

#include <ui/base/file_dialog.h>
#include <ui/base/in_place_message.h>
#include <ui/sources/match_controller.h>

namespace pitchboard::ui {
namespace {

const QString fileKey = QStringLiteral("variables/catalog");

struct ReadCatalog {
  std::shared_ptr<const link::VariableCatalog> catalog;
  QString problem;
};

ReadCatalog read(const QString& file) {
  auto made = link::VariableCatalog::fromFile(file.toStdString());
  if (!made) return {nullptr, QString::fromStdString(made.error().text())};
  return {std::make_shared<const link::VariableCatalog>(std::move(*made)), {}};
}

}  // namespace

CatalogChoice::CatalogChoice(MatchController* controller, QSettings* settings,
                             InPlaceMessage* message, QObject* parent)
    : QObject(parent), m_controller(controller), m_settings(settings), m_message(message) {
  const QString file = m_settings ? m_settings->value(fileKey).toString() : QString();
  if (file.isEmpty()) return;
  const ReadCatalog remembered = read(file);
  if (remembered.catalog) {
    m_file = file;
    m_controller->setCatalog(remembered.catalog);
  } else {
    m_message->showMessage(
        InPlaceMessage::Tone::Error,
        QStringLiteral("Could not read the imported catalog, so the published one is used: %1")
            .arg(remembered.problem));
  }
}

QString CatalogChoice::name() const {
  return m_file.isEmpty() ? QStringLiteral("Published catalog")
                          : QStringLiteral("Catalog of %1").arg(QFileInfo(m_file).fileName());
}

void CatalogChoice::askAndImport(QWidget* parent) {
  const QString file = askToOpen(parent, QStringLiteral("Import variable catalog"),
                                 QStringLiteral("Catalogs (*.h *.hpp *.py *.json);;All files (*)"));
  if (!file.isEmpty()) importFile(file);
}

void CatalogChoice::importFile(const QString& file) {
  const ReadCatalog made = read(file);
  if (!made.catalog) {
    m_message->showMessage(InPlaceMessage::Tone::Error,
                           QStringLiteral("Could not import the catalog. %1").arg(made.problem));
    return;
  }
  m_file = QFileInfo(file).absoluteFilePath();
  if (m_settings) m_settings->setValue(fileKey, m_file);
  m_controller->setCatalog(made.catalog);
  offerRestart(QStringLiteral("%1 variables read from %2.")
                   .arg(made.catalog->variables().size())
                   .arg(QFileInfo(file).fileName()));
}

void CatalogChoice::usePublished() {
  m_file.clear();
  if (m_settings) m_settings->remove(fileKey);
  m_controller->setCatalog({&link::VariableCatalog::published(), [](const auto*) {}});
  offerRestart(QStringLiteral("The published catalog is used again."));
}

void CatalogChoice::offerRestart(const QString& sentence) {
  const bool playing = m_controller->isOpen() || m_controller->isOpening();
  if (!playing || m_controller->catalog() == m_controller->nextCatalog()) {
    m_message->showMessage(InPlaceMessage::Tone::Note, sentence);
    return;
  }
  QString all = sentence + QLatin1Char(' ') + QStringLiteral("They apply from the next match on.");
  if (!isPublished() && m_controller->cognition() == link::Cognition::Separate) {
    all += QLatin1Char(' ') + QStringLiteral(
                                  "The studio's reference processes only know the published "
                                  "catalog: use your team's programs with this one.");
  }
  m_message->showMessage(InPlaceMessage::Tone::Note, all, QStringLiteral("Restart the match"),
                         [this] { m_controller->restart(); });
}

}  // namespace pitchboard::ui
