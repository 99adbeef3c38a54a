// SPDX-License-Identifier: GPL-3.0-or-later
// Rules in the window: the moments of the command line for a recording, and while a match runs
// those of its rows; the row of the timeline, the alarm, the filter, what is saved, and long lists.

#include <QClipboard>
#include <QDockWidget>
#include <QHelpEvent>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableView>
#include <QToolTip>
#include <cmath>

#include <robotlink/scenario/scenario.h>
#include <telemetry/query/moment_watch.h>
#include <telemetry/session/session_reader.h>
#include <telemetry/session/session_writer.h>
#include <ui/base/session_mark.h>
#include <ui/base/theme.h>
#include <ui/sources/compared_session.h>
#include <ui/sources/compared_sessions.h>
#include <ui/sources/live_controller.h>
#include <ui/sources/match_memory.h>
#include <ui/sources/replay_controller.h>
#include <ui/sources/rule_watch.h>
#include <ui/sources/session_recording.h>
#include <ui/sources/shown_moment.h>

#include "../../support/program_run.h"
#include "../live_window.h"
#include "../studio_rig.h"
#include "timeline_strip.h"

namespace tst_rules_dock {

using namespace pitchboard;
using namespace pitchboard::ui;

namespace {

constexpr int patience_ms = 30'000;

struct RulesPanel : studio_rig::PanelStudio {
  RuleWatch* rules = window.findChild<RuleWatch*>();
  TimelineStrip* strip = window.findChild<TimelineStrip*>();

  RulesPanel() : PanelStudio("rules") {}
  QTableView* table() const { return find<QTableView>("rulesTable"); }
  QString problem() const { return find<QLabel>("inPlaceText")->text(); }
  QString state() const { return find<QLabel>("rulesState")->text(); }
  void replay(const QString& session) {
    open(session);
    QTRY_VERIFY_WITH_TIMEOUT(!rules->isRunning(), patience_ms);
  }
  /// "rule robot from until", sorted; of a compared session with this id, or of what is shown.
  QStringList lines(quint64 session = 0) const {
    QStringList out;
    for (const BrokenRule& one : rules->broken()) {
      if (one.session == session) out << textOf(rules->ruleOf(one), one.moment);
    }
    out.sort();
    return out;
  }
  /// The same as the command line finds it in a recording.
  static QStringList linesOfFile(const QString& rules, const QString& session) {
    const ProgramRun run = cli({"check", rules, session, "--json"});
    QStringList out;
    for (const QByteArray& line : run.out.trimmed().split('\n')) {
      const QJsonObject one = QJsonDocument::fromJson(line).object();
      if (one.contains("not_checked")) continue;
      out << QStringLiteral("%1 %2 %3 %4")
                 .arg(one["rule"].toString(), one["robot"].toString())
                 .arg(one["from"].toDouble(), 0, 'f', 6)
                 .arg(one["until"].toDouble(), 0, 'f', 6);
    }
    out.sort();
    return out;
  }
  ComparedSessions* compared() const { return window.compared(); }
  ComparedSession* session(std::size_t index) const { return compared()->all().at(index); }
  /// Opens files beside the one that is shown, and waits until they are checked.
  void compare(const QStringList& paths) const {
    const std::size_t all = compared()->all().size() + static_cast<std::size_t>(paths.size());
    compared()->open(paths);
    QTRY_VERIFY_WITH_TIMEOUT(compared()->all().size() == all && !rules->isRunning(), patience_ms);
  }
  static QString textOf(const telemetry::Rule& rule, const telemetry::FoundMoment& moment) {
    return QStringLiteral("%1 %2 %3 %4")
        .arg(QString::fromStdString(rule.name), QString::fromStdString(moment.robot))
        .arg(moment.range.begin, 0, 'f', 6)
        .arg(moment.range.end, 0, 'f', 6);
  }
  /// What the rows that the match keeps say, all at once.
  QStringList linesOfMemory() const {
    const telemetry::QueryRows rows(*window.shown()->series());
    telemetry::MomentWatch watch(telemetry::questionsOf(rules->rules()));
    if (!watch.advance(rows, std::nextafter(rows.range()->end, -1.0))) qFatal("stopped");
    QStringList out;
    for (const auto& all : {watch.takeEnded(), watch.open()}) {
      for (const auto& one : all) out << textOf(rules->rules()[one.question], one);
    }
    out.sort();
    return out;
  }
  /// The events of the timeline that are of rules, as the list above, and their sentences.
  std::vector<link::MatchEvent> events() const {
    std::vector<link::MatchEvent> out;
    for (const link::MatchEvent& event : window.shown()->events()->events()) {
      if (event.kind == link::MatchEventKind::RuleBroken) out.push_back(event);
    }
    return out;
  }
  bool listsEveryBeginning() const {
    const auto all = events();
    return all.size() == rules->broken().size() &&
           std::ranges::all_of(rules->broken(), [&](const BrokenRule& one) {
             return std::ranges::any_of(all, [&](const link::MatchEvent& event) {
               return event.time == one.moment.range.begin && event.name == one.moment.robot &&
                      event.value == static_cast<int>(rules->ruleOf(one).severity);
             });
           });
  }
  void playTo(std::uint64_t tick) {
    controller.runTo(tick);
    QTRY_VERIFY_WITH_TIMEOUT(
        window.shown()->newest() != nullptr && window.shown()->newest()->snapshot.tick == tick,
        patience_ms);
  }
};

}  // namespace

namespace {

/// Live robots whose rows a test writes.
class RowsSource : public FrameSource {
 public:
  const SourceKind& kind() const override { return SourceKind::Live; }
  FramePtr frame() const override { return nullptr; }
  std::shared_ptr<const telemetry::SeriesStore> series() const override { return m_rows; }
  QString emptyText() const override { return {}; }
  /// With a column X.
  telemetry::GroupId addGroup(const char* name) const {
    using namespace telemetry;
    return m_rows->addGroup(
        {name, {{"X", ColumnType::Float64, "", "", ColumnKind::Number, {}}}, {}});
  }
  void append(telemetry::GroupId group, double time, double x) {
    m_rows->append(group, {time, {}, std::span(&x, 1)});
    emit rowsAppended();
  }

 private:
  std::shared_ptr<telemetry::SeriesStore> m_rows = std::make_shared<telemetry::SeriesStore>();
};

}  // namespace

class TestRulesDock : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

  QString path(const char* name) const { return m_folder.filePath(QLatin1String(name)); }
  QString written(const char* name, const QByteArray& text) const {
    QFile file(path(name));
    if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size()) qFatal("not written");
    return path(name);
  }

 private slots:
  void initTestCase() {
    setTheme(*qApp, ThemeChoice::Dark);
    const ProgramRun run = cli({"record", "--scenario", "match-3v3", "--noise", "realistic",
                                "--seed", "3", "--duration", "20", "-o", path("match.mcap")});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    written("rules.json", R"({"version": 1, "rules": [
  {"name": "wrong", "text": "Believes in a wrong place", "when": "BELIEF_ERROR > 25", "for": 0.2,
   "severity": "warning"},
  {"name": "late", "text": "It is late", "when": "TRUE_X > -1000 && t > 12 && t < 13",
   "robots": ["B1", "B2"]},
  {"name": "unknown", "when": "NOSUCH > 1"}]})");
  }

  void aRecordingHasTheMomentsOfTheCommandLine() {
    RulesPanel s;
    QVERIFY(s.find<QLabel>("emptyRules")->isVisible());
    QCOMPARE(s.strip->rulesRect(), QRect());
    const int height = s.strip->sizeHint().height();
    QVERIFY(s.rules->open(path("rules.json")));
    s.replay(path("match.mcap"));
    const QStringList expected = s.linesOfFile(path("rules.json"), path("match.mcap"));
    QVERIFY(expected.size() > 5);
    QTRY_COMPARE_WITH_TIMEOUT(s.lines(), expected, patience_ms);
    QCOMPARE(s.table()->model()->rowCount(), static_cast<int>(expected.size()));
    QVERIFY2(s.problem().contains(QStringLiteral("unknown is not checked: No robot has the "
                                                 "variable NOSUCH")),
             qPrintable(s.problem()));
    // Each is an event of its robot, with the severity: to be stepped to, and hidden.
    QVERIFY(s.listsEveryBeginning());
    const auto listed = s.events();
    const auto late = std::ranges::find_if(listed, [](const link::MatchEvent& event) {
      return sentenceOf(event) == "B1 broke a rule: It is late (error)";
    });
    QVERIFY(late != listed.end());
    const link::RobotFrame* b1 = s.window.shown()->frame()->robot(late->robot);
    QVERIFY(b1 != nullptr && b1->name == "B1");
    EventFilter onlyRules;
    for (const link::MatchEvent& event : s.window.shown()->events()->events()) {
      if (event.kind != link::MatchEventKind::RuleBroken) onlyRules.hidden.insert(event.kind);
    }
    s.window.shown()->setFilter(onlyRules);
    s.window.shown()->seek(late->time - 0.001);
    QVERIFY(s.window.shown()->goToNextEvent());
    QVERIFY(std::abs(s.window.shown()->time() - late->time) < 0.02);
    s.window.shown()->setFilter({});
    // A row of the timeline.
    QVERIFY(s.strip->sizeHint().height() > height);
    const auto middleOf = [&s](double time) {
      return QPoint(qRound(s.strip->axis().pixel(time)), s.strip->rulesRect().center().y());
    };
    const QImage picture = s.strip->grab().toImage();
    const auto colorAt = [&](double time) {
      return picture.pixelColor(middleOf(time) * picture.devicePixelRatio());
    };
    QCOMPARE(colorAt(12.5), theme().errorText);
    const auto broken = s.strip->brokenAt(s.strip->axis().pixel(12.5));
    QVERIFY(broken.size() >= 2);
    QCOMPARE(s.rules->ruleOf(*broken.front()).name, std::string("late"));
    QHelpEvent help(QEvent::ToolTip, middleOf(12.5), s.strip->mapToGlobal(middleOf(12.5)));
    QApplication::sendEvent(s.strip, &help);
    QVERIFY2(QToolTip::text().contains(QStringLiteral("B1: It is late (late, 1.")) ||
                 QToolTip::text().contains(QStringLiteral("B1: It is late (late, 0.98")),
             qPrintable(QToolTip::text()));
    QTest::mouseClick(s.strip, Qt::LeftButton, {}, middleOf(12.5));
    QVERIFY(std::abs(s.window.shown()->time() - 12.0) < 0.05);
    // A click in the table leads there, too; the list can be filtered, copied.
    s.find<QLineEdit>("rulesFilter")->setText(QStringLiteral("late B2"));
    QCOMPARE(s.table()->model()->rowCount(), 1);
    QVERIFY2(s.state().contains(QStringLiteral("broken 1 of ")), qPrintable(s.state()));
    s.window.shown()->seek(1.0);
    const QModelIndex cell = s.table()->model()->index(0, RuleWatch::Name);
    QTest::mouseClick(s.table()->viewport(), Qt::LeftButton, {},
                      s.table()->visualRect(cell).center());
    QVERIFY(std::abs(s.window.shown()->time() - 12.0) < 0.05);
    s.table()->setFocus();
    QTest::keyClick(s.table(), Qt::Key_C, Qt::ControlModifier);
    QVERIFY2(QApplication::clipboard()->text().startsWith(QStringLiteral("error\tlate\tB2\t")),
             qPrintable(QApplication::clipboard()->text()));
    // Times and other numbers are found as they are shown.
    s.find<QLineEdit>("rulesFilter")
        ->setText(s.table()->model()->index(0, RuleWatch::From).data().toString());
    QVERIFY(s.table()->model()->rowCount() > 0);
    s.find<QLineEdit>("rulesFilter")->setText(QStringLiteral("0123456789"));
    QCOMPARE(s.table()->model()->rowCount(), 0);
    // The file is known at the next start.
    QCOMPARE(s.settings.value(QStringLiteral("rules/file")).toString(), path("rules.json"));
    RuleWatch next(s.window.shown(), s.window.replay(), s.compared(), &s.settings, nullptr);
    QCOMPARE(next.rules().size(), std::size_t{3});
  }

  void aMatchIsCheckedWhileItRuns() {
    RulesPanel s;
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    s.playTo(6);
    QVERIFY(s.rules->open(written("live.json", R"({"version": 1, "rules": [
  {"name": "late", "when": "TRUE_X > -1000 && t > 2 && t < 3"},
  {"name": "later", "text": "Now it is late", "when": "TRUE_X > -1000 && t > 4", "for": 0.5},
  {"name": "wrong", "when": "BELIEF_ERROR > 15", "severity": "note"}]})")));
    QSignalSpy broke(s.rules, &RuleWatch::broke);
    auto* frame = s.window.findChild<QWidget*>(QStringLiteral("alarmFrame"));
    s.playTo(100);
    QTRY_COMPARE_WITH_TIMEOUT(s.lines(), s.linesOfMemory(), patience_ms);
    QCOMPARE(broke.count(), 0);  // notes are no alarms
    QVERIFY(s.listsEveryBeginning() && !s.events().empty());
    // Also while somebody looks back.
    s.window.shown()->seek(1.0);
    QVERIFY(s.window.shown()->isLookingBack());
    const std::size_t before = s.events().size();
    QVERIFY(!frame->isVisible());
    s.playTo(150);
    QTRY_VERIFY_WITH_TIMEOUT(broke.count() > 0, patience_ms);
    QTRY_COMPARE_WITH_TIMEOUT(s.lines(), s.linesOfMemory(), patience_ms);
    QVERIFY(s.window.shown()->isLookingBack());
    QVERIFY(s.listsEveryBeginning() && s.events().size() > before);
    s.window.shown()->goLive();
    // What is saved of the match has no rules: who opens it has their own.
    QVERIFY(s.window.findChild<SessionRecording*>()->recentPast(60.0)(path("recent.mcap")));
    const auto saved = telemetry::SessionReader::open(path("recent.mcap").toStdString());
    QVERIFY(std::ranges::none_of(saved->events(), [](const telemetry::SessionEvent& event) {
      return event.kind == "rule";
    }));
    const auto rulesBroken = [&broke] {
      int all = 0;
      for (const QList<QVariant>& one : broke) {
        const QString text = one.front().toString();
        const qsizetype more = text.indexOf(QStringLiteral("(and "));
        all += 1 + (more < 0 ? 0 : text.mid(more + 5).section(QLatin1Char(' '), 0, 0).toInt());
      }
      return all;
    };
    QCOMPARE(rulesBroken(), 6);
    QVERIFY(frame->isVisible());
    s.playTo(250);
    QTRY_COMPARE_WITH_TIMEOUT(s.lines(), s.linesOfMemory(), patience_ms);
    QVERIFY(std::ranges::none_of(s.rules->broken(), [&](const BrokenRule& one) {
      return s.rules->ruleOf(one).name == "later";  // not for half a second yet
    }));
    s.playTo(290);
    QTRY_COMPARE_WITH_TIMEOUT(rulesBroken(), 12, patience_ms);
    QVERIFY2(frame->accessibleName().contains(QStringLiteral(": Now it is late")),
             qPrintable(frame->accessibleName()));
    QTRY_COMPARE_WITH_TIMEOUT(s.lines(), s.linesOfMemory(), patience_ms);
    // The match goes on from an earlier moment: what was later has not happened.
    s.controller.memory()->continueFrom(2.5);
    QTRY_VERIFY_WITH_TIMEOUT(s.window.shown()->now() < 4.0, patience_ms);
    QTRY_COMPARE_WITH_TIMEOUT(s.lines(), s.linesOfMemory(), patience_ms);
    QVERIFY(std::ranges::all_of(
        s.rules->broken(), [](const BrokenRule& one) { return one.moment.range.begin < 3.0; }));
    QVERIFY(s.listsEveryBeginning());
    // Without rules there is no row.
    s.rules->close();
    QVERIFY(s.events().empty());
    QVERIFY(s.rules->broken().empty());
    QCOMPARE(s.strip->rulesRect(), QRect());
  }

  void comparedSessionsAreChecked() {
    const QString second = path("second.mcap");
    const ProgramRun run = cli({"record", "--scenario", "match-3v3", "--noise", "realistic",
                                "--seed", "8", "--duration", "16", "-o", second});
    QVERIFY2(run.exitCode == 0, run.err.constData());
    const QString rules = path("rules.json");
    const QStringList first = RulesPanel::linesOfFile(rules, path("match.mcap"));
    const QStringList other = RulesPanel::linesOfFile(rules, second);
    QVERIFY(!other.isEmpty() && other != first);
    RulesPanel s;
    QVERIFY(s.rules->open(rules));
    s.replay(path("match.mcap"));
    QTRY_COMPARE_WITH_TIMEOUT(s.lines(), first, patience_ms);
    QVERIFY(s.table()->isColumnHidden(RuleWatch::Session));
    // The same file twice is two sessions.
    s.compare({second, path("match.mcap")});
    QCOMPARE(s.lines(), first);
    QCOMPARE(s.lines(s.session(0)->id()), other);
    QCOMPARE(s.lines(s.session(1)->id()), first);
    QCOMPARE(s.table()->model()->rowCount(), static_cast<int>(2 * first.size() + other.size()));
    // The events of the timeline are those of what is shown.
    QCOMPARE(s.events().size(), static_cast<std::size_t>(first.size()));
    QVERIFY2(s.problem().contains(QStringLiteral("′ second: unknown is not checked")),
             qPrintable(s.problem()));
    // The table says whose they are, with mark and colour.
    QVERIFY(!s.table()->isColumnHidden(RuleWatch::Session));
    s.find<QLineEdit>("rulesFilter")->setText(QStringLiteral("late B1 second"));
    QCOMPARE(s.table()->model()->rowCount(), 1);
    const QModelIndex cell = s.table()->model()->index(0, RuleWatch::Session);
    QCOMPARE(cell.data().toString(), QStringLiteral("′ second"));
    QCOMPARE(cell.data(Qt::DecorationRole).value<QColor>(), sessionColor(1));
    // A row leads to the moment as it is aligned.
    const auto goToFirst = [&s] {
      const QModelIndex row = s.table()->model()->index(0, RuleWatch::Name);
      QTest::mouseClick(s.table()->viewport(), Qt::LeftButton, {},
                        s.table()->visualRect(row).center());
      return s.window.shown()->time();
    };
    QVERIFY(std::abs(goToFirst() - 12.0) < 0.05);
    s.session(0)->setOffset(2.5);
    QVERIFY(std::abs(goToFirst() - 14.5) < 0.05);
    QCOMPARE(s.lines(s.session(0)->id()), other);  // in its own time
    s.find<QLineEdit>("rulesFilter")->clear();
    // Its row of the timeline has its ranges where they are aligned.
    const auto middleOf = [&s](double time) {
      return QPoint(qRound(s.strip->axis().pixel(time)),
                    s.strip->comparedRulesRect(0).center().y());
    };
    QTRY_VERIFY(s.strip->comparedRect(0).height() > 0 &&
                s.strip->height() == s.strip->sizeHint().height());
    const auto colorAt = [&](double time) {
      const QImage picture = s.strip->grab().toImage();
      return picture.pixelColor(middleOf(time) * picture.devicePixelRatio());
    };
    QCOMPARE(colorAt(15.0), theme().errorText);
    QVERIFY(colorAt(12.5) != theme().errorText);
    QHelpEvent help(QEvent::ToolTip, middleOf(15.0), s.strip->mapToGlobal(middleOf(15.0)));
    QApplication::sendEvent(s.strip, &help);
    QVERIFY2(QToolTip::text().contains(QStringLiteral("′ second · +2.50 s")) &&
                 QToolTip::text().contains(QStringLiteral("It is late (late, ")),
             qPrintable(QToolTip::text()));
    s.window.shown()->seek(1.0);
    QTest::mouseClick(s.strip, Qt::LeftButton, {}, middleOf(15.0));
    QVERIFY(std::abs(s.window.shown()->time() - 14.5) < 0.05);
    // What is changed in the rules is checked everywhere; what is closed is gone.
    written("only.json", R"({"version": 1, "rules": [
  {"name": "only", "text": "It is early", "when": "TRUE_X > -1000 && t < 1"}]})");
    QVERIFY(s.rules->open(path("only.json")));
    QTRY_VERIFY_WITH_TIMEOUT(!s.rules->isRunning(), patience_ms);
    QCOMPARE(s.lines(s.session(0)->id()), RulesPanel::linesOfFile(path("only.json"), second));
    QCOMPARE(s.lines(s.session(1)->id()), s.lines());
    s.compared()->remove(s.session(0));
    QCOMPARE(s.rules->broken().size(), static_cast<std::size_t>(2 * s.lines().size()));
    s.compared()->removeAll();
    QVERIFY(s.table()->isColumnHidden(RuleWatch::Session));
    QCOMPARE(s.table()->model()->rowCount(), static_cast<int>(s.lines().size()));
  }

  /// A match is checked while recordings are read beside it, and only its rules raise an alarm.
  void aMatchHasComparedSessionsBesideIt() {
    RulesPanel s;
    s.controller.open(link::loadScenario("match-3v3").value(), true);
    s.playTo(6);
    QVERIFY(s.rules->open(written("beside.json", R"({"version": 1, "rules": [
  {"name": "late", "text": "It is late", "when": "TRUE_X > -1000 && t > 2 && t < 3"}]})")));
    QSignalSpy broke(s.rules, &RuleWatch::broke);
    s.compare({path("match.mcap")});
    const quint64 id = s.session(0)->id();
    const QStringList expected = RulesPanel::linesOfFile(path("beside.json"), path("match.mcap"));
    QCOMPARE(s.lines(id), expected);
    QCOMPARE(expected.size(), 6);
    QCOMPARE(broke.count(), 0);
    s.playTo(150);
    QTRY_COMPARE_WITH_TIMEOUT(s.lines(), s.linesOfMemory(), patience_ms);
    QVERIFY(broke.count() > 0 && s.lines().size() == 6);
    // What is dropped of the match leaves the recording as it is.
    s.controller.memory()->continueFrom(1.0);
    QTRY_VERIFY_WITH_TIMEOUT(s.lines().isEmpty(), patience_ms);
    QCOMPARE(s.lines(id), expected);
  }

  /// Live, at the present and while somebody looks back.
  void liveRobotsAreChecked() {
    RulesPanel s;
    live_rig::LiveWindow live(s.window);
    QVERIFY(live.isListening());
    QVERIFY(s.rules->open(written("received.json", R"({"version": 1, "rules": [
  {"name": "near", "text": "The ball is near", "when": "VISION_BALL_DIST < 50"},
  {"name": "far", "when": "VISION_BALL_DIST > 400", "severity": "note"}]})")));
    QSignalSpy broke(s.rules, &RuleWatch::broke);
    auto* frame = s.window.findChild<QWidget*>(QStringLiteral("alarmFrame"));
    // The robot goes on sending, until what it said before has been checked.
    const auto isChecked = [&] {
      return QTest::qWaitFor([&] { return live.say() && s.lines() == s.linesOfMemory(); },
                             patience_ms);
    };
    for (const float distance : {100.0F, 20.0F, 30.0F, 100.0F, 500.0F}) QVERIFY(live.say(distance));
    QVERIFY(isChecked());
    QCOMPARE(s.rules->broken().size(), std::size_t{2});
    QCOMPARE(broke.count(), 1);  // notes are no alarms
    QVERIFY2(broke[0][0].toString().endsWith(QStringLiteral(": The ball is near")),
             qPrintable(broke[0][0].toString()));
    QVERIFY(frame->isVisible());
    const BrokenRule near = s.rules->broken().front();
    QCOMPARE(near.moment.value, std::optional(20.0));
    // An event of the robot that is shown, to which N leads.
    QVERIFY(s.listsEveryBeginning());
    const auto events = s.events();
    const link::RobotFrame& robot = s.window.live()->frame()->robots[0];
    QCOMPARE(events[0].robot, robot.uid);
    QCOMPARE(events[0].name, robot.name);
    EventFilter onlyRules;
    for (const link::MatchEvent& event : s.window.shown()->events()->events()) {
      if (event.kind != link::MatchEventKind::RuleBroken) onlyRules.hidden.insert(event.kind);
    }
    s.window.shown()->setFilter(onlyRules);
    s.window.shown()->seek(s.window.shown()->available()->begin);
    QVERIFY(s.window.shown()->isLookingBack());
    QVERIFY(s.window.shown()->goToNextEvent());
    QCOMPARE(s.window.shown()->time(), near.from());
    // It is checked meanwhile, and the moment that is shown stays.
    QVERIFY(live.say(10.0F));
    QVERIFY(isChecked());
    QCOMPARE(broke.count(), 2);
    QCOMPARE(s.rules->broken().size(), std::size_t{3});
    QCOMPARE(s.events().size(), std::size_t{3});
    QCOMPARE(s.window.shown()->time(), near.from());
    // Another source has other rows, and comes back to these without an alarm.
    s.window.showSource(SourceKind::Simulate);
    QVERIFY(s.events().empty());
    s.window.showSource(SourceKind::Live);
    QVERIFY(isChecked());
    QCOMPARE(s.events().size(), std::size_t{3});
    QCOMPARE(broke.count(), 2);
    s.window.live()->clear();
    QTRY_VERIFY_WITH_TIMEOUT(s.rules->broken().empty() && s.events().empty(), patience_ms);
  }

  /// Rows of one robot may come after those of another one that have later times.
  void rowsThatComeLateAreChecked() {
    RowsSource source;
    ShownMoment shown(&source);
    ReplayController replay;
    ComparedSessions compared(&shown, nullptr);
    RuleWatch rules(&shown, &replay, &compared, nullptr, nullptr);
    const auto a = source.addGroup("A"), b = source.addGroup("B");
    for (const auto& [group, time, x] :
         {std::tuple(a, 1.0, 0.0), {b, 1.0, 0.0}, {a, 1.2, 1.0}, {a, 1.3, 0.0}, {a, 3.0, 0.0}}) {
      source.append(group, time, x);
    }
    QVERIFY(rules.open(written("order.json", R"({"version": 1, "rules": [
  {"name": "a", "when": "A.X > 0"}, {"name": "b", "when": "B.X > 0"}]})")));
    QTRY_COMPARE_WITH_TIMEOUT(rules.broken().size(), std::size_t{1}, patience_ms);
    source.append(b, 2.8, 1.0);
    source.append(b, 2.9, 0.0);
    source.append(a, 4.0, 0.0);
    QTRY_COMPARE_WITH_TIMEOUT(rules.broken().size(), std::size_t{2}, patience_ms);
    QCOMPARE(rules.broken()[1].from(), 2.8);
    QCOMPARE(rules.broken()[1].until(), 2.9);
  }

  void mistakesAreShown() {
    RulesPanel s;
    QVERIFY(!s.rules->open(written("bad.json", "{\"version\": 1,\n \"rules\": [{}]}")));
    QVERIFY2(s.problem().contains(QStringLiteral("bad.json:2: rules[0].name")) ||
                 s.problem().contains(QStringLiteral("bad.json:2: rules[0]")),
             qPrintable(s.problem()));
    QVERIFY(s.find<QLabel>("emptyRules")->isVisible());
    // Corrected, it is read again.
    written("bad.json", R"({"version": 1, "rules": [{"name": "a", "when": "TRUE_X > 1000"}]})");
    QTest::mouseClick(s.find<QPushButton>("checkRulesAgain"), Qt::LeftButton);
    QCOMPARE(s.rules->rules().size(), std::size_t{1});
    QTRY_VERIFY_WITH_TIMEOUT(s.problem().isEmpty(), patience_ms);
    QVERIFY(!s.rules->open(path("none.json")));
    QVERIFY(s.rules->rules().empty());
  }

  /// Twelve thousand times: the newest ten thousand are listed.
  void longListsAreCut() {
    using namespace telemetry;
    SessionInfo info;
    info.program = "test";
    info.source = "simulation";
    auto writer = SessionWriter::create(path("long.mcap").toStdString(), info);
    QVERIFY(writer);
    (*writer)->addGroup(
        {"match", {{"X", ColumnType::Float64, "", "", ColumnKind::Number, {}}}, {}});
    for (int i = 0; i < 24'000; ++i) {
      const double value = i % 2;
      (*writer)->append(0, {i * 0.1, {}, std::span(&value, 1)});
    }
    QVERIFY((*writer)->finish());
    RulesPanel s;
    QVERIFY(s.rules->open(written(
        "often.json", R"({"version": 1, "rules": [{"name": "a", "when": "match.X > 0"}]})")));
    s.replay(path("long.mcap"));
    QTRY_COMPARE_WITH_TIMEOUT(s.rules->broken().size(), RuleWatch::maxBroken, patience_ms);
    QVERIFY(std::abs(s.rules->broken().back().moment.range.begin - 2399.9) < 1e-6);
    QVERIFY2(s.state().contains(QStringLiteral("the newest ones")), qPrintable(s.state()));
    QVERIFY(s.listsEveryBeginning());
    QVERIFY(!s.strip->grab().isNull());
  }
};

PITCHBOARD_GUI_TEST(TestRulesDock)

}  // namespace tst_rules_dock

#include "tst_rules_dock.moc"
