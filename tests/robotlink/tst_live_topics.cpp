// SPDX-License-Identifier: GPL-3.0-or-later
// Programs that send topics as sources of Live: their robots, with numbers and teams of their own,
// rows, log lines and a referee; times by the shortest delay; channels that come late, go, or begin
// anew under other ids; and what a recording keeps of it.

#include <QTemporaryDir>
#include <QtTest>

#include <cmath>
#include <fstream>

#include <robotlink/live/live_pipeline.h>
#include <robotlink/session/live_recorder.h>
#include <robotlink/session/recorded_frame.h>
#include <telemetry/session/session_reader.h>

namespace tst_live_topics {

using namespace pitchboard;
using namespace pitchboard::link;
using namespace pitchboard::telemetry;

namespace {

constexpr std::int64_t second = 1'000'000'000;
/// The pipeline's 0 s, and by how much the robots' clock is ahead.
constexpr std::int64_t zeroNs = 1'700'000'000 * second, ahead = 3600 * second;
constexpr const char* poseType = "geometry_msgs/msg/PoseWithCovarianceStamped";

WallTime wall(double seconds) {
  return WallTime(Duration(zeroNs + std::llround(seconds * 1e9)));
}

std::string poseJson(double x, double y) {
  return R"({"pose": {"pose": {"position": {"x": )" + std::to_string(x) + R"(, "y": )" +
         std::to_string(y) + R"(, "z": 0}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}}})";
}

FoxgloveChannel jsonChannel(std::uint32_t id, const std::string& topic, const std::string& type) {
  return {id, topic, "json", type, {}, {}};
}

/// Keeps rows, log lines and events.
class Keeper : public RowSink {
 public:
  GroupId addGroup(const GroupInfo& info) override {
    const auto known = std::ranges::find_if(
        groups, [&info](const GroupInfo& group) { return isSameGroup(group, info); });
    const auto id = static_cast<GroupId>(known - groups.begin());
    if (known == groups.end()) groups.emplace_back();
    groups[id] = info;
    return id;
  }
  void append(GroupId group, const RowView& row) override {
    rows[groups[group].name].push_back({row.time, {row.values.begin(), row.values.end()}});
  }

  struct Row {
    double time;
    std::vector<double> values;
  };
  std::vector<GroupInfo> groups;
  std::map<std::string, std::vector<Row>> rows;
  std::vector<MatchEvent> events;
  std::vector<LogLine> lines;
};

class KeptRows : public LiveObserver {
 public:
  std::shared_ptr<Keeper> keeper = std::make_shared<Keeper>();
  std::shared_ptr<RowSink> rows() override { return keeper; }
  void happened(const MatchEvent& event) override { keeper->events.push_back(event); }
  void logged(const LogLine& line) override { keeper->lines.push_back(line); }
};

struct Rig {
  explicit Rig(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) options.foxglove.push_back(*parseFoxgloveSource(text));
    pipeline = std::make_unique<LivePipeline>(options, WallTime(Duration(zeroNs)));
    pipeline->observe(observer, wall(0.0));
  }
  const FoxgloveSource& source(std::size_t i = 0) const { return options.foxglove[i]; }

  TopicRequest begin(const std::vector<FoxgloveChannel>& channels, std::size_t i = 0) {
    pipeline->take(source(i), FoxgloveBegun{++session, "bridge"});
    return pipeline->take(source(i), FoxgloveChannelsAdded{channels});
  }
  void send(std::uint32_t channel, const std::string& payload, double sent, double arrived,
            std::size_t i = 0) {
    const auto logTime = static_cast<std::uint64_t>(zeroNs + ahead + std::llround(sent * 1e9));
    pipeline->take(source(i), FoxgloveReceived{channel, logTime, wall(arrived), payload});
  }
  MatchFrame advance(double time) { return pipeline->advance(wall(time)); }
  Keeper& kept() { return *observer->keeper; }

  LiveOptions options;
  std::shared_ptr<KeptRows> observer = std::make_shared<KeptRows>();
  std::unique_ptr<LivePipeline> pipeline;
  std::uint64_t session = 0;
};

const RobotFrame* named(const MatchFrame& frame, const std::string& name) {
  const auto found = std::ranges::find(frame.robots, name, &RobotFrame::name);
  return found == frame.robots.end() ? nullptr : &*found;
}

}  // namespace

class TestLiveTopics : public QObject {
  Q_OBJECT

 private slots:
  void sourcesAsText() {
    const auto source = parseFoxgloveSource("ws://robot3:9000,robot=5,team=red,map=a b.json");
    QVERIFY(source.has_value());
    QCOMPARE(source->address.text(), std::string("ws://robot3:9000"));
    QCOMPARE(source->robot, 5);
    QCOMPARE(source->team, TeamColor::Red);
    QCOMPARE(source->mappingFile, std::string("a b.json"));
    QCOMPARE(*parseFoxgloveSource(foxgloveSourceText(*source)), *source);
    QCOMPARE(foxgloveSourceText(*parseFoxgloveSource("robot")), std::string("ws://robot:8765"));
    for (const char* bad : {"", "ws://robot,robot=0", "ws://robot,robot=100", "ws://robot,team=x",
                            "ws://robot,map=", "ws://robot,speed=3"}) {
      QVERIFY2(!parseFoxgloveSource(bad), bad);
    }
    QVERIFY(!validate(std::vector<FoxgloveSource>{*parseFoxgloveSource("robot"),
                                                  *parseFoxgloveSource("robot,robot=2")}));
    QVERIFY(!validate(std::vector<FoxgloveSource>{*parseFoxgloveSource("robot,map=/no/file")}));
  }

  void aRobotWithItsRows() {
    Rig rig({"ws://robot3:8765,team=red"});
    const TopicRequest request = rig.begin({jsonChannel(4, "/amcl_pose", poseType),
                                            jsonChannel(6, "/camera", "sensor_msgs/msg/Image"),
                                            {8, "/strange", "xml", "T", {}, {}}});
    // Neither the image nor what is not understood.
    QCOMPARE(request.channels, std::vector<std::uint32_t>{4});
    QCOMPARE(request.session, rig.session);
    rig.send(4, poseJson(1.5, -0.5), 2.0, 2.1);
    const MatchFrame frame = rig.advance(2.2);
    const RobotFrame* robot = named(frame, "R3");  // the number of the host's name
    QVERIFY(robot != nullptr && robot->belief && robot->link);
    QCOMPARE(robot->belief->position.x, 1.5);
    QCOMPARE(robot->belief->position.y, -0.5);
    QVERIFY(!robot->timedOut() && !robot->link->loss);  // TCP: a loss is not known
    QCOMPARE(rig.kept().rows["R3"].size(), std::size_t{1});
    QVERIFY(rig.kept().rows.contains("amcl_pose"));
    const auto received =
        std::ranges::find(rig.kept().events, MatchEventKind::RobotReceived, &MatchEvent::kind);
    QVERIFY(received != rig.kept().events.end());
    QCOMPARE(received->detail, std::string("ws://robot3:8765"));
    const TopicSourceStatus status = rig.pipeline->details(wall(2.2)).topics.front();
    QCOMPARE(status.channels, std::size_t{3});
    QCOMPARE(status.decoded, std::size_t{1});
    QCOMPARE(status.skipped, std::size_t{1});
    QCOMPARE(status.unread.size(), std::size_t{1});
    QVERIFY(status.unread.front().starts_with("/strange: The encoding \"xml\""));
    // It goes offline after the time that Live's settings say.
    QVERIFY(!named(rig.advance(11.0), "R3")->timedOut());
    QVERIFY(named(rig.advance(13.0), "R3")->timedOut());
  }

  /// The delay above the shortest one; times of rows do not tremble with it.
  void timesAreThoseOfTheShortestDelay() {
    Rig rig({"robot1"});
    rig.begin({jsonChannel(1, "/amcl_pose", poseType)});
    const double delays[] = {0.050, 0.002, 0.120, 0.010};
    for (int i = 0; i < 4; ++i) rig.send(1, poseJson(i, 0), 1.0 + i, 1.0 + i + delays[i]);
    rig.advance(6.0);
    const auto& rows = rig.kept().rows["amcl_pose"];
    QCOMPARE(rows.size(), std::size_t{4});
    for (std::size_t i = 1; i < 4; ++i) {  // after the shortest delay
      QVERIFY(std::abs(rows[i].time - (1.002 + static_cast<double>(i))) < 1e-5);
    }
    const TopicSourceStatus status = rig.pipeline->details(wall(6.0)).topics.front();
    QVERIFY(std::abs(status.delay - 0.008) < 1e-5);
    QVERIFY(std::abs(status.clockOffset - (-3600.0 + 0.002)) < 1e-3);
    // What was kept for new subscribers is old: it counts from its arrival, and changes no delay.
    rig.send(1, poseJson(9, 0), -5000.0, 6.5);
    rig.send(1, poseJson(9, 0), 6.6, 6.603);
    rig.advance(7.0);
    QCOMPARE(rig.pipeline->details(wall(7.0)).topics.front().old, std::uint64_t{1});
    QVERIFY(std::abs(rig.kept().rows["amcl_pose"][4].time - 6.5) < 1e-5);
    QVERIFY(std::abs(rig.kept().rows["amcl_pose"][5].time - 6.602) < 1e-5);
  }

  void twoSourcesAreTwoRobots() {
    Rig rig({"ws://10.0.0.1:8765", "ws://10.0.0.2:8765", "ws://10.0.0.3:8765,robot=7"});
    for (std::size_t i = 0; i < 3; ++i) {
      rig.begin({jsonChannel(1, "/amcl_pose", poseType), jsonChannel(2, "/imu", "own/msg/Imu")}, i);
      rig.send(1, poseJson(static_cast<double>(i), 0), 1.0, 1.1, i);
      rig.send(2, R"({"a": 1})", 1.0, 1.1, i);
    }
    const MatchFrame frame = rig.advance(1.2);
    QCOMPARE(frame.robots.size(), std::size_t{3});
    for (const auto& [name, x] : {std::pair("B1", 0.0), {"B2", 1.0}, {"B7", 2.0}}) {
      const RobotFrame* robot = named(frame, name);
      QVERIFY2(robot != nullptr, name);
      QCOMPARE(robot->belief->position.x, x);
    }
    // Groups of one topic have their hosts in their names.
    for (const char* group : {"imu", "imu (10.0.0.2)", "imu (10.0.0.3)"}) {
      QVERIFY2(rig.kept().rows.contains(group), group);
    }
    // A source that is removed takes its robot with it, and comes back as the same one.
    const RobotUid second = named(frame, "B2")->uid;
    LiveOptions fewer = rig.options;
    fewer.foxglove.erase(fewer.foxglove.begin() + 1);
    rig.pipeline->setOptions(fewer, wall(2.0));
    QCOMPARE(rig.advance(2.1).robots.size(), std::size_t{2});
    rig.pipeline->setOptions(rig.options, wall(3.0));
    rig.begin({jsonChannel(1, "/amcl_pose", poseType)}, 1);
    rig.send(1, poseJson(1, 0), 4.0, 4.1, 1);
    QCOMPARE(named(rig.advance(4.2), "B2")->uid, second);
  }

  void channelsComeAndGo() {
    Rig rig({"robot1"});
    rig.begin({jsonChannel(1, "/robot4/amcl_pose", poseType)});
    rig.send(1, poseJson(1, 0), 1.0, 1.1);
    QVERIFY(named(rig.advance(1.2), "B4") != nullptr);
    // A further robot, and a battery of the first one.
    const auto more = rig.pipeline->take(
        rig.source(),
        FoxgloveChannelsAdded{{jsonChannel(2, "/robot2/amcl_pose", poseType),
                               jsonChannel(3, "/robot4/battery", "sensor_msgs/msg/BatteryState")}});
    QCOMPARE(more.channels.size(), std::size_t{2});
    rig.send(2, poseJson(2, 0), 2.0, 2.1);
    rig.send(3, R"({"voltage": 11.5, "percentage": 0.5})", 2.0, 2.1);
    MatchFrame frame = rig.advance(2.2);
    QCOMPARE(named(frame, "B2")->belief->position.x, 2.0);
    QVERIFY(named(frame, "B4")->battery.has_value());
    QVERIFY(std::abs(named(frame, "B4")->battery->volts - 11.5) < 0.01);
    const RobotUid fourth = named(frame, "B4")->uid;
    // A channel that has gone: its messages, late on their way, are of nobody.
    rig.pipeline->take(rig.source(), FoxgloveChannelsRemoved{{2}});
    rig.send(2, poseJson(9, 0), 3.0, 3.1);
    QCOMPARE(named(rig.advance(3.2), "B2")->belief->position.x, 2.0);
    // The server begins anew: id 2 is now another topic.
    rig.pipeline->take(rig.source(), FoxgloveEnded{});
    rig.begin({jsonChannel(2, "/robot4/amcl_pose", poseType)});
    rig.send(2, poseJson(4, 0), 4.0, 4.1);
    frame = rig.advance(4.2);
    QCOMPARE(named(frame, "B4")->uid, fourth);
    QCOMPARE(named(frame, "B4")->belief->position.x, 4.0);
    QCOMPARE(rig.kept().rows["robot4/amcl_pose"].size(), std::size_t{2});
  }

  void logLinesAndAReferee() {
    QTemporaryDir folder;
    const std::string file = folder.filePath("map.json").toStdString();
    std::ofstream(file) << R"({"mapping": 1, "robots": [],
      "log": [{"topic": "/rosout", "text": "msg", "level": "level", "origin": "name"}],
      "referee": {"topic": "/game", "state": "state", "secondsLeft": "left"}})";
    Rig rig({"robot1,map=" + file});
    rig.begin({jsonChannel(1, "/rosout", "rcl_interfaces/msg/Log"), jsonChannel(2, "/game", "G")});
    rig.send(1, R"({"msg": "lost", "level": 40, "name": "vision"})", 1.0, 1.1);
    rig.send(2, R"({"state": 3, "left": 321})", 1.0, 1.1);
    const MatchFrame frame = rig.advance(1.2);
    QCOMPARE(rig.kept().lines.size(), std::size_t{1});
    QCOMPARE(rig.kept().lines.front().text, std::string("lost"));
    QCOMPARE(rig.kept().lines.front().origin, std::string("vision"));
    QCOMPARE(rig.kept().lines.front().level, LogLevel::Error);
    QVERIFY(frame.game.has_value());
    QCOMPARE(frame.game->state, PlayState::Playing);
    QCOMPARE(frame.game->secondsLeft(), 321);
    QCOMPARE(rig.pipeline->drainNews().lines.size(), std::size_t{1});
  }

  void wrongMessagesCostThemselves() {
    Rig rig({"robot1"});
    rig.begin({{1, "/joints", "cdr", "own/msg/A", "float64 x", "ros2msg"}});
    rig.send(1, "no", 1.0, 1.1);
    rig.send(1, std::string("\0\1\0\0\0\0\0\0\0\0\xf8\x3f", 12), 2.0, 2.1);
    rig.advance(2.2);
    QCOMPARE(rig.pipeline->details(wall(2.2)).topics.front().wrong, std::uint64_t{1});
    QCOMPARE(rig.kept().rows["joints"].size(), std::size_t{1});
    QCOMPARE(rig.kept().rows["joints"].front().values.front(), 1.5);
  }

  void aRecordingShowsTheSame() {
    QTemporaryDir folder;
    const std::string file = folder.filePath("live.mcap").toStdString();
    Rig rig({"robot3"});
    const auto recorder =
        LiveRecorder::create(file, rig.options, WallTime(Duration(zeroNs)), {}).value();
    rig.pipeline->observe(recorder, wall(0.0));
    rig.begin({jsonChannel(1, "/amcl_pose", poseType),
               jsonChannel(2, "/rosout", "rcl_interfaces/msg/Log")});
    MatchFrame shown;
    for (int i = 0; i < 50; ++i) {
      const double time = 1.0 + 0.1 * i;
      rig.send(1, poseJson(0.1 * i, 1.0), time, time + 0.001);
      if (i == 20) rig.send(2, R"({"msg": "a", "level": 20, "name": "b"})", time, time + 0.001);
      shown = rig.advance(time + 0.002);
    }
    rig.pipeline->stopObserving(recorder);
    QVERIFY(recorder->finish());
    const auto session = SessionReader::open(file).value();
    RecordedFrames frames(backdropOf(session));
    const MatchFrame frame = frames.frameAt(session, 3.05);
    const RobotFrame* robot = named(frame, "B3");
    QVERIFY(robot != nullptr && robot->belief);
    QVERIFY(std::abs(robot->belief->position.x - 2.0) < 1e-6);
    QCOMPARE(robot->uid, named(shown, "B3")->uid);
    bool hasTopic = false, hasLink = false;
    for (const auto& group : session.groups()) {
      hasTopic = hasTopic || (group.info.name == "amcl_pose" && group.rows == 50);
      hasLink = hasLink || group.info.name == "ws://robot3:8765 link";
    }
    QVERIFY(hasTopic);
    QVERIFY(!hasLink);  // only of sources that are connected: nothing was noted of this one
  }
};

PITCHBOARD_TEST(TestLiveTopics)

}  // namespace tst_live_topics

#include "tst_live_topics.moc"
