// SPDX-License-Identifier: GPL-3.0-or-later
// Values that are typed, names that are imported, blackboards that are attached, robots that fall
// silent.
#include <QSpinBox>
#include <QTableWidget>

#include <robotlink/blackboard/system_v.h>
#include <ui/live/attach_dialog.h>
#include <ui/sources/live_settings.h>
#include <ui/sources/match_memory.h>

#include "../../support/group_facts.h"
#include "../support/segment_keys.h"
#include "catalog_choice.h"
#include "variables_bench.h"

namespace tst_variables_edit {

using namespace pitchboard;
using namespace pitchboard::ui;
using namespace pitchboard::ui::test;

class TestVariablesEdit : public QObject {
  Q_OBJECT

  /// The panel with an editor that is open.
  struct Editing {
    Bench bench;
    QSignalSpy edited{bench.model, &VariablesModel::valueEdited};
    QLineEdit* editor;
    explicit Editing(const QString& path) : editor(bench.edit(path)) {}
  };

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void valuesAreLockedAtFirst() {
    Bench bench;
    bench.hand.take(twoRobots(), SourceKind::Simulate);
    bench.choose(ballDistance);
    QTest::keyClick(bench.view, Qt::Key_F2);
    QVERIFY(!bench.view->isEditing());
    QVERIFY(bench.message().contains(QStringLiteral("Editing is off")));
    QVERIFY(bench.at(ballDistance)
                .data(Qt::ToolTipRole)
                .toString()
                .contains(QStringLiteral("distance to the ball")));
    bench.press("editValues");
    QTest::keyClick(bench.view, Qt::Key_F2);
    QVERIFY(bench.view->isEditing());
  }

  void anOfflineRobotIsGreyFromItsNameOn() {
    Bench bench;
    auto store = twoRobots();
    bench.hand.take(store, SourceKind::Live);
    const auto look = [&bench] {
      bench.model->refresh(bench.view->rowsInSight(), bench.view->sparkPixels());
      return bench.at(QStringLiteral("B2")).data(Qt::ForegroundRole).value<QColor>();
    };
    QVERIFY(look() != theme().disabledText);
    for (int second = 11; second <= 30; ++second) {
      append(*store, *store->findGroup("B1"), second, 1, 0, 100.0F, 0.5);
    }
    QSignalSpy changed(bench.model, &QAbstractItemModel::dataChanged);
    QCOMPARE(look(), theme().disabledText);
    // The name is painted again as well.
    const QModelIndex name = bench.model->find(QStringLiteral("B2"));
    QVERIFY(std::ranges::any_of(changed, [&name](const QList<QVariant>& call) {
      const auto first = call[0].toModelIndex(), last = call[1].toModelIndex();
      return first.parent() == name.parent() && first.column() == 0 && first.row() <= name.row() &&
             last.row() >= name.row();
    }));
    append(*store, *store->findGroup("B2"), 30.5, 1, 0, 100.0F, 0.5);
    QVERIFY(look() != theme().disabledText);
  }

  void readOnlyVariablesExplainWhy_data() {
    QTest::addColumn<SourceKind>("kind");
    QTest::addColumn<QString>("path");
    QTest::addColumn<QString>("reason");
    QTest::newRow("truth") << SourceKind::Simulate << "B1/TRUE_X"
                           << "truth";
    QTest::newRow("live") << SourceKind::Live << ballDistance << "Live";
    QTest::newRow("replay") << SourceKind::Replay << ballDistance << "recording";
    QTest::newRow("attached") << SourceKind::Simulate << "key 900/VISION_LOST"
                              << "read-only";
  }
  void readOnlyVariablesExplainWhy() {
    QFETCH(const SourceKind, kind);
    QFETCH(const QString, path);
    QFETCH(const QString, reason);
    auto store = twoRobots();
    telemetry::GroupInfo attached = robotGroup("key 900", 9);
    attached.robot = telemetry::facts({{"key", "900"}});
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
                           << "nor a label of";
    QTest::newRow("two commas") << ballDistance << "1,234,5"
                                << "not a number";
  }
  void badValuesAreRefusedBesideTheEditor() {
    QFETCH(const QString, path);
    QFETCH(const QString, typed);
    QFETCH(const QString, problem);
    Editing on(path);
    QVERIFY(on.editor);
    on.editor->selectAll();
    QTest::keyClicks(on.editor, typed);
    QTest::keyClick(on.editor, Qt::Key_Return);
    auto* reported = on.bench.dock->findChild<QLabel*>(QStringLiteral("valueProblem"));
    QVERIFY(reported->isVisible());
    QVERIFY2(reported->text().contains(problem), qPrintable(reported->text()));
    QVERIFY(on.bench.view->isEditing());
    QTest::keyClick(on.editor, Qt::Key_Escape);
    QTRY_VERIFY(!on.bench.view->isEditing());
    QCOMPARE(on.edited.count(), 0);
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
    Editing on(path);
    QVERIFY(on.editor);
    on.editor->setText(typed);
    QTest::keyClick(on.editor, Qt::Key_Return);
    QTRY_COMPARE(on.edited.count(), 1);
    QCOMPARE(on.edited[0][1].toDouble(), value);
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

  void attachedBlackboardIsSampledAndItsEndIsReported() {
    const int key = testKeyBase() + 77;
    removeSegment(key);
    Bench bench;
    bench.source.choose(&bench.controller);
    bench.controller.open(link::loadScenario("match-3v3").value(), false);
    QTRY_VERIFY(bench.controller.frame());
    AttachDialog dialog(&bench.boards, nullptr);
    dialog.setAttribute(Qt::WA_DeleteOnClose, false);
    dialog.show();
    dialog.findChild<QSpinBox*>(QStringLiteral("attachKey"))->setValue(key);
    auto* attach = dialog.findChild<QPushButton*>(QStringLiteral("attach"));
    auto* reported = dialog.findChild<QLabel*>(QStringLiteral("attachMessage"));
    QTest::mouseClick(attach, Qt::LeftButton);
    QVERIFY(!reported->text().isEmpty());
    // The list is that of Live.
    QCOMPARE(bench.live.options().boards.size(), std::size_t(1));
    const QString group = QStringLiteral("B%1").arg(key / 100);  // as published: 100 n is robot n
    {
      auto board = link::SystemVSegments::open(key, link::AttachMode::AttachOrCreate);
      QVERIFY(board);
      board->write(*link::VariableCatalog::published().intVar("DECISION_STATE"), 42);
      QTest::mouseClick(attach, Qt::LeftButton);
      QVERIFY2(reported->text().isEmpty(), qPrintable(reported->text()));
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
    // None of the match's robots, whatever its number is.
    const auto rows = bench.controller.memory()->series();
    const auto attributes = attributesOf(rows->view(*rows->findGroup(group.toStdString()))->info());
    for (const char* ofRobots : {"robot", "number", "team"}) {
      QVERIFY2(!attributes.contains(ofRobots), ofRobots);
    }
    QCOMPARE(loadLiveSettings(bench.settings).options.boards, bench.live.options().boards);
    dialog.findChild<QTableWidget*>(QStringLiteral("attachedBoards"))->selectRow(0);
    QTest::mouseClick(dialog.findChild<QPushButton*>(QStringLiteral("detach")), Qt::LeftButton);
    QVERIFY(bench.boards.list().empty());
  }
};

PITCHBOARD_GUI_TEST(TestVariablesEdit)

}  // namespace tst_variables_edit

#include "tst_variables_edit.moc"
