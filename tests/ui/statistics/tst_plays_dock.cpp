// SPDX-License-Identifier: GPL-3.0-or-later
// The panel Play by play: the plays of a tally of the same recording, filters, and what a row leads
// to.
#include <QtTest>

#include <QComboBox>
#include <QDockWidget>
#include <QTableView>
#include <set>

#include <robotlink/report/session_tally.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>

#include "../../support/program_run.h"
#include "../studio_rig.h"
#include "plays_model.h"

namespace tst_plays_dock {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

constexpr int patience_ms = 30'000;

struct Panel : studio_rig::Studio {
  QDockWidget* dock = window.findChild<QDockWidget*>(QStringLiteral("plays"));
  QTableView* table = dock->findChild<QTableView*>(QStringLiteral("plays"));
  PlaysModel* model = dock->findChild<PlaysModel*>(QStringLiteral("playsModel"));

  Panel() {
    dock->show();
    dock->raise();
  }
  void choose(const char* box, const QString& text) const {
    auto* found = dock->findChild<QComboBox*>(QLatin1String(box));
    const int index = found->findText(text);
    if (index < 0) qFatal("no such entry");
    found->setCurrentIndex(index);
  }
  void trigger(const char* action) const {
    table->findChild<QAction*>(QLatin1String(action))->trigger();
  }
};

}  // namespace

class TestPlaysDock : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  QString m_match = m_folder.filePath(QStringLiteral("match.mcap"));

 private slots:
  void initTestCase() {
    const ProgramRun run = cli(
        {"record", "--scenario", "match-3v3", "--duration", "60", "--seed", "4", "-o", m_match});
    QVERIFY2(run.exitCode == 0, run.err.constData());
  }

  void aRecordingHasThePlaysOfItsTally() {
    const auto session = telemetry::SessionReader::open(m_match.toStdString()).value();
    const auto plays = link::statisticsOf(session, *session.range()).plays;
    QVERIFY(plays.size() >= 8);
    Panel panel;
    panel.window.openSession(m_match);
    QTRY_COMPARE_WITH_TIMEOUT(panel.model->rowCount(), static_cast<int>(plays.size()), patience_ms);
    QVERIFY(panel.model->plays() == plays);

    panel.choose("playKind", QStringLiteral("Ball won"));
    panel.choose("playRobot", QStringLiteral("B1"));
    const auto expected = std::ranges::count_if(plays, [](const link::PlayEvent& play) {
      return play.kind == link::PlayKind::BallWon && (play.name == "B1" || play.otherName == "B1");
    });
    QVERIFY(expected > 0);
    QCOMPARE(panel.table->model()->rowCount(), static_cast<int>(expected));
    panel.choose("playKind", QStringLiteral("All kinds"));
    panel.choose("playRobot", QStringLiteral("Both teams"));

    const QModelIndex row = panel.table->model()->index(3, PlaysModel::What);
    panel.table->scrollTo(row);
    QTest::mouseClick(panel.table->viewport(), Qt::LeftButton, {},
                      panel.table->visualRect(row).center());
    QVERIFY(std::abs(panel.window.shown()->time() - plays[3].time) < 1e-6);
    panel.trigger("bookmarkPlay");
    const auto& events = panel.window.shown()->events()->events();
    QVERIFY(std::ranges::any_of(events, [&plays](const link::MatchEvent& event) {
      return event.kind == link::MatchEventKind::Bookmark &&
             event.detail == link::sentenceOf(plays[3]) &&
             std::abs(event.time - plays[3].time) < 1e-6;
    }));
  }

  /// The widget keeps up with a long season's list.
  void tenThousandPlaysAreFiltered() {
    PlaysModel model;
    PlaysFilter filter;
    filter.setSourceModel(&model);
    std::vector<link::PlayEvent> plays(10'000);
    for (std::size_t i = 0; i < plays.size(); ++i) {
      plays[i].kind = static_cast<link::PlayKind>(i % link::playKindCount);
      plays[i].time = static_cast<double>(i);
      plays[i].name = i % 4 == 0 ? "B1" : "R2";
    }
    model.show(plays, {});
    QCOMPARE(filter.rowCount(), 10'000);
    filter.setKind(link::PlayKind::Shot);
    filter.setWho("B1", {});
    QCOMPARE(filter.rowCount(), 357);  // of each 28 plays the ninth
    filter.setFilterText(QStringLiteral("shoots"));
    QCOMPARE(filter.rowCount(), 357);
  }
};

PITCHBOARD_GUI_TEST(TestPlaysDock)

}  // namespace tst_plays_dock

#include "tst_plays_dock.moc"
