// SPDX-License-Identifier: GPL-3.0-or-later
// Mappings that people make: fields are put into places one by one, problems are named, and what a
// mapping makes of a recording at a moment is what an import makes of it. Recordings of one match
// are moved on one clock, and the mapping beside a recording is used.

#include <QTemporaryDir>
#include <QtTest>

#include <cmath>
#include <fstream>

#include <robotlink/import/import_session.h>
#include <robotlink/import/mapping_sample.h>
#include <robotlink/session/recorded_frame.h>
#include <telemetry/session/session_reader.h>

namespace tst_mapping {

using namespace pitchboard;
using namespace pitchboard::link;
using telemetry::RecordedField;
using telemetry::RecordedKind;
using telemetry::SessionReader;

namespace {

std::string recording(const std::string& name) {
  return std::string(PITCHBOARD_SOURCE_DIR "/tests/data/recordings/") + name;
}

MappingSample sampleOf(const std::vector<std::string>& files,
                       const std::optional<TopicMapping>& mapping,
                       std::optional<double> seconds = {}) {
  const auto open = [&](const std::vector<MappedRecording>& timing) {
    return openTogether(files, timing);
  };
  return sampleMapping(open, mapping, seconds, {}).value();
}

const SampledTopic* topicOf(const MappingSample& sample, const std::string& name) {
  for (const SampledTopic& topic : sample.topics) {
    if (topic.topic.name == name) return &topic;
  }
  return nullptr;
}

std::string valueOf(const MappingSample& sample, const std::string& topic,
                    const std::string& path) {
  const SampledTopic* found = topicOf(sample, topic);
  for (std::size_t i = 0; found != nullptr && i < found->fields.size(); ++i) {
    if (found->fields[i].path == path) return found->values[i];
  }
  return "no such field";
}

std::vector<std::string> put(TopicMapping& mapping, MappingSlot slot, const MappingSample& sample,
                             const std::string& topic, const std::string& path) {
  return putField(mapping, 0, slot, {topic, path}, topicOf(sample, topic)->fields);
}

bool hasProblem(const std::vector<MappingProblem>& problems, const std::string& part) {
  return std::ranges::any_of(problems, [&](const MappingProblem& one) {
    return one.sentence.find(part) != std::string::npos;
  });
}

std::vector<MappingProblem> problems(const TopicMapping& mapping, const MappingSample& sample) {
  const std::vector<TopicFields> topics(sample.topics.begin(), sample.topics.end());
  return problemsOf(mapping, topics);
}

constexpr const char* poseTopic = "/robot3/amcl_pose";

}  // namespace

class TestMapping : public QObject {
  Q_OBJECT

  QTemporaryDir m_folder;
  std::string path(const char* name) const { return m_folder.filePath(name).toStdString(); }

 private slots:
  void topicsWithTypesUnitsAndValues() {
    const MappingSample sample = sampleOf({recording("robot_walks.mcap")}, {});
    const SampledTopic* pose = topicOf(sample, poseTopic);
    QVERIFY(pose != nullptr && pose->messages > 0);
    QCOMPARE(pose->topic.type, std::string("geometry_msgs/PoseWithCovarianceStamped"));
    QCOMPARE(pose->fields.size(), pose->values.size());
    QVERIFY(std::stod(valueOf(sample, poseTopic, "pose.pose.position.x")) != 0.0);
    const SampledTopic* image = topicOf(sample, "/camera/image");
    QVERIFY(image != nullptr && image->topic.isSkipped && image->fields.empty());
    QVERIFY(sample.end > 1.0);
    // The usual mapping is the one of an import without a file.
    QCOMPARE(sample.robots.size(), std::size_t{2});
    QVERIFY(problems(sample.mapping, sample).empty());
  }

  /// The robots at a moment are those of the imported session at that moment.
  void sameAsTheImport() {
    const auto report =
        importRecordings({recording("robot_walks.mcap")}, path("walk.mcap"), {}).value();
    QCOMPARE(report.robots.size(), std::size_t{2});
    const auto session = SessionReader::open(path("walk.mcap")).value();
    RecordedFrames frames(backdropOf(session));
    for (const double at : {1.0, 4.0, 9.0}) {
      const MappingSample sample = sampleOf({recording("robot_walks.mcap")}, {}, at);
      const MatchFrame frame = frames.frameAt(session, session.range()->begin + at);
      QVERIFY(!sample.robots.empty());
      for (const RobotFrame& robot : sample.robots) {
        const auto same = std::ranges::find(frame.robots, robot.name, &RobotFrame::name);
        QVERIFY2(same != frame.robots.end(), robot.name.c_str());
        QVERIFY(robot.belief && same->belief);
        // Sessions have whole centimetres, and frames at their own times.
        const double apart = distance(robot.belief->position, same->belief->position);
        QVERIFY2(apart < 0.05, (robot.name + " at " + std::to_string(at) + " is " +
                                std::to_string(apart) + " m away")
                                   .c_str());
      }
    }
  }

  void fieldsArePutIntoPlaces() {
    const MappingSample sample = sampleOf({recording("robot_walks.mcap")}, {});
    TopicMapping mapping;
    mapping.robots.push_back({});
    mapping.robots[0].number = 3;
    put(mapping, MappingSlot::PoseX, sample, poseTopic, "pose.pose.position.x");
    QVERIFY(hasProblem(problems(mapping, sample), "the pose needs x and y"));
    put(mapping, MappingSlot::PoseY, sample, poseTopic, "pose.pose.position.y");
    QVERIFY(hasProblem(problems(mapping, sample), "without a heading"));
    // One component stands for the whole quaternion, one element for the whole covariance.
    put(mapping, MappingSlot::PoseHeading, sample, poseTopic, "pose.pose.orientation.z");
    put(mapping, MappingSlot::PoseCovariance, sample, poseTopic, "pose.covariance[7]");
    QCOMPARE(mapping.robots[0].poses[0].orientation, std::string("pose.pose.orientation"));
    QCOMPARE(mapping.robots[0].poses[0].yaw, std::string());
    QCOMPARE(mapping.robots[0].poses[0].covariance, std::string("pose.covariance"));
    QVERIFY(problems(mapping, sample).empty());
    // An angle takes the place of the quaternion.
    put(mapping, MappingSlot::PoseHeading, sample, poseTopic, "pose.pose.position.z");
    QCOMPARE(mapping.robots[0].poses[0].orientation, std::string());
    QCOMPARE(fieldIn(mapping, 0, MappingSlot::PoseHeading),
             (TopicField{poseTopic, "pose.pose.position.z"}));
    // The file that is saved reads back to the same.
    QCOMPARE(mappingFromJson(mappingText(mapping), "mapping").value(), mapping);
    const MappingSample mapped = sampleOf({recording("robot_walks.mcap")}, mapping);
    QCOMPARE(mapped.robots.size(), std::size_t{1});
    QCOMPARE(mapped.robots[0].name, std::string("B3"));
    QVERIFY(mapped.robots[0].sigma.has_value());
  }

  void aPartHasOneTopic() {
    const MappingSample sample = sampleOf({recording("robot_walks.mcap")}, {});
    TopicMapping mapping;
    mapping.robots.push_back({});
    mapping.robots[0].number = 3;
    put(mapping, MappingSlot::BallX, sample, "/robot3/ball", "x_mm");
    put(mapping, MappingSlot::BallSeen, sample, "/robot3/ball", "seen");
    const auto cleared =
        put(mapping, MappingSlot::BallX, sample, poseTopic, "pose.pose.position.x");
    QCOMPARE(cleared, std::vector<std::string>{"seen"});
    QCOMPARE(mapping.robots[0].ball->topic, std::string(poseTopic));
    putField(mapping, 0, MappingSlot::BallX, {}, {});
    QVERIFY(!mapping.robots[0].ball);
    put(mapping, MappingSlot::LogText, sample, "/rosout", "msg");
    put(mapping, MappingSlot::LogLevel, sample, "/rosout", "level");
    QCOMPARE(mapping.log.size(), std::size_t{1});
    put(mapping, MappingSlot::LogLevel, sample, "/rosout", "name");
    QVERIFY(hasProblem(problems(mapping, sample), "Log, Log level: name is a text"));
    mapping.robots[0].battery.emplace();
    mapping.robots[0].battery->topic = "/none";
    mapping.robots[0].battery->volts = "v";
    QVERIFY(hasProblem(problems(mapping, sample), "there is no topic /none"));
    mapping.robots[0].battery->topic = poseTopic;
    QVERIFY(hasProblem(problems(mapping, sample), "has no field v"));
  }

  /// Two recordings of one match: one is moved by hand, and stays so with the mapping.
  void recordingsAreMovedOnOneClock() {
    const std::string first = path("first.csv"), second = path("second.csv");
    std::ofstream(first) << "time,x\n1751364000.0,1\n1751364010.0,2\n";
    std::ofstream(second) << "time,y\n1751364003.0,1\n1751364005.0,2\n";
    TopicMapping mapping;
    mapping.recordings = {{"first.csv", RecordingClock::Auto, 0.0},
                          {"second.csv", RecordingClock::Log, 2.5}};
    QCOMPARE(mappingFromJson(mappingText(mapping), "mapping").value(), mapping);
    const MappingSample sample = sampleOf({first, second}, mapping);
    QCOMPARE(sample.recordings.size(), std::size_t{2});
    QCOMPARE(sample.recordings[1].timing, mapping.recordings[1]);
    QVERIFY(std::abs(sample.recordings[1].begin - 5.5) < 1e-6);
    QVERIFY(std::abs(sample.recordings[1].end - 7.5) < 1e-6);
    ImportOptions options;
    options.mapping = mapping;
    QVERIFY(importRecordings({first, second}, path("both.mcap"), options).has_value());
    const auto session = SessionReader::open(path("both.mcap")).value();
    const auto group = session.groupsNamed("second").value();
    std::vector<double> times;
    session.rows(*session.range(), group, [&](telemetry::GroupId, const telemetry::RowView& row) {
      times.push_back(row.time);
      return true;
    });
    QCOMPARE(times.size(), std::size_t{2});
    QVERIFY(std::abs(times[0] - 5.5) < 1e-6);
    QVERIFY(std::abs(times[1] - 7.5) < 1e-6);
  }

  void theMappingBesideARecordingIsUsed() {
    QCOMPARE(mappingBeside("/a/walk.mcap"), std::string("/a/walk.mapping.json"));
    QCOMPARE(mappingBeside("/a/bag/"), std::string("/a/bag.mapping.json"));
    const std::string copy = path("copy.mcap");
    QVERIFY(QFile::copy(QString::fromStdString(recording("robot_walks.mcap")),
                        QString::fromStdString(copy)));
    TopicMapping mapping;
    mapping.robots.push_back({});
    mapping.robots[0].number = 9;
    mapping.robots[0].team = TeamColor::Red;
    mapping.robots[0].poses.push_back({});
    mapping.robots[0].poses[0].topic = poseTopic;
    mapping.robots[0].poses[0].x = "pose.pose.position.x";
    mapping.robots[0].poses[0].y = "pose.pose.position.y";
    std::ofstream(path("copy.mapping.json")) << mappingText(mapping);
    const auto report = importRecordings({copy}, path("copied.mcap"), {}).value();
    QCOMPARE(report.robots, std::vector<std::string>{"R9"});
    QVERIFY(report.notes.back().find("copy.mapping.json") != std::string::npos);
    std::ofstream(path("copy.mapping.json")) << "{";
    const auto wrong = importRecordings({copy}, path("wrong.mcap"), {});
    QVERIFY(!wrong && wrong.error().text().find("copy.mapping.json") != std::string::npos);
  }
};

PITCHBOARD_TEST(TestMapping)

}  // namespace tst_mapping

#include "tst_mapping.moc"
