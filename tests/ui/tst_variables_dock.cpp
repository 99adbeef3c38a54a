// SPDX-License-Identifier: GPL-3.0-or-later
#include <QAbstractItemModelTester>
#include <QClipboard>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QToolButton>
#include <QtTest>
#include <bit>
#include <set>

#include <base/actions.h>
#include <robotlink/blackboard/system_v.h>
#include <telemetry/series/series_store.h>
#include <ui/base/in_place_message.h>
#include <ui/base/plot_target.h>
#include <ui/base/theme.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/source_switch.h>
#include <ui/variables/variables_dock.h>

#include "../support/segment_keys.h"
#include "catalog_choice.h"
#include "variables_filter.h"
#include "variables_model.h"
#include "variables_view.h"

using namespace pitchboard;
using namespace pitchboard::ui;
using telemetry::ColumnInfo;
using telemetry::ColumnKind;
using telemetry::ColumnType;
using Mode = QAbstractItemModelTester::FailureReportingMode;

namespace {

// A robot with a few variables of every kind, by hand.
telemetry::GroupInfo robotGroup(const std::string& name, int robot, int extra = 0) {
  telemetry::GroupInfo info;
  info.name = name;
  info.attributes = {{"robot", std::to_string(robot)}, {"team", "blue"}, {"number", "1"}};
  ColumnInfo action{"DECISION_ACTION_A", ColumnType::Int32,       "",
                    "Decision",          ColumnKind::Enumeration, actionLabels()};
  info.columns = {
      action,
      {"VISION_LOST", ColumnType::Int32, "", "Vision", ColumnKind::Flag, {}},
      {"VISION_BALL_DIST", ColumnType::Float32, "cm", "Vision", ColumnKind::Number, {}}};
  for (int i = 0; i < extra; ++i) {
    info.columns.push_back(
        {"EXTRA_" + std::to_string(i), ColumnType::Float32, "", "Extra", ColumnKind::Number, {}});
  }
  info.columns.push_back({"TRUE_X", ColumnType::Float64, "m", "Truth", ColumnKind::Number, {}});
  return info;
}

void append(telemetry::SeriesStore& store, telemetry::GroupId group, double time, int action,
            int lost, float distance, double x, int extra = 0) {
  std::vector<std::uint32_t> words{static_cast<std::uint32_t>(action),
                                   static_cast<std::uint32_t>(lost),
                                   std::bit_cast<std::uint32_t>(distance)};
  for (int i = 0; i < extra; ++i) {
    words.push_back(std::bit_cast<std::uint32_t>(float(i) + float(std::sin(time))));
  }
  const double values[] = {x};
  store.append(group, {time, words, values});
}

// Rows made by hand in place of a match.
class HandSource : public FrameSource {
  Q_OBJECT
 public:
  SourceKind kind() const override { return m_kind; }
  FramePtr frame() const override { return {}; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override { return m_store; }
  QString emptyText() const override { return QStringLiteral("Nobody is here."); }
  void take(std::shared_ptr<telemetry::SeriesStore> store, SourceKind kind) {
    m_store = std::move(store);
    m_kind = kind;
    emit restarted();
  }

 private:
  std::shared_ptr<telemetry::SeriesStore> m_store;
  SourceKind m_kind = SourceKind::Simulate;
};

class HandPlots : public PlotTarget {
 public:
  using PlotTarget::PlotTarget;
  void plotVariables(const QStringList& names) override { plotted += names; }
  QStringList plotted;
};

std::shared_ptr<telemetry::SeriesStore> twoRobots() {
  auto store = std::make_shared<telemetry::SeriesStore>();
  const auto b1 = store->addGroup(robotGroup("B1", 1));
  const auto b2 = store->addGroup(robotGroup("B2", 2));
  for (int i = 0; i <= 600; ++i) {
    const double time = i / 60.0;
    // B1 turns to walking at 9 s; its distance changes all the time. B2 stands.
    append(*store, b1, time, time >= 9.0 ? 1 : 0, 0, float(100 - 2 * time), 0.5);
    append(*store, b2, time, 0, 1, 250.0F, -0.5);
  }
  return store;
}

// The dock with everything around it that it needs.
struct Bench {
  explicit Bench(const QString& settingsFile = {})
      : controller(inlineOptions()),
        source(&hand),
        plots(nullptr),
        settings(settingsFile.isEmpty() ? folder.filePath(QStringLiteral("s.ini")) : settingsFile,
                 QSettings::IniFormat) {
    VariablesContext context;
    context.controller = &controller;
    context.source = &source;
    context.plots = &plots;
    context.settings = &settings;
    dock.reset(makeVariablesDock(context, nullptr));
    dock->resize(460, 700);
    dock->show();
    view = dock->findChild<VariablesView*>();
    model = dock->findChild<VariablesModel*>();
  }
  static link::MatchOptions inlineOptions() {
    link::MatchOptions options;
    options.cognition = link::Cognition::Inline;
    return options;
  }
  QModelIndex at(const QString& path, int column = 0) const {
    auto* filter = qobject_cast<VariablesFilter*>(view->model());
    return filter->mapFromSource(model->find(path)).siblingAtColumn(column);
  }
  QString text(const QString& path, int column) const {
    return model->find(path).siblingAtColumn(column).data().toString();
  }
  QString message() const { return dock->findChild<InPlaceMessage*>()->text(); }
  void press(const char* button) const {
    QTest::mouseClick(dock->findChild<QToolButton*>(QLatin1String(button)), Qt::LeftButton);
  }
  void choose(const QString& path) const {
    view->openAll();
    view->setCurrentIndex(at(path));
    view->setFocus();
  }
  /// Opens the editor of a value of twoRobots(), as F2 does; null when there is none.
  QLineEdit* edit(const QString& path) {
    hand.take(twoRobots(), SourceKind::Simulate);
    press("editValues");
    choose(path);
    QTest::keyClick(view, Qt::Key_F2);
    return dock->findChild<QLineEdit*>(QStringLiteral("valueEdit"));
  }

  QTemporaryDir folder;
  HandSource hand;
  MatchController controller;
  SourceSwitch source;
  HandPlots plots;
  QSettings settings;
  std::unique_ptr<QWidget> dock;
  VariablesView* view = nullptr;
  VariablesModel* model = nullptr;
};

const QString ballDistance = QStringLiteral("B1/VISION_BALL_DIST");
const QString action = QStringLiteral("B1/DECISION_ACTION_A");

}  // namespace

class TestVariablesDock : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

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
    filter.setWords(QStringLiteral("b2 cm"));
    QCOMPARE(filter.variableCount(), 1);
    filter.sort(VariablesModel::Value, Qt::DescendingOrder);
    filter.setWords({});
    filter.update();
    filter.sort(-1);
    model.refreshAll();
    model.setStore(nullptr, SourceKind::Live);
    QCOMPARE(filter.rowCount(), 0);
  }

  void valuesWithWordsUnitsAndRates() {
    Bench bench;
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    bench.view->openAll();
    QTRY_COMPARE(bench.text(ballDistance, VariablesModel::Value), QStringLiteral("80.0"));
    QCOMPARE(bench.text(ballDistance, VariablesModel::Unit), QStringLiteral("cm"));
    QCOMPARE(bench.text(ballDistance, VariablesModel::Rate), QStringLiteral("−2.0"));
    QCOMPARE(bench.text(action, VariablesModel::Value), QStringLiteral("1"));
    QCOMPARE(bench.text(action, VariablesModel::Unit), QString::fromStdString(actionWords(1)));
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
      QVERIFY(empty->text().contains(QStringLiteral("words")));
    else
      QVERIFY(bench.view->isExpanded(filter->index(0, 0)));
    box->clear();
    QCOMPARE(filter->variableCount(), 8);
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

  void emptyStatesAreWords() {
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

  void valuesAreLockedAtFirst() {
    Bench bench;
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    bench.choose(ballDistance);
    QTest::keyClick(bench.view, Qt::Key_F2);
    QVERIFY(!bench.view->isEditing());
    QVERIFY(bench.message().contains(QStringLiteral("locked")));
    bench.press("editValues");
    QTest::keyClick(bench.view, Qt::Key_F2);
    QVERIFY(bench.view->isEditing());
  }

  void whatCannotBeEditedSaysWhy_data() {
    QTest::addColumn<SourceKind>("kind");
    QTest::addColumn<QString>("path");
    QTest::addColumn<QString>("reason");
    QTest::newRow("truth") << SourceKind::Simulate << "B1/TRUE_X"
                           << "truth";
    QTest::newRow("live") << SourceKind::Live << ballDistance << "live";
    QTest::newRow("replay") << SourceKind::Replay << ballDistance << "recording";
    QTest::newRow("attached") << SourceKind::Simulate << "key 900/VISION_LOST"
                              << "only read";
  }
  void whatCannotBeEditedSaysWhy() {
    QFETCH(const SourceKind, kind);
    QFETCH(const QString, path);
    QFETCH(const QString, reason);
    auto store = twoRobots();
    telemetry::GroupInfo attached = robotGroup("key 900", 9);
    attached.attributes = {{"key", "900"}};
    append(*store, store->addGroup(attached), 1.0, 0, 0, 0.0F, 0.0);
    Bench bench;
    bench.hand.take(store, kind);
    bench.model->setEditingAllowed(true);
    bench.choose(path);
    bench.view->scrollTo(bench.at(path));
    const QRect cell = bench.view->visualRect(bench.at(path, VariablesModel::Value));
    QTest::mouseDClick(bench.view->viewport(), Qt::LeftButton, {}, cell.center());
    QVERIFY(!bench.view->isEditing());
    QVERIFY2(bench.message().contains(reason), qPrintable(bench.message()));
    QVERIFY(
        bench.at(path, VariablesModel::Value).data(Qt::ToolTipRole).toString().contains(reason));
  }

  void badValuesAreRefusedBesideTheEditor_data() {
    QTest::addColumn<QString>("path");
    QTest::addColumn<QString>("typed");
    QTest::addColumn<QString>("problem");
    QTest::newRow("not whole") << action << "1.5"
                               << "whole";
    QTest::newRow("too large") << action << "3000000000"
                               << "32 bits";
    QTest::newRow("no number") << ballDistance << "far"
                               << "not a number";
    QTest::newRow("nan") << ballDistance << "nan"
                         << "not a number";
    QTest::newRow("no float") << ballDistance << "1e39"
                              << "32-bit";
    QTest::newRow("flag") << "B1/VISION_LOST"
                          << "2"
                          << "0 or 1";
    QTest::newRow("words") << action << "dance"
                           << "words of a code";
    QTest::newRow("two commas") << ballDistance << "1,234,5"
                                << "not a number";
  }
  void badValuesAreRefusedBesideTheEditor() {
    QFETCH(const QString, path);
    QFETCH(const QString, typed);
    QFETCH(const QString, problem);
    Bench bench;
    QSignalSpy edited(bench.model, &VariablesModel::valueEdited);
    auto* editor = bench.edit(path);
    QVERIFY(editor);
    editor->selectAll();
    QTest::keyClicks(editor, typed);
    QTest::keyClick(editor, Qt::Key_Return);
    auto* said = bench.dock->findChild<QLabel*>(QStringLiteral("valueProblem"));
    QVERIFY(said->isVisible());
    QVERIFY2(said->text().contains(problem), qPrintable(said->text()));
    QVERIFY(bench.view->isEditing());
    QTest::keyClick(editor, Qt::Key_Escape);
    QTRY_VERIFY(!bench.view->isEditing());
    QCOMPARE(edited.count(), 0);
  }

  void goodValuesAreHandedOn_data() {
    QTest::addColumn<QString>("path");
    QTest::addColumn<QString>("typed");
    QTest::addColumn<double>("value");
    QTest::newRow("int") << action << "-7" << -7.0;
    QTest::newRow("words") << action << "Walk forward, fast" << 1.0;
    QTest::newRow("float") << ballDistance << "1.5e2" << 150.0;
    QTest::newRow("minus sign") << ballDistance << QStringLiteral("−2.5") << -2.5;
    QTest::newRow("decimal comma") << ballDistance << "-1,25" << -1.25;
    QTest::newRow("flag") << "B1/VISION_LOST"
                          << "1" << 1.0;
  }
  void goodValuesAreHandedOn() {
    QFETCH(const QString, path);
    QFETCH(const QString, typed);
    QFETCH(const double, value);
    Bench bench;
    QSignalSpy edited(bench.model, &VariablesModel::valueEdited);
    auto* editor = bench.edit(path);
    QVERIFY(editor);
    editor->setText(typed);
    QTest::keyClick(editor, Qt::Key_Return);
    QTRY_COMPARE(edited.count(), 1);
    QCOMPARE(edited[0][1].toDouble(), value);
  }

  void aMatchIsSampledAndEdited() {
    Bench bench;
    bench.source.choose(&bench.controller);
    link::Scenario scenario = link::loadScenario("match-3v3").value();
    scenario.robots.resize(2);
    scenario.robots[0].behaviour = "none";
    bench.controller.open(scenario, false);
    const QString team = QStringLiteral("B1/");
    QTRY_VERIFY(bench.model->find(team + QStringLiteral("TRUE_X")).isValid());
    QVERIFY(bench.model->find(QStringLiteral("match/BALL_X")).isValid());
    bench.press("editValues");
    const auto edit = [&bench](const QString& path, const QString& value) {
      bench.choose(path);
      bench.view->scrollTo(bench.at(path));
      QTest::keyClick(bench.view, Qt::Key_F2);
      auto* editor = bench.dock->findChild<QLineEdit*>(QStringLiteral("valueEdit"));
      QVERIFY(editor);
      editor->setText(value);
      QTest::keyClick(editor, Qt::Key_Return);
      QTRY_VERIFY(!bench.view->isEditing());
    };
    // Nobody decides for B1: the value stays. Somebody does for the other robot.
    edit(team + QStringLiteral("DECISION_STATE"), QStringLiteral("77"));
    QTRY_COMPARE(bench.text(team + QStringLiteral("DECISION_STATE"), VariablesModel::Value),
                 QStringLiteral("77"));
    // Vision writes the head's angle again on the next tick.
    edit(team + QStringLiteral("VISION_PAN_DEG"), QStringLiteral("1234.5"));
    QTRY_VERIFY2(bench.message().contains(QStringLiteral("after you wrote 1234.5")),
                 qPrintable(bench.message()));
    QCOMPARE(bench.text(team + QStringLiteral("DECISION_STATE"), VariablesModel::Value),
             QStringLiteral("77"));
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

  void importedCatalogNamesTheNextMatch() {
    QTemporaryDir folder;
    const QString file = folder.filePath(QStringLiteral("blackboard.json"));
    const auto save = [&file](const QByteArray& text) {
      QFile out(file);
      QVERIFY(out.open(QIODevice::WriteOnly));
      out.write(text);
    };
    save("#define BROKEN");
    Bench bench;
    bench.source.choose(&bench.controller);
    bench.controller.open(link::loadScenario("match-3v3").value(), true);
    QTRY_VERIFY(bench.controller.frame());
    QSignalSpy errors(&bench.controller, &MatchController::errorOccurred);
    auto* catalog = bench.dock->findChild<CatalogChoice*>();
    catalog->importFile(file);
    QVERIFY2(bench.message().contains(QStringLiteral("blackboard.json")),
             qPrintable(bench.message()));
    QVERIFY(catalog->isPublished());
    link::VariableCatalog own =
        link::VariableCatalog::fromJson(
            QByteArray(
                R"({"int": {"OUR_STATE": 19, "COM_REFEREE": 51}, "float": {"OUR_SPEED": 3}})")
                .toStdString(),
            "own")
            .value();
    save(QByteArray::fromStdString(own.toJson()));
    catalog->importFile(file);
    QVERIFY(bench.message().contains(QStringLiteral("3 variables")));
    QVERIFY(!bench.model->find(QStringLiteral("B1/OUR_STATE")).isValid());
    auto* restart = bench.dock->findChild<QPushButton*>(QStringLiteral("inPlaceButton"));
    QVERIFY(restart->isVisible());
    QTest::mouseClick(restart, Qt::LeftButton);
    QTRY_VERIFY2(bench.model->find(QStringLiteral("B1/OUR_STATE")).isValid(),
                 qPrintable(errors.isEmpty() ? bench.message() : errors[0][0].toString()));
    QVERIFY(!bench.model->find(QStringLiteral("B1/VISION_LOST")).isValid());
    QVERIFY(bench.settings.contains(QStringLiteral("variables/catalog")));
    catalog->usePublished();
    QTest::mouseClick(restart, Qt::LeftButton);
    QTRY_VERIFY(bench.model->find(QStringLiteral("B1/VISION_LOST")).isValid());
    QVERIFY(!bench.settings.contains(QStringLiteral("variables/catalog")));
  }

  void attachedBlackboardIsSampledAndItsEndIsSaid() {
    const int key = testKeyBase() + 77;
    removeSegment(key);
    Bench bench;
    bench.source.choose(&bench.controller);
    bench.controller.open(link::loadScenario("match-3v3").value(), false);
    QTRY_VERIFY(bench.controller.frame());
    auto* form = bench.dock->findChild<QWidget*>(QStringLiteral("attachForm"));
    form->show();
    form->findChild<QSpinBox*>(QStringLiteral("attachKey"))->setValue(key);
    auto* attach = form->findChild<QPushButton*>(QStringLiteral("attachButton"));
    QTest::mouseClick(attach, Qt::LeftButton);
    QVERIFY2(bench.message().startsWith(QStringLiteral("Not attached")),
             qPrintable(bench.message()));
    const QString group = QStringLiteral("B%1").arg(key / 100);  // as published: 100 n is robot n
    {
      auto board = link::SystemVSegments::open(key, link::AttachMode::AttachOrCreate);
      QVERIFY(board);
      board->write(*link::VariableCatalog::published().intVar("DECISION_STATE"), 42);
      QTest::mouseClick(attach, Qt::LeftButton);
      QVERIFY(!form->isVisible());
      const QString state = group + QStringLiteral("/DECISION_STATE");
      QTRY_VERIFY(bench.model->find(state).isValid());
      bench.choose(state);
      bench.view->scrollTo(bench.at(state));
      QTRY_COMPARE(bench.text(state, VariablesModel::Value), QStringLiteral("42"));
      QVERIFY(!bench.model->whyNotEditable(bench.model->find(state)).isEmpty());
      QVERIFY(bench.text(group, VariablesModel::Value).toDouble() > 0);
      bench.controller.restart();
      QTRY_VERIFY(bench.model->find(state).isValid());
    }
    QTRY_VERIFY2(bench.text(group, VariablesModel::Name).contains(QStringLiteral("removed")),
                 qPrintable(bench.text(group, VariablesModel::Name)));
    QVERIFY(bench.message().contains(QStringLiteral("was removed")));
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

QTEST_MAIN(TestVariablesDock)
#include "tst_variables_dock.moc"
