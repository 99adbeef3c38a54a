// SPDX-License-Identifier: GPL-3.0-or-later
// The list of variables: what it shows, how it is filtered, folded, gone through and remembered.
#include <QAbstractItemModelTester>
#include <QClipboard>
#include <QKeySequence>
#include <QMimeData>
#include <cmath>
#include <limits>
#include <set>

#include <ui/sources/match_memory.h>

#include "../../support/group_facts.h"
#include "../support/robot_keys.h"
#include "variables_bench.h"
#include "variables_delegate.h"
#include "variables_header.h"

namespace tst_variables_dock {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace pitchboard::ui::test;
using Mode = QAbstractItemModelTester::FailureReportingMode;

class TestVariablesDock : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  // Over the curve beside them, though columns that are hidden stand between the two.
  void labelsOfCodesAreReadCompletely() {
    Bench bench;
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    bench.choose(action);
    const QModelIndex curve = bench.at(action, VariablesModel::Spark);
    QTRY_VERIFY(
        !curve.data(VariablesModel::SparkRole).value<QList<telemetry::SeriesBucket>>().isEmpty());
    const auto cell = [&] {
      return bench.view->viewport()->grab(bench.view->visualRect(curve)).toImage();
    };
    const QImage words = cell();
    bench.view->header()->resizeSection(VariablesModel::Unit, 160);
    QVERIFY(cell() != words);  // now they fit, and the curve has its place
  }

  void valuesAreWholeHoweverLong() {
    Bench bench;
    auto store = std::make_shared<telemetry::SeriesStore>();
    const auto b1 = store->addGroup(robotGroup("B1", 1));
    append(*store, b1, 0.0, 0, 0, -1234567.0F, -120000.125);
    append(*store, b1, 1.0, 0, 0, -1234567.0F, -120000.125);
    bench.hand.take(store, SourceKind::Simulate);
    bench.dock->resize(300, 500);
    for (const char* name : {"B1/VISION_BALL_DIST", "B1/TRUE_X"}) {
      bench.choose(QString::fromLatin1(name));
      const QString path = QString::fromLatin1(name);
      QTRY_VERIFY(bench.text(path, VariablesModel::Value).contains(QStringLiteral("12")));
      const QString text = bench.text(path, VariablesModel::Value);
      QTRY_VERIFY2(bench.view->columnWidth(VariablesModel::Value) >
                       bench.view->fontMetrics().horizontalAdvance(text) + 4,
                   qPrintable(text));
    }
  }

  void modelAndFilterKeepTheRulesOfModels() {
    auto store = twoRobots();
    VariablesModel model;
    VariablesFilter filter(&model);
    const QAbstractItemModelTester testModel(&model, Mode::QtTest);
    const QAbstractItemModelTester testFilter(&filter, Mode::QtTest);
    model.setStore(store, SourceKind::Simulate);
    QCOMPARE(model.rowCount(), 2);
    QCOMPARE(model.variableCount(), 8);
    const auto match =
        store->addGroup({"match", {{"SCORE", ColumnType::Float64, "", "", {}, {}}}, {}});
    store->addGroup(robotGroup("B3", 3));
    store->append(match, {1.0, {}, std::vector<double>{2.0}});
    model.updateGroups();
    QCOMPARE(model.rowCount(), 4);
    QCOMPARE(model.index(3, 0).data().toString(), QStringLiteral("match"));
    // The same robot with other variables: its old row goes.
    store->addGroup(robotGroup("B1", 1, 5));
    model.updateGroups();
    QCOMPARE(model.rowCount(), 4);
    QCOMPARE(model.variableCount(), 4 * 3 + 5 + 1);
    filter.setFilterText(QStringLiteral("b2 cm"));
    QCOMPARE(filter.variableCount(), 1);
    filter.sort(VariablesModel::Value, Qt::DescendingOrder);
    filter.setFilterText({});
    filter.update();
    filter.sort(-1);
    model.refreshAll();
    model.setStore(nullptr, SourceKind::Live);
    QCOMPARE(filter.rowCount(), 0);
  }

  void valuesWithLabelsUnitsAndRates() {
    Bench bench;
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    bench.view->openAll();
    QTRY_COMPARE(bench.text(ballDistance, VariablesModel::Value), QStringLiteral("80.0"));
    QCOMPARE(bench.text(ballDistance, VariablesModel::Unit), QStringLiteral("cm"));
    QCOMPARE(bench.text(ballDistance, VariablesModel::Rate), QStringLiteral("−2.0"));
    QCOMPARE(bench.text(action, VariablesModel::Value), QStringLiteral("1"));
    QCOMPARE(bench.text(action, VariablesModel::Unit), QString::fromStdString(actionLabel(1)));
    QCOMPARE(bench.text(action, VariablesModel::Age), QStringLiteral("1.0 s"));
    QTRY_COMPARE(bench.text(QStringLiteral("B2/VISION_LOST"), VariablesModel::Value),
                 QStringLiteral("1"));
    QTRY_COMPARE(bench.text(QStringLiteral("B1"), VariablesModel::Value), QStringLiteral("60"));
    const auto spark = bench.model->find(ballDistance)
                           .siblingAtColumn(VariablesModel::Spark)
                           .data(VariablesModel::SparkRole)
                           .value<QList<telemetry::SeriesBucket>>();
    QVERIFY(spark.size() > 20);
    std::uint32_t samples = 0;
    for (const auto& bucket : spark) samples += bucket.samples;
    QCOMPARE(samples, 601U);
  }

  void whatIsMissingIsADash() {
    Bench bench;
    auto store = std::make_shared<telemetry::SeriesStore>();
    const auto b1 = store->addGroup(robotGroup("B1", 1));
    const float noFloat = std::numeric_limits<float>::quiet_NaN();
    for (const double time : {0.0, 1.0}) append(*store, b1, time, 0, 0, noFloat, std::nan(""));
    bench.hand.take(store, SourceKind::Simulate);
    bench.view->openAll();
    const QString place = QStringLiteral("B1/TRUE_X");
    for (const QString& name : {ballDistance, place}) {
      QTRY_COMPARE(bench.text(name, VariablesModel::Value), QStringLiteral("–"));
      for (int column = 0; column < bench.model->columnCount(); ++column) {
        QVERIFY(!bench.text(name, column).contains(QStringLiteral("nan"), Qt::CaseInsensitive));
      }
      bench.choose(name);
      const QString tip = bench.at(name).data(Qt::ToolTipRole).toString();
      QVERIFY2(!tip.contains(QStringLiteral("nan"), Qt::CaseInsensitive), qPrintable(tip));
      QTest::keySequence(bench.view, QKeySequence::Copy);
      QVERIFY(
          !QApplication::clipboard()->text().contains(QStringLiteral("nan"), Qt::CaseInsensitive));
    }
  }

  // In a narrow panel the curve leaves first, then the heading that the name repeats.
  void namesAreWholeInANarrowPanel() {
    Bench bench;
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    bench.view->openAll();
    const QHeaderView* header = bench.view->header();
    bench.view->resize(scaled(bench.view, 400), 400);
    QTRY_VERIFY(!header->isSectionHidden(VariablesModel::Spark));
    bench.view->resize(scaled(bench.view, 264), 400);
    QTRY_VERIFY(header->isSectionHidden(VariablesModel::Spark));
    const QModelIndex row = bench.model->find(ballDistance);
    const QFont font = bench.view->font();
    QCOMPARE(VariablesDelegate::nameFor(row, font, 1000), QStringLiteral("VISION_BALL_DIST"));
    QCOMPARE(VariablesDelegate::nameFor(row, font, 90), QStringLiteral("BALL_DIST"));
    QVERIFY(bench.view->columnWidth(VariablesModel::Name) >
            QFontMetrics(font).horizontalAdvance(QStringLiteral("BALL_DIST")) + 40);
    // Kept as it was wanted, not as it had to be.
    auto* kept = static_cast<VariablesHeader*>(bench.view->header());
    QHeaderView wide(Qt::Horizontal);
    wide.setModel(bench.model);
    QVERIFY(wide.restoreState(kept->stateToKeep()));
    QVERIFY(!wide.isSectionHidden(VariablesModel::Spark));
  }

  void columnsStayWhenTheSourceChanges() {
    Bench bench;
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    QHeaderView* header = bench.view->header();
    header->setSectionHidden(VariablesModel::Rate, false);
    header->resizeSection(VariablesModel::Value, 123);
    header->setSortIndicator(VariablesModel::Value, Qt::DescendingOrder);
    bench.hand.take(twoRobots(), SourceKind::Replay);
    QVERIFY(!header->isSectionHidden(VariablesModel::Rate));
    QCOMPARE(header->sectionSize(VariablesModel::Value), 123);
    QCOMPARE(header->sortIndicatorSection(), int(VariablesModel::Value));
  }

  void aPastMomentShowsItsOwnValues() {
    VariablesModel model;
    model.setStore(twoRobots(), SourceKind::Replay);
    const auto shown = [&model](const QString& name, int column) {
      return model.find(name).siblingAtColumn(column).data().toString();
    };
    model.setMoment(5.0);
    model.refreshAll();
    QCOMPARE(shown(ballDistance, VariablesModel::Value), QStringLiteral("90.0"));
    QCOMPARE(shown(action, VariablesModel::Value), QStringLiteral("0"));
    QCOMPARE(shown(action, VariablesModel::Age), QString());
    model.setMoment(9.5);
    model.refreshAll();
    QCOMPARE(shown(action, VariablesModel::Value), QStringLiteral("1"));
    QCOMPARE(shown(action, VariablesModel::Age), QStringLiteral("500 ms"));
    model.setMoment({});
    model.refreshAll();
    QCOMPARE(shown(ballDistance, VariablesModel::Value), QStringLiteral("80.0"));
  }

  void onlyRowsInSightAreRead() {
    auto store = std::make_shared<telemetry::SeriesStore>();
    constexpr int extra = 500;
    const auto id = store->addGroup(robotGroup("B1", 1, extra));
    append(*store, id, 0.0, 0, 0, 1.0F, 0.0, extra);
    Bench bench;
    bench.hand.take(store, SourceKind::Simulate);
    bench.view->openAll();
    bench.view->scrollToTop();
    QTRY_COMPARE(bench.text(ballDistance, VariablesModel::Value), QStringLiteral("1.0"));
    QVERIFY(bench.view->rowsInSight().size() < 60);
    QCOMPARE(bench.text(QStringLiteral("B1/EXTRA_499"), VariablesModel::Value), QString());
    QSignalSpy changed(bench.model, &QAbstractItemModel::dataChanged);
    append(*store, id, 1.0, 0, 0, 2.0F, 0.0, extra);
    QTRY_COMPARE(bench.text(ballDistance, VariablesModel::Value), QStringLiteral("2.0"));
    for (const QList<QVariant>& arguments : changed) {
      const auto first = arguments[0].toModelIndex(), last = arguments[1].toModelIndex();
      QVERIFY(last.row() - first.row() < 60);
    }
  }

  void wordsFilterRobotsCategoriesNamesAndUnits_data() {
    QTest::addColumn<QString>("words");
    QTest::addColumn<int>("expected");
    QTest::newRow("robot") << "b2" << 4;
    QTest::newRow("category") << "decision" << 2;
    QTest::newRow("name and robot") << "DIST b1" << 1;
    QTest::newRow("unit") << "cm" << 2;
    QTest::newRow("path") << "b1/decision" << 1;
    QTest::newRow("nothing") << "b1 nonsense" << 0;
  }
  void wordsFilterRobotsCategoriesNamesAndUnits() {
    QFETCH(const QString, words);
    QFETCH(const int, expected);
    Bench bench;
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    auto* box = bench.dock->findChild<QLineEdit*>(QStringLiteral("variablesFilter"));
    box->setFocus();
    QTest::keyClicks(box, words);
    auto* filter = qobject_cast<VariablesFilter*>(bench.view->model());
    QCOMPARE(filter->variableCount(), expected);
    auto* empty = bench.dock->findChild<QLabel*>(QStringLiteral("emptyVariables"));
    QCOMPARE(empty->isVisible(), expected == 0);
    if (expected == 0)
      QVERIFY(empty->text().contains(QStringLiteral("No matching")));
    else
      QVERIFY(bench.view->isExpanded(filter->index(0, 0)));
    box->clear();
    QCOMPARE(filter->variableCount(), 8);
  }

  void enterInTheFilterLeadsToWhatWasFound() {
    Bench bench;
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    auto* box = bench.dock->findChild<QLineEdit*>(QStringLiteral("variablesFilter"));
    const QSignalSpy plotted(bench.view, &VariablesView::plotRequested);
    box->setFocus();
    QTest::keyClicks(box, QStringLiteral("DIST b1"));
    QTest::keyClick(box, Qt::Key_Return);
    QTRY_COMPARE(QApplication::focusWidget(), static_cast<QWidget*>(bench.view));
    QCOMPARE(bench.view->selectedVariables(), QStringList{QStringLiteral("B1/VISION_BALL_DIST")});
    QCOMPARE(plotted.size(), 0);
    QTest::keyClick(bench.view, Qt::Key_Return);
    QCOMPARE(plotted.size(), 1);
    box->setFocus();
    QTest::keyClicks(box, QStringLiteral(" nonsense"));
    QTest::keyClick(box, Qt::Key_Return);
    QCOMPARE(QApplication::focusWidget(), static_cast<QWidget*>(box));
  }

  void anAttachedBlackboardIsFoundByItsKey() {
    Bench bench;
    auto store = twoRobots();
    telemetry::GroupInfo attached = robotGroup("B7", 7);
    attached.robot = telemetry::facts({{"key", "700"}, {"attached", "1"}, {"number", "7"}});
    append(*store, store->addGroup(attached), 1.0, 0, 0, 50.0F, 0.0);
    bench.hand.take(store, SourceKind::Simulate);
    auto* box = bench.dock->findChild<QLineEdit*>(QStringLiteral("variablesFilter"));
    box->setFocus();
    QTest::keyClicks(box, QStringLiteral("700"));
    auto* filter = qobject_cast<VariablesFilter*>(bench.view->model());
    QCOMPARE(filter->variableCount(), 4);
    QCOMPARE(filter->index(0, 0).data().toString(), QStringLiteral("B7 (key 700)"));
  }

  void favouritesByKeyAreKept() {
    QTemporaryDir folder;
    const QString file = folder.filePath(QStringLiteral("settings.ini"));
    {
      Bench bench(file);
      bench.hand.take(twoRobots(), SourceKind::Simulate);
      bench.choose(ballDistance);
      QTest::keyClick(bench.view, Qt::Key_Asterisk);
      QCOMPARE(bench.model->favourites(), QStringList{ballDistance});
      bench.press("favouritesOnly");
      QCOMPARE(qobject_cast<VariablesFilter*>(bench.view->model())->variableCount(), 1);
      bench.hand.take(nullptr, SourceKind::Simulate);
      bench.hand.take(twoRobots(), SourceKind::Simulate);
      QVERIFY(bench.at(ballDistance).isValid());
    }
    Bench bench(file);
    QCOMPARE(bench.model->favourites(), QStringList{ballDistance});
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    bench.choose(ballDistance);
    QTest::keyClick(bench.view, Qt::Key_Asterisk);
    QVERIFY(bench.model->favourites().isEmpty());
  }

  void changedOnly() {
    Bench bench;
    auto store = twoRobots();
    bench.hand.take(store, SourceKind::Simulate);
    bench.press("changedOnly");
    auto* filter = qobject_cast<VariablesFilter*>(bench.view->model());
    // Within 5 s: B1's distance and, a second ago, its action.
    QCOMPARE(filter->variableCount(), 2);
    QVERIFY(bench.at(action).isValid());
    // The same values for six seconds more: nothing is new any more but B2's flag.
    for (int i = 1; i <= 360; ++i) {
      append(*store, *store->findGroup("B1"), 10 + i / 60.0, 1, 0, 80.0F, 0.5);
      append(*store, *store->findGroup("B2"), 10 + i / 60.0, 0, i < 300 ? 1 : 0, 250.0F, -0.5);
    }
    QTRY_COMPARE(filter->variableCount(), 1);
    QVERIFY(bench.at(QStringLiteral("B2/VISION_LOST")).isValid());
  }

  void keyboardPlotsAndCopies() {
    Bench bench;
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    bench.choose(ballDistance);
    QTRY_COMPARE(bench.text(ballDistance, VariablesModel::Value), QStringLiteral("80.0"));
    QTest::keyClick(bench.view, Qt::Key_Return);
    QCOMPARE(bench.plots.plotted, QStringList{ballDistance});
    QTest::keySequence(bench.view, QKeySequence::Copy);
    QCOMPARE(QGuiApplication::clipboard()->text(), ballDistance + QStringLiteral(" 80"));
    QTest::keyClick(bench.view, Qt::Key_Up);
    QCOMPARE(bench.view->selectedVariables(), QStringList{QStringLiteral("B1/VISION_LOST")});
  }

  void dragCarriesNames() {
    Bench bench;
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    const QModelIndexList rows{bench.model->find(ballDistance), bench.model->find(action),
                               bench.model->find(QStringLiteral("B1"))};
    const std::unique_ptr<QMimeData> data(bench.model->mimeData(rows));
    QCOMPARE(data->data(variablesMimeType), (ballDistance + QLatin1Char('\n') + action).toUtf8());
    QVERIFY(bench.model->flags(rows[0]).testFlag(Qt::ItemIsDragEnabled));
    QVERIFY(!bench.model->flags(rows[2]).testFlag(Qt::ItemIsDragEnabled));
  }

  void whatWasNeverSetIsOneRow() {
    auto store = std::make_shared<telemetry::SeriesStore>();
    const auto b1 = store->addGroup(robotGroup("B1", 1, 3));
    for (int i = 0; i < 60; ++i) {
      const std::vector<std::uint32_t> words{0, 0, std::bit_cast<std::uint32_t>(80.0F), 0, 0, 0};
      store->append(b1, {i / 60.0, words, std::vector<double>{0.5}});
    }
    Bench bench;
    bench.hand.take(store, SourceKind::Simulate);
    auto* filter = qobject_cast<VariablesFilter*>(bench.view->model());
    const QAbstractItemModelTester tester(filter, Mode::QtTest);
    const QString extra = QStringLiteral("B1\nExtra"), rest = extra + QStringLiteral("\nnever set");
    const QString lost = QStringLiteral("B1/VISION_LOST");
    QTRY_COMPARE(filter->variableCount(), 2);  // the distance and the truth
    bench.view->expand(bench.at(extra));
    QCOMPARE(bench.text(rest, VariablesModel::Name), QStringLiteral("3 variables never set"));
    QCOMPARE(bench.text(QStringLiteral("B1\nVision\nnever set"), VariablesModel::Name),
             QStringLiteral("1 variable never set"));
    const auto click = [&bench](const QString& path) {
      bench.view->scrollTo(bench.at(path));
      QTest::mouseClick(bench.view->viewport(), Qt::LeftButton, {},
                        bench.view->visualRect(bench.at(path)).center());
    };
    click(rest);
    QCOMPARE(filter->variableCount(), 5);
    QVERIFY(bench.at(QStringLiteral("B1/EXTRA_2")).isValid());
    QVERIFY(bench.text(rest, VariablesModel::Name).startsWith(QStringLiteral("Fold")));
    // By keys as by the mouse.
    bench.view->setCurrentIndex(bench.at(rest));
    QTest::keyClick(bench.view, Qt::Key_Return);
    QCOMPARE(filter->variableCount(), 2);
    QVERIFY(bench.plots.plotted.isEmpty());
    // The filter finds a name; the name of a robot alone finds no variable.
    auto* box = bench.dock->findChild<QLineEdit*>(QStringLiteral("variablesFilter"));
    box->setText(QStringLiteral("lost"));
    QVERIFY(bench.at(lost).isValid());
    box->setText(QStringLiteral("B1/"));
    QVERIFY(!bench.at(lost).isValid());
    QCOMPARE(filter->variableCount(), 2);
    box->clear();
    // A value that came and went again was set.
    for (const std::uint32_t value : {1U, 0U}) {
      const std::vector<std::uint32_t> words{0, value, std::bit_cast<std::uint32_t>(80.0F),
                                             0, 0,     0};
      store->append(b1, {1.0 + (value == 0), words, std::vector<double>{0.5}});
    }
    QTRY_VERIFY(bench.at(lost).isValid());
    QVERIFY(!bench.at(QStringLiteral("B1\nVision\nnever set")).isValid());
    filter->sort(VariablesModel::Name, Qt::DescendingOrder);
    bench.view->openAll();
    QCOMPARE(bench.at(rest).row(), 3);
    filter->setFolding(false);
    QVERIFY(!bench.at(rest).isValid());
    QCOMPARE(filter->variableCount(), 7);
  }

  void aBlackboardIsShownByItsRobot() {
    Bench bench;
    bench.source.choose(&bench.controller);
    link::Scenario scenario = link::loadScenario("match-3v3").value();
    scenario.robots[1].identity.number = 11;
    bench.controller.open(scenario, true);
    bench.controller.runTo(10);
    QTRY_VERIFY(bench.model->find(QStringLiteral("B11/TRUE_X")).isValid());
    QTRY_VERIFY(bench.controller.frame());  // rows may be there before it
    bench.press("changedOnly");
    emit bench.selection.blackboardRequested(inSlot(1));
    QCOMPARE(bench.dock->findChild<QLineEdit*>(QStringLiteral("variablesFilter"))->text(),
             QStringLiteral("B1/"));
    QVERIFY(bench.at(QStringLiteral("B1")).isValid());
    QVERIFY(!bench.at(QStringLiteral("B11")).isValid());
    QVERIFY2(bench.message().contains(QStringLiteral("own memory")), qPrintable(bench.message()));
  }

  void openRowsAndSelectionOutlastTheSource() {
    Bench bench;
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    QTRY_VERIFY(bench.view->isExpanded(bench.at(QStringLiteral("B1\nVision"))));
    bench.view->collapse(bench.at(QStringLiteral("B1\nVision")));
    bench.view->expand(bench.at(QStringLiteral("B2")));
    bench.view->expand(bench.at(QStringLiteral("B2\nDecision")));
    const QString chosen = QStringLiteral("B2/DECISION_ACTION_A");
    bench.view->setCurrentIndex(bench.at(chosen));
    bench.hand.take(nullptr, SourceKind::Simulate);
    QCOMPARE(bench.view->selectedVariables(), QStringList());
    bench.hand.take(twoRobots(), SourceKind::Replay);
    QTRY_COMPARE(bench.view->selectedVariables(), QStringList{chosen});
    QVERIFY(!bench.view->isExpanded(bench.at(QStringLiteral("B1\nVision"))));
    QVERIFY(bench.view->isExpanded(bench.at(QStringLiteral("B2\nDecision"))));
  }

  void emptyStatesAreTexts() {
    Bench bench;
    auto* empty = bench.dock->findChild<QLabel*>(QStringLiteral("emptyVariables"));
    QTRY_VERIFY(empty->isVisible());
    QCOMPARE(empty->text(), QStringLiteral("Nobody is here."));
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    QTRY_VERIFY(!empty->isVisible());
    bench.press("favouritesOnly");
    QTRY_VERIFY(empty->isVisible());
    QVERIFY(empty->text().contains(QLatin1Char('*')));
  }

  void everyNthTick() {
    Bench bench;
    bench.controller.memory()->setSampling(10);
    bench.controller.open(link::loadScenario("match-3v3").value(), true);
    QTRY_VERIFY(bench.controller.frame());
    bench.controller.runTo(60);
    QTRY_COMPARE(bench.controller.frame()->snapshot.tick, std::uint64_t(60));
    const auto ticksSeen = [&bench](double begin, double end) {
      const auto store = bench.controller.series();
      const auto id = store->find("match", "TICK");
      std::vector<telemetry::Sample> samples;
      store->view(id->group)->samples(id->column, {begin, end}, samples);
      std::set<double> ticks;
      for (const telemetry::Sample& sample : samples) ticks.insert(sample.value);
      return ticks.size();
    };
    QTRY_COMPARE(ticksSeen(0.001, 1.0), std::size_t(6));
    bench.controller.memory()->setSampling(1);
    bench.controller.runTo(120);
    QTRY_COMPARE(bench.controller.frame()->snapshot.tick, std::uint64_t(120));
    QTRY_COMPARE(ticksSeen(1.001, 2.0), std::size_t(60));
  }

  void refreshOfThousandsOfRows() {
    auto store = std::make_shared<telemetry::SeriesStore>();
    constexpr int robots = 22, extra = 230;
    std::vector<telemetry::GroupId> ids;
    for (int r = 1; r <= robots; ++r) {
      ids.push_back(store->addGroup(robotGroup("B" + std::to_string(r), r, extra)));
    }
    for (int i = 0; i < 900; ++i) {
      for (const auto id : ids) append(*store, id, i / 60.0, i / 60, 0, float(i), i, extra);
    }
    Bench bench;
    bench.dock->resize(600, 1000);
    bench.hand.take(store, SourceKind::Simulate);
    bench.view->openAll();
    QCOMPARE(bench.model->variableCount(), robots * (extra + 4));
    double time = 15.0;
    QBENCHMARK {
      time += 0.1;
      for (const auto id : ids) append(*store, id, time, 0, 0, float(time), time, extra);
      bench.model->refresh(bench.view->rowsInSight(), bench.view->sparkPixels());
      bench.view->viewport()->repaint();
    }
    qInfo("%lld rows in sight of %d", static_cast<long long>(bench.view->rowsInSight().size()),
          bench.model->variableCount());
    QElapsedTimer clock;
    clock.start();
    bench.dock->findChild<QLineEdit*>(QStringLiteral("variablesFilter"))
        ->setText(QStringLiteral("extra b1"));
    qInfo("filter by two words: %.1f ms", double(clock.nsecsElapsed()) / 1e6);
    clock.restart();
    bench.model->refreshChanges();
    qInfo("all times of change: %.1f ms", double(clock.nsecsElapsed()) / 1e6);
    clock.restart();
    bench.model->refreshAll();
    qInfo("all values: %.1f ms", double(clock.nsecsElapsed()) / 1e6);
  }
};

PITCHBOARD_GUI_TEST(TestVariablesDock)

}  // namespace tst_variables_dock

#include "tst_variables_dock.moc"
