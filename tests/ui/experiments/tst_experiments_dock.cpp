// SPDX-License-Identifier: GPL-3.0-or-later

// The Experiments dock: a file that is edited and played, its tables, a run that is seen again, an
// error in the file, cancelling.

#include <QAbstractItemModelTester>
#include <QtTest>
#include <QtWidgets>
#include <memory>
#include <vector>

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
  QString message() const { return find<QLabel>("experimentMessage")->text(); }
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
  void errorIsReportedWhereTheFileIs();
  void cancelKeepsWhatIsThere();
  void opensOnAForm();
  void theFormEditsTheFile();
};

// Seed, runs and conditions; everything else stays as it was.
void TestExperimentsDock::theFormEditsTheFile() {
  Dock dock;
  dock.write("2", 7);
  auto* edit = dock.find<QPlainTextEdit>("experimentText");
  const auto file = [edit] {
    return QJsonDocument::fromJson(edit->toPlainText().toUtf8()).object();
  };
  const QJsonObject before = file();
  QCOMPARE(before[QStringLiteral("runs")].toInt(), 7);
  auto* seed = dock.find<QLineEdit>("experimentSeed");
  seed->setFocus();
  seed->selectAll();
  QTest::keyClicks(seed, "4711");
  QTest::keyClick(seed, Qt::Key_Return);
  QCOMPARE(file()[QStringLiteral("seed")].toInt(), 4711);
  auto* conditions = dock.find<QTableWidget>("experimentConditions");
  const auto listed = [&] { return file()[QStringLiteral("conditions")].toArray(); };
  const auto conditionIn = [&](int row) { return listed()[row].toObject(); };
  const auto setOf = [&](int row, const char* key) {
    const QJsonObject set = conditionIn(row)[QStringLiteral("set")].toObject();
    return set[QLatin1String(key)].toString();
  };
  const auto type = [&](int row, int column, const char* words) {
    conditions->setCurrentCell(row, column);
    conditions->editItem(conditions->item(row, column));
    auto* editor = conditions->findChild<QLineEdit*>();
    QVERIFY(editor);
    editor->setText(QString::fromUtf8(words));
    QTest::keyClick(editor, Qt::Key_Return);
    QTRY_VERIFY(!conditions->findChild<QLineEdit*>());
  };
  type(1, 0, "loud");
  QTRY_COMPARE(conditionIn(1)[QStringLiteral("name")].toString(), QStringLiteral("loud"));
  type(1, 1, "noise = none, physics=published");
  QTRY_COMPARE(setOf(1, "physics"), QStringLiteral("published"));
  QTRY_COMPARE(conditions->item(1, 1)->text(), QStringLiteral("noise = none, physics = published"));
  // What cannot be played is said, and neither the form nor the file loses anything.
  type(1, 1, "noise = thunder");
  QTRY_VERIFY2(dock.message().contains(QStringLiteral("thunder")), qPrintable(dock.message()));
  QCOMPARE(conditions->item(1, 1)->text(), QStringLiteral("noise = thunder"));
  QCOMPARE(setOf(1, "noise"), QStringLiteral("none"));
  type(1, 1, "noise");
  QTRY_VERIFY2(dock.message().contains(QStringLiteral("key = value")), qPrintable(dock.message()));
  type(1, 1, "");
  QTRY_VERIFY(!conditionIn(1).contains(QStringLiteral("set")));
  QVERIFY(dock.message().isEmpty());
  QTest::mouseClick(dock.find<QPushButton>("addCondition"), Qt::LeftButton);
  QTRY_COMPARE(listed().size(), 3);
  QCOMPARE(dock.find<QLabel>("experimentAllRuns")->text(),
           QStringLiteral("per condition, 21 in all"));
  conditions->setCurrentCell(2, 0);
  QTest::mouseClick(dock.find<QPushButton>("removeCondition"), Qt::LeftButton);
  QTRY_COMPARE(listed().size(), 2);
  QJsonObject after = file();
  for (const char* key : {"seed", "conditions"})
    after[QLatin1String(key)] = before[QLatin1String(key)];
  QCOMPARE(after, before);
}

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
  using Tester = QAbstractItemModelTester;
  std::vector<std::unique_ptr<Tester>> testers;  // they look at every change of the tables
  for (const char* name :
       {"experimentTable", "experimentMeasured", "experimentDifferences", "experimentAssertions"}) {
    testers.push_back(
        std::make_unique<Tester>(dock.table(name), Tester::FailureReportingMode::QtTest));
  }
  dock.write("2", 3);
  dock.press();
  QCOMPARE(dock.start(), QStringLiteral("Cancel"));
  QVERIFY(noRuns->text().startsWith(QStringLiteral("Playing the runs.")));
  QTRY_COMPARE_WITH_TIMEOUT(dock.start(), QStringLiteral("Start"), 60000);
  QVERIFY(noRuns->isHidden());
  QVERIFY(dock.find<QLabel>("experimentDistributionEmpty")->isHidden());
  QVERIFY2(dock.message().startsWith(QStringLiteral("6 runs; 2 of 4 assertions fail")),
           qPrintable(dock.message()));
  QAbstractItemModel* runs = dock.table("experimentTable");
  QCOMPARE(runs->rowCount(), 6);
  QCOMPARE(runs->index(4, 1).data().toString(), QStringLiteral("noisy"));
  QCOMPARE(runs->index(4, 2).data().toString(), QStringLiteral("2"));
  QCOMPARE(runs->headerData(3, Qt::Horizontal).toString(), QStringLiteral("Score"));
  QCOMPARE(runs->index(4, 3).data().toString(), QStringLiteral("0 : 0"));
  QCOMPARE(runs->index(4, 4).data().toString(), QStringLiteral("yes"));
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
  QTRY_VERIFY_WITH_TIMEOUT(dock.message().contains(QStringLiteral("open in Replay")), 60000);
}

void TestExperimentsDock::errorIsReportedWhereTheFileIs() {
  Dock dock;
  dock.find<QPlainTextEdit>("experimentText")
      ->setPlainText(QStringLiteral("{\n\"version\": 1,\n\"scenari\": 2}"));
  dock.press();
  QCOMPARE(dock.start(), QStringLiteral("Start"));
  QVERIFY2(dock.message().startsWith(QStringLiteral("File:3: scenari")),
           qPrintable(dock.message()));
}

void TestExperimentsDock::cancelKeepsWhatIsThere() {
  Dock dock;
  dock.write("20", 100000);
  dock.press();
  QTRY_VERIFY_WITH_TIMEOUT(dock.message().contains(QStringLiteral("runs/s")), 60000);
  dock.press();
  QTRY_COMPARE_WITH_TIMEOUT(dock.start(), QStringLiteral("Start"), 60000);
  QVERIFY2(dock.message().startsWith(QStringLiteral("Cancelled: ")), qPrintable(dock.message()));
  const int runs = dock.table("experimentTable")->rowCount();
  QVERIFY(runs > 0 && runs < 200000);
  // Conditions take turns.
  if (runs > 20) QVERIFY(!dock.message().contains(QStringLiteral("Not played")));
}

PITCHBOARD_GUI_TEST(TestExperimentsDock)

}  // namespace tst_experiments_dock

#include "tst_experiments_dock.moc"
