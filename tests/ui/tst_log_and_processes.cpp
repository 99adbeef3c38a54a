// SPDX-License-Identifier: GPL-3.0-or-later
#include <QAbstractItemModelTester>
#include <QtTest>

#include <ui/base/words_filter.h>

#include "log_model.h"
#include "processes_model.h"

using namespace pitchboard;
using namespace pitchboard::ui;
using Mode = QAbstractItemModelTester::FailureReportingMode;

class TestLogAndProcesses : public QObject {
  Q_OBJECT

  static std::vector<LogLine> lines(int count, int first = 0) {
    std::vector<LogLine> made;
    for (int i = 0; i < count; ++i) {
      made.push_back({double(i), "B1 decision", "line " + std::to_string(first + i)});
    }
    return made;
  }
  static link::ChildStatus child(int handle, int robot, const char* name) {
    link::ChildStatus status;
    status.handle = handle;
    status.spec.robot = RobotId{robot};
    status.spec.name = name;
    return status;
  }

 private slots:
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

  void theFilterWantsEveryWord() {
    LogModel model;
    WordsFilter filter;
    filter.setSourceModel(&model);
    const QAbstractItemModelTester tester(&filter, Mode::QtTest);
    model.append({{0, "B1 decision", "kicks"}, {1, "R1 decision", "kicks"}});
    filter.setWords(QStringLiteral("KICK b1"));
    QCOMPARE(filter.rowCount(), 1);
    filter.setWords(QStringLiteral("nothing"));
    QCOMPARE(filter.rowCount(), 0);
    filter.setWords(QString());
    QCOMPARE(filter.rowCount(), 2);
  }

  void eventsInWords() {
    sim::Event event;
    event.kind = sim::EventKind::UnknownAction;
    event.tick = 120;
    event.value = 42;
    const LogLine line = eventLine(event, QStringLiteral("R3"), 60);
    QCOMPARE(line.time, 2.0);
    QVERIFY(line.isWarning());
    QVERIFY(QString::fromStdString(line.text).contains(QStringLiteral("42")));
  }

  void processesShowTheNewestOfEachName() {
    ProcessesModel model;
    const QAbstractItemModelTester tester(&model, Mode::QtTest);
    link::MatchFrame frame;
    link::RobotFrame robot;
    robot.identity = {RobotId{1}, TeamColor::Blue, 1, false};
    frame.robots.push_back(robot);
    std::vector<link::ChildStatus> children{child(1, 1, "decision"), child(2, 1, "communication")};
    const auto show = [&] {
      if (!frame.robots.empty()) {
        frame.robots[0].processList =
            std::make_shared<const std::vector<link::ChildStatus>>(children);
      }
      model.update(frame);
    };
    show();
    QCOMPARE(model.rowCount(), 2);
    children[0].state = link::ChildState::Failed;
    children[0].detail = "exit code 2";
    QSignalSpy changed(&model, &QAbstractItemModel::dataChanged);
    show();
    QCOMPARE(changed.count(), 1);
    QCOMPARE(model.index(0, ProcessesModel::State).data().toString(),
             QStringLiteral("failed (exit code 2)"));
    children.push_back(child(4, 1, "decision"));
    show();
    QCOMPARE(model.rowCount(), 2);
    QCOMPARE(model.index(0, ProcessesModel::State).data().toString(), QStringLiteral("running"));
    frame.robots.clear();
    show();
    QCOMPARE(model.rowCount(), 0);
  }
};

QTEST_MAIN(TestLogAndProcesses)
#include "tst_log_and_processes.moc"
