// SPDX-License-Identifier: GPL-3.0-or-later
// The settings of Live, the profile editor and the table of bad messages, by their widgets.

#include <QAbstractItemModelTester>
#include <QCheckBox>
#include <QComboBox>
#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTabWidget>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QtTest>

#include <sys/ipc.h>
#include <sys/shm.h>
#include <unistd.h>

#include <ui/base/theme.h>
#include <ui/live/attach_dialog.h>
#include <ui/live/live_settings_dialog.h>
#include <ui/sources/attached_boards.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_controller.h>
#include <ui/sources/shown_moment.h>

#include "bad_messages_model.h"
#include "live_rig.h"
#include "live_settings_rig.h"
#include "network_chooser.h"
#include "profile_editor.h"
#include "teams_page.h"

namespace tst_live_settings {

using namespace pitchboard;
using namespace pitchboard::ui;
using live_settings_rig::Dialog;

class TestLiveSettings : public QObject {
  Q_OBJECT
 private slots:
  void whatIsSetIsUsedAndKept() {
    Dialog d;
    d.box<QSpinBox>("portBase")->setValue(5000);
    d.box<QSpinBox>("robots")->setValue(6);
    d.box<QLineEdit>("ourTeam")->setText(QStringLiteral("12"));
    d.box<QDoubleSpinBox>("timeout")->setValue(4.5);
    d.box<QSpinBox>("cells")->setValue(3);
    d.box<QLineEdit>("senders")->setText(QStringLiteral("192.168.0.0/24, 10.0.0.7"));
    QVERIFY(d.dialog->apply());
    QCOMPARE(d.live.options().portBase, 5000);
    QCOMPARE(d.live.options().ourTeam, 12);
    const LiveSettings again = loadLiveSettings(d.settings);
    QCOMPARE(again.options.portBase, 5000);
    QCOMPARE(again.options.robots, 6);
    QCOMPARE(again.options.ourTeam, 12);
    QVERIFY(again.options.team.timeout == std::chrono::milliseconds(4500));
    QCOMPARE(again.options.team.battery.cells, 3);
    QVERIFY(again.options.team.senders.allows({0xc0a80005}));
    QVERIFY(!again.options.team.senders.allows({0x08080808}));
    QVERIFY(again.problem.isEmpty());
  }

  void theNetworkIsChosenByNameAndAddress() {
    QList<NetworkAddress> there{{"lo", "127.0.0.1"}, {"eth0", "192.168.0.12"}};
    NetworkChooser chooser(nullptr, [&there] { return there; });
    QCOMPARE(chooser.address(), QStringLiteral("0.0.0.0"));
    QCOMPARE(chooser.currentText(), QStringLiteral("every interface"));
    chooser.setAddress(QStringLiteral("192.168.0.12"));
    QCOMPARE(chooser.currentText(), QStringLiteral("eth0 — 192.168.0.12"));
    QCOMPARE(chooser.count(), 3);
    // The cable is pulled: the choice stays and says so; it comes back by itself.
    there.removeLast();
    chooser.show();
    chooser.showPopup();
    QCOMPARE(chooser.currentText(), QStringLiteral("192.168.0.12 (not on this computer now)"));
    QCOMPARE(chooser.address(), QStringLiteral("192.168.0.12"));
    chooser.hidePopup();
    there << NetworkAddress{"wlan0", "192.168.0.12"};
    chooser.showPopup();
    QCOMPARE(chooser.currentText(), QStringLiteral("wlan0 — 192.168.0.12"));
    chooser.hidePopup();
    // By hand.
    chooser.lineEdit()->selectAll();
    QTest::keyClicks(chooser.lineEdit(), QStringLiteral("10.0.0.7"));
    QCOMPARE(chooser.address(), QStringLiteral("10.0.0.7"));
    chooser.setEditText(QStringLiteral("no address"));
    chooser.showPopup();
    QCOMPARE(chooser.address(), QStringLiteral("no address"));
    chooser.hidePopup();
  }

  void aPageWithoutHoles() {
    Dialog d;
    QVERIFY(QTest::qWaitForWindowExposed(d.dialog));
    auto* tabs = d.box<QTabWidget>("liveTabs");
    QCOMPARE(tabs->count(), 2);
    QTRY_VERIFY(tabs->widget(0)->height() > 200);
    int lowest = 0;
    const auto groups = tabs->widget(0)->findChildren<QGroupBox*>();
    QCOMPARE(groups.size(), 4);
    for (const QGroupBox* group : groups) lowest = std::max(lowest, group->geometry().bottom());
    // Nor is a sentence cut.
    for (const auto* label : tabs->widget(0)->findChildren<QLabel*>()) {
      if (!label->wordWrap()) continue;
      QVERIFY2(label->height() >= label->heightForWidth(label->width()), qPrintable(label->text()));
    }
    const int page = tabs->widget(0)->height();
    QVERIFY2(page - lowest < scaled(nullptr, 60),
             qPrintable(QStringLiteral("%1 of %2").arg(lowest).arg(page)));
  }

  void theInterfacesOfThisComputerAreOffered() {
    Dialog d;
    auto* bind = d.box<QComboBox>("bind");
    const int own = bind->findData(QStringLiteral("127.0.0.1"));
    QVERIFY(own > 0);
    QVERIFY(bind->itemText(own).endsWith(QStringLiteral(" — 127.0.0.1")));
    bind->setCurrentIndex(own);
    QVERIFY(d.dialog->apply());
    QCOMPARE(d.live.options().bind.text(), std::string("127.0.0.1"));
    QCOMPARE(loadLiveSettings(d.settings).options.bind.text(), std::string("127.0.0.1"));
    // A saved address of a network that is not there now (one of those for documentation).
    d.box<QComboBox>("bind")->setEditText(QStringLiteral("192.0.2.77"));
    QVERIFY(d.dialog->apply());
    LiveSettingsDialog again(&d.live, &d.settings, nullptr);
    QCOMPARE(again.findChild<QComboBox*>(QStringLiteral("bind"))->currentText(),
             QStringLiteral("192.0.2.77 (not on this computer now)"));
    QVERIFY(again.apply());
    QCOMPARE(d.live.options().bind.text(), std::string("192.0.2.77"));
  }

  void mistakesAreReportedInTheDialog_data() {
    QTest::addColumn<QString>("box");
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("reported");
    QTest::newRow("address") << "bind"
                             << "localhost"
                             << "Listen on";
    QTest::newRow("sender") << "senders"
                            << "1.2.3.4/77"
                            << "Accept robots from";
    QTest::newRow("referee's") << "refereeSenders"
                               << "1.2.3.4/77"
                               << "Accept referee from";
    QTest::newRow("ports") << "portBase"
                           << "65530"
                           << "port";
    QTest::newRow("collision") << "refereePort"
                               << "1245"
                               << "robots'";
  }
  void mistakesAreReportedInTheDialog() {
    QFETCH(QString, box);
    QFETCH(QString, text);
    QFETCH(QString, reported);
    Dialog d;
    auto* widget = d.dialog->findChild<QWidget*>(box);
    if (auto* edit = qobject_cast<QLineEdit*>(widget))
      edit->setText(text);
    else if (auto* choice = qobject_cast<QComboBox*>(widget))
      choice->setEditText(text);
    else
      qobject_cast<QSpinBox*>(widget)->setValue(text.toInt());
    QVERIFY(!d.dialog->apply());
    QVERIFY2(d.problem().contains(reported), qPrintable(d.problem()));
    QCOMPARE(d.live.options().portBase, 1240);
    QVERIFY(d.settings.allKeys().isEmpty());
  }

  void monitorModeNeedsAnAddressAndIsOffAtFirst() {
    Dialog d;
    QVERIFY(!d.box<QCheckBox>("monitor")->isChecked());
    d.box<QCheckBox>("monitor")->setChecked(true);
    QVERIFY(!d.dialog->apply());
    QVERIFY(d.problem().startsWith(QStringLiteral("Referee at")));
    d.box<QLineEdit>("monitorAddress")->setText(QStringLiteral("127.0.0.1"));
    QVERIFY(d.dialog->apply());
    QVERIFY(d.live.options().monitor);
    QVERIFY(!loadLiveSettings(d.settings).options.monitor);
  }

  void garbageInTheSettingsGivesDefaults() {
    QTemporaryDir folder;
    QSettings settings(folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat);
    settings.setValue(QStringLiteral("live/portBase"), QStringLiteral("many"));
    settings.setValue(QStringLiteral("live/robots"), 100000);
    settings.setValue(QStringLiteral("live/bind"), QStringLiteral("nowhere"));
    settings.setValue(QStringLiteral("live/timeout"), QStringLiteral("nan"));
    settings.setValue(QStringLiteral("live/profileFile"), QStringLiteral("/does/not/exist.json"));
    const LiveSettings live = loadLiveSettings(settings);
    QVERIFY(link::validate(live.options));
    QVERIFY(!live.problem.isEmpty());
    QCOMPARE(live.options.portBase, 1240);
  }

  void aBlackboardOfThisComputerIsAttached() {
    const int key = 0x5100'0000 + static_cast<int>(getpid() % 100'000) * 64;
    const int segment = shmget(key, 2048, IPC_CREAT | IPC_EXCL | 0600);
    QVERIFY(segment >= 0);
    const auto remove = qScopeGuard([segment] { shmctl(segment, IPC_RMID, nullptr); });
    QTemporaryDir folder;
    QSettings settings(folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat);
    LiveController live;
    live.setOptions(live_rig::options());
    live.start();
    MatchController match{link::MatchOptions()};
    ShownMoment source(&match);
    AttachedBoards boards(&match, &live, &source, &settings);
    AttachDialog dialog(&boards, nullptr);
    dialog.setAttribute(Qt::WA_DeleteOnClose, false);
    dialog.show();
    auto* segments = dialog.findChild<QTableWidget*>(QStringLiteral("segments"));
    const auto found = segments->findItems(QString::number(key), Qt::MatchExactly);
    QCOMPARE(found.size(), 1);
    QCOMPARE(segments->item(found[0]->row(), 1)->text(), QStringLiteral("2048 bytes"));
    // The form says from the start what the list has.
    const int first = segments->currentRow();
    QVERIFY(first >= 0);
    QCOMPARE(dialog.findChild<QSpinBox*>(QStringLiteral("attachKey"))->value(),
             segments->item(first, 0)->text().toInt());
    QVERIFY(!segments->item(found[0]->row(), 2)->text().isEmpty());
    segments->selectRow(found[0]->row());
    QCOMPARE(dialog.findChild<QSpinBox*>(QStringLiteral("attachKey"))->value(), key);
    dialog.findChild<QSpinBox*>(QStringLiteral("attachRobot"))->setValue(4);
    dialog.findChild<QComboBox*>(QStringLiteral("attachTeam"))->setCurrentText("red");
    QTest::mouseClick(dialog.findChild<QPushButton*>(QStringLiteral("attach")), Qt::LeftButton);
    QCOMPARE(live.options().boards.size(), std::size_t(1));
    auto* attached = dialog.findChild<QTableWidget*>(QStringLiteral("attachedBoards"));
    QCOMPARE(attached->item(0, 0)->text(), QStringLiteral("R4"));
    QTRY_COMPARE(attached->item(0, 3)->text(), QStringLiteral("attached"));
    const auto isShown = [&live] {
      return live.frame() && live.frame()->robots.size() == 1 &&
             live.frame()->robots[0].identity.name() == "R4";
    };
    QTRY_VERIFY(isShown());
    const LiveSettings again = loadLiveSettings(settings);
    QVERIFY2(again.problem.isEmpty(), qPrintable(again.problem));
    QVERIFY(again.options.boards == live.options().boards);
    attached->selectRow(0);
    QTest::mouseClick(dialog.findChild<QPushButton*>(QStringLiteral("detach")), Qt::LeftButton);
    QVERIFY(live.options().boards.empty());
    QVERIFY(loadLiveSettings(settings).options.boards.empty());
    // One that is not there is said, and waited for.
    dialog.findChild<QSpinBox*>(QStringLiteral("attachKey"))->setValue(key + 1);
    QVERIFY(!dialog.attach());
    QVERIFY(!dialog.findChild<QLabel*>(QStringLiteral("attachMessage"))->text().isEmpty());
    QCOMPARE(live.options().boards.size(), std::size_t(1));
  }

  void theRowsOfARobotWakeTheCurves() {
    LiveController live;
    live.setOptions(live_rig::options());
    QSignalSpy appended(&live, &FrameSource::rowsAppended);
    live.start();
    const live_rig::Robot robot(live.options(), 1);
    QTRY_VERIFY(robot.sendMessage(live_rig::message(1)) && !appended.isEmpty());
    const qsizetype before = appended.size();
    QTRY_VERIFY(robot.sendMessage(live_rig::message(1)) && appended.size() > before);
  }

  void badMessagesAreListedByKindRobotAndSender() {
    telemetry::TeamMonitor monitor;
    const telemetry::WallTime now{std::chrono::seconds(1'700'000'000)};
    const telemetry::Sender sender{{0x7f000001}, 4000};
    monitor.take(
        {now, sender, 1241, false, "1 258 448 -8 56.3 184.6 41.0 1 1 1 1 1 8 0.05 189 OUT"});
    monitor.take({now, sender, 1241, false, "1 2 3 OUT"});
    link::LiveDetails details;
    details.team = monitor.status(now);
    details.unknownReferee = 2;
    details.unknownRefereeReason = "not a referee's packet";
    BadMessagesModel model;
    const QAbstractItemModelTester tester(&model);
    model.update({});
    QCOMPARE(model.rowCount(), 0);
    model.update(details);
    QCOMPARE(model.rowCount(), 4);  // everybody, robot 1, its sender, the referee's port
    QCOMPARE(model.index(0, BadMessagesModel::Sample).data().toString(),
             QStringLiteral("1 2 3 OUT"));
    QVERIFY(model.index(1, BadMessagesModel::Who)
                .data()
                .toString()
                .startsWith(QStringLiteral("robot 1")));
    // What is refused is shown.
    details.team.refusedByFilter = 5;
    details.refusedReferees = 6;
    details.rows = {7, 8};
    model.update(details);
    QCOMPARE(model.rowCount(), 8);
    for (int row = 4; row < 8; ++row) {
      QCOMPARE(model.index(row, BadMessagesModel::Count).data().toString(),
               QString::number(row + 1));
    }
    details.team.refusedByFilter = details.refusedReferees = 0;
    details.rows = {};
    model.update(details);
    details.unknownReferee = 3;
    QSignalSpy changed(&model, &QAbstractItemModel::dataChanged);
    model.update(details);
    QCOMPARE(changed.size(), 1);
    QCOMPARE(model.index(3, BadMessagesModel::Count).data().toString(), QStringLiteral("3"));
  }
};

PITCHBOARD_GUI_TEST(TestLiveSettings)

}  // namespace tst_live_settings

#include "tst_live_settings.moc"
