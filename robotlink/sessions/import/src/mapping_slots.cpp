// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/import/mapping_slots.h>

#include <algorithm>
#include <array>
#include <map>

namespace pitchboard::link {
namespace {

using telemetry::RecordedField;

constexpr std::array<MappingSlotInfo, 22> slotRows{
    {{MappingSlot::PoseX, "Pose", "x", true},
     {MappingSlot::PoseY, "Pose", "y", true},
     {MappingSlot::PoseHeading, "Pose", "heading", true},
     {MappingSlot::PoseCovariance, "Pose", "covariance", true},
     {MappingSlot::PoseSigma, "Pose", "standard deviation", true},
     {MappingSlot::Transforms, "Transforms", "transforms", true},
     {MappingSlot::BallX, "Ball", "x", true},
     {MappingSlot::BallY, "Ball", "y", true},
     {MappingSlot::BallDistance, "Ball", "distance", true},
     {MappingSlot::BallAngle, "Ball", "angle", true},
     {MappingSlot::BallSeen, "Ball", "seen", true},
     {MappingSlot::BatteryVolts, "Battery", "voltage", true},
     {MappingSlot::BatteryCharge, "Battery", "charge", true},
     {MappingSlot::Fallen, "Fallen", "fallen", true},
     {MappingSlot::LogText, "Log", "text", false},
     {MappingSlot::LogLevel, "Log", "level", false},
     {MappingSlot::LogOrigin, "Log", "origin", false},
     {MappingSlot::RefereeState, "Referee", "state", false},
     {MappingSlot::RefereeSecondsLeft, "Referee", "seconds left", false},
     {MappingSlot::RefereeFirstHalf, "Referee", "first half", false},
     {MappingSlot::RefereeLeftScore, "Referee", "left score", false},
     {MappingSlot::RefereeRightScore, "Referee", "right score", false}}};

/// Of a part: its topic, and the text of a place. `second` is the other text that the place can
/// have, that of a quaternion.
struct SlotTexts {
  std::string* topic = nullptr;
  std::string* text = nullptr;
  std::string* second = nullptr;
};

/// The part of a place; `make`: it is made if it is not there.
struct Parts {
  TopicMapping& mapping;
  std::size_t robot;
  bool make;

  MappedPose* pose() const {
    auto& poses = mapping.robots[robot].poses;
    if (poses.empty() && make) poses.emplace_back();
    return poses.empty() ? nullptr : &*std::ranges::max_element(poses, {}, &MappedPose::priority);
  }
  template <class Part>
  Part* of(std::optional<Part>& part) const {
    if (!part && make) part.emplace();
    return part ? &*part : nullptr;
  }
  MappedLog* log() const {
    if (mapping.log.empty() && make) mapping.log.emplace_back();
    return mapping.log.empty() ? nullptr : &mapping.log.front();
  }
};

template <class Part>
SlotTexts textsOf(Part* part, std::string Part::*text, std::string Part::*second = nullptr) {
  if (part == nullptr) return {};
  return {&part->topic, &(part->*text), second != nullptr ? &(part->*second) : nullptr};
}

SlotTexts textsOf(const Parts& parts, MappingSlot slot) {
  using S = MappingSlot;
  const auto robot = [&]() -> MappedRobot& { return parts.mapping.robots[parts.robot]; };
  switch (slot) {
    case S::PoseX:
      return textsOf(parts.pose(), &MappedPose::x);
    case S::PoseY:
      return textsOf(parts.pose(), &MappedPose::y);
    case S::PoseHeading:
      return textsOf(parts.pose(), &MappedPose::yaw, &MappedPose::orientation);
    case S::PoseCovariance:
      return textsOf(parts.pose(), &MappedPose::covariance);
    case S::PoseSigma:
      return textsOf(parts.pose(), &MappedPose::sigma);
    case S::Transforms:
      return textsOf(parts.of(robot().transforms), &MappedTransforms::topic);
    case S::BallX:
      return textsOf(parts.of(robot().ball), &MappedBall::x);
    case S::BallY:
      return textsOf(parts.of(robot().ball), &MappedBall::y);
    case S::BallDistance:
      return textsOf(parts.of(robot().ball), &MappedBall::distance);
    case S::BallAngle:
      return textsOf(parts.of(robot().ball), &MappedBall::angle);
    case S::BallSeen:
      return textsOf(parts.of(robot().ball), &MappedBall::seen);
    case S::BatteryVolts:
      return textsOf(parts.of(robot().battery), &MappedBattery::volts);
    case S::BatteryCharge:
      return textsOf(parts.of(robot().battery), &MappedBattery::charge);
    case S::Fallen:
      return textsOf(parts.of(robot().fallen), &MappedFallen::flag, &MappedFallen::orientation);
    case S::LogText:
      return textsOf(parts.log(), &MappedLog::text);
    case S::LogLevel:
      return textsOf(parts.log(), &MappedLog::level);
    case S::LogOrigin:
      return textsOf(parts.log(), &MappedLog::origin);
    case S::RefereeState:
      return textsOf(parts.of(parts.mapping.referee), &MappedReferee::state);
    case S::RefereeSecondsLeft:
      return textsOf(parts.of(parts.mapping.referee), &MappedReferee::secondsLeft);
    case S::RefereeFirstHalf:
      return textsOf(parts.of(parts.mapping.referee), &MappedReferee::firstHalf);
    case S::RefereeLeftScore:
      return textsOf(parts.of(parts.mapping.referee), &MappedReferee::leftScore);
    case S::RefereeRightScore:
      return textsOf(parts.of(parts.mapping.referee), &MappedReferee::rightScore);
  }
  return {};
}

bool hasField(std::span<const RecordedField> fields, const std::string& path) {
  return std::ranges::find(fields, path, &RecordedField::path) != fields.end();
}

bool isQuaternion(std::span<const RecordedField> fields, const std::string& path) {
  return std::ranges::all_of(std::array{".x", ".y", ".z", ".w"}, [&](const char* component) {
    return hasField(fields, path + component);
  });
}

bool isCovariance(std::span<const RecordedField> fields, const std::string& path) {
  return hasField(fields, path + "[0]") && hasField(fields, path + "[35]");
}

/// "a.b" of "a.b.x" and of "a.b[3]".
std::string wholeOf(const std::string& path) {
  const auto end = path.find_last_of(".[");
  return end == path.npos ? std::string() : path.substr(0, end);
}

/// Parts in which nothing is left.
void removeEmptyParts(TopicMapping& mapping) {
  const auto isPlace = [](const MappedBall& ball) {
    return !(ball.x + ball.y + ball.distance + ball.angle + ball.seen).empty();
  };
  for (MappedRobot& robot : mapping.robots) {
    std::erase_if(robot.poses, [](const MappedPose& pose) {
      return (pose.x + pose.y + pose.yaw + pose.orientation + pose.covariance + pose.sigma).empty();
    });
    if (robot.transforms && robot.transforms->topic.empty()) robot.transforms.reset();
    if (robot.ball && !isPlace(*robot.ball)) robot.ball.reset();
    if (robot.battery && (robot.battery->volts + robot.battery->charge).empty()) {
      robot.battery.reset();
    }
    if (robot.fallen && (robot.fallen->flag + robot.fallen->orientation).empty()) {
      robot.fallen.reset();
    }
  }
  std::erase_if(mapping.log,
                [](const MappedLog& log) { return (log.text + log.level + log.origin).empty(); });
  if (mapping.referee) {
    const MappedReferee& referee = *mapping.referee;
    const bool isEmpty = (referee.state + referee.secondsLeft + referee.firstHalf +
                          referee.leftScore + referee.rightScore)
                             .empty();
    if (isEmpty) mapping.referee.reset();
  }
}

/// Clears the other places of the part; returns their names.
std::vector<std::string> clearOthers(TopicMapping& mapping, std::size_t robot, MappingSlot kept) {
  std::vector<std::string> cleared;
  for (const MappingSlotInfo& row : slotRows) {
    if (row.part != info(kept).part || row.slot == kept) continue;
    const SlotTexts texts = textsOf(Parts{mapping, robot, false}, row.slot);
    const bool isTaken =
        texts.text != nullptr && (!texts.text->empty() || (texts.second && !texts.second->empty()));
    if (!isTaken) continue;
    texts.text->clear();
    if (texts.second != nullptr) texts.second->clear();
    cleared.emplace_back(row.name);
  }
  return cleared;
}

}  // namespace

std::span<const MappingSlotInfo> mappingSlots() {
  return slotRows;
}

const MappingSlotInfo& info(MappingSlot slot) {
  return slotRows[static_cast<std::size_t>(slot)];
}

TopicField fieldIn(const TopicMapping& mapping, std::size_t robot, MappingSlot slot) {
  TopicMapping copy;  // nothing of it is changed; the texts are found by one function
  if (info(slot).isOfRobot) {
    copy.robots = {mapping.robots[robot]};
  } else {
    copy.log = mapping.log;
    copy.referee = mapping.referee;
  }
  const SlotTexts texts = textsOf(Parts{copy, 0, false}, slot);
  if (texts.text == nullptr) return {};
  if (slot == MappingSlot::Transforms) return {*texts.topic, {}};
  const std::string& path =
      texts.text->empty() && texts.second != nullptr ? *texts.second : *texts.text;
  return path.empty() ? TopicField() : TopicField{*texts.topic, path};
}

std::vector<std::string> putField(TopicMapping& mapping, std::size_t robot, MappingSlot slot,
                                  TopicField field, std::span<const RecordedField> fields) {
  std::vector<std::string> cleared;
  SlotTexts texts = textsOf(Parts{mapping, robot, !field.isEmpty()}, slot);
  if (texts.text == nullptr) return cleared;
  if (slot == MappingSlot::Transforms) {
    *texts.topic = field.topic;
  } else if (field.isEmpty()) {
    texts.text->clear();
    if (texts.second != nullptr) texts.second->clear();
  } else {
    if (*texts.topic != field.topic) {
      cleared = clearOthers(mapping, robot, slot);
      texts = textsOf(Parts{mapping, robot, true}, slot);
      *texts.topic = field.topic;
    }
    const std::string whole = wholeOf(field.path);
    if (slot == MappingSlot::PoseCovariance && !isCovariance(fields, field.path) &&
        isCovariance(fields, whole)) {
      field.path = whole;
    }
    if (texts.second != nullptr && isQuaternion(fields, whole)) field.path = whole;
    const bool isSecond = texts.second != nullptr && isQuaternion(fields, field.path);
    if (texts.second != nullptr) texts.second->clear();
    texts.text->clear();
    *(isSecond ? texts.second : texts.text) = field.path;
  }
  removeEmptyParts(mapping);
  return cleared;
}

namespace {

class ProblemFinder {
 public:
  ProblemFinder(const TopicMapping& mapping, std::span<const TopicFields> topics)
      : m_mapping(mapping), m_topics(topics) {}

  std::vector<MappingProblem> find() {
    if (m_mapping.robots.empty()) add("There is no robot. Add one, and give it a pose.");
    std::map<std::pair<TeamColor, int>, int> numbers;
    for (std::size_t i = 0; i < m_mapping.robots.size(); ++i) {
      const MappedRobot& robot = m_mapping.robots[i];
      m_robot = i;
      m_name = "Robot " + std::to_string(robot.number);
      if (++numbers[{robot.team, robot.number}] == 2) {
        add("There are two robots with number " + std::to_string(robot.number) + " in one team.",
            true);
      }
      checkRobot(robot);
    }
    m_robot.reset();
    m_name = "Log";
    checkSlots(false, "Log");
    if (!m_mapping.log.empty() && m_mapping.log.front().text.empty()) {
      add("The log has no text.", true);
    }
    m_name = "Referee";
    checkSlots(false, "Referee");
    if (m_mapping.referee && m_mapping.referee->state.empty()) {
      add("The referee has no state.", true);
    }
    return std::move(m_problems);
  }

 private:
  void add(std::string sentence, bool isError = false) {
    m_problems.push_back({std::move(sentence), isError, m_robot});
  }

  void checkRobot(const MappedRobot& robot) {
    for (const MappedPose& pose : robot.poses) {
      if (pose.x.empty() || pose.y.empty()) {
        add(m_name + ": the pose needs x and y.", true);
      } else if (pose.yaw.empty() && pose.orientation.empty()) {
        add(m_name + ": without a heading it always looks to the right.");
      }
    }
    if (robot.poses.empty() && !robot.transforms) {
      add(m_name + ": without a pose it is not on the field.");
    }
    if (robot.ball) {
      const bool isPlace = !robot.ball->x.empty() && !robot.ball->y.empty();
      const bool isPolar = !robot.ball->distance.empty() && !robot.ball->angle.empty();
      if (!isPlace && !isPolar) {
        add(m_name + ": the ball needs x and y, or distance and angle.", true);
      }
    }
    checkSlots(true, {});
  }

  void checkSlots(bool isOfRobot, std::string_view part) {
    for (const MappingSlotInfo& row : slotRows) {
      if (row.isOfRobot != isOfRobot || (!part.empty() && row.part != part)) continue;
      const TopicField field = fieldIn(m_mapping, m_robot.value_or(0), row.slot);
      if (!field.isEmpty()) checkField(row, field);
    }
  }

  void checkField(const MappingSlotInfo& row, const TopicField& field) {
    const auto topic = std::ranges::find(m_topics, field.topic, [](const TopicFields& one) {
      return std::string_view(one.topic.name);
    });
    const std::string where =
        m_name + ", " + std::string(row.part) + " " + std::string(row.name) + ": ";
    if (topic == m_topics.end()) return add(where + "there is no topic " + field.topic + ".");
    if (field.path.empty() || topic->fields.empty()) return;  // it has sent nothing yet
    const auto& fields = topic->fields;
    const auto found = std::ranges::find(fields, field.path, &RecordedField::path);
    const bool isWhole = isQuaternion(fields, field.path) || isCovariance(fields, field.path);
    if (found == fields.end() && !isWhole) {
      return add(where + field.topic + " has no field " + field.path + ".");
    }
    if (found == fields.end()) return;
    const bool isText = found->kind == telemetry::RecordedKind::Text;
    const bool takesText = row.slot == MappingSlot::LogText || row.slot == MappingSlot::LogOrigin;
    if (isText != takesText) {
      add(where + field.path +
          (isText ? " is a text, not a number." : " is a number, not a text."));
    }
  }

  const TopicMapping& m_mapping;
  std::span<const TopicFields> m_topics;
  std::vector<MappingProblem> m_problems;
  std::optional<std::size_t> m_robot;
  std::string m_name;
};

}  // namespace

std::vector<MappingProblem> problemsOf(const TopicMapping& mapping,
                                       std::span<const TopicFields> topics) {
  return ProblemFinder(mapping, topics).find();
}

}  // namespace pitchboard::link
