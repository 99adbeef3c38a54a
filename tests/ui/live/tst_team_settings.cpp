// SPDX-License-Identifier: GPL-3.0-or-later
// Teams and message profiles in the settings of Live: edited, tried on what arrives, kept.

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QRegularExpression>
#include <QSpinBox>
#include <QTabWidget>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <QtTest>

#include <sys/ipc.h>
#include <sys/shm.h>

#include <ui/live/attach_dialog.h>
#include <ui/live/live_settings_dialog.h>
#include <ui/sources/live_controller.h>

#include "bad_messages_model.h"
#include "live_rig.h"
#include "live_settings_rig.h"
#include "profile_editor.h"
#include "teams_page.h"

namespace tst_team_settings {

using namespace pitchboard;
using namespace pitchboard::ui;
using live_settings_rig::Dialog;

class TestTeamSettings : public QObject {
  Q_OBJECT
 private slots:
  void teamsAreEditedUsedAndKept() {
    Dialog d;
    QVERIFY(!d.box<QLineEdit>("teamName")->isEnabled());
    // An empty list says what it is for.
    const auto* hint = d.box<QLabel>("noTeams");
    QVERIFY(!hint->isHidden() && hint->text().contains(QStringLiteral("Add a team")));
    const auto click = [&d](const char* name) {
      d.box<QToolButton>(name)->click();  // its page may lie behind another one
    };
    click("addTeam");
    d.type("teamName", "Guests");
    d.box<QSpinBox>("teamNumber")->setValue(18);
    d.box<QComboBox>("teamColour")->setCurrentText(QStringLiteral("red"));
    d.box<QSpinBox>("teamFirstPort")->setValue(12321);
    d.box<QSpinBox>("teamLastPort")->setValue(12325);
    d.type("teamSenders", "192.168.18.0/24");
    d.choose("teamProfile", "mitecom");
    d.box<QComboBox>("teamAttacks")->setCurrentIndex(1);
    d.type("teamRobots", "1 Ana, 3 Bo Li");
    click("addTeam");
    auto* list = d.box<QListWidget>("teams");
    QCOMPARE(list->count(), 2);
    QVERIFY(hint->isHidden());
    QCOMPARE(list->item(0)->text(), QStringLiteral("Guests"));
    QCOMPARE(d.box<QLineEdit>("teamName")->text(), QString());
    QVERIFY2(d.dialog->apply(), qPrintable(d.problem()));

    const auto expected = telemetry::parseTeamSetup(
        R"({"name": "Guests", "number": 18, "colour": "red", "ports": [12321, 12325],
            "senders": ["192.168.18.0/24"], "profile": "mitecom", "attacks": "left",
            "robots": {"1": "Ana", "3": "Bo Li"}})",
        "expected");
    QVERIFY(expected);
    const LiveSettings again = loadLiveSettings(d.settings);
    QVERIFY2(again.problem.isEmpty(), qPrintable(again.problem));
    for (const auto& teams : {d.live.options().team.teams, again.options.team.teams}) {
      QCOMPARE(teams.size(), std::size_t(2));
      QVERIFY(teams[0] == *expected);
      QVERIFY(teams[1] == telemetry::TeamSetup());
    }
    // As a file, and back.
    const QString path = d.folder.filePath(QStringLiteral("guests.json"));
    auto* page = d.dialog->findChild<TeamsPage*>();
    list->setCurrentRow(0);
    QVERIFY(page->save(path));
    QVERIFY(telemetry::loadTeamSetup(path.toStdString()) == *expected);
    click("removeTeam");
    QCOMPARE(list->count(), 1);
    QVERIFY(page->load(path));
    QCOMPARE(list->currentRow(), 1);
    QCOMPARE(d.box<QSpinBox>("teamNumber")->value(), 18);
    QCOMPARE(d.box<QLineEdit>("teamRobots")->text(), QStringLiteral("1 Ana, 3 Bo Li"));
    QVERIFY(!page->load(QStringLiteral("/nonexistent.json")));
  }

  void mistakesInTeamsAreReported() {
    Dialog d;
    d.box<QToolButton>("addTeam")->click();
    const std::tuple<const char*, const char*, const char*> mistakes[] = {
        {"teamSenders", "home", "home"},
        {"teamRobots", "Ana", "numbers and names"},
        {"teamRobots", "0 Ana", "numbers and names"}};
    for (const auto& [box, typed, reported] : mistakes) {
      const QString before = d.box<QLineEdit>(box)->text();
      d.type(box, typed);
      QVERIFY(d.box<QLabel>("teamMessage")->text().contains(QLatin1String(reported)));
      QVERIFY(!d.dialog->apply());
      QVERIFY2(d.problem().contains(QLatin1String(reported)), qPrintable(d.problem()));
      d.type(box, "");
    }
    d.box<QSpinBox>("teamFirstPort")->setValue(5000);
    d.box<QSpinBox>("teamLastPort")->setValue(4000);
    QVERIFY(!d.dialog->apply());
    d.box<QSpinBox>("teamLastPort")->setValue(5100);
    QVERIFY(!d.dialog->apply());
    QVERIFY2(d.problem().contains(QStringLiteral("64")), qPrintable(d.problem()));
    QVERIFY(d.live.options().team.teams.empty());
  }

  /// Before a setup is put to use it is seen what it makes of what arrives.
  void whatArrivesIsShownAsTheTeamsWouldReadIt() {
    Dialog d;
    link::LiveOptions options = live_rig::options();
    d.live.setOptions(options);
    d.live.start();
    QTRY_VERIFY(d.live.details().network.ports.size() > 16);
    d.box<QTabWidget>("liveTabs")->setCurrentWidget(d.dialog->findChild<TeamsPage*>());
    auto* table = d.box<QTableWidget>("teamPreview");
    const auto cell = [table](int row, int column) {
      const QTableWidgetItem* item = table->item(row, column);
      return item == nullptr ? QString() : item->text();
    };
    const live_rig::Robot robot(options, 3);
    // Without a setup: as Live reads it. (Sent again until the page looks.)
    const auto isRead = [&] {
      return robot.sendMessage() && cell(0, 4).contains(QStringLiteral("X 270"));
    };
    QTRY_VERIFY(isRead());
    QCOMPARE(cell(0, 3), QStringLiteral("Robot 3"));
    QCOMPARE(cell(0, 0), QStringLiteral("127.0.0.1"));
    QCOMPARE(cell(0, 1), QString::number(options.portBase + 3));
    // Of another format: why it cannot be read, and what it could be.
    d.box<QToolButton>("addTeam")->click();
    d.type("teamName", "Ours");
    d.choose("teamProfile", "upenn");
    static const QRegularExpression known(QStringLiteral("could be (\\S+ or )*published"));
    QTRY_VERIFY2(cell(0, 4).contains(known), qPrintable(cell(0, 4)));
    QCOMPARE(cell(0, 3), QStringLiteral("–"));
    d.choose("teamProfile", "published");
    d.box<QComboBox>("teamColour")->setCurrentText(QStringLiteral("red"));
    d.type("teamRobots", "3 Ana");
    QTRY_COMPARE(cell(0, 3), QStringLiteral("R3 Ana (Ours)"));
    // Live does not listen to this port yet.
    const int port = options.portBase + 19;
    d.box<QSpinBox>("teamFirstPort")->setValue(port);
    const TestSocket other;
    const std::string message = telemetry::encode(live_rig::message(5));
    const auto arrives = [&] {
      return other.send(static_cast<std::uint16_t>(port), message) && table->rowCount() == 2 &&
             cell(1, 3) == QStringLiteral("R5 (Ours)");
    };
    QTRY_VERIFY(arrives());
    QVERIFY(cell(0, 4).contains(QStringLiteral("no team has this sender and port")));
    QVERIFY(d.live.options().team.teams.empty());
  }

  void theEditorAddsMovesRemovesAndSaves() {
    QTemporaryDir folder;
    ProfileEditor editor(telemetry::publishedProfile(), {}, nullptr);
    editor.setAttribute(Qt::WA_DeleteOnClose, false);
    editor.show();
    auto* table = editor.findChild<QTableWidget*>();
    auto* problem = editor.findChild<QLabel*>(QStringLiteral("profileProblem"));
    const auto click = [&editor](const char* name) {
      QTest::mouseClick(editor.findChild<QToolButton*>(QLatin1String(name)), Qt::LeftButton);
    };
    QCOMPARE(editor.profile(), telemetry::publishedProfile());
    table->setCurrentCell(14, 0);
    click("addField");
    QCOMPARE(table->rowCount(), 16);
    table->item(15, 0)->setText(QStringLiteral("TEMPERATURE"));
    QVERIFY(editor.saveTo(folder.filePath(QStringLiteral("p.json"))));
    const auto loaded =
        telemetry::loadProfile(folder.filePath(QStringLiteral("p.json")).toStdString());
    QVERIFY(loaded);
    QCOMPARE(loaded->fields.back().name, std::string("TEMPERATURE"));
    QCOMPARE(*loaded, editor.profile());
    // Numbers, words of codes, and the frame of poses.
    enum { Scale = 3, Offset = 4, Labels = 7 };
    table->item(15, Scale)->setText(QStringLiteral("0.1"));
    table->item(15, Offset)->setText(QStringLiteral("-40"));
    table->item(15, Labels)->setText(QStringLiteral("0 = cold, 1=hot"));
    editor.findChild<QComboBox*>(QStringLiteral("frameOrigin"))->setCurrentIndex(1);
    const telemetry::Profile edited = editor.profile();
    QCOMPARE(edited.fields.back().scale, 0.1);
    QCOMPARE(edited.fields.back().offset, -40.0);
    QCOMPARE(edited.fields.back().labels,
             (std::map<std::int32_t, std::string>{{0, "cold"}, {1, "hot"}}));
    QVERIFY(edited.frame.centre);
    table->item(15, Labels)->setText(QStringLiteral("cold"));
    QVERIFY2(problem->text().contains(QStringLiteral("0 = stop")), qPrintable(problem->text()));
    QVERIFY(!editor.saveTo(folder.filePath(QStringLiteral("q.json"))));
    table->item(15, Labels)->setText({});
    table->item(15, Scale)->setText(QStringLiteral("1"));
    table->item(15, Offset)->setText(QStringLiteral("0"));
    editor.findChild<QComboBox*>(QStringLiteral("frameOrigin"))->setCurrentIndex(0);
    QCOMPARE(editor.profile(), *loaded);
    click("fieldUp");
    QCOMPARE(editor.profile().fields[14].name, std::string("TEMPERATURE"));
    click("fieldDown");
    QCOMPARE(*loaded, editor.profile());
    // Two fields of one name: said under the table, and not saved.
    table->item(15, 0)->setText(QStringLiteral("X"));
    QVERIFY(!problem->text().isEmpty());
    QVERIFY(!editor.findChild<QPushButton*>(QStringLiteral("saveProfile"))->isEnabled());
    QVERIFY(!editor.saveTo(folder.filePath(QStringLiteral("q.json"))));
    QVERIFY(!QFile::exists(folder.filePath(QStringLiteral("q.json"))));
    table->selectRow(15);
    click("removeField");
    QCOMPARE(editor.profile(), telemetry::publishedProfile());
    QVERIFY(!editor.saveTo(QStringLiteral("/nonexistent/folder/p.json")));
    QVERIFY(problem->text().contains(QStringLiteral("Could not write")));
  }

  void theEditorKeepsWhatItDoesNotShow() {
    QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("p.json"));
    for (const std::string& name : telemetry::builtInProfiles()) {
      const auto opened = telemetry::loadProfile(name);
      QVERIFY2(opened, name.c_str());
      ProfileEditor editor(*opened, {}, nullptr);
      editor.setAttribute(Qt::WA_DeleteOnClose, false);
      QCOMPARE(editor.profile(), *opened);
      editor.findChild<QTableWidget*>()->setCurrentCell(0, 0);
      QTest::mouseClick(editor.findChild<QToolButton*>(QStringLiteral("fieldDown")),
                        Qt::LeftButton);
      QTest::mouseClick(editor.findChild<QToolButton*>(QStringLiteral("fieldUp")), Qt::LeftButton);
      QVERIFY2(editor.saveTo(path), name.c_str());
      const auto saved = telemetry::loadProfile(path.toStdString());
      QVERIFY2(saved && *saved == *opened, name.c_str());
    }
  }

  void aSavedProfileIsUsedByTheDialog() {
    Dialog d;
    QTest::mouseClick(d.box<QPushButton>("editProfile"), Qt::LeftButton);
    auto* editor = d.dialog->findChild<ProfileEditor*>();
    QVERIFY(editor);
    editor->findChild<QTableWidget*>()->item(14, 0)->setText(QStringLiteral("BATTERY"));
    const QString path = d.folder.filePath(QStringLiteral("team.json"));
    QVERIFY(editor->saveTo(path));
    QVERIFY(d.dialog->apply());
    QCOMPARE(d.live.options().profile.fields[14].name, std::string("BATTERY"));
    QCOMPARE(QString::fromStdString(loadLiveSettings(d.settings).options.profileFile), path);
  }
};

PITCHBOARD_GUI_TEST(TestTeamSettings)

}  // namespace tst_team_settings

#include "tst_team_settings.moc"
