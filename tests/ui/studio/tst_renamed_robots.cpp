// SPDX-License-Identifier: GPL-3.0-or-later
// Robots of Live get another name when it becomes known whose they are, and every robot has one
// name in every place.

#include <QDockWidget>
#include <QJsonDocument>
#include <QJsonObject>
#include <QMenu>
#include <QProcess>
#include <QRegularExpression>
#include <QtTest>
#include <algorithm>
#include <csignal>
#include <set>

#include <robotlink/live/live_teams.h>
#include <telemetry/series/series_store.h>
#include <telemetry/session/session_reader.h>
#include <ui/field/field_view.h>
#include <ui/plots/plots_dock.h>
#include <ui/robots/robot_card.h>
#include <ui/robots/robots_dock.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/robot_selection.h>
#include <ui/sources/shown_moment.h>
#include <ui/window/main_window.h>

#include "../support/robot_keys.h"
#include "hover_text.h"
#include "legend_bar.h"
#include "live_rig.h"
#include "live_studio.h"
#include "log_model.h"
#include "plot_page.h"
#include "plot_pane.h"
#include "plot_presets.h"
#include "variables_model.h"

namespace tst_renamed_robots {

using namespace pitchboard;
using namespace pitchboard::ui;
using live_rig::Robot;
using Names = std::set<QString>;

namespace {

const QString cli = QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli");

struct Studio : live_studio::Studio {
  PlotsDock* plots() { return window.findChild<PlotsDock*>(); }
  VariablesModel* tree() { return window.findChild<VariablesModel*>(); }

  void plot(const QList<CurveSpec>& curves) {
    PaneSpec chart;
    chart.curves = curves;
    plots()->setLayoutSpec({{PageSpec{QStringLiteral("one"), {chart}}}, 0});
  }
  QList<LegendEntry> legend() {
    const auto panes = plots()->currentPage()->panes();
    return panes.isEmpty() ? QList<LegendEntry>() : panes[0]->legend()->entries();
  }
  /// What the legend calls its curves; empty while one of them has no data.
  QStringList curves() {
    QStringList names;
    for (const LegendEntry& entry : legend()) {
      if (entry.muted || entry.faulty) return {};
      names << entry.text.section(QStringLiteral(" ["), 0, 0);  // without the unit
    }
    return names;
  }
  Names robotsInTree() {
    Names names;
    for (int row = 0; row < tree()->rowCount(); ++row) {
      const auto group = tree()->groupOf(tree()->index(row, 0));
      if (factsOf(group->info()).number > 0) {
        names.insert(QString::fromStdString(group->info().name));
      }
    }
    return names;
  }
  Names namesOnCards() {
    Names names;
    for (const RobotCard* card : cards()) names.insert(card->state().name);
    return names;
  }
  /// Returns the name that the field's tooltip of each robot begins with.
  Names namesOnField() {
    Names names;
    for (const link::RobotFrame& robot : live()->frame()->robots) {
      const QString head = hoverText(*live()->frame(), robot.uid).section(QLatin1Char('\n'), 0, 0);
      names.insert(head.section(QLatin1Char(' '), 0, robot.ownName.empty() ? -1 : 0));
    }
    return names;
  }
  Names namesInLog() {
    Names names;
    const auto* log = window.findChild<LogModel*>();
    for (int row = 0; row < log->rowCount(); ++row) {
      const QString origin = log->index(row, LogModel::Origin).data().toString();
      if (origin != QStringLiteral("network") && origin != QStringLiteral("referee")) {
        names.insert(origin);
      }
    }
    return names;
  }
  std::optional<telemetry::TimeRange> rowsOf(const char* group) {
    const auto id = live()->series()->findGroup(group);
    return id ? live()->series()->view(*id)->range() : std::nullopt;
  }
};

CurveSpec expression(const char* text) {
  CurveSpec curve;
  curve.kind = CurveKind::Expression;
  curve.expression = QString::fromUtf8(text);
  return curve;
}

telemetry::TextMessage moved(int robot, int step) {
  telemetry::TextMessage message = live_rig::message(robot);
  message.x += step;
  return message;
}

}  // namespace

class TestRenamedRobots : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

  QString write(const char* name, const QByteArray& text) {
    QFile file(m_folder.filePath(QLatin1String(name)));
    if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size()) return {};
    return file.fileName();
  }

 private slots:
  void initTestCase() { setTheme(*qApp, ThemeChoice::Dark); }

  void aTeamSetupAppliedInMidMatchCarriesOn() {
    Studio s;
    s.goLive();
    const Robot robot(s.options, 3);
    QVERIFY(robot.sendMessage());
    QTRY_COMPARE(s.cards().size(), qsizetype(1));
    s.plot({variableCurve(QStringLiteral("Robot 3/LOCALIZATION_X")),
            expression("{Robot 3/LOCALIZATION_X} / 100")});
    PlotPresets(&s.settings).save(QStringLiteral("mine"), s.plots()->layoutSpec());
    QTRY_COMPARE(s.curves().value(0), QStringLiteral("LOCALIZATION_X Robot 3"));
    QCOMPARE(s.curves().value(1), QStringLiteral("{Robot 3/LOCALIZATION_X} / 100"));
    QTRY_VERIFY(s.tree()->find(QStringLiteral("Robot 3/LOCALIZATION_X")).isValid());
    s.tree()->setFavourites({QStringLiteral("Robot 3/LOCALIZATION_X")});
    auto* selection = s.window.findChild<RobotSelection*>();
    const RobotUid uid = s.live()->frame()->robots.at(0).uid;
    selection->set({uid});
    selection->follow(uid);
    auto* dock = s.window.findChild<RobotsDock*>();
    dock->floatCard(uid);
    const QDockWidget* floating = dock->floating(uid);
    QVERIFY(floating);
    auto* statistics = s.window.findChild<QMenu*>(QStringLiteral("statisticsRobotsMenu"));
    const auto ticked = [statistics] {
      QStringList names;
      emit statistics->aboutToShow();
      for (const QAction* action : statistics->actions()) {
        if (action->isChecked()) names << action->text();
      }
      return names;
    };
    QCOMPARE(ticked(), QStringList{QStringLiteral("All robots")});
    // Its losses may be listed, too, by now.
    const auto entries = statistics->actions();
    const auto entry = std::ranges::find(entries, QStringLiteral("Robot 3"), &QAction::text);
    QVERIFY(entry != entries.end());
    (*entry)->trigger();
    QCOMPARE(ticked(), QStringList{QStringLiteral("Robot 3")});
    const auto group = s.live()->series()->findGroup("Robot 3");
    const double began = s.rowsOf("Robot 3")->begin;

    s.change([](link::LiveOptions& o) {
      telemetry::TeamSetup ours;
      ours.name = "RoboFEI";
      ours.number = 12;
      ours.colour = "red";
      ours.firstPort = o.portBase + 1;
      ours.lastPort = o.portBase + 16;
      o.team.teams = {ours};
    });
    int step = 0;
    const auto goesOn = [&] {
      return robot.sendMessage(moved(3, ++step)) && s.rowsOf("R3") &&
             s.rowsOf("R3")->end > began + 0.5;
    };
    QTRY_VERIFY(goesOn());
    // One robot, under its new name, with all that it had.
    QVERIFY(s.live()->series()->findGroup("R3") == group);
    QVERIFY(s.live()->series()->findGroup("Robot 3") == group);  // by its former name
    QCOMPARE(s.rowsOf("R3")->begin, began);
    QTRY_COMPARE(s.robotsInTree(), Names{QStringLiteral("R3")});
    QTRY_COMPARE(s.robots(), std::size_t(1));
    QCOMPARE(s.namesOnField(), Names{QStringLiteral("R3")});
    QVERIFY(dock->floating(uid) == floating && s.cards().isEmpty());
    QCOMPARE(selection->ids(), std::vector{uid});
    QCOMPARE(selection->followed(), std::optional(uid));
    QCOMPARE(ticked(), QStringList{QStringLiteral("R3")});
    const QModelIndex row = s.tree()->find(QStringLiteral("R3/LOCALIZATION_X"));
    QVERIFY(row.data(VariablesModel::FavouriteRole).toBool());
    const QStringList present{QStringLiteral("LOCALIZATION_X R3"),
                              QStringLiteral("R3.LOCALIZATION_X / 100")};
    QTRY_COMPARE(s.curves(), present);
    const auto& curve = s.plots()->currentPage()->panes()[0]->curves()[1];
    QTRY_VERIFY(curve.view() && curve.view().group->range() &&
                curve.view().group->range()->begin == began);
    // What was typed means the same robot: another one may have its former name soon. What was
    // saved before is drawn, too.
    QCOMPARE(s.plots()->layoutSpec().pages[0].panes[0].curves[1].expression,
             QStringLiteral("R3.LOCALIZATION_X / 100"));
    s.plot({});
    s.plots()->setLayoutSpec(*PlotPresets(&s.settings).load(QStringLiteral("mine")));
    QTRY_COMPARE(s.curves(), present);
  }

  void aRefereeWhoRevealsTheColoursRenamesEverything() {
    Studio s;
    s.change([](link::LiveOptions& o) {
      o.ourTeam = 1;
      o.team.timeout = std::chrono::milliseconds(500);
    });
    s.goLive();
    const Robot one(s.options, 1), three(s.options, 3);
    QVERIFY(one.sendMessage() && three.sendMessage());
    QTRY_COMPARE(s.namesOnCards(), (Names{QStringLiteral("Robot 1"), QStringLiteral("Robot 3")}));
    const QList<RobotCard*> cards = s.cards();
    s.plot({variableCurve(QStringLiteral("Robot 3/LOCALIZATION_X")),
            variableCurve(QStringLiteral("each/LOCALIZATION_Y"))});
    QTRY_COMPARE(s.curves(), (QStringList{QStringLiteral("LOCALIZATION_X Robot 3"),
                                          QStringLiteral("LOCALIZATION_Y Robot 1"),
                                          QStringLiteral("LOCALIZATION_Y Robot 3")}));
    // Both fall silent; who comes back has another name.
    QTRY_VERIFY(s.namesInLog().contains(QStringLiteral("Robot 3")));

    const TestSocket referee;
    QVERIFY(referee.send(static_cast<std::uint16_t>(s.options.refereePort),
                         live_rig::packet(QStringLiteral("v12hl688_READY.bin"))));
    const Names known{QStringLiteral("R1"), QStringLiteral("R3")};
    QTRY_COMPARE(s.namesOnCards(), known);
    QVERIFY(s.cards() == cards);
    QTRY_COMPARE(s.robotsInTree(), known);
    QCOMPARE(s.namesOnField(), known);
    QVERIFY(one.sendMessage() && three.sendMessage());
    QTRY_COMPARE(s.curves(), (QStringList{QStringLiteral("LOCALIZATION_X R3"),
                                          QStringLiteral("LOCALIZATION_Y R1"),
                                          QStringLiteral("LOCALIZATION_Y R3")}));
    QTRY_VERIFY(s.namesInLog().contains(QStringLiteral("R3")));
    QCOMPARE(s.robots(), std::size_t(2));
    QCOMPARE(s.cards().size(), qsizetype(2));
  }

  /// What 0.8 kept is drawn in Live, where robots and variables have other names now.
  void plotsOf08AreDrawnInLive() {
    Studio s;
    s.goLive();
    const auto layout =
        PlotPresets::readFile(QStringLiteral(PITCHBOARD_SOURCE_DIR "/tests/data/0.8/plots.json"));
    QVERIFY(layout);
    s.plots()->setLayoutSpec(*layout);
    const Robot one(s.options, 1), two(s.options, 2), three(s.options, 3), other(s.options, 3);
    int step = 0;
    const auto drawn = [&] {
      ++step;
      // The fourth curve is of a second program with a robot's number.
      if (!one.sendMessage(moved(1, step)) || !two.sendMessage(moved(2, step)) ||
          !three.sendMessage(moved(3, step)) || !other.sendMessage(moved(3, 300 + step))) {
        return false;
      }
      for (const PlotPane* pane : s.plots()->currentPage()->panes()) {
        for (const Curve& curve : pane->curves()) {
          const bool isHere = !curve.name().endsWith(QStringLiteral(" B1"));
          if (isHere && !curve.valueAt(std::nullopt)) return false;
        }
      }
      return true;
    };
    QTRY_VERIFY_WITH_TIMEOUT(drawn(), 30'000);
    const auto panes = s.plots()->currentPage()->panes();
    QCOMPARE(panes.size(), 2);
    QCOMPARE(panes[0]->curves().size(), std::size_t(4));
    QCOMPARE(panes[0]->curves()[0].name(), QStringLiteral("LOCALIZATION_X Robot 1"));
    QCOMPARE(panes[0]->curves()[2].name(), QStringLiteral("d/dt LOCALIZATION_THETA Robot 2"));
    // It was made in a simulation: nothing says that Robot 1 is that B1.
    QCOMPARE(panes[1]->curves()[0].name(), QStringLiteral("DECISION_ACTION_A B1"));
    QVERIFY(!panes[1]->curves()[0].valueAt(std::nullopt));
  }

  void oneNameEverywhere_data() {
    QTest::addColumn<QString>("our");
    QTest::addColumn<bool>("setups");
    QTest::addColumn<QStringList>("names");
    QTest::newRow("colour unknown") << QString() << false << QStringList{"Robot 3"};
    QTest::newRow("colour known") << QStringLiteral("red") << false << QStringList{"R3"};
    QTest::newRow("two teams") << QString() << true << QStringList{"B3", "R3"};
    QTest::newRow("two teams, the second is ours")
        << QStringLiteral("7") << true << QStringList{"R3", "B3"};
  }
  /// On cards, field, tree, legends, events, log, in CSV, report, --robots and JSON; and our team
  /// stands first wherever robots are listed.
  void oneNameEverywhere() {
    QFETCH(QString, our);
    QFETCH(bool, setups);
    QFETCH(QStringList, names);
    const Names expected(names.begin(), names.end());
    QStringList more;
    if (!our.isEmpty()) more << QStringLiteral("--our-team") << our;
    link::LiveOptions chosen;
    if (!our.isEmpty()) QVERIFY(link::chooseOurTeam(chosen, our.toStdString()));
    if (setups) {
      for (const QString& file :
           {write("blue.json", R"({"number": 12, "colour": "blue", "senders": ["127.0.0.2"],
                "robots": {"3": "Ana"}})"),
            write("red.json", R"({"number": 7, "colour": "red", "senders": ["127.0.0.3"]})")}) {
        more << QStringLiteral("--team") << file;
        chosen.team.teams.push_back(telemetry::loadTeamSetup(file.toStdString()).value());
      }
    }
    const auto start = [&](QProcess& process, const link::LiveOptions& at, QStringList command) {
      process.start(
          cli, command +
                   QStringList{"--bind", "127.0.0.1", "--port-base", QString::number(at.portBase),
                               "--gamecontroller-port", QString::number(at.refereePort)} +
                   more);
      QByteArray reported;
      QTRY_VERIFY_WITH_TIMEOUT(
          (reported += process.readAllStandardError()).contains("listening at"), 30'000);
    };
    const link::LiveOptions forListen = live_rig::options(), forRecord = live_rig::options();
    QProcess listen, record;
    const QString file = m_folder.filePath(QStringLiteral("%1.mcap").arg(QTest::currentDataTag()));
    start(listen, forListen, {"listen", "--json"});
    start(record, forRecord, {"record", "--live", "-o", file});
    Studio s;
    s.change([&](link::LiveOptions& o) {
      o.ourTeam = chosen.ourTeam;
      o.ourColour = chosen.ourColour;
      o.team.teams = chosen.team.teams;
    });
    s.goLive();
    s.plot({variableCurve(QStringLiteral("each/LOCALIZATION_X"))});

    // The guests are the first to speak.
    const TestSocket red(INADDR_LOOPBACK + 2), blue(INADDR_LOOPBACK + 1);
    std::vector<const TestSocket*> senders{&blue};
    if (setups) senders = {our.isEmpty() ? &red : &blue, our.isEmpty() ? &blue : &red};
    std::uint64_t sent = 0;
    for (int step = 0; step < 3; ++step) {
      for (const TestSocket* sender : senders) {
        for (const link::LiveOptions& at : {forListen, forRecord, s.options}) {
          QVERIFY(sender->send(static_cast<std::uint16_t>(at.portBase + 3),
                               telemetry::encode(moved(3, step))));
        }
        ++sent;
        QTRY_COMPARE(s.live()->details().network.datagrams(), sent);
      }
    }
    QTRY_COMPARE(s.namesOnCards(), expected);
    QStringList cards;
    for (const RobotCard* card : s.cards()) cards << card->state().name;
    QCOMPARE(cards, names);
    QCOMPARE(s.namesOnField(), expected);
    QTRY_COMPARE(s.robotsInTree(), expected);
    QStringList tree;
    for (int row = 0; row < s.tree()->rowCount(); ++row) {
      const auto info = s.tree()->groupOf(s.tree()->index(row, 0))->info();
      if (factsOf(info).number > 0) tree << QString::fromStdString(info.name);
    }
    QCOMPARE(tree, names);
    const auto drawn = [&s] {
      Names found;
      for (const QString& curve : s.curves()) found.insert(curve.section(QLatin1Char(' '), 1));
      return found;
    };
    QTRY_COMPARE(drawn(), expected);
    const auto inEvents = [&s] {
      Names found;
      for (const link::MatchEvent& event : s.window.shown()->events()->events()) {
        if (!event.name.empty()) found.insert(QString::fromStdString(event.name));
      }
      return found;
    };
    QTRY_COMPARE(inEvents(), expected);
    QTRY_COMPARE(s.namesInLog(), expected);

    kill(static_cast<pid_t>(listen.processId()), SIGINT);
    QVERIFY(listen.waitForFinished(30'000));
    Names messages, health, events;
    QStringList listed;
    for (const QByteArray& line : listen.readAllStandardOutput().trimmed().split('\n')) {
      const QJsonObject object = QJsonDocument::fromJson(line).object();
      const QString type = object["type"].toString(), name = object["name"].toString();
      if (type == QStringLiteral("health")) {
        health.insert(name);
        listed << name;
      }
      if (type == QStringLiteral("event")) events.insert(name);
      if (type != QStringLiteral("telemetry")) continue;
      messages.insert(name);
      QCOMPARE(object["robot"].toInt(), 3);
    }
    QCOMPARE(messages, expected);
    QCOMPARE(health, expected);
    QCOMPARE(events, expected);
    QCOMPARE(listed.mid(listed.size() - names.size()), names);

    kill(static_cast<pid_t>(record.processId()), SIGINT);
    QVERIFY(record.waitForFinished(30'000));
    const auto run = [](const QStringList& arguments) {
      QProcess process;
      process.start(cli, arguments);
      process.waitForFinished(30'000);
      return process.exitCode() == 0 ? process.readAllStandardOutput()
                                     : "failed: " + process.readAllStandardError();
    };
    const QByteArray csv = run({"export", file, "--to", "csv-wide"});
    QStringList columns;
    for (const QByteArray& column : csv.left(csv.indexOf('\n')).split(',')) {
      const QString name = QString::fromUtf8(column).section(QLatin1Char('.'), 0, 0);
      const bool isRobot =
          name != QStringLiteral("time") && !name.endsWith(QStringLiteral(" link"));
      if (isRobot && !columns.contains(name)) columns << name;
    }
    QVERIFY2(columns == names, csv.left(300));
    const QString html = file + QStringLiteral(".html");
    QCOMPARE(run({"export", file, "--to", "report", "-o", html}).left(7) == "failed:", false);
    QFile report(html);
    QVERIFY(report.open(QIODevice::ReadOnly));
    const QString page = QString::fromUtf8(report.readAll());
    QStringList inReport;
    static const QRegularExpression badge(QStringLiteral("<span class=\"badge [a-z]+\">([^<]+)<"));
    for (auto found = badge.globalMatch(page); found.hasNext();) {
      const QString name = found.next().captured(1);
      if (!inReport.contains(name)) inReport << name;
    }
    QCOMPARE(inReport, names);
    QCOMPARE(page.contains(QStringLiteral("B3</span> Ana<")), setups);
    for (const QString& name : names) {
      const QByteArray rows = run({"export", file, "--to", "csv-long", "--robots", name});
      QVERIFY2(rows.contains("," + name.toUtf8() + ",LOCALIZATION_X,"), rows.left(300));
    }
    const QByteArray unknown = run({"export", file, "--to", "csv-long", "--robots", "nobody"});
    QVERIFY2(unknown.indexOf(names.front().toUtf8()) <= unknown.indexOf(names.back().toUtf8()),
             unknown);
  }
};

PITCHBOARD_GUI_TEST(TestRenamedRobots)

}  // namespace tst_renamed_robots

#include "tst_renamed_robots.moc"
