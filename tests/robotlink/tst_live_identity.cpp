// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever a referee or an operator corrects, each row stays that of the robot that sent it: in
// memory and in recordings, of messages and of variables, from the first datagram on.

#include <QTemporaryDir>
#include <QtTest>
#include <map>
#include <set>

#include <robotlink/live/live_pipeline.h>
#include <robotlink/live/robot_uids.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/session_choice.h>
#include <telemetry/referee/gamecontroller_encoder.h>
#include <telemetry/series/series_store.h>

#include "../support/group_facts.h"
#include "../support/session_values.h"

namespace tst_live_identity {

using namespace pitchboard;
using namespace pitchboard::link;
using telemetry::Address;
using telemetry::WallTime;

namespace {

constexpr telemetry::TimeRange always{-1e9, 1e9};
constexpr int ours = 12, theirs = 7;

WallTime at(double seconds) {
  return WallTime(
      std::chrono::duration_cast<telemetry::Duration>(std::chrono::duration<double>(seconds)));
}

struct Player {
  int team = 0, number = 0;
  auto operator<=>(const Player&) const = default;
  std::uint32_t address() const {
    return 0x0a00'0000U + static_cast<std::uint32_t>(team) * 256U +
           static_cast<std::uint32_t>(number);
  }
  /// What it says of itself in every row.
  int code() const { return team * 100 + number; }
};

/// Two teams of five that send messages and variables to one pipeline, which is recorded.
class Match {
 public:
  explicit Match(const std::string& path, LiveOptions options = {})
      : pipeline(options, WallTime{}),
        m_memory(std::make_shared<LiveMemory>(store)),
        m_recorder(LiveRecorder::create(path, options, WallTime{}).value()) {
    pipeline.observe(m_memory, WallTime{});
    pipeline.observe(m_recorder, WallTime{});
    for (int team = 0; team < 2; ++team) {
      for (int number = 1; number <= 5; ++number) robots.push_back({team, number});
    }
  }

  void referee(int ourColour) {
    telemetry::RefereeState state;
    state.version = 20;
    state.size = telemetry::refereePacketSize(20).value();
    state.playersPerTeam = 5;
    state.state = 3;
    state.packetNumber = ++m_packet;
    state.teams[0].number = ours;
    state.teams[0].colour = ourColour;
    state.teams[1].number = theirs;
    state.teams[1].colour = 1 - ourColour;
    const std::string bytes = telemetry::encodeReferee(state).value();
    pipeline.take({at(time), {{0x0a00'0a01}, 3838}, 3838, false, bytes});
  }

  /// A tenth of a second: each robot sends, and a frame is made.
  void step(bool sendsVariables = true) {
    for (const Player& robot : robots) {
      ++m_count;
      const std::string message =
          std::to_string(robot.number) + " " + std::to_string(robot.code()) + " " +
          std::to_string(m_count % 600) + " 0 9.5 80 10 1 1 1 1 1 8 0.1 189 OUT";
      pipeline.take({at(time),
                     {{robot.address()}, 5000},
                     static_cast<std::uint16_t>(1240 + robot.number),
                     false,
                     message});
      messages[robot].push_back({time, static_cast<double>(m_count % 600)});
      if (!sendsVariables) continue;
      const auto ms = static_cast<std::uint64_t>(std::lround(time * 1000));
      const std::string variables = "PB2 " + std::to_string(robot.number) + " " +
                                    std::to_string(m_sequence[robot]++) + " " + std::to_string(ms) +
                                    " COM_REFEREE=" + std::to_string(robot.code()) +
                                    " DECISION_ACTION_A=" + std::to_string(m_count) + " OUT";
      pipeline.take({at(time),
                     {{robot.address()}, 6000},
                     static_cast<std::uint16_t>(1340 + robot.number),
                     false,
                     variables});
      variableRows[robot].push_back({time, static_cast<double>(m_count)});
    }
    newest = pipeline.advance(at(time + 0.01));
    for (const RobotFrame& robot : newest.robots) {
      uids[robot.link->sender.address.value].insert(robot.uid);
    }
    time += 0.1;
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }

  /// Two setups, of which one network each is the team's.
  void applySetups() {
    LiveOptions options = pipeline.options();
    for (const int team : {1, 0}) {
      telemetry::TeamSetup& setup = options.team.teams.emplace_back();
      setup.number = team == 0 ? ours : theirs;
      setup.senders = {"10.0." + std::to_string(team) + ".0/24"};
    }
    options.ourTeam = ours;
    pipeline.setOptions(options, at(time));
  }

  void finish() {
    pipeline.stopObserving(m_recorder);
    QVERIFY(m_recorder->finish());
    m_recorder.reset();
  }

  using Rows = std::vector<telemetry::Sample>;
  std::shared_ptr<telemetry::SeriesStore> store = std::make_shared<telemetry::SeriesStore>();
  LivePipeline pipeline;
  std::vector<Player> robots;
  std::map<Player, Rows> messages, variableRows;     // as they were sent
  std::map<std::uint32_t, std::set<RobotUid>> uids;  // by address, of all frames
  MatchFrame newest;
  double time = 1.0;

 private:
  std::shared_ptr<LiveMemory> m_memory;
  std::shared_ptr<LiveRecorder> m_recorder;
  std::map<Player, std::uint32_t> m_sequence;
  int m_count = 0, m_packet = 0;
};

/// What a group has: who said it (in every row), and what.
struct Group {
  telemetry::GroupInfo info;
  std::set<int> codes;
  Match::Rows rows;
};

constexpr const char *messageCode = "LOCALIZATION_X", *messageValue = "LOCALIZATION_Y",
                     *variableCode = "COM_REFEREE", *variableValue = "DECISION_ACTION_A";

std::vector<Group> groupsOf(const telemetry::SeriesStore& store) {
  std::vector<Group> all;
  for (telemetry::GroupId id = 0; id < store.groups(); ++id) {
    const auto view = store.view(id);
    if (view->rows() == 0) continue;
    Group& group = all.emplace_back(Group{view->info(), {}, {}});
    const auto indexOf = [&](const char* name) -> std::optional<std::uint32_t> {
      const auto& columns = group.info.columns;
      const auto found = std::ranges::find(columns, name, &telemetry::ColumnInfo::name);
      if (found == columns.end()) return std::nullopt;
      return static_cast<std::uint32_t>(found - columns.begin());
    };
    for (const auto& [code, value] :
         {std::pair(messageCode, messageValue), {variableCode, variableValue}}) {
      const auto codes = indexOf(code), values = indexOf(value);
      if (!codes || !values) continue;
      Match::Rows said;
      view->samples(*codes, always, said);
      for (const auto& sample : said) group.codes.insert(static_cast<int>(sample.value));
      view->samples(*values, always, group.rows);
    }
  }
  return all;
}

std::vector<Group> groupsOf(const telemetry::SessionReader& session) {
  std::vector<Group> all;
  for (const telemetry::SessionGroup& group : session.groups()) all.push_back({group.info, {}, {}});
  session.rows(always, {}, [&](telemetry::GroupId id, const telemetry::RowView& row) {
    Group& group = all[id];
    const auto& columns = group.info.columns;
    for (const auto& [code, value] :
         {std::pair(messageCode, messageValue), {variableCode, variableValue}}) {
      if (std::ranges::find(columns, code, &telemetry::ColumnInfo::name) == columns.end()) continue;
      group.codes.insert(static_cast<int>(valueOf(group.info, row, columnOf(group.info, code))));
      group.rows.push_back({row.time, valueOf(group.info, row, columnOf(group.info, value))});
    }
    return true;
  });
  return all;
}

/// Every group is of one robot, and every row that a robot sent is there.
void compareRows(const std::vector<Group>& groups, const Match& match, const char* where) {
  std::map<int, std::set<std::string>> uids;
  std::set<std::string> names;
  std::map<std::pair<int, bool>, Match::Rows> found;
  for (const Group& group : groups) {
    QVERIFY2(names.insert(group.info.name).second, group.info.name.c_str());
    QVERIFY2(!group.info.id.empty(), group.info.name.c_str());
    QVERIFY2(group.info.name.find("before") == std::string::npos, group.info.name.c_str());
    if (group.codes.empty()) continue;  // of a link
    QVERIFY2(group.codes.size() == 1, (where + (" " + group.info.name)).c_str());
    const int code = *group.codes.begin();
    uids[code].insert(attributesOf(group.info).at("uid"));
    const bool isVariables = group.info.id.ends_with("variables");
    Match::Rows& rows = found[{code, isVariables}];
    rows.insert(rows.end(), group.rows.begin(), group.rows.end());
  }
  QCOMPARE(uids.size(), match.robots.size());
  std::set<std::string> all;
  for (const auto& [code, of] : uids) {
    QVERIFY2(of.size() == 1, qPrintable(QString("%1: robot %2").arg(where).arg(code)));
    all.insert(*of.begin());
  }
  QCOMPARE(all.size(), match.robots.size());
  for (const Player& robot : match.robots) {
    for (const bool isVariables : {false, true}) {
      const auto& sent = isVariables ? match.variableRows : match.messages;
      const auto wanted = sent.find(robot);
      if (wanted == sent.end()) continue;
      const Match::Rows& rows = found[{robot.code(), isVariables}];
      QCOMPARE(rows.size(), wanted->second.size());
      for (std::size_t i = 0; i < rows.size(); ++i) {
        QVERIFY2(rows[i].value == wanted->second[i].value &&
                     std::abs(rows[i].time - wanted->second[i].time) < 1e-6,
                 qPrintable(QString("%1: robot %2, row %3").arg(where).arg(robot.code()).arg(i)));
      }
    }
  }
}

/// Exporting a robot by its last name takes all of its messages, and nobody else's.
void compareChosen(const telemetry::SessionReader& session, const Match& match,
                   const Player& robot) {
  telemetry::ExportSelection selection;
  selection.robots = {(robot.team == 0 ? "R" : "B") + std::to_string(robot.number)};
  QVERIFY(chooseRobots(session, telemetry::ExportFormat::Mcap, selection));
  constexpr std::array streams{telemetry::SessionStream::LiveState,
                               telemetry::SessionStream::RefereeRaw,
                               telemetry::SessionStream::Telemetry};
  std::size_t kept = 0;
  session.messages(
      streams, session.range().value(),
      [&](telemetry::SessionStream stream, double, std::string_view json) {
        std::string text(json);
        if (!selection.change(stream, text) || stream != telemetry::SessionStream::Telemetry) {
          return true;
        }
        ++kept;
        const auto sender = telemetry::sessionDatagram(text)->sender.address;
        return QTest::qVerify(sender.value == robot.address(), "sender", sender.text().c_str(),
                              __FILE__, __LINE__);
      });
  QCOMPARE(kept, match.messages.at(robot).size());
  // Its events, too, whatever it was called.
  const RobotUid uid = robotNamed(session, selection.robots[0]);
  QVERIFY(match.uids.at(robot.address()).contains(uid));
  for (const telemetry::SessionEvent& event : session.events()) {
    std::string json = sessionEventJson(event);
    const bool isTheirs = event.group.empty() || event.facts->robot == uid;
    QCOMPARE(selection.change(telemetry::SessionStream::Events, json), isTheirs);
  }
}

/// Who sent from an address is one robot in all frames, in Live and in the recording.
void compareUids(const Match& match, const std::string& path) {
  const auto session = telemetry::SessionReader::open(path);
  QVERIFY(session);
  std::set<RobotUid> all;
  for (const auto& [address, uids] : match.uids) {
    QCOMPARE(uids.size(), std::size_t{1});
    all.insert(*uids.begin());
  }
  QCOMPARE(all.size(), match.robots.size());
  RecordedFrames frames;
  // Forwards and backwards: whoever looks back begins at any moment.
  std::vector<double> times;
  for (double time = 1.05; time < match.time; time += 0.31) times.push_back(time);
  for (std::size_t i = times.size(); i > 0; --i) times.push_back(times[i - 1]);
  for (const double time : times) {
    const MatchFrame frame = frames.frameAt(*session, time);
    QCOMPARE(frame.robots.size(), match.robots.size());
    for (const RobotFrame& robot : frame.robots) {
      const std::uint32_t address = robot.link->sender.address.value;
      QVERIFY2(match.uids.at(address).contains(robot.uid),
               qPrintable(QString("%1 s: %2").arg(time).arg(robot.name.c_str())));
    }
  }
}

}  // namespace

class TestLiveIdentity : public QObject {
  Q_OBJECT
  QTemporaryDir m_folder;

  std::string newPath() {
    return m_folder.filePath(QString("%1.mcap").arg(++m_files)).toStdString();
  }
  int m_files = 0;

 private slots:
  /// An operator corrects the colours three times, and somebody applies setups meanwhile.
  void coloursThatAreCorrectedMoveNoRow_data() {
    QTest::addColumn<bool>("setupsFirst");
    QTest::newRow("setups before the match") << true;
    QTest::newRow("setups applied in between") << false;
  }
  void coloursThatAreCorrectedMoveNoRow() {
    QFETCH(bool, setupsFirst);
    const std::string path = newPath();
    Match match(path);
    if (setupsFirst) match.applySetups();
    match.steps(7);
    match.referee(0);
    match.steps(8);
    match.referee(1);
    match.steps(9);
    if (!setupsFirst) match.applySetups();
    match.steps(6);
    match.referee(0);
    match.steps(8);
    const auto nameOf = [&match](std::uint32_t address) {
      for (const RobotFrame& robot : match.newest.robots) {
        if (robot.link->sender.address.value == address) return robot.name;
      }
      return std::string();
    };
    QCOMPARE(nameOf(Player{0, 3}.address()), std::string("B3"));
    QCOMPARE(nameOf(Player{1, 3}.address()), std::string("R3"));
    match.referee(1);
    match.steps(15);
    QCOMPARE(nameOf(Player{0, 3}.address()), std::string("R3"));
    QCOMPARE(nameOf(Player{1, 3}.address()), std::string("B3"));
    QCOMPARE(match.newest.robots.size(), match.robots.size());
    match.finish();
    compareUids(match, path);
    compareRows(groupsOf(*match.store), match, "memory");
    const auto session = telemetry::SessionReader::open(path);
    QVERIFY(session && session->notes().empty());
    compareRows(groupsOf(*session), match, "file");
    // Names, teams and order are those that were known last.
    for (const Group& group : groupsOf(*session)) {
      const auto id = match.store->findGroup(group.info.name);
      QVERIFY2(id, group.info.name.c_str());
      QCOMPARE(match.store->view(*id)->info().id, group.info.id);
      QVERIFY2(match.store->view(*id)->info().robot == group.info.robot, group.info.name.c_str());
      if (!group.info.id.ends_with("messages")) continue;
      const bool isOurs = *group.codes.begin() < 100;
      QCOMPARE(attributesOf(group.info).at("team"), std::string(isOurs ? "red" : "blue"));
    }
    for (const Player robot : {Player{0, 3}, Player{1, 3}}) compareChosen(*session, match, robot);
  }

  /// A second program of a number is the robot of that number once the first one is gone. Each
  /// keeps its own rows, also when the first one comes back, and when one of them is forgotten.
  void aProgramThatTakesAPlaceKeepsItsRows() {
    const std::string path = newPath();
    Match match(path);
    const std::vector<Player> both{{0, 1}, {1, 1}};
    const auto nameOf = [&match](const Player& player) {
      for (const RobotFrame& robot : match.newest.robots) {
        if (robot.link->sender.address.value == player.address()) return robot.name;
      }
      return std::string();
    };
    match.robots = both;
    match.steps(5);
    QCOMPARE(nameOf(both[1]), std::string("Robot 1 (2)"));
    match.robots = {both[1]};
    match.steps(120);
    QCOMPARE(nameOf(both[1]), std::string("Robot 1"));
    // Behind the other one's message: before it, the message might be the other one's from a new
    // address.
    match.robots = {both[1], both[0]};
    match.steps(5);
    QCOMPARE(nameOf(both[0]), std::string("Robot 1 (2)"));
    match.pipeline.forget(match.newest.robot(RobotKey{0, 1, 0})->uid, at(match.time));
    match.robots = both;
    match.steps(5);
    QCOMPARE(nameOf(both[0]), std::string("Robot 1"));
    QCOMPARE(nameOf(both[1]), std::string("Robot 1 (2)"));
    match.finish();
    compareRows(groupsOf(*match.store), match, "memory");
    const auto session = telemetry::SessionReader::open(path);
    QVERIFY(session);
    compareRows(groupsOf(*session), match, "file");
  }

  /// The agent knows its team by nothing but its address.
  void anAgentOfOursIsNoOpponent_data() {
    QTest::addColumn<bool>("oursFirst");
    QTest::addColumn<bool>("variablesFirst");
    QTest::newRow("our setup first, variables first") << true << true;
    QTest::newRow("our setup last, variables first") << false << true;
    QTest::newRow("our setup first, messages first") << true << false;
    QTest::newRow("our setup last, messages first") << false << false;
  }
  void anAgentOfOursIsNoOpponent() {
    QFETCH(bool, oursFirst);
    QFETCH(bool, variablesFirst);
    // Both teams may send from anywhere, here from one computer; their messages have other ports.
    LiveOptions options;
    for (const bool isOurs : {oursFirst, !oursFirst}) {
      telemetry::TeamSetup& setup = options.team.teams.emplace_back();
      setup.number = isOurs ? ours : theirs;
      setup.colour = isOurs ? "blue" : "red";
      setup.firstPort = isOurs ? 1241 : 1301;
      setup.lastPort = setup.firstPort + 10;
    }
    options.ourTeam = ours;
    const std::string path = newPath();
    Match match(path, options);
    const Address here{0x7f00'0001};
    const auto message = [&](int port) {
      match.pipeline.take({at(match.time),
                           {here, static_cast<std::uint16_t>(port + 4000)},
                           static_cast<std::uint16_t>(port),
                           false,
                           "2 450 300 0 9.5 80 10 1 1 1 1 1 8 0.1 189 OUT"});
    };
    std::uint32_t sequence = 0;
    const auto variables = [&] {
      const std::string text = "PB2 2 " + std::to_string(sequence++) + " 9000 VOLTAGE=148 OUT";
      match.pipeline.take({at(match.time), {here, 6000}, 1342, false, text});
    };
    if (variablesFirst) variables();
    match.pipeline.advance(at(match.time += 0.1));
    message(1302);  // theirs
    match.pipeline.advance(at(match.time += 0.1));
    message(1242);
    match.pipeline.advance(at(match.time += 0.1));
    variables();
    const MatchFrame frame = match.pipeline.advance(at(match.time += 0.1));
    QCOMPARE(frame.robots.size(), std::size_t{2});
    QCOMPARE(frame.robots[0].name, std::string("B2"));
    QVERIFY(frame.robots[0].board.names && !frame.robots[1].board.names);
    QVERIFY(!frame.robots[0].values.empty());
    const auto uidOf = [&match](const char* name) {
      const auto group = match.store->findGroup(name);
      return group ? attributesOf(match.store->view(*group)->info()).at("uid")
                   : std::string("none");
    };
    QCOMPARE(uidOf("B2"), uidOf("B2 telemetry"));
    QVERIFY(uidOf("R2") != uidOf("B2"));
    // Setups in another order change no robot.
    const std::string uid = uidOf("B2");
    std::swap(options.team.teams[0], options.team.teams[1]);
    match.pipeline.setOptions(options, at(match.time));
    QCOMPARE(match.pipeline.advance(at(match.time += 0.1)).robots.at(0).name, std::string("B2"));
    variables();
    message(1242);
    QCOMPARE(match.pipeline.advance(at(match.time += 0.1)).robots.size(), std::size_t{2});
    QCOMPARE(uidOf("B2"), uid);
    QCOMPARE(uidOf("B2 telemetry"), uid);
    match.finish();
  }

  /// What the first one said does not become the other one's past.
  void anotherTeamAtTheSamePlaceIsAnotherRobot() {
    const std::string path = newPath();
    LiveOptions options;
    options.team.teams.emplace_back().colour = "blue";
    Match match(path, options);
    match.robots = {{0, 3}};
    match.step(false);
    match.pipeline.forget(match.newest.robots.at(0).uid, at(match.time));
    // The setup is taken away, and later there is one of other visitors.
    options.team.teams.clear();
    match.pipeline.setOptions(options, at(match.time));
    match.pipeline.advance(at(match.time));
    options.team.teams.emplace_back().colour = "blue";
    options.team.teams.back().name = "Visitors";
    match.pipeline.setOptions(options, at(match.time));
    match.robots = {{1, 3}};
    match.step(false);
    match.robots = {{0, 3}, {1, 3}};
    match.finish();
    compareRows(groupsOf(*match.store), match, "memory");
    QVERIFY(match.store->findGroup("B3") && match.store->findGroup("B3 (earlier)"));
    const auto session = telemetry::SessionReader::open(path);
    QVERIFY(session);
    compareRows(groupsOf(*session), match, "file");
  }

  /// A session before 0.23 says nowhere who a robot is: it is then known by its key.
  void aStateWithoutUidsIsRead() {
    Match match(newPath());
    match.robots = {{0, 3}, {1, 3}};
    match.step(false);
    LiveState state(match.pipeline.options());
    const telemetry::DatagramView datagram{at(1.0),
                                           {{0x0a00'0003}, 5000},
                                           1243,
                                           false,
                                           "3 450 300 0 9.5 80 10 1 1 1 1 1 8 0.1 189 OUT"};
    QVERIFY(state.takeRobot(datagram, 1.0) == telemetry::TeamMonitor::Verdict::Used);
    const std::string text = state.text({}, 1.0, WallTime{});
    const auto uidIn = [](const LiveState::Read& read) {
      const auto frame = read.state.frame(read.options, read.state.monitor.status(at(1.0)), 1.0);
      return frame.robots.at(0).uid;
    };
    QCOMPARE(uidIn(LiveState::read(text, WallTime{}).value()), state.uids->withKey({0, 3, 0}));
    const auto kept = text.find("\"uids\"");
    QVERIFY(kept != std::string::npos);
    std::string old = text;
    old.replace(kept, 6, "\"else\"");
    auto read = LiveState::read(old, WallTime{});
    QVERIFY(read && !read->state.uids);
    QCOMPARE(uidIn(*read), uidOf(RobotKey{0, 3, 0}));
    QVERIFY(read->state.takeRobot(datagram, 1.0));
    QVERIFY(LiveState::read(read->state.text({}, 1.0, WallTime{}), WallTime{}));
    match.finish();
  }

  void aRobotHasOneUid() {
    RobotUids uids;
    std::set<RobotUid> received;
    const auto variables = [&](int number, Address sender, int place) {
      return uids.ofVariables(number, sender, place,
                              [&](RobotUid uid) { return received.contains(uid); });
    };
    const Address here{0x0a00'0003}, there{0x0a00'0103};
    const RobotUid one = uids.ofMessages({0, 3, 0}, here);
    QVERIFY(one != RobotUid{});
    const RobotUid second = uids.ofMessages({0, 3, 1}, there);
    QVERIFY(second != one);
    QCOMPARE(variables(3, here, 0), one);
    QCOMPARE(variables(3, there, 0), second);
    QVERIFY(variables(4, here, 0) != one);
    // Setups say who they are.
    uids.rename({{{0, 3, 0}, {1, 3, 0}}, {{0, 3, 1}, {2, 3, 0}}});
    QCOMPARE(uids.ofMessages({1, 3, 0}, here), one);
    QCOMPARE(uids.ofMessages({2, 3, 0}, there), second);
    QCOMPARE(uids.keyOf(second), std::optional(RobotKey{2, 3, 0}));
    QCOMPARE(variables(3, there, 2), second);
    // It gets another address.
    const Address moved{0x0a00'0203};
    QCOMPARE(uids.ofMessages({1, 3, 0}, moved), one);
    QCOMPARE(variables(3, moved, 1), one);
    // A key that another robot gets belongs to that one alone.
    uids.rename({{{2, 3, 0}, {1, 3, 0}}});
    QCOMPARE(uids.ofMessages({1, 3, 0}, there), second);
    QVERIFY(!uids.keyOf(one));
    // A board of this computer is no robot of the network.
    const RobotUid board = uidOfBoard(300);
    QVERIFY(board != one && board != second && board != uidOfBoard(400));
    // An agent without messages gets another address; meanwhile another one may have its number.
    const RobotUid agent = variables(5, here, 1);
    QCOMPARE(variables(5, there, 1), agent);
    received = {agent};
    QVERIFY(variables(5, here, 1) != agent);
    uids.keepOnly({});
    QVERIFY(uids.ofMessages({1, 9, 0}, here) != one);
  }

  void uidsOfInventedRobotsTakeNoMemory() {
    RobotUids uids;
    const Address here{0x0a00'0003};
    const RobotUid real = uids.ofMessages({1, 3, 0}, here);
    const RobotUid first = uids.ofMessages({1, 100, 0}, {0x0b00'0000U});
    for (int i = 0; i < 10'000; ++i) {
      uids.ofMessages({1, 100 + i, 0}, {0x0b00'0000U + static_cast<std::uint32_t>(i)});
      if (i % 500 == 0) QCOMPARE(uids.ofMessages({1, 3, 0}, here), real);
    }
    QVERIFY(!uids.keyOf(first));
    QCOMPARE(uids.ofMessages({1, 3, 0}, here), real);
  }
};

PITCHBOARD_TEST(TestLiveIdentity)

}  // namespace tst_live_identity

#include "tst_live_identity.moc"
