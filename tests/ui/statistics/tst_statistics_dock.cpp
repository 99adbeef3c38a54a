// SPDX-License-Identifier: GPL-3.0-or-later
// The panel Statistics in the window, with mouse and keys: the numbers of the command line for a
// recording and for a running match, the stretches, what is copied and saved, and the map.

#include <QClipboard>
#include <QComboBox>
#include <QDockWidget>
#include <QDropEvent>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QProgressBar>
#include <QPushButton>
#include <QTabBar>
#include <QTimer>
#include <QToolButton>
#include <cmath>

#include <robotlink/scenario/scenario.h>
#include <telemetry/query/stretch_table.h>
#include <ui/base/plot_target.h>
#include <ui/base/theme.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/scenario_files.h>

#include "../../support/program_run.h"
#include "../../support/sanitized.h"
#include "../event_loop_watchdog.h"
#include "../studio_rig.h"
#include "field_map.h"
#include "line_charts.h"
#include "line_details.h"
#include "statistics_table.h"

namespace tst_statistics_dock {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

constexpr int patience_ms = 30'000;

struct Panel : studio_rig::PanelStudio {
  Panel() : PanelStudio("statistics") {}
  StatisticsTable* table() const { return find<StatisticsTable>("statisticsTable"); }
  StatisticsModel* model() const { return find<StatisticsModel>("statisticsModel"); }
  QString state() const { return find<QLabel>("statisticsState")->text(); }
  QString problem() const { return find<QLabel>("inPlaceText")->text(); }
  void type(const char* name, const QString& text) const {
    auto* box = find<QLineEdit>(name);
    box->setFocus();
    box->selectAll();
    QTest::keyClicks(box, text);
    hidePopups();
    QTest::keyClick(box, Qt::Key_Return);
  }
  /// Lists that would take the keys.
  static void hidePopups() {
    for (QWidget* popup : QApplication::topLevelWidgets()) {
      if (popup->windowType() == Qt::Popup) popup->hide();
    }
  }
  void add(const QString& text) const { type("addStatistics", text); }
  void choose(const char* name, const QString& text) const {
    auto* box = find<QComboBox>(name);
    const int index = box->findText(text);
    if (index < 0) qFatal("no such entry");
    box->setCurrentIndex(index);
  }
  int rowOf(const std::string& robot, const std::string& variable) const {
    for (int row = 0; row < model()->rowCount(); ++row) {
      const telemetry::StretchLine& line = model()->at(row).line;
      if (line.robot == robot && line.variable == variable && !model()->at(row).isMissing) {
        return row;
      }
    }
    return -1;
  }
  const telemetry::StretchLine* line(const std::string& robot, const std::string& variable) const {
    const int row = rowOf(robot, variable);
    return row < 0 ? nullptr : &model()->at(row).line;
  }
  QModelIndex cell(int row, int column) const {
    const auto* sorted = qobject_cast<QSortFilterProxyModel*>(table()->model());
    return sorted->mapFromSource(model()->index(row, column));
  }
  void click(const QModelIndex& index) const {
    table()->scrollTo(index);
    QTest::mouseClick(table()->viewport(), Qt::LeftButton, {}, table()->visualRect(index).center());
  }
  /// Everything, as for a spreadsheet, without the column of the session.
  QStringList copied() const {
    hidePopups();
    table()->setFocus();
    table()->selectAll();
    QTest::keyClick(table(), Qt::Key_C, Qt::ControlModifier);
    return QApplication::clipboard()->text().trimmed().split(QLatin1Char('\n'));
  }
};

/// The lines of a CSV as those of a spreadsheet.
QStringList withTabs(const QByteArray& csv) {
  QString out;
  bool isQuoted = false;
  for (const QChar c : QString::fromUtf8(csv).trimmed()) {
    if (c == QLatin1Char('"')) {
      isQuoted = !isQuoted;
    } else {
      out += c == QLatin1Char(',') && !isQuoted ? QLatin1Char('\t') : c;
    }
  }
  return out.split(QLatin1Char('\n'));
}

void drop(QWidget* at, const QStringList& names) {
  QMimeData data;
  data.setData(variablesMimeType, names.join(QLatin1Char('\n')).toUtf8());
  const QPoint middle = at->rect().center();
  QDragEnterEvent enter(middle, Qt::CopyAction, &data, Qt::LeftButton, {});
  QApplication::sendEvent(at, &enter);
  QVERIFY(enter.isAccepted());
  QDropEvent dropped(middle, Qt::CopyAction, &data, Qt::LeftButton, {});
  QApplication::sendEvent(at, &dropped);
  QVERIFY(dropped.isAccepted());
}

}  // namespace

class TestStatisticsDock : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;
  QString m_match, m_other;

  QString path(const char* name) const { return m_folder.filePath(QLatin1String(name)); }

 private slots:
  void initTestCase() {
    setTheme(*qApp, ThemeChoice::Dark);
    m_match = path("match.mcap");
    m_other = path("other.mcap");
    for (const auto& [file, seed] : {std::pair(m_match, "3"), std::pair(m_other, "4")}) {
      const ProgramRun run =
          cli({"record", "--scenario", "match-3v3", "--noise", "realistic", "--seed", seed,
               "--speed", "max", "--duration", "20", "-o", file});
      QVERIFY2(run.exitCode == 0, run.err.constData());
    }
  }

  void theNumbersAreThoseOfTheCommandLine() {
    Panel s;
    QVERIFY(s.find<QLabel>("emptyStatistics")->isVisible());
    s.open(m_match);
    s.window.shown()->setSelection(telemetry::TimeRange{2.0, 15.5});
    s.add(QStringLiteral("TRUE_X"));
    s.add(QStringLiteral("VISION_BALL_DIST / 100"));
    s.add(QStringLiteral("DECISION_ACTION_A"));
    s.add(QStringLiteral("B1.TRUE_Y - R1.TRUE_Y"));
    s.type("statisticsWhile", QStringLiteral("match.BALL_X < 3"));
    s.type("statisticsAgainst", QStringLiteral("BELIEF_X"));
    const ProgramRun run = cli({"statistics", m_match, "--expr", "TRUE_X", "--expr",
                                "VISION_BALL_DIST / 100", "--expr", "DECISION_ACTION_A", "--expr",
                                "B1.TRUE_Y - R1.TRUE_Y", "--while", "match.BALL_X < 3", "--against",
                                "BELIEF_X", "--from", "2", "--until", "15.5", "--csv"});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const QStringList expected = withTabs(run.out);
    QVERIFY(expected.size() > 15);
    QTRY_COMPARE_WITH_TIMEOUT(s.copied(), expected, patience_ms);
    QVERIFY2(s.state().contains(QStringLiteral("while match.BALL_X < 3")), qPrintable(s.state()));

    // Between two events, for some robots.
    s.type("statisticsWhile", QString());
    s.find<QLineEdit>("statisticsWhile")->clear();
    s.find<QLineEdit>("statisticsAgainst")->clear();
    s.choose("statisticsStretch", QStringLiteral("Between events"));
    auto* first = s.find<QComboBox>("statisticsFirstEvent");
    first->showPopup();
    QVERIFY(first->findText(QStringLiteral("kick")) >= 0);
    first->hidePopup();
    for (const auto& [name, event] :
         {std::pair("statisticsFirstEvent", "referee"), std::pair("statisticsLastEvent", "kick")}) {
      auto* box = s.find<QComboBox>(name);
      box->lineEdit()->selectAll();
      QTest::keyClicks(box->lineEdit(), QLatin1String(event));
      QTest::keyClick(box->lineEdit(), Qt::Key_Return);
    }
    Panel::hidePopups();
    s.window.activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&s.window));
    auto* robots = s.find<QMenu>("statisticsRobotsMenu");
    emit robots->aboutToShow();
    for (QAction* action : robots->actions()) {
      if (action->text() == QStringLiteral("B1") || action->text() == QStringLiteral("R2")) {
        action->trigger();
      }
    }
    const ProgramRun between =
        cli({"statistics", m_match, "--expr", "TRUE_X", "--expr", "VISION_BALL_DIST / 100",
             "--expr", "DECISION_ACTION_A", "--expr", "B1.TRUE_Y - R1.TRUE_Y", "--between",
             "referee", "kick", "--robots", "B1,R2", "--csv"});
    QVERIFY2(between.exitCode == 0, between.err.constData());
    QTRY_COMPARE_WITH_TIMEOUT(s.copied(), withTabs(between.out), patience_ms);
  }

  void aRunningMatchIsDescribedLikeItsRecording() {
    Panel s;
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    s.controller.runTo(300);
    s.add(QStringLiteral("TRUE_X"));
    s.add(QStringLiteral("VISION_LOST"));
    s.choose("statisticsStretch", QStringLiteral("Everything"));
    const auto samples = [&s] {
      const telemetry::StretchLine* line = s.line("B1", "TRUE_X");
      return line == nullptr ? std::uint64_t(0) : line->summary.samples;
    };
    QTRY_VERIFY2_WITH_TIMEOUT(samples() == 301, qPrintable(s.problem() + s.state()), patience_ms);
    // More rows, more samples, by themselves.
    s.controller.runTo(600);
    QTRY_COMPARE_WITH_TIMEOUT(samples(), std::uint64_t(601), patience_ms);
    // The rows of memory, counted by hand.
    const auto rows = s.window.shown()->series();
    const auto all = rows->range();
    QVERIFY(all);
    s.window.shown()->setSelection(telemetry::TimeRange{0.5, 1.0});
    s.choose("statisticsStretch", QStringLiteral("Selected range"));
    const auto id = rows->find("B1", "TRUE_X");
    QVERIFY(id);
    const auto expected = rows->view(id->group)->statistics(id->column, {0.5, 1.0});
    QVERIFY(expected.samples > 20);
    QTRY_COMPARE_WITH_TIMEOUT(samples(), expected.samples, patience_ms);
    QVERIFY(std::abs(s.line("B1", "TRUE_X")->summary.mean - expected.mean) < 1e-12);
    // Another match forgets nothing of what was asked for.
    QCOMPARE(s.settings.value(QStringLiteral("statistics/variables")).toStringList(),
             (QStringList{QStringLiteral("TRUE_X"), QStringLiteral("VISION_LOST")}));
  }

  void extremesLeadToTheirMoments() {
    Panel s;
    s.open(m_match);
    s.add(QStringLiteral("BELIEF_X"));
    s.type("statisticsAgainst", QStringLiteral("TRUE_X"));
    QTRY_VERIFY_WITH_TIMEOUT(s.line("R1", "BELIEF_X") != nullptr && s.line("R1", "BELIEF_X")->error,
                             patience_ms);
    const int row = s.rowOf("R1", "BELIEF_X");
    const telemetry::StretchLine line = *s.line("R1", "BELIEF_X");
    s.click(s.cell(row, StatisticsModel::LargestError));
    QCOMPARE(s.window.shown()->time(), line.error->largestAt);
    s.click(s.cell(row, StatisticsModel::Max));
    QCOMPARE(s.window.shown()->time(), line.summary.mostAt);
    s.click(s.cell(row, StatisticsModel::Min));
    QCOMPARE(s.window.shown()->time(), line.summary.leastAt);
    s.click(s.cell(row, StatisticsModel::Robot));  // no moment
    QCOMPARE(s.window.shown()->time(), line.summary.leastAt);
    // The same in the details.
    auto* comparison = s.find<QLabel>("statisticsComparison");
    QVERIFY2(comparison->text().contains(QStringLiteral("Against TRUE_X")),
             qPrintable(comparison->text()));
    emit comparison->linkActivated(QString::number(line.error->largestAt, 'g', 15));
    QCOMPARE(s.window.shown()->time(), line.error->largestAt);
    QVERIFY(s.find<DelayChart>("delayChart")->isVisible());
    auto* chart = s.find<DistributionChart>("distributionChart");
    QVERIFY(chart->isVisible());
    QVERIFY(chart->textAt({chart->width() / 2, 20}).contains(QStringLiteral("samples")));
  }

  void columnsSort() {
    Panel s;
    s.open(m_match);
    s.add(QStringLiteral("TRUE_X"));
    s.add(QStringLiteral("DECISION_ACTION_A"));  // has no mean: always last
    QTRY_VERIFY_WITH_TIMEOUT(s.model()->rowCount() == 12, patience_ms);
    QHeaderView* header = s.table()->horizontalHeader();
    for (const bool descending : {false, true}) {
      const int x = header->sectionViewportPosition(StatisticsModel::Mean) + 12;
      QTest::mouseClick(header->viewport(), Qt::LeftButton, {}, {x, header->height() / 2});
      QList<double> means;
      for (int row = 0; row < 12; ++row) {
        means << s.table()
                     ->model()
                     ->index(row, StatisticsModel::Mean)
                     .data(StatisticsModel::sortRole)
                     .toDouble();
      }
      for (int row = 0; row < 12; ++row) QCOMPARE(std::isnan(means[row]), row >= 6);
      means.resize(6);
      QVERIFY(descending ? std::is_sorted(means.rbegin(), means.rend())
                         : std::is_sorted(means.begin(), means.end()));
    }
    // States are shares of the time.
    const int row = s.rowOf("B1", "DECISION_ACTION_A");
    QVERIFY(s.model()
                ->index(row, StatisticsModel::States)
                .data()
                .toString()
                .contains(QStringLiteral(" %")));
    double sum = 0.0;
    for (const auto& state : s.model()->at(row).states) sum += state.state->share;
    QVERIFY(std::abs(sum - 1.0) < 1e-9);
  }

  void variablesAreDroppedAndRemoved() {
    Panel s;
    s.open(m_match);
    drop(s.dock->widget(), {QStringLiteral("B1/TRUE_X"), QStringLiteral("R2/TRUE_Y")});
    QTRY_VERIFY_WITH_TIMEOUT(s.line("B1", "B1.TRUE_X") && s.line("R2", "R2.TRUE_Y"), patience_ms);
    QCOMPARE(s.model()->rowCount(), 2);
    s.click(s.cell(s.rowOf("B1", "B1.TRUE_X"), StatisticsModel::Variable));
    s.find<QAction>("statisticsOfEachRobot")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(s.model()->rowCount() == 7 && s.line("R3", "TRUE_X"), patience_ms);
    s.click(s.cell(s.rowOf("R2", "R2.TRUE_Y"), StatisticsModel::Variable));
    s.find<QAction>("removeStatistics")->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(s.model()->rowCount(), 6, patience_ms);
    s.table()->selectAll();
    s.find<QAction>("removeStatistics")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(s.find<QLabel>("emptyStatistics")->isVisible(), patience_ms);
  }

  void mistakesAreSentences() {
    Panel s;
    s.open(m_match);
    s.add(QStringLiteral("TRUE_X +"));
    QVERIFY(!s.problem().isEmpty());
    QCOMPARE(s.find<QLineEdit>("addStatistics")->text(), QStringLiteral("TRUE_X +"));
    QCOMPARE(s.model()->rowCount(), 0);
    s.add(QStringLiteral("TRUE_XX"));
    QTRY_VERIFY2_WITH_TIMEOUT(s.problem().contains(QStringLiteral("did you mean TRUE_X?")),
                              qPrintable(s.problem()), patience_ms);
    QCOMPARE(s.model()->rowCount(), 1);  // the name stays, so that it can be removed
    QVERIFY(s.model()->at(0).isMissing);
    s.add(QStringLiteral("TRUE_X"));
    s.type("statisticsWhile", QStringLiteral("NOSUCH > 1"));
    QTRY_VERIFY2_WITH_TIMEOUT(s.problem().contains(QStringLiteral("NOSUCH")),
                              qPrintable(s.problem()), patience_ms);
    s.find<QLineEdit>("statisticsWhile")->clear();
    QTRY_VERIFY_WITH_TIMEOUT(s.line("B1", "TRUE_X") != nullptr, patience_ms);
  }

  void severalSessionsHaveTheirLines() {
    const QString third = path("third.mcap");
    const ProgramRun made = cli({"record", "--scenario", "match-3v3", "--noise", "realistic",
                                 "--seed", "5", "--duration", "20", "-o", third});
    QVERIFY2(made.exitCode == 0, made.err.constData());
    Panel s;
    s.open(m_match);
    s.add(QStringLiteral("BELIEF_ERROR"));
    s.add(QStringLiteral("DECISION_ACTION_A"));
    ComparedSessions* compared = s.window.compared();
    compared->open({m_other, third, m_other});
    // What the command line says of each file alone.
    const auto expected = [](const QStringList& files) {
      QStringList lines;
      for (const QString& file : files) {
        const ProgramRun run = cli(
            {"statistics", file, "--expr", "BELIEF_ERROR", "--expr", "DECISION_ACTION_A", "--csv"});
        const QStringList all = withTabs(run.out);
        lines << (lines.isEmpty() ? all : all.mid(1));
      }
      lines.back() = lines.back().trimmed();  // as what is copied
      return lines;
    };
    const QStringList four = expected({m_match, m_other, third, m_other});
    QVERIFY(four.size() > 4 * 12);
    QTRY_COMPARE_WITH_TIMEOUT(s.copied(), four, patience_ms);
    QVERIFY(four.back().startsWith(m_other));
    QVERIFY(!s.table()->isColumnHidden(StatisticsModel::Session));
    const int rows = s.model()->rowCount();
    QCOMPARE(rows % 4, 0);
    const auto session = [&s](int row) {
      return s.model()->index(row, StatisticsModel::Session).data().toString();
    };
    QCOMPARE(session(0), QStringLiteral("match.mcap"));
    QCOMPARE(session(rows / 4), QStringLiteral("′ other.mcap"));
    QCOMPARE(session(rows - 1), QStringLiteral("′₃ other.mcap"));

    compared->all()[1]->setOffset(3.0);
    QTRY_COMPARE_WITH_TIMEOUT(s.model()->at(rows / 2).offset, 3.0, patience_ms);
    // Sessions are chosen with the robots.
    auto* menu = s.find<QMenu>("statisticsRobotsMenu");
    emit menu->aboutToShow();
    for (QAction* action : menu->actions()) {
      if (action->text() == QStringLiteral("The one shown") ||
          action->text() == QStringLiteral("′₃ other")) {
        action->trigger();
      }
    }
    QTRY_COMPARE_WITH_TIMEOUT(s.copied(), expected({m_other, third}), patience_ms);
    QVERIFY2(s.find<QToolButton>("statisticsRobots")->text().contains("2 of 4 sessions"),
             qPrintable(s.find<QToolButton>("statisticsRobots")->text()));
    compared->removeAll();
    QTRY_COMPARE_WITH_TIMEOUT(s.copied(), expected({m_match}), patience_ms);
    QVERIFY(s.table()->isColumnHidden(StatisticsModel::Session));
  }

  void valuesOverTheField() {
    Panel s;
    s.open(m_match);
    s.add(QStringLiteral("BELIEF_ERROR"));
    QTRY_VERIFY_WITH_TIMEOUT(s.line("B1", "BELIEF_ERROR") != nullptr, patience_ms);
    auto* views = s.find<QTabBar>("statisticsViews");
    QTest::mouseClick(views, Qt::LeftButton, {}, views->tabRect(1).center());
    QTRY_VERIFY_WITH_TIMEOUT(s.line("B1", "BELIEF_ERROR")->map.has_value(), patience_ms);
    const telemetry::StretchLine* line = s.line("B1", "BELIEF_ERROR");
    std::uint64_t samples = line->map->outside;
    double sum = 0.0;
    for (std::size_t i = 0; i < line->map->counts.size(); ++i) {
      samples += line->map->counts[i];
      if (line->map->counts[i] > 0) {
        sum += line->map->means[i] * static_cast<double>(line->map->counts[i]);
      }
    }
    QCOMPARE(samples, line->summary.samples);
    QVERIFY(std::abs(sum / static_cast<double>(samples) - line->summary.mean) < 1e-9);
    auto* map = s.find<FieldMap>("fieldMap");
    QTRY_VERIFY(map->isVisible());
    QString text;
    for (int x = 0; x < map->width() && text.isEmpty(); x += 3) {
      for (int y = 0; y < map->height() && text.isEmpty(); y += 3) text = map->textAt({x, y});
    }
    QVERIFY2(text.contains(QStringLiteral("samples at x")), qPrintable(text));
  }

  void workIsCancelledAndShowsProgress() {
    auto rows = std::make_shared<telemetry::SeriesStore>();
    telemetry::GroupInfo group;
    group.name = "B1";
    telemetry::ColumnInfo column;
    column.name = "X";
    group.columns.push_back(column);
    const telemetry::GroupId id = rows->addGroup(group);
    for (int i = 0; i < 400'000; ++i) {
      const double value = std::sin(i * 0.001);
      rows->append(id, {i / 60.0, {}, std::span(&value, 1)});
    }
    StretchOrder order;
    order.sources.push_back({"Simulate", {}, rows, {}, 0.0});
    for (int i = 0; i < 40; ++i) {
      const std::string text = "X + " + std::to_string(i);
      order.question.texts.push_back({text, text});
    }
    StretchWork work(nullptr);
    QSignalSpy progressed(&work, &StretchWork::progressed);
    QSignalSpy finished(&work, &StretchWork::finished);
    work.start(order);
    QVERIFY(work.isRunning());
    QTRY_VERIFY_WITH_TIMEOUT(!progressed.isEmpty(), patience_ms);
    work.cancel();
    QVERIFY(!work.isRunning() && finished.isEmpty());
    // Behind it comes the next one, and only that.
    order.question.texts = {{"X * 2", "X * 2"}};
    order.range = telemetry::TimeRange{1.0, 2.0};
    work.start(order);
    QTRY_COMPARE_WITH_TIMEOUT(finished.size(), qsizetype(1), patience_ms);
    QCOMPARE(work.result()->lines.size(), std::size_t(1));
    QCOMPARE(work.result()->lines.front().summary.samples, std::uint64_t(61));
  }

  /// The time that the window itself needs, whatever else the computer does.
  void theWindowIsNeverBlocked() {
    Panel s;
    s.open(m_match);
    QTRY_VERIFY_WITH_TIMEOUT(s.window.replay()->loaded() >= 1.0, patience_ms);
    QStringList names{QStringLiteral("B1/TRUE_X")};
    for (const telemetry::GroupInfo& group : s.window.replay()->groups()) {
      for (const telemetry::ColumnInfo& column : group.columns) {
        if (column.kind == telemetry::ColumnKind::Text || names.size() >= 150) continue;
        names << QString::fromStdString(group.name + '/' + column.name);
      }
    }
    drop(s.dock->widget(), names);
    QTRY_VERIFY_WITH_TIMEOUT(s.model()->rowCount() >= 140, patience_ms);
    s.type("statisticsAgainst", QStringLiteral("BELIEF_X"));
    const tests::EventLoopWatchdog turns;
    s.window.shown()->setSelection(telemetry::TimeRange{1.0, 19.0});
    QTRY_VERIFY_WITH_TIMEOUT(s.line("B1", "B1.TRUE_X") && s.line("B1", "B1.TRUE_X")->error &&
                                 s.line("B1", "B1.TRUE_X")->summary.samples == 1081,
                             patience_ms);
    if (PITCHBOARD_SANITIZED) return;
    QVERIFY2(turns.longest_ms() < 50.0, qPrintable(QString::number(turns.longest_ms())));
  }
};

PITCHBOARD_GUI_TEST(TestStatisticsDock)

}  // namespace tst_statistics_dock

#include "tst_statistics_dock.moc"
