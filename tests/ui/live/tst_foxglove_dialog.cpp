// SPDX-License-Identifier: GPL-3.0-or-later
// Live's dialog of Foxglove bridges, with a real server on this computer: a source is added with
// the mouse, says how its connection is, puts its robot on the field, is remembered, and is
// removed.

#include <QComboBox>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QtTest>

#include <ui/base/in_place_message.h>
#include <ui/live/foxglove_dialog.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/live_settings.h>

#include "../../support/websocket_server.h"
#include "live_rig.h"

namespace tst_foxglove_dialog {

using namespace pitchboard;
using namespace pitchboard::ui;

class TestFoxgloveDialog : public QObject {
  Q_OBJECT

 private slots:
  void aMappingIsChosen() {
    QTemporaryDir folder;
    QSettings settings(folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat);
    LiveController live;
    live.setOptions(live_rig::options());
    FoxgloveDialog dialog(&live, &settings, nullptr);
    dialog.setAttribute(Qt::WA_DeleteOnClose, false);
    dialog.show();
    auto* address = dialog.findChild<QLineEdit*>(QStringLiteral("foxgloveAddress"));
    auto* mapping = dialog.findChild<QLineEdit*>(QStringLiteral("foxgloveMapping"));
    auto* problem = dialog.findChild<InPlaceMessage*>(QStringLiteral("foxgloveProblem"));
    auto* map = dialog.findChild<QPushButton*>(QStringLiteral("foxgloveMapTopics"));
    QStringList wanted;
    connect(&dialog, &FoxgloveDialog::mappingWanted, this,
            [&wanted](const QString& of, const QString& file) { wanted << of << file; });
    QTest::mouseClick(map, Qt::LeftButton);
    QVERIFY(problem->isVisible() && wanted.isEmpty());  // of which bridge?
    const QString file = folder.filePath(QStringLiteral("team.json"));
    address->setText(QStringLiteral("ws://robot3:8765"));
    mapping->setText(file);
    QVERIFY(!dialog.add());  // there is no such file
    QVERIFY2(problem->text().contains(QStringLiteral("team.json")), qPrintable(problem->text()));
    QFile made(file);
    QVERIFY(made.open(QIODevice::WriteOnly));
    made.write("{\"mapping\": 1}");
    made.close();
    QVERIFY(dialog.add());
    QCOMPARE(live.options().foxglove[0].mappingFile, file.toStdString());
    QTest::mouseClick(map, Qt::LeftButton);
    QCOMPARE(wanted, (QStringList{QStringLiteral("ws://robot3:8765"), file}));
    const QString other = folder.filePath(QStringLiteral("other.json"));
    QVERIFY(QFile::copy(file, other));
    dialog.setMapping(QStringLiteral("ws://robot3:8765"), other);
    QCOMPARE(live.options().foxglove[0].mappingFile, other.toStdString());
    QCOMPARE(mapping->text(), other);
  }

  void aBridgeIsAddedAndRemoved() {
    QTemporaryDir folder;
    QSettings settings(folder.filePath(QStringLiteral("s.ini")), QSettings::IniFormat);
    LiveController live;
    live.setOptions(live_rig::options());
    auto* dialog = new FoxgloveDialog(&live, &settings, nullptr);
    dialog->setAttribute(Qt::WA_DeleteOnClose, false);
    dialog->show();
    QVERIFY(QTest::qWaitForWindowExposed(dialog));
    auto* table = dialog->findChild<QTableWidget*>(QStringLiteral("foxgloveSources"));
    auto* address = dialog->findChild<QLineEdit*>(QStringLiteral("foxgloveAddress"));
    auto* problem = dialog->findChild<InPlaceMessage*>(QStringLiteral("foxgloveProblem"));
    auto* add = dialog->findChild<QPushButton*>(QStringLiteral("addFoxglove"));
    auto* remove = dialog->findChild<QPushButton*>(QStringLiteral("removeFoxglove"));
    const auto state = [table] {
      return table->item(0, 2) ? table->item(0, 2)->text() : QString();
    };

    QVERIFY(!remove->isEnabled());
    QTest::keyClicks(address, QStringLiteral("wss://robot"));
    QTest::mouseClick(add, Qt::LeftButton);
    QVERIFY(problem->isVisible() && problem->text().contains(QStringLiteral("wss")));
    QCOMPARE(table->rowCount(), 0);

    WebSocketServer server("foxglove.sdk.v1");
    address->clear();
    QTest::keyClicks(address, QString::fromStdString(server.url()));
    dialog->findChild<QSpinBox*>(QStringLiteral("foxgloveRobot"))->setValue(4);
    auto* team = dialog->findChild<QComboBox*>(QStringLiteral("foxgloveTeam"));
    team->setCurrentIndex(team->findText(QStringLiteral("red")));
    QTest::keyClick(address, Qt::Key_Return);  // Add is the default button
    QVERIFY(!problem->isVisible());
    QCOMPARE(table->rowCount(), 1);
    QCOMPARE(table->item(0, 1)->text(), QStringLiteral("robot 4, red"));
    QCOMPARE(state(), QStringLiteral("Switch to Live to connect."));

    live.start();
    QTRY_VERIFY(server.isOpen());
    server.sendText(R"({"op":"serverInfo","name":"bridge","sessionId":"a"})");
    server.sendText(
        R"({"op":"advertise","channels":[{"id":1,"topic":"/amcl_pose",)"
        R"("encoding":"json","schemaName":"geometry_msgs/msg/PoseWithCovarianceStamped"},)"
        R"({"id":2,"topic":"/odd","encoding":"xml"}]})");
    QTRY_COMPARE(server.texts.size(), 1);
    const int id = QJsonDocument::fromJson(server.texts[0])["subscriptions"][0]["id"].toInt();
    server.sendMessage(static_cast<quint32>(id), 1'700'000'000'000'000'000ULL,
                       R"({"pose":{"pose":{"position":{"x":1,"y":2,"z":0},)"
                       R"("orientation":{"x":0,"y":0,"z":0,"w":1}}}})");
    QTRY_VERIFY(state().startsWith(QStringLiteral("bridge, 1 of 2 topics")));
    QVERIFY(table->item(0, 2)->toolTip().contains(QStringLiteral("not read: /odd: ")));
    const auto isShown = [&live] {
      const FramePtr frame = live.frame();
      return frame && frame->robots.size() == 1 && frame->robots[0].name == "R4" &&
             frame->robots[0].belief;
    };
    QTRY_VERIFY(isShown());

    // It is there at the next start, and gone once it is removed.
    QCOMPARE(loadLiveSettings(settings).options.foxglove, live.options().foxglove);
    QTest::mouseClick(table->viewport(), Qt::LeftButton, {},
                      table->visualItemRect(table->item(0, 0)).center());
    QCOMPARE(address->text(), QString::fromStdString(server.url()));
    QTest::mouseClick(remove, Qt::LeftButton);
    QCOMPARE(table->rowCount(), 0);
    QVERIFY(loadLiveSettings(settings).options.foxglove.empty());
    QTRY_VERIFY(!server.isOpen());
    QTRY_VERIFY(live.frame()->robots.empty());
    delete dialog;
  }
};

PITCHBOARD_GUI_TEST(TestFoxgloveDialog)

}  // namespace tst_foxglove_dialog

#include "tst_foxglove_dialog.moc"
