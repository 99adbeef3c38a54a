// SPDX-License-Identifier: GPL-3.0-or-later
// Rules: their file, the moments at which they are broken, worked out on paper, and the same
// moments in rows that are still coming.
#include <QtTest>
#include <cmath>

#include <telemetry/query/moment_watch.h>
#include <telemetry/query/rules.h>

#include "session_rig.h"

namespace tst_rules {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace pitchboard::telemetry::rig;

namespace {

GroupInfo robotWithDistance(const std::string& name, int number) {
  GroupInfo group{
      name,
      {{"SEEN", ColumnType::Int32, "", "", ColumnKind::Flag, {}},
       {"DIST", ColumnType::Float64, "cm", "", ColumnKind::Number, {}, 0.0, {{"SEEN", 0.0}}}},
      {}};
  if (number > 0) group.robot = facts({{"robot", std::to_string(number)}, {"team", "blue"}});
  return group;
}

/// The rows of the test, ten a second. B1: DIST 0, 10, ... 90 and again, unknown from 1.5 s to
/// 1.9 s; then silent from 6 s to 20 s, and 100 in each row until 21 s. B2, from 2 s on: 100 if the
/// whole second is even, otherwise 0. The match's DIST is 1 from 0.95 s to 1.95 s, then nothing
/// comes.
void play(const std::function<void(const GroupInfo&)>& begin,
          const std::function<void(const RowView&, std::size_t group)>& row) {
  begin(robotWithDistance("B1", 1));
  begin(robotWithDistance("match", 0));
  const auto add = [&row](std::size_t group, double time, bool isSeen, double distance) {
    const std::vector<std::uint32_t> words{isSeen ? 1U : 0U};
    const std::vector<double> values{distance};
    row({time, words, values}, group);
  };
  for (int i = 0; i <= 210; ++i) {
    const double time = i * 0.1;
    if (i == 20) begin(robotWithDistance("B2", 2));
    if (i < 60) add(0, time, i < 15 || i > 19, i % 10 * 10.0);
    if (i >= 200) add(0, time, true, 100.0);
    if (i >= 20) add(2, time, true, i / 10 % 2 == 0 ? 100.0 : 0.0);
    if (i < 20) add(1, time + 0.05, true, i < 9 ? 0.0 : 1.0);
  }
}

const char* const theRules = R"json({"version": 1, "rules": [
  {"name": "far", "text": "Too far", "when": "DIST > 75"},
  {"name": "far_for_long", "when": "DIST > 75", "for": 0.5, "severity": "warning"},
  {"name": "far_B1", "when": "DIST > 75", "for": 0.2, "robots": ["B1"], "severity": "note"},
  {"name": "with_match", "when": "B1.DIST >= 0 && match.DIST == 1"},
  {"name": "unseen", "when": "!known(DIST)"},
  {"name": "missing", "when": "NOSUCH > 1"}
]})json";

std::string text(const Rule& rule, const FoundMoment& moment) {
  char out[160];
  std::snprintf(out, sizeof out, "%s %s %.2f-%.2f", rule.name.c_str(), moment.robot.c_str(),
                moment.range.begin, moment.range.end);
  std::string line = out;
  if (!moment.value) return line;
  std::snprintf(out, sizeof out, " %g at %.2f", *moment.value, moment.valueAt);
  return line + out;
}

QStringList lines(const std::vector<Rule>& rules, const std::vector<FoundMoment>& moments) {
  QStringList out;
  for (const FoundMoment& one : moments) {
    out << QString::fromStdString(text(rules[one.question], one));
  }
  out.sort();
  return out;
}

}  // namespace

class TestRules : public QObject {
  Q_OBJECT

  NewSessions m_sessions;
  std::vector<Rule> m_rules;
  std::string m_file;

  FileMoments inFile() const {
    FileMoments out;
    const auto done = findMoments(std::vector{m_file}, {questionsOf(m_rules), 2},
                                  [&out](std::size_t, FileMoments&& found) {
                                    out = std::move(found);
                                    return true;
                                  });
    if (!done) qFatal("%s", done.error().text().c_str());
    return out;
  }

 private slots:
  void initTestCase() {
    auto rules = rulesFromJson(theRules, "rules.json");
    QVERIFY2(rules, rules ? "" : rules.error().text().c_str());
    m_rules = *rules;
    m_file = m_sessions.newPath();
    auto writer = SessionWriter::create(m_file, sessionInfo());
    QVERIFY(writer);
    play([&](const GroupInfo& group) { (*writer)->addGroup(group); },
         [&](const RowView& row, std::size_t group) {
           (*writer)->append(static_cast<GroupId>(group), row);
         });
    QVERIFY((*writer)->finish());
  }

  void aFileIsRead() {
    QCOMPARE(m_rules.size(), std::size_t{6});
    QCOMPARE(m_rules[0].text, std::string("Too far"));
    QCOMPARE(m_rules[0].severity, RuleSeverity::Error);
    QCOMPARE(m_rules[1].text, std::string("DIST > 75"));
    QCOMPARE(m_rules[1].question.least, 0.5);
    QCOMPARE(m_rules[2].severity, RuleSeverity::Note);
    QCOMPARE(m_rules[2].question.robots, std::vector<std::string>{"B1"});
    QVERIFY(!rulesFromFile("/no/such/rules.json"));
    QVERIFY(!rulesFromFile("/tmp"));
  }

  void mistakesAreNamedWithTheirLine_data() {
    QTest::addColumn<QByteArray>("json");
    QTest::addColumn<QString>("said");
    const auto rule = [](const char* members) {
      return QByteArray("{\"version\": 1, \"rules\": [\n{") + members + "}]}";
    };
    QTest::newRow("empty") << QByteArray() << "r.json:1";
    QTest::newRow("no JSON") << QByteArray("when: x") << "not valid JSON";
    QTest::newRow("a list") << QByteArray("[]") << "r.json:1";
    QTest::newRow("no version") << QByteArray(R"({"rules": []})") << "version";
    QTest::newRow("version 2") << QByteArray(R"({"version": 2, "rules": []})") << "version";
    QTest::newRow("no rules") << QByteArray(R"({"version": 1})") << "rules";
    QTest::newRow("empty list") << QByteArray(R"({"version": 1, "rules": []})") << "has no rule";
    QTest::newRow("numbers") << QByteArray(R"({"version": 1, "rules": [1, 2]})") << "rules[0]";
    QTest::newRow("no name") << rule(R"("when": "DIST > 1")") << "r.json:2: rules[0]";
    QTest::newRow("no condition") << rule(R"("name": "a")") << "when";
    QTest::newRow("odd name") << rule(R"("name": "a-b", "when": "DIST > 1")") << "letters, digits";
    QTest::newRow("no expression") << rule(R"("name": "a", "when": "DIST >")") << "rules[0].when";
    QTest::newRow("no variable") << rule(R"("name": "a", "when": "1 > 0")") << "no variable";
    QTest::newRow("robots twice") << rule(R"("name": "a", "when": "B1.DIST > 1", "robots": ["B1"])")
                                  << "names its robots";
    QTest::newRow("no names") << rule(R"("name": "a", "when": "DIST > 1", "robots": [1])")
                              << "rules[0].robots";
    QTest::newRow("negative") << rule(R"("name": "a", "when": "DIST > 1", "for": -1)")
                              << "rules[0].for";
    QTest::newRow("severity") << rule(R"("name": "a", "when": "DIST > 1", "severity": "fatal")")
                              << "severity \"fatal\"";
    QTest::newRow("unknown key") << rule(R"("name": "a", "when": "DIST > 1", "until": 2)")
                                 << "until";
    QTest::newRow("twice") << QByteArray(R"({"version": 1, "rules": [{"name": "a", "when": "X > 1"},
{"name": "a", "when": "Y > 1"}]})")
                           << "r.json:2: rules[1].name: another rule";
    QTest::newRow("too many") << QByteArray(R"({"version": 1, "rules": [)") +
                                     QByteArray("{\"name\":\"a\",\"when\":\"X\"},").repeated(300) +
                                     R"({"name":"b","when":"X"}]})"
                              << "rules";
    QTest::newRow("deep") << QByteArray("[").repeated(10'000) << "nested deeper";
    QTest::newRow("large") << QByteArray(3'000'000, ' ') << "larger than";
  }
  void mistakesAreNamedWithTheirLine() {
    QFETCH(const QByteArray, json);
    QFETCH(const QString, said);
    const auto rules = rulesFromJson(json.toStdString(), "r.json");
    QVERIFY(!rules);
    const QString error = QString::fromStdString(rules.error().text());
    QVERIFY2(error.contains(said), qPrintable(error));
  }

  void momentsOnPaper() {
    const FileMoments found = inFile();
    const QStringList all = lines(m_rules, found.moments);
    QStringList expected{
        // 80 and 90 in each second but the second one, which is unknown from 1.5 s on.
        QStringLiteral("far B1 0.80-1.00 90 at 0.90"),
        QStringLiteral("far B1 2.80-3.00 90 at 2.90"),
        QStringLiteral("far B1 3.80-4.00 90 at 3.90"),
        QStringLiteral("far B1 4.80-5.00 90 at 4.90"),
        // Nothing follows within 10 s: it ended with its last sample.
        QStringLiteral("far B1 5.80-5.90 90 at 5.90"),
        QStringLiteral("far B1 20.00-21.00 100 at 20.00"),
        QStringLiteral("far_for_long B1 20.00-21.00 100 at 20.00"),
        QStringLiteral("far_B1 B1 0.80-1.00 90 at 0.90"),
        QStringLiteral("far_B1 B1 2.80-3.00 90 at 2.90"),
        QStringLiteral("far_B1 B1 3.80-4.00 90 at 3.90"),
        QStringLiteral("far_B1 B1 4.80-5.00 90 at 4.90"),
        QStringLiteral("far_B1 B1 20.00-21.00 100 at 20.00"),
        QStringLiteral("unseen B1 1.50-2.00"),
        // B1's rows until 1.4 s and from 2 s on; its silence begins at 5.9 s, while the match's
        // value counts until 11.95 s.
        QStringLiteral("with_match B1 1.00-1.50 0 at 1.00"),
        QStringLiteral("with_match B1 2.00-5.90 0 at 2.00"),
    };
    for (int second = 2; second < 21; second += 2) {
      for (const char* rule : {"far", "far_for_long"}) {
        const int end = std::min(second + 1, 21);
        expected << QStringLiteral("%1 B2 %2.00-%3.00 100 at %2.00").arg(rule).arg(second).arg(end);
      }
    }
    // What is worst of B1 >= 0 is its largest value.
    expected.replaceInStrings(QStringLiteral("1.50 0 at 1.00"), QStringLiteral("1.50 40 at 1.40"));
    expected.replaceInStrings(QStringLiteral("5.90 0 at 2.00"), QStringLiteral("5.90 90 at 2.90"));
    expected.sort();
    QCOMPARE(all, expected);
    QVERIFY(!found.error);
    QCOMPARE(found.unanswered.size(), std::size_t{1});
    QCOMPARE(found.unanswered.front().question, std::size_t{5});
    QCOMPARE(found.unanswered.front().error.code, ErrorCode::NotFound);
  }

  /// However the rows are cut into pieces.
  void rowsThatComeGiveTheSame_data() {
    QTest::addColumn<int>("rowsAtOnce");
    for (const int rows : {1, 2, 7, 100, 1000}) QTest::addRow("%d", rows) << rows;
  }
  void rowsThatComeGiveTheSame() {
    QFETCH(const int, rowsAtOnce);
    SeriesStore store;
    MomentWatch watch(questionsOf(m_rules));
    std::vector<FoundMoment> ended;
    const auto advance = [&](double until) {
      QVERIFY(watch.advance(QueryRows(store), until));
      for (FoundMoment& one : watch.takeEnded()) ended.push_back(std::move(one));
    };
    int fresh = 0;
    double newest = 0.0;
    QStringList openAt2035;
    play([&](const GroupInfo& group) { store.addGroup(group); },
         [&](const RowView& row, std::size_t group) {
           store.append(static_cast<GroupId>(group), row);
           // Other rows of this time may follow.
           if (row.time > newest && ++fresh % rowsAtOnce == 0) {
             advance(std::nextafter(row.time, 0.0));
             if (rowsAtOnce == 1 && row.time > 20.35 && openAt2035.isEmpty()) {
               openAt2035 = lines(m_rules, watch.open());
             }
           }
           newest = std::max(newest, row.time);
         });
    advance(newest);
    if (rowsAtOnce == 1) {
      // The rule that allows half a second is not broken yet.
      const QStringList goesOn{QStringLiteral("far B1 20.00-20.30 100 at 20.00"),
                               QStringLiteral("far B2 20.00-20.30 100 at 20.00"),
                               QStringLiteral("far_B1 B1 20.00-20.30 100 at 20.00")};
      QCOMPARE(openAt2035, goesOn);
    }
    for (FoundMoment& one : watch.open()) ended.push_back(std::move(one));
    QCOMPARE(lines(m_rules, ended), lines(m_rules, inFile().moments));
    QCOMPARE(watch.unanswered().size(), std::size_t{1});
  }

  void aTableForOtherPrograms() {
    FoundMoment moment{0, "B1", {1.5, 2.25}, 90.5, 1.75};
    Rule rule{"far", "Too far", {"DIST > 1"}, RuleSeverity::Warning};
    QCOMPARE(brokenRuleCsvHead(),
             std::string("session,rule,severity,robot,from,until,value,value_time\n"));
    QCOMPARE(brokenRuleCsv("a,b.mcap", rule, moment),
             std::string("\"a,b.mcap\",far,warning,B1,1.5,2.25,90.5,1.75\n"));
    moment.value.reset();
    QCOMPARE(brokenRuleCsv("a", rule, moment), std::string("a,far,warning,B1,1.5,2.25,,\n"));
  }
};

PITCHBOARD_TEST(TestRules)

}  // namespace tst_rules

#include "tst_rules.moc"
