// SPDX-License-Identifier: GPL-3.0-or-later
#include <QtTest>

#include <robotlink/report/field_svg.h>
#include <robotlink/report/report.h>
#include <robotlink/session/match_sampler.h>

#include "../support/robot_keys.h"

namespace tst_report {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

constexpr double played = 60.0;  // s

}  // namespace

class TestReport : public QObject {
  Q_OBJECT
  telemetry::SeriesStore m_store;
  sim::Snapshot m_end;
  std::vector<float> m_errors;  // of the first robot
  MatchStatistics m_statistics;

 private slots:
  void initTestCase() {
    Scenario scenario = loadScenario("match-3v3").value();
    scenario.settings.noise = noisePreset("paper").value();
    scenario.stop = {};
    auto match = SimulatedMatch::create(scenario, {}).value();
    MatchSampler sampler(std::shared_ptr<telemetry::RowSink>(std::shared_ptr<void>(), &m_store));
    sampler.ticked(match, {});
    for (int i = 0; i < static_cast<int>(played) * 60; ++i) {
      match.tick();
      sampler.ticked(match, std::chrono::nanoseconds(1000));
    }
    m_end = match.simulation().snapshot();
    m_statistics = statisticsOf(m_store, {0.0, played});
  }

  void numbersAreThoseOfTheMatch() {
    QVERIFY(m_statistics.truthKnown);
    QCOMPARE(m_statistics.robots.size(), m_end.robots.size());
    double ball = 0.0;
    for (const sim::RobotSnapshot& robot : m_end.robots) {
      const std::string name = robot.identity.name();
      const auto found = std::find_if(m_statistics.robots.begin(), m_statistics.robots.end(),
                                      [&](const auto& one) { return one.name == name; });
      QVERIFY(found != m_statistics.robots.end());
      QVERIFY(found->team == robot.identity.team);
      QVERIFY(std::abs(*found->distance - robot.statistics.distanceWalked) < 1e-9);
      QCOMPARE(found->kicks, robot.statistics.kicks);
      QVERIFY(std::abs(found->seconds - played) < 1e-6);
      QVERIFY(*found->uptime[0] > 0.95 && *found->uptime[1] > 0.95);
      QVERIFY(found->ballSeconds >= 0.0 && found->ballSeconds <= played);
      ball += found->ballSeconds;
    }
    QVERIFY(ball > 1.0 && ball <= played + 1e-6);
    QCOMPARE(m_statistics.teams.size(), std::size_t{2});
    QCOMPARE(*m_statistics.teams[0].score, m_end.score.left);
    QCOMPARE(*m_statistics.teams[1].score, m_end.score.right);
  }

  /// Two halves of a match add up to it, also when it is cut between two rows.
  void partsAddUp_data() {
    QTest::addColumn<double>("cut");
    QTest::newRow("at a row") << 5.0;
    QTest::newRow("between rows") << 5.0 + 1.0 / 240.0;
  }
  void partsAddUp() {
    QFETCH(double, cut);
    const auto first = statisticsOf(m_store, {0.0, cut}),
               second = statisticsOf(m_store, {cut, played});
    QCOMPARE(second.robots.size(), m_statistics.robots.size());
    for (std::size_t i = 0; i < m_statistics.robots.size(); ++i) {
      const RobotSummary& whole = m_statistics.robots[i];
      const RobotSummary &a = first.robots[i], &b = second.robots[i];
      QVERIFY(std::abs(*a.distance + *b.distance - *whole.distance) < 1e-9);
      QCOMPARE(a.kicks + b.kicks, whole.kicks);
      QCOMPARE(a.falls + b.falls, whole.falls);
      QVERIFY(std::abs(a.seconds + b.seconds - whole.seconds) < 1.0 / 60.0);
    }
    for (std::size_t i = 0; i < m_statistics.teams.size(); ++i) {
      QCOMPARE(first.teams[i].scored + second.teams[i].scored, m_statistics.teams[i].scored);
    }
  }

  void teamsAreNamedWithTheirGoalsByHalf() {
    const Scenario scenario =
        scenarioFromJson(R"({"version": 1, "noise": "none", "field": "kid-2020",
          "referee": {"rules": "humanoid-2021", "half_time": 5, "break_time": 1, "before_match": 1},
          "teams": [{"colour": "blue", "number": 12, "name": "RoboFEI"}],
          "score": {"left": 0, "right": 4}, "ball": {"x": 0, "y": 0},
          "robots": [{"team": "blue", "number": 1, "x": -3, "y": 2, "behaviour": "none"},
                     {"team": "red", "number": 1, "x": 3, "y": 2, "behaviour": "none"}]})",
                         "test")
            .value();
    auto match = SimulatedMatch::create(scenario, {}).value();
    telemetry::SeriesStore store;
    MatchSampler sampler(std::shared_ptr<telemetry::RowSink>(std::shared_ptr<void>(), &store));
    while (!match.finished()) {
      match.tick();
      sampler.ticked(match, {});
    }
    const double end = match.simulation().snapshot().time;
    ReportContent content;
    content.statistics = statisticsOf(store, {0.0, end});
    const auto& teams = content.statistics.teams;
    QCOMPARE(teams.size(), std::size_t{2});
    const MatchResult result = match.result();
    for (std::size_t i = 0; i < teams.size(); ++i) {
      QCOMPARE(teams[i].team, result.teams[i].colour);
      QCOMPARE(teams[i].name, result.teams[i].name);
      QCOMPARE(teams[i].number, result.teams[i].number);
      QCOMPARE(teams[i].score, std::optional(result.teams[i].score));
      QCOMPARE(teams[i].byHalf, result.teams[i].byHalf);
    }
    QCOMPARE(teams[0].name, std::string("RoboFEI"));
    QCOMPARE(teams[1].byHalf, (std::vector<int>{4, 0}));
    const std::string page = reportHtml(content);
    QVERIFY(page.find("blue, team 12 · by half 0 + 0") != std::string::npos);
    QVERIFY(page.find("· by half 4 + 0") != std::string::npos);
  }

  void beliefErrorsAreQuantiles() {
    const auto& robot = m_statistics.robots.front();
    const auto series = m_store.find(robot.name, "BELIEF_ERROR");
    QVERIFY(series);
    std::vector<telemetry::Sample> samples;
    m_store.view(series->group)->samples(series->column, {0.0, played}, samples);
    std::vector<double> errors;
    for (const auto& sample : samples) {
      if (std::isfinite(sample.value)) errors.push_back(sample.value);
    }
    QVERIFY(errors.size() > 100);
    std::sort(errors.begin(), errors.end());
    QVERIFY(std::abs(*robot.errorMedian - errors[errors.size() / 2]) < 1.0);
    QVERIFY(std::abs(*robot.error90 - errors[errors.size() * 9 / 10]) < 1.0);
    QCOMPARE(robot.errorCurve.size(), statisticsParts);
  }

  void thePageHasEverythingAndNothingFromOutside() {
    ReportContent content;
    content.title = "3 against 3 <script>alert(1)</script>";
    content.session.source = "simulation";
    content.session.seed = 7;
    content.session.start =
        std::chrono::sys_days(std::chrono::year{2026} / 7 / 4) + std::chrono::hours(12);
    content.session.program = "pitchboard";
    content.statistics = m_statistics;
    content.statistics.robots.front().ownName = "Ana <i>";
    const auto event = [](MatchEventKind kind, double time, const char* detail = "") {
      MatchEvent made;
      made.kind = kind;
      made.time = time;
      made.detail = detail;
      return made;
    };
    content.events = {event(MatchEventKind::Goal, 12.34), event(MatchEventKind::Kick, 20.0),
                      event(MatchEventKind::Bookmark, 30.0, "<b>look</b>"),
                      event(MatchEventKind::Goal, 999.0)};
    content.events.front().side = Side::Left;
    content.events.back().side = Side::Right;
    content.events[1].name = "B1";
    content.picture =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 104 74\"><rect width=\"104\" "
        "height=\"74\" fill=\"#33453a\"/></svg>";
    content.pictureCaption = "The field at 0:30";
    content.notes = {"The recording broke off."};
    const QString html = QString::fromStdString(reportHtml(content));
    // The only script is the page's own.
    QVERIFY(html.count("<script") == 1 && html.contains("<script>\ndocument.querySelectorAll") &&
            !html.contains("<b>look"));
    QVERIFY(html.contains("0:12.3") && html.contains("goal for the left side"));
    QVERIFY(!html.contains("goal for the right side"));
    QVERIFY(html.contains("1 kick</summary>"));
    QVERIFY(html.contains("data:image/svg+xml;base64,"));
    QVERIFY(html.contains("seed 7") && html.contains("The recording broke off."));
    // Self-contained: nothing is fetched.
    QVERIFY(!html.contains("src=\"http") && !html.contains("href=") && !html.contains("url("));
    for (const auto& robot : m_statistics.robots) {
      QVERIFY(html.contains('>' + QString::fromStdString(robot.name) + "</span>"));
    }
    QCOMPARE(html.count("</span> Ana &lt;i&gt;"), 3);  // in both tables and the heat map tables
    QTemporaryDir folder;
    const std::string path = folder.filePath("report.html").toStdString();
    QVERIFY(writeReport(path, content));
    QCOMPARE(writeReport(path, content).error().code, ErrorCode::Conflict);
    QVERIFY(writeReport(path, content, IfExists::Replace));
    QVERIFY(!writeReport(path, content, IfExists::Replace, path));
    QCOMPARE(writeReport("/nonexistent/r.html", content).error().code, ErrorCode::SystemError);
    QFile file(QString::fromStdString(path));
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(QString::fromUtf8(file.readAll()), html);
    if (const QByteArray keep = qgetenv("PITCHBOARD_KEEP_REPORT"); !keep.isEmpty()) {
      QFile::remove(QString::fromUtf8(keep));
      QVERIFY(file.copy(QString::fromUtf8(keep)));
    }
  }

  /// The lines are those of the studio's field; a field without penalty marks has none.
  void trajectoriesLieOnTheField() {
    sim::FieldSpec field;
    const std::vector<FieldTrajectory> ball{{{{0.0, 0.0}, {1.0, 0.5}}, "#f0a35e", 0.5, 0.02}};
    const auto count = [&](const char* what) {
      return QString::fromStdString(fieldSvg(field, ball)).count(QLatin1String(what));
    };
    QCOMPARE(count("<polyline points=\"0.0,0.0 100.0,-50.0 \""), 1);
    QCOMPARE(count("stroke-opacity=\"0.50\" stroke-width=\"2.0\""), 1);
    QCOMPARE(count("<circle"), 4);  // centre circle, two penalty marks, the end of the trajectory
    field.penaltyMarkDistance = 0.0;
    QCOMPARE(count("<circle"), 2);
    // Border, grass, five lines, three of each goal area, two goals.
    QCOMPARE(count("<rect"), 2 + 5 + 6 + 2);
  }

  void whatHappenedToProcessesIsReportedEach() {
    ReportContent content;
    content.statistics = m_statistics;
    const auto add = [&](MatchEventKind kind, double time, const char* detail) {
      MatchEvent event;
      event.kind = kind;
      event.time = time;
      event.robot = uidOf(blue(1));
      event.name = "B1";
      event.process = "localization";
      event.detail = detail;
      content.events.push_back(event);
    };
    add(MatchEventKind::ProcessDied, 5.0, "signal 11 (Segmentation fault); last output: <oh>");
    add(MatchEventKind::ProcessRestarted, 5.5, "");
    add(MatchEventKind::ProcessNotResponding, 20.0, "no cycle done for 5 s");
    add(MatchEventKind::ProcessGivenUp, 40.0, "");
    const QString html = QString::fromStdString(reportHtml(content));
    QString rest = html.section("<h2>Events</h2>", 1);
    for (const char* reported :
         {"0:05.0", "B1 localization died: signal 11 (Segmentation fault)",
          "last output: &lt;oh&gt;", "0:05.5", "B1 localization started again", "0:20.0",
          "B1 localization stopped responding: no cycle done for 5 s", "0:40.0",
          "B1 localization is no longer restarted"}) {
      const auto at = rest.indexOf(reported);
      QVERIFY2(at >= 0, qPrintable(QString(reported) + " not after the one before in " + rest));
      rest = rest.mid(at);
    }
  }

  void nothingRecordedIsAReportToo() {
    const telemetry::SeriesStore empty;
    ReportContent content;
    content.statistics = statisticsOf(empty, {0.0, 0.0});
    const QString html = QString::fromStdString(reportHtml(content));
    QVERIFY(html.contains("No robot was recorded.") && html.contains("Match report"));
    QVERIFY(!html.contains("nan"));
  }

  /// A browser sorts its tables, and nothing is wider than a phone.
  void aBrowserShowsIt() {
    const QString browser = QStandardPaths::findExecutable(QStringLiteral("chromium"));
    if (browser.isEmpty()) QSKIP("needs the program chromium");
    ReportContent content;
    content.statistics = m_statistics;
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("report.html"));
    QFile page(path);
    QVERIFY(page.open(QIODevice::WriteOnly));
    page.write(QByteArray::fromStdString(reportHtml(content)) +
               "<script>const way = document.querySelectorAll('table.sorts th')[1]; way.click();"
               "const cells = [...way.closest('table').tBodies[0].rows].map(r => "
               "r.cells[1].textContent);"
               "document.title = [cells.join(';'), document.documentElement.scrollWidth, "
               "window.innerWidth].join('|');</script>");
    page.close();
    QProcess process;
    process.start(browser,
                  {QStringLiteral("--headless"), QStringLiteral("--no-sandbox"),
                   QStringLiteral("--disable-gpu"), QStringLiteral("--window-size=500,800"),
                   QStringLiteral("--user-data-dir=") + folder.path(), QStringLiteral("--dump-dom"),
                   QStringLiteral("file://") + path});
    if (!process.waitForFinished(60'000) || process.exitCode() != 0) QSKIP("chromium cannot run");
    const QString dom = QString::fromUtf8(process.readAllStandardOutput());
    const qsizetype begin = dom.indexOf(QStringLiteral("<title>")) + 7;
    const QStringList told =
        dom.mid(begin, dom.indexOf(QStringLiteral("</title>")) - begin).split(QLatin1Char('|'));
    QCOMPARE(told.size(), 3);
    std::vector<double> ways;
    for (const QString& cell : told[0].split(QLatin1Char(';'))) {
      ways.push_back(cell.split(QLatin1Char(' ')).front().toDouble());
    }
    QCOMPARE(ways.size(), m_statistics.robots.size());
    QVERIFY(std::ranges::is_sorted(ways) && ways.front() < ways.back());
    QVERIFY(told[1].toInt() <= told[2].toInt());
  }
};

PITCHBOARD_TEST(TestReport)

}  // namespace tst_report

#include "tst_report.moc"
