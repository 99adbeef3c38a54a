// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions over the rows of sessions: moments and stretches worked out on paper, and a search
// that skips what summaries rule out against one that reads every row.
#include <QtTest>
#include <cmath>
#include <fstream>

#include <telemetry/query/find_moments.h>
#include <telemetry/query/session_query.h>
#include <telemetry/query/stretch.h>
#include <telemetry/query/stretch_table.h>

#include "comparisons.h"
#include "session_rig.h"

namespace tst_query {

using namespace pitchboard;
using namespace pitchboard::telemetry;
using namespace pitchboard::telemetry::rig;

namespace {

GroupInfo plainGroup(const std::string& name, int number) {
  GroupInfo group{
      name,
      {{"SEEN", ColumnType::Int32, "", "", ColumnKind::Flag, {}},
       {"DIST", ColumnType::Float64, "cm", "", ColumnKind::Number, {}, 0.0, {{"SEEN", 0.0}}},
       {"odd name", ColumnType::Float64, "m", "", ColumnKind::Number, {}}},
      {}};
  if (number > 0) group.robot = facts({{"robot", std::to_string(number)}, {"team", "blue"}});
  return group;
}

std::string writtenTo(const std::string& path, const std::function<void(SessionWriter&)>& fill) {
  auto writer = SessionWriter::create(path, sessionInfo());
  if (!writer) qFatal("%s", writer.error().text().c_str());
  fill(**writer);
  if (!(*writer)->finish()) qFatal("not written");
  return path;
}

std::string text(const FoundMoment& moment) {
  char out[160];
  std::snprintf(out, sizeof out, "%s %.3f-%.3f", moment.robot.c_str(), moment.range.begin,
                moment.range.end);
  std::string line = out;
  if (moment.value) {
    std::snprintf(out, sizeof out, " %g at %.3f", *moment.value, moment.valueAt);
    line += out;
  }
  return line;
}

std::vector<FileMoments> found(const std::vector<std::string>& files, FindOptions options) {
  std::vector<FileMoments> out;
  const auto done = findMoments(files, options, [&](std::size_t, FileMoments&& one) {
    out.push_back(std::move(one));
    return true;
  });
  if (!done) qFatal("%s", done.error().text().c_str());
  return out;
}

/// The rows of a file in memory, as the studio has them.
std::unique_ptr<SeriesStore> inMemory(const SessionReader& session) {
  auto store = std::make_unique<SeriesStore>();
  for (const SessionGroup& group : session.groups()) store->addGroup(group.info);
  session.rows({-1e9, 1e9}, {}, [&](GroupId group, const RowView& row) {
    store->append(group, row);
    return true;
  });
  return store;
}

QStringList lines(const FileMoments& of) {
  QStringList out;
  for (const FoundMoment& moment : of.moments) out << QString::fromStdString(text(moment));
  return out;
}

QStringList linesOf(const std::string& file, const std::string& condition, double least = 0.0,
                    const std::vector<std::string>& robots = {}) {
  return lines(found({file}, {{{condition, least, robots}}, 1}).front());
}

}  // namespace

class TestQuery : public QObject {
  Q_OBJECT

  NewSessions m_sessions;
  std::string m_small, m_long;

 private slots:
  void initTestCase() {
    // B1 ten times a second: DIST 0, 10, ... 90 and again; it is not seen from 1.5 s to 1.9 s.
    // B2: always 50. The match's DIST is 1 from 0.95 s on, and its rows end at 1.95 s.
    m_small = writtenTo(m_sessions.newPath(), [](SessionWriter& writer) {
      writer.addGroup(plainGroup("B1", 1));
      writer.addGroup(plainGroup("B2", 2));
      writer.addGroup(plainGroup("match", 0));
      for (int i = 0; i < 200; ++i) {
        const double time = i * 0.1;
        const bool isSeen = i < 15 || i > 19;
        append(writer, {0, time, {isSeen ? 1U : 0U}, {i % 10 * 10.0, time}});
        append(writer, {1, time, {1U}, {50.0, -time}});
        if (i < 20) append(writer, {2, time + 0.05, {1U}, {i < 9 ? 0.0 : 1.0, 0.0}});
      }
    });
    // Long enough for summaries; DIST rises slowly, and B1 and B2 differ.
    m_long = writtenTo(m_sessions.newPath(), [](SessionWriter& writer) {
      writer.addGroup(plainGroup("B1", 1));
      writer.addGroup(plainGroup("B2", 2));
      writer.addGroup(plainGroup("match", 0));
      for (int i = 0; i < 60'000; ++i) {
        const double time = i / 60.0;
        const double slow = i / 60.0 + 3.0 * std::sin(i / 7.0);
        append(writer, {0, time, {i % 977 > 5 ? 1U : 0U}, {slow, 0.1 * (i % 4000)}});
        append(writer, {1, time, {1U}, {1000.0 - slow, std::cos(i / 300.0)}});
        if (i % 7 == 0) append(writer, {2, time + 0.003, {1U}, {std::sin(i / 5000.0), 0.0}});
      }
    });
  }

  void stretchesOnPaper() {
    // 80 and 90 in each second; of the second second nothing is known from 1.5 s on.
    const QStringList high = linesOf(m_small, "B1.DIST > 75");
    QCOMPARE(high.size(), 19);
    QCOMPARE(high[0], QStringLiteral("B1 0.800-1.000 90 at 0.900"));
    QCOMPARE(high[1], QStringLiteral("B1 2.800-3.000 90 at 2.900"));
    QCOMPARE(high.back(), QStringLiteral("B1 19.800-19.900 90 at 19.900"));  // to the last sample
    QCOMPARE(linesOf(m_small, "75 < B1.DIST"), high);
    QCOMPARE(linesOf(m_small, "B1.DIST < 15 && t < 2").join(';'),
             QStringLiteral("B1 0.000-0.200 0 at 0.000;B1 1.000-1.200 0 at 1.000"));
    // Unknown is not true; an unknown value is true only of !known().
    QCOMPARE(linesOf(m_small, "!known(B1.DIST)").join(';'), QStringLiteral("B1 1.500-2.000"));
    QCOMPARE(linesOf(m_small, "!(B1.DIST > 5) && t > 1.2 && t < 2.1").join(';'),
             QStringLiteral("B1 2.000-2.100"));
  }

  void shortStretchesAreLeftOut() {
    QCOMPARE(linesOf(m_small, "B1.DIST > 75", 0.2).size(), 18);  // the last one lasts 0.1 s
    QCOMPARE(linesOf(m_small, "B1.DIST > 75", 0.21).size(), 0);
    QCOMPARE(linesOf(m_small, "B2.DIST == 50", 19.9).join(';'), QStringLiteral("B2 0.000-19.900"));
  }

  void namesWithoutARobotAreOfEach() {
    const QStringList all = linesOf(m_small, "DIST >= 40 && DIST <= 50 && t < 1");
    QCOMPARE(all.join(';'),
             QStringLiteral("B2 0.000-1.000 50 at 0.000;B1 0.400-0.600 50 at 0.500"));
    QCOMPARE(linesOf(m_small, "each.DIST >= 40 && {each/DIST} <= 50 && t < 1"), all);
    QCOMPARE(linesOf(m_small, "DIST >= 40 && DIST <= 50 && t < 1", 0, {"B1"}).size(), 1);
    QCOMPARE(linesOf(m_small, "{each/odd name} < -19.85").join(';'),
             QStringLiteral("B2 19.900-19.900 -19.9 at 19.900"));
  }

  /// The last value before counts, at most 10 s.
  void otherGroupsAreHeld() {
    const QStringList both = linesOf(m_small, "B2.DIST > 1 && match.DIST == 1");
    QCOMPARE(both.join(';'), QStringLiteral("B2 1.000-12.000 50 at 1.000"));
    // The difference, if neither side is a number; the largest at the first sample that has it.
    QCOMPARE(linesOf(m_small, "B2.DIST > B1.DIST && t < 0.65").join(';'),
             QStringLiteral("B2 0.000-0.500 50 at 0.000"));
  }

  void whatIsWrongIsSaid() {
    QVERIFY(!checkQuestion({"DIST >"}));
    QVERIFY(!checkQuestion({"B1.DIST > 1", 0.0, {"B1"}}));
    QVERIFY(checkQuestion({"DIST > 1", 0.0, {"B1"}}));
    const FileMoments none = found({m_small}, {{{"DISTT > 1"}}}).front();
    QCOMPARE(none.error->code, ErrorCode::NotFound);
    QVERIFY2(none.error->message.find("did you mean DIST?") != std::string::npos,
             none.error->message.c_str());
    QCOMPARE(found({m_small}, {{{"B9.DIST > 1"}}}).front().error->code, ErrorCode::NotFound);
    QCOMPARE(found({m_small}, {{{"first.DIST > 1"}}}).front().error->code,
             ErrorCode::InvalidArgument);
    const FileMoments missing = found({m_small + ".not"}, {{{"DIST > 1"}}}).front();
    QVERIFY(missing.error && missing.moments.empty());
  }

  void conditionsAreTakenApart() {
    QCOMPARE(conjunctsOf("(a > 1) && (b < 2 && c == 3)").size(), std::size_t{3});
    QCOMPARE(conjunctsOf("a > 1 && b || c").size(), std::size_t{1});
    QCOMPARE(conjunctsOf("a > 1 ? b && c : d").size(), std::size_t{1});
    QVERIFY(!comparisonOf("a < b < c") && !comparisonOf("a != 3") && !comparisonOf("a || b > 1"));
    QVERIFY(limitsOf("DIST > 1 || DIST < 0").empty());
    QVERIFY(limitsOf("DIST + 1 > 1").empty());
    QVERIFY(limitsOf("!(DIST > 1)").empty());
    const auto limits = limitsOf("3 >= DIST && B1.X == -2e1 && ({B1/odd name} < (4))");
    QCOMPARE(limits.size(), std::size_t{3});
    QCOMPARE(limits[0].variable + limits[0].op, std::string("each/DIST<="));
    QCOMPARE(limits[1].value, -20.0);
    QCOMPARE(limits[2].variable, std::string("B1/odd name"));
  }

  void summariesOnlySkipWhatCannotHold_data() {
    QTest::addColumn<QString>("condition");
    QTest::addColumn<bool>("skips");
    QTest::newRow("a part") << "B1.DIST > 900" << true;
    QTest::newRow("of each") << "DIST > 990" << true;
    QTest::newRow("nowhere") << "DIST > 5000" << true;
    QTest::newRow("exactly") << "DIST == 500" << true;
    QTest::newRow("below") << "B1.DIST <= -1" << true;
    QTest::newRow("both") << "B1.DIST > 300 && 310 > B1.DIST && B1.SEEN == 1" << true;
    QTest::newRow("another group") << "B1.DIST > 5 && match.DIST > 0.99" << false;
    QTest::newRow("two groups") << "B1.DIST > 200 && B2.DIST > 797 && match.DIST < 2" << true;
    QTest::newRow("either") << "DIST > 999 || {each/odd name} > 399" << false;
    QTest::newRow("unknown") << "B1.DIST > 10 && !known(B1.DIST)" << false;
    QTest::newRow("gaps") << "!known(B1.DIST) && {B1/odd name} > 395" << true;
    QTest::newRow("often") << "{B2/odd name} > 0.999" << true;
  }
  void summariesOnlySkipWhatCannotHold() {
    QFETCH(const QString, condition);
    QFETCH(const bool, skips);
    FindOptions options{{{condition.toStdString()}}, 1};
    const FileMoments quick = found({m_long}, options).front();
    QVERIFY2(!quick.error, quick.error ? quick.error->message.c_str() : "");
    options.usesSummaries = false;
    const FileMoments whole = found({m_long}, options).front();
    QCOMPARE(whole.share, 1.0);
    QCOMPARE(lines(quick), lines(whole));
    if (skips) QVERIFY2(quick.share < 0.99, qPrintable(QString::number(quick.share)));
    // Several threads, each with a part of the file.
    for (const unsigned threads : {2U, 5U}) {
      options.threads = threads;
      options.usesSummaries = threads == 5;
      QCOMPARE(lines(found({m_long}, options).front()), lines(whole));
    }
  }

  void manyFilesInTheirOrder() {
    std::vector<std::string> files;
    for (int i = 0; i < 30; ++i) files.push_back(i % 3 == 1 ? m_long : m_small);
    files[4] += ".not";
    const auto all = found(files, {{{"B1.DIST > 995"}}, 4});
    QCOMPARE(all.size(), files.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      QCOMPARE(all[i].error.has_value(), i == 4);
      if (i != 4) QCOMPARE(all[i].moments.empty(), i % 3 != 1);
    }
    std::size_t reports = 0;
    QVERIFY(findMoments(files, {{{"B1.DIST > 5"}}},
                        [&](std::size_t, FileMoments&&) { return ++reports < 3; }));
    QCOMPARE(reports, std::size_t{3});
  }

  void damageIsReported() {
    std::string bytes = bytesOf(m_long);
    const auto whole = McapReader::open(m_long);
    // A part with rows: the summary's parts have one message each.
    const auto& chunks = whole->contents().chunks;
    const auto largest = std::ranges::max_element(chunks, {}, &McapChunkInfo::length);
    for (std::uint64_t i = 0; i < 1000; ++i) bytes[largest->offset + 200 + i] ^= 0x55;
    const std::string path = m_sessions.newPath();
    std::ofstream(path, std::ios::binary) << bytes;
    const FileMoments damaged = found({path}, {{{"B1.DIST > 5"}}, 2}).front();
    QVERIFY2(!damaged.error, damaged.error ? damaged.error->text().c_str() : "");
    QVERIFY(damaged.isDamaged);
    QVERIFY(!damaged.notes.empty());
    QVERIFY(!damaged.moments.empty());
    std::ofstream(path, std::ios::binary) << "no session";
    QVERIFY(found({path}, {{{"B1.DIST > 5"}}}).front().error);
  }

  void stretchesOfSessions() {
    const auto session = SessionReader::open(m_small);
    QVERIFY(session);
    const std::vector<TimeRange> parts{{0.35, 0.65}, {0.95, 1.75}};
    const auto curves =
        readStretch(*session, {{"DIST"}, "B2.DIST > 1 && DIST < 45", {"B1"}}, parts);
    QVERIFY(curves);
    QCOMPARE(curves->size(), std::size_t{1});
    const StretchCurve& b1 = curves->front();
    QCOMPARE(b1.curve.robot, std::string("B1"));
    QCOMPARE(b1.curve.unit, std::string("cm"));
    QCOMPARE(b1.samples.size(), std::size_t{14});  // 0.4 to 1.7 s
    const CurveSummary s = summaryOf(b1.samples, b1.counted);
    QCOMPARE(s.samples, std::uint64_t{6});  // 40, and 0 to 40; unknown ones fail the condition
    QCOMPARE(s.missing, std::uint64_t{0});
    QCOMPARE(s.mean, (40.0 + 0 + 10 + 20 + 30 + 40) / 6);
    const auto known = readStretch(*session, {{"DIST"}, {}, {"B1"}}, parts);
    const CurveSummary all = summaryOf(known->front().samples, known->front().counted);
    QCOMPARE(all.samples, std::uint64_t{8});
    QCOMPARE(all.missing, std::uint64_t{3});  // 1.5, 1.6, 1.7 s
    QCOMPARE(readStretch(*session, {{"DIST / 100"}, {}, {"B1"}}, parts)->front().curve.unit,
             std::string("m"));
    QCOMPARE(readStretch(*session, {{"B1.DIST - B2.DIST"}, {}, {}}, parts)->front().curve.unit,
             std::string("cm"));
    QVERIFY(!readStretch(*session, {{"DIST"}, {}, {"B7"}}, parts));
  }

  void memoryAndFileGiveTheSameTable() {
    for (const std::string& file : {m_small, m_long}) {
      const auto session = SessionReader::open(file);
      const auto store = inMemory(*session);
      const std::vector<TimeRange> parts{{0.35, 1.25}, {1.35, file == m_small ? 15.0 : 900.0}};
      StretchQuestion question;
      for (const char* text : {"DIST", "{each/odd name} * 2", "SEEN", "B1.DIST - B2.DIST",
                               "B1.DIST + match.DIST", "known(DIST)"}) {
        question.texts.push_back({text, text});
      }
      question.against = "{B2/odd name} * 100";
      question.maxDelay = 0.5;
      question.bins = 7;
      question.placeX = "{B1/odd name}";
      question.placeY = "B2.DIST";
      question.grid = {-2000.0, -2000.0, 10.0, 400, 400};
      for (const char* condition : {"", "match.DIST > 0 || B2.DIST > DIST"}) {
        question.condition = condition;
        const auto ofFile = describeStretch(*session, question, parts);
        const auto ofMemory = describeStretch(QueryRows(*store), question, parts);
        QVERIFY2(ofFile && ofMemory, ofFile ? "" : ofFile.error().text().c_str());
        QVERIFY(ofFile->lines.size() > 10);
        QCOMPARE(stretchCsv(ofMemory->lines, true, true), stretchCsv(ofFile->lines, true, true));
        QCOMPARE(ofMemory->problems.size(), ofFile->problems.size());
        QVERIFY(ofMemory->lines.front().map);
        QVERIFY(ofMemory->lines.front().map->counts == ofFile->lines.front().map->counts);
      }
    }
  }

  void aTableSaysWhatItCouldNotDescribe() {
    const auto session = SessionReader::open(m_small);
    const std::vector<TimeRange> all{{0.0, 20.0}};
    StretchQuestion question;
    question.texts = {
        {"DISTT", "DISTT"}, {"DIST +", "DIST +"}, {"DIST", "DIST"}, {"{each/odd name}", "odd"}};
    question.robots = {"B1"};
    question.against = "DIST";
    const auto table = describeStretch(*session, question, all);
    QVERIFY(table);
    QCOMPARE(table->lines.size(), std::size_t{2});
    QCOMPARE(table->lines.front().error->largest, 0.0);
    QVERIFY(!table->lines.back().error);  // m against cm
    QCOMPARE(table->problems.size(), std::size_t{3});
    QVERIFY(table->problems[0].error.message.find("did you mean DIST?") != std::string::npos);
    QVERIFY(table->problems[2].error.message.find("is in m, DIST in cm") != std::string::npos);
    // Progress goes up, and ends it.
    double last = 0.0;
    QVERIFY(describeStretch(*session, question, all, [&](double part) {
      const bool rises = part >= last && part <= 1.0;
      last = part;
      return rises;
    }));
    QCOMPARE(last, 1.0);
    const auto stopped = describeStretch(*session, question, all, [](double) { return false; });
    QVERIFY(!stopped && stopped.error().code == ErrorCode::Conflict);
    question.condition = "NOSUCH > 1";
    QVERIFY(!describeStretch(*session, question, all));
  }

  void valuesByPlace() {
    // 1, 3 in the first square, 5 in the last, one outside, and two that do not count.
    const std::vector<Sample> values{{0, 1}, {1, 3}, {2, 5}, {3, 7}, {4, std::nan("")}, {20, 9}};
    const std::vector<Sample> x{{0, -0.9}, {2, 0.9}, {3, 1.5}, {4, 0.0}};
    const std::vector<Sample> y{{0, -0.9}, {2, 0.1}};
    const ValueMap map = valueMap(values, x, y, {-1.0, -1.0, 1.0, 2, 2});
    QVERIFY(map.counts == (std::vector<std::uint64_t>{2, 0, 0, 1}));
    QCOMPARE(map.means[0], 2.0);
    QCOMPARE(map.means[3], 5.0);
    QVERIFY(std::isnan(map.means[1]));
    QCOMPARE(map.outside, std::uint64_t{1});
  }

  void rangesAreBetweenEvents() {
    const std::string path = writtenTo(m_sessions.newPath(), [](SessionWriter& writer) {
      writer.addGroup(plainGroup("B1", 1));
      for (int i = 0; i < 100; ++i) append(writer, {0, i * 0.1, {1U}, {1.0, 2.0}});
      const auto event = [&](double time, const char* kind, const char* detail) {
        SessionEvent one{time, kind, "", "text"};
        one.facts.emplace().detail = detail;
        writer.append(one);
      };
      event(1.0, "referee", "PLAYING");
      event(2.0, "goal", "");
      event(3.0, "referee", "READY");
      event(4.0, "referee", "PLAYING");
    });
    const auto session = SessionReader::open(path);
    QCOMPARE(*rangesBetween(*session, "referee:PLAYING", "goal"),
             (std::vector<TimeRange>{{1.0, 2.0}, {4.0, session->range()->end}}));
    QCOMPARE(*rangesBetween(*session, "goal", "referee"), (std::vector<TimeRange>{{2.0, 3.0}}));
    QCOMPARE(*rangesBetween(*session, "referee", "referee"),
             (std::vector<TimeRange>{{1.0, 3.0}, {3.0, 4.0}, {4.0, session->range()->end}}));
    const auto none = rangesBetween(*session, "kick", "goal");
    QVERIFY(!none && none.error().message.find("goal, referee") != std::string::npos);
  }
};

PITCHBOARD_TEST(TestQuery)

}  // namespace tst_query

#include "tst_query.moc"
