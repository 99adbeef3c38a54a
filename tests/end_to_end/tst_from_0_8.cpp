// SPDX-License-Identifier: GPL-3.0-or-later
// What 0.8 wrote is read on: sessions, exact states, settings, layouts, scenarios and situations,
// with the numbers that 0.8 itself showed for them. The files in tests/data/0.8 are made by 0.8's
// own recorders and its studio.

#include <zlib.h>

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSettings>
#include <QtTest>
#include <cmath>

#include <robotlink/experiment/experiment.h>
#include <robotlink/match/simulated_match.h>
#include <robotlink/session/moment_reader.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/session_events.h>
#include <telemetry/session/session_reader.h>

#include "studio_program.h"

namespace tst_from_0_8 {

using namespace pitchboard;
using namespace pitchboard::link;
using telemetry::SessionReader;
using telemetry::SessionStream;

namespace {

const QString data = QStringLiteral(PITCHBOARD_TEST_DATA) + QStringLiteral("/0.8/");
constexpr int longWait = 40'000;  // ms, on a machine that is busy otherwise

QByteArray unpacked(const QString& path) {
  QByteArray bytes;
  const gzFile file = gzopen(path.toLocal8Bit().constData(), "rb");
  if (file == nullptr) return bytes;
  QByteArray part(1 << 16, '\0');
  for (int count = 0; (count = gzread(file, part.data(), unsigned(part.size()))) > 0;) {
    bytes.append(part.constData(), count);
  }
  gzclose(file);
  return bytes;
}

std::uint64_t rowsIn(const SessionReader& session) {
  std::uint64_t rows = 0;
  session.rows({-1e9, 1e9}, {}, [&rows](telemetry::GroupId, const telemetry::RowView&) {
    ++rows;
    return true;
  });
  return rows;
}

/// What 0.8 showed of a robot. The place tells which robot it is.
struct Shown {
  int number;
  double x, y;
  int action;
  const char* ownName = "";
};

/// The robots of a frame, each found by its number and place.
QByteArray missing(const MatchFrame& frame, const std::vector<Shown>& shown) {
  for (const Shown& wanted : shown) {
    const auto found = std::ranges::find_if(frame.robots, [&wanted](const RobotFrame& robot) {
      return robot.identity.number == wanted.number &&
             std::hypot(robot.pose.position.x - wanted.x, robot.pose.position.y - wanted.y) < 0.011;
    });
    const QByteArray name = QByteArray::number(wanted.number) + " at " +
                            QByteArray::number(wanted.x) + " " + QByteArray::number(wanted.y);
    if (found == frame.robots.end()) return "no robot " + name;
    if (found->ownName != wanted.ownName) return "other name: " + name;
    if (found->decided && *found->decided != wanted.action) return "other action: " + name;
  }
  return {};
}

}  // namespace

class TestFrom08 : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;

  /// The file itself, or without its end, as a program that was killed leaves it.
  std::string file(const QString& name, double part = 1.0) {
    const QByteArray bytes = unpacked(data + name + QStringLiteral(".mcap.gz"));
    const QString path = m_folder.filePath(QStringLiteral("%1-%2.mcap").arg(name).arg(part));
    QFile out(path);
    if (!out.exists() && out.open(QIODevice::WriteOnly)) {
      out.write(bytes.left(qsizetype(double(bytes.size()) * part)));
    }
    return path.toStdString();
  }

 private slots:
  void sessionsOpen_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<int>("rows");
    QTest::addColumn<int>("datagrams");
    QTest::addColumn<int>("events");
    QTest::addColumn<double>("end");
    QTest::newRow("no team setups") << QStringLiteral("live_plain") << 121 << 86 << 15 << 6.944;
    QTest::newRow("team setups in mid-match")
        << QStringLiteral("live_midway") << 233 << 176 << 18 << 10.848;
    QTest::newRow("team setups") << QStringLiteral("live_setups") << 246 << 163 << 16 << 11.008;
    QTest::newRow("refereed match") << QStringLiteral("match") << 4 * 373 << 0 << 11 << 62.0;
  }
  void sessionsOpen() {
    QFETCH(QString, name);
    const auto session = SessionReader::open(file(name));
    QVERIFY(session && session->complete() && session->notes().empty());
    QTEST(int(rowsIn(*session)), "rows");
    QTEST(int(session->count(SessionStream::Telemetry)), "datagrams");
    QTEST(int(eventsOf(*session).size()), "events");
    QTEST(std::round(session->range()->end * 1000) / 1000, "end");
  }

  void sessionsOpenWithoutTheirEnd_data() {
    QTest::addColumn<QString>("name");
    for (const char* name : {"live_plain", "live_midway", "live_setups", "match"}) {
      QTest::newRow(name) << QString::fromLatin1(name);
    }
  }
  void sessionsOpenWithoutTheirEnd() {
    QFETCH(QString, name);
    const auto whole = SessionReader::open(file(name));
    const auto session = SessionReader::open(file(name, 0.5));
    QVERIFY(whole && session && !session->complete());
    QVERIFY(rowsIn(*session) > rowsIn(*whole) / 5 && rowsIn(*session) <= rowsIn(*whole));
    RecordedFrames frames(backdropOf(*session)), all(backdropOf(*whole));
    const double time = session->range()->end * 0.5;
    const MatchFrame frame = frames.frameAt(*session, time), same = all.frameAt(*whole, time);
    QVERIFY(!frame.robots.empty());
    QCOMPARE(frame.robots.size(), same.robots.size());
    for (std::size_t i = 0; i < frame.robots.size(); ++i) {
      QVERIFY(frame.robots[i].pose == same.robots[i].pose);
    }
    QCOMPARE(frame.game.has_value(), same.game.has_value());
  }

  void liveMomentsAreThoseThat08Showed_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<double>("time");
    QTest::addColumn<QString>("referee");
    QTest::addColumn<std::vector<Shown>>("shown");
    using Robots = std::vector<Shown>;
    QTest::newRow("plain, 0.5 s") << QStringLiteral("live_plain") << 0.5 << QString()
                                  << Robots{{1, -3.44, 0.97, 8}};
    QTest::newRow("plain, 3 s") << QStringLiteral("live_plain") << 3.0 << QString()
                                << Robots{{1, -2.96, 0.96, 8},
                                          {2, -0.96, -0.04, 3},
                                          {3, 1.04, -1.04, 1},
                                          {4, 3.04, -2.04, 11},
                                          {5, 2.04, 1.96, 12}};
    // Two programs send as robot 3.
    QTest::newRow("plain, 5.5 s") << QStringLiteral("live_plain") << 5.5 << QStringLiteral("READY")
                                  << Robots{{1, -2.42, 1.08, 8},  {2, -0.96, -0.04, 3},
                                            {3, 1.58, -0.92, 4},  {3, 4.58, 2.08, 6},
                                            {4, 3.58, -1.92, 11}, {5, 2.58, 2.08, 12}};
    QTest::newRow("before the setups")
        << QStringLiteral("live_midway") << 5.0 << QStringLiteral("READY")
        << Robots{{1, -2.54, 1.10, 8}, {2, -0.54, 0.10, 3},  {3, 1.46, -0.90, 1},
                  {3, 4.46, 2.10, 6},  {4, 3.46, -1.90, 11}, {5, 2.46, 2.10, 12}};
    QTest::newRow("behind the setups")
        << QStringLiteral("live_midway") << 9.0 << QStringLiteral("PLAYING")
        << Robots{{1, -1.76, 0.94, 8, "Ana"},
                  {2, 0.24, -0.06, 3, "Bia"},
                  {3, 2.24, -1.06, 4},
                  {4, 4.24, -2.06, 11},
                  {5, 3.24, 1.94, 12}};
    QTest::newRow("setups, 0.2 s")
        << QStringLiteral("live_setups") << 0.2 << QString() << Robots{{1, -3.50, 1.00, 8, "Ana"}};
    // The guests write a text of their own. 0.8 showed a blackboard that nobody had written, of
    // robot 6, in the corner of the field.
    QTest::newRow("setups, 5 s") << QStringLiteral("live_setups") << 5.0 << QStringLiteral("READY")
                                 << Robots{{1, -2.54, 1.10, 8, "Ana"}, {2, -0.54, 0.10, 3, "Bia"},
                                           {3, 1.46, -0.90, 1},        {3, 4.46, 2.10, 6},
                                           {1, 2.518, 0.50, 1},        {2, 3.518, 1.00, 2}};
    QTest::newRow("setups, 10.5 s")
        << QStringLiteral("live_setups") << 10.5 << QStringLiteral("PLAYING")
        << Robots{{1, -1.46, 1.08, 8, "Ana"},
                  {2, -0.12, -0.05, 3, "Bia"},
                  {3, 2.54, -0.92, 4},
                  {1, 1.977, 0.50, 1},
                  {2, 2.977, 1.00, 2}};
  }
  void liveMomentsAreThoseThat08Showed() {
    QFETCH(QString, name);
    QFETCH(double, time);
    QFETCH(QString, referee);
    QFETCH(std::vector<Shown>, shown);
    const auto session = SessionReader::open(file(name));
    QVERIFY(session);
    RecordedFrames frames(backdropOf(*session));
    const MatchFrame frame = frames.frameAt(*session, time);
    QCOMPARE(missing(frame, shown), QByteArray());
    QVERIFY(!frame.truthKnown && !frame.ballKnown);
    QCOMPARE(frame.game.has_value(), !referee.isEmpty());
    if (frame.game) {
      QCOMPARE(QString::fromStdString(std::string(labelOf(frame.game->state))), referee);
      QCOMPARE(frame.game->teamAt(false).number, 12);
      QCOMPARE(frame.game->teamAt(false).colour, TeamColor::Red);
      QCOMPARE(frame.game->teamAt(true).number, 18);
      QCOMPARE(frame.game->teamAt(true).playing(), 4);
    }
    QCOMPARE(frame.drawings.size(), std::size_t(name == QStringLiteral("live_plain") ? 0 : 1));
  }

  void aRefereedMatchIsAsItWas() {
    const auto session = SessionReader::open(file(QStringLiteral("match")));
    QVERIFY(session);
    RecordedFrames frames(backdropOf(*session));
    const auto at = [&](double time) { return frames.frameAt(*session, time); };
    MatchFrame frame = at(12.0);
    QCOMPARE(
        missing(frame, {{1, -1.5609, 1.3983, 1}, {2, -3.7685, 0.0384, 0}, {1, 1.9765, 2.0419, 0}}),
        QByteArray());
    QVERIFY(frame.game && frame.truthKnown && frame.ballKnown);
    QCOMPARE(frame.game->state, PlayState::Playing);
    QCOMPARE(frame.game->teamAt(false).playing(), 2);
    frame = at(31.0);
    QCOMPARE(
        missing(frame, {{1, 0.5525, -0.1593, 8}, {2, -3.7828, 0.0348, 0}, {1, 1.3302, 1.2211, 11}}),
        QByteArray());
    QVERIFY(std::abs(frame.snapshot.ball.x - 1.03) < 1e-3);
    QVERIFY(frame.robots[1].penalty);
    QCOMPARE(frame.robots[1].penalty->kind, PenaltyKind::Incapable);
    QCOMPARE(frame.game->teamAt(false).playing(), 1);
    frame = at(43.0);
    QCOMPARE(frame.game->setPlay(), SetPlay::CornerKick);
    QVERIFY(frame.robots[1].penalty);
    frame = at(60.0);
    QCOMPARE(frame.game->state, PlayState::Ready);
    QCOMPARE(frame.game->teamAt(false).score, 1);
    QCOMPARE(frame.game->teamAt(true).score, 0);
  }

  void anExactStateOf08IsEnteredAgain() {
    const auto session = SessionReader::open(file(QStringLiteral("match")));
    QVERIFY(session);
    const auto scenario = session->attachment("scenario.json");
    QVERIFY(scenario);
    auto match =
        SimulatedMatch::create(*scenarioFromJson(*scenario, "scenario.json"), MatchOptions{});
    QVERIFY(match);
    RecordedFrames frames(backdropOf(*session));
    for (const double time : {12.0, 31.0, 43.0, 60.0}) {
      const auto moment = momentFromSession(*session, time, VariableCatalog::published());
      QVERIFY2(moment, moment ? "" : moment.error().text().c_str());
      QCOMPARE(moment->state.tick, std::uint64_t(time * 6));
      const auto entered = match->restore(*moment);
      QVERIFY2(entered, entered ? "" : entered.error().text().c_str());
      const MatchFrame frame = frames.frameAt(*session, time);
      const sim::Snapshot now = match->simulation().snapshot();
      QCOMPARE(now.robots.size(), std::size_t(3));
      for (std::size_t i = 0; i < 3; ++i) {
        const Point here = now.robots[i].pose.position, there = frame.robots[i].pose.position;
        QVERIFY(std::hypot(here.x - there.x, here.y - there.y) < 1e-4);
      }
      QVERIFY(match->simulation().state().game.has_value());
      for (int i = 0; i < 6; ++i) match->tick();
    }
  }

  void scenariosAndSituationsLoad() {
    for (const char* name : {"scenario.json", "moment.json"}) {
      const auto scenario = loadScenario((data + QLatin1String(name)).toStdString());
      QVERIFY2(scenario, scenario ? "" : scenario.error().text().c_str());
      QCOMPARE(scenario->robots.size(), std::size_t(3));
      QVERIFY(SimulatedMatch::create(*scenario, MatchOptions{}));
    }
    const auto situation = loadExperiment((data + QStringLiteral("situation.json")).toStdString());
    QVERIFY2(situation, situation ? "" : situation.error().text().c_str());
  }

  /// The studio starts with them and writes them again when it ends.
  void settingsAreKept() {
    const QString path = m_folder.filePath(QStringLiteral("s.ini"));
    QVERIFY(QFile::copy(data + QStringLiteral("settings.ini"), path));
    const QSettings before(data + QStringLiteral("settings.ini"), QSettings::IniFormat);
    studio_program::Studio studio(m_folder);
    QVERIFY(studio.launch({QStringLiteral("--cognition"), QStringLiteral("inline"),
                           QStringLiteral("--screenshot-to"),
                           m_folder.filePath(QStringLiteral("s.png"))}));
    QVERIFY(studio.waitForFinished(longWait));
    const QByteArray output = studio.readAllStandardError();
    QVERIFY2(studio.exitCode() == 0, output);
    QVERIFY2(!output.contains("plots"), output);
    const QSettings after(path, QSettings::IniFormat);
    const auto curvesOf = [](const QSettings& settings) {
      QList<qsizetype> counts;
      const QByteArray text = settings.value(QStringLiteral("plots/layout")).toByteArray();
      const QJsonObject layout = QJsonDocument::fromJson(text).object();
      for (const auto tab : layout[QLatin1String("tabs")].toArray()) {
        for (const auto plot : tab.toObject()[QLatin1String("plots")].toArray()) {
          counts << plot.toObject()[QLatin1String("curves")].toArray().size();
        }
      }
      return counts;
    };
    QCOMPARE(curvesOf(before), (QList<qsizetype>{4, 2, 1}));
    QCOMPARE(curvesOf(after), curvesOf(before));
    for (const char* key : {"variables/favourites", "field/hiddenDrawings", "cards/values"}) {
      QCOMPARE(after.value(QLatin1String(key)).toStringList().size(),
               before.value(QLatin1String(key)).toStringList().size());
    }
  }
};

PITCHBOARD_TEST(TestFrom08)

}  // namespace tst_from_0_8

#include "tst_from_0_8.moc"
