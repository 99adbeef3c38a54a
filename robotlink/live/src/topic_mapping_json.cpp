// SPDX-License-Identifier: GPL-3.0-or-later
// Mappings as files. Each part has a table of its texts, which both directions use.
#include <robotlink/live/topic_mapping.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

#include <base/byte_sizes.h>
#include <base/lined_json.h>
#include <base/read_file.h>
#include <base/try.h>
#include <base/units.h>

namespace pitchboard::link {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t longestPath = 500, mostParts = 100;

template <class Part>
struct TextRow {
  const char* key;
  std::string Part::*text;
};

constexpr std::array<TextRow<MappedPose>, 9> poseTexts{{{"topic", &MappedPose::topic},
                                                        {"x", &MappedPose::x},
                                                        {"y", &MappedPose::y},
                                                        {"yaw", &MappedPose::yaw},
                                                        {"orientation", &MappedPose::orientation},
                                                        {"unit", &MappedPose::unit},
                                                        {"angleUnit", &MappedPose::angleUnit},
                                                        {"covariance", &MappedPose::covariance},
                                                        {"sigma", &MappedPose::sigma}}};
constexpr std::array<TextRow<MappedTransforms>, 3> transformTexts{
    {{"topic", &MappedTransforms::topic},
     {"root", &MappedTransforms::root},
     {"base", &MappedTransforms::base}}};
constexpr std::array<TextRow<MappedBall>, 8> ballTexts{{{"topic", &MappedBall::topic},
                                                        {"x", &MappedBall::x},
                                                        {"y", &MappedBall::y},
                                                        {"distance", &MappedBall::distance},
                                                        {"angle", &MappedBall::angle},
                                                        {"seen", &MappedBall::seen},
                                                        {"unit", &MappedBall::unit},
                                                        {"angleUnit", &MappedBall::angleUnit}}};
constexpr std::array<TextRow<MappedBattery>, 4> batteryTexts{{{"topic", &MappedBattery::topic},
                                                              {"volts", &MappedBattery::volts},
                                                              {"charge", &MappedBattery::charge},
                                                              {"unit", &MappedBattery::unit}}};
constexpr std::array<TextRow<MappedFallen>, 3> fallenTexts{
    {{"topic", &MappedFallen::topic},
     {"orientation", &MappedFallen::orientation},
     {"flag", &MappedFallen::flag}}};
constexpr std::array<TextRow<MappedLog>, 4> logTexts{{{"topic", &MappedLog::topic},
                                                      {"text", &MappedLog::text},
                                                      {"level", &MappedLog::level},
                                                      {"origin", &MappedLog::origin}}};
constexpr std::array<TextRow<MappedReferee>, 6> refereeTexts{
    {{"topic", &MappedReferee::topic},
     {"state", &MappedReferee::state},
     {"secondsLeft", &MappedReferee::secondsLeft},
     {"firstHalf", &MappedReferee::firstHalf},
     {"leftScore", &MappedReferee::leftScore},
     {"rightScore", &MappedReferee::rightScore}}};

constexpr std::array<std::string_view, 3> frameNames{"centre", "studio", "bottom-left"};
constexpr std::array<std::string_view, 3> clockNames{"auto", "header", "log"};

struct VoltRow {
  const char* key;
  std::optional<double> MappedBattery::*volts;
};
constexpr std::array<VoltRow, 3> voltRows{{{"full", &MappedBattery::full},
                                           {"low", &MappedBattery::low},
                                           {"empty", &MappedBattery::empty}}};

/// Reads one file.
class MappingReader {
 public:
  explicit MappingReader(JsonReport& report) : m_report(report) {}

  TopicMapping read(const JsonNode& root) {
    TopicMapping mapping;
    const JsonObject file(
        m_report, root, "",
        {"mapping", "field", "robots", "log", "referee", "recordings", "alignedBy"});
    file.require("mapping");
    (void)file.integer("mapping", 1, 1, 1);
    mapping.field = file.text("field", {}, 100);
    if (!mapping.field.empty() && !sim::fieldByName(mapping.field)) {
      file.fail("field", "there is no field \"" + mapping.field + "\"");
    }
    each(file, "robots", [&](const JsonNode& node, const std::string& path) {
      mapping.robots.push_back(readRobot(node, path));
    });
    each(file, "log", [&](const JsonNode& node, const std::string& path) {
      MappedLog log;
      readPart(node, path, logTexts, {"topic", "text"}, {}, log);
      mapping.log.push_back(std::move(log));
    });
    if (const JsonNode* node = file.find("referee")) mapping.referee = readReferee(*node);
    each(file, "recordings", [&](const JsonNode& node, const std::string& path) {
      mapping.recordings.push_back(readRecording(node, path));
    });
    if (const auto event = file.choice("alignedBy", alignEventNames, "event")) {
      mapping.alignedBy = static_cast<AlignEvent>(*event);
    }
    return mapping;
  }

 private:
  void each(const JsonObject& parent, std::string_view key, auto&& take) {
    const std::vector<JsonNode>* items = parent.array(key, mostParts);
    for (std::size_t i = 0; items != nullptr && i < items->size(); ++i) {
      take((*items)[i], parent.pathOf(key, i));
    }
  }

  /// Reads the texts of a part; `more` are its other keys.
  template <class Part, std::size_t N>
  JsonObject readPart(const JsonNode& node, const std::string& path,
                      const std::array<TextRow<Part>, N>& rows,
                      std::initializer_list<std::string_view> needed,
                      std::initializer_list<std::string_view> more, Part& part) {
    std::vector<std::string_view> keys(more);
    for (const auto& row : rows) keys.push_back(row.key);
    JsonObject object(m_report, node, path, keys);
    for (const auto& row : rows) {
      part.*row.text = object.text(row.key, part.*row.text, longestPath);
    }
    for (const std::string_view key : needed) object.require(key);
    checkUnit(object, "unit", part);
    return object;
  }

  template <class Part>
  static void checkUnit(const JsonObject& object, std::string_view key, const Part& part) {
    if constexpr (requires { part.unit; }) {
      if (unitNamed(part.unit) == nullptr) {
        object.fail(key, "the unit \"" + part.unit + "\" is unknown; use m, cm, mm, V or mV");
      }
    }
    if constexpr (requires { part.angleUnit; }) {
      const Unit* unit = unitNamed(part.angleUnit);
      if (unit == nullptr || unit->kind != UnitKind::Angle) {
        object.fail("angleUnit", "the unit of an angle is rad or deg");
      }
    }
  }

  static MappedFrame frameOf(const JsonObject& object, MappedFrame fallback) {
    const auto index = object.choice("frame", frameNames, "frame");
    return index ? static_cast<MappedFrame>(*index) : fallback;
  }

  static std::optional<TeamColor> colourOf(const JsonObject& object, std::string_view key) {
    static const std::vector<std::string_view> names = [] {
      std::vector<std::string_view> made;
      for (const TeamColorInfo& team : teamColors) made.push_back(team.name);
      return made;
    }();
    const auto index = object.choice(key, names, "team");
    if (!index) return {};
    return teamColors[*index].color;
  }

  MappedRobot readRobot(const JsonNode& node, const std::string& path) {
    MappedRobot robot;
    const JsonObject object(m_report, node, path,
                            {"number", "team", "name", "attacksLeft", "pose", "poses", "transforms",
                             "ball", "battery", "fallen"});
    object.require("number");
    robot.number = object.integer("number", 1, 1, 99);
    robot.team = colourOf(object, "team").value_or(TeamColor::Blue);
    robot.name = object.text("name", {}, 100);
    robot.attacksLeft = object.boolean("attacksLeft", false);
    if (const JsonNode* pose = object.find("pose")) {
      robot.poses.push_back(readPose(*pose, object.pathOf("pose")));
    }
    each(object, "poses", [&](const JsonNode& one, const std::string& onePath) {
      robot.poses.push_back(readPose(one, onePath));
    });
    readParts(object, robot);
    return robot;
  }

  void readParts(const JsonObject& object, MappedRobot& robot) {
    if (const JsonNode* node = object.find("transforms")) {
      const auto part = readPart(*node, object.pathOf("transforms"), transformTexts, {"topic"},
                                 {"frame"}, robot.transforms.emplace());
      robot.transforms->frame = frameOf(part, MappedFrame::Centre);
    }
    if (const JsonNode* node = object.find("ball")) {
      const auto part = readPart(*node, object.pathOf("ball"), ballTexts, {"topic"}, {"frame"},
                                 robot.ball.emplace());
      if (part.find("frame") != nullptr) robot.ball->frame = frameOf(part, MappedFrame::Centre);
      const bool isPlace = !robot.ball->x.empty() && !robot.ball->y.empty();
      const bool isPolar = !robot.ball->distance.empty() && !robot.ball->angle.empty();
      if (!isPlace && !isPolar) part.fail("x", "a ball has x and y, or distance and angle");
    }
    if (const JsonNode* node = object.find("battery")) {
      const auto part = readPart(*node, object.pathOf("battery"), batteryTexts, {"topic"},
                                 {"full", "low", "empty"}, robot.battery.emplace());
      for (const VoltRow& row : voltRows) {
        if (part.find(row.key) == nullptr) continue;
        (*robot.battery).*row.volts = part.number(row.key, 0.0, {0.1, 1000.0, "volts"});
      }
    }
    if (const JsonNode* node = object.find("fallen")) {
      readPart(*node, object.pathOf("fallen"), fallenTexts, {"topic"}, {}, robot.fallen.emplace());
    }
  }

  MappedPose readPose(const JsonNode& node, const std::string& path) {
    MappedPose pose;
    const auto object =
        readPart(node, path, poseTexts, {"topic", "x", "y"}, {"frame", "priority"}, pose);
    pose.frame = frameOf(object, MappedFrame::Centre);
    pose.priority = object.integer("priority", pose.priority, 0, 100);
    return pose;
  }

  MappedReferee readReferee(const JsonNode& node) {
    MappedReferee referee;
    const auto object =
        readPart(node, "referee", refereeTexts, {"topic", "state"}, {"left", "right"}, referee);
    referee.left = colourOf(object, "left").value_or(referee.left);
    referee.right = colourOf(object, "right").value_or(referee.right);
    return referee;
  }

  MappedRecording readRecording(const JsonNode& node, const std::string& path) {
    MappedRecording recording;
    const JsonObject object(m_report, node, path, {"file", "time", "offset"});
    object.require("file");
    recording.file = object.text("file", {}, longestPath);
    if (const auto clock = object.choice("time", clockNames, "time")) {
      recording.clock = static_cast<RecordingClock>(*clock);
    }
    constexpr double longest = 1e10;  // a clock that was never set counts from 1970
    recording.offset = object.number("offset", 0.0, {-longest, longest, "seconds"});
    return recording;
  }

  JsonReport& m_report;
};

/// Texts that are not those of a new part.
template <class Part, std::size_t N>
Json textsOf(const Part& part, const std::array<TextRow<Part>, N>& rows) {
  const Part plain;
  Json json = Json::object();
  for (const auto& row : rows) {
    if (part.*row.text != plain.*row.text) json[row.key] = part.*row.text;
  }
  return json;
}

std::string_view nameOf(MappedFrame frame) {
  return frameNames[static_cast<std::size_t>(frame)];
}

Json poseJson(const MappedPose& pose) {
  Json json = textsOf(pose, poseTexts);
  if (pose.frame != MappedFrame::Centre) json["frame"] = nameOf(pose.frame);
  if (pose.priority != MappedPose().priority) json["priority"] = pose.priority;
  return json;
}

Json robotJson(const MappedRobot& robot) {
  Json json{{"number", robot.number}, {"team", info(robot.team).name}};
  if (!robot.name.empty()) json["name"] = robot.name;
  if (robot.attacksLeft) json["attacksLeft"] = true;
  for (const MappedPose& pose : robot.poses) json["poses"].push_back(poseJson(pose));
  if (robot.transforms) {
    json["transforms"] = textsOf(*robot.transforms, transformTexts);
    if (robot.transforms->frame != MappedFrame::Centre) {
      json["transforms"]["frame"] = nameOf(robot.transforms->frame);
    }
  }
  if (robot.ball) {
    json["ball"] = textsOf(*robot.ball, ballTexts);
    if (robot.ball->frame) json["ball"]["frame"] = nameOf(*robot.ball->frame);
  }
  if (robot.battery) {
    json["battery"] = textsOf(*robot.battery, batteryTexts);
    for (const VoltRow& row : voltRows) {
      if (const auto& volts = (*robot.battery).*row.volts) json["battery"][row.key] = *volts;
    }
  }
  if (robot.fallen) json["fallen"] = textsOf(*robot.fallen, fallenTexts);
  return json;
}

}  // namespace

Result<TopicMapping> mappingFromJson(std::string_view text, const std::string& name) {
  JsonReport report(name);
  const auto root = parseJson(text, report);
  TopicMapping mapping;
  if (root) mapping = MappingReader(report).read(*root);
  if (report.failed()) return tl::unexpected(report.allErrors());
  return mapping;
}

Result<TopicMapping> mappingFromFile(const std::string& path) {
  const auto text = TRY(readFile(path, mebibyte, "The mapping"));
  return mappingFromJson(text, path);
}

std::string mappingText(const TopicMapping& mapping) {
  Json json{{"mapping", 1}};
  if (!mapping.field.empty()) json["field"] = mapping.field;
  json["robots"] = Json::array();
  for (const MappedRobot& robot : mapping.robots) json["robots"].push_back(robotJson(robot));
  if (!mapping.log.empty()) json["log"] = Json::array();
  for (const MappedLog& log : mapping.log) json["log"].push_back(textsOf(log, logTexts));
  if (mapping.referee) {
    json["referee"] = textsOf(*mapping.referee, refereeTexts);
    json["referee"]["left"] = info(mapping.referee->left).name;
    json["referee"]["right"] = info(mapping.referee->right).name;
  }
  for (const MappedRecording& recording : mapping.recordings) {
    Json one{{"file", recording.file}};
    if (recording.clock != RecordingClock::Auto) {
      one["time"] = clockNames[static_cast<std::size_t>(recording.clock)];
    }
    if (recording.offset != 0.0) one["offset"] = recording.offset;
    json["recordings"].push_back(std::move(one));
  }
  if (mapping.alignedBy) json["alignedBy"] = nameOf(*mapping.alignedBy);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pitchboard::link
