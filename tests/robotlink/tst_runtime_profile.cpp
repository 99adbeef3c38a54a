// SPDX-License-Identifier: GPL-3.0-or-later
// Which processes a robot has: profiles as files, as choices in scenarios, and in matches.
#include <QDir>
#include <QTemporaryDir>
#include <QtTest>
#include <bit>
#include <csignal>
#include <set>

#include <base/file_target.h>
#include <resources/resources.h>
#include <robotlink/cognition/process_registry.h>
#include <robotlink/match/moment.h>
#include <robotlink/match/simulated_match.h>

#include "../support/segment_keys.h"

namespace tst_runtime_profile {

using namespace pitchboard;
using namespace pitchboard::link;

namespace {

MatchOptions separate() {
  MatchOptions options;
  options.cognition = Cognition::Separate;
  options.keyBase = testKeyBase();
  options.robotProgram = PITCHBOARD_BIN "/pitchboard-robot";
  return options;
}

RuntimeChoice choice(const char* text) {
  return runtimeChoiceFromText(text).value();
}

std::vector<std::string> namesOf(const SimulatedMatch& match, int robot) {
  std::vector<std::string> names;
  for (const ProcessStatus& one : match.robots().processes().statuses()) {
    if (one.robot == RobotId{robot}) names.push_back(one.name);
  }
  return names;
}

}  // namespace

class TestRuntimeProfile : public QObject {
  Q_OBJECT
  const int m_base = testKeyBase();

 private slots:
  void cleanup() {
    for (int n = 1; n <= 6; ++n) removeSegment(m_base + 100 * n);
  }

  void theBuiltInOnes() {
    for (const std::string name : {"reference", "own", "published-tree"}) {
      const auto profile = loadRuntime({name, {}, {}});
      QVERIFY2(profile, profile ? "" : profile.error().text().c_str());
      QCOMPARE(profile->name, name);
    }
    const auto reference = loadRuntime({}).value();
    QCOMPARE(reference.processes.size(), referenceProcesses().size());
    for (std::size_t i = 0; i < reference.processes.size(); ++i) {
      QCOMPARE(reference.processes[i].reference, std::string(referenceProcesses()[i].name));
    }
    QVERIFY(loadRuntime({"own", {}, {}}).value().processes.empty());
    const auto tree = loadRuntime(choice("published-tree:folder=/home/x,python=pypy")).value();
    QCOMPARE(tree.values.at("folder"), std::string("/home/x"));
    QCOMPARE(tree.processes[1].command,
             (std::vector<std::string>{"${python}", "decision.py", "-n"}));
  }

  void cyclesAreAnnouncedWhereTheProfileSays() {
    const auto profile = loadRuntime(choice("reference:announce_cycles=decision=460:461"));
    QVERIFY2(profile, profile ? "" : profile.error().text().c_str());
    QCOMPARE(profile->values.at("announce_cycles"), std::string("decision=460:461"));
    const auto wrong = loadRuntime(choice("reference:announce_cycles=decision"));
    QVERIFY(!wrong && wrong.error().message.find("announce_cycles") != std::string::npos);
  }

  void everyKeyIsRead() {
    const auto profile = runtimeProfileFromJson(R"({"version": 1, "name": "team", "title": "Ours",
      "values": {"side": "left"}, "cycle": "MATCH_CYCLE",
      "processes": [{"name": "decide", "command": ["./decide", "--key", "${key}"],
        "directory": "/home/robot", "environment": {"SIDE": "${side}"}, "delay": 0.5,
        "heartbeat": "DECISION_WORKING", "response_timeout": 2, "restart": "on_failure",
        "first_wait": 0.1, "longest_wait": 3, "steady_after": 20, "give_up_after": 5,
        "stop_signal": "INT", "watch_program": true, "only_for": "everyone",
        "clock": "real"}]})",
                                                "team.json");
    QVERIFY2(profile, profile ? "" : profile.error().text().c_str());
    QCOMPARE(profile->cycle, std::string("MATCH_CYCLE"));
    const ProfileProcess& process = profile->processes.front();
    QCOMPARE(process.command.size(), std::size_t{3});
    QCOMPARE(process.directory, std::string("/home/robot"));
    QCOMPARE(process.environment.front().second, std::string("${side}"));
    QCOMPARE(process.delay, 0.5);
    QCOMPARE(process.responseTimeout, 2.0);
    QVERIFY(process.restart.policy == RestartPolicy::OnFailure);
    QCOMPARE(process.restart.giveUpAfter, 5);
    QCOMPARE(process.restart.maxWait.count(), 3.0);
    QCOMPARE(process.stopSignal, SIGINT);
    QVERIFY(process.watchFile && profile->hasOwn());
    QVERIFY(process.clock == ProfileProcess::Clock::Real);
    QVERIFY(ProfileProcess{}.clock == ProfileProcess::Clock::Match);
    QCOMPARE(expanded("a ${x}b${x}", {{"x", "1"}}).value(), std::string("a 1b1"));
    QVERIFY(!expanded("a ${y}", {{"x", "1"}}));
    QVERIFY(!expanded("a ${x", {{"x", "1"}}));
  }

  void readsTheKeyOfVersion08() {
    const auto profile = runtimeProfileFromJson(
        R"({"version": 1, "name": "team", "title": "Ours", "processes":
        [{"name": "decide", "command": ["a"], "heartbeat": "DECISION_WORKING", "silent_after": 3}]})",
        "team.json");
    QVERIFY2(profile, profile ? "" : profile.error().text().c_str());
    QCOMPARE(profile->processes.front().responseTimeout, 3.0);
  }

  void mistakesNameFileLineAndKey_data() {
    QTest::addColumn<QByteArray>("processes");
    QTest::addColumn<QByteArray>("message");
    const auto row = [](const char* name, const char* text, const char* message) {
      QTest::newRow(name) << QByteArray(text) << QByteArray(message);
    };
    row("no name", R"([{"command": ["a"]}])", "team.json:3: processes[0]");
    row("neither", R"([{"name": "a"}])", "team.json:3: processes[0].name: needs either");
    row("both", R"([{"name": "a", "reference": "decision", "command": ["b"]}])",
        "processes[0].command: needs either");
    row("empty program", R"([{"name": "a", "command": [""]}])",
        "processes[0].command: must name a program");
    row("not words", R"([{"name": "a", "command": ["b", 3]}])",
        "processes[0].command[1]: must be a text in quotes");
    row("twice", R"([{"name": "a", "command": ["b"]}, {"name": "a", "command": ["b"]}])",
        "processes[1].name: is listed twice");
    row("key", R"([{"name": "a", "command": ["b"], "restrat": "never"}])",
        "did you mean \"restart\"");
    row("policy", R"([{"name": "a", "command": ["b"], "restart": "nver"}])",
        "processes[0].restart: there is no restart policy \"nver\"; did you mean \"never\"");
    row("signal", R"([{"name": "a", "command": ["b"], "stop_signal": "TREM"}])",
        "processes[0].stop_signal: there is no signal");
    row("time", R"([{"name": "a", "command": ["b"], "response_timeout": 0}])",
        "processes[0].response_timeout: must");
    row("clock", R"([{"name": "a", "command": ["b"], "clock": "rael"}])",
        "processes[0].clock: there is no clock \"rael\"; did you mean \"real\"");
    row("clock of ours", R"([{"name": "a", "reference": "decision", "clock": "real"}])",
        "processes[0].clock: is for a process with \"command\"");
    row("environment", R"([{"name": "a", "command": ["b"], "environment": {"A": 3}}])",
        "processes[0].environment.A");
  }
  void mistakesNameFileLineAndKey() {
    QFETCH(QByteArray, processes);
    QFETCH(QByteArray, message);
    const QByteArray text =
        "{\"version\": 1,\n\"name\": \"team\",\n\"processes\": " + processes + "}";
    const auto profile = runtimeProfileFromJson(text.toStdString(), "team.json");
    QVERIFY(!profile);
    const QByteArray reported = QByteArray::fromStdString(profile.error().text());
    QVERIFY2(reported.contains(message) && reported.startsWith("team.json:3: "),
             reported.constData());
  }

  void choicesAsText_data() {
    QTest::addColumn<QByteArray>("text");
    for (const char* text : {"own", "reference", "team.json", "program=/home/me/decide",
                             "published-tree:folder=/home/robot,python=python3",
                             "reference:program=/home/me/decide"}) {
      QTest::addRow("%s", text) << QByteArray(text);
    }
  }
  void choicesAsText() {
    QFETCH(QByteArray, text);
    const auto read = runtimeChoiceFromText(text.toStdString());
    QVERIFY(read && read->isChosen());
    QCOMPARE(runtimeChoiceToText(*read), text.toStdString());
  }

  void wrongChoices() {
    QVERIFY(!runtimeChoiceFromText("published-tree:folder"));
    // Its values would belong to nothing, and its text would be another choice.
    for (const char* text : {":folder=/home/a:b", ":", "program=", "program=,folder=/home/robot"}) {
      const auto noTeam = runtimeChoiceFromText(text);
      QVERIFY2(!noTeam && noTeam.error().message.find("neither") != std::string::npos, text);
    }
    // Found by fuzz_rules: it was accepted, and did not read back from its own text.
    const QByteArray odd = QByteArray::fromBase64("OiAiAG4Aez3ZOnBhY2tldF9zemUiqP1/AAB0bAo=");
    const auto accepted = runtimeChoiceFromText(odd.toStdString());
    if (accepted) {
      const auto again = runtimeChoiceFromText(runtimeChoiceToText(*accepted));
      QVERIFY(again && *again == *accepted);
    }
    const auto unknown = loadRuntime(choice("owm"));
    QVERIFY2(!unknown && unknown.error().text().find("did you mean \"own\"") != std::string::npos,
             "owm");
    QVERIFY(!loadRuntime(choice("published-tree:flder=/x")));
    QVERIFY(!loadRuntime(choice("/no/such/file.json")));
    const QTemporaryDir dir;
    const std::string program = dir.filePath("chase.py").toStdString();
    QVERIFY(writeFile(program, "print()", IfExists::Refuse).has_value());
    QCOMPARE(loadRuntime(choice(program.c_str())).error().text(),
             program + ": is not a runtime profile; if it is a program, write program=" + program);
    const std::string missing = loadRuntime(choice("no_such_chase.py")).error().text();
    QVERIFY2(missing.ends_with(" If it is a program, write program=./no_such_chase.py"),
             missing.c_str());
    QCOMPARE(runtimeChoiceFromText("program:chase.py").error().text(),
             std::string("write program=chase.py"));
  }

  void scenariosChooseTheRuntime() {
    const auto scenario = scenarioFromJson(R"({"version": 1, "runtime": {"red": "own"}, "robots": [
      {"team": "blue", "number": 1, "x": -1, "y": 0, "runtime": "program=/home/me/decide"},
      {"team": "red", "number": 1, "x": 1, "y": 0},
      {"team": "red", "number": 2, "x": 2, "y": 0, "runtime": "reference"}]})",
                                           "test");
    QVERIFY2(scenario, scenario ? "" : scenario.error().text().c_str());
    QCOMPARE(scenario->runtimeOf(scenario->robots[0]), choice("program=/home/me/decide"));
    QCOMPARE(scenario->runtimeOf(scenario->robots[1]), choice("own"));
    QCOMPARE(scenario->runtimeOf(scenario->robots[2]), choice("reference"));
    const auto again = scenarioFromJson(scenarioToJson(*scenario), "again");
    QVERIFY(again && *again == *scenario);
    for (const auto& [text, where] : std::map<std::string, std::string>{
             {R"({"version": 1, "runtime": {"green": "own"}})", "runtime"},
             {R"({"version": 1, "runtime": {"red": "owm"}})", "runtime.red"},
             {R"({"version": 1,
                  "robots": [{"team": "red", "number": 1, "x": 0, "y": 0, "runtime": "a:b"}]})",
              "robots[0].runtime"}}) {
      const auto wrong = scenarioFromJson(text, "test");
      QVERIFY(!wrong);
      QVERIFY2(wrong.error().text().find(where) != std::string::npos, wrong.error().text().c_str());
    }
  }

  // Whatever stands in the words that belong to others stays there.
  void ownWritesOnlyVisionControlAndImu_data() {
    QTest::addColumn<QString>("physics");
    QTest::newRow("rigid-body") << "rigid-body";
    QTest::newRow("published") << "published";
  }
  void ownWritesOnlyVisionControlAndImu() {
    QFETCH(QString, physics);
    const int key = m_base + 100;
    constexpr std::uint32_t mark = 0x00C0FFEE;
    const VariableCatalog& catalog = VariableCatalog::published();
    std::array<bool, Blackboard::words> theirs{};
    for (const Variable& variable : catalog.variables()) {
      const std::string& n = variable.name;
      const bool simulated =
          n.starts_with("VISION_") || n.starts_with("IMU_") || n.starts_with("CONTROL_") ||
          n == "VOLTAGE" || n == "DECISION_ACTION_A" ||  // control clears what is finished
          n == "DECISION_SEARCH_ON" ||                   // vision clears it when it finds the ball
          (physics == "published" && n == "DECISION_WORKING");
      const int word =
          variable.index + (variable.type == VariableType::Float ? Blackboard::floatOffset : 0);
      if (simulated) theirs[static_cast<std::size_t>(word)] = true;
    }
    QVERIFY(SystemVSegments::create(key));
    {
      auto board = SystemVSegments::open(key, AttachMode::AttachOnly).value();
      for (int word = 0; word < Blackboard::words; ++word) {
        board.write(IntVar{word}, std::bit_cast<std::int32_t>(mark));
      }
      Scenario scenario = loadScenario("one-robot").value();
      scenario.settings.physics = physics.toStdString();
      scenario.writes.clear();
      scenario.robots[0].runtime = choice("own");
      auto match = SimulatedMatch::create(scenario, separate()).value();
      const auto write = [&](const char* name, int value) {
        board.write(*catalog.intVar(name), value);
      };
      for (int i = 0; i < 1200; ++i) {
        // Walks, kicks, looks for everything, as a decision process would tell it.
        write("DECISION_ACTION_A", (i / 60) % 18);
        write("DECISION_ACTION_B", 10);
        write("DECISION_SEARCH_ON", i % 2);
        write("DECISION_ACTION_VISION", i % 3);
        write("DECISION_LOCALIZATION", (i / 100) % 2);
        write("IMU_RESET", i % 50 == 0 ? 1 : 0);
        match.tick();
        match.pace().lookAfterProcesses(std::chrono::steady_clock::now());
      }
      QVERIFY(match.robots().processes().statuses().empty());
      std::array<std::uint32_t, Blackboard::words> words{};
      board.copyWords(words);
      std::size_t written = 0;
      for (std::size_t word = 0; word < words.size(); ++word) {
        const bool commanded =
            word == static_cast<std::size_t>(catalog.intVar("DECISION_ACTION_B")->index) ||
            word == static_cast<std::size_t>(catalog.intVar("DECISION_ACTION_VISION")->index) ||
            word == static_cast<std::size_t>(catalog.intVar("DECISION_LOCALIZATION")->index);
        if (words[word] == mark || commanded) continue;
        QVERIFY2(theirs[word], qPrintable(QString::number(word)));
        ++written;
      }
      QVERIFY(written > 10);
    }
    QVERIFY(SystemVSegments::remove(key));
  }

  void myRobotAmongReferenceRobots() {
    Scenario scenario = loadScenario("match-3v3").value();
    scenario.robots[1].runtime = choice("own");
    auto match = SimulatedMatch::create(scenario, separate()).value();
    match.tick();
    QVERIFY(namesOf(match, 2).empty());
    for (const int other : {1, 3, 4, 5, 6}) {
      QCOMPARE(namesOf(match, other), (std::vector<std::string>{"localization", "team", "decision",
                                                                "planning", "communication"}));
    }
    QVERIFY(match.robots().ofOthers().empty());
    const auto mine = SystemVSegments::open(m_base + 200, AttachMode::AttachOnly);
    QVERIFY(mine);
    QCOMPARE(match.robots().ofOthers().size(), std::size_t{1});
    QCOMPARE(match.robots().ofOthers().front().name(), std::string("B2"));
    // And back again.
    QVERIFY(match.robots().setRuntime(RobotId{2}, {}));
    QCOMPARE(namesOf(match, 2).size(), std::size_t{5});
    QVERIFY(match.robots().ofOthers().empty());
    match.tick();
  }

  // What the referee says reaches a robot of somebody else as it reaches one of ours.
  void aRobotWithItsOwnProgramsReceivesTheReferee() {
    QTemporaryDir folder;
    QFile file(folder.filePath("hears.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(R"({"version": 1, "name": "hears", "referee": "own", "processes": []})");
    file.close();
    Scenario scenario = loadScenario("match").value();
    scenario.settings.referee->beforeMatch = 1.0;
    scenario.settings.referee->readyTime = 1.0;
    for (ScenarioRobot& robot : scenario.robots) robot.behaviour = std::string(noBehaviour);
    auto inside = SimulatedMatch::create(scenario, {}).value();
    scenario.robots[0].runtime = choice("own");
    scenario.robots[1].runtime.profile = file.fileName().toStdString();
    auto match = SimulatedMatch::create(scenario, separate()).value();
    const IntVar word = match.variables().comReferee;
    std::set<int> given;
    for (int i = 0; i < 60 * 15; ++i) {
      if (i == 60 * 9) {
        const sim::RefereeCall call{.kind = sim::CallKind::SetPlay,
                                    .team = 1,
                                    .setPlay = SetPlay::ThrowIn,
                                    .place = Point{0.0, 3.0}};
        QVERIFY(inside.simulation().call(call) && match.simulation().call(call));
      }
      inside.tick();
      match.tick();
      const int one = match.blackboard(RobotId{1})->read(word);
      QCOMPARE(one, inside.blackboard(RobotId{1})->read(word));
      given.insert(one);
    }
    QCOMPARE(given, (std::set<int>{1, 2, 11, 12}));
    QCOMPARE(match.blackboard(RobotId{2})->read(word), 0);  // its own program would write it
  }

  void aRobotWithoutABehaviourHasNoProcessesOfOurs() {
    Scenario scenario = loadScenario("one-robot").value();
    scenario.robots[0].behaviour = std::string(noBehaviour);
    auto match = SimulatedMatch::create(scenario, separate()).value();
    QVERIFY(namesOf(match, 1).empty());
  }

  void insideAProfileMeansTheSame() {
    QTemporaryDir folder;
    QFile file(folder.filePath("lazy.json"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(R"({"version": 1, "name": "lazy",
                   "processes": [{"name": "team", "reference": "team"}]})");
    file.close();
    Scenario scenario = loadScenario("one-robot").value();
    auto usual = SimulatedMatch::create(scenario, {}).value();
    scenario.robots[0].runtime.profile = file.fileName().toStdString();
    auto lazy = SimulatedMatch::create(scenario, {}).value();
    auto outside = SimulatedMatch::create(scenario, separate()).value();
    for (int i = 0; i < 600; ++i) {
      usual.tick();
      lazy.tick();
      outside.tick();
    }
    QVERIFY(usual.simulation().snapshot().robots[0].statistics.distanceWalked > 0.1);
    QCOMPARE(lazy.simulation().snapshot().robots[0].statistics.distanceWalked, 0.0);
    QCOMPARE(outside.simulation().hash(), lazy.simulation().hash());
    QCOMPARE(namesOf(outside, 1), std::vector<std::string>{"team"});
  }

  void aChangeThatFailsLeavesTheSlotAsItWas_data() {
    using Call = std::function<Result<void>(SimulatedMatch&)>;
    QTest::addColumn<Call>("call");
    QTest::newRow("add") << Call([](SimulatedMatch& match) {
      ScenarioRobot robot = match.scenario().robots[0];
      robot.identity = {RobotId{2}, TeamColor::Red, 4, true};
      return match.robots().add(robot);
    });
    QTest::newRow("behaviour") << Call(
        [](SimulatedMatch& match) { return match.robots().setBehaviour(RobotId{1}, "naive"); });
    QTest::newRow("runtime") << Call([](SimulatedMatch& match) {
      return match.robots().setRuntime(RobotId{1}, match.scenario().robots[0].runtime);
    });
    QTest::newRow("identity") << Call([](SimulatedMatch& match) {
      return match.robots().setIdentity({RobotId{1}, TeamColor::Red, 4, true});
    });
    QTest::newRow("model") << Call([](SimulatedMatch& match) {
      sim::RobotModel other = *match.robots().model(RobotId{1});
      other.radius = 0.1;
      return match.robots().setModel(RobotId{1}, other);
    });
    QTest::newRow("restore") << Call([](SimulatedMatch& match) {
      Moment moment{match.simulation().state(), {{RobotId{1}, "naive", {}}}, nullptr};
      moment.state.tick += 60;
      return match.restore(moment);
    });
  }
  void aChangeThatFailsLeavesTheSlotAsItWas() {
    QFETCH(std::function<Result<void>(SimulatedMatch&)>, call);
    QTemporaryDir folder;
    const QString program = folder.filePath("program");
    const auto write = [](const QString& path, const QByteArray& text) {
      QFile file(path);
      QVERIFY(file.open(QIODevice::WriteOnly));
      file.write(text);
      file.setPermissions(file.permissions() | QFile::ExeOwner);
    };
    write(program, "#!/bin/sh\nexec sleep 600\n");
    write(folder.filePath("two.json"), QByteArray(R"({"version": 1, "name": "two", "processes": [
            {"name": "stays", "command": ["/bin/sleep", "600"], "only_for": "behaviour"},
            {"name": "goes", "command": ["%1"], "only_for": "behaviour"}]})")
                                           .replace("%1", program.toUtf8()));
    Scenario scenario = loadScenario("one-robot").value();
    scenario.robots[0].runtime.profile = folder.filePath("two.json").toStdString();
    auto match = SimulatedMatch::create(scenario, separate()).value();
    match.tick();
    QVERIFY(QFile::remove(program));  // from now on it cannot be started

    const sim::WorldState world = match.simulation().state();
    const RobotSetup before = *match.robots().find(RobotId{1});
    const auto result = call(match);
    QVERIFY(!result);
    QVERIFY2(result.error().text().find("program") != std::string::npos,
             result.error().text().c_str());
    QVERIFY(match.simulation().state() == world);
    QCOMPARE(match.robots().all().size(), std::size_t{1});
    QVERIFY(!SystemVSegments::info(m_base + 200));
    const RobotSetup after = *match.robots().find(RobotId{1});
    QCOMPARE(after.behaviour, before.behaviour);
    QVERIFY(after.choice == before.choice);
    QCOMPARE(after.runtime.name, before.runtime.name);
    QVERIFY(after.processes == before.processes);
    QCOMPARE(namesOf(match, 1), (std::vector<std::string>{"stays", "goes"}));
    QCOMPARE(namesOf(match, 2).size(), std::size_t{0});
    QCOMPARE(match.robots().processes().status(after.processes[0]->id)->state,
             ProcessState::Running);
    match.tick();
  }

  void aProgramRunsAsDecision() {
    QTemporaryDir folder;
    QFile file(folder.filePath("decide"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("#!/bin/sh\necho \"key $1\"\nexec sleep 600\n");
    file.setPermissions(file.permissions() | QFile::ExeOwner);
    file.close();
    Scenario scenario = loadScenario("one-robot").value();
    scenario.robots[0].runtime.decision = file.fileName().toStdString();
    auto match = SimulatedMatch::create(scenario, separate()).value();
    QCOMPARE(namesOf(match, 1),
             (std::vector<std::string>{"localization", "team", "decision", "communication"}));
    const std::string wanted = "key " + std::to_string(m_base + 100);
    const auto reported = [&] {
      match.pace().lookAfterProcesses(std::chrono::steady_clock::now());
      for (const ProcessStatus& one : match.robots().processes().statuses()) {
        if (one.name == "decision" && !one.lastLines.empty()) return one.lastLines.back() == wanted;
      }
      return false;
    };
    QTRY_VERIFY(reported());
    match.tick();
  }

  void theProcessesOfAPublishedFolder() {
    QTemporaryDir folder;
    const QDir root(folder.path());
    const auto make = [&root](const QString& path, const QByteArray& text) {
      QVERIFY(root.mkpath(QFileInfo(path).path()));
      QFile file(root.filePath(path));
      QVERIFY(file.open(QIODevice::WriteOnly));
      file.write(text);
    };
    const QByteArray program =
        "import os, sys, time\n"
        "print(' '.join([os.path.basename(os.path.dirname(os.getcwd()))] + sys.argv), flush=True)\n"
        "time.sleep(600)\n";
    make("AI2/Localization/src/Localization.py", program);
    make("AI2/Decision/src/decision.py", program);
    make("AI2/Communication/src/sending.py", program);
    make("AI2/Communication/src/receiving.py", program);
    Scenario scenario = loadScenario("one-robot").value();
    scenario.robots[0].identity.id = RobotId{2};
    scenario.writes.clear();
    scenario.robots[0].runtime =
        choice(("published-tree:python=python3,folder=" + folder.path()).toUtf8().constData());
    const auto missing = SimulatedMatch::create(scenario, separate());
    QVERIFY(!missing);
    QVERIFY2(missing.error().text().find("config.ini") != std::string::npos,
             missing.error().text().c_str());
    make("AI2/Control/Data/config.ini", "[Communication]\nno_player_robofei = 3\n");
    const auto wrong = SimulatedMatch::create(scenario, separate());
    QVERIFY(!wrong);
    QVERIFY2(
        wrong.error().text().find("says robot 3, whose blackboard is 300") != std::string::npos,
        wrong.error().text().c_str());
    // The published processes have no key base: only match 0 gives them their blackboards.
    MatchOptions options = separate();
    options.keyBase = 0;
    make("AI2/Control/Data/config.ini", "[Communication]\nno_player_robofei = 2\n");
    if (SystemVSegments::info(200)) QSKIP("a robot 2 is played on this computer");
    auto match = SimulatedMatch::create(scenario, options);
    QVERIFY2(match, match ? "" : match.error().text().c_str());
    const auto lines = [&match] {
      match->pace().lookAfterProcesses(std::chrono::steady_clock::now());
      std::set<std::string> all;
      for (const ProcessStatus& one : match->robots().processes().statuses()) {
        if (!one.lastLines.empty()) all.insert(one.lastLines.back());
      }
      return all;
    };
    QTRY_COMPARE(lines(), (std::set<std::string>{
                              "Communication receiving.py", "Communication sending.py",
                              "Decision decision.py -n", "Localization Localization.py -m"}));
  }
};

PITCHBOARD_TEST(TestRuntimeProfile)

}  // namespace tst_runtime_profile

#include "tst_runtime_profile.moc"
