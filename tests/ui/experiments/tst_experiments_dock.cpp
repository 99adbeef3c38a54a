// SPDX-License-Identifier: GPL-3.0-or-later

// The Experiments dock: a file that is edited and played, its tables, a run that is seen again, an
// error in the file, cancelling.

#include <QtTest>
#include <QtWidgets>
#include <memory>

#include <ui/experiments/experiments_dock.h>
#include <ui/sources/replay_controller.h>

namespace tst_experiments_dock {

using namespace pitchboard::ui;

namespace {

const char* const text = R"({
  "version": 1, "name": "short",
  "scenario": {"version": 1, "ball": {"x": 0.3},
    "robots": [{"team": "blue", "number": 1, "x": 0, "y": 0, "behaviour": "naive"}],
    "writes": [{"variable": "COM_REFEREE", "value": 2}]},
  "conditions": [{"name": "quiet", "set": {}}, {"name": "noisy", "set": {"noise": "paper"}}],
  "stop": {"duration": SECONDS}, "assertions": ["timeout_rate == 1", "goal_rate == 1"]
})";

class Dock {
 public:
  Dock() : m_dock(makeExperimentsDock({&m_replay}, nullptr)) {
    m_dock->resize(900, 400);
    m_dock->show();
  }
  template <class T>
  T* find(const char* name) const {
    T* found = m_dock->findChild<T*>(QString::fromLatin1(name));
    if (found == nullptr) qFatal("there is no %s", name);
    return found;
  }
  void write(const char* seconds, int runs) const {
    find<QPlainTextEdit>("experimentText")
        ->setPlainText(QString::fromLatin1(text).replace(QStringLiteral("SECONDS"),
                                                         QString::fromLatin1(seconds)));
    // The form takes over what was written.
    auto* tabs = find<QTabWidget>("experimentTabs");
    tabs->setCurrentIndex(tabs->count() - 1);
    find<QPlainTextEdit>("experimentText")->document()->setModified(true);
    tabs->setCurrentIndex(0);
    find<QSpinBox>("experimentRuns")->setValue(runs);
  }
  void press() const { QTest::mouseClick(find<QPushButton>("experimentStart"), Qt::LeftButton); }
  QString start() const { return find<QPushButton>("experimentStart")->text(); }
  QString words() const { return find<QLabel>("experimentWords")->text(); }
  QAbstractItemModel* table(const char* name) const { return find<QTableView>(name)->model(); }
  ReplayController& replay() { return m_replay; }

 private:
  ReplayController m_replay;
  std::unique_ptr<QWidget> m_dock;
};

}  // namespace

class TestExperimentsDock : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { QStandardPaths::setTestModeEnabled(true); }
  void cleanupTestCase() {
    QDir(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation)).removeRecursively();
  }
  void playsAndShowsResults();
  void errorIsSaidWhereTheFileIs();
  void cancelKeepsWhatIsThere();
  void opensOnAForm();
};

void TestExperimentsDock::opensOnAForm() {
  Dock dock;
  auto* tabs = dock.find<QTabWidget>("experimentTabs");
  QCOMPARE(tabs->currentWidget(), dock.find<QScrollArea>("experimentForm"));
  QVERIFY(tabs->tabText(tabs->count() - 1).contains(QStringLiteral("JSON")));
  dock.write("2", 60);
  auto* conditions = dock.find<QTableWidget>("experimentConditions");
  QCOMPARE(conditions->rowCount(), 2);
  QCOMPARE(conditions->item(1, 0)->text(), QStringLiteral("noisy"));
  QVERIFY(conditions->item(1, 1)->text().startsWith(QStringLiteral("noise = ")));
  QCOMPARE(dock.find<QLabel>("experimentAllRuns")->text(),
           QStringLiteral("per condition, 120 in all"));
  // Start and Report stay where they are while it plays.
  auto* start = dock.find<QPushButton>("experimentStart");
  const int x = start->mapTo(tabs->parentWidget(), QPoint()).x();
  dock.press();
  QTRY_COMPARE(dock.start(), QStringLiteral("Cancel"));
  QTest::qWait(50);
  QCOMPARE(start->mapTo(tabs->parentWidget(), QPoint()).x(), x);
  dock.press();
  QTRY_COMPARE_WITH_TIMEOUT(dock.start(), QStringLiteral("Start"), 60000);
}

void TestExperimentsDock::playsAndShowsResults() {
  Dock dock;
  QVERIFY(dock.find<QComboBox>("experimentChoice")->count() >= 7);
  auto* noRuns = dock.find<QLabel>("experimentTableEmpty");
  QCOMPARE(noRuns->text(), QStringLiteral("No results yet. Press Start to play the experiment."));
  dock.write("2", 3);
  dock.press();
  QCOMPARE(dock.start(), QStringLiteral("Cancel"));
  QVERIFY(noRuns->text().startsWith(QStringLiteral("Playing the runs.")));
  QTRY_COMPARE_WITH_TIMEOUT(dock.start(), QStringLiteral("Start"), 60000);
  QVERIFY(noRuns->isHidden());
  QVERIFY(dock.find<QLabel>("experimentDistributionEmpty")->isHidden());
  QVERIFY2(dock.words().startsWith(QStringLiteral("6 runs; 2 of 4 assertions fail")),
           qPrintable(dock.words()));
  QAbstractItemModel* runs = dock.table("experimentTable");
  QCOMPARE(runs->rowCount(), 6);
  QCOMPARE(runs->index(4, 1).data().toString(), QStringLiteral("noisy"));
  QCOMPARE(runs->index(4, 2).data().toString(), QStringLiteral("2"));
  QVERIFY(dock.table("experimentMeasured")->rowCount() >= 4);
  QCOMPARE(dock.table("experimentAssertions")->index(0, 0).data().toString(),
           QStringLiteral("yes"));
  QCOMPARE(dock.table("experimentAssertions")->index(2, 0).data().toString(), QStringLiteral("NO"));

  // A double click plays the run again and opens it in Replay.
  auto* table = dock.find<QTableView>("experimentTable");
  dock.find<QTabWidget>("experimentTabs")->setCurrentWidget(table);
  const QPoint at = table->visualRect(runs->index(4, 0)).center();
  QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, at);
  QTest::mouseDClick(table->viewport(), Qt::LeftButton, {}, at);
  QTRY_VERIFY_WITH_TIMEOUT(dock.replay().isOpen(), 60000);
  QVERIFY(dock.replay().path().endsWith(QStringLiteral("/sessions/run-000005.mcap")));
  QTRY_VERIFY_WITH_TIMEOUT(dock.words().contains(QStringLiteral("open in Replay")), 60000);
}

void TestExperimentsDock::errorIsSaidWhereTheFileIs() {
  Dock dock;
  dock.find<QPlainTextEdit>("experimentText")
      ->setPlainText(QStringLiteral("{\n\"version\": 1,\n\"scenari\": 2}"));
  dock.press();
  QCOMPARE(dock.start(), QStringLiteral("Start"));
  QVERIFY2(dock.words().startsWith(QStringLiteral("File:3: scenari")), qPrintable(dock.words()));
}

void TestExperimentsDock::cancelKeepsWhatIsThere() {
  Dock dock;
  dock.write("20", 100000);
  dock.press();
  QTRY_VERIFY_WITH_TIMEOUT(dock.words().contains(QStringLiteral("runs/s")), 60000);
  dock.press();
  QTRY_COMPARE_WITH_TIMEOUT(dock.start(), QStringLiteral("Start"), 60000);
  QVERIFY2(dock.words().startsWith(QStringLiteral("Cancelled: ")), qPrintable(dock.words()));
  const int runs = dock.table("experimentTable")->rowCount();
  QVERIFY(runs > 0 && runs < 200000);
  // Conditions take turns.
  if (runs > 20) QVERIFY(!dock.words().contains(QStringLiteral("Not played")));
}

PITCHBOARD_GUI_TEST(TestExperimentsDock)

}  // namespace tst_experiments_dock

#include "tst_experiments_dock.moc"
