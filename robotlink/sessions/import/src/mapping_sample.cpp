// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/import/mapping_sample.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unordered_map>

#include <base/try.h>
#include <robotlink/live/topic_robots.h>

namespace pitchboard::link {
namespace {

using telemetry::RecordedField;
using telemetry::RecordedItem;
using telemetry::RecordedKind;
using telemetry::RecordedMessage;

constexpr std::size_t maxSampledFields = 10'000;  ///< of a topic
constexpr std::size_t longestValue = 60;          ///< bytes
constexpr double sampledTimeout = 2.0;            // s

class NoRows : public telemetry::RowSink {
 public:
  telemetry::GroupId addGroup(const telemetry::GroupInfo&) override { return 0; }
  void append(telemetry::GroupId, const telemetry::RowView&) override {}
};

std::string valueText(const RecordedField& field, double value) {
  if (field.kind == RecordedKind::Flag) return value != 0.0 ? "yes" : "no";
  const auto label = field.labels.find(
      static_cast<std::int32_t>(std::isfinite(value) ? std::clamp(value, -2e9, 2e9) : 0.0));
  if (field.kind == RecordedKind::Enumeration && label != field.labels.end()) return label->second;
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// The fields of a topic over all shapes, and where those of the last shape are among them.
class TopicGathering {
 public:
  void take(const RecordedMessage& message) {
    ++m_messages;
    if (m_shape != message.shape) place(message);
    m_values.assign(message.values.begin(), message.values.end());
    m_texts.assign(message.texts.begin(), message.texts.end());
  }

  SampledTopic finish(const telemetry::RecordedTopic& topic) {
    if (m_shape) keepValues();
    SampledTopic made;
    made.topic = topic;
    made.fields = std::move(m_fields);
    made.values = std::move(m_shown);
    made.messages = m_messages;
    return made;
  }

 private:
  void place(const RecordedMessage& message) {
    if (m_shape) keepValues();
    m_shape = message.shape;
    m_places.clear();
    for (const RecordedField& field : m_shape->fields) {
      const auto [known, isNew] = m_index.try_emplace(field.path, m_fields.size());
      if (isNew && m_fields.size() < maxSampledFields) {
        m_fields.push_back(field);
        m_shown.emplace_back();
      }
      m_places.push_back(known->second);
    }
  }
  void keepValues() {
    std::size_t text = 0;
    for (std::size_t i = 0; i < m_places.size(); ++i) {
      const RecordedField& field = m_shape->fields[i];
      const bool isText = field.kind == RecordedKind::Text;
      const std::string shown =
          isText ? m_texts[text++].substr(0, longestValue) : valueText(field, m_values[i]);
      if (m_places[i] < m_shown.size()) m_shown[m_places[i]] = shown;
    }
  }

  std::vector<RecordedField> m_fields;
  std::vector<std::string> m_shown;
  std::unordered_map<std::string, std::size_t> m_index;
  std::shared_ptr<const telemetry::RecordedShape> m_shape;
  std::vector<std::size_t> m_places;
  std::vector<double> m_values;
  std::vector<std::string> m_texts;
  std::uint64_t m_messages = 0;
};

/// What was found in one of the recordings.
struct RecordingGathering {
  std::vector<TopicGathering> topics;
  std::optional<std::int64_t> begin;
  std::int64_t end = 0;

  void take(const OpenedRecording& from) {
    begin = begin.value_or(from.time);
    end = from.time;
    if (from.item != RecordedItem::Message) return;
    const RecordedMessage& message = from.reader->message();
    if (topics.size() <= message.topic) topics.resize(message.topic + 1);
    topics[message.topic].take(message);
  }
};

/// The usual mapping does not know the robots of a tree of transforms: their frames name them.
void nameRobotsOfFrames(MappingSample& sample) {
  const auto isMapped = [&sample](const RobotFrame& frame) {
    return std::ranges::any_of(sample.mapping.robots, [&frame](const MappedRobot& robot) {
      return robot.number == frame.identity.number && robot.team == frame.identity.team;
    });
  };
  for (MappedRobot& robot : sample.mapping.robots) {
    if (!robot.transforms || !robot.name.empty()) continue;
    for (const RobotFrame& frame : sample.robots) {
      if (frame.ownName.empty() || isMapped(frame)) continue;
      robot.number = frame.identity.number;
      robot.name = frame.ownName;
      break;
    }
  }
  std::ranges::stable_sort(sample.mapping.robots, {}, &MappedRobot::number);
}

}  // namespace

Result<MappingSample> sampleMapping(const OpenRecordings& open,
                                    const std::optional<TopicMapping>& mapping,
                                    std::optional<double> seconds,
                                    const std::function<bool()>& goesOn) {
  constexpr std::uint64_t betweenQuestions = 1000;
  auto sources = TRY(open(mapping ? mapping->recordings : std::vector<MappedRecording>()));
  MappingSample sample;
  sample.mapping = mapping ? *mapping : builtInMapping(topicsOf(sources));
  if (!sample.mapping.field.empty()) sample.field = TRY(sim::fieldByName(sample.mapping.field));
  NoRows rows;
  TopicRobots::Options options;
  options.field = sample.field;
  options.timeout = sampledTimeout;
  TopicRobots robots(rows, sample.mapping, options);
  std::vector<RecordingGathering> found(sources.size());
  for (OpenedRecording& source : sources) TRY(source.step());
  std::optional<std::int64_t> first;
  const auto secondsOf = [&first](std::int64_t time) {
    return static_cast<double>(time - *first) / 1e9;
  };
  std::uint64_t count = 0;
  while (OpenedRecording* source = earliestOf(sources)) {
    if (++count % betweenQuestions == 0 && goesOn && !goesOn()) {
      return failure(ErrorCode::Conflict, "Reading was stopped.");
    }
    first = first.value_or(source->time);
    const double time = secondsOf(source->time);
    if (seconds && time > *seconds) break;
    sample.end = std::max(sample.end, time);
    found[static_cast<std::size_t>(source - sources.data())].take(*source);
    if (source->item == RecordedItem::Message) {
      const RecordedMessage& message = source->reader->message();
      robots.take(source->reader->topics()[message.topic], message, time);
    }
    TRY(source->step());
  }
  sample.time = seconds.value_or(sample.end);
  sample.robots = robots.frames(sample.time, {});
  std::ranges::stable_sort(sample.robots, {},
                           [](const RobotFrame& robot) { return robot.identity.number; });
  if (!mapping) nameRobotsOfFrames(sample);
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const auto& topics = sources[s].reader->topics();
    found[s].topics.resize(std::max(found[s].topics.size(), topics.size()));
    for (std::size_t i = 0; i < topics.size(); ++i) {
      sample.topics.push_back(found[s].topics[i].finish(topics[i]));
    }
    SampledRecording recording{sources[s].timing, 0.0, 0.0};
    if (found[s].begin) {
      recording.begin = secondsOf(*found[s].begin);
      recording.end = secondsOf(found[s].end);
    }
    sample.recordings.push_back(std::move(recording));
  }
  return sample;
}

}  // namespace pitchboard::link
