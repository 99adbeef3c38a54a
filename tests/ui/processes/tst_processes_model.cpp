// SPDX-License-Identifier: GPL-3.0-or-later
// The table of processes as a model: frames made by hand, no process.
#include <QAbstractItemModelTester>
#include <QSignalSpy>
#include <QtTest>

#include <robotlink/frame/match_frame.h>

#include "processes_model.h"

namespace tst_processes_model {

using namespace pitchboard;
using namespace pitchboard::ui;

class TestProcessesModel : public QObject {
  Q_OBJECT

  static link::ProcessStatus process(int id, const char* name) {
    link::ProcessStatus status;
    status.id = id;
    status.name = name;
    status.state = link::ProcessState::Running;
    status.pid = 4000 + id;
    return status;
  }

 private slots:
  void processesAreShownEach() {
    ProcessesModel model;
    const QAbstractItemModelTester tester(&model,
                                          QAbstractItemModelTester::FailureReportingMode::QtTest);
    const std::chrono::steady_clock::time_point begin{};
    link::MatchFrame frame;
    link::RobotFrame robot;
    robot.identity = {RobotId{1}, TeamColor::Blue, 1, false};
    frame.robots.push_back(robot);
    std::vector<link::ProcessStatus> all{process(1, "decision"), process(2, "communication")};
    const auto show = [&](std::chrono::seconds later) {
      if (!frame.robots.empty()) {
        frame.robots[0].processList = std::make_shared<const std::vector<link::ProcessStatus>>(all);
      }
      model.update(frame, begin + later);
    };
    const auto text = [&model](int row, int column) {
      return model.index(row, column).data().toString();
    };
    show(std::chrono::seconds(125));
    QCOMPARE(model.rowCount(), 2);
    QCOMPARE(text(0, ProcessesModel::State), QStringLiteral("running"));
    QCOMPARE(text(0, ProcessesModel::Pid), QStringLiteral("4001"));
    QCOMPARE(text(0, ProcessesModel::Uptime), QStringLiteral("2 min 5 s"));
    QCOMPARE(text(0, ProcessesModel::Heartbeat), QString());
    // Numbers stand at the right, beneath their titles.
    for (int column = 0; column < ProcessesModel::columns; ++column) {
      const QVariant title = model.headerData(column, Qt::Horizontal, Qt::TextAlignmentRole);
      QCOMPARE(model.index(0, column).data(Qt::TextAlignmentRole), title);
      const bool number = column >= ProcessesModel::Pid && column <= ProcessesModel::Heartbeat;
      QCOMPARE(title.toInt() == int(Qt::AlignRight | Qt::AlignVCenter), number);
    }
    all[0].state = link::ProcessState::Restarting;
    all[0].pid = 0;
    all[0].detail = "exit code 2";
    all[0].restarts = 3;
    all[1].heartbeatAge = 0.2;
    all[1].cpu = 0.125;
    all[1].memoryBytes = 4'200'000;
    all[1].lastLines = {"one", "two"};
    QSignalSpy changed(&model, &QAbstractItemModel::dataChanged);
    show(std::chrono::seconds(3725));
    QCOMPARE(changed.count(), 2);
    QCOMPARE(text(0, ProcessesModel::State), QStringLiteral("restarting (exit code 2)"));
    QCOMPARE(text(0, ProcessesModel::Uptime), QString());
    QCOMPARE(text(0, ProcessesModel::Restarts), QStringLiteral("3"));
    QCOMPARE(text(1, ProcessesModel::Uptime), QStringLiteral("1 h 2 min"));
    QCOMPARE(text(1, ProcessesModel::Heartbeat), QStringLiteral("0.2 s ago"));
    QCOMPARE(text(1, ProcessesModel::Cpu), QStringLiteral("12.5 %"));
    QCOMPARE(text(1, ProcessesModel::Memory), QStringLiteral("4.2 MB"));
    QCOMPARE(text(1, ProcessesModel::LastOutput), QStringLiteral("two"));
    // A program that crashed says so while it runs again.
    all[0].state = link::ProcessState::Running;
    all[0].deaths = 3;
    all[0].lastDeath = "exit code 2";
    all[0].command = {"python3", "/home/robot/chase.py", "--key", "100"};
    show(std::chrono::seconds(3725));
    QCOMPARE(text(0, ProcessesModel::State), QStringLiteral("running, crashed 3 times"));
    QCOMPARE(model.index(0, ProcessesModel::State).data(Qt::ToolTipRole).toString(),
             QStringLiteral("Last crash: exit code 2"));
    QCOMPARE(text(0, ProcessesModel::Program), QStringLiteral("chase.py"));
    QCOMPARE(model.index(0, ProcessesModel::Program).data(Qt::ToolTipRole).toString(),
             QStringLiteral("python3 /home/robot/chase.py --key 100"));
    all.push_back(process(3, "team"));
    show(std::chrono::seconds(3726));
    QCOMPARE(model.rowCount(), 3);
    frame.robots.clear();
    show(std::chrono::seconds(3727));
    QCOMPARE(model.rowCount(), 0);
  }
};

PITCHBOARD_GUI_TEST(TestProcessesModel)

}  // namespace tst_processes_model

#include "tst_processes_model.moc"
