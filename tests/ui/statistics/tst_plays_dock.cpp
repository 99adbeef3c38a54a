// SPDX-License-Identifier: GPL-3.0-or-later
// The panel Play by play: the plays of a tally of the same recording, filters, and what a row leads
// to.
#include <QtTest>

#include <QComboBox>
#include <QDockWidget>
#include <QLineEdit>
#include <QScrollBar>
#include <QTableView>
#include <set>

#include <robotlink/report/session_tally.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>

#include "../../support/program_run.h"
#include "../../support/sanitized.h"
#include "../event_loop_watchdog.h"
#include "../studio_rig.h"
#include "plays_model.h"

namespace tst_plays_dock {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

constexpr int patience_ms = 30'000;

struct Panel : studio_rig::PanelStudio {
  QTableView* table = dock->findChild<QTableView*>(QStringLiteral("plays"));
  PlaysModel* model = dock->findChild<PlaysModel*>(QStringLiteral("playsModel"));

  Panel() : PanelStudio("plays") {}
  void choose(const char* box, const QString& text) const {
    auto* found = find<QComboBox>(box);
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
    QVERIFY(panel.model->sessions().front().plays == plays);

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

  void theWindowIsNotBlocked() {
    Panel panel;
    QVERIFY(QTest::qWaitForWindowExposed(&panel.window));
    panel.window.openSession(m_match);
    QTRY_VERIFY_WITH_TIMEOUT(panel.window.replay()->loaded() >= 1.0, patience_ms);
    QTRY_VERIFY_WITH_TIMEOUT(panel.model->rowCount() > 0, patience_ms);
    constexpr int many = 10'000;
    std::vector<link::PlayEvent> plays;
    while (plays.size() < many) plays.push_back(panel.model->sessions()[0].plays[plays.size() % 8]);
    for (std::size_t i = 0; i < plays.size(); ++i) plays[i].time = static_cast<double>(i);
    PlayWords made = wordsOf(plays);  // on the thread that counts
    const tests::EventLoopWatchdog turns;
    panel.model->show({{0, 0, {}, 0.0, plays, std::move(made)}}, {});
    QTest::qWait(1);
    auto* words = panel.dock->findChild<QLineEdit*>(QStringLiteral("playFilter"));
    for (const char key : std::string_view("ball b1")) {
      QTest::keyClick(words, key);
      QTest::qWait(1);
    }
    QVERIFY(panel.table->model()->rowCount() > 0);
    words->clear();
    QTest::qWait(1);
    QCOMPARE(panel.table->model()->rowCount(), many);
    for (const char* box : {"playKind", "playRobot"}) {
      auto* choice = panel.find<QComboBox>(box);
      for (int i = 0; i < choice->count(); ++i) {
        choice->setCurrentIndex(i);
        QTest::qWait(1);
      }
      choice->setCurrentIndex(0);
      QTest::qWait(1);
    }
    for (const int row : {0, many / 2, many - 1}) {
      const QModelIndex chosen = panel.table->model()->index(row, PlaysModel::What);
      panel.table->scrollTo(chosen);
      QTest::qWait(1);
      QTest::mouseClick(panel.table->viewport(), Qt::LeftButton, {},
                        panel.table->visualRect(chosen).center());
      QTest::qWait(1);
      QCOMPARE(panel.table->currentIndex().row(), row);
    }
    for (int i = 0; i <= 10; ++i) {
      QScrollBar* bar = panel.table->verticalScrollBar();
      bar->setValue(bar->maximum() / 10 * i);
      QTest::qWait(1);
    }
    for (int column = 0; column < panel.model->columnCount(); ++column) {
      panel.table->sortByColumn(column, Qt::DescendingOrder);
      QTest::qWait(1);
    }
    qInfo("longest turn: %.1f ms of work, %.1f ms by the clock", turns.longest_ms(),
          turns.gap_ms());
    if (PITCHBOARD_SANITIZED) return;
    QVERIFY2(turns.longest_ms() < 50.0, qPrintable(QString::number(turns.longest_ms())));
  }

  void theSelectionSurvivesAChangeOfTheFilter() {
    Panel panel;
    panel.window.openSession(m_match);
    QTRY_VERIFY_WITH_TIMEOUT(panel.model->rowCount() >= 8, patience_ms);
    const auto& plays = panel.model->sessions()[0].plays;
    const auto play = std::ranges::find(plays, link::PlayKind::BallWon, &link::PlayEvent::kind);
    QVERIFY(play != plays.end());
    const auto row = static_cast<int>(play - plays.begin());
    const QModelIndex cell = panel.table->model()->index(row, PlaysModel::What);
    panel.table->scrollTo(cell);
    QTest::mouseClick(panel.table->viewport(), Qt::LeftButton, {},
                      panel.table->visualRect(cell).center());
    const auto selected = [&panel]() -> const link::PlayEvent* {
      const QModelIndexList rows = panel.table->selectionModel()->selectedRows();
      if (rows.size() != 1 || rows[0].row() != panel.table->currentIndex().row()) return nullptr;
      const auto* filter = qobject_cast<const QAbstractProxyModel*>(panel.table->model());
      return &panel.model->at(filter->mapToSource(rows[0]).row());
    };
    QVERIFY(selected() != nullptr && *selected() == *play);
    // By kind, robot and words; and when all are back.
    panel.choose("playKind", QStringLiteral("Ball won"));
    QVERIFY(panel.table->model()->rowCount() < panel.model->rowCount());
    QVERIFY(selected() != nullptr && *selected() == *play);
    panel.choose("playRobot", QString::fromStdString(play->name));
    QVERIFY(selected() != nullptr && *selected() == *play);
    panel.find<QLineEdit>("playFilter")->setText(QString::fromStdString(play->name));
    QVERIFY(selected() != nullptr && *selected() == *play);
    panel.choose("playKind", QStringLiteral("All kinds"));
    panel.choose("playRobot", QStringLiteral("Both teams"));
    panel.find<QLineEdit>("playFilter")->clear();
    QCOMPARE(panel.table->model()->rowCount(), panel.model->rowCount());
    QVERIFY(selected() != nullptr && *selected() == *play);
    // Nothing is selected once it is not in the list.
    panel.find<QLineEdit>("playFilter")->setText(QStringLiteral("no such word"));
    panel.find<QLineEdit>("playFilter")->clear();
    QVERIFY(panel.table->selectionModel()->selectedRows().isEmpty());
    // Times are found, too, as they are shown.
    const QString time = panel.model->textOf(row, PlaysModel::Time);
    panel.find<QLineEdit>("playFilter")->setText(time);
    QVERIFY(panel.table->model()->rowCount() >= 1);
    QCOMPARE(panel.table->model()->index(0, PlaysModel::Time).data().toString(), time);
  }

  void severalSessionsAreOneList() {
    const QString second = m_folder.filePath(QStringLiteral("second.mcap"));
    const ProgramRun run =
        cli({"record", "--scenario", "match-3v3", "--duration", "40", "--seed", "6", "-o", second});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const auto playsOf = [](const QString& path) {
      const auto session = telemetry::SessionReader::open(path.toStdString()).value();
      return link::statisticsOf(session, *session.range()).plays;
    };
    const auto first = playsOf(m_match), other = playsOf(second);
    QVERIFY(!other.empty() && other != first);
    Panel panel;
    panel.window.openSession(m_match);
    QTRY_COMPARE_WITH_TIMEOUT(panel.model->rowCount(), static_cast<int>(first.size()), patience_ms);
    auto* chosen = panel.dock->findChild<QComboBox*>(QStringLiteral("playSession"));
    QVERIFY(!chosen->isVisible() && panel.table->isColumnHidden(PlaysModel::Session));
    ComparedSessions* compared = panel.window.compared();
    compared->open({second, m_match});
    const std::size_t all = 2 * first.size() + other.size();
    QTRY_COMPARE_WITH_TIMEOUT(panel.model->rowCount(), static_cast<int>(all), patience_ms);
    QVERIFY(panel.model->sessions()[1].plays == other);
    QVERIFY(panel.model->sessions()[2].plays == first);
    QVERIFY(chosen->isVisible() && !panel.table->isColumnHidden(PlaysModel::Session));
    panel.choose("playSession", QStringLiteral("′ second"));
    QCOMPARE(panel.table->model()->rowCount(), static_cast<int>(other.size()));
    // A row leads to the moment as it is aligned; what changes a recording is not for it.
    compared->all()[0]->setOffset(5.0);
    const auto clickFirst = [&panel] {
      const QModelIndex row = panel.table->model()->index(0, PlaysModel::What);
      QTest::mouseClick(panel.table->viewport(), Qt::LeftButton, {},
                        panel.table->visualRect(row).center());
    };
    clickFirst();
    QVERIFY(std::abs(panel.window.shown()->time() - (other[0].time + 5.0)) < 1e-6);
    QVERIFY(!panel.table->findChild<QAction*>(QStringLiteral("bookmarkPlay"))->isEnabled());
    QVERIFY(panel.table->findChild<QAction*>(QStringLiteral("copyPlay"))->isEnabled());
    panel.choose("playSession", QStringLiteral("match"));
    clickFirst();
    QVERIFY(panel.table->findChild<QAction*>(QStringLiteral("bookmarkPlay"))->isEnabled());
    compared->remove(compared->all()[0]);
    QTRY_COMPARE(panel.model->rowCount(), static_cast<int>(2 * first.size()));
    compared->removeAll();
    QTRY_COMPARE(panel.model->rowCount(), static_cast<int>(first.size()));
    QVERIFY(!chosen->isVisible());
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
    model.show({SessionPlays{0, 0, {}, 0.0, plays}}, {});
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
