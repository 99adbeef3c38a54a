// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever a person chooses by name is named by the document that describes it: a new scenario,
// noise preset, behaviour, metric or message format is not finished before.
#include <QFile>
#include <QRegularExpression>
#include <QSet>
#include <QtTest>

#include <robotlink/capi/world_lines.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/experiment/experiment.h>
#include <robotlink/experiment/run_result.h>
#include <robotlink/frame/match_event.h>
#include <robotlink/models/noise_presets.h>
#include <robotlink/models/robot_models.h>
#include <robotlink/processes/runtime_profile.h>
#include <robotlink/scenario/referee_rule_sets.h>
#include <robotlink/scenario/scenario.h>
#include <simcore/physics/physics_model.h>
#include <simcore/world/field.h>
#include <telemetry/formats/profile.h>
#include <telemetry/referee/gamecontroller_encoder.h>

namespace tst_documents {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

QString text(const QString& document) {
  QFile file(QStringLiteral(PITCHBOARD_SOURCE_DIR "/docs/") + document);
  if (!file.open(QIODevice::ReadOnly)) qFatal("no docs/%s", qPrintable(document));
  return QString::fromUtf8(file.readAll());
}

template <class List, class NameOf>
QStringList namesOf(const List& list, NameOf nameOf) {
  QStringList names;
  for (const auto& one : list) {
    const std::string_view name = nameOf(one);
    names << QString::fromUtf8(name.data(), qsizetype(name.size()));
  }
  return names;
}

const auto itself = [](const auto& one) -> std::string_view { return one; };
const auto itsName = [](const auto& one) -> std::string_view { return one.name; };

QStringList formats() {
  QStringList names;
  for (std::size_t i = 0; i < telemetry::messageFormatCount; ++i) {
    const auto name = telemetry::formatName(static_cast<telemetry::MessageFormat>(i));
    names << QString::fromUtf8(name.data(), qsizetype(name.size()));
  }
  return names;
}

QStringList meanings() {
  QStringList names;
  for (std::size_t i = 1; i < telemetry::fieldMeaningCount; ++i) {
    const auto name = telemetry::meaningName(static_cast<telemetry::FieldMeaning>(i));
    names << QString::fromUtf8(name.data(), qsizetype(name.size()));
  }
  return names;
}

QStringList events() {
  QStringList names;
  for (std::size_t i = 0; i < matchEventKindCount; ++i) {
    const auto name = info(static_cast<MatchEventKind>(i)).name;
    names << QString::fromUtf8(name.data(), qsizetype(name.size()));
  }
  return names;
}

}  // namespace

class TestDocuments : public QObject {
  Q_OBJECT

 private slots:
  void everythingThatIsChosenByNameIsNamed_data() {
    QTest::addColumn<QString>("document");
    QTest::addColumn<QStringList>("names");
    const auto row = [](const char* what, const char* document, const QStringList& names) {
      QTest::newRow(what) << QString(document) << names;
    };
    row("scenario", "scenarios.md", namesOf(builtInScenarios(), itsName));
    row("field", "scenarios.md", namesOf(sim::builtInFields(), itsName));
    row("noise preset", "scenarios.md", namesOf(noisePresets(), itself));
    row("kind of robot", "scenarios.md", namesOf(robotModels(), itself));
    row("physics model", "scenarios.md", namesOf(sim::physicsModels(), itsName));
    row("rule set", "referee.md", namesOf(refereeRuleSets(), itsName));
    row("runtime profile", "robot-programs.md", {"reference", "own", "published-tree"});
    row("process", "robot-programs.md", namesOf(referenceProcesses(), itsName));
    row("behaviour", "behaviours.md", namesOf(behaviours(), itsName));
    row("experiment", "experiments.md", namesOf(builtInExperiments(), itsName));
    row("situation test", "experiments.md", namesOf(builtInSituations(), itsName));
    row("metric", "experiments.md", namesOf(teamMetrics(), itsName));
    row("request", "worlds.md", namesOf(WorldLines::requests(), itself));
    row("profile of messages", "live.md", namesOf(telemetry::builtInProfiles(), itself));
    row("format of messages", "live.md", formats());
    row("meaning of a field", "live.md", meanings());
    row("kind of event", "sessions.md", events());
  }
  void everythingThatIsChosenByNameIsNamed() {
    QFETCH(QString, document);
    QFETCH(QStringList, names);
    QVERIFY(!names.isEmpty());
    const QString whole = text(document);
    for (const QString& name : names) {
      const bool named = whole.contains(QStringLiteral("`%1`").arg(name)) ||
                         whole.contains(QStringLiteral("**%1**").arg(name));
      QVERIFY2(named,
               qPrintable(QStringLiteral("docs/%1 does not name the %2 `%3`: say there what it is")
                              .arg(document, QTest::currentDataTag(), name)));
    }
  }

  void everyVersionOfTheRefereesPacketsIsDescribed() {
    // The first cells of the table of layouts: "12", "11/12/13", "15-18".
    static const QRegularExpression row(QStringLiteral("^\\| ([0-9/-]+) \\| [0-9]"),
                                        QRegularExpression::MultilineOption);
    QSet<int> described;
    for (auto rows = row.globalMatch(text("reference/gamecontroller.md")); rows.hasNext();) {
      for (const QString& cell : rows.next().captured(1).split('/')) {
        const int last = cell.section('-', -1).toInt();
        for (int version = cell.section('-', 0, 0).toInt(); version <= last; ++version)
          described.insert(version);
      }
    }
    for (int version = 0; version < 256; ++version) {
      if (!telemetry::refereePacketSize(version)) continue;
      QVERIFY2(
          described.contains(version),
          qPrintable(QStringLiteral("docs/reference/gamecontroller.md has no row for version %1 "
                                    "in its table of layouts")
                         .arg(version)));
    }
  }
};

PITCHBOARD_TEST(TestDocuments)

}  // namespace tst_documents

#include "tst_documents.moc"
