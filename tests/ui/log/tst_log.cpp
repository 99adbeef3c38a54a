// SPDX-License-Identifier: GPL-3.0-or-later
#include <QAbstractItemModelTester>
#include <QClipboard>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollBar>
#include <QTableView>
#include <QTemporaryDir>
#include <QTimer>
#include <QToolButton>
#include <QtTest>
#include <map>

#include <ui/base/text_filter.h>
#include <ui/base/time_axis.h>
#include <ui/log/log_dock.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/shown_moment.h>

#include "log_model.h"

namespace tst_log {

using namespace pitchboard;
using namespace pitchboard::ui;
using Mode = QAbstractItemModelTester::FailureReportingMode;

class TestLog : public QObject {
  Q_OBJECT

  static std::vector<LogLine> lines(int count, int first = 0) {
    std::vector<LogLine> made;
    for (int i = 0; i < count; ++i) {
      made.push_back({double(i), "B1 decision", "line " + std::to_string(first + i)});
    }
    return made;
  }

  /// The panel with nothing but what the test says.
  struct Panel {
    MatchController controller{link::MatchOptions{}};
    ShownMoment shown{&controller};
    std::unique_ptr<QWidget> dock{makeLogDock(&controller, &shown, nullptr)};
    QTableView* table = dock->findChild<QTableView*>();
    QToolButton* follow = dock->findChild<QToolButton*>(QStringLiteral("logFollow"));
    Panel() {
      dock->resize(900, 300);
      dock->show();
    }
    bool atEnd() const {
      return table->verticalScrollBar()->value() == table->verticalScrollBar()->maximum();
    }
  };

 private slots:
  void whatWasUndoneIsStruckThrough() {
    LogModel model;
    const QAbstractItemModelTester tester(&model, Mode::QtTest);
    std::vector<LogLine> reported = lines(3);
    reported[1].cause = 7;
    model.append(reported, {}, &SourceKind::Simulate);
    const auto struck = [&model](int row) {
      return model.index(row, LogModel::Text).data(Qt::FontRole).value<QFont>().strikeOut();
    };
    model.strike(SourceKind::Live, 7);
    QVERIFY(!struck(1));
    model.strike(SourceKind::Simulate, 7);
    QVERIFY(!struck(0) && struck(1) && !struck(2));
    // Done again it counts: later lines of the same decision are plain.
    model.append({reported[1]}, {}, &SourceKind::Simulate);
    QVERIFY(struck(1) && !struck(3));
  }

  /// Simulated and live lines stand together, because both go on; what a file says does not.
  void linesOfASessionAreShownWithIt() {
    Panel p;
    ReplayController replay;
    p.dock.reset();
    p.shown.add(&replay);
    const std::unique_ptr<QWidget> dock(makeLogDock(&p.controller, &p.shown, nullptr));
    const auto texts = [&dock] {
      const QAbstractItemModel* model = dock->findChild<QTableView*>()->model();
      QStringList all;
      for (int row = 0; row < model->rowCount(); ++row) {
        all << model->index(row, LogModel::Text).data().toString();
      }
      return all;
    };
    emit p.controller.logReceived({{1.0, "B1 decision", "played"}});
    emit replay.logReceived({{1.0, "B1 decision", "recorded"}});
    QCOMPARE(texts(), QStringList{QStringLiteral("played")});
    p.shown.choose(&replay);
    QCOMPARE(texts(), (QStringList{QStringLiteral("played"), QStringLiteral("recorded")}));
    // Another session has other lines.
    emit replay.restarted();
    emit replay.logReceived({{1.0, "B1 decision", "recorded later"}});
    QCOMPARE(texts(), (QStringList{QStringLiteral("played"), QStringLiteral("recorded later")}));
    p.shown.choose(&p.controller);
    QCOMPARE(texts(), QStringList{QStringLiteral("played")});
  }

  void anUndoneGoalIsStruckThroughInTheLog() {
    Panel p;
    link::MatchEvent goal, undone;
    goal.kind = link::MatchEventKind::Goal;
    goal.cause = undone.cause = 3;
    undone.kind = link::MatchEventKind::Undone;
    emit p.controller.eventsReceived({goal, undone});
    const auto* model = p.dock->findChild<LogModel*>();
    QCOMPARE(model->rowCount(), 1);
    QVERIFY(model->index(0, LogModel::Text).data(Qt::FontRole).value<QFont>().strikeOut());
  }

  void initTestCase() { QApplication::setAttribute(Qt::AA_DontUseNativeDialogs); }

  void chosenLinesAreCopied() {
    Panel panel;
    QVERIFY(QTest::qWaitForWindowActive(panel.dock.get()));
    emit panel.controller.logReceived({{1.0, "B1 decision", "first"},
                                       {2.0, "B1 decision", "second"},
                                       {3.0, "R1 decision", "third"}});
    panel.table->setFocus();
    panel.table->selectRow(0);
    panel.table->selectionModel()->select(panel.table->model()->index(2, 0),
                                          QItemSelectionModel::Select | QItemSelectionModel::Rows);
    QTest::keySequence(panel.table, QKeySequence::Copy);
    const QStringList copied = QApplication::clipboard()->text().split('\n');
    QCOMPARE(copied.size(), 2);
    QVERIFY(copied[0].endsWith(QStringLiteral("\tB1 decision\tfirst")));
    QVERIFY(copied[1].endsWith(QStringLiteral("\tR1 decision\tthird")));
  }

  void theLinesShownAreSaved() {
    Panel panel;
    emit panel.controller.logReceived(
        {{1.0, "B1 decision", "kicks"}, {2.0, "B1 decision", "walks"}, {3.0, "R1", "kicks"}});
    panel.dock->findChild<QLineEdit*>(QStringLiteral("logFilter"))
        ->setText(QStringLiteral("kicks"));
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("log.txt"));
    QTimer answer;
    connect(&answer, &QTimer::timeout, this, [&] {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (!dialog) return;
      answer.stop();
      dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))->setText(path);
      auto* buttons = dialog->findChild<QDialogButtonBox*>();
      QTest::mouseClick(buttons->button(QDialogButtonBox::Save), Qt::LeftButton);
      if (dialog->isVisible()) dialog->reject();
    });
    answer.start(20);
    for (QToolButton* button : panel.dock->findChildren<QToolButton*>()) {
      if (button->toolTip().startsWith(QStringLiteral("Save"))) {
        QTest::mouseClick(button, Qt::LeftButton);
      }
    }
    QFile file(path);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QList<QByteArray> saved = file.readAll().trimmed().split('\n');
    QCOMPARE(saved.size(), 2);
    QVERIFY(saved[0].endsWith("\tB1 decision\tkicks") && saved[1].endsWith("\tR1\tkicks"));
  }

  // Scrolling up stops following; the button, or scrolling to the end, follows again.
  void followKeepsTheNewestLineInView() {
    Panel panel;
    emit panel.controller.logReceived(lines(500));
    QTRY_VERIFY(panel.table->verticalScrollBar()->maximum() > 0 && panel.atEnd());
    emit panel.controller.logReceived(lines(10, 500));
    QTRY_VERIFY(panel.atEnd());
    QVERIFY(panel.follow->isChecked());
    QScrollBar* bar = panel.table->verticalScrollBar();
    bar->triggerAction(QAbstractSlider::SliderPageStepSub);
    QVERIFY(!panel.follow->isChecked());
    const int reading = bar->value();
    emit panel.controller.logReceived(lines(10, 510));
    QCOMPARE(bar->value(), reading);
    QVERIFY(!panel.atEnd());
    QTest::mouseClick(panel.follow, Qt::LeftButton);
    QTRY_VERIFY(panel.atEnd());
    bar->triggerAction(QAbstractSlider::SliderPageStepSub);
    QVERIFY(!panel.follow->isChecked());
    bar->triggerAction(QAbstractSlider::SliderToMaximum);
    QVERIFY(panel.follow->isChecked());
  }

  /// Times of day and of long sessions were dots, and a new filter left the place.
  void timesAreReadableAndAFilterKeepsThePlace() {
    Panel panel;
    QVERIFY(QTest::qWaitForWindowActive(panel.dock.get()));
    for (const char* text : {"23:59:59.999", "-1:02:03.456"}) {
      const double wide = QFontMetricsF(panel.table->font()).horizontalAdvance(QLatin1String(text));
      QVERIFY(panel.table->columnWidth(LogModel::Time) >= wide + 8);
    }
    std::vector<LogLine> many = lines(200);
    for (std::size_t i = 0; i < many.size(); i += 10) many[i].text += " goal";
    emit panel.controller.logReceived(many);
    QTest::mouseClick(panel.follow, Qt::LeftButton);
    panel.table->scrollTo(panel.table->model()->index(100, 0), QAbstractItemView::PositionAtTop);
    auto* words = panel.dock->findChild<QLineEdit*>(QStringLiteral("logFilter"));
    const auto top = [&panel] {
      const QModelIndex first = panel.table->model()->index(panel.table->rowAt(0), LogModel::Text);
      return first.data().toString();
    };
    QCOMPARE(top(), QStringLiteral("line 100 goal"));
    QTest::keyClicks(words, QStringLiteral("goal"));
    QCOMPARE(panel.table->model()->rowCount(), 20);
    QTest::keyClick(words, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClick(words, Qt::Key_Delete);
    QCOMPARE(panel.table->model()->rowCount(), 200);
    QVERIFY2(std::abs(panel.table->rowAt(0) - 100) <= 10, qPrintable(top()));
  }

  void theLogIsBounded() {
    LogModel model;
    const QAbstractItemModelTester tester(&model, Mode::QtTest);
    model.append(lines(6000));
    model.append(lines(6000, 6000));
    QCOMPARE(model.rowCount(), 10000);
    QCOMPARE(model.dropped(), quint64(2000));
    QCOMPARE(model.index(0, LogModel::Text).data().toString(), QStringLiteral("line 2000"));
    model.append(lines(25000));
    QCOMPARE(model.rowCount(), 10000);
    QCOMPARE(model.index(9999, LogModel::Text).data().toString(), QStringLiteral("line 24999"));
    model.clear();
    QCOMPARE(model.rowCount(), 0);
  }

  void aFloodKeepsTheGoals() {
    LogModel model;
    model.append({{1.0, "referee", "goal BLUE", LogLevel::Info}}, {}, &SourceKind::Simulate, true);
    model.append({{1.5, "B2 vision", "one quiet line", LogLevel::Info}});
    const std::vector<LogLine> burst(1000, {2.0, "B1 decision", "again", LogLevel::Info});
    for (int i = 0; i < 15; ++i) model.append(burst);
    QCOMPARE(model.rowCount(), int(LogModel::maxLines));
    QCOMPARE(model.index(0, LogModel::Text).data().toString(), QStringLiteral("goal BLUE"));
    QCOMPARE(model.index(1, LogModel::Text).data().toString(), QStringLiteral("one quiet line"));
    QCOMPARE(model.dropped(), quint64(15'002 - LogModel::maxLines));
  }

  void theLongestPartsGiveUpTheirOldestLines() {
    LogModel model;
    const QAbstractItemModelTester tester(&model, Mode::QtTest);
    std::vector<LogLine> mixed;
    for (int i = 0; i < 3000; ++i) {
      const double time = i;
      mixed.push_back({time, "B1 decision", "a " + std::to_string(i), LogLevel::Info});
      mixed.push_back({time, "B2 decision", "b " + std::to_string(i), LogLevel::Info});
      if (i % 10 == 0) mixed.push_back({time, "B3 vision", "quiet", LogLevel::Info});
    }
    model.append(mixed, {}, &SourceKind::Simulate);
    model.append(mixed, {}, &SourceKind::Simulate);
    QCOMPARE(model.rowCount(), int(LogModel::maxLines));
    QCOMPARE(model.dropped(), quint64(12'600 - LogModel::maxLines));
    std::map<QString, int> counts;
    for (int row = 0; row < model.rowCount(); ++row) {
      ++counts[model.index(row, LogModel::Origin).data().toString()];
    }
    QCOMPARE(counts[QStringLiteral("B3 vision")], 600);
    QCOMPARE(counts[QStringLiteral("B1 decision")], 4700);
    QCOMPARE(counts[QStringLiteral("B2 decision")], 4700);
    QCOMPARE(model.index(0, LogModel::Text).data().toString(), QStringLiteral("quiet"));
    // Put back: of both passes the lines until then are left.
    model.rewind(SourceKind::Simulate, 1299.5);
    for (int row = 0; row < model.rowCount(); ++row) {
      QVERIFY(model.index(row, LogModel::Time).data(LogModel::timeRole).toDouble() < 1299.5);
    }
    QCOMPARE(model.rowCount(), 130 + 130 + 2 * 1300);
  }

  // Whoever shows the list pays for each removal.
  void aFullListLosesNeighbours() {
    LogModel model;
    const auto say = [&model](int count) {
      for (int i = 0; i < count; ++i) {
        std::vector<LogLine> portion;
        for (int k = 0; k < 100; ++k) {
          portion.push_back({i * 1.0, k % 3 == 0 ? "B1 decision" : "R2 localization",
                             "cycle " + std::to_string(k), LogLevel::Info});
        }
        model.append(portion);
      }
    };
    model.append({{0.0, "B3 vision", "quiet", LogLevel::Info}});
    say(105);
    const QSignalSpy removed(&model, &LogModel::rowsRemoved);
    say(500);
    QVERIFY(model.rowCount() > int(LogModel::maxLines));
    QVERIFY2(removed.size() > 80 && removed.size() <= 100,
             qPrintable(QString::number(removed.size())));
    QCOMPARE(model.index(0, LogModel::Text).data().toString(), QStringLiteral("quiet"));
  }

  void aRestartIsADivider() {
    LogModel model;
    model.setMoment(SourceKind::Simulate, {});
    model.divide(SourceKind::Simulate, QStringLiteral("Match started, 14:03"));
    QCOMPARE(model.rowCount(), 0);  // nothing stands before it
    model.append({{80.0, "B1", "old", LogLevel::Info}}, {}, &SourceKind::Simulate);
    model.divide(SourceKind::Simulate, QStringLiteral("Match started, 14:03"));
    model.append({{1.0, "B1", "new", LogLevel::Info}}, {}, &SourceKind::Simulate);
    QCOMPARE(model.rowCount(), 3);
    QCOMPARE(model.index(1, LogModel::Text).data().toString(),
             QStringLiteral("Match started, 14:03"));
    QVERIFY(model.index(1, LogModel::Time).data().toString().isEmpty());
    // The old match's moments are not those of the new one.
    QVERIFY(!model.index(0, 0).data(LogModel::shownRole).toBool());
    QVERIFY(model.index(2, 0).data(LogModel::shownRole).toBool());
    model.rewind(SourceKind::Simulate, 0.5);
    QCOMPARE(model.rowCount(), 2);
  }

  void theFilterRequiresEveryWord() {
    LogModel model;
    TextFilter filter;
    filter.setSourceModel(&model);
    const QAbstractItemModelTester tester(&filter, Mode::QtTest);
    model.append({{0, "B1 decision", "kicks"}, {1, "R1 decision", "kicks"}});
    filter.setFilterText(QStringLiteral("KICK b1"));
    QCOMPARE(filter.rowCount(), 1);
    filter.setFilterText(QStringLiteral("nothing"));
    QCOMPARE(filter.rowCount(), 0);
    filter.setFilterText(QString());
    QCOMPARE(filter.rowCount(), 2);
  }

  void startLinesAreFoldedAndLevelsChosen() {
    LogModel model;
    LogFilter filter;
    filter.setSourceModel(&model);
    const QAbstractItemModelTester tester(&filter, Mode::QtTest);
    model.append({{0, "B1 decision", "reading the map", LogLevel::Debug},
                  {1, "B1 decision", "the ball is lost"},
                  {1, "B1 decision", "voltage is low", LogLevel::Warning},
                  {2, "B1 decision", "no blackboard", LogLevel::Error}});
    const auto shown = [&filter] {
      QStringList texts;
      for (int row = 0; row < filter.rowCount(); ++row) {
        texts << filter.index(row, LogModel::Text).data().toString().section(' ', -1);
      }
      return texts.join(' ');
    };
    QCOMPARE(shown(), QStringLiteral("lost low blackboard"));
    QCOMPARE(model.startLines(), 1);
    filter.showStartLines(true);
    QCOMPARE(shown(), QStringLiteral("map lost low blackboard"));
    filter.showStartLines(false);
    filter.setLeast(LogLevel::Warning);
    QCOMPARE(shown(), QStringLiteral("low blackboard"));
    filter.setLeast(LogLevel::Error);
    QCOMPARE(shown(), QStringLiteral("blackboard"));
  }

  void eventsAsSentences() {
    link::MatchEvent event;
    event.kind = link::MatchEventKind::UnknownAction;
    event.time = 2.0;
    event.name = "R3";
    event.value = 42;
    const LogLine line = logLineOf(event);
    QCOMPARE(line.time, 2.0);
    QCOMPARE(line.origin, std::string("R3"));
    QVERIFY(line.isWarning());
    QVERIFY(QString::fromStdString(line.text).contains(QStringLiteral("42")));
  }

  void twoFormatsOfOneTime() {
    const QDateTime clock(QDate(2026, 7, 4), QTime(14, 59, 58, 500));
    QCOMPARE(momentText(2.25, 0, clock), QStringLiteral("15:00:00"));
    QCOMPARE(momentText(2.25, 1, clock), QStringLiteral("15:00:00.7"));
    QCOMPARE(momentText(2.25, 3, clock), QStringLiteral("15:00:00.750"));
    QCOMPARE(momentText(2.25, 1, {}), QStringLiteral("00:02.2"));
    LogModel log;
    log.append({{2.25, "B1", "live", LogLevel::Info}}, clock);
    log.append({{2.25, "B1", "simulated", LogLevel::Info}});
    const auto time = [&log](int row) { return log.index(row, LogModel::Time).data().toString(); };
    QCOMPARE(time(0), QStringLiteral("15:00:00.7"));
    QCOMPARE(time(1), QStringLiteral("00:02.2"));
    log.setTimesOfDay(false);
    QCOMPARE(time(0), time(1));
  }
};

PITCHBOARD_GUI_TEST(TestLog)

}  // namespace tst_log

#include "tst_log.moc"
