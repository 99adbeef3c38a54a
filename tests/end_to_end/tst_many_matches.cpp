// SPDX-License-Identifier: GPL-3.0-or-later
// Many matches of separate processes on one computer at once: each has a number of its own, robots
// of different matches never hear each other, and each match goes as it goes alone.
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>
#include <set>

#include <robotlink/blackboard/match_number.h>
#include <robotlink/match/simulated_match.h>

namespace tst_many_matches {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

constexpr int matches = 6;

MatchOptions separate() {
  MatchOptions options;
  options.cognition = Cognition::Separate;
  options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
  options.process.particles = 200;
  return options;
}

/// Two against two.
Scenario soccer(std::uint64_t seed) {
  Scenario scenario = loadScenario("match-3v3").value();
  scenario.settings.noise = noisePreset("realistic").value();
  scenario.settings.seed = seed;
  std::erase_if(scenario.robots, [](const ScenarioRobot& r) { return r.identity.number == 3; });
  return scenario;
}

SimulatedMatch make(const Scenario& scenario, const MatchOptions& options) {
  auto match = SimulatedMatch::create(scenario, options);
  if (!match) qFatal("%s", match.error().text().c_str());
  return std::move(*match);
}

}  // namespace

class TestManyMatches : public QObject {
  Q_OBJECT
 private slots:
  void noTwoNumbersShareAKeyOrAPort() {
    std::set<int> keys, ports;
    std::size_t allKeys = 0, allPorts = 0;
    for (int value = 0; value <= MatchNumber::most; ++value) {
      const MatchNumber number{value};
      for (int robot = 1; robot <= 64; ++robot) {
        keys.insert(number.keyBase() + 100 * robot);
        ports.insert(number.telemetryPortBase() + robot);
        ++allKeys, ++allPorts;
      }
      for (const int port : {number.drawingPort(), number.refereePort()}) {
        ports.insert(port);
        ++allPorts;
      }
      for (int team = 1; team <= 4; ++team, ++allPorts) ports.insert(number.teamPortBase() + team);
      for (int team = 0; team <= 99; ++team, ++allPorts) {
        ports.insert(number.channelPortBase() + team);
      }
    }
    QCOMPARE(keys.size(), allKeys);
    QCOMPARE(ports.size(), allPorts);
    QVERIFY(*ports.rbegin() < 32768);  // from there on the system gives them away
  }

  // As a machine with many cores runs tests: the same program many times at once.
  void eachProgramPlaysItsOwnMatch() {
    const QTemporaryDir folder;
    constexpr double seconds = 6.0;
    std::vector<std::uint64_t> wanted;
    std::vector<std::unique_ptr<QProcess>> programs;
    for (int i = 0; i < matches; ++i) {
      Scenario scenario = soccer(static_cast<std::uint64_t>(40 + i));
      scenario.stop = {};
      scenario.stop.duration = seconds;
      QFile file(folder.filePath(QStringLiteral("%1.json").arg(i)));
      QVERIFY(file.open(QIODevice::WriteOnly));
      file.write(QByteArray::fromStdString(scenarioToJson(scenario)));
      file.close();
      programs.push_back(std::make_unique<QProcess>());
      programs.back()->start(
          QStringLiteral(PITCHBOARD_BIN "/pitchboard-cli"),
          {QStringLiteral("simulate"), QStringLiteral("--scenario"), file.fileName(),
           QStringLiteral("--cognition"), QStringLiteral("separate"), QStringLiteral("--speed"),
           QStringLiteral("max"), QStringLiteral("--json")});
      auto inside = make(loadScenario(file.fileName().toStdString()).value(), {});
      while (!inside.finished()) inside.tick();
      wanted.push_back(inside.simulation().hash());
    }
    QCOMPARE(std::set<std::uint64_t>(wanted.begin(), wanted.end()).size(), wanted.size());
    // How many of them play at the same moment is the machine's affair; that those who do have
    // numbers of their own is the next test's.
    for (int i = 0; i < matches; ++i) {
      QProcess& program = *programs[static_cast<std::size_t>(i)];
      QVERIFY(program.waitForFinished(240'000));
      const QByteArray reported = program.readAllStandardError();
      QVERIFY2(program.exitCode() == 0, reported.constData());
      const QJsonObject outcome = QJsonDocument::fromJson(program.readAllStandardOutput()).object();
      QCOMPARE(outcome["state_hash"].toString(),
               QStringLiteral("0x%1").arg(wanted[static_cast<std::size_t>(i)], 16, 16,
                                          QLatin1Char('0')));
    }
  }

  void robotsOfOneMatchNeverReceiveThoseOfAnother() {
    // The last one has a whole team; the others lack robot 2, and would hear it in its place.
    // Running freely they talk by UDP, as on the field.
    std::vector<SimulatedMatch> all;
    std::set<int> numbers, keys;
    for (int i = 0; i < matches; ++i) {
      Scenario scenario = loadScenario("match-3v3").value();
      const bool whole = i == matches - 1;
      std::erase_if(scenario.robots, [whole](const ScenarioRobot& r) {
        return r.identity.team != TeamColor::Blue || (!whole && r.identity.number == 2);
      });
      all.push_back(make(scenario, separate()));
      SimulatedMatch& match = all.back();
      QVERIFY(match.robots().claim().has_value());
      numbers.insert(match.robots().claim()->number().value);
      keys.insert(match.blackboard(RobotId{3})->key());
      QCOMPARE(match.robots().claim()->publishedHolder().empty(),
               match.robots().claim()->number().value == 0);
      match.pace().robotsPace = RobotsPace::Free;
      match.pace().setPlaying(1.0, false, std::chrono::steady_clock::now());
    }
    QCOMPARE(numbers.size(), static_cast<std::size_t>(matches));
    QCOMPARE(keys.size(), static_cast<std::size_t>(matches));
    const VariableCatalog& catalog = all.back().catalog();
    const IntVar first = catalog.intVar("COM_STATE_ROBOT1").value();
    const IntVar second = catalog.intVar("COM_STATE_ROBOT2").value();
    const auto board = [&all](int match) -> const Blackboard& {
      return *all[static_cast<std::size_t>(match)].blackboard(RobotId{3});
    };
    const auto everyEarIsOpen = [&] {
      bool open = board(matches - 1).read(second) == 1;
      for (SimulatedMatch& match : all) {
        match.tick();
        match.pace().lookAfterProcesses(std::chrono::steady_clock::now());
        open = open && match.blackboard(RobotId{3})->read(first) == 1;
      }
      return open;
    };
    QTRY_VERIFY_WITH_TIMEOUT(everyEarIsOpen(), 120'000);
    for (int i = 0; i < 240; ++i) {
      QVERIFY(everyEarIsOpen());
      QTest::qWait(1);
    }
    for (int i = 0; i < matches - 1; ++i) QCOMPARE(board(i).read(second), 0);
  }

  void aNumberOfItsOwnIsRefusedWhenItIsTaken() {
    MatchOptions options = separate();
    auto first = make(loadScenario("one-robot").value(), options);
    options.match = first.robots().claim()->number().value;
    const auto second = SimulatedMatch::create(loadScenario("one-robot").value(), options);
    QVERIFY(!second);
    QVERIFY2(second.error().text().find("is already in use by this program") != std::string::npos,
             second.error().text().c_str());
  }
};

PITCHBOARD_TEST(TestManyMatches)

}  // namespace tst_many_matches

#include "tst_many_matches.moc"
